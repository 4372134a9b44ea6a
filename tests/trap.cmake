# All tests run with floating-point traps (CMakeLists.txt). That these strike: a scene that starts with 1/0 m/s is refused
# without them, and ends the program with them, by an exit code of its own. Registered wherever there should be traps, so
# that their loss shows.
if(CMAKE_C_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$" AND CMAKE_SYSTEM_NAME STREQUAL "Linux")
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/scenes/divides-by-zero.lua @ONLY CONTENT
    "title, dim, n, t_end = 'divides by zero', 1, 8, 1
domain = { lower = {0}, upper = {1} }
material = { model = 'linear-elastic', E = 1, nu = 0.3, rho = 1 }
initial = { velocity = function(X) return 1 / X end }
")
  set(divides $<TARGET_FILE:assay> run ${CMAKE_BINARY_DIR}/scenes/divides-by-zero.lua --out test-out/trap)
  assay_test(trap-strikes LABELS unit mustfail COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 99
    "ASSAY_TRAP: division by zero" ${divides})
  assay_test(trap-not-asked-for LABELS unit UNTRAPPED "this is what it does without" COMMAND
    sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 2 "velocity" ${divides})
endif()
