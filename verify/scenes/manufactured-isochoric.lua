-- A manufactured motion that keeps every volume, of a body that hardly yields in volume: what a scheme adds to or takes
-- from volumes is turned into pressure, 5000 times as stiff as shear.
title = "Manufactured motion, volumes kept"
source = "manufactured: oracles/motion.c"

parameters = { L = 1, period = 1, amplitude = 0.1 } -- m, s, -

dim = 2
domain = { lower = ({{0}, {0, 0}, {0, 0, 0}})[dim], upper = ({{L}, {L, L}, {L, L, L}})[dim] } -- m
levels = {12, 24}
n = 24

material = { model = "neo-hookean", E = 1, nu = 0.4999, rho = 1 } -- Pa, -, kg/m^3

scheme = "upwind"
evolved, stencil, support, integrator, cfl = "pFHJ", "sbp4", 2, "rk4", 0.4
t_end = 0.1 * period

oracle = { name = "manufactured-isochoric" }
initial = { from = "oracle" }
loads = { from = "oracle" }
faces = ({
    { X0 = "motion", X1 = "motion" },
    { X0 = "motion", X1 = "motion", Y0 = "motion", Y1 = "motion" },
    { X0 = "motion", X1 = "motion", Y0 = "motion", Y1 = "motion", Z0 = "motion", Z1 = "motion" },
})[dim]

gates = {
    { p = 1e-2, P_all = 1 },
    { when = { dim = 2, stencil = "sbp4", integrator = "rk4", evolved = "pFHJ", n = 24,
      ["material.nu"] = 0.4999 }, -- whatever the faces prescribe
      p = 3.3e-4, ["rate p"] = 2.7, P_all = 6.6e-3, ["rate P_all"] = 2.6 },
    -- --set material.nu=0.5 --set incompressible.solver=poisson: 1.11e-4, 2.6; 8.8e-2, 3.6
    { when = { ["material.nu"] = 0.5, dim = 2, stencil = "sbp4", integrator = "rk4", n = 24 },
      p = 1.3e-4, ["rate p"] = 2.4, P_all = 9.7e-2, ["rate P_all"] = 2.4 },
}

view = {
    field = "von_mises", range = {0, 0.32}, bands = 8, -- Pa
    direction = dim == 3 and {1, 0.8, 0.6} or {0, 0, 1}, up = dim == 3 and {0, 0, 1} or {0, 1, 0},
    magnify = 1, size = {900, 900},
}
