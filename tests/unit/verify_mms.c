/* The suite of manufactured solutions judges: claims that hold, claims too high, and claims of what nobody measured. */
#include "tests/unit/unit.h"
#include "verify/mutations.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char path[] = TEST_SOURCE_DIR "/verify/scenes/manufactured.lua";

/* A bar of two coarse levels. */
static struct verify_mms_case bar(void)
{
    return (struct verify_mms_case){.family = "bar",
                                    .scene = "manufactured",
                                    .path = path,
                                    .setting_count = 3,
                                    .setting = {"dim=1", "stencil=sbp2", "amplitude=0.3"},
                                    .level = {16, 32}};
}

static struct verify_mms_result judged(enum verify_mms_variable variable, double order)
{
    struct verify_mms_case which = bar();
    struct verify_mms_result result;
    which.asked[variable] = order;
    CU_ASSERT(verify_mms_claims(&which));
    verify_mms_run(&which, NULL, &result);
    CU_ASSERT_FATAL(result.ran);
    return result;
}

static void orders_are_held_to_their_claims(void)
{
    struct verify_mms_result result = judged(VERIFY_MMS_OF_P, 1.5);
    CU_ASSERT(result.pass && result.asked[VERIFY_MMS_OF_P] && !result.asked[VERIFY_MMS_OF_p]);
    CU_ASSERT(result.order[VERIFY_MMS_OF_P] > 1.5 && result.order[VERIFY_MMS_OF_P] < 3);
    CU_ASSERT(!judged(VERIFY_MMS_OF_P, 3).pass);
}

static void what_is_not_measured_is_not_held(void)
{
    struct verify_mms_result result = judged(VERIFY_MMS_OF_H, 0.5); /* in a line H is 1: there is no relative error */
    CU_ASSERT(isnan(result.finest[VERIFY_MMS_OF_H]));
    CU_ASSERT(result.asked[VERIFY_MMS_OF_H]);
    CU_ASSERT(!result.pass);
}

static void what_does_not_run_is_not_held(void)
{
    struct verify_mms_case which = bar();
    struct verify_mms_result result;
    (void)snprintf(which.setting[0], VERIFY_MMS_TEXT, "dim=4");
    which.asked[VERIFY_MMS_OF_p] = 1;
    verify_mms_run(&which, NULL, &result);
    CU_ASSERT(!result.ran && !result.pass);
    CU_ASSERT(result.error.code == SOLVER_BAD_INPUT);
}

static void claims_are_of_what_is_measured(void)
{
    struct verify_mms_case *cases = NULL;
    size_t count = 0;
    struct solver_error error;
    CU_ASSERT_FATAL(verify_mms_cases(&cases, &count, &error));
    size_t claiming = 0;
    for (size_t i = 0; i < count; i++) {
        bool of_line = false;
        for (size_t s = 0; s < cases[i].setting_count; s++) {
            of_line = of_line || (cases[i].setting[s][0] == 'd' && cases[i].setting[s][4] == '1');
        }
        CU_ASSERT(!of_line || cases[i].asked[VERIFY_MMS_OF_H] == 0);
        CU_ASSERT(cases[i].level[0] > 0 && cases[i].level[1] > cases[i].level[0]);
        claiming += verify_mms_claims(&cases[i]) ? 1 : 0;
    }
    CU_ASSERT(claiming > 100);
    free(cases);
}

static void a_mutation_must_be_noticed(void)
{
    struct verify_mutation mutation = {.what = "something"};
    CU_ASSERT(verify_mutation_missed(&mutation));
    (void)snprintf(mutation.caught, sizeof mutation.caught, "gate \"p\"");
    CU_ASSERT(!verify_mutation_missed(&mutation));
    mutation.control = true; /* nothing was wrong, and a gate failed */
    CU_ASSERT(verify_mutation_missed(&mutation));
    mutation.caught[0] = '\0';
    CU_ASSERT(!verify_mutation_missed(&mutation));
    mutation.failed = true;
    CU_ASSERT(verify_mutation_missed(&mutation));
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"orders are held to their claims", orders_are_held_to_their_claims},
        {"what is not measured is not held", what_is_not_measured_is_not_held},
        {"what does not run is not held", what_does_not_run_is_not_held},
        {"claims are of what is measured", claims_are_of_what_is_measured},
        {"a mutation must be noticed", a_mutation_must_be_noticed},
    };
    return unit_main("manufactured solutions", tests, sizeof tests / sizeof *tests);
}
