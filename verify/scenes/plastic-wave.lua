title = "Elastic precursor and plastic wave"
source = "Davison, Fundamentals of Shock Wave Propagation in Solids (2008); copper of 004_0c0448173ed5e9bd.txt, section 4.1"

parameters = { L = 2, v0 = 6e-3 } -- m, m/s

dim = 1
domain = { lower = {0}, upper = {L} } -- m
levels = {200, 400, 800}
n = 800

-- Copper, with a ten-thousandth of its yield stress and of the velocity of the face: the oracle is of small strains.
material = { model = "hencky", E = 117e9, nu = 0.35, rho = 8930, yield_stress = 0.4e5, hardening = 0.1e9 } -- Pa, -, kg/m^3, Pa, Pa

scheme = "upwind"
evolved, stencil, support, integrator, cfl = "pF", "sbp2", 2, "tvd-rk2", 0.4
t_end = 3e-4 -- s

oracle = { name = "plastic-wave" }
faces = { X0 = { kind = "motion", value = function() return v0 end } }

gates = { { P_l1 = 1e-1 } }
