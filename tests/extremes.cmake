# Extremes: where schemes work, held to what is asked of them, and that the map notices what does not.
foreach(extreme scale place alternating poisson stretch perturbed impact contrast small spin)
  assay_test(extremes-${extreme} LABELS stability gate COMMAND $<TARGET_FILE:assay> extremes ${extreme})
endforeach()
foreach(extreme cfl vibration)
  assay_test(extremes-${extreme} LABELS stability gate slow COMMAND $<TARGET_FILE:assay> extremes ${extreme})
endforeach()
# Without its dissipation JST lets the alternating mode live.
assay_test(extremes-notice-no-damping LABELS stability mustfail COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 1
  "36 of these fail" $<TARGET_FILE:assay> extremes alternating --set jst.kappa4=0 --set scheme=jst)
assay_test(extremes-know-their-names LABELS unit COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 2
  "did you mean scale" $<TARGET_FILE:assay> extremes scales)
