# What is broken on purpose must be caught by the gate meant for it, and by exit code 1.
include(${CMAKE_CURRENT_LIST_DIR}/scenes.cmake)
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(mustfail ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/mustfail.py)
# One thread each: ctest runs as many of them as there are cores.
set(quick_sbp4 ${quick_scene} --levels 8,16 --set threads=1)
set(quick_rk2 ${quick_sbp4} --set integrator=tvd-rk2 --set cfl=0.3)
set(quick_sbp2 ${quick_rk2} --set stencil=sbp2)
set(quick_sph ${quick_rk2} --set stencil=sph)

# First-order reconstruction is a choice of the scene.
assay_test(mustfail-first-order-reconstruction LABELS gate mustfail COMMAND ${mustfail} mustfail/reconstruction
  "p,P,rate p,rate P" $<TARGET_FILE:assay> ${quick_sbp2} -- $<TARGET_FILE:assay> ${quick_sbp2} --set reconstruction=none)

# Mutants: the program with one of its sources broken as tests/mutants/NAME.mutant says; the solver holds no code for
# tests. The broken object stands on the command line, so the linker has no use for that of the library; had it, both
# would define the same names, which is an error. Hot loops are broken on the baseline path, which is all that the tests
# of mutants run. Debug builds, which run the unit programs only, go without.
if(NOT CMAKE_BUILD_TYPE STREQUAL "Release")
  message(STATUS "no mutants: they are for the build type Release")
  return()
endif()

add_library(assay_main OBJECT ${CMAKE_SOURCE_DIR}/verify/main.c)
target_link_libraries(assay_main PRIVATE assay_verify)

# assay_mutate(NAME LIBRARY...): the broken source, or the one that includes the broken header, as objects compiled as in
# each of the libraries; their names become `objects`.
function(assay_mutate name)
  set(mutant ${CMAKE_CURRENT_SOURCE_DIR}/mutants/${name}.mutant)
  set(broken ${CMAKE_BINARY_DIR}/mutants/${name}/${source})
  set(script ${CMAKE_CURRENT_SOURCE_DIR}/mutants/mutate.py)
  get_filename_component(folder ${broken} DIRECTORY)
  file(MAKE_DIRECTORY ${folder})
  add_custom_command(OUTPUT ${broken} VERBATIM DEPENDS ${script} ${mutant} ${CMAKE_SOURCE_DIR}/${source}
    COMMAND ${Python3_EXECUTABLE} ${script} ${CMAKE_SOURCE_DIR} ${mutant} ${broken})
  # Objects of several libraries come from one file: it must be there before the first of them is compiled.
  add_custom_target(source_of_${name} DEPENDS ${broken})
  set(compiled ${broken})
  if(NOT through STREQUAL source)
    set(compiled ${CMAKE_SOURCE_DIR}/${through})
  endif()
  set(objects "")
  foreach(library ${ARGN})
    add_library(mutated_${name}_${library} OBJECT ${compiled})
    add_dependencies(mutated_${name}_${library} source_of_${name})
    # What other tools check is the file as it is.
    set_target_properties(mutated_${name}_${library} PROPERTIES EXPORT_COMPILE_COMMANDS OFF)
    target_compile_definitions(mutated_${name}_${library} PRIVATE $<TARGET_PROPERTY:${library},COMPILE_DEFINITIONS>)
    target_compile_options(mutated_${name}_${library} PRIVATE $<TARGET_PROPERTY:${library},COMPILE_OPTIONS>)
    target_include_directories(mutated_${name}_${library} PRIVATE ${CMAKE_BINARY_DIR}/mutants/${name}
      ${CMAKE_SOURCE_DIR})
    target_include_directories(mutated_${name}_${library} SYSTEM PRIVATE
      $<TARGET_PROPERTY:${library},INCLUDE_DIRECTORIES>)
    list(APPEND objects $<TARGET_OBJECTS:mutated_${name}_${library}>)
  endforeach()
  set(objects ${objects} PARENT_SCOPE)
endfunction()

# Sets `source` to the file that a mutant breaks, and `through` to the source that has it compiled.
macro(assay_mutant_source name)
  file(STRINGS ${CMAKE_CURRENT_SOURCE_DIR}/mutants/${name}.mutant source REGEX "^source: " LIMIT_COUNT 1)
  string(REPLACE "source: " "" source "${source}")
  file(STRINGS ${CMAKE_CURRENT_SOURCE_DIR}/mutants/${name}.mutant through REGEX "^through: " LIMIT_COUNT 1)
  string(REPLACE "through: " "" through "${through}")
  if(NOT through)
    set(through ${source})
  endif()
endmacro()

# assay_mutant(NAME GATES WORD...): `verify WORD...` must fail, by these gates among others.
function(assay_mutant name gates)
  assay_mutant_source(${name})
  set(library assay_solver)
  if(through MATCHES "_dim\\.c$")
    set(library assay_solver_3d_baseline) # all scenes of these tests are in 3D
  endif()
  assay_mutate(${name} ${library})
  add_executable(mutant_${name} ${objects} $<TARGET_OBJECTS:assay_main>)
  target_link_libraries(mutant_${name} PRIVATE assay_verify)
  assay_test(mustfail-${name} LABELS gate mustfail ENVIRONMENT ASSAY_ISA=baseline
    COMMAND ${mustfail} mustfail/${name} ${gates}
    $<TARGET_FILE:assay> ${ARGN} -- $<TARGET_FILE:mutant_${name}> ${ARGN})
endfunction()

# assay_extreme_mutant(NAME DIM FAILING WORD...): of the rows of `extremes WORD...`, which are of bodies in DIM dimensions,
# so many must fail.
function(assay_extreme_mutant name dim failing)
  assay_mutant_source(${name})
  set(library assay_solver)
  if(through MATCHES "_dim\\.c$")
    set(library assay_solver_${dim}d_baseline)
  endif()
  assay_mutate(${name} ${library})
  add_executable(mutant_${name} ${objects} $<TARGET_OBJECTS:assay_main>)
  target_link_libraries(mutant_${name} PRIVATE assay_verify)
  assay_test(mustfail-${name} LABELS stability mustfail ENVIRONMENT ASSAY_ISA=baseline UNTRAPPED "it is broken"
    COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 1 "${failing} of these fail" $<TARGET_FILE:mutant_${name}> extremes
    ${ARGN})
endfunction()

# assay_unit_mutant(NAME UNIT TEST): this test of tests/unit/UNIT.c must fail, in any of the dimensions.
function(assay_unit_mutant name unit test)
  assay_mutant_source(${name})
  set(libraries assay_solver)
  if(through MATCHES "_dim\\.c$")
    set(libraries assay_solver_1d_baseline assay_solver_2d_baseline assay_solver_3d_baseline)
  elseif(through MATCHES "^verify/")
    set(libraries assay_verify)
  endif()
  assay_mutate(${name} ${libraries})
  foreach(library ${libraries}) # run once, and compiled each time
    target_compile_options(mutated_${name}_${library} PRIVATE -O1)
  endforeach()
  # The test's own objects, and of the frame all but a source that is broken: verify/trap.c.
  add_executable(mutant_${name} ${objects} $<TARGET_OBJECTS:test_${unit}>
    $<FILTER:${unit_frame},EXCLUDE,/${source}[.]>)
  string(REGEX MATCH "^[a-z]+" room ${unit})
  target_link_libraries(mutant_${name} PRIVATE assay_${room} PkgConfig::CUNIT OpenMP::OpenMP_C)
  assay_test(mustfail-${name} LABELS unit mustfail ENVIRONMENT ASSAY_ISA=baseline
    COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/mustfail_unit.sh ${test}
    $<TARGET_FILE:test_${unit}> $<TARGET_FILE:mutant_${name}>)
endfunction()

assay_mutant(gradient-correction "p,P" ${quick_sph})
assay_mutant(momentum-dissipation-sign "p,P" ${quick_sbp2})
assay_mutant(volume-dissipation-sign "p,P" ${quick_sbp2})
assay_mutant(corner-constraint "p,P" ${quick_sbp2})
assay_mutant(stress-one-percent "p,P" ${quick_sbp4})
assay_mutant(sbp2-boundary-weight "p,P" ${quick_sbp2})
assay_mutant(sbp4-boundary-weight "p,P" ${quick_sbp4})
assay_mutant(free-traction "p,P" ${quick_sbp2})
assay_mutant(rk2-weight "p,P" ${quick_sbp2})
assay_mutant(rk4-weight "p,P" ${quick_sbp4})
assay_mutant(body-force-late "rate p,rate x,rate P" mms "small waves, 1D")
assay_mutant(return-map-hardening "P_all" plastic-cube --levels 3 --set threads=1)
assay_mutant(plastic-memory "P_all" plastic-cube --levels 3 --set threads=1)

assay_extreme_mutant(flux-impedance-at-rest 3 1 stretch "upwind {p,F,H,J}, 3D")
assay_extreme_mutant(step-beyond-cfl 1 1 cfl "upwind sbp2 pF rk4, 1D")
assay_extreme_mutant(interface-mean-slope 1 1 contrast "upwind sbp2")
assay_extreme_mutant(interface-crossed 1 1 contrast "upwind sbp4")

assay_unit_mutant(slope-across-interface solver_run_composite "energy where materials meet")
assay_unit_mutant(single-step-without-meeting solver_run_composite
                  "a step for materials that differ ten thousand times")
assay_unit_mutant(jst-biharmonic-sign solver_jst "its work is the Laplacian's square")
assay_unit_mutant(ulsph-spin-sign solver_ulsph_gradients "linear velocity")
assay_unit_mutant(ulsph-divergence-correction solver_ulsph_forces "work of forces is that of stress")
assay_unit_mutant(ulsph-tension-factor solver_ulsph_forces "a constant tension")
assay_unit_mutant(ulsph-riemann-sign solver_ulsph_forces "Riemann term")
assay_unit_mutant(ulsph-diffusion-across solver_ulsph_diffusion "nothing crosses between materials")
assay_unit_mutant(ulsph-kernel-height solver_ulsph_pairs "kernel")
assay_unit_mutant(round-share solver_cloud_round "volumes")
assay_unit_mutant(round-area solver_cloud_round "divergence theorem")
assay_unit_mutant(simplex-inward solver_simplex "closure")
assay_unit_mutant(closure-narrow-sign solver_closure "matrix in single precision")
assay_unit_mutant(closure-weak-lost solver_closure "matrix in single precision")
assay_unit_mutant(closure-tiny-kept solver_closure "tiny changes")
assay_unit_mutant(solid-second-moments solver_cloud_solid "divergence theorem")
assay_unit_mutant(stl-one-side solver_stl "sharp edges")
assay_unit_mutant(skin-late solver_skin "two that close in")
assay_unit_mutant(contact-foresight solver_contact "two particles")
assay_unit_mutant(wall-impulse-share solver_wall "momentum of body and wall")
assay_unit_mutant(checkpoint-forgets-centre solver_checkpoint "every part that has something to hand on")
assay_unit_mutant(checkpoint-evolved-alone solver_checkpoint "every part that has something to hand on")
assay_unit_mutant(die-hollow solver_die "distance and normal")
assay_unit_mutant(die-one-side solver_die "sharp corners")
assay_unit_mutant(jst-fading solver_jst_plastic "each particle has the printed value")
assay_unit_mutant(wall-energy solver_balance "closes")
assay_unit_mutant(balance-jacobian-sign solver_balance "closes")
assay_unit_mutant(symmetry-tensor-sign solver_symmetry "as the whole")
assay_unit_mutant(shared-by-length solver_stencil_share "a lattice keeps equal rows once")
assay_unit_mutant(closed-one-pair solver_stencil "every builder in 2D")
assay_unit_mutant(sbp4-boundary-row solver_affine "what claims affine motions keeps them, 1D")
assay_unit_mutant(edge-traction solver_affine "what claims affine motions keeps them, 2D")
assay_unit_mutant(skew-normal solver_affine "what claims affine motions keeps them, 2D")
assay_unit_mutant(cofactor-rate solver_affine "what claims affine motions keeps them, 2D")
assay_unit_mutant(jacobian-rate solver_rotation "cells and their stress through a turn, 2D")
assay_unit_mutant(ulsph-spin-short solver_rotation "cells and their stress through a turn, 2D")
assay_unit_mutant(angular-last-stage solver_run_angular "a spinning body over 1000 steps, 2D")
assay_unit_mutant(angular-inertia-sign solver_run_angular "every integrator, and densities that differ")
assay_unit_mutant(angular-load-impulse solver_run_angular "loads turn the body")
assay_unit_mutant(plastic-forgotten solver_run_plastic "energy balance")
assay_unit_mutant(pressure-moment solver_pressure "the operator is symmetric and positive")
assay_unit_mutant(pressure-stray solver_pressure "volumes are kept")
assay_unit_mutant(ulsph-pair-volumes solver_run_momentum "linear momentum over 1000 steps, 2D")
assay_unit_mutant(index-without-safety verify_grid_convergence "a known limit")
assay_unit_mutant(front-of-cost-alone verify_trade "fronts")
assay_unit_mutant(study-without-sum verify_trade_file "damage")
assay_unit_mutant(order-of-equal-ratios verify_grid_convergence "a known limit")
assay_unit_mutant(limit-outward verify_grid_convergence "the printed example")
assay_unit_mutant(index-of-coarse-value verify_grid_convergence "a known limit")
assay_unit_mutant(oscillation-unseen verify_grid_convergence "no limit to be seen")
assay_unit_mutant(index-fits-any verify_grid_convergence "not yet settled")
assay_unit_mutant(order-may-change verify_grid_convergence "not yet settled")
assay_unit_mutant(error-order-may-change verify_grid_convergence "errors")
assay_unit_mutant(order-of-halves verify_study "power laws")
assay_unit_mutant(spectrum-without-frequencies solver_spectrum "a free bar has its frequencies")
assay_unit_mutant(spectrum-leaves-a-trace solver_spectrum "a spectrum leaves the run alone")
assay_unit_mutant(spectrum-one-sided solver_spectrum "a free bar has its frequencies")
assay_unit_mutant(stability-without-sum solver_spectrum "stability functions are the exponential to the order")
assay_unit_mutant(stable-step-without-scan solver_spectrum "shorter steps must hold too")
assay_unit_mutant(stable-step-of-real-parts solver_spectrum "stable steps are the known limits")
assay_unit_mutant(front-of-equals verify_trade "fronts")
assay_unit_mutant(front-of-no-use verify_trade "choices")
assay_unit_mutant(dearest-recommended verify_trade "choices")
assay_unit_mutant(no-number-reaches verify_trade "choices")
assay_unit_mutant(hash-without-overrides verify_trade_pick "refusals")
assay_unit_mutant(promotion-beaten-by-any verify_trade "promotion")
assay_unit_mutant(study-of-six-digits verify_trade_file "written and read")
assay_unit_mutant(study-with-any-key verify_trade_file "hostile files")
assay_unit_mutant(cost-without-stages verify_trade_run "costs")
assay_unit_mutant(bytes-of-one-particle verify_trade_run "costs")
assay_unit_mutant(time-of-the-last verify_trade_run "the best time")
assay_unit_mutant(pick-by-pairs verify_trade_pick "the fastest that reaches it")
assay_unit_mutant(pick-without-threads verify_trade_pick "what the run is told")
assay_unit_mutant(pick-of-another-scene verify_trade_pick "refusals")
assay_unit_mutant(trap-without-overflow verify_trap "strikes")
assay_unit_mutant(trap-in-one-thread verify_trap "does not strike")
assay_unit_mutant(trap-unasked verify_trap "does not strike")
assay_unit_mutant(minutes-of-seconds verify_pace "what is meant")
assay_unit_mutant(to-go-of-all verify_progress "time to go")
assay_unit_mutant(checkpoints-without-end verify_progress "due by steps or by time")
assay_unit_mutant(signal-never-ends verify_signals "what ends the program")
assay_unit_mutant(signal-twice-ends verify_signals "what comes is noted")
assay_unit_mutant(bisect-wrong-side verify_extremes "ends above and below")
assay_unit_mutant(bisect-upwards-alone verify_extremes "ends above and below")
assay_unit_mutant(row-of-no-number verify_extremes "rows")

# A mutant whose text is no longer in the source is an error: here, in a source that is broken already.
assay_test(mustfail-rotten-mutant LABELS mustfail COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 1
  "holds this text 0 times, expected once" ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/mutants/mutate.py
  mutants/rk4-weight ${CMAKE_CURRENT_SOURCE_DIR}/mutants/rk4-weight.mutant mutants/rotten.c)
