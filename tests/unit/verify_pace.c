/* How often checkpoints are written, as the command line spells it. */
#include "tests/unit/unit.h"
#include "verify/pace.h"

#include <stdio.h>

static void what_is_meant(void)
{
    static const struct {
        const char *text;
        struct verify_pace pace;
    } cases[] = {{"1", {1, 0}},       {"500", {500, 0}},   {"30s", {0, 30}},
                 {"0.5s", {0, 0.5}},  {"10min", {0, 600}}, {"2h", {0, 7200}},
                 {"1.5h", {0, 5400}}, {"1e3s", {0, 1000}}, {"123456789012345", {123456789012345, 0}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct verify_pace pace;
        CU_ASSERT(verify_pace_read(cases[i].text, &pace));
        CU_ASSERT_EQUAL(pace.steps, cases[i].pace.steps);
        CU_ASSERT_EQUAL(pace.seconds, cases[i].pace.seconds);
    }
}

static void what_is_refused(void)
{
    unit_untrapped();
    static const char *const texts[] = {
        "",    "0",      "-5",        "5.5", "s",     "0s", "-1s", "1e999h", "nan", "inf",
        "10m", "10 min", "10minutes", "1d",  "0x10s", " 5", "5 ",  "+5",     "1s2", "9999999999999999"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct verify_pace pace;
        bool read = verify_pace_read(texts[i], &pace);
        if (read) {
            (void)printf("\n    \"%s\" is taken", texts[i]);
        }
        CU_ASSERT_FALSE(read);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"what is meant", what_is_meant},
        {"what is refused", what_is_refused},
    };
    return unit_main("pace", tests, sizeof tests / sizeof *tests);
}
