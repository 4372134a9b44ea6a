-- The oracle is told what the scene does not say, and the body is to start from it: nobody knows from what.
title = "Bar that starts from what the oracle alone is told"
dim = 1
n = 20
domain = { lower = {0}, upper = {10} }
material = { model = "linear-elastic", E = 2e11, nu = 0, rho = 7850 }
oracle = { name = "cable", L = 10, moving = 2.5, U0 = 5 }
initial = { from = "oracle" }
scheme, stencil, evolved, integrator, cfl = "upwind", "sbp2", "pF", "tvd-rk2", 0.3
t_end = 1e-4
