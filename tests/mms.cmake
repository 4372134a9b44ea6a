# Manufactured solutions: every combination that claims an order has it, and what is told wrongly on purpose is noticed.
assay_test(mms-orders LABELS mms gate TIMEOUT 600 COMMAND $<TARGET_FILE:assay> verify mms claims
  --out mms/orders --json mms/orders.json)
# What claims none runs too, and is told.
assay_test(mms-all LABELS mms gate slow TIMEOUT 900 CORES ${cores} COMMAND $<TARGET_FILE:assay> verify mms --out mms/all)
assay_test(mms-mutations LABELS mms mustfail TIMEOUT 600 COMMAND $<TARGET_FILE:assay> verify --mutations)
# One scene of each family, as a user runs it.
foreach(scene manufactured manufactured-isochoric manufactured-waves manufactured-flow)
  assay_test(gate-${scene} LABELS mms gate COMMAND $<TARGET_FILE:assay> verify ${scene} --out gates/${scene})
endforeach()
assay_test(mms-knows-its-families LABELS unit COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 2
  "no family of studies is called \"in space\"" $<TARGET_FILE:assay> verify mms "in space")
assay_test(mms-takes-no-keys LABELS unit COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 2
  "takes neither --set nor --levels" $<TARGET_FILE:assay> verify mms --set n=8)
assay_test(mutations-stand-alone LABELS unit COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 2 "stands alone"
  $<TARGET_FILE:assay> verify swinging-cube --mutations)
assay_test(verify-takes-one-scene LABELS unit COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 2
  "\"rings\" is one word too many" $<TARGET_FILE:assay> verify swinging-cube rings)
assay_test(manufactured-of-one-material LABELS unit COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 2
  "there is no oracle \"manufactured-stretch-rubber-2d\"" $<TARGET_FILE:assay> oracle manufactured-stretch-rubber-2d
  --grid 0:1:2,0:1:2 --time 0.1)
# What moved faces put in is not measured: nothing is said of the energy gained, least of all that it came from nothing.
assay_test(manufactured-run LABELS unit COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 0 "energy gained      not known"
  $<TARGET_FILE:assay> run manufactured --set n=8 --out mms/run)
assay_test(manufactured-by-motion LABELS unit COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 2
  "a scene names the motion alone" $<TARGET_FILE:assay> verify manufactured --set
  oracle.name=manufactured-stretch-neo-hookean-2d)
# The body is driven by what the scene says, the judge told something else: were the drive to follow it, all would agree.
assay_test(manufactured-told-wrongly LABELS mms mustfail COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh 1
  "FAIL: a gate does not hold" $<TARGET_FILE:assay> verify manufactured --set oracle.amplitude=0.9 --out mms/told)
