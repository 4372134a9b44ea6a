#include "tests/unit/unit.h"

#include "verify/trap.h"

#include <CUnit/Basic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool were_set;

void unit_untrapped(void)
{
    were_set = verify_trap_suspend() || were_set;
}

/* After each test as well, however it ended. */
void unit_trapped(void)
{
    verify_trap_resume(were_set);
    were_set = false;
}

int unit_main(const char *suite, const struct unit_test *tests, size_t count)
{
    verify_trap_from_environment();
    if (CU_initialize_registry() != CUE_SUCCESS) {
        return 2;
    }
    CU_pSuite registered = CU_add_suite_with_setup_and_teardown(suite, NULL, NULL, NULL, unit_trapped);
    const char *only = getenv("UNIT_ONLY");
    for (size_t i = 0; i < count; i++) {
        if (only != NULL && *only != '\0' && strcmp(only, tests[i].name) != 0) {
            continue;
        }
        if (registered == NULL || CU_add_test(registered, tests[i].name, tests[i].run) == NULL) {
            (void)fprintf(stderr, "%s: cannot add test %s: %s\n", suite, tests[i].name, CU_get_error_msg());
            return 2;
        }
    }
    CU_basic_set_mode(CU_BRM_VERBOSE);
    (void)CU_basic_run_tests();
    bool passed = CU_get_number_of_failures() == 0 && CU_get_number_of_asserts() > 0;
    CU_cleanup_registry();
    return passed ? 0 : 1;
}
