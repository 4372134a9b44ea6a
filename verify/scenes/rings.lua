-- Two elastic rings run into one another, press each other oval, and part. Momentum must be kept to round-off through
-- all of it; what the collision leaves of the energy is waves and what the scheme damps.
title = "Colliding rings"
source = "001_363f711843f01da4.txt, section 4.4" -- its diameters are radii: only so are there about as many particles

parameters = { inner = 0.03, outer = 0.04, U0 = 1, gap = 0.001 } -- m, m, m/s, m

dim = 2
local x = outer + gap / 2 -- m
bodies = {
    { shape = "ring", centre = {-x, 0}, inner = inner, outer = outer },
    { shape = "ring", centre = {x, 0}, inner = inner, outer = outer },
}
reference_length = outer - inner
lattice = "centres"
n = 10 -- a spacing of 1 mm, as in the paper
levels = {5, 10}

material = { model = "linear-elastic", E = 2e6, nu = 0.495, rho = 1000 } -- Pa, -, kg/m^3
t_end = 0.04 -- s
golden = { t_end = 0.002 } -- s: they have met

initial = { velocity = function(X) return X < 0 and U0 or -U0, 0 end } -- m/s

scheme = "ulsph"
support, integrator, cfl = 2.4, "tvd-rk2", 0.4
contact = { law = "predicted" }

-- Momentum to round-off, no energy out of nothing, and no checkerboard: without density diffusion (--set ulsph.delta=0)
-- there is one.
gates = {
    { ["indicator linear momentum"] = 1e-11, ["indicator energy gain"] = 1e-9, ["indicator clumping"] = 0.9,
      ["indicator checkerboard"] = 0.35 },
}

view = {
    field = "sigma_xx", range = {-6e4, 6e4}, bands = 12, -- Pa
    direction = {0, 0, 1}, up = {0, 1, 0}, magnify = 1, size = {1200, 700},
}
