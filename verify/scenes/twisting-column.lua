-- A slender column, held at its foot, is set spinning about its axis and winds itself up: large strains of a body that
-- hardly yields in volume. Nothing pushes it aside, so its axis must stay where it is to round-off.
title = "Twisting column"
source = "000_e9ec29e1bde7947d.txt, section 7.3.1, Figures 20 to 24"

parameters = { Omega = 105, L = 6 } -- rad/s, m

-- The axis is X = Z = 0.5. The paper prints the point that it monitors, the middle of the top, with Y and Z exchanged.
dim = 3
domain = { lower = {0, 0, 0}, upper = {1, L, 1} } -- m
reference_length = 1
n = 8
levels = {4, 6, 8} -- 4 x 4 x 24, 6 x 6 x 36, 8 x 8 x 48 spacings; with --levels 5 no particle lies on the axis

faces = { Y0 = "clamped" }
initial = { velocity = function(X, Y, Z)
    local omega = Omega * math.sin(math.pi * Y / (2 * L))
    return omega * (Z - 0.5), 0, -omega * (X - 0.5)
end }

-- nu of Figure 23; the text and the other captions have 0.4995, and Figure 24 Omega = 200.
material = { model = "neo-hookean", E = 17e6, nu = 0.495, rho = 1100 } -- Pa, -, kg/m^3
t_end = 0.1 -- s

scheme, evolved, stencil = "upwind", "pFHJ", "sbp2"
angular_momentum = "projected"
-- As printed ("tvd-rk2", 0.3) the energy rises by 1.4e-6 of itself on the way, at n = 6.
integrator, cfl = "rk4", 0.45
history = 10000 -- rows: every step

probes = { { name = "axis", X = {0.5, L, 0.5} }, { name = "corner", X = {1, L, 1} } }
-- Turned by little it swings in torsion. Saint-Venant: T = 4 L sqrt(rho I / (mu J)), J = 0.14058 a^4, I = a^4/6.
figures = {
    ["period of torsion"] = Omega < 1 and { measure = "fundamental period", probe = "corner", expected = 0.36348 } or nil,
    ["the same at n = 4"] = Omega < 1 and { measure = "fundamental period", probe = "corner", expected = 0.3568 } or nil,
    drift = { measure = "drift", probe = "axis", across = {2} },
    ["energy rise"] = { measure = "energy rise" },
}
beside = { n = 6 } -- the same twist

-- There is no exact solution. The pressure of {p,F} alternates from particle to particle: its checkerboard is 0.27 at
-- n = 8, 0.37 with nu = 0.499, and that of the others 0.15 and 0.16; at n = 6, 0.46, 0.69, 0.25 and 0.27.
gates = {
    { ["figure drift"] = 1e-10, ["figure energy rise"] = 1e-12, ["indicator clumping"] = 0.6 },
    { when = { n = 6 },
      ["figure drift"] = 1e-10, ["figure energy rise"] = 1e-12, ["indicator clumping"] = 0.6,
      ["indicator checkerboard"] = 0.3 },
    { when = { n = 8 },
      ["figure drift"] = 1e-10, ["figure energy rise"] = 1e-12, ["indicator clumping"] = 0.6,
      ["indicator checkerboard"] = 0.2, beside = 0.02 },
    -- 1.8e-2 at n = 4, 4.5e-3 at n = 6, 2.0e-3 at n = 8
    Omega < 1 and { when = { n = 4, t_end = 0.56 },
                  ["figure period of torsion"] = 0.02, ["figure the same at n = 4"] = 0.005 } or nil,
    Omega < 1 and { when = { n = 6, t_end = 0.75 }, ["figure period of torsion"] = 6e-3 } or nil,
}

view = {
    field = "pressure", range = {-1.2e6, 3e6}, bands = 14, -- Pa
    direction = {1, 0.3, 0.8}, up = {0, 1, 0}, magnify = 1, size = {700, 1200},
}
