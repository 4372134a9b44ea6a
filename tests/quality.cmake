# The code itself under test: its form, what compilers and analysers say of it, and its memory errors.
set(quality ${CMAKE_CURRENT_LIST_DIR}/quality)
cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)

assay_test(quality-format LABELS unit COMMAND ${quality}/format.sh ${CMAKE_SOURCE_DIR})
assay_test(quality-forbidden LABELS unit COMMAND ${quality}/forbidden.sh ${CMAKE_SOURCE_DIR})
assay_test(quality-mustfail LABELS mustfail COMMAND ${quality}/mustfail.sh ${CMAKE_SOURCE_DIR})

# Builds of their own, kept between runs. The one with clang serves the analyser, as list of what to look at, valgrind,
# and the comparison of compilers; all paths of the hot loops are in it.
assay_test(quality-clang LABELS quality TIMEOUT 1800 CORES ${cores}
  COMMAND ${quality}/build.sh ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR}/clang debug -DCMAKE_C_COMPILER=clang-14
  -DASSAY_ARCH= "-DASSAY_DEBUG=-Og -g1 -gdwarf-4") # lines alone, for memcheck's reports
assay_test(quality-tidy LABELS quality TIMEOUT 1800 CORES ${cores}
  COMMAND ${quality}/tidy.sh ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR}/clang)
assay_test(quality-valgrind LABELS quality TIMEOUT 1800 CORES ${cores}
  COMMAND ${quality}/valgrind.sh ${CMAKE_BINARY_DIR}/clang)
set_tests_properties(quality-clang PROPERTIES FIXTURES_SETUP clang_build)
set_tests_properties(quality-tidy quality-valgrind PROPERTIES FIXTURES_REQUIRED clang_build)

assay_test(quality-sanitize LABELS quality TIMEOUT 1800 CORES ${cores} UNTRAPPED "its tests say for themselves"
  COMMAND ${quality}/sanitize.sh ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR}/sanitize)

# Another compiler, and no optimisation, against the stored records.
assay_test(quality-compilers LABELS quality TIMEOUT 600 CORES ${cores} UNTRAPPED "clang computes what it then discards"
  COMMAND ${quality}/compilers.sh ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR}/O0 ${CMAKE_BINARY_DIR}/clang)
set_tests_properties(quality-compilers PROPERTIES FIXTURES_REQUIRED clang_build)
