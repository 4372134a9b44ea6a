-- The cross-section of a long incompressible tube, hit from within, swings in and out: an exact solution of finite strain
-- between two curved surfaces without traction.
title = "Oscillating tube"
source = "J. K. Knowles, Quart. Appl. Math. 18 (1960) 71"

parameters = { A = 1, B = 2, stretch = 1, velocity = 10, mu = 1e6 } -- m, m, -, m/s of the inner face, Pa

-- The whole of it: images in planes of symmetry have no pressure of their own.
dim = 2
domain = { shape = "solid", lower = {-1.25 * B, -1.25 * B}, upper = {1.25 * B, 1.25 * B}, -- m
    distance = function(X, Y)
        local R = math.sqrt(X * X + Y * Y)
        return math.max(A - R, R - B)
    end }
reference_length = B - A
n = 16
levels = {8, 16}

material = { model = "neo-hookean", E = 3 * mu, nu = 0.5, rho = 1000 } -- Pa, -, kg/m^3
incompressible = { solver = "poisson", tolerance = 1e-9 }
t_end = 0.15 -- s: a period and a ninth
snapshots = { 0.02 } -- s: on the way out

scheme, evolved, stencil, support = "upwind", "pFHJ", "closed", 2.2
integrator, cfl = "tvd-rk2", 0.3

initial = { from = "oracle" }
oracle = { name = "tube-oscillation" }

probes = { { name = "inner", X = {A, 0} }, { name = "outer", X = {B, 0} } }
figures = {
    period = { measure = "period", probe = "inner" },
    ["volume change"] = { measure = "volume change" },
    iterations = { measure = "iterations" },
}

-- From n = 8 to 16 the period is of order 1.45 and displacements of 2.1, but stresses do not converge: at particles of small
-- shares of the curved surfaces they scatter (P 0.11 and 0.18, checkerboard 0.18 and 0.28). More dissipation takes half of
-- that for more of the volumes: P 0.057, volume change 1.3e-2 with incompressible.dissipation = 0.1. Other amplitudes, the
-- inner radius over that in the reference (--set velocity): at 5 m/s, 0.89 to 1.11, period 1.8e-3, volume change 4.3e-4; at
-- 10 m/s, 0.79 to 1.22; at 20 m/s, 0.60 to 1.45, period 3.0e-3, volume change 2.4e-3.
gates = {
    { ["indicator linear momentum"] = 1e-11, ["indicator angular momentum"] = 1e-11, ["indicator energy gain"] = 1e-9 },
    { when = { ["material.nu"] = 0.5, ["incompressible.solver"] = "poisson", velocity = 10, stencil = "closed", n = 8 },
      ["figure period"] = 8.8e-3, p = 1.9e-2, P = 0.125, u = 3.9e-2, snapshots_p = 7.3e-3, snapshots_u = 5.2e-3,
      ["figure volume change"] = 3.3e-4, ["indicator linear momentum"] = 1e-11,
      ["indicator angular momentum"] = 1e-11, ["indicator energy gain"] = 1e-9 },
    { when = { ["material.nu"] = 0.5, ["incompressible.solver"] = "poisson", velocity = 10, stencil = "closed", n = 16 },
      ["figure period"] = 3.2e-3, ["rate figure period"] = 1.3, p = 2e-2, P = 0.2, P_l1 = 0.122, u = 8.9e-3,
      ["rate u"] = 1.9, snapshots_p = 5.5e-3, snapshots_u = 4.1e-3, ["figure volume change"] = 1.1e-3,
      ["indicator linear momentum"] = 1e-11, ["indicator angular momentum"] = 1e-11, ["indicator energy gain"] = 1e-9 },
}

view = {
    field = "pressure", range = {0, 3e5}, bands = 12, -- Pa
    direction = {0, 0, 1}, up = {0, 1, 0}, magnify = 1, size = {1000, 900},
}
