# Pictures: the comparison of pictures calibrated by mutations, and a gallery to look at in BUILD/pictures.
foreach(program calibration gallery)
  add_executable(image_${program} ${CMAKE_CURRENT_SOURCE_DIR}/image/${program}.c ${CMAKE_CURRENT_SOURCE_DIR}/image/body.c)
  target_link_libraries(image_${program} PRIVATE assay_render)
endforeach()
set(pictures ${CMAKE_BINARY_DIR}/pictures)
file(MAKE_DIRECTORY ${pictures})

foreach(mutation identical round-off shift-right shift-down-left)
  assay_test(image-forgives-${mutation} LABELS image COMMAND image_calibration ${mutation} same ${pictures})
endforeach()
foreach(mutation shift-three range-up range-down range-shift mirrored missing-quad nan field-error)
  assay_test(image-sees-${mutation} LABELS image mustfail COMMAND image_calibration ${mutation} different ${pictures})
endforeach()

# The same bytes for any number of rasteriser threads; the same look from another rasteriser, and from one that runs
# with narrower vectors, as on another machine.
assay_test(image-gallery LABELS image COMMAND image_gallery ${pictures})
assay_test(image-threads LABELS image COMMAND image_gallery ${pictures}/threads ${pictures} bytes
  ENVIRONMENT LP_NUM_THREADS=0)
assay_test(image-narrow LABELS image COMMAND image_gallery ${pictures}/narrow ${pictures} look
  ENVIRONMENT LP_NATIVE_VECTOR_WIDTH=128)
assay_test(image-softpipe LABELS image COMMAND image_gallery ${pictures}/softpipe ${pictures} look
  ENVIRONMENT GALLIUM_DRIVER=softpipe)
set_tests_properties(image-gallery PROPERTIES FIXTURES_SETUP gallery)
set_tests_properties(image-threads image-narrow image-softpipe PROPERTIES FIXTURES_REQUIRED gallery)
