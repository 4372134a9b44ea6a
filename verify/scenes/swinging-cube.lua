-- A unit cube swings in its first mode. The exact solution is smooth and known in closed form, which makes this the
-- scene on which errors and orders of accuracy are measured.
title = "Swinging cube"
source = "000_e9ec29e1bde7947d.txt, section 7.1.1"

-- With A = B = C the mode travels with the p-wave, with A + B + C = 0 with the s-wave. Try --set A=2 --set B=-1.
parameters = { A = 1, B = 1, C = 1, U0 = 5e-4 } -- U0 in m

dim = 3
domain = { lower = {0, 0, 0}, upper = {1, 1, 1} } -- m
n = 24
levels = {8, 16, 24} -- the paper has 4 as well, too coarse for the boundary closure of sbp4

grading = { X = 1, Y = 1, Z = 1 } -- even; --set grading.X=10 --set grading.fine_X=upper

-- As in the text. The caption of Figure 5 has a neo-Hookean model; with that (--set material.model=neo-hookean) what is not
-- linear at these strains, 6.8e-4 of p and 8.0e-4 of P at n = 24, is more than the published errors.
material = { model = "linear-elastic", E = 17e6, nu = 0.3, rho = 1100 } -- Pa, -, kg/m^3
t_end = 0.002 -- s

scheme, evolved = "upwind", "pFHJ"
stencil, integrator, cfl = "sbp4", "rk4", 0.8

faces = {
    X0 = "symmetric", X1 = "skew-symmetric",
    Y0 = "symmetric", Y1 = "skew-symmetric",
    Z0 = "symmetric", Z1 = "skew-symmetric",
}

local k = math.pi / 2
local sin, cos = math.sin, math.cos

-- The cube is let go at rest from its largest deflection.
initial = {
    displacement = function(X, Y, Z)
        return U0 * A * sin(k * X) * cos(k * Y) * cos(k * Z),
               U0 * B * cos(k * X) * sin(k * Y) * cos(k * Z),
               U0 * C * cos(k * X) * cos(k * Y) * sin(k * Z)
    end,
    F = function(X, Y, Z) -- identity + gradient of the displacement, row by row
        local sx, cx, sy, cy, sz, cz = sin(k * X), cos(k * X), sin(k * Y), cos(k * Y), sin(k * Z), cos(k * Z)
        local a, b, c = k * U0 * A, k * U0 * B, k * U0 * C
        return 1 + a * cx * cy * cz,    -a * sx * sy * cz,    -a * sx * cy * sz,
                  -b * sx * sy * cz, 1 + b * cx * cy * cz,    -b * cx * sy * sz,
                  -c * sx * cy * sz,    -c * cx * sy * sz, 1 + c * cx * cy * cz
    end,
}

oracle = { name = "swinging-cube" }

-- Errors of p_x and P_xX; the paper does not define its norm, nor the constants of its JST.
published = scheme == "jst" and {
    source = "000_e9ec29e1bde7947d.txt, Table 1, {p,F,H,J} JST-SPH",
    { n = 4,  p = 6.635e-3, P = 9.976e-3 },
    { n = 8,  p = 1.986e-3, P = 4.156e-3 },
    { n = 16, p = 5.697e-4, P = 1.184e-3 },
    { n = 24, p = 2.510e-4, P = 5.248e-4 },
} or {
    source = "000_e9ec29e1bde7947d.txt, Table 1, {p,F,H,J} Upwind-SPH",
    { n = 4,  p = 2.490e-3, P = 4.422e-3 },
    { n = 8,  p = 8.123e-4, P = 2.269e-3 },
    { n = 16, p = 2.198e-4, P = 5.554e-4 },
    { n = 24, p = 9.342e-5, P = 2.513e-4 },
}

-- Where the largest spacing, at X1, is ten times the smallest, and 2.5 times the mean, by which n counts. From n = 24 to 48
-- the orders of p and P are 2.1 and 2.0 with sbp2, {p,F}, and 3.3 and 3.9 with sbp4.
local function graded(scheme, stencil, integrator, cfl)
    return { ["grading.X"] = 10, ["grading.Y"] = 1, ["grading.Z"] = 1, ["grading.fine_X"] = "lower",
             ["incompressible.solver"] = "none", scheme = scheme, ["jst.kappa4"] = 1 / 64, stencil = stencil,
             integrator = integrator, cfl = cfl }
end
local even = grading.X == 1 and grading.Y == 1 and grading.Z == 1
local graded_gates = {
    { when = graded("upwind", "sbp2", "tvd-rk2", 0.3), p = 1.7e-3, P = 4e-3, ["rate p"] = 1.6, ["rate P"] = 1.75 },
    { when = graded("upwind", "sbp4", "rk4", 0.8), p = 4.4e-4, P = 5.3e-4, ["rate p"] = 2.6, ["rate P"] = 3.6 },
    { when = graded("jst", "sbp2", "tvd-rk2", 0.3), p = 2.2e-3, P = 3.2e-3, ["rate p"] = 1.55, ["rate P"] = 1.9 },
    { when = graded("jst", "sbp4", "rk4", 0.8), p = 5e-4, P = 1.05e-3, ["rate p"] = 2.4, ["rate P"] = 2.5 },
    { p = 0.5, P = 0.5 },
}

-- Largest relative errors at n = 24 and smallest orders from 16 to 24 that each configuration must reach.
gates = not even and graded_gates or {
    -- The s-wave of an incompressible cube: --set A=1 --set B=-1 --set C=0 --set material.nu=0.5
    -- --set incompressible.solver=poisson --set incompressible.tolerance=1e-13, since strains are small.
    { when = { ["incompressible.solver"] = "poisson", stencil = "sbp4", integrator = "rk4", cfl = 0.8 },
      p = 2.1e-5, P = 5.4e-5, ["rate p"] = 3.0, ["rate P"] = 2.9 },
    { when = { ["incompressible.solver"] = "poisson", stencil = "sbp2", integrator = "tvd-rk2", cfl = 0.3 },
      p = 1.3e-3, P = 1.4e-2, ["rate p"] = 2.0, ["rate P"] = 1.2 },
    { when = { scheme = "upwind", stencil = "sbp4", integrator = "rk4", cfl = 0.8, evolved = "pFHJ",
               ["incompressible.solver"] = "none" },
      p = 2.6e-5, P = 7e-5, ["rate p"] = 3.0, ["rate P"] = 2.9 },
    { when = { scheme = "upwind", stencil = "sbp2", integrator = "tvd-rk2", cfl = 0.3, ["incompressible.solver"] = "none" },
      p = 6.5e-4, P = 1.1e-3, ["rate p"] = 1.9, ["rate P"] = 1.8 },
    { when = { scheme = "upwind", stencil = "closed", perturb = 0, integrator = "tvd-rk2", cfl = 0.3, evolved = "pFHJ" },
      p = 7.5e-4, P = 1.4e-3, ["rate p"] = 1.9, ["rate P"] = 1.8 },
    { when = { scheme = "upwind", stencil = "closed", perturb = 0.15 },
      ["rate p"] = 1.5, ["rate P"] = 1.3 },
    -- The natural boundary conditions of JST dissipation let sbp4 be of second order only (solver/jst.h).
    { when = { scheme = "jst", ["jst.kappa4"] = 1 / 64, stencil = "sbp4", integrator = "rk4", cfl = 0.8, evolved = "pFHJ" },
      p = 3.3e-4, P = 1.04e-3, ["rate p"] = 2.1, ["rate P"] = 1.6 },
    { when = { scheme = "jst", ["jst.kappa4"] = 1 / 64, stencil = "sbp2", integrator = "tvd-rk2", cfl = 0.3 },
      p = 8e-4, P = 1.02e-3, ["rate p"] = 1.8, ["rate P"] = 1.7 },
    { when = { scheme = "jst", ["jst.kappa4"] = 1 / 64, stencil = "closed", perturb = 0, integrator = "tvd-rk2", cfl = 0.3 },
      p = 8.3e-4, P = 1.03e-3, ["rate p"] = 1.8, ["rate P"] = 1.7 },
    -- Any other choice is measured and reported, and held only to not blowing up.
    { p = 0.5, P = 0.5 },
}

probes = {
    { name = "origin", X = {0, 0, 0} },  { name = "far corner", X = {1, 1, 1} },
    { name = "corner X", X = {1, 0, 0} }, { name = "corner Y", X = {0, 1, 0} }, { name = "corner Z", X = {0, 0, 1} },
}

-- Seen from the origin's side: on the three faces behind, the mean stress is zero.
view = {
    field = "pressure", range = {0, 25e3}, bands = 10, -- Pa
    direction = {-1, -0.8, -0.6}, up = {0, 0, 1},
    magnify = 300, size = {1200, 900},
}
