# What accuracy costs: whole studies of runs that take milliseconds, and runs that are picked by them.
set(trade ${Python3_EXECUTABLE} ${CMAKE_CURRENT_LIST_DIR}/trade.py)
set(cli sh ${CMAKE_CURRENT_LIST_DIR}/cli.sh)
set(assay $<TARGET_FILE:assay>)

# Lattice stencils refuse particles that are moved, and RK4 breaks down at CFL 3. 2 x 2 x 2 x 3 combinations.
set(bar plastic-wave --set scheme=upwind --set evolved=pF --set precision=double)
assay_test(trade-study LABELS gate UNTRAPPED "runs break down" COMMAND ${trade} study ${assay} test-out/trade 24 ${bar} --levels 25,50
  --vary stencil=closed,sbp4 --vary support=2 --vary perturb=0,0.1 --vary integrator=euler,rk4 --vary cfl=0.3,0.8,3
  --budget 100)
set_tests_properties(trade-study PROPERTIES FIXTURES_SETUP trade)
# Another way to set the problem up, which the scene offers, doubles them: 2 stencils, 2 ways, and 3 evolved sets.
assay_test(trade-variants LABELS gate COMMAND ${trade} study ${assay} test-out/trade-variants 12
  ${CMAKE_CURRENT_LIST_DIR}/scenes/whole-cube.lua --set scheme=upwind --set precision=double --vary stencil=sbp2,closed
  --vary support=2 --vary integrator=tvd-rk2 --vary cfl=0.3 --budget 100)
# A quarter by symmetry, and keys of incompressible bodies.
assay_test(trade-symmetry LABELS gate COMMAND ${trade} study ${assay} test-out/trade-symmetry 2 breathing-cylinder
  --set scheme=upwind --set evolved=pF --set precision=double --levels 8,16 --vary stencil=closed --vary support=2
  --vary integrator=rk4 --vary cfl=0.4 --budget 100)
assay_test(trade-incompressible LABELS gate COMMAND ${trade} study ${assay} test-out/trade-incompressible 3
  manufactured-isochoric --set scheme=upwind --set evolved=pFHJ --set precision=double --levels 8,12 --set material.nu=0.5
  --set incompressible.solver=poisson --vary incompressible.restore=0,0.1 --vary stencil=sbp2 --vary support=2
  --vary integrator=tvd-rk2 --vary cfl=0.3 --budget 100)
# Every key that is varied unless something else is said, cut short by the budget: nothing is left for n = 80.
assay_test(trade-cut LABELS gate COMMAND ${cli} 0 "the budget was spent before its turn" ${assay} trade plastic-wave
  --levels 20,40,80 --budget 0.01 --out test-out/trade-cut)

# A run that a study picked: it reaches the error, and repeats what the study measured.
set(picked ${assay} run ${bar} --out test-out/trade-run --study test-out/trade/trade.tsv --error)
function(trade_test name code text)
  assay_test(trade-${name} LABELS gate mustfail COMMAND ${cli} ${code} ${text} ${ARGN})
  set_tests_properties(trade-${name} PROPERTIES FIXTURES_REQUIRED "program;trade")
endfunction()
trade_test(run 0 "PASS: the error is what was asked for, and what the study says" ${picked} 0.1)
trade_test(run-names-error 0 "choose sbp4 rk4 cfl=0.8 at n = 50" ${picked} v_l1=0.06)
trade_test(run-out-of-reach 2 "nothing measured reaches P_l1 <= 1e-07" ${picked} 1e-7)
trade_test(run-unknown-error 2 "the study has no error q" ${picked} q=1e-3)
trade_test(run-wrong-error 2 "expected a number above 0" ${picked} P_l1=-1)
trade_test(run-no-study 2 "make one: assay trade plastic-wave" ${assay} run ${bar} --error 0.1 --out test-out/trade-none)
trade_test(run-other-overrides 2 "the scene has changed since the study" ${picked} 0.1 --set v0=5e-3)
trade_test(run-n 2 "n is what --error picks" ${picked} 0.1 --set n=100)
trade_test(run-other-scene 2 "a study of the scene plastic-wave" ${assay} run swinging-cube --error 0.1
  --study test-out/trade/trade.tsv --out test-out/trade-run)
trade_test(run-changed-scene 2 "the scene has changed since the study" sh -c
  "mkdir -p test-out/trade-changed
   cp ${CMAKE_SOURCE_DIR}/verify/scenes/plastic-wave.lua test-out/trade-changed/ && echo '-- a comment' >> test-out/trade-changed/plastic-wave.lua
   $<TARGET_FILE:assay> run test-out/trade-changed/plastic-wave.lua --set scheme=upwind --set evolved=pF --set precision=double --error 0.1 --study test-out/trade/trade.tsv --out test-out/trade-changed")
trade_test(run-cut-study 2 "cut short or damaged" sh -c
  "head -c 1500 test-out/trade/trade.tsv > test-out/trade/cut.tsv
   $<TARGET_FILE:assay> run plastic-wave --error 0.1 --study test-out/trade/cut.tsv --out test-out/trade-run")
# A study whose pick does not reach the error: the run's own error is what counts.
trade_test(run-lying-study 1 "FAIL: the study does not hold for this run" sh -c
  "${Python3_EXECUTABLE} ${CMAKE_CURRENT_LIST_DIR}/trade.py forge test-out/trade lie.tsv
   $<TARGET_FILE:assay> run plastic-wave --set scheme=upwind --set evolved=pF --set precision=double --error 0.1 --study test-out/trade/lie.tsv --out test-out/trade-lie")

function(trade_refuses name text)
  assay_test(trade-${name} LABELS mustfail COMMAND ${cli} 2 ${text} ${assay} ${ARGN})
endfunction()
trade_refuses(of-no-oracle "answers to no oracle" trade rotating-plate)
trade_refuses(vary-what-is-no-method "--vary material.E: no key that says how a problem is solved" trade plastic-wave
              --vary material.E=1,2)
trade_refuses(vary-the-luck "--vary seed: no key that says how a problem is solved" trade plastic-wave --vary seed=1,2)
trade_refuses(vary-suggests "did you mean stencil?" trade plastic-wave --vary stencl=sbp2)
trade_refuses(vary-no-number "--vary cfl=abc: expected a number" trade plastic-wave --vary cfl=0.3,abc)
trade_refuses(vary-no-such-word "did you mean sbp" trade plastic-wave --vary stencil=sbp2,sbp3)
trade_refuses(vary-what-is-set "--set fixes this key" trade plastic-wave --vary cfl=0.3 --set cfl=0.8)
trade_refuses(vary-twice "given twice" trade plastic-wave --vary cfl=0.3 --vary cfl=0.8)
trade_refuses(vary-same-value "0.80 is given twice" trade plastic-wave --vary cfl=0.8,0.3,0.80)
trade_refuses(vary-nothing "expected up to 16 values" trade plastic-wave --vary cfl=0.3,,0.8)
trade_refuses(budget-twice "--budget: given twice" trade plastic-wave --budget 1 --budget 2)
trade_refuses(levels-twice "--levels: given twice" trade plastic-wave --levels 20 --levels 40)
trade_refuses(wrong-budget "a number of seconds above 0" trade plastic-wave --budget -1)
trade_refuses(wrong-error "there is no error called \"q\"" trade plastic-wave --error q)
trade_refuses(n-in-a-trade "say which by --levels" trade plastic-wave --set n=100)
trade_refuses(study-without-error "says nothing without --error" run plastic-wave --study x.tsv)
assay_test(trade-help LABELS unit COMMAND ${cli} 0 "usage: assay trade SCENE" ${assay} trade --help)

# A body at rest has no error: a run that such a study picked repeats it, and nothing is divided by it.
set(rest ${CMAKE_CURRENT_LIST_DIR}/scenes/whole-cube.lua --set U0=0 --set scheme=upwind --set precision=double)
assay_test(trade-exact LABELS gate COMMAND ${assay} trade ${rest} --error p_abs --levels 4,6 --vary stencil=sbp2
  --vary support=2 --vary integrator=tvd-rk2 --vary cfl=0.3 --budget 100 --out test-out/trade-exact)
set_tests_properties(trade-exact PROPERTIES FIXTURES_SETUP exact)
assay_test(trade-run-exact LABELS gate COMMAND ${cli} 0 "PASS: the error is what was asked for" ${assay} run ${rest}
  --error p_abs=1e-3 --study test-out/trade-exact/trade.tsv --out test-out/trade-run-exact)
set_tests_properties(trade-run-exact PROPERTIES FIXTURES_REQUIRED "program;exact")
