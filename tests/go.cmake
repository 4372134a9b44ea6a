# The command that everybody types first.
assay_test(go-sets-up LABELS unit COMMAND ${CMAKE_CURRENT_LIST_DIR}/go.sh ${CMAKE_SOURCE_DIR}/go)
