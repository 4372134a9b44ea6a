# Records as VTK reads them.
add_executable(record_sample ${CMAKE_CURRENT_SOURCE_DIR}/record_sample.c)
target_link_libraries(record_sample PRIVATE assay_solver)

include(${CMAKE_CURRENT_LIST_DIR}/system_python.cmake)
set(samples ${CMAKE_BINARY_DIR}/record_samples)
file(MAKE_DIRECTORY ${samples})
assay_test(record-sample LABELS unit COMMAND record_sample ${samples})
assay_test(record-vtk LABELS unit SKIP_CODE 77
  COMMAND ${ASSAY_SYSTEM_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/vtk_reader.py ${samples})
set_tests_properties(record-sample PROPERTIES FIXTURES_SETUP record_samples)
set_tests_properties(record-vtk PROPERTIES FIXTURES_REQUIRED record_samples)
