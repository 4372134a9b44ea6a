-- The face of a copper plate is moved at once, faster than the plate can follow elastically: an elastic precursor runs
-- ahead, a plastic wave behind it.
title = "Elastic precursor and plastic wave"
source = "Davison, Fundamentals of Shock Wave Propagation in Solids (2008); copper of 004_0c0448173ed5e9bd.txt, section 4.1"

parameters = { L = 2, v0 = 6e-3 } -- m, m/s

dim = 1
domain = { lower = {0}, upper = {L} } -- m
n = 800
levels = {200, 400, 800}

-- The oracle is of small strains: yield stress and velocity are a ten-thousandth of what they are in copper.
material = { model = "hencky", E = 117e9, nu = 0.35, rho = 8930, yield_stress = 0.4e5, hardening = 0.1e9 } -- Pa, -, kg/m^3, Pa
t_end = 3e-4 -- s

faces = { X0 = { kind = "motion", value = function() return v0 end }, X1 = "free" }

scheme = "upwind"
evolved, stencil, integrator, cfl = "pF", "sbp4", "rk4", 0.8

oracle = { name = "plastic-wave" }

-- Relative L1 errors at 2.5 mm and their order from 5 mm. Two jumps of a linear wave: a method of order q smears each over
-- h^(q/(q+1)), so that 2/3 is what second order can reach and 3/4 what third can.
gates = {
    { when = { stencil = "sbp4", integrator = "rk4", cfl = 0.8 },
      P_l1 = 5.6e-3, ["rate P_l1"] = 0.73, v_l1 = 5.2e-3, ["rate v_l1"] = 0.73 },
    { when = { stencil = "sbp2", integrator = "tvd-rk2", cfl = 0.3 },
      P_l1 = 1.35e-2, ["rate P_l1"] = 0.58, v_l1 = 1.25e-2, ["rate v_l1"] = 0.58 },
}

view = {
    field = "plastic_strain", range = {0, 7e-7}, bands = 12, -- -
    direction = {0, 0, 1}, up = {0, 1, 0}, magnify = 1e3, size = {1200, 300},
}
