# test_solver_stencil_share runs scenes with shared rows and without: the linker puts its function in front of this.
foreach(program test_solver_stencil_share mutant_shared-by-length)
  target_link_options(${program} PRIVATE -Wl,--wrap=solver_stencil_share)
endforeach()
