# What `cmake --install BUILD --prefix P` puts in place. Nothing in it names P: it may be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(assay_include ${CMAKE_INSTALL_INCLUDEDIR}/assay) # headers name each other as "ROOM/FILE.h"
set(assay_package ${CMAKE_INSTALL_LIBDIR}/cmake/assay)
# For the program, which looks for its scenes from where it lies itself.
get_filename_component(assay_bin ${CMAKE_INSTALL_BINDIR} NAME)
file(RELATIVE_PATH assay_share ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_DATADIR}/assay)

# Public headers: what a room is called by, and what those need. verify/ is the program, and no library.
set(public_solver error cost hardening shape grading cloud scene run record checkpoint)
set(public_oracles oracle)
set(public_render render)
set(public_golden golden)
foreach(room solver oracles render golden)
  set_target_properties(assay_${room} PROPERTIES EXPORT_NAME ${room})
  install(TARGETS assay_${room} EXPORT assay-${room} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    INCLUDES DESTINATION ${assay_include})
  list(TRANSFORM public_${room} REPLACE "(.+)" "${CMAKE_SOURCE_DIR}/${room}/\\1.h" OUTPUT_VARIABLE headers)
  install(FILES ${headers} DESTINATION ${assay_include}/${room})
  # One file per room: who wants oracles alone needs nothing of what the others need.
  install(EXPORT assay-${room} NAMESPACE assay:: DESTINATION ${assay_package})
endforeach()

install(TARGETS assay EXPORT assay-program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(EXPORT assay-program NAMESPACE assay:: DESTINATION ${assay_package})
configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/assayConfig.cmake.in ${CMAKE_BINARY_DIR}/assayConfig.cmake
  INSTALL_DESTINATION ${assay_package} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/assayConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/assayConfig.cmake ${CMAKE_BINARY_DIR}/assayConfigVersion.cmake
  cmake/assayGates.cmake cmake/assayGateRun.cmake DESTINATION ${assay_package})

file(RELATIVE_PATH assay_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" assay_prefix ${assay_prefix})
foreach(package assay assay-oracles)
  configure_file(cmake/${package}.pc.in ${CMAKE_BINARY_DIR}/${package}.pc @ONLY)
  install(FILES ${CMAKE_BINARY_DIR}/${package}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

install(DIRECTORY verify/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/assay FILES_MATCHING PATTERN "*.lua")
install(DIRECTORY golden DESTINATION ${CMAKE_INSTALL_DATADIR}/assay
  FILES_MATCHING PATTERN "*.vtkhdf" PATTERN "*.png")
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/assay)

# The program writes its own page, so that the two cannot drift apart.
set(manual ${CMAKE_BINARY_DIR}/assay.1)
add_custom_command(TARGET assay POST_BUILD COMMAND assay --manual > ${manual} BYPRODUCTS ${manual} VERBATIM)
install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
