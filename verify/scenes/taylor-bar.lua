title = "Taylor bar"
source = "000_e9ec29e1bde7947d.txt, section 7.2.3, Table 2; 003_253cac78b077eaad.txt; 004_0c0448173ed5e9bd.txt, section 4.1"

parameters = { R = 3.2e-3, L = 32.4e-3, V0 = 227 } -- m, m, m/s

dim = 3
domain = { shape = "cylinder", centre = {0, 0, L / 2}, radius = R, length = L } -- m
n = 4
levels = {2, 3, 4}

material = { model = "hencky", E = 117e9, nu = 0.35, rho = 8930, yield_stress = 0.4e9, hardening = 0.1e9 } -- Pa, -, kg/m^3, Pa
t_end = 80e-6 -- s

initial = { velocity = function() return 0, 0, -V0 end }
rigid_wall = { point = {0, 0, 0}, normal = {0, 0, 1} }

scheme, evolved = "upwind", "pFJ"
stencil, support, integrator, cfl = "closed", 1.6, "tvd-rk2", 0.3

figures = {
    radius = { measure = "distance", from = "foot", to = "rim", expected = 7.0e-3 }, -- m
    ["radius y"] = { measure = "distance", from = "foot", to = "rim y", expected = 7.0e-3 }, -- m
    ["radius diagonal"] = { measure = "distance", from = "foot", to = "diagonal", expected = 7.0e-3 }, -- m
    length = { measure = "distance", from = "foot", to = "top", expected = 21.4e-3 }, -- m
    drift = { measure = "drift", probe = "top", across = {3} },
    ["energy lost"] = { measure = "energy lost" },
    ["energy rise"] = { measure = "energy rise" },
}
gates = { { ["figure radius"] = 1 } }

probes = { { name = "foot", X = {0, 0, 0} }, { name = "rim", X = {R, 0, 0} }, { name = "rim y", X = {0, R, 0} },
           { name = "diagonal", X = {R / math.sqrt(2), R / math.sqrt(2), 0} }, { name = "top", X = {0, 0, L} } }

view = {
    field = "plastic_strain", range = {0, 2.4}, bands = 12, -- -
    direction = {1, -0.8, 0.4}, up = {0, 0, 1}, magnify = 1, size = {700, 1200},
}
