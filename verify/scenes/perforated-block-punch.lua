-- A quarter of a block with holes is struck from above between rollers: nearly incompressible, and nowhere to go but into
-- the holes and up beside the punch.
title = "Perforated block, punched"
source = "000_e9ec29e1bde7947d.txt, section 7.2.2"

parameters = { V = 250 } -- m/s

-- Figure 10 is not in the text. Here the block is 1 m x 1 m x 0.5 m with four upright holes of radius 0.125 m, a quarter of
-- an edge from either side; its sides and foot are on rollers, the holes are free, and the quarter X > 0, Y > 0 is struck.
local edge, height, radius = 1, 0.5, 0.125 -- m
dim = 3
domain = { shape = "solid", lower = {-edge / 2, -edge / 2, 0}, upper = {edge / 2, edge / 2, height}, -- m
    distance = function(X, Y)
        return radius - math.sqrt((math.abs(X) - edge / 4) ^ 2 + (math.abs(Y) - edge / 4) ^ 2)
    end }
reference_length = edge
n = 16
levels = {16}

material = { model = "neo-hookean", E = 17e6, nu = 0.499, rho = 1100 } -- Pa, -, kg/m^3
t_end = 2e-3 -- s

initial = { velocity = function(X, Y, Z) return 0, 0, X > 0 and Y > 0 and -V * Z / height or 0 end }
faces = { X0 = "symmetric", X1 = "symmetric", Y0 = "symmetric", Y1 = "symmetric", Z0 = "symmetric" }

scheme, evolved, stencil, support = "upwind", "pFHJ", "closed", 2.2
reconstruction = "least-squares"
integrator, cfl = "ssp-rk3", 0.3
history = 2000
probes = { { name = "punched", X = {edge / 4, 0, height} } }

-- Departure of the pressure from its neighbours' at n = 16: with {p,F,J} and {p,F,H,J} 0.108, with {p,F} 0.62; at n = 24 0.054
-- and 0.66.
gates = {
    { ["indicator checkerboard"] = 0.15, ["indicator clumping"] = 0.4, ["indicator energy gain"] = 1e-9 },
}

view = {
    field = "pressure", range = {-12e6, 6e6}, bands = 18, -- Pa
    direction = {0.7, -1, 1.1}, up = {0, 0, 1}, magnify = 1, size = {1000, 900},
}
