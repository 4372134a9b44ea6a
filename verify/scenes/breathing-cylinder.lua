-- The cross-section of a long cylinder breathes in its first radial mode, plane strain: small strains, and nothing but a
-- curved surface without traction.
title = "Breathing cylinder"
source = "A. E. H. Love, A Treatise on the Mathematical Theory of Elasticity"

parameters = { R = 1, mode = 1, U0 = 5e-4 } -- m, -, m

-- Particles lie on concentric circles, the outermost being the surface, where each has its share of the circle as its
-- boundary area vector, along the exact normal: see breathing-sphere.lua.
dim = 2
domain = { shape = "disc", centre = {0, 0}, radius = R } -- m
n = 32
levels = {8, 16, 32}

material = { model = "linear-elastic", E = 17e6, nu = 0.3, rho = 1100 } -- Pa, -, kg/m^3
local cp = math.sqrt(material.E * (1 - material.nu) / (1 + material.nu) / (1 - 2 * material.nu) / material.rho) -- m/s
t_end = 6.3 * R / cp -- s: a little more than two periods, so that neither displacement nor velocity is near zero
snapshots = { 0.37 * R / cp } -- s: an eighth of a period
golden = { t_end = 1.2 * R / cp } -- s

scheme, evolved = "upwind", "pF"
stencil, support, integrator, cfl = "closed", 2.0, "rk4", 0.4

initial = { from = "oracle" }

oracle = { name = "breathing-cylinder" }
probes = { { name = "surface", X = {R, 0} }, { name = "corner", X = {0.7071 * R, 0.7071 * R} } }
figures = { period = { measure = "period", probe = "surface" } }

gates = { { p = 1, u = 1, snapshots_p = 1,  snapshots_u = 1, ["figure period"] = 1 } }

view = {
    field = "pressure", range = {-24e3, 24e3}, bands = 12, -- Pa
    direction = {0, 0, 1}, up = {0, 1, 0}, magnify = 100, size = {1000, 900},
}
