/* What the self-check of every oracle compares with, asked of every oracle there is. */
#include "tests/unit/one_oracle.h"

/* How many lines of a self-check begin with one of two texts. */
static size_t lines_of(const struct oracle_check *line, size_t count, const char *one, const char *other)
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        found += strncmp(line[i].law, one, strlen(one)) == 0 || strncmp(line[i].law, other, strlen(other)) == 0;
    }
    return found;
}

/* What no spoiled field can ask for: that the check compares the start, displacement and velocity, with what is given,
 * and the fields with a second evaluation. A rigid body's start is its momentum. */
static void its_check_knows_the_start_and_a_second_evaluation(void)
{
    for (const struct oracle_kind *const *k = oracle_kinds(); *k != NULL; k++) {
        struct oracle *oracle = create_with(*k, NULL);
        struct oracle_check line[ORACLE_LAWS];
        size_t count = 0;
        CU_ASSERT_TRUE(oracle_self_check(*k, oracle, line, &count));
        bool starts = lines_of(line, count, "initial displacement", "initial velocity") >= 2 || (*k)->rigid;
        bool twice = lines_of(line, count, "second evaluation: ", "modal series: ") >= 3;
        if (!starts || !twice) {
            printf("%s: its self-check %s\n", (*k)->name, starts ? "has no second evaluation" : "leaves out the start");
        }
        CU_ASSERT_TRUE(starts);
        CU_ASSERT_TRUE(twice);
        (*k)->destroy(oracle);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"knows the start, and a second evaluation", its_check_knows_the_start_and_a_second_evaluation},
    };
    return unit_main("oracles: self-checks", tests, sizeof tests / sizeof *tests);
}
