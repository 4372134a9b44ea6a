-- A manufactured solution: the body is made to stretch from half to twice its length and back while it turns, by the body
-- force and the boundary data that this takes. Nothing is small, no symmetry helps, and the answer is known exactly.
-- `assay verify mms` runs it, and its siblings, for everything that claims an order; one of them in detail:
--   assay verify manufactured --set stencil=closed --set faces.X0=traction --set dim=3
title = "Manufactured motion"
source = "manufactured: oracles/motion.c"

parameters = { L = 1, period = 1, amplitude = 1 } -- m, s, -

dim = 2
domain = { lower = ({{0}, {0, 0}, {0, 0, 0}})[dim], upper = ({{L}, {L, L}, {L, L, L}})[dim] } -- m
levels = {12, 24}
n = 24

-- Waves of the material and the motion take about the same time, so that inertia and stress both count.
material = { model = "neo-hookean", E = 1, nu = 0.3, rho = 1 } -- Pa, -, kg/m^3

scheme = "upwind"
evolved, stencil, support, integrator, cfl = "pFHJ", "sbp4", 2, "rk4", 0.4
t_end = 0.4 * period

oracle = { name = "manufactured-stretch" }
initial = { from = "oracle" }
loads = { from = "oracle" }
-- On every face the position is prescribed; --set faces.X0=traction or roller prescribes the others.
faces = ({
    { X0 = "motion", X1 = "motion" },
    { X0 = "motion", X1 = "motion", Y0 = "motion", Y1 = "motion" },
    { X0 = "motion", X1 = "motion", Y0 = "motion", Y1 = "motion", Z0 = "motion", Z1 = "motion" },
})[dim]

-- What is asked of every combination stands in the suite; here what the default shows, and that others are not far off.
gates = {
    { p = 1e-2, P_all = 1e-2 },
    { when = { dim = 2, stencil = "sbp4", integrator = "rk4", evolved = "pFHJ", n = 24 },
      p = 4e-5, ["rate p"] = 2.8, P_all = 4e-4, ["rate P_all"] = 2.8, F_max = 2.6e-3, J = 4e-4, H = 4e-4 },
}

view = {
    field = "pressure", range = {0.06, 0.24}, bands = 9, -- Pa
    direction = dim == 3 and {1, 0.8, 0.6} or {0, 0, 1}, up = dim == 3 and {0, 0, 1} or {0, 1, 0},
    magnify = 1, size = {900, 900},
}
