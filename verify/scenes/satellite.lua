-- A satellite without anything that acts on it: a truncated cone with four arms spins about its axis, and the arms swing
-- out. Nothing may change its momenta.
title = "Satellite-like structure"
source = "000_e9ec29e1bde7947d.txt, section 7.1.2"

parameters = { Omega = 1 } -- rad/s

-- Figure 6 is not in the text: where along the axis the arms are is not printed. Here they leave the cone half way up.
local base, top, height, reach, width = 4, 2, 3, 6.5, 1 -- m
local slant = math.sqrt(height ^ 2 + (base - top) ^ 2)

-- Of a box; less than 0 within.
local function box(X, Y, Z, a, b, c)
    return math.max(math.abs(X) - a, math.abs(Y) - b, math.abs(Z) - c)
end

dim = 3
domain = { shape = "solid", lower = {-7, -7, 0}, upper = {7, 7, height}, -- m; the box's Z0 and Z1 are the cone's ends
    distance = function(X, Y, Z)
        local cone = (math.sqrt(X * X + Y * Y) - base + (base - top) * Z / height) * height / slant
        local along_x = box(X, Y, Z - height / 2, reach, width / 2, width / 2)
        local along_y = box(X, Y, Z - height / 2, width / 2, reach, width / 2)
        return math.min(cone, along_x, along_y)
    end }
reference_length = 1
n = 2
levels = {2}

material = { model = "neo-hookean", E = 50.046e3, nu = 0.3, rho = 1000 } -- Pa, -, kg/m^3
t_end = 10 -- s, a turn and a half

-- About the axis, on which the centre of mass lies.
initial = { velocity = function(X, Y, Z) return -Omega * Y, Omega * X, 0 end }

scheme, evolved, stencil, support = "upwind", "pF", "closed", 2.2
angular_momentum = "projected"
reconstruction = "least-squares" -- slopes by the stencil turn particles at the rim inside out
integrator, cfl = "ssp-rk3", 0.2 -- particles at the rim have little volume and are stiff: at 0.4 they gain energy
history = 10000 -- rows: every step
probes = { { name = "arm", X = {reach, 0, height / 2} } }

-- The momenta stay within 1.2e-15 and 5.8e-15 at n = 2 over 1278 steps, 2.8e-15 and 6.6e-15 at n = 4. With --set
-- angular_momentum=free the angular momentum drifts by 1.2e-3 at n = 2.
gates = {
    { ["indicator linear momentum"] = 1e-12, ["indicator angular momentum"] = 1e-12, ["indicator energy gain"] = 1e-6,
      ["indicator checkerboard"] = 0.2, ["indicator clumping"] = 0.5 },
}

view = {
    field = "pressure", range = {-2e3, 10e3}, bands = 12, -- Pa
    frame = {-6.6, 6.6, -6.6, 6.6, 0, 3}, -- m
    direction = {0.5, -0.9, 0.9}, up = {0, 0, 1}, magnify = 1, size = {1100, 900},
}
