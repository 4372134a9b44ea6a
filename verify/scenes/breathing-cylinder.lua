-- The cross-section of a long cylinder breathes in its first radial mode, plane strain: small strains, and nothing but a
-- curved surface without traction.
title = "Breathing cylinder"
source = "A. E. H. Love, A Treatise on the Mathematical Theory of Elasticity"

parameters = { R = 1, mode = 1, U0 = 5e-4, cut = 0, quarter = 0 } -- m, -, m; cut = 1: a lattice cut by the surface;
-- quarter = 1: that much of it, with the same errors

-- Particles lie on concentric circles, the outermost being the surface, where each has its share of the circle as its
-- boundary area vector, along the exact normal: see breathing-sphere.lua. With --set cut=1 they lie on a lattice, those near
-- the surface moved onto it, and areas are those of a polygon: as accurate, and possible for any shape.
dim = 2
if cut == 0 then
    domain = { shape = "disc", centre = {0, 0}, radius = R, symmetry = quarter == 1 and { X = 0, Y = 0 } or nil } -- m
else -- as a body of any shape
    domain = { shape = "solid", lower = {-1.25 * R, -1.25 * R}, upper = {1.25 * R, 1.25 * R}, -- m
        distance = function(X, Y) return math.sqrt(X * X + Y * Y) - R end }
    reference_length = R
end
n = 32
levels = {8, 16, 32}

material = { model = "linear-elastic", E = 17e6, nu = 0.3, rho = 1100 } -- Pa, -, kg/m^3
local cp = math.sqrt(material.E * (1 - material.nu) / (1 + material.nu) / (1 - 2 * material.nu) / material.rho) -- m/s
t_end = 6.3 * R / cp -- s: two periods and an eighth, so that neither displacement nor velocity is near zero
snapshots = { 0.37 * R / cp } -- s: an eighth of a period
golden = { t_end = 1.2 * R / cp } -- s

scheme = "upwind" -- or "ulsph"
if scheme == "ulsph" then
    -- Nothing clumps at this amplitude, and the artificial stress at the surface, which control brings with it, makes it
    -- unstable.
    ulsph = { tension = "none" }
    support, integrator, cfl = 2.4, "tvd-rk2", 0.4
else
    evolved, stencil, support, integrator, cfl = "pF", "closed", cut == 0 and 2 or 2.2, "rk4", 0.4
    -- With {p,F} this body has not been seen to grow with slopes of the stencil. Least-squares ones, a solid's default: at
    -- n = 32 p 6.1e-3, P 6.3e-3, period 5.3e-4, as with these.
    if cut == 1 then reconstruction = "stencil" end
end

initial = { from = "oracle" }

oracle = { name = "breathing-cylinder" }
if cut == 0 and scheme ~= "ulsph" then trade = { quarter = { quarter = 1 } } end
probes = { { name = "surface", X = {cut == 0 and domain.radius or R, 0} } }
figures = { period = { measure = "period", probe = "surface" } }

-- Largest errors at n = 32 and smallest orders from n = 16. A stencil that does not close over the surface (--set
-- stencil=sph) is of first order in P. Last, half the radius at --levels 8,16, driven by the exact tractions or velocities on
-- its surface: --set domain.radius=0.5 --set loads.from=oracle --set faces.surface.kind=traction.
gates = {
    { when = { scheme = "upwind", ["loads.from"] = "formulas", cut = 0 },
      ["figure period"] = 5e-4, ["rate figure period"] = 1.9, p = 6.1e-3, ["rate p"] = 1.9, P = 7e-3, ["rate P"] = 1.8,
      u = 6.6e-3, ["rate u"] = 1.8, snapshots_p = 3.5e-4, ["rate snapshots_p"] = 1.9,
      snapshots_P = 1.15e-3, ["rate snapshots_P"] = 1.7, snapshots_u = 1.6e-4, ["rate snapshots_u"] = 1.9 },
    { when = { scheme = "upwind", ["loads.from"] = "formulas", cut = 1 },
      ["figure period"] = 5.5e-4, ["rate figure period"] = 1.8, p = 6.2e-3, ["rate p"] = 1.9, P = 6.8e-3, ["rate P"] = 1.8,
      u = 6.8e-3, ["rate u"] = 1.8, snapshots_p = 5.4e-4, ["rate snapshots_p"] = 1.8,
      snapshots_P = 1.3e-3, ["rate snapshots_P"] = 1.8, snapshots_u = 2.5e-4, ["rate snapshots_u"] = 1.7 },
    { when = { scheme = "ulsph", ["ulsph.tension"] = "none", integrator = "tvd-rk2" },
      ["figure period"] = 6.5e-4, ["rate figure period"] = 1.8, p = 7.7e-3, ["rate p"] = 1.9, u = 8.2e-3,
      ["rate u"] = 1.7 },
    { when = { scheme = "upwind", ["loads.from"] = "oracle" },
      p = 1.45e-3, ["rate p"] = 1.5, P = 1.35e-3, ["rate P"] = 1.5, ["rate snapshots_P"] = 1.8 },
}

view = {
    field = "pressure", range = {-24e3, 24e3}, bands = 12, -- Pa
    direction = {0, 0, 1}, up = {0, 1, 0}, magnify = 100, size = {1000, 900},
}
