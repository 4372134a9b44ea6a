-- A ball breathes in its first radial mode: small strains, and nothing but a curved surface without traction.
title = "Breathing sphere"
source = "H. Lamb, Proc. London Math. Soc. 13 (1882) 189"

parameters = { R = 1, mode = 1, U0 = 5e-4, cut = 0, eighth = 0 } -- m, -, m; cut = 1: a lattice cut by the surface;
-- eighth = 1: that much of it, with the same errors

-- Particles lie on concentric spheres, the outermost being the surface. The boundary area vector of each of those on it is
-- its share of the sphere, the exact solid angle up to half-way lines between particles, along the exact normal. The
-- shares sum to 4 pi R^2 and the cloud is as symmetric as a cube, so the discrete divergence theorem holds for quadratic
-- fields: a constant stress gives no force but its tractions, and linear fields are exact up to the surface.
dim = 3
if cut == 0 then
    domain = { shape = "ball", centre = {0, 0, 0}, radius = R, symmetry = eighth == 1 and { X = 0, Y = 0, Z = 0 } or nil } -- m
else -- as a body of any shape
    local edge = 1.25 * R
    domain = { shape = "solid", lower = {-edge, -edge, -edge}, upper = {edge, edge, edge}, -- m
        distance = function(X, Y, Z) return math.sqrt(X * X + Y * Y + Z * Z) - R end }
    reference_length = R
end
n = 12
levels = {4, 8, 12}

material = { model = "linear-elastic", E = 17e6, nu = 0.3, rho = 1100 } -- Pa, -, kg/m^3
local cp = math.sqrt(material.E * (1 - material.nu) / (1 + material.nu) / (1 - 2 * material.nu) / material.rho) -- m/s
t_end = 5 * R / cp -- s: two periods and an eighth, so that neither displacement nor velocity is near zero
snapshots = { 0.294 * R / cp } -- s: an eighth of a period
golden = { t_end = R / cp } -- s

scheme, evolved = "upwind", "pF"
-- On a sphere particles are pi/4 of a spacing apart, near the corners of the bent cube less. RK4 is stable at cfl = 0.6;
-- at 0.2 the period is the same to five digits.
stencil, support, integrator, cfl = "closed", cut == 0 and 1.6 or 2.2, "rk4", 0.4
-- With {p,F} this body has not been seen to grow with slopes of the stencil. Least-squares ones, a solid's default: at n = 8
-- p 0.182, P 8.2e-2, period 1.08e-2; with these 0.170, 0.101, 1.07e-2.
if cut == 1 then reconstruction = "stencil" end

initial = { from = "oracle" }

oracle = { name = "breathing-sphere" }
if cut == 0 then trade = { eighth = { eighth = 1 } } end
probes = { { name = "surface", X = {cut == 0 and domain.radius or R, 0, 0} } }
figures = { period = { measure = "period", probe = "surface" } }

-- Largest errors at n = 12 and smallest orders from n = 8. After two periods P and u err by a lag of the phase, of second
-- order, less what damping, of third order, has taken: their difference converges unevenly, their sum in p does not.
gates = {
    { when = { scheme = "upwind", cut = 0 },
      ["figure period"] = 5e-3, ["rate figure period"] = 1.8, p = 0.065, ["rate p"] = 1.9, P = 0.051, ["rate P"] = 1.4,
      u = 0.049, ["rate u"] = 1.4, snapshots_p = 5.3e-3, ["rate snapshots_p"] = 1.2, snapshots_P = 0.0104,
      ["rate snapshots_P"] = 2, snapshots_u = 1.5e-3, ["rate snapshots_u"] = 1.7 },
    { when = { scheme = "upwind", cut = 1 },
      ["figure period"] = 5.1e-3, ["rate figure period"] = 1.8, p = 0.075, ["rate p"] = 1.9, P = 0.057, ["rate P"] = 1.4,
      u = 0.055, ["rate u"] = 1.4, snapshots_p = 5.8e-3, ["rate snapshots_p"] = 1.7, snapshots_P = 9.4e-3,
      ["rate snapshots_P"] = 2, snapshots_u = 2.3e-3, ["rate snapshots_u"] = 1.8 },
}

view = {
    field = "displacement_x", range = {-5e-4, 5e-4}, bands = 10, -- m
    direction = {1, -0.8, 0.6}, up = {0, 0, 1}, magnify = 300, size = {1000, 900},
}
