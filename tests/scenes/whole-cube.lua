-- The swinging cube, or by symmetry the whole of which it is an eighth: the same error for eight times the cost.
title = "Swinging cube, an eighth or the whole"
source = "000_e9ec29e1bde7947d.txt, section 7.1.1"
parameters = { A = 1, B = 1, C = 1, U0 = 5e-4, whole = 0 } -- U0 in m

dim = 3
local low = whole == 1 and -1 or 0
domain = { lower = {low, low, low}, upper = {1, 1, 1} } -- m
reference_length = 1 -- m
n = 4
levels = {4, 6}
material = { model = "linear-elastic", E = 17e6, nu = 0.3, rho = 1100 } -- Pa, -, kg/m^3
t_end = 1e-3 -- s
scheme, evolved, stencil, integrator, cfl = "upwind", "pF", "sbp2", "tvd-rk2", 0.3

local at_low = whole == 1 and "skew-symmetric" or "symmetric"
faces = {
    X0 = at_low, X1 = "skew-symmetric", Y0 = at_low, Y1 = "skew-symmetric", Z0 = at_low, Z1 = "skew-symmetric",
}
initial = { from = "oracle" }
oracle = { name = "swinging-cube" }
trade = { ["whole cube"] = { whole = 1 } }
view = { field = "pressure", range = {0, 25e3} } -- Pa
