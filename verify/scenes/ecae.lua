title = "Equal channel angular extrusion"
source = "004_0c0448173ed5e9bd.txt, 4.3"

parameters = { W = 8e-3, L = 56e-3, middle = 24e-3, outer = 1.5e-3, inner = 1e-3, V = 1, gap = 1.5e-3, scaling = 100 } -- m, m/s

dim = 2 -- plane strain
domain = { lower = {0, gap}, upper = {W, gap + L} } -- m
n = 3
levels = {3, 5, 7, 9}

material = {
    model = "hencky", E = 69e9, nu = 0.33, rho = 2800 * scaling, -- Pa, -, kg/m^3
    law = "power", yield_stress = 159e6 * 0.02 ^ 0.27, hardening_strain = 0.02, hardening_exponent = 0.27,
}
t_end = 40e-3 -- s

local far = W + middle -- where the second channel begins
die = {
    { path = { {0, gap + L + W}, {0, 0}, {far, 0}, {far, -L} }, fillets = { outer, inner } },
    { path = { {far + W, -L}, {far + W, W}, {W, W}, {W, gap + L + W} }, fillets = { outer, inner } },
}
initial = { velocity = function() return 0, -V end }
faces = { Y1 = { kind = "roller", value = function() return 0, -V end } }

scheme, evolved = "jst", "pFHJ"
jst = { kappa2 = 0, kappa4 = 1 / 64, kappa4_plastic = 1 / 4096, plastic_at = 0.5 }
stencil, support, integrator, cfl = "closed", 2.0, "tvd-rk2", 0.3
angular_momentum = "projected"
history = 2000

view = {
    field = "plastic_strain", range = {0, 2.4}, bands = 12, -- -
    direction = {0, 0, 1}, up = {0, 1, 0}, magnify = 1, size = {1000, 900},
}
