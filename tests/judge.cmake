# The judge, with results that stand for another solver's, right and wrong, and with files that are none.
include(${CMAKE_CURRENT_LIST_DIR}/system_python.cmake)
add_executable(judge_sample ${CMAKE_CURRENT_SOURCE_DIR}/judge_sample.c)
target_link_libraries(judge_sample PRIVATE assay_verify)
set(judged ${CMAKE_BINARY_DIR}/judge_samples)
file(MAKE_DIRECTORY ${judged})
assay_test(judge-sample LABELS unit COMMAND judge_sample ${judged})
set_tests_properties(judge-sample PROPERTIES FIXTURES_SETUP judge_samples)
assay_test(judge-gates LABELS gate mustfail COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/judge_gates.py
  $<TARGET_FILE:assay> ${judged})
assay_test(judge-vtk LABELS unit SKIP_CODE 77 COMMAND ${ASSAY_SYSTEM_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/judge_vtk.py
  $<TARGET_FILE:assay> test-out/judge-vtk)
assay_test(judge-malformed LABELS mustfail UNTRAPPED "damaged files hold infinities" COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/judge_malformed.py
  $<TARGET_FILE:assay> ${judged} test-out/judge-malformed)
set_tests_properties(judge-gates judge-malformed PROPERTIES FIXTURES_REQUIRED "program;judge_samples")
# With sanitizers thousands of calls of the program: begun last it would keep one core busy alone.
set_tests_properties(judge-malformed PROPERTIES COST 20)

function(judge_refuses name text)
  assay_test(judge-${name} LABELS mustfail COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 2 ${text} $<TARGET_FILE:assay> ${ARGN})
  set_tests_properties(judge-${name} PROPERTIES FIXTURES_REQUIRED "program;judge_samples")
endfunction()
set(right judge ${judged}/right-4.csv ${judged}/right-8.csv)
set(cube --oracle swinging-cube --typical)
judge_refuses(no-file "wants FILE" judge ${cube})
judge_refuses(missing-file "nowhere.h5" judge nowhere.h5 ${cube})
judge_refuses(folder "plain file" judge ${judged} ${cube})
judge_refuses(no-oracle "wants --oracle NAME" ${right})
judge_refuses(wrong-oracle "did you mean swinging-cube" ${right} --oracle swinging-cub --typical)
judge_refuses(missing-parameters "--param material.rho=1100   [kg/m^3] density" ${right} --oracle swinging-cube --param nu=0.3)
judge_refuses(wrong-parameter "did you mean material.nu" ${right} ${cube} --param material.nuu=0.3)
judge_refuses(wrong-parameter-value "material.nu" ${right} ${cube} --param material.nu=0.7)
judge_refuses(parameter-no-number "expected KEY=number" ${right} ${cube} --param material.nu=soft)
judge_refuses(wrong-gate "there is no error of that name" ${right} ${cube} --gate Q=1)
judge_refuses(gate-no-number "expected NAME=number" ${right} ${cube} --gate P=small)
judge_refuses(gate-no-bound "expected NAME=BOUND" ${right} ${cube} --gate P)
judge_refuses(gate-of-missing-field "field v is missing" ${right} ${cube} --gate v=1)
judge_refuses(wrong-norm "expected l2, l1, max" ${right} ${cube} --norm l3)
judge_refuses(same-level-twice "the same spacing" ${right} ${judged}/right-8.vtu ${cube})
judge_refuses(other-time "but --time says" ${right} ${cube} --time 1)
judge_refuses(spacings-of-fewer "expected one for each of 2 levels" ${right} ${cube} --spacing 0.1)
judge_refuses(other-body "outside the body" judge ${judged}/right-8.h5 --oracle thin-plate --typical)
judge_refuses(json-elsewhere "ends in .json" ${right} ${cube} --json /dev/null)
judge_refuses(oracle-without-places "wants --points FILE or --grid" oracle cable --typical --time 1)
judge_refuses(oracle-without-time "give --time" oracle cable --typical --grid 0:1:2)
judge_refuses(oracle-grid-outside "outside the body" oracle cable --typical --grid 0:11:2 --time 0)
judge_refuses(oracle-before-the-start "begins at t = 0" oracle cable --typical --grid 0:1:2 --time 0,-1 -o before.h5)
judge_refuses(oracle-wrong-grid "expected X0:X1:N" oracle cable --typical --grid 0:1 --time 0)
judge_refuses(oracle-huge-grid "expected X0:X1:N" oracle swinging-cube --typical --grid 0:1:9999,0:1:9999,0:1:9999 --time 0)
judge_refuses(oracle-table-of-two-times "one time and one level" oracle cable --typical --grid 0:1:2 --time 0,1)
judge_refuses(oracle-wrong-ending "ends in .h5 or .csv" oracle cable --typical --grid 0:1:2 --time 0 -o out.txt)
# The weights of a grid are those of the trapezium rule: 0.75, 1.5, 0.75.
assay_test(judge-grid-weights LABELS unit COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 0 ",0.75"
  $<TARGET_FILE:assay> oracle cable --typical --grid 0:3:3 --time 0)
foreach(command judge oracle)
  assay_test(cli-help-${command} LABELS unit COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 0 "usage: assay ${command}"
    $<TARGET_FILE:assay> ${command} --help)
endforeach()

# Every oracle of the table, asked on a grid and judged by itself, in both formats, agrees with itself to the last bit.
assay_test(judge-every-oracle LABELS oracle COMMAND ${Python3_EXECUTABLE}
  ${CMAKE_CURRENT_SOURCE_DIR}/judge_every_oracle.py $<TARGET_FILE:assay> test-out/judge-every)
