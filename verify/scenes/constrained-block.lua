-- A copper block between three frictionless walls, half of whose top is driven down: beside the driven half the material
-- is torn past itself, along a line that moves with it.
title = "Constrained block"
source = "004_0c0448173ed5e9bd.txt, 4.2"

dim = 2 -- plane strain
domain = { lower = {0, 0}, upper = {1, 0.5} } -- m
n = 20 -- 231 particles, as in the paper; its Fig. 8 has no numbers of others
levels = {10, 20, 40}

material = {
    model = "hencky", E = 117e9, nu = 0.35, rho = 8930, -- Pa, -, kg/m^3
    yield_stress = 0.4e9, hardening = 0.1e9, -- Pa
}
t_end = 15e-3 -- s

-- Where the 10 m/s act is shown in Fig. 6, which is not in the text. The elastic forerunner that it names has them on half
-- of the top: here the left one, its edge included; the right one is free.
faces = {
    X0 = "symmetric", X1 = "symmetric", Y0 = "symmetric",
    Y1 = { kind = "motion", value = function() return 0, -10 end, within = { {0, 0.5}, {0.5, 0.5} } },
}

scheme, evolved = "jst", "pFHJ" -- in the plane H is linear in F: {p,F,J} is the same to all digits
jst = { kappa2 = 0, kappa4 = 1 / 1024 }
stencil, support, integrator, cfl = "closed", 2.0, "tvd-rk2", 0.3
angular_momentum = "projected"

probes = { { name = "floor", X = {1, 0} }, { name = "free corner", X = {1, 0.5} } }

figures = {
    ["height of the free corner"] = { measure = "distance", from = "floor", to = "free corner", expected = 0.684 }, -- m
    ["plastic work"] = { measure = "plastic work", expected = 1e8 }, -- J
}

gates = {
    { ["figure plastic work"] = 0.3, ["indicator clumping"] = 0.05 },
}

view = {
    field = "plastic_strain", range = {0, 1.6}, bands = 16, -- -
    direction = {0, 0, 1}, up = {0, 1, 0}, magnify = 1, size = {1000, 700},
}
