# Runs that are stopped, killed, or out of disk, and gone on with.
foreach(test killed stopped twice burst over unasked full refused study)
  assay_test(restart-${test} LABELS unit COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/restart.py ${test}
    $<TARGET_FILE:assay> test-out/restart-${test})
endforeach()
set_tests_properties(restart-full restart-refused PROPERTIES LABELS "unit;mustfail")
# Measurements keep what they have.
foreach(test extremes cost trade trade_at_once)
  string(REPLACE _ - name ${test})
  assay_test(stopped-${name} LABELS unit COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/stopped.py ${test}
    $<TARGET_FILE:assay> test-out/stopped-${name})
endforeach()
