# Records as VTK reads them. Debian's python3-vtk9 belongs to /usr/bin/python3, which need not be the first in PATH.
add_executable(record_sample ${CMAKE_CURRENT_SOURCE_DIR}/record_sample.c)
target_link_libraries(record_sample PRIVATE assay_solver)

find_program(ASSAY_SYSTEM_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
if(NOT ASSAY_SYSTEM_PYTHON)
  find_program(ASSAY_SYSTEM_PYTHON NAMES python3 REQUIRED)
endif()
set(samples ${CMAKE_BINARY_DIR}/record_samples)
file(MAKE_DIRECTORY ${samples})
assay_test(record-sample LABELS unit COMMAND record_sample ${samples})
assay_test(record-vtk LABELS unit SKIP_CODE 77
  COMMAND ${ASSAY_SYSTEM_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/vtk_reader.py ${samples})
set_tests_properties(record-sample PROPERTIES FIXTURES_SETUP record_samples)
set_tests_properties(record-vtk PROPERTIES FIXTURES_REQUIRED record_samples)
