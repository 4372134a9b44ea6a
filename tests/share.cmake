# test_solver_stencil_share runs scenes with shared rows and without: the linker puts its function in front of this.
foreach(program test_solver_stencil_share mutant_shared-by-length)
  if(TARGET ${program}) # there are no mutants under sanitizers
    target_link_options(${program} PRIVATE -Wl,--wrap=solver_stencil_share)
  endif()
endforeach()
# The same of test_solver_stencil_align, with rows sorted by axis and without.
foreach(program test_solver_stencil_align mutant_aligned-off-axis)
  if(TARGET ${program})
    target_link_options(${program} PRIVATE -Wl,--wrap=solver_stencil_align)
  endif()
endforeach()
# And of solver_stencil_find_runs, with particles abreast and without, and without ranks.
foreach(program test_solver_stencil_runs mutant_abreast-by-row)
  if(TARGET ${program})
    target_link_options(${program} PRIVATE -Wl,--wrap=solver_stencil_find_runs
                        -Wl,--wrap=solver_stencil_find_ranks)
  endif()
endforeach()
# And of solver_stencil_find_ranks, with ranks and without.
target_link_options(test_solver_stencil_ranks PRIVATE -Wl,--wrap=solver_stencil_find_ranks)
# And of aligned_alloc, which then may have no memory.
target_link_options(test_solver_closure_memory PRIVATE -Wl,--wrap=aligned_alloc)
