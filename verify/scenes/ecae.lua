-- A billet of aluminium is pushed round two corners: each shears it by 2, and its section stays what it was.
title = "Equal channel angular extrusion"
source = "004_0c0448173ed5e9bd.txt, 4.3"

-- Not printed, and how they are inferred: 88, 216, 400 and 640 particles on a width of 8 mm are 4 x 22, 6 x 36, 8 x 50 and
-- 10 x 64, all of them 56 mm long. Cut from 24 to 16 mm, the middle channel is shown at 0.027 s in place of 0.035 s: 8 mm
-- in 8 ms. At 1 m/s contact after 0.00142 s is a gap of the outer fillet's radius, on which the billet then stands, and
-- 0.035 s is when the second corner is filled and passed if 24 mm are what lies between the two vertical channels. Were
-- they from axis to axis (--set middle=16e-3 --set t_end=40e-3) it would be passed at 27 ms; with 216 particles the strain
-- energy then has a peak at 32.5 ms, and section 2 is 2.2 on its inner side. The text does not decide it. Channels are as
-- wide as the billet, the third goes down. `scaling` multiplies the density, and so the step by its square root: the
-- kinetic energy is 2 % of the plastic work at the first turn, 0.3 to 0.5 % at the end. It is not without effect: of 88
-- particles the plastic work is 8 % lower at 15 ms with scaling = 1, of 216 2 % lower with 100.
parameters = { W = 8e-3, L = 56e-3, middle = 24e-3, outer = 1.5e-3, inner = 1e-3, V = 1, scaling = 400 } -- m, m/s

dim = 2 -- plane strain
domain = { lower = {0, outer}, upper = {W, outer + L} } -- m
n = 3
levels = {3, 5, 7}

material = {
    model = "hencky", E = 69e9, nu = 0.33, rho = 2800 * scaling, -- Pa, -, kg/m^3
    law = "power", yield_stress = 159e6 * 0.02 ^ 0.27, hardening_strain = 0.02, hardening_exponent = 0.27, -- eq. 4.3
}
t_end = middle < 20e-3 and 27e-3 or 40e-3 -- s

-- --set middle=16e-3 is the short die of Fig. 16. That the upper part of its second corner stays unfilled is not found.

local far, top = W + middle, outer + L + W -- where the third channel begins, and the first one ends
die = {
    { path = { {0, top}, {0, 0}, {far, 0}, {far, -L} }, fillets = { outer, inner } },
    { path = { {far + W, -L}, {far + W, W}, {W, W}, {W, top} }, fillets = { outer, inner } },
}
initial = { velocity = function() return 0, -V end }
faces = { Y1 = { kind = "roller", value = function() return 0, -V end } } -- the ram

-- With a support of 2 spacings particles beside the inner corners change places, and of 88 those at the second one get
-- entangled (plastic strain 7.6, scaling = 900).
scheme, evolved = "jst", "pFHJ"
if scheme == "jst" then jst = { kappa2 = 0, kappa4 = 1 / 64, kappa4_plastic = 1 / 4096, plastic_at = 0.5 } end -- eq. 4.2
stencil, support, integrator, cfl = "closed", 3.0, "tvd-rk2", 0.3
history = 1000

-- At n = 3, 5, 7 and 9: plastic work 69.8, 56.8, 53.0, 51.7 kJ, largest strain 2.96, 2.35, 2.24, 2.42 (at 35 ms 51.5, 41.7,
-- 38.4, 37.4 kJ; 2.09, 1.71, 1.86, 1.54), ram loss 5.6, 3.5, 2.0, 2.6 %. The work converges, the largest strain does not:
-- it is that of single particles at the inner corners, where at n = 9 cells turn over (42 of 567 at the end, none of 343 at
-- n = 7). What is expected is of n = 9, so that orders up to n = 7 come out too high. For a look that takes
-- seconds, n = 3 at 10 ms, it is what was found there, so that what is too soft is noticed as what is too hard is; n = 9 has
-- 1.232 and 9.086 kJ.
local strain, work = 2.417, 51707
if t_end < 11e-3 then strain, work = 1.422, 10864 end

-- Section 1 is in the middle of the middle channel, section 2 is 5 mm below the second corner, where the billet's head has
-- just come to. Means over ten places at n = 3, 5, 7 and 9: 1.32, 1.14, 1.03, 1.00 and 1.59, 0.83, 0.70, 0.66. A corner of
-- 90 degrees without fillets has 2 / sqrt(3) = 1.155. At n = 9 from the bottom up 0.68, 0.61, 1.00, 1.10, 1.08, 1.12, 1.09,
-- 1.08, 1.07, 1.20, from the left 1.12, 0.93, 0.79, 0.75, 0.68, 0.60, 0.48, 0.39, 0.40, 0.42; n = 7 is within 0.18.
figures = {
    ["strain in section 1"] = { measure = "plastic strain", expected = 1.00,
                                from = {W + middle / 2, 0}, to = {W + middle / 2, W} },
    ["strain in section 2"] = { measure = "plastic strain", expected = 0.66, from = {far, -5e-3}, to = {far + W, -5e-3} },
    ["largest strain"] = { measure = "largest plastic strain", expected = strain },
    ["plastic work"] = { measure = "plastic work", expected = work }, -- J
    ["ram loss"] = { measure = "ram loss", along = {2}, speed = -V },
}

gates = {
    { when = { n = 3, t_end = 0.01, scheme = "jst", evolved = "pFHJ", support = 3 },
      ["figure plastic work"] = 0.02, ["figure largest strain"] = 0.05, ["figure ram loss"] = 0.06,
      ["indicator clumping"] = 0.35 },
    { when = { n = 5, middle = 16e-3, t_end = 27e-3, scheme = "jst", evolved = "pFHJ", support = 3 },
      ["figure ram loss"] = 0.04, ["indicator clumping"] = 0.25, ["indicator checkerboard"] = 0.2 },
    { when = { n = 7, middle = 24e-3, t_end = 0.04, scheme = "jst", evolved = "pFHJ", support = 3 },
      ["figure plastic work"] = 0.03, ["rate figure plastic work"] = 3, ["figure largest strain"] = 0.09,
      ["figure strain in section 1"] = 0.04, ["rate figure strain in section 1"] = 3,
      ["figure strain in section 2"] = 0.08, ["rate figure strain in section 2"] = 3, ["figure ram loss"] = 0.023,
      ["indicator clumping"] = 0.09, ["indicator checkerboard"] = 0.33 },
}

view = {
    field = "plastic_strain", range = {0, 2.4}, bands = 12, -- -
    frame = {0, far + W, -10e-3, outer + L - V * t_end + 4e-3, 0, 0}, -- m; down from the ram
    direction = {0, 0, 1}, up = {0, 1, 0}, magnify = 1, size = {1000, 900},
}
