-- Gates for levels that take a second, in place of those of verify/scenes/swinging-cube.lua; tests/scenes.cmake puts
-- the two together. Each bound is what the correct program gives and 5 % more; an order, 0.1 less.
-- Measure anew: assay verify BUILD/scenes/swinging-cube-quick.lua --levels 8,16 --set ... prints value and bound.
gates = {
    -- measured 7.394e-05, 6.338e-05, 3.92, 4.75 with --levels 8,16
    { when = { stencil = "sbp4", integrator = "rk4", cfl = 0.8, t_end = 0.002 },
      p = 7.77e-5, P = 6.66e-5, ["rate p"] = 3.82, ["rate P"] = 4.65 },
    -- measured 1.366e-03, 2.088e-03, 1.81, 2.09
    { when = { stencil = "sbp2", integrator = "tvd-rk2", cfl = 0.3, evolved = "pF" },
      p = 1.44e-3, P = 2.20e-3, ["rate p"] = 1.71, ["rate P"] = 1.99 },
    -- measured 1.441e-03, 2.295e-03, 1.90, 2.14
    { when = { stencil = "sbp2", integrator = "tvd-rk2", cfl = 0.3, evolved = "pFHJ" },
      p = 1.52e-3, P = 2.41e-3, ["rate p"] = 1.80, ["rate P"] = 2.04 },
    -- measured 5.059e-02, 1.163e-01
    { when = { stencil = "sph", integrator = "tvd-rk2", cfl = 0.3 },
      p = 5.32e-2, P = 1.23e-1 },
    -- three periods, at n = 16 alone: measured 1.722e-03, 2.525e-03
    { when = { scheme = "jst", stencil = "sbp4", t_end = 0.05 },
      p = 1.81e-3, P = 2.65e-3 },
    -- nine times as long, at n = 24 alone: measured 5.339e-05, 3.702e-05
    { when = { stencil = "sbp4", t_end = 0.018 },
      p = 5.61e-5, P = 3.89e-5 },
}
