# The command line from outside: exit codes, messages, files.
set(cli sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh)
set(assay $<TARGET_FILE:assay>)
include(${CMAKE_CURRENT_LIST_DIR}/scenes.cmake)

# What was typed or given is wrong: exit code 2, and the message says what.
function(cli_refuses name text)
  assay_test(cli-${name} LABELS mustfail COMMAND ${cli} 2 ${text} ${assay} ${ARGN})
endfunction()

cli_refuses(no-command "usage: assay COMMAND")
cli_refuses(wrong-command "did you mean assay verify?" verfy swinging-cube)
cli_refuses(no-scene "wants SCENE" verify)
cli_refuses(wrong-scene "did you mean swinging-cube?" verify swinging-cub)
cli_refuses(missing-scene-file "/nowhere/x.lua" run /nowhere/x.lua)
cli_refuses(scene-is-folder "directory" run ./CMakeFiles/)
cli_refuses(wrong-option "did you mean --levels?" verify swinging-cube --lvels 4,8)
cli_refuses(option-of-another "takes no --levels, being of one size, as in --set n=24" run swinging-cube --levels 4,8)
cli_refuses(cost-of-one-size "assay cost takes no --levels, being of one size" cost swinging-cube --levels 24)
cli_refuses(wrong-levels "must increase" verify swinging-cube --levels 8,4)
cli_refuses(huge-level "memory" verify swinging-cube --levels 8,100000)
cli_refuses(n-in-a-study "--levels" verify swinging-cube --set n=8)
cli_refuses(wrong-key "material.nuu" verify swinging-cube --set material.nuu=0.3)
cli_refuses(wrong-value "material.nu" verify swinging-cube --set material.nu=0.7)
cli_refuses(oracle-of-what-is-lacking "\"plate-impact-stiffened\" cannot judge a run, because the solver lacks equations of state"
            verify swinging-cube --set oracle.name=plate-impact-stiffened)
cli_refuses(elastic-oracle-of-plastic-body "is of an elastic body, and the scene has material.yield_stress" verify
            manufactured --set material.model=hencky --set material.yield_stress=1)
cli_refuses(wrong-oracle-key "oracle.V0" verify swinging-cube --set oracle.V0=1)
cli_refuses(wrong-oracle-value "material.nu" verify swinging-cube --set oracle.material.nu=0.7)
cli_refuses(domain-beyond-oracle "corner at (1, 0, 0) m lies 0.1 m outside the body that the oracle" verify
            manufactured-waves --set oracle.L=0.9)
cli_refuses(disc-beyond-oracle "m lies 0.1 m outside the body that the oracle" verify breathing-cylinder --levels 4
            --set oracle.R=0.9)
cli_refuses(trade-beyond-oracle "m lies 0.1 m outside the body that the oracle" trade breathing-cylinder --levels 4
            --set oracle.R=0.9 --out test-out/trade-beyond)
cli_refuses(time-beyond-oracle "reaches to 0.000436" verify plastic-wave
            --set t_end=1)
cli_refuses(gate-of-no-figure "the scene's key figures has no such figure" verify bimaterial-wave
            --set figures={})
cli_refuses(wrong-subject "did you mean keys?" list kyes)
cli_refuses(wrong-golden-verb "check or update" golden chek swinging-cube)
cli_refuses(no-golden-record "golden update swinging-cube" golden check swinging-cube --dir test-out/no-golden
            --out test-out/no-golden)
cli_refuses(missing-record "nothing-there.vtkhdf" render nothing-there.vtkhdf)
cli_refuses(no-such-scalar "its fields are F, H, J, P, displacement, momentum, pressure, sigma" render
            ${CMAKE_SOURCE_DIR}/golden/swinging-cube.vtkhdf -o test-out/none.png --set view.field=Q_xx)
# Before a run, and so before the folder of its results is looked at, which is no folder.
cli_refuses(no-such-scalar-in-a-scene "view.field: the record has no scalar" run swinging-cube
            --set view.field=Q_xx --out ${CMAKE_SOURCE_DIR}/README.md)
cli_refuses(gate-on-unknown-field "\"P\" needs the scene's key scheme" verify swinging-cube --set scheme=ulsph)
cli_refuses(no-oracle-no-gates "has no gates" verify rotating-plate --set gates={})
cli_refuses(beside-nothing "\"beside\" needs the scene's key beside" verify rotating-plate --set beside={})
cli_refuses(beside-without-probes "probes are what is compared" verify rotating-plate --set probes={})
cli_refuses(told-alone "needs L (length) [m]: give it under parameters, as the body starts from it" verify
            ${CMAKE_SOURCE_DIR}/tests/scenes/told-alone.lua)
cli_refuses(gate-without-oracle "\"p_l1\" needs the scene's key oracle" verify ${plate_without_oracle})
cli_refuses(foreign-record "CMakeCache.txt" render CMakeCache.txt)
cli_refuses(json-over-another-file "ends in .json" verify swinging-cube --levels 8 --out test-out/device
            --json /dev/null)
# Before anything is measured, for which the refusal would come too late.
foreach(command "verify;swinging-cube;--levels;8;--out;test-out/nowhere" "verify;mms;in time;--out;test-out/nowhere"
                "trade;plastic-wave" "cost;swinging-cube;--set;n=100" "extremes;cfl")
  list(GET command 0 name)
  list(GET command 1 of)
  assay_test(cli-${name}-${of}-json-nowhere LABELS mustfail TIMEOUT 5 COMMAND ${cli} 2 "assay: test-out/none/x.json: cannot write"
    ${assay} ${command} --json test-out/none/x.json)
endforeach()
cli_refuses(out-is-a-file "CMakeCache.txt" run swinging-cube --set n=8 --out CMakeCache.txt)

foreach(command list run verify render golden compare bench)
  assay_test(cli-help-${command} LABELS unit COMMAND ${cli} 0 "usage: assay ${command}" ${assay} ${command} --help)
endforeach()
foreach(word --help --version list)
  assay_test(cli-full-disk-${word} LABELS mustfail COMMAND ${cli} 2 "standard output could not be written" sh -c
    "${assay} ${word} >/dev/full")
endforeach()
assay_test(cli-list LABELS unit COMMAND ${cli} 0 "Swinging cube" ${assay} list)
assay_test(cli-list-awaited LABELS unit COMMAND ${cli} 0 "the solver lacks equations of state: nothing is verified by it yet"
           ${assay} list oracles)
assay_test(cli-list-schemes LABELS unit COMMAND ${cli} 0 "cofactor H" ${assay} list schemes)
assay_test(cli-bench-without-stencil LABELS unit COMMAND ${cli} 0 "-        -             125"
  ${assay} bench swinging-cube --set scheme=ulsph --set n=4)
assay_test(cli-bench-levels LABELS unit COMMAND ${cli} 0 "-        -              64"
  ${assay} bench swinging-cube --set scheme=ulsph --levels 3,4)
# Mixed and single precision beside double, unless the row is of one of them.
set(last_columns "'sbp2 +pF .* %")
assay_test(cli-bench-precisions LABELS unit COMMAND sh -c
  "'$<TARGET_FILE:assay>' bench swinging-cube --levels 3 --set stencil=sbp2 --set evolved=pF | grep -E ${last_columns}( +[0-9]+[.][0-9]+){2}$'")
assay_test(cli-bench-of-one-precision LABELS unit COMMAND sh -c
  "'$<TARGET_FILE:assay>' bench swinging-cube --levels 3 --set stencil=sbp2 --set evolved=pF --set precision=single | grep -E ${last_columns}( +-){2}$'")
assay_test(cli-bench-of-what-fits LABELS unit COMMAND ${cli} 0 "sbp4     pF     refused: " ${assay} bench breathing-cylinder --set precision=double
  --set n=4 --set evolved=pF)
# Thousands of steps: by an integrator and a CFL number that every stencil holds.
assay_test(cli-bench-lasts LABELS unit COMMAND ${cli} 0 "sbp4     pFJ           144 " ${assay} bench rotating-plate --levels 11
  --set stencil=sbp4 --set evolved=pFJ)
assay_test(cli-bench-of-what-breaks LABELS mustfail UNTRAPPED "runs break down" COMMAND ${cli} 3 "sbp2     pF     broke down: step "
  ${assay} bench swinging-cube --levels 4 --set stencil=sbp2 --set evolved=pF --set cfl=3)
cli_refuses(bench-of-nothing "single is for antisymmetric stencils" bench swinging-cube --set n=4 --set precision=single
            --set stencil=sph)
assay_test(cli-version-path LABELS unit ENVIRONMENT ASSAY_ISA=baseline COMMAND ${cli} 0 "loops for baseline"
  ${assay} --version)
assay_test(cli-path-refused LABELS unit mustfail ENVIRONMENT ASSAY_ISA=avx1024 COMMAND ${cli} 2
  "ASSAY_ISA is \"avx1024\"" ${assay} run swinging-cube --set n=8 --out test-out/path)
assay_test(cli-list-materials LABELS unit COMMAND ${cli} 0 "Hooke's law" ${assay} list materials)
assay_test(cli-list-stencils LABELS unit COMMAND ${cli} 0 "summation-by-parts 4-2" ${assay} list stencils)
assay_test(cli-list-claims LABELS unit COMMAND ${cli} 0 "to degree 4, 2 at the boundary" ${assay} list stencils)
assay_test(cli-list-promises LABELS unit COMMAND ${cli} 0 "with ulsph.tension=stress" ${assay} list schemes)
assay_test(cli-list-integrators LABELS unit COMMAND ${cli} 0 "four-stage" ${assay} list integrators)
assay_test(cli-list-measures LABELS unit COMMAND ${cli} 0 "damped oscillation" ${assay} list measures)
assay_test(cli-list-keys LABELS unit COMMAND ${cli} 0 "material.nu" ${assay} list keys)

# Two pictures: the same, another scene's, of another size, none, and a difference that is asked for over one of them.
set(stored ${CMAKE_SOURCE_DIR}/golden)
set(cli_script "sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh")
assay_test(cli-compare-same LABELS image COMMAND ${cli} 0 "0.000 % of the pixels differ visibly" ${assay} compare
  ${stored}/rings.png ${stored}/rings.png)
assay_test(cli-compare-other LABELS image mustfail COMMAND sh -c
  "rm -f test-out/compared.png
   ${cli_script} 1 FAIL $<TARGET_FILE:assay> compare ${stored}/rod-impact.png ${stored}/elastic-cable.png -o test-out/compared.png &&
   ${cli_script} 0 PASS $<TARGET_FILE:assay> compare ${stored}/rod-impact.png ${stored}/elastic-cable.png --tolerance 1,1 &&
   ${cli_script} 2 'one of the pictures compared' $<TARGET_FILE:assay> compare ${stored}/rod-impact.png test-out/compared.png -o ./test-out/compared.png &&
   ${cli_script} 0 PASS $<TARGET_FILE:assay> compare test-out/compared.png test-out/compared.png")
cli_refuses(compare-nothing "nothing.png: cannot be read" compare ${stored}/rings.png nothing.png)
cli_refuses(compare-sizes "expected the same" compare ${stored}/rings.png ${stored}/elastic-cable.png)
cli_refuses(compare-no-picture "not a whole PNG" compare ${stored}/rings.png ${stored}/rings.vtkhdf)
cli_refuses(compare-tolerance "two numbers from 0 to 1" compare a.png b.png --tolerance 2)

# An oracle that is told another number than the solver must make the gates fail: amplitude and modulus by 1 %.
set(mismatch sh ${CMAKE_CURRENT_SOURCE_DIR}/mismatch.sh ${assay})
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/test-out)
assay_test(mismatch-amplitude LABELS gate mustfail COMMAND ${mismatch} test-out/amplitude oracle.U0=5.05e-4)
assay_test(mismatch-modulus LABELS gate mustfail COMMAND ${mismatch} test-out/modulus oracle.material.E=17.17e6)
assay_test(mismatch-density LABELS gate mustfail COMMAND ${mismatch} test-out/density oracle.rho=1111)

assay_test(readme-scene LABELS gate COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/readme_scene.sh ${assay}
  ${CMAKE_SOURCE_DIR}/README.md test-out/readme-scene)

# With one level no order was observed, and gates on orders cannot pass.
assay_test(one-level LABELS gate mustfail COMMAND ${cli} 1
  "nothing was measured: one level has no order"
  ${assay} verify swinging-cube --levels 8 --out test-out/one-level)
# Where memory does not suffice for OSMesa, which would crash, nothing is drawn; what was computed stays. Sanitizers take
# more addresses than any limit leaves.
if(NOT ASSAY_SANITIZE)
  assay_test(no-room-to-draw LABELS mustfail COMMAND ${cli} 2
    "the record is in test-out/no-room/elastic-cable.vtkhdf, for assay render" sh -c
    "rm -rf test-out/no-room && ulimit -v 500000 && exec $<TARGET_FILE:assay> run elastic-cable --out test-out/no-room")
  assay_test(no-room-to-draw-record LABELS gate COMMAND ${assay} render test-out/no-room/elastic-cable.vtkhdf)
  set_tests_properties(no-room-to-draw PROPERTIES FIXTURES_SETUP no-room)
  set_tests_properties(no-room-to-draw-record PROPERTIES FIXTURES_REQUIRED "program;no-room")
endif()
# A run that breaks down: exit code 3, and the last whole state on disk.
assay_test(breakdown LABELS gate mustfail COMMAND ${cli} 3 "the last whole state is in test-out/breakdown/"
  ${assay} run swinging-cube --set n=8 --set t_end=1 --set cfl=3 --out test-out/breakdown)
assay_test(breakdown-record LABELS gate COMMAND ${assay} render test-out/breakdown/swinging-cube.last-good.vtkhdf)
set_tests_properties(breakdown PROPERTIES FIXTURES_SETUP breakdown)
set_tests_properties(breakdown-record PROPERTIES FIXTURES_REQUIRED "program;breakdown")

# Stored results: what was just stored compares equal, and a run with a modulus off by 1e-8 does not.
assay_test(golden-round-trip LABELS golden COMMAND sh -c
  "$<TARGET_FILE:assay> golden update swinging-cube --dir test-out/golden &&
   $<TARGET_FILE:assay> golden check swinging-cube --dir test-out/golden --out test-out/golden-fresh")
set_tests_properties(golden-round-trip PROPERTIES FIXTURES_SETUP golden-round-trip)
assay_test(golden-notices LABELS golden mustfail COMMAND ${cli} 1 "FAIL: the result is not as stored"
  ${assay} golden check swinging-cube --dir test-out/golden --out test-out/golden-other --set material.E=17.00000017e6)
assay_test(golden-shows LABELS golden mustfail COMMAND sh -c
  "rm -f test-out/golden-shown/*.png
   $<TARGET_FILE:assay> golden check swinging-cube --dir test-out/golden --out test-out/golden-shown --set material.E=18e6
   test $? = 1 && cd test-out/golden-shown && ls swinging-cube.diff.png swinging-cube.stored.png swinging-cube.fresh.png")
set_tests_properties(golden-notices golden-shows PROPERTIES FIXTURES_REQUIRED "program;golden-round-trip")

# A scene without an oracle: judged by its indicators and beside another configuration, in which too few particles show.
assay_test(no-oracle LABELS gate COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/study_beside.py ${assay}
  test-out/no-oracle)
assay_test(no-oracle-too-coarse LABELS gate mustfail COMMAND ${cli} 1 "FAIL: a gate does not hold"
  ${assay} verify rotating-plate --set scheme=ulsph --set t_end=0.03 --levels 8 --out test-out/no-oracle-coarse)

# The JSON report and its checker, on a study that passes or fails and on one that must fail.
assay_test(json-shape LABELS gate COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/study_json.py ${assay}
  test-out/json-shape swinging-cube)
assay_test(json-shape-snapshots LABELS gate COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/study_json.py
  ${assay} test-out/json-snapshots swinging-cube --levels 8,12 --set snapshots={5e-4,1e-3})
assay_test(json-shape-figures LABELS gate COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/study_json.py
  ${assay} test-out/json-figures bimaterial-wave --levels 50,100,200)
assay_test(json-shape-mismatch LABELS gate COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/study_json.py
  ${assay} test-out/json-mismatch swinging-cube --levels 8,12 --set oracle.U0=5.05e-4)

# From a run to its picture, drawn again from the record alone.
assay_test(run-and-render LABELS image COMMAND sh -c
  "$<TARGET_FILE:assay> run swinging-cube --set n=8 --out test-out/render &&
   $<TARGET_FILE:assay> render test-out/render/swinging-cube.vtkhdf -o test-out/render/again.png &&
   cmp test-out/render/swinging-cube.png test-out/render/again.png")
# A record is not overwritten by its own picture.
assay_test(render-over-record LABELS mustfail COMMAND sh -c
  "$<TARGET_FILE:assay> run swinging-cube --set n=8 --out test-out/render-over &&
   sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 2 'ends in .png' $<TARGET_FILE:assay> render test-out/render-over/swinging-cube.vtkhdf -o test-out/render-over/swinging-cube.vtkhdf &&
   ln -sf swinging-cube.vtkhdf test-out/render-over/link.png &&
   sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 2 'is the record itself' $<TARGET_FILE:assay> render test-out/render-over/swinging-cube.vtkhdf -o test-out/render-over/link.png &&
   $<TARGET_FILE:assay> render test-out/render-over/swinging-cube.vtkhdf")
assay_test(render-another-field LABELS image COMMAND sh -c
  "$<TARGET_FILE:assay> run swinging-cube --set n=8 --out test-out/field &&
   $<TARGET_FILE:assay> render test-out/field/swinging-cube.vtkhdf -o test-out/field/u.png --set view.field=displacement_x &&
   ! cmp -s test-out/field/swinging-cube.png test-out/field/u.png")

set(html ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/study_html.py ${assay})
assay_test(report-html LABELS gate COMMAND ${html} test-out/report-html 0 swinging-cube --levels 8,10,12)
assay_test(report-html-profiles LABELS gate COMMAND ${html} test-out/report-profiles 6 bimaterial-wave --levels 50,100,200)
assay_test(report-html-two-levels LABELS gate COMMAND ${html} test-out/report-two-levels 6 bimaterial-wave --levels 100,200)

# Of a configuration that no gate is meant for, the report says so, and that published figures are of another problem.
assay_test(general-bounds-are-named LABELS gate COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 0
  "PASS, but only of the bounds that the scene has for any configuration" $<TARGET_FILE:assay> verify swinging-cube
  --levels 8 --set evolved=pF --set material.nu=0.31 --out test-out/general)
