title = "Constrained block"
source = "004_0c0448173ed5e9bd.txt, 4.2"

dim = 2 -- plane strain
domain = { lower = {0, 0}, upper = {1, 0.5} } -- m
n = 20

material = { model = "hencky", E = 117e9, nu = 0.35, rho = 8930, yield_stress = 0.4e9, hardening = 0.1e9 }
t_end = 15e-3 -- s

faces = {
    X0 = "symmetric", X1 = "symmetric", Y0 = "symmetric",
    Y1 = { kind = "motion", value = function() return 0, -10 end, within = { {0, 0.5}, {0.5, 0.5} } },
}

scheme, evolved = "jst", "pFHJ"
jst = { kappa2 = 0, kappa4 = 1 / 1024 }
stencil, support, integrator, cfl = "closed", 2.0, "tvd-rk2", 0.3
angular_momentum = "projected"

view = {
    field = "plastic_strain", range = {0, 1.6}, bands = 16, -- -
    direction = {0, 0, 1}, up = {0, 1, 0}, magnify = 1, size = {1000, 700},
}
