-- Two rods meet end to end. Exact waves say how long they press and how fast each leaves: the test of a contact law.
title = "Impact of two rods"

parameters = {
    E1 = 200e9, rho1 = 7850, L1 = 1, v1 = 4, -- steel: Pa, kg/m^3, m, m/s
    E2 = 70e9, rho2 = 2700, L2 = 1.5, v2 = 1, -- aluminium
    gap = 1e-4, -- m
}

dim = 1
bodies = {
    { shape = "box", lower = {0}, upper = {L1} },
    { shape = "box", lower = {L1 + gap}, upper = {L1 + gap + L2} },
}
reference_length = 1
n = 400
levels = {100, 200, 400}
lattice = "centres" -- half a spacing from either face, so that particles meet at one spacing

material = {
    model = "linear-elastic", E = E1, nu = 0, rho = rho1,
    at = function(X) if X < L1 + gap / 2 then return E1, 0, rho1 end return E2, 0, rho2 end,
}
t_end = 1.2e-3 -- s
golden = { t_end = 2e-4 } -- s: they press

initial = { velocity = function(X) return X < L1 + gap / 2 and v1 or v2 end }

scheme = "ulsph"
support, integrator, cfl = 2.4, "tvd-rk2", 0.5
contact = { law = "predicted" }

oracle = { name = "rod-impact" }
figures = {
    ["contact time"] = { measure = "contact time" },
    ["exit velocity 1"] = { measure = "body velocity", body = {1} },
    ["exit velocity 2"] = { measure = "body velocity", body = {2} },
}
probes = { { name = "left face", X = {L1} }, { name = "right face", X = {L1 + gap} } }

-- At n = 400: relative errors of what the impact leaves, and their orders from n = 200. The velocity jumps: first order at
-- best. With the law as printed the rods go into one another, whatever n: contact.law = "printed" misses every bound.
gates = {
    { when = { scheme = "ulsph", integrator = "tvd-rk2", cfl = 0.5, E2 = 70e9 },
      ["figure contact time"] = 0.004, ["figure exit velocity 1"] = 0.006, ["figure exit velocity 2"] = 0.005,
      ["rate figure contact time"] = 0.7, ["rate figure exit velocity 1"] = 0.6, ["rate figure exit velocity 2"] = 0.6 },
    -- equal rods exchange their velocities: --set E2=200e9 --set rho2=7850 --set L2=1
    { when = { scheme = "ulsph", integrator = "tvd-rk2", cfl = 0.5, E2 = 200e9, rho2 = 7850, L2 = 1 },
      ["figure contact time"] = 0.004, ["figure exit velocity 1"] = 0.02, ["figure exit velocity 2"] = 0.006,
      ["rate figure exit velocity 1"] = 0.6, ["rate figure exit velocity 2"] = 0.6 },
}

view = {
    field = "sigma_xx", range = {-33e6, 33e6}, bands = 11, -- Pa
    direction = {0, 0, 1}, up = {0, 1, 0}, magnify = 1, size = {1200, 400},
}
