# What is installed: whole, where it was moved to, and of use to other projects.
set(cli sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh)
set(here ${CMAKE_CURRENT_SOURCE_DIR}/install)
set(installed ${CMAKE_BINARY_DIR}/installed)
set(prefix ${installed}/moved)
set(share ${prefix}/${CMAKE_INSTALL_DATADIR}/assay)
set(program ${prefix}/${CMAKE_INSTALL_BINDIR}/assay)

# Here too, so that the analyser sees them.
add_executable(install_libraries ${here}/libraries/libraries.c)
target_link_libraries(install_libraries PRIVATE assay_golden assay_oracles assay_render)
add_executable(example_pulse ${CMAKE_SOURCE_DIR}/examples/pulse-c/pulse.c)
target_link_libraries(example_pulse PRIVATE assay_oracles)

# Staged by DESTDIR, then moved: nothing may depend on where it was meant to be.
assay_test(install LABELS gate COMMAND sh ${here}/install.sh ${CMAKE_COMMAND} ${CMAKE_BINARY_DIR} ${installed} ${share})
set_tests_properties(install PROPERTIES FIXTURES_SETUP installed FIXTURES_REQUIRED program)

function(assay_install_test name)
  assay_test(install-${name} ${ARGN})
  set_property(TEST install-${name} APPEND PROPERTY FIXTURES_REQUIRED installed)
endfunction()

# The program finds what lies beside it, and not the source that it was built from.
assay_install_test(own-scenes LABELS gate COMMAND ${cli} 0 "A scene of its own" ${program} list scenes)
assay_install_test(own-golden LABELS gate mustfail COMMAND ${cli} 2 "${share}/golden/own.vtkhdf: there is no such golden record"
  ${program} golden check own --out ${installed}/out)

# The manual page, as those checkers see it that are there.
assay_install_test(manual LABELS unit mustfail SKIP_CODE 77
  COMMAND sh ${here}/manual.sh ${prefix}/${CMAKE_INSTALL_MANDIR}/man1/assay.1)

# Programs in C: by pkg-config and by CMake, with the oracles alone and with all libraries.
assay_install_test(pkg-config LABELS gate COMMAND sh ${here}/pkg_config.sh ${CMAKE_C_COMPILER}
  ${prefix}/${CMAKE_INSTALL_LIBDIR}/pkgconfig ${here}/libraries ${share} ${installed}/pkg-config)
# project(NAME FOLDER WORD...): configures, builds and tests another project that finds what is installed.
function(project_test name folder)
  assay_install_test(${name} LABELS gate ${ARGN} COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${folder}
    ${installed}/${name} --build-generator Ninja --build-options -DCMAKE_PREFIX_PATH=${prefix} ${options}
    --test-command ${CMAKE_CTEST_COMMAND} --output-on-failure --no-tests=error)
endfunction()
set(options -DCMAKE_C_COMPILER=${CMAKE_C_COMPILER})
project_test(libraries ${here}/libraries)
project_test(pulse ${share}/examples/pulse-c)
# A solver in another language, judged right, and broken copies of it, judged wrong.
set(options "")
project_test(bar ${share}/examples/bar-python mustfail)
set_tests_properties(install-bar PROPERTIES SKIP_REGULAR_EXPRESSION "no Python 3")

# Gates of another project: those that must fail say why.
assay_install_test(gates LABELS gate COMMAND ${CMAKE_COMMAND} -G Ninja -S ${here}/gates -B ${installed}/gates
  -DCMAKE_PREFIX_PATH=${prefix})
set_tests_properties(install-gates PROPERTIES FIXTURES_SETUP installed-gates)
function(gate_ends code name text)
  assay_install_test(gate-${name} LABELS gate mustfail COMMAND ${cli} ${code} ${text} ${CMAKE_CTEST_COMMAND}
    --test-dir ${installed}/gates --no-tests=error -R "^${name}$" -V)
  set_property(TEST install-gate-${name} APPEND PROPERTY FIXTURES_REQUIRED installed-gates)
endfunction()
set(failed 8) # so ctest ends if a test fails
gate_ends(0 right "bar-20.csv")
gate_ends(${failed} wrong "a gate does not hold")
gate_ends(${failed} ends-badly "the command ended with 3")
gate_ends(${failed} left-from-before "the command has not written")
gate_ends(${failed} no-such-oracle "no oracle \"none\"")
gate_ends(${failed} not-wrong "all gates hold, but must not: u")
gate_ends(${failed} wrong-by-another "the gate \"rate u\" holds, but must not")
gate_ends(0 picture "PASS")
gate_ends(0 picture-other "FAIL")
gate_ends(${failed} picture-wrong "the picture differs from")
gate_ends(${failed} picture-not-wrong "the pictures show the same, but must not")
gate_ends(${failed} picture-sizes "nothing could be judged: the program ended with 2")
gate_ends(0 picture-tolerance "PASS")

# What no gate can be made of is refused at once; so is a library that there is not.
function(gate_refused name text)
  assay_install_test(refused-${name} LABELS mustfail COMMAND ${cli} 1 ${text} ${CMAKE_COMMAND}
    -DPACKAGE=${prefix}/${CMAKE_INSTALL_LIBDIR}/cmake/assay -DCASE=${name} -P ${here}/refused.cmake)
endfunction()
gate_refused(no-bound "needs ERROR or ORDER")
gate_refused(one-level "an ORDER is observed between two levels")
gate_refused(one-result "RESULT must hold @LEVEL@")
gate_refused(no-command "needs COMMAND")
gate_refused(nothing-follows "nothing follows ORDER")
gate_refused(wrong-keyword "knows no ORDERS")
gate_refused(no-image "needs IMAGE")
gate_refused(no-component "knows no library \"oracle\"")
gate_refused(no-language "its libraries need the language C")
gate_refused(version "were considered but not accepted")
