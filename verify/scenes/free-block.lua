-- A free block is given a smooth motion, and left alone: what extremes are driven with. No dimension, length,
-- stiffness, density, place or attitude is special to it.
title = "Free block"
source = "of this program"

-- angle: the block is turned by it about the z axis from the start, rad; random: share of velocities without any order;
-- held: all faces are clamped; flight: velocity of the whole along all axes, over c; impact: the same against a wall; alternate: share of velocities that alternate from particle to particle; turn: angular velocity over c / length;
-- jump: stiffness and density of what lies beyond a plane that is slanted against the lattice, over those before it
parameters = { d = 2, length = 1, modulus = 1e7, density = 1e3, origin = 0, angle = 0, stretch = 1,
               speed = 1e-3, random = 0, alternate = 0, turn = 0, held = 0, flight = 0, impact = 0, thickness = 1, periods = 1, jump = 1 }

-- As many numbers as there are dimensions.
local function first(a, b, c)
    if d == 1 then return a elseif d == 2 then return a, b else return a, b, c end
end

dim = d
local thick = length * thickness
domain = { lower = {first(origin, origin, origin)}, upper = {first(origin + length, origin + thick, origin + thick)} } -- m
reference_length = length -- m
n = 4
levels = {4, 8}

local function slanted(X, Y, Z) -- a plane through the body, with steps along the lattice
    local y, z = d > 1 and Y - origin or 0, d > 2 and Z - origin or 0
    local times = X - origin - 0.3 * y - 0.1 * z < 0.35 * length and 1 or jump
    return modulus * times, 0.3, density * times
end
material = { model = "neo-hookean", E = modulus, nu = 0.3, rho = density, at = jump ~= 1 and slanted or nil } -- Pa, kg/m^3
local c = math.sqrt(modulus / density) -- m/s
t_end = periods * length / c -- s

scheme, evolved, stencil = "upwind", "pF", "sbp2"
integrator, cfl = "rk4", 0.45

local kinds = {}
for i, axis in ipairs { "X", "Y", "Z" } do
    if i <= d and held == 1 then kinds[axis .. "0"], kinds[axis .. "1"] = "clamped", "clamped" end
end
faces = kinds
if impact > 0 then rigid_wall = { point = {first(origin, origin, origin)}, normal = {first(1, 0, 0)} } end

local cos, sin = math.cos, math.sin
local function noise(X, Y, Z, k) -- in [-1, 1], without any order
    return 2 * ((sin(12.9898 * X + 78.233 * Y + 37.719 * Z + k) * 43758.5453) % 1) - 1
end
local function turned(x, y)
    return x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle)
end
local function motion(X, Y, Z)
    local x, y, z = (X - origin) / length, (Y - origin) / length, (Z - origin) / length
    local sign = (math.floor(n * x + 0.5) + math.floor(n * y + 0.5) + math.floor(n * z + 0.5)) % 2 == 0 and 1 or -1
    local smooth = 1 - random - alternate
    local u = smooth * cos(math.pi * x) * cos(2 * math.pi * y) + random * noise(x, y, z, 1) + alternate * sign
    local v = smooth * cos(2 * math.pi * x) * cos(math.pi * y) + random * noise(x, y, z, 2) + alternate * sign
    local w = smooth * cos(math.pi * z) * cos(math.pi * x) + random * noise(x, y, z, 3) + alternate * sign
    return c * (speed * u - turn * (y - 0.5) + flight - impact), c * (speed * v + turn * (x - 0.5) + flight),
           c * (speed * w + flight)
end

initial = {
    displacement = function(X, Y, Z)
        local x, y = stretch * (X - origin), Y - origin
        if d == 1 then return x - (X - origin) end
        local a, b = turned(x, y)
        return first(a - (X - origin), b - y, 0)
    end,
    velocity = function(X, Y, Z)
        if d == 1 then return (motion(X, origin, origin)) end
        local u, v, w = motion(X, Y, d == 2 and origin or Z)
        local a, b = turned(u, v)
        return first(a, b, w)
    end,
    F = function() -- row by row
        local r, q = cos(angle), sin(angle)
        if d == 1 then return stretch end
        if d == 2 then return r * stretch, -q, q * stretch, r end
        return r * stretch, -q, 0, q * stretch, r, 0, 0, 0, 1
    end,
}
history = 200

figures = { ["energy rise"] = { measure = "energy rise" } }
gates = { { ["figure energy rise"] = 1e-10, ["indicator linear momentum"] = 1e-12, ["indicator clumping"] = 0.9 } }

view = {
    field = "von_mises", range = {0, 5e3}, bands = 10, -- Pa
    direction = {0.3, -0.4, 1}, up = {0, 1, 0}, magnify = 100, size = {800, 700},
}
