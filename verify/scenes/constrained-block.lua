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

-- At n = 10, 20 and 40: 0.7023, 0.6822 and 0.6796 m, 85.23, 81.20 and 80.48 MJ; expected is what they extrapolate to. The
-- largest strain, beside the driven half's edge, has no limit. The run goes through at every n, and so with {p,F}, and
-- without dissipation; but particles at that edge are drawn past each other, cells between them turn over (2 of 200 at n =
-- 20), and the free surface beside it is jagged from particle to particle.
figures = {
    ["height of the free corner"] = { measure = "distance", from = "floor", to = "free corner", expected = 0.6792 }, -- m
    ["plastic work"] = { measure = "plastic work", expected = 80.32e6 }, -- J
}

gates = {
    { when = { n = 20, scheme = "jst", evolved = "pFHJ" },
      ["figure height of the free corner"] = 0.0055, ["rate figure height of the free corner"] = 2,
      ["figure plastic work"] = 0.013, ["rate figure plastic work"] = 2,
      ["indicator clumping"] = 0.28, ["indicator checkerboard"] = 0.16 },
    { when = { n = 40, scheme = "jst", evolved = "pFHJ" },
      ["figure height of the free corner"] = 0.002, ["figure plastic work"] = 0.004,
      ["rate figure plastic work"] = 1.5, ["indicator clumping"] = 0.14, ["indicator checkerboard"] = 0.08 },
}

view = {
    field = "plastic_strain", range = {0, 1.6}, bands = 16, -- -
    direction = {0, 0, 1}, up = {0, 1, 0}, magnify = 1, size = {1000, 700},
}
