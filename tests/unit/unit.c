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

/* Names in a list, with | between. */
static size_t names_in(const char *list)
{
    size_t count = list != NULL && *list != '\0';
    for (const char *c = list; count > 0 && *c != '\0'; c++) {
        count += *c == '|';
    }
    return count;
}

static bool lists(const char *list, const char *name)
{
    size_t length = strlen(name);
    for (const char *at = list; at != NULL; at = strchr(at, '|')) {
        at += *at == '|';
        if (strncmp(at, name, length) == 0 && (at[length] == '|' || at[length] == '\0')) {
            return true;
        }
    }
    return false;
}

/* Tests whose names are in the list; says so if it has names that no test has. */
static bool all_known(const char *list, const struct unit_test *tests, size_t count)
{
    size_t known = 0;
    for (size_t i = 0; i < count; i++) {
        known += lists(list, tests[i].name);
    }
    if (known != names_in(list)) {
        (void)fprintf(stderr, "%zu of the tests in \"%s\" are there, not all\n", known, list);
    }
    return known == names_in(list);
}

int unit_main(const char *suite, const struct unit_test *tests, size_t count)
{
    verify_trap_from_environment();
    if (CU_initialize_registry() != CUE_SUCCESS) {
        return 2;
    }
    CU_pSuite registered = CU_add_suite_with_setup_and_teardown(suite, NULL, NULL, NULL, unit_trapped);
    const char *only = getenv("UNIT_ONLY"), *without = getenv("UNIT_WITHOUT");
    if (!all_known(only, tests, count) || !all_known(without, tests, count)) {
        CU_cleanup_registry();
        return 2;
    }
    for (size_t i = 0; i < count; i++) {
        if ((names_in(only) > 0 && !lists(only, tests[i].name)) || lists(without, tests[i].name)) {
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
