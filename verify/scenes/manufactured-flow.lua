-- A manufactured solution of a body that flows plastically all over and all the time: drawn out ever further while it
-- turns, each particle along a direction of its own that stays. There the solution is in closed form (Hencky's theory of
-- total deformation) and the return map exact, so that what errs is discretisation alone.
title = "Manufactured plastic flow"
source = "manufactured: verify/manufactured_flow.c"

parameters = { L = 1, period = 1, amplitude = 1 } -- m, s, -

dim = 2
domain = { lower = ({{0}, {0, 0}, {0, 0, 0}})[dim], upper = ({{L}, {L, L}, {L, L, L}})[dim] } -- m
levels = {12, 24}
n = 24

material = { model = "hencky", E = 1, nu = 0.3, rho = 1, yield_stress = 0.02, hardening = 0.5 } -- Pa, -, kg/m^3, Pa

scheme = "upwind"
evolved, stencil, support, integrator, cfl = "pFHJ", "sbp4", 2, "rk4", 0.4
t_end = 0.4 * period

oracle = { name = "manufactured-drawn" }
initial = { from = "oracle" }
loads = { from = "oracle" }
faces = ({
    { X0 = "motion", X1 = "motion" },
    { X0 = "motion", X1 = "motion", Y0 = "motion", Y1 = "motion" },
    { X0 = "motion", X1 = "motion", Y0 = "motion", Y1 = "motion", Z0 = "motion", Z1 = "motion" },
})[dim]

-- What is asked of every combination stands in the suite. JST keeps second order (--set scheme=jst).
gates = {
    { p = 1e-2, P_all = 1e-2 },
    { when = { dim = 2, scheme = "upwind", stencil = "sbp4", integrator = "rk4", evolved = "pFHJ", n = 24 },
      p = 1.4e-6, ["rate p"] = 3, P_all = 1.6e-5, ["rate P_all"] = 3 },
}

view = {
    field = "plastic_strain", range = {0.15, 0.45}, bands = 12, -- -
    frame = { -0.6 * L, 1.7 * L, -0.2 * L, 1.2 * L, 0, dim == 3 and L or 0 }, -- m, as far as it is drawn
    direction = dim == 3 and {1, 0.8, 0.6} or {0, 0, 1}, up = dim == 3 and {0, 0, 1} or {0, 1, 0},
    magnify = 1, size = {900, 900},
}
