/* Text that a terminal may be shown: what drives one is gone, and whatever language it is in stays. */
#include "solver/error.h"
#include "tests/unit/unit.h"

#include <stdio.h>
#include <string.h>

static void expect(const char *text, const char *plain)
{
    char made[64];
    (void)snprintf(made, sizeof made, "%s", text);
    solver_plain(made, false);
    if (strcmp(made, plain) != 0) {
        printf("\n    expected \"%s\", got \"%s\"", plain, made);
    }
    CU_ASSERT_STRING_EQUAL(made, plain);
}

static void test_stays(void)
{
    expect("", "");
    expect("a plain line, 100 % ~", "a plain line, 100 % ~");
    expect("Stra\303\237e, \345\233\272\344\275\223, \360\237\247\212",
           "Stra\303\237e, \345\233\272\344\275\223, \360\237\247\212");
    expect("\302\240", "\302\240"); /* the first character after the controls */
}

static void test_goes(void)
{
    expect("\033[2J\033]0;title\007", "?[2J?]0;title?");
    expect("one\ntwo\tthree\rfour", "one two three?four");
    expect("\177", "?");
    expect("\302\2332J", "??2J"); /* CSI as one character */
    expect("\2332J", "?2J");      /* and as one byte */
    expect("\303", "?");          /* cut short */
    expect("\345\233", "??");
    expect("\300\233", "??");           /* an escape in two bytes */
    expect("\340\200\233", "???");      /* and in three */
    expect("\340\202\233", "???");      /* CSI in three */
    expect("\360\200\200\233", "????"); /* an escape in four */
    expect("\355\240\200", "???");      /* half of a surrogate pair */
    expect("\364\220\200\200", "????"); /* beyond the last character */
    expect("\377\376", "??");
}

static void test_errors(void)
{
    struct solver_error error;
    CU_ASSERT_FALSE(solver_fail(&error, SOLVER_BAD_INPUT, "%s: no such scene", "a\033[31m\tb,\n  or c"));
    CU_ASSERT_STRING_EQUAL(error.text, "a?[31m b,\n  or c: no such scene"); /* what there is may be listed in lines */
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"what is printable stays", test_stays},
        {"what drives a terminal goes", test_goes},
        {"errors are plain", test_errors},
    };
    return unit_main("plain text", tests, sizeof tests / sizeof *tests);
}
