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
t_end = 16 -- s: nearly half a period of 32.6 s, after which the box has turned over

initial = { from = "oracle" }
oracle = { name = "free-top" }

-- The weights of sbp4 integrate moments of inertia exactly, those of sbp2 to second order.
scheme, evolved, stencil = "upwind", "pF", "sbp4"
angular_momentum = "projected"
integrator, cfl = "ssp-rk3", 0.6
history = 400 -- rows
probes = { { name = "corner", X = {A / 2, B / 2, C / 2} } }

-- What any free body keeps, beside what is asked of one configuration.
local function gate(when, bounds)
    bounds.when, bounds["indicator energy gain"] = when, 1e-9
    bounds["indicator linear momentum"], bounds["indicator angular momentum"] = 1e-12, 1e-12
    return bounds
end

-- The error of u is that of softness: 4.2e-2, 1.05e-2 and 3.8e-3 at 0.1, 0.05 and 0.03, of order 2.0. With sbp2 and a
-- softness of 0.02 it is 0.17, 3.4e-2 and 8.4e-3 at n = 2, 4 and 8. Outer halves lighter by a tenth have 3.3e-2, heavier by
-- a fifth 2.5e-2. Stresses are not held to anything: the oracle knows none.
gates = {
    gate(nil, {}),
    gate({ stencil = "sbp4", softness = 0.1, n = 8 }, { u = 4.4e-2, v = 0.127, probes = 3.6e-2 }),
    gate({ stencil = "sbp4", softness = 0.05, n = 8 }, { u = 1.1e-2, v = 3.2e-2, probes = 9e-3 }),
    gate({ stencil = "sbp4", softness = 0.03, n = 8 }, { u = 4e-3, v = 1.9e-2, probes = 3.3e-3 }),
    gate({ stencil = "sbp2", softness = 0.02, n = 4 }, { u = 3.6e-2, ["rate u"] = 1.9 }),
}

view = { -- where it is, since the exact one has no stress
    field = "displacement_x", range = {-2, 2}, bands = 16, -- m
    frame = {-1.1, 1.1, -1, 1, -0.9, 0.9}, -- m
    direction = {0.5, -0.6, 1}, up = {0, 0, 1}, magnify = 1, size = {1000, 900},
}
