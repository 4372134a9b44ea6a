-- A cube of copper is stretched uniaxially by a twentieth, far beyond its yield stress. Its particles are led by the exact
-- motion, so that nothing is left to err but the return map.
title = "Cube stretched beyond its yield stress"
source = "000_e9ec29e1bde7947d.txt, Algorithm 2; copper of 004_0c0448173ed5e9bd.txt, section 4.1"

parameters = { amplitude = 0.05, period = 1e-2, cycles = 1 } -- -, s, -

dim = 3
domain = { lower = {0, 0, 0}, upper = {1, 1, 1} } -- m
n = 6
levels = {3, 6}

material = { model = "hencky", E = 117e9, nu = 0.35, rho = 8930, yield_stress = 0.4e9, hardening = 0.1e9 } -- Pa, -, kg/m^3, Pa
t_end = 0.24 * period -- within the first quarter, after which the velocity is turned round at once

oracle = { name = "j2-hencky-uniaxial" }
initial = { from = "oracle" }
loads = { from = "oracle" }
faces = { X0 = "motion", X1 = "motion", Y0 = "motion", Y1 = "motion", Z0 = "motion", Z1 = "motion" }

scheme = "upwind"
evolved, stencil, integrator, cfl = "pFHJ", "sbp2", "rk4", 0.8

gates = { { p = 1e-10, P_all = 1e-12, F = 1e-12, J = 1e-12 } } -- round-off: velocities and strains are linear in X and t

view = {
    field = "plastic_strain", range = {0, 0.04}, bands = 12, -- -
    direction = {1, 0.8, 0.6}, up = {0, 0, 1}, magnify = 1, size = {600, 600},
}
