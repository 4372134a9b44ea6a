/* Runs one CUnit suite and turns the result into an exit code. A suite without assertions fails. Where a checker
 * is too slow for all tests, the environment's UNIT_ONLY names those to run, and UNIT_WITHOUT those to leave out, with
 * | between names; a name that no test has fails. With UNIT_FEW tests that go through a list of settings may take only
 * some of them (one_oracle.h). */
#ifndef TESTS_UNIT_H
#define TESTS_UNIT_H

#include <CUnit/CUnit.h>
#include <stddef.h>

struct unit_test {
    const char *name;
    void (*run)(void);
};

/* Infinities and NaN are handed over on purpose from here on: floating-point traps (verify/trap.h) stay away until the
 * second, or else to the end of the test. */
void unit_untrapped(void);
void unit_trapped(void);

/* Call from main: `return unit_main("cloud", tests, sizeof tests / sizeof *tests);` */
int unit_main(const char *suite, const struct unit_test *tests, size_t count);

#endif
