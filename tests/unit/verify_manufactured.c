/* Manufactured solutions as oracles: every motion of every material in every dimension proves itself, also where it is
 * hard, and what is not one is not taken for one. */
#include "tests/unit/unit.h"
#include "verify/manufactured.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PARAMETERS = 6, ALL = 8 };

/* L, period, amplitude as a part of the largest, E, nu, rho */
static const double settings[][PARAMETERS] = {
    {1, 1, 0.5, 1, 0.3, 1},
    {1e-9, 1e-12, 1, 2e11, 0.4999, 7800}, /* small, stiff, hardly compressible, as large as it may be */
    {1e6, 3e7, 1e-3, 1, -0.9, 1e-3},
};

static void proves_itself(const struct oracle_kind *kind, const double setting[PARAMETERS], bool flows)
{
    double value[ALL];
    char why[ORACLE_WHY];
    struct oracle *oracle = NULL;
    struct oracle_check line[ORACLE_LAWS];
    size_t count = 0;
    memcpy(value, setting, PARAMETERS * sizeof *value);
    value[2] *= kind->parameter[2].upper;
    value[6] = (flows ? 1e-3 : 0) * value[2] * value[3]; /* yield stress and hardening of what may flow */
    value[7] = 0.1 * value[3];
    CU_ASSERT_FATAL(oracle_create(kind, value, &oracle, why));
    bool proven = oracle_self_check(kind, oracle, line, &count);
    for (size_t i = 0; i < count; i++) {
        if (!oracle_law_holds(&line[i])) {
            printf("%s, L = %g m: %s: %.2e > %.2e\n", kind->name, value[0], line[i].law, line[i].residual,
                   line[i].bound);
        }
    }
    CU_ASSERT(proven);
    CU_ASSERT(count >= 9);
    CU_ASSERT_EQUAL(kind->outside(oracle, (double[3]){0.5 * value[0], 0.5 * value[0], 0.5 * value[0]}), 0);
    CU_ASSERT_DOUBLE_EQUAL(kind->outside(oracle, (double[3]){-3 * value[0], value[0], 0}), 3 * value[0],
                           1e-12 * value[0]);
    kind->destroy(oracle);
}

static void every_kind_proves_itself(void)
{
    size_t kinds = 0;
    for (const struct oracle_motion *motion = oracle_motions(); motion->name != NULL; motion++) {
        for (const struct solver_material_model *model = solver_material_models(); model->name != NULL; model++) {
            for (int dim = motion->least_dim; dim <= 3; dim++) {
                char shortened[96], whole[96];
                (void)snprintf(shortened, sizeof shortened, "manufactured-%s", motion->name);
                (void)snprintf(whole, sizeof whole, "manufactured-%s-%s-%dd", motion->name, model->name, dim);
                const struct oracle_kind *kind = verify_kind_find(whole);
                CU_ASSERT_PTR_NOT_NULL_FATAL(kind);
                CU_ASSERT_PTR_EQUAL(kind, verify_manufactured_find(shortened, model->name, dim));
                CU_ASSERT_EQUAL(kind->dim, dim);
                CU_ASSERT(verify_is_manufactured(kind));
                for (size_t i = 0; i < (dim < 3 ? sizeof settings / sizeof *settings : 1); i++) {
                    proves_itself(kind, settings[i], false);
                    if (verify_plastic_strain_extra(kind) >= 0) {
                        proves_itself(kind, settings[i], true);
                    }
                }
                kinds++;
            }
        }
    }
    CU_ASSERT(kinds >= 24);
}

static void others_are_none(void)
{
    const struct oracle_kind *cube = verify_kind_find("swinging-cube");
    CU_ASSERT_PTR_NOT_NULL_FATAL(cube);
    CU_ASSERT(!verify_is_manufactured(cube));
    CU_ASSERT_PTR_NULL(verify_kind_find("manufactured-stretch"));
    CU_ASSERT_PTR_NULL(verify_kind_find("manufactured-isochoric-neo-hookean-1d")); /* nothing moves in one dimension */
    CU_ASSERT_PTR_NULL(verify_manufactured_find("manufactured-stretch", "rubber", 2));
    CU_ASSERT_PTR_NULL(verify_manufactured_find("manufactured-stretch", "neo-hookean", 4));
}

/* Where nothing accelerates and stress is constant, nothing is needed; where the body is at rest, only the motion's
 * own. */
static void no_force_where_none_is_needed(void)
{
    const struct oracle_kind *kind = verify_kind_find("manufactured-stretch-neo-hookean-2d");
    const struct oracle_kind *cube = verify_kind_find("swinging-cube");
    double value[PARAMETERS] = {1, 1, 1, 1, 0.3, 1}, force[3];
    char why[ORACLE_WHY];
    struct oracle *oracle = NULL;
    CU_ASSERT_FATAL(oracle_create(kind, value, &oracle, why));
    verify_body_force(kind, oracle, (double[3]){0.2, 0.7, 0}, 0.1, force);
    CU_ASSERT(fabs(force[0]) > 1e-3 && fabs(force[1]) > 1e-3);
    CU_ASSERT_EQUAL(force[2], 0);
    kind->destroy(oracle);
    verify_body_force(cube, NULL, (double[3]){0.2, 0.7, 0}, 0.1, force);
    CU_ASSERT(force[0] == 0 && force[1] == 0 && force[2] == 0);
}

static void bad_amplitudes_are_refused(void)
{
    const struct oracle_kind *kind = verify_kind_find("manufactured-waves-linear-elastic-1d");
    double value[PARAMETERS] = {1, 1, 0.11, 1, 0.3, 1};
    char why[ORACLE_WHY];
    struct oracle *oracle = NULL;
    CU_ASSERT(!oracle_create(kind, value, &oracle, why));
    CU_ASSERT_PTR_NOT_NULL(strstr(why, "amplitude = 0.11 [-], but it must be a finite number, > 0 and <= 0.1"));
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"every kind proves itself", every_kind_proves_itself},
        {"other oracles are none of them", others_are_none},
        {"body force", no_force_where_none_is_needed},
        {"amplitudes that tear the body", bad_amplitudes_are_refused},
    };
    return unit_main("manufactured", tests, sizeof tests / sizeof *tests);
}
