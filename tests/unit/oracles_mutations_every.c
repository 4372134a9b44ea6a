/* Faults that any oracle could have, put into every one there is, must be caught by the self-check of the true one.
 * What must at least be seen is a change a thousand times as large as the loosest bound of the check; the suite prints
 * what is seen. */
#include "oracles/oracle.h"
#include "tests/unit/spoilt_states.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void place(const double X[3], double t, double d, struct oracle_state *s)
{
    const double nearer[3] = {X[0] * (1 - d), X[1] * (1 - d), X[2] * (1 - d)}; /* still in the body */
    true_state(nearer, t, s);
}

static void clock_alone(const double X[3], double t, double d, struct oracle_state *s)
{
    true_state(X, t * (1 + d), s);
}

static void frequency(const double X[3], double t, double d, struct oracle_state *s)
{
    clock_alone(X, t, d, s);
    scale(s->v, 3, 1 + d);
    scale(s->p, 3, 1 + d);
}

static const struct {
    const char *name;
    spoil_state *state;
    spoil_energy *energy;
    spoil_extras *extras;
} mutations[] = {
    {"displacement", displacement, NULL, NULL},
    {"velocity", velocity, NULL, NULL},
    {"momentum", momentum, NULL, NULL},
    {"gradient", gradient, NULL, NULL},
    {"stress", stress, NULL, NULL},
    {"amplitude", amplitude, NULL, NULL},
    {"place", place, NULL, NULL},
    {"clock", clock_alone, NULL, NULL},
    {"frequency", frequency, NULL, NULL},
    {"kinetic energy", NULL, kinetic_energy, NULL},
    {"strain energy", NULL, strain_energy, NULL},
    {"both energies", NULL, both_energies, NULL},
    {"share of the energies", NULL, exchanged_energy, NULL},
    {"extra scalars", NULL, NULL, all_extras},
};

static void begin(const struct oracle_kind *kind, double value[ORACLE_PARAMETERS])
{
    char why[ORACLE_WHY] = "";
    memset(&now, 0, sizeof now);
    now.kind = kind;
    for (size_t i = 0; kind->parameter[i].name != NULL; i++) {
        value[i] = kind->parameter[i].typical;
    }
    CU_ASSERT_TRUE_FATAL(oracle_create(kind, value, &now.whole, why));
}

static void small_changes_are_caught(void)
{
    unit_untrapped();
    printf("\n");
    for (const struct oracle_kind *const *k = oracle_kinds(); *k != NULL; k++) {
        double value[ORACLE_PARAMETERS], loosest = 0;
        begin(*k, value);
        CU_ASSERT_FALSE(caught(&loosest)); /* going through the copy is no fault */
        for (size_t i = 0; i < sizeof mutations / sizeof *mutations; i++) {
            now.state = mutations[i].state;
            now.energy = mutations[i].energy;
            now.extras = mutations[i].extras;
            bool of_nothing = mutations[i].state == stress || mutations[i].energy == strain_energy;
            if ((now.extras != NULL && (*k)->extras == NULL) || (of_nothing && (*k)->rigid)) {
                continue;
            }
            double smallest = smallest_caught(-4, -14, 2);
            printf("    %-16s %-16s caught down to %.0e\n", (*k)->name, mutations[i].name, smallest);
            CU_ASSERT_TRUE(smallest <= 1e3 * loosest);
        }
        (*k)->destroy(now.whole);
    }
}

/* Every parameter off in the fields alone: a solution without a flaw, but of another problem. */
static void another_problem_is_caught(void)
{
    unit_untrapped();
    printf("\n");
    for (const struct oracle_kind *const *k = oracle_kinds(); *k != NULL; k++) {
        double value[ORACLE_PARAMETERS], loosest = 0;
        begin(*k, value);
        CU_ASSERT_FALSE(caught(&loosest));
        now.state = other_oracle;
        now.extras = other_extras;
        for (size_t i = 0; (*k)->parameter[i].name != NULL; i++) {
            double right = value[i], off = fmax(1e-8, 1e3 * loosest);
            for (int sign = -1; sign <= 1; sign += 2) {
                char why[ORACLE_WHY] = "";
                value[i] = right * (1 + sign * off);
                if (!oracle_create(*k, value, &now.other, why)) {
                    CU_ASSERT_TRUE(right == floor(right)); /* one that counts something cannot be off by so little */
                    continue;
                }
                bool seen = caught(NULL);
                if (!seen) {
                    printf("    %s: %s off by %.0e goes unseen\n", (*k)->name, (*k)->parameter[i].name, sign * off);
                }
                CU_ASSERT_TRUE(seen || right == 0);
                (*k)->destroy(now.other);
            }
            value[i] = right;
        }
        (*k)->destroy(now.whole);
    }
}

static void sign_of_P(const double X[3], double t, double d, struct oracle_state *s)
{
    (void)d;
    stress(X, t, -2, s);
}

static void nan_now_and_then(const double X[3], double t, double d, struct oracle_state *s)
{
    (void)d;
    true_state(X, t, s);
    s->P[0] = fmod(X[0] * 64, 8) < 1 ? NAN : s->P[0];
}

static void wrong_formulas_are_caught(void)
{
    unit_untrapped();
    static spoil_state *const states[] = {sign_of_v, sign_of_P, no_unit_matrix, frozen, nothing, nan_now_and_then};
    for (const struct oracle_kind *const *k = oracle_kinds(); *k != NULL; k++) {
        double value[ORACLE_PARAMETERS];
        begin(*k, value);
        for (size_t i = 0; i < sizeof states / sizeof *states; i++) {
            now.state = states[i];
            if (now.state == sign_of_P && (*k)->rigid) {
                continue;
            }
            bool seen = caught(NULL);
            if (!seen) {
                printf("%s: wrong formula %zu goes unseen\n", (*k)->name, i);
            }
            CU_ASSERT_TRUE(seen);
        }
        now.state = NULL;
        CU_ASSERT_FALSE(caught(NULL));
        now.energy = infinite_energy;
        CU_ASSERT_TRUE(caught(NULL));
        (*k)->destroy(now.whole);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"small changes are caught", small_changes_are_caught},
        {"another problem is caught", another_problem_is_caught},
        {"wrong formulas are caught", wrong_formulas_are_caught},
    };
    return unit_main("oracles: mutations of every kind", tests, sizeof tests / sizeof *tests);
}
