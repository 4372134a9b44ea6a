-- Two rods meet end to end. Exact waves say how long they press and how fast each leaves: the test of a contact law.
title = "Impact of two rods"

parameters = {
    E1 = 200e9, rho1 = 7850, L1 = 1, v1 = 2, -- steel: Pa, kg/m^3, m, m/s
    E2 = 70e9, rho2 = 2700, L2 = 1.5, v2 = -1, -- aluminium
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

initial = { velocity = function(X) return X < L1 + gap / 2 and v1 or v2 end }

scheme = "ulsph"
support, integrator, cfl = 2.4, "tvd-rk2", 0.5
contact = { law = "predicted" }

oracle = { name = "rod-impact" }
probes = { { name = "left face", X = {L1} }, { name = "right face", X = {L1 + gap} } }
