# The comparisons with stored results are must-fail tests: they change values and expect to be seen.
set_tests_properties(unit-golden_compare PROPERTIES LABELS "unit;golden;mustfail")
set_tests_properties(unit-golden_image PROPERTIES LABELS "unit;golden;image;mustfail")
