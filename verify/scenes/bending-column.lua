-- A slender column, held at its foot, is set leaning: it bends over by more than its own width and swings back.
title = "Bending column"
source = "003_253cac78b077eaad.txt, section 6.1"

parameters = { V0 = 10, L = 6 } -- m/s, m

dim = 3
domain = { lower = {0, 0, 0}, upper = {1, L, 1} } -- m
reference_length = 1
n = 8
levels = {4, 8}

faces = { Y0 = "clamped" }
initial = { velocity = function(X, Y) return V0 * Y / L, 0, 0 end }

material = { model = "neo-hookean", E = 17e6, nu = 0.45, rho = 1100 } -- Pa, -, kg/m^3
t_end = 0.5 -- s

scheme, evolved, stencil = "upwind", "pFHJ", "sbp2"
integrator, cfl = "tvd-rk2", 0.3

probes = { { name = "tip", X = {0.5, L, 0.5} } }
figures = { drift = { measure = "drift", probe = "tip", across = {1} } }
beside = { n = 6 }

gates = {
    { ["indicator energy gain"] = 1e-9, ["indicator checkerboard"] = 0.2, beside = 0.1 },
}

view = {
    field = "pressure", range = {-2e6, 2e6}, bands = 20, -- Pa
    direction = {0.5, 0.3, 1}, up = {0, 1, 0}, magnify = 1, size = {1000, 1200},
}
