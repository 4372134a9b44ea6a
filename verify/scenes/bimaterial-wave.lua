-- A pulse runs along an aluminium bar into a copper one: part of it is reflected, part goes on. Everything about it is
-- known: stress reflection +0.406, transmission 1.406.
title = "Wave in a bar of two materials"
source = "001_363f711843f01da4.txt, section 4.5" -- it prints t1 = 1e-5 s once; half a period is 1e-4 s

parameters = {
    E1 = 79.1e9, rho1 = 2785, L1 = 1, -- aluminium: Pa, kg/m^3, m
    E2 = 138.1e9, rho2 = 8930, L2 = 1, -- copper
    A1 = 5e-5, omega = math.pi * 1e4, t1 = 1e-4, -- m, rad/s, s
}

dim = 1
domain = { lower = {0}, upper = {L1 + L2} } -- m
n = 1664
levels = {416, 832, 1664} -- spacings of 4.8, 2.4 and 1.2 mm; even, so that a particle sits on the interface

-- The exact solution is that of rods: nu = 0, so that the modulus along the bar is E.
material = {
    model = "linear-elastic", E = E1, nu = 0, rho = rho1,
    at = function(X)
        if math.abs(X - L1) < 1e-9 then
            -- The particle on the interface stands for half a spacing of either material. Under one stress their
            -- strains add, so compliances are averaged, and so are densities. The lines of sbp4 end at it.
            return 2 * E1 * E2 / (E1 + E2), 0, (rho1 + rho2) / 2
        elseif X < L1 then
            return E1, 0, rho1
        end
        return E2, 0, rho2
    end,
}
t_end = 3.5e-4 -- s
snapshots = {1e-4, 1.5e-4, 2e-4, 2.5e-4, 3e-4, 3.5e-4} -- s, those of the source's Fig. 27 and 28

faces = {
    X0 = { kind = "motion", value = function(X, Y, Z, t) return A1 * omega * math.sin(omega * t) end, free_after = t1 },
    X1 = "free",
}

scheme = "upwind" -- or "ulsph", the paper's updated-Lagrangian system
if scheme == "ulsph" then
    support, integrator, cfl = 2.4, "tvd-rk2", 0.5
else
    evolved, stencil, integrator, cfl = "pF", "sbp4", "rk4", 0.8
end

oracle = { name = "bimaterial-wave" }
probes = { { name = "left end", X = {0} }, { name = "interface", X = {L1} }, { name = "right end", X = {L1 + L2} } }

-- The pulse is 0.53 m long and reaches the interface at 1.876e-4 s; at 3e-4 s it has left it, both ways.
local incident = {1.5e-4, 0, L1} -- s, m, m
figures = {
    reflection = { measure = "stress ratio", of = {3e-4, 0, L1}, over = incident },
    transmission = { measure = "stress ratio", of = {3e-4, L1, L1 + L2}, over = incident },
    -- A kink is smeared over a few spacings: 12.5 mm are five of 2.4 mm, and 2 % of the pulse.
    ["ahead of the front"] = { measure = "stress ahead", beyond = {0.0125} },
}

-- Relative L1 error of the stress at 1.2 mm, the largest over the snapshots, and its order from 2.4 mm; the same of the
-- coefficients; and the largest stress, over the peak, more than 12.5 mm ahead of the fronts.
gates = {
    { when = { scheme = "upwind", stencil = "sbp4", integrator = "rk4", cfl = 0.8 },
      snapshots_sigma_l1 = 5e-4, ["rate snapshots_sigma_l1"] = 1.4, ["figure ahead of the front"] = 2e-4,
      ["figure reflection"] = 5e-6, ["rate figure reflection"] = 1.7, ["figure transmission"] = 1e-6 },
    { when = { scheme = "upwind", stencil = "sbp2", integrator = "tvd-rk2", cfl = 0.3 },
      snapshots_sigma_l1 = 4e-3, ["rate snapshots_sigma_l1"] = 1.2, ["figure ahead of the front"] = 5e-3,
      ["figure reflection"] = 1e-4, ["figure transmission"] = 1e-4 },
    { when = { scheme = "ulsph", integrator = "tvd-rk2", cfl = 0.5 },
      snapshots_sigma_l1 = 6e-3, ["rate snapshots_sigma_l1"] = 1, ["figure ahead of the front"] = 4e-3,
      ["figure reflection"] = 1e-3, ["figure transmission"] = 1e-3 },
}

view = {
    field = "sigma_xx", range = {-33e6, 33e6}, bands = 11, -- Pa
    direction = {0, 0, 1}, up = {0, 1, 0}, magnify = 1000, size = {1200, 400},
}
