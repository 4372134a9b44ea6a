-- A stiff box thrown with a spin about its middle axis turns over, and over again: Euler's top, whose inertia is the box's
-- own. An elastic box moves so but for strains of the size of softness squared.
title = "Tumbling box"
source = "L. D. Landau, E. M. Lifshitz, Mechanics, section 37"

parameters = {
    A = 2, B = 1.5, C = 1, -- m
    spin_x = 0.1, spin_y = 1, spin_z = 0.2, -- rad/s at first
    softness = 0.05, -- speed that the spin gives the ends of the longest side over that of waves in a bar
    lump = 1, -- density of the outer half along X over that of the inner; the oracle knows of none but 1
}

dim = 3
domain = { lower = {-A / 2, -B / 2, -C / 2}, upper = {A / 2, B / 2, C / 2} } -- m
reference_length = 1
n = 8
levels = {8}

local speed = spin_y * A / 2 / softness -- m/s
local E, nu, rho = 1000 * speed ^ 2, 0.3, 1000 -- Pa, -, kg/m^3
local function halves(X) return E, nu, math.abs(X) > A / 4 and lump * rho or rho end
material = { model = "neo-hookean", E = E, nu = nu, rho = rho, at = lump ~= 1 and halves or nil }
t_end = 16 -- s: the box has turned over once and a half

initial = { from = "oracle" }
oracle = { name = "free-top" }

-- The weights of sbp4 integrate moments of inertia exactly, those of sbp2 to second order.
scheme, evolved, stencil = "upwind", "pF", "sbp4"
angular_momentum = "projected"
integrator, cfl = "ssp-rk3", 0.45
history = 400 -- rows
probes = { { name = "corner", X = {A / 2, B / 2, C / 2} } }

gates = {
    { u = 1, v = 1, probes = 1, P_abs = 1e9, ["indicator linear momentum"] = 1e-12, ["indicator angular momentum"] = 1e-12, ["indicator energy gain"] = 1e-9 },
}

view = {
    field = "pressure", range = {-500, 500}, bands = 18, -- Pa
    frame = {-1.3, 1.3, -1.3, 1.3, -1.3, 1.3}, -- m
    direction = {0.5, -0.6, 1}, up = {0, 0, 1}, magnify = 1, size = {1000, 900},
}
