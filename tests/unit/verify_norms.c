/* Error norms against values worked out by hand. */
#include "tests/unit/unit.h"
#include "verify/norms.h"

#include <math.h>
#include <string.h>

static void check(double value, double expected)
{
    CU_ASSERT_DOUBLE_EQUAL(value, expected, 1e-15 * fabs(expected));
}

static void by_hand(void)
{
    /* Two particles of volume 1 and 3; errors (3, 4) and (0, 1); exact (6, 8) and (0, 2). */
    const double V[] = {1, 3}, exact[] = {6, 8, 0, 2}, computed[] = {9, 12, 0, 3};
    struct verify_norms norms = verify_norms_field(2, 2, V, computed, exact);
    check(norms.relative_l2, sqrt((25.0 + 3) / (100.0 + 12)));
    check(norms.absolute_l2, sqrt(28.0 / 4));
    check(norms.relative_max, 0.5);
    check(norms.absolute_max, 5);
    check(norms.relative_l1, (5.0 + 3 * 1) / (10 + 3 * 2));
}

static void weights_matter(void)
{
    const double even[] = {1, 1}, uneven[] = {1, 9}, exact[] = {1, 1}, computed[] = {1, 2};
    check(verify_norms_field(2, 1, even, computed, exact).relative_l2, sqrt(0.5));
    check(verify_norms_field(2, 1, uneven, computed, exact).relative_l2, sqrt(0.9));
    check(verify_norms_field(2, 1, uneven, computed, exact).relative_max, 1);
    check(verify_norms_field(2, 1, even, computed, exact).relative_l1, 0.5);
    check(verify_norms_field(2, 1, uneven, computed, exact).relative_l1, 0.9);
}

static void no_error(void)
{
    const double V[] = {1, 2}, exact[] = {5, -7};
    struct verify_norms norms = verify_norms_field(2, 1, V, exact, exact);
    CU_ASSERT(norms.relative_l2 == 0 && norms.absolute_l2 == 0 && norms.relative_max == 0 && norms.absolute_max == 0);
    CU_ASSERT(norms.relative_l1 == 0);
}

static void exact_field_is_zero(void)
{
    const double V[] = {1, 1}, zero[] = {0, 0}, computed[] = {3, 4};
    struct verify_norms norms = verify_norms_field(2, 1, V, computed, zero);
    CU_ASSERT(isnan(norms.relative_l2));
    CU_ASSERT(isnan(norms.relative_max) && isnan(norms.relative_l1));
    check(norms.absolute_l2, sqrt(12.5));
    check(norms.absolute_max, 4);
    CU_ASSERT(isnan(verify_norms_field(2, 1, V, zero, zero).relative_l2));
}

/* A NaN must show wherever it stands: a maximum is where it is lost most easily. */
static void nan_shows(void)
{
    const double V[] = {1, 1, 1}, exact[] = {1, 2, 3};
    for (size_t at = 0; at < 3; at++) {
        double spoiled[] = {1, 2, 3};
        spoiled[at] = NAN;
        struct verify_norms norms = verify_norms_field(3, 1, V, spoiled, exact);
        CU_ASSERT(isnan(norms.relative_l2) && isnan(norms.absolute_l2));
        CU_ASSERT(isnan(norms.relative_max) && isnan(norms.absolute_max) && isnan(norms.relative_l1));
        norms = verify_norms_field(3, 1, V, exact, spoiled);
        CU_ASSERT(isnan(norms.relative_l2) && isnan(norms.relative_max) && isnan(norms.relative_l1));
    }
    const double bad_V[] = {1, NAN, 1}, computed[] = {1, 2, 4};
    CU_ASSERT(isnan(verify_norms_field(3, 1, bad_V, computed, exact).relative_l2));
}

static void infinity_is_no_small_error(void)
{
    const double V[] = {1}, exact[] = {1}, computed[] = {INFINITY};
    CU_ASSERT(!isfinite(verify_norms_field(1, 1, V, computed, exact).relative_l2));
    CU_ASSERT(!isfinite(verify_norms_field(1, 1, V, computed, exact).absolute_max));
}

/* An oracle of constants, to see which components each error counts. */
static void constant_state(const struct oracle *oracle, const double X[3], double t, struct oracle_state *state)
{
    (void)oracle;
    *state = (struct oracle_state){.u = {X[0], t, 0}, .p = {3, 4, 0}, .F = {2, 0, 0, 0, 1, 0, 0, 0, 1}};
    for (int i = 0; i < 9; i++) {
        state->P[i] = i + 1; /* in the plane: 1 2 / 4 5 */
    }
}

static void components_counted(void)
{
    const struct oracle_kind kind = {.state = constant_state};
    double X[] = {1, 0}, V[] = {2};
    struct solver_cloud cloud = {.dim = 2, .count = 1, .X = X};
    /* p off by 1 in y; a shear stress off by 2, a normal stress by 3; F off by 0.5; u exact at t = 1. */
    const double u[] = {1, 1}, p[] = {3, 5}, F[] = {2, 0.5, 0, 1}, P[] = {4, 2, 6, 5};
    const struct solver_output output = {.cloud = &cloud, .time = 1, .V = V, .u = u, .p = p, .F = F, .P = P};
    double error[VERIFY_STATE_ERRORS];
    struct solver_error why;
    CU_ASSERT_TRUE_FATAL(verify_norms_state(&output, &kind, NULL, error, &why));
    check(error[verify_error_find("p")], 1.0 / 5);
    check(error[verify_error_find("P")], 3 / sqrt(26));
    check(error[verify_error_find("P_all")], sqrt(13.0 / 46));
    check(error[verify_error_find("P_all_abs")], sqrt(13));
    check(error[verify_error_find("F")], 0.5); /* against F - I, whose size is 1 */
    check(error[verify_error_find("F_abs_max")], 0.5);
    CU_ASSERT(error[verify_error_find("u")] == 0);
}

/* Of a deformation that is not small, sigma = P F^T / J; what the scheme does not know is measured by nothing. */
static void cauchy_stress(void)
{
    struct oracle_kind kind = {.state = constant_state, .finite_strain = true};
    double X[] = {1, 0}, V[] = {2};
    struct solver_cloud cloud = {.dim = 2, .count = 1, .X = X};
    /* exact: P = 1 2 / 4 5 with F = diag(2, 1) makes sigma = 1 1 / 4 2.5; off by 2 in xx and by 3 in xy */
    const double u[] = {1, 1}, p[] = {3, 4}, sigma[] = {3, 4, 4, 2.5};
    const struct solver_output output = {.cloud = &cloud, .time = 1, .V = V, .u = u, .p = p, .sigma = sigma};
    static const char *const unknown[] = {"F", "P", "P_all", "P_l1", "F_abs_max"};
    double error[VERIFY_STATE_ERRORS];
    struct solver_error why;
    CU_ASSERT_TRUE_FATAL(verify_norms_state(&output, &kind, NULL, error, &why));
    check(error[verify_error_find("sigma")], 2 / sqrt(7.25));
    check(error[verify_error_find("sigma_abs")], 2);
    check(error[verify_error_find("sigma_all_abs")], sqrt(13));
    check(error[verify_error_find("sigma_all")], sqrt(13 / 24.25));
    CU_ASSERT(error[verify_error_find("p")] == 0 && error[verify_error_find("u")] == 0);
    for (size_t i = 0; i < sizeof unknown / sizeof *unknown; i++) {
        CU_ASSERT(isnan(error[verify_error_find(unknown[i])]));
    }
    kind.finite_strain = false; /* P itself: 1 2 / 4 5 */
    CU_ASSERT_TRUE_FATAL(verify_norms_state(&output, &kind, NULL, error, &why));
    check(error[verify_error_find("sigma_abs")], sqrt(4 + 6.25));
    check(error[verify_error_find("sigma_all_abs")], sqrt(4 + 4 + 6.25));
}

static void sheared_state(const struct oracle *oracle, const double X[3], double t, struct oracle_state *state)
{
    constant_state(oracle, X, t, state);
    memcpy(state->F, (double[9]){2, 0.5, 0, 0.25, 1.5, 0, 0, 0, 1}, sizeof state->F);
}

/* Cofactor and Jacobian are measured from those of the body at rest, I and 1. */
static void cofactor_and_jacobian(void)
{
    struct oracle_kind kind = {.state = sheared_state, .finite_strain = true};
    double X[] = {1, 0}, V[] = {2};
    struct solver_cloud cloud = {.dim = 2, .count = 1, .X = X};
    /* exact: H = 1.5 -0.25 / -0.5 2, which is 1.25 from I, and J = 2.875; off by 0.5 and by 1 */
    const double u[] = {1, 1}, p[] = {3, 4}, F[] = {2, 0.5, 0.25, 1.5}, H[] = {1.5, -0.25, -0.5, 2.5}, J[] = {3.875};
    const struct solver_output output = {.cloud = &cloud, .time = 1, .V = V, .u = u, .p = p, .F = F, .H = H, .J = J};
    double error[VERIFY_STATE_ERRORS];
    struct solver_error why;
    CU_ASSERT_TRUE_FATAL(verify_norms_state(&output, &kind, NULL, error, &why));
    check(error[verify_error_find("H")], 0.5 / 1.25);
    check(error[verify_error_find("H_abs")], 0.5);
    check(error[verify_error_find("J")], 1 / 1.875);
    check(error[verify_error_find("J_max")], 1 / 1.875);
    CU_ASSERT(error[verify_error_find("F")] == 0);
    kind.finite_strain = false; /* J = 1 + tr(F - I) = 2.5 */
    CU_ASSERT_TRUE_FATAL(verify_norms_state(&output, &kind, NULL, error, &why));
    check(error[verify_error_find("J")], 1.375 / 1.5);
    check(error[verify_error_find("H")], 0.5 / 1.25);
}

/* Two probes at X = 3 and X = 0, three times: exact u = (X, t, 0). */
static void probes_over_time(void)
{
    const struct oracle_kind kind = {.state = constant_state};
    struct solver_totals totals[] = {{.time = 0}, {.time = 1}, {.time = 2}};
    double place[][3] = {{3, 0, 0}, {0, 0, 0}};
    double u[] = {3, 0, 0, 0, 0, 0, 3, 1, 0, 0, 1.5, 0, 3, 2, 0, 2, 2, 0}; /* off by 0.5 at t = 1, by 2 at t = 2 */
    const struct solver_history history = {
        .count = 3, .totals = totals, .probe_count = 2, .probe_X = place, .probe_u = u};
    double error[VERIFY_ERRORS];
    struct solver_error why;
    CU_ASSERT_TRUE_FATAL(verify_norms_probes(&history, &kind, NULL, 0.5, error, &why));
    check(error[verify_error_find("probes_abs")], sqrt((0.25 + 4) / 6));
    check(error[verify_error_find("probes")], sqrt((0.25 + 4) / (9 + 10 + 1 + 13 + 4)));
    check(error[verify_error_find("probes_abs_max")], 2);
    check(error[verify_error_find("probes_max")], 2 / sqrt(13));
    check(error[verify_error_find("probes_nrmse")], sqrt((0.25 + 4) / 6) / 0.5);
    check(error[verify_error_find("probes_y_abs")], sqrt(0.25 / 6)); /* the 2 is along x */
    check(error[verify_error_find("probes_y")], sqrt(0.25 / (1 + 1 + 4 + 4)));
    check(error[verify_error_find("probes_y_abs_max")], 0.5);
    check(error[verify_error_find("probes_y_nrmse")], sqrt(0.25 / 6) / 0.5);
    CU_ASSERT_TRUE_FATAL(verify_norms_probes(&history, &kind, NULL, 0, error, &why));
    CU_ASSERT(isnan(error[verify_error_find("probes_nrmse")])); /* relative to nothing */
    CU_ASSERT(isnan(error[verify_error_find("probes_y_nrmse")]));
    u[4] = NAN;
    CU_ASSERT_TRUE_FATAL(verify_norms_probes(&history, &kind, NULL, 0.5, error, &why));
    CU_ASSERT(isnan(error[verify_error_find("probes")]) && isnan(error[verify_error_find("probes_abs_max")]));
    CU_ASSERT(isnan(error[verify_error_find("probes_nrmse")]));
    CU_ASSERT(isnan(error[verify_error_find("probes_y")]) && isnan(error[verify_error_find("probes_y_nrmse")]));
    const struct solver_history none = {.count = 1}; /* nothing was recorded, so nothing is said */
    error[verify_error_find("probes")] = error[verify_error_find("probes_nrmse")] = 0;
    CU_ASSERT_TRUE_FATAL(verify_norms_probes(&none, &kind, NULL, 0.5, error, &why));
    CU_ASSERT(isnan(error[verify_error_find("probes")]) && isnan(error[verify_error_find("probes_nrmse")]));
    CU_ASSERT(isnan(error[verify_error_find("probes_y")]));
}

/* The largest of each error, whichever snapshot it comes from; one that could not be measured stays unmeasured. */
static void worst_of_snapshots(void)
{
    size_t p = verify_error_find("p"), P = verify_error_find("P_l1"), F = verify_error_find("F_abs_max");
    double one[VERIFY_STATE_ERRORS] = {0}, two[VERIFY_STATE_ERRORS] = {0}, error[VERIFY_ERRORS];
    for (size_t i = 0; i < VERIFY_ERRORS; i++) {
        error[i] = 99;
    }
    one[p] = 3, one[P] = 1, one[F] = NAN;
    two[p] = 2, two[P] = 4, two[F] = 5;
    verify_norms_worst(0, one, error);
    CU_ASSERT(error[verify_error_find("snapshots_p")] == 3); /* the first replaces what stood there */
    verify_norms_worst(1, two, error);
    CU_ASSERT(error[verify_error_find("snapshots_p")] == 3);
    CU_ASSERT(error[verify_error_find("snapshots_P_l1")] == 4);
    CU_ASSERT(isnan(error[verify_error_find("snapshots_F_abs_max")]));
    CU_ASSERT(error[p] == 99 && error[VERIFY_PROBES_NRMSE] == 99);
    two[p] = NAN;
    verify_norms_worst(2, two, error);
    CU_ASSERT(isnan(error[verify_error_find("snapshots_p")]));
}

/* What an error needs of the scene. */
static void errors_that_apply(void)
{
    static const struct {
        const char *name, *lacks;
    } needs[] = {{"snapshots_P_l1", "snapshots"},
                 {"probes_abs", "probes"},
                 {"probes_nrmse", "probe_scale"},
                 {"probes_y_abs_max", "dim = 2 or 3, so that there is a y"},
                 {"probes_y_nrmse", "dim = 2 or 3, so that there is a y"}};
    struct solver_scene scene = {
        .oracle = "some", .dim = 2, .probe_count = 1, .probe_scale = 1, .snapshot_count = 1, .beside = {.count = 1}};
    const char *lacks = NULL;
    for (size_t i = 0; i < VERIFY_ERRORS; i++) {
        CU_ASSERT(verify_error_applies(&scene, i, &lacks) && lacks == NULL);
    }
    for (size_t i = 0; i < sizeof needs / sizeof *needs; i++) {
        struct solver_scene less = scene;
        less.dim = i >= 3 ? 1 : 2;
        less.snapshot_count = i == 0 ? 0 : 1;
        less.probe_count = i == 1 ? 0 : 1;
        less.probe_scale = i == 2 ? 0 : 1;
        CU_ASSERT_FALSE(verify_error_applies(&less, verify_error_find(needs[i].name), &lacks));
        CU_ASSERT_STRING_EQUAL(lacks, needs[i].lacks);
        CU_ASSERT_TRUE(verify_error_applies(&less, verify_error_find("P_l1"), &lacks));
    }
    struct solver_scene alone = scene; /* no oracle: what is left is the configuration beside */
    alone.oracle[0] = '\0';
    for (size_t i = 0; i < VERIFY_ERRORS; i++) {
        CU_ASSERT_EQUAL(verify_error_applies(&alone, i, &lacks), i >= VERIFY_BESIDE);
        CU_ASSERT(lacks == NULL || strncmp(lacks, "oracle", 6) == 0);
    }
    scene.beside.count = 0;
    CU_ASSERT_FALSE(verify_error_applies(&scene, VERIFY_BESIDE, &lacks));
    CU_ASSERT_STRING_EQUAL(lacks, "beside");
    scene.beside.count = 1;
    (void)snprintf(scene.scheme, sizeof scene.scheme, "ulsph"); /* knows neither F nor P */
    for (size_t i = 0; i < VERIFY_ERRORS; i++) {
        const char *name = verify_error_name(i) + (strncmp(verify_error_name(i), "snapshots_", 10) == 0 ? 10 : 0);
        bool of_deformation = strchr("PFH", name[0]) != NULL;
        CU_ASSERT_EQUAL(verify_error_applies(&scene, i, &lacks), !of_deformation);
        CU_ASSERT_EQUAL(verify_error_known(&scene, i), !of_deformation);
        CU_ASSERT_EQUAL(of_deformation, lacks != NULL && strncmp(lacks, "scheme ", 7) == 0);
    }
}

static void names(void)
{
    for (size_t i = 0; i < VERIFY_ERRORS; i++) {
        CU_ASSERT_EQUAL(verify_error_find(verify_error_name(i)), i);
        CU_ASSERT_EQUAL(strstr(verify_error_name(i), "_abs") == NULL,
                        strstr(verify_error_meaning(i), "absolute") == NULL);
        CU_ASSERT_EQUAL(strstr(verify_error_name(i), "_max") == NULL, strstr(verify_error_meaning(i), " max ") == NULL);
    }
    CU_ASSERT_STRING_EQUAL(verify_error_unit(verify_error_find("P_abs")), "Pa");
    CU_ASSERT_STRING_EQUAL(verify_error_unit(verify_error_find("P_max")), "-");
    CU_ASSERT_STRING_EQUAL(verify_error_unit(verify_error_find("snapshots_P_abs")), "Pa");
    CU_ASSERT_STRING_EQUAL(verify_error_name(VERIFY_PROBES_NRMSE), "probes_nrmse");
    CU_ASSERT_EQUAL(verify_error_find("snapshots_P_l1"), VERIFY_SNAPSHOT_ERRORS + verify_error_find("P_l1"));
    CU_ASSERT_EQUAL(verify_error_find("q"), VERIFY_ERRORS);
    CU_ASSERT_EQUAL(verify_error_find(""), VERIFY_ERRORS);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"values by hand", by_hand},
        {"volumes are the weights", weights_matter},
        {"no error is zero", no_error},
        {"an exact field of zero has no relative error", exact_field_is_zero},
        {"NaN shows", nan_shows},
        {"infinity shows", infinity_is_no_small_error},
        {"components counted", components_counted},
        {"Cauchy stress", cauchy_stress},
        {"cofactor and Jacobian", cofactor_and_jacobian},
        {"probes over time", probes_over_time},
        {"largest over the snapshots", worst_of_snapshots},
        {"errors that a scene can have", errors_that_apply},
        {"names and units", names},
    };
    return unit_main("norms", tests, sizeof tests / sizeof *tests);
}
