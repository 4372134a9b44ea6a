# The allocator of test_solver_cost is watched: the linker puts the test's functions in front of it.
foreach(function aligned_alloc malloc calloc realloc free)
  target_link_options(test_solver_cost PRIVATE -Wl,--wrap=${function})
endforeach()
