# The comparison with stored results is a must-fail test: it changes values and expects to be seen.
set_tests_properties(unit-golden_compare PROPERTIES LABELS "unit;golden;mustfail")
