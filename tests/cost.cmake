
# The allocator of test_solver_cost is watched: the linker puts the test's functions in front of it.
foreach(function aligned_alloc malloc calloc realloc free)
  target_link_options(test_solver_cost PRIVATE -Wl,--wrap=${function})
endforeach()

# The command, on scenes that switch on what others do not.
foreach(row "swinging-cube;n=8;--set;balance=true" "taylor-bar;n=1" "spinning-body;n=2" "bimaterial-wave;n=50"
        "rotating-plate;n=8;--set;scheme=jst")
  list(POP_FRONT row scene words)
  assay_test(cost-${scene} LABELS unit COMMAND ${CMAKE_COMMAND} -E env OMP_NUM_THREADS=1 ${Python3_EXECUTABLE}
    ${CMAKE_CURRENT_SOURCE_DIR}/cost_json.py $<TARGET_FILE:assay> cost-${scene}.json ${scene} --set ${words})
endforeach()
