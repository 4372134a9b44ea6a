-- A ball breathes in its first radial mode: small strains, and nothing but a curved surface without traction.
title = "Breathing sphere"
source = "H. Lamb, Proc. London Math. Soc. 13 (1882) 189"

parameters = { R = 1, mode = 1, U0 = 5e-4 } -- m, -, m

-- Particles lie on concentric spheres, the outermost being the surface. Each of those on it has as its boundary area
-- vector its share of the sphere, the solid angle up to half-way lines between particles, along the exact normal: the
-- shares sum to 4 pi R^2 and, by the cloud's symmetry, the discrete divergence theorem holds for quadratic fields. A
-- constant stress so gives no force but its tractions, and linear fields are exact up to the surface.
dim = 3
domain = { shape = "ball", centre = {0, 0, 0}, radius = R } -- m
n = 12
levels = {4, 8, 12}

material = { model = "linear-elastic", E = 17e6, nu = 0.3, rho = 1100 } -- Pa, -, kg/m^3
local cp = math.sqrt(material.E * (1 - material.nu) / (1 + material.nu) / (1 - 2 * material.nu) / material.rho) -- m/s
t_end = 5.0 * R / cp -- s: a little more than two periods, so that neither displacement nor velocity is near zero
snapshots = { 0.294 * R / cp } -- s: an eighth of a period
golden = { t_end = R / cp } -- s

scheme, evolved = "upwind", "pF"
stencil, support, integrator, cfl = "closed", 1.6, "rk4", 0.4 -- shells have two thirds of a spacing between particles

initial = { from = "oracle" }

oracle = { name = "breathing-sphere" }
probes = { { name = "surface", X = {R, 0, 0} }, { name = "corner", X = {0.577 * R, 0.577 * R, 0.577 * R} } }
figures = { period = { measure = "period", probe = "surface" } }

gates = { { p = 1, P = 1, u = 1, snapshots_p = 1, snapshots_P = 1, snapshots_u = 1, ["figure period"] = 1 } }

view = {
    field = "displacement_x", range = {-5e-4, 5e-4}, bands = 10, -- m
    direction = {1, -0.8, 0.6}, up = {0, 0, 1}, magnify = 300, size = {1000, 900},
}
