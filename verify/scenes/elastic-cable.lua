-- A cable is pulled at its free quarter: a wave runs to the wall and back. What jumps is the velocity, so this scene
-- shows how a scheme carries a jump; the displacement of the free end is what the paper compares.
title = "Elastic cable"
source = "001_363f711843f01da4.txt, section 4.3"

parameters = { L = 10, moving = 2.5, U0 = 5 } -- m, m, m/s

dim = 1
domain = { lower = {0}, upper = {L} } -- m
n = 800
levels = {200, 400, 800} -- spacings of 0.05, 0.025 and 0.0125 m

material = { model = "linear-elastic", E = 200e9, nu = 0, rho = 8000 } -- Pa, -, kg/m^3
t_end = 0.01 -- s, a period and a quarter

faces = { X0 = "clamped", X1 = "free" }
initial = {
    velocity = function(X) -- the particle on the edge has the mean: half of its volume moves
        local beyond = X - (L - moving)
        return math.abs(beyond) < 1e-9 * L and U0 / 2 or beyond > 0 and U0 or 0
    end,
}

scheme = "upwind" -- or "ulsph", the paper's updated-Lagrangian system
if scheme == "ulsph" then
    support, integrator, cfl = 2.4, "tvd-rk2", 0.5
else
    evolved, stencil, integrator, cfl = "pF", "sbp4", "rk4", 0.8
end

oracle = { name = "cable" }
probes = { { name = "free end", X = {L} } }

probe_scale = 5e-3 -- m: what the source divides by, going by its own figures

-- Root mean square error of the free end's displacement over time [m], and that over probe_scale.
published = {
    source = "001_363f711843f01da4.txt, Table 3, delta-ULSPH-R-TIC",
    { n = 200, probes_abs = 4.88234e-4, probes_nrmse = 9.76467e-2 },
    { n = 400, probes_abs = 2.44817e-4, probes_nrmse = 4.89634e-2 },
    { n = 800, probes_abs = 1.23457e-4, probes_nrmse = 2.46915e-2 },
}

-- Errors at n = 800. The paper's updated-Lagrangian system has 1.23e-4 m; a total-Lagrangian one should have half of it.
gates = {
    { when = { scheme = "upwind" }, probes_abs = 6.17e-5 },
    { when = { scheme = "upwind", stencil = "sbp4", integrator = "rk4", cfl = 0.8 }, ["rate probes_abs"] = 0.8 },
    { when = { scheme = "ulsph" }, probes_abs = 1.23457e-4 },
    { when = { scheme = "ulsph", ["ulsph.tension"] = "control", integrator = "tvd-rk2", cfl = 0.5, n = 800 },
      probes_abs = 1.2e-5, ["rate probes_abs"] = 0.7 },
}

view = {
    field = "sigma_xx", range = {-2.2e8, 2.2e8}, bands = 11, -- Pa
    direction = {0, 0, 1}, up = {0, 1, 0}, magnify = 100, size = {1200, 400},
}
