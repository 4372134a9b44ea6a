-- Manufactured standing waves of small amplitude, with no symmetry: for schemes of linear elasticity, and for those whose law
-- is one of rates and agrees with it at small strain.
title = "Manufactured waves"
source = "manufactured: oracles/motion.c"

parameters = { L = 1, period = 1, amplitude = 1e-6 } -- m, s, -

dim = 2
domain = { lower = ({{0}, {0, 0}, {0, 0, 0}})[dim], upper = ({{L}, {L, L}, {L, L, L}})[dim] } -- m
levels = {12, 24}
n = 24

material = { model = "linear-elastic", E = 1, nu = 0.3, rho = 1 } -- Pa, -, kg/m^3

scheme = "upwind"
evolved, stencil, support, integrator, cfl = "pF", "sbp4", 2, "rk4", 0.4
t_end = 0.4 * period

oracle = { name = "manufactured-waves" }
initial = { from = "oracle" }
loads = { from = "oracle" }
faces = ({
    { X0 = "motion", X1 = "motion" },
    { X0 = "motion", X1 = "motion", Y0 = "motion", Y1 = "motion" },
    { X0 = "motion", X1 = "motion", Y0 = "motion", Y1 = "motion", Z0 = "motion", Z1 = "motion" },
})[dim]

gates = {
    { p = 1e-2, sigma_all = 1e-1 },
    { when = { scheme = "upwind", dim = 2, stencil = "sbp4", integrator = "rk4", n = 24 },
      p = 2.5e-4, ["rate p"] = 2.8, sigma_all = 1.8e-3, ["rate sigma_all"] = 2.8 },
}

view = {
    field = "sigma_xx", range = {-9e-7, 9e-7}, bands = 9, -- Pa
    direction = dim == 3 and {1, 0.8, 0.6} or {0, 0, 1}, up = dim == 3 and {0, 0, 1} or {0, 1, 0},
    magnify = 1e5, size = {900, 900},
}
