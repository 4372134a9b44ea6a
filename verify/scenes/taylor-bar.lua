-- A copper bar hits a rigid wall: its foot spreads into a mushroom, and plastic flow takes nearly all of its energy.
title = "Taylor bar"
source = "000_e9ec29e1bde7947d.txt, 7.2.3; 003_253cac78b077eaad.txt, Fig. 19; 004_0c0448173ed5e9bd.txt, 4.1"

parameters = { R = 3.2e-3, L = 32.4e-3, V0 = 227, quarter = 1 } -- m, m, m/s; 0: all of it, which moves as a quarter does

dim = 3
domain = {
    shape = "cylinder", centre = {0, 0, L / 2}, radius = R, length = L, -- m
    symmetry = quarter == 1 and { X = 0, Y = 0 } or nil, -- m
}
n = 3
levels = {2, 3} -- and 4, a minute of one core, or 6, five; layers lie up to 1.3 % off the spacing

material = {
    model = "hencky", E = 117e9, nu = 0.35, rho = 8930, -- Pa, -, kg/m^3
    yield_stress = 0.4e9, hardening = 0.1e9, -- Pa
}
t_end = 80e-6 -- s

initial = { velocity = function() return 0, 0, -V0 end }
rigid_wall = { point = {0, 0, 0}, normal = {0, 0, 1} } -- without friction

-- {p,F}, as in the paper, Table 2. Where J is evolved a particle on the axis at the foot is turned inside out at n = 3
-- and this CFL number; at 0.3 it is not.
scheme, evolved = "upwind", "pF"
stencil, support, integrator, cfl = "closed", 1.6, "tvd-rk2", 0.45
balance = true -- what dissipation and impacts take
history = 10000 -- rows: every step

probes = { { name = "foot", X = {0, 0, 0} }, { name = "rim", X = {R, 0, 0} }, { name = "rim y", X = {0, R, 0} },
           { name = "diagonal", X = {R / math.sqrt(2), R / math.sqrt(2), 0} }, { name = "top", X = {0, 0, L} } }

-- Printed in 000_e9ec29e1bde7947d.txt, Table 2, [mm]: 6.95 (hexahedra), 6.99 (average nodal pressure), 6.98 (JST), 7.00
-- (Petrov-Galerkin, and cell-centred upwind finite volumes), 6.89 (its Upwind-SPH, {p,F}), and 5.55 of linear tetrahedra,
-- which lock; 6.98 in 004 (JST-SPH), whose bar is 32 mm long, not 32.4. No length is printed as a number: what it is
-- compared with is ours at n = 4 (upwind). Since all radii fall short of what is printed, a bar that is too soft would come
-- nearer: "at n = 2" are those found before, held both ways.
local found = scheme == "jst" and { radius = 6.610e-3, length = 21.859e-3 } or { radius = 6.213e-3, length = 21.896e-3 }
figures = {
    radius = { measure = "distance", from = "foot", to = "rim", expected = 7.0e-3 }, -- m
    ["radius along y"] = { measure = "distance", from = "foot", to = "rim y", expected = 7.0e-3 }, -- m
    ["radius diagonally"] = { measure = "distance", from = "foot", to = "diagonal", expected = 7.0e-3 }, -- m
    length = { measure = "distance", from = "foot", to = "top", expected = 21.7e-3 }, -- m
    ["radius at n = 2"] = { measure = "distance", from = "foot", to = "rim", expected = found.radius }, -- m
    ["length at n = 2"] = { measure = "distance", from = "foot", to = "top", expected = found.length }, -- m
    ["drift of the top"] = { measure = "drift", probe = "top", across = {3} },
    ["drift of the foot"] = { measure = "drift", probe = "foot", across = {3} },
    ["energy lost"] = { measure = "energy lost" },
    ["energy rise"] = { measure = "energy rise" },
    ["energy balance"] = { measure = "energy balance" },
    ["numerical dissipation"] = { measure = "numerical dissipation" },
    ["impact loss"] = { measure = "impact loss" },
}

-- Radius and length [mm], and what of the energy dissipation and impacts take; at n = 2 a quarter and the whole agree to
-- all digits. kappa4 of JST; 004 sets it "to a very low value" that it does not print.
--      n   upwind              JST, 1/64           JST, 1/512          JST, 1/4096
--      2   6.213 21.896 9.2 %  6.610 21.859 6.9 %  6.806 21.827 4.4 %
--      3   6.415 21.739 8.0 %  6.745 21.628 5.6 %  7.031 21.533 3.1 %  7.131 21.497 2.1 %
--      4   6.602 21.712 6.8 %  6.944 21.620 4.2 %  7.149 21.528 1.9 %
--      5                        7.071 21.500 3.0 %
--      6                        7.171 21.571 2.3 %  7.332 21.517 0.3 %
-- The radius is a matter of the energy that is left for it, whoever took the rest, scheme or spacing: the straight line
-- 7.41 mm - 0.123 mm per % lost misses no row by more than 0.07 mm. The published radii, hexahedra's to Upwind-SPH's, are
-- those of a loss of 3.3 to 4.2 %. So none of these converges to them; they pass them. JST passes 6.98 mm, which 004 has
-- with 4131 particles, at 1/64 beyond n = 4 (3321 particles in all), at 1/512 before n = 3. Of other choices at n = 2 with
-- upwind, least-squares slopes give 6.04 mm, a support of two spacings 6.23 mm, {p,F,J} and {p,F,H,J} (cfl = 0.3) 6.26 mm,
-- shorter steps (cfl = 0.2) 6.21 mm.
-- Impacts take 2.7, 1.7 and 1.3 % at n = 2, 3 and 4 with upwind, mostly the first one, which stops half a layer of particles
-- at once: h/2L. The balance of all energies closes within 0.41, 0.21 and 0.14 %; the gap is that of the steps (n = 2 with
-- cfl = 0.2: 0.04 %). JST at n = 2: 0.8 %, with kappa4 = 1/512 1.3 %. The pressure of {p,F} alternates (checkerboard 0.45).
gates = {
    { ["figure drift of the top"] = 1e-12, ["figure drift of the foot"] = 1e-12, ["indicator linear momentum"] = 1e-12 },
    { when = { n = 2, evolved = "pF", scheme = "upwind" },
      ["figure radius"] = 0.114, ["figure radius along y"] = 0.114, ["figure radius diagonally"] = 0.114,
      ["figure radius at n = 2"] = 4e-3, ["figure length at n = 2"] = 4e-3,
      ["figure energy lost"] = 0.093, ["figure energy rise"] = 1e-12, ["figure energy balance"] = 4.3e-3,
      ["figure drift of the top"] = 1e-12, ["figure drift of the foot"] = 1e-12,
      ["indicator linear momentum"] = 1e-12, ["indicator clumping"] = 0.2 },
    { when = { n = 2, evolved = "pF", scheme = "jst", ["jst.kappa4"] = 1 / 64 },
      ["figure radius"] = 0.057, ["figure radius at n = 2"] = 4e-3, ["figure length at n = 2"] = 4e-3,
      ["figure energy lost"] = 0.07, ["figure energy rise"] = 1e-12,
      ["figure energy balance"] = 8.4e-3, ["indicator linear momentum"] = 1e-12, ["indicator clumping"] = 0.14 },
    { when = { n = 3, evolved = "pF", scheme = "upwind" },
      ["figure radius"] = 0.085, ["rate figure radius"] = 0.7, ["figure radius along y"] = 0.085,
      ["figure radius diagonally"] = 0.085, ["figure energy lost"] = 0.081, ["figure energy rise"] = 1e-12,
      ["figure energy balance"] = 2.3e-3, ["figure drift of the top"] = 1e-12, ["figure drift of the foot"] = 1e-12,
      ["indicator linear momentum"] = 1e-12, ["indicator clumping"] = 0.14 },
    { when = { n = 4, evolved = "pF", scheme = "upwind" },
      ["figure radius"] = 0.058, ["rate figure radius"] = 1.3, ["figure radius along y"] = 0.058,
      ["figure radius diagonally"] = 0.058, ["figure energy lost"] = 0.07, ["figure energy rise"] = 1e-12,
      ["figure energy balance"] = 1.6e-3, ["figure drift of the top"] = 1e-12, ["figure drift of the foot"] = 1e-12,
      ["indicator linear momentum"] = 1e-12, ["indicator clumping"] = 0.1 },
}

view = {
    field = "plastic_strain", range = {0, 1.6}, bands = 16, -- -
    frame = { quarter == 1 and 0 or -7e-3, 7e-3, quarter == 1 and 0 or -7e-3, 7e-3, 0, 30e-3 }, -- m
    direction = {1, -0.8, 0.25}, up = {0, 0, 1}, magnify = 1, size = {700, 900},
}
