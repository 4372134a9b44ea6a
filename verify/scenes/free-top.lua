-- A stiff box thrown with a spin about its middle axis turns over, and over again: Euler's top.
title = "Tumbling box"
source = "L. D. Landau, E. M. Lifshitz, Mechanics, section 37"

parameters = { A = 3, B = 2, C = 1, spin_x = 0.1, spin_y = 1, spin_z = 0.2, softness = 0.02 } -- m, rad/s, -

dim = 3
domain = { lower = {-A / 2, -B / 2, -C / 2}, upper = {A / 2, B / 2, C / 2} } -- m
reference_length = 1
n = 4
levels = {2, 4}

-- Softness: the speed of the longest side's ends over that of waves in a bar.
material = { model = "neo-hookean", E = 1000 * (spin_y * A / 2 / softness) ^ 2, nu = 0.3, rho = 1000 } -- Pa, -, kg/m^3
t_end = 20 -- s

initial = { from = "oracle" }
oracle = { name = "free-top" }

scheme, evolved, stencil = "upwind", "pF", "sbp2"
angular_momentum = "projected"
integrator, cfl = "ssp-rk3", 0.45

gates = {
    { ["indicator linear momentum"] = 1e-12, ["indicator angular momentum"] = 1e-12 },
}

view = {
    field = "pressure", range = {-500, 500}, bands = 18,
    frame = {-2, 2, -2, 2, -2, 2}, -- m
    direction = {0.5, -0.6, 1}, up = {0, 0, 1}, magnify = 1, size = {1000, 900},
}
