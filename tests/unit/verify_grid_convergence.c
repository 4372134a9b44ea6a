/* Richardson extrapolation and the grid convergence index, on sequences whose limit is known. */
#include "tests/unit/unit.h"
#include "verify/grid_convergence.h"

#include <math.h>

enum { LEVELS = 5 };

/* limit + c h^order, and spacings whose ratios are not all the same. */
static void make(double limit, double c, double order, double h[LEVELS], double f[LEVELS])
{
    static const double ratio[LEVELS] = {1, 1.5, 2, 1.25, 1.6};
    double spacing = 0.1;
    for (int i = 0; i < LEVELS; i++) {
        h[i] = spacing /= ratio[i];
        f[i] = limit + c * pow(h[i], order);
    }
}

static void known_limit(void)
{
    for (double order = 0.7; order < 5; order += 0.4) {
        for (double c = -3; c < 4; c += 6) {
            double h[LEVELS], f[LEVELS];
            make(2.5, c, order, h, f);
            struct verify_extrapolation found = verify_extrapolate(LEVELS, h, f);
            CU_ASSERT_DOUBLE_EQUAL(found.order, order, 1e-6);
            CU_ASSERT_DOUBLE_EQUAL(found.limit, 2.5, 1e-9);
            /* 1.25 of the distance that is left */
            CU_ASSERT_DOUBLE_EQUAL(found.uncertainty, 1.25 * fabs(f[LEVELS - 1] - 2.5), 1e-9);
            CU_ASSERT_DOUBLE_EQUAL(found.index, found.uncertainty / f[LEVELS - 1], 1e-15);
            CU_ASSERT_DOUBLE_EQUAL(found.ratio, f[LEVELS - 1] / f[LEVELS - 2], 1e-6);
            CU_ASSERT_EQUAL(found.state, VERIFY_ASYMPTOTIC);
        }
    }
}

/* Celik et al., Table 1, monotonic convergence: reattachment length over 18000, 8000 and 4500 cells in 2D. */
static void printed_example(void)
{
    const double h[] = {1 / sqrt(4500), 1 / sqrt(8000), 1 / sqrt(18000)}, f[] = {5.863, 5.972, 6.063};
    struct verify_extrapolation found = verify_extrapolate(3, h, f);
    CU_ASSERT_DOUBLE_EQUAL(found.order, 1.53, 0.01);
    CU_ASSERT_DOUBLE_EQUAL(found.limit, 6.1685, 5e-4);
    CU_ASSERT_DOUBLE_EQUAL(found.index, 0.022, 5e-4);
    CU_ASSERT_EQUAL(found.state, VERIFY_ONE_ORDER);
}

/* Differences far above round-off have an order, however small they are beside the value: 2 within what their own
 * round-off leaves of it. */
static void small_differences(void)
{
    double h[LEVELS], f[LEVELS];
    make(1.0, 1e-6, 2.0, h, f);
    struct verify_extrapolation found = verify_extrapolate(LEVELS, h, f);
    CU_ASSERT_DOUBLE_EQUAL(found.order, 2.0, 1e-5);
    CU_ASSERT_DOUBLE_EQUAL(found.limit, 1.0, 1e-14);
}

static void two_levels(void)
{
    const double h[] = {0.2, 0.1}, f[] = {1.4, 1.1};
    double order[2];
    struct verify_extrapolation found = verify_extrapolate(2, h, f);
    CU_ASSERT_EQUAL(found.state, VERIFY_TOO_FEW);
    CU_ASSERT(isnan(found.limit) && isnan(found.uncertainty) && isnan(found.order));
    CU_ASSERT_EQUAL(verify_error_convergence(2, h, f, order), VERIFY_TOO_FEW);
    CU_ASSERT(isnan(order[0]) && isnan(order[1]));
}

static void is_not_extrapolated(const double f[4], enum verify_convergence state)
{
    const double h[] = {0.8, 0.4, 0.2, 0.1};
    struct verify_extrapolation found = verify_extrapolate(4, h, f);
    CU_ASSERT_EQUAL(found.state, state);
    CU_ASSERT(isnan(found.limit) && isnan(found.uncertainty) && isnan(found.order) && isnan(found.index));
    CU_ASSERT(isnan(found.ratio));
}

static void no_limit_to_be_seen(void)
{
    is_not_extrapolated((const double[]){9, 1, 2, 1.5}, VERIFY_OSCILLATING);
    is_not_extrapolated((const double[]){9, 1, 2, 4}, VERIFY_DIVERGING);
    is_not_extrapolated((const double[]){9, 1, 2, 3}, VERIFY_DIVERGING);
    is_not_extrapolated((const double[]){9, 2, 2, 3}, VERIFY_DIVERGING);
    is_not_extrapolated((const double[]){2, 2, 2, 2}, VERIFY_EQUAL);
    is_not_extrapolated((const double[]){9, 3, 2, 2 + 4e-16}, VERIFY_EQUAL);
    is_not_extrapolated((const double[]){9, NAN, 2, 1}, VERIFY_UNMEASURED);
    is_not_extrapolated((const double[]){9, 3, 2, INFINITY}, VERIFY_UNMEASURED);
}

static void not_yet_settled(void)
{
    const double h[] = {0.8, 0.4, 0.2, 0.1};
    const double changing[] = {10 + 0.64 - 0.51, 10 + 0.16 - 0.064, 10 + 0.04 - 0.008, 10 + 0.01 - 0.001};
    const double far[] = {65, 17, 5, 2}; /* 1 + h^2 in coarse steps: of second order, and far from its limit */
    CU_ASSERT_EQUAL(verify_extrapolate(4, h, changing).state, VERIFY_UNSETTLED);
    CU_ASSERT_EQUAL(verify_extrapolate(4, h, far).state, VERIFY_UNSETTLED);
    CU_ASSERT_DOUBLE_EQUAL(verify_extrapolate(4, h, far).limit, 1, 1e-9);
}

static void error_is(const double e[3], enum verify_convergence state)
{
    const double h[] = {0.4, 0.2, 0.1};
    double order[2];
    CU_ASSERT_EQUAL(verify_error_convergence(3, h, e, order), state);
}

static void errors(void)
{
    const double h[] = {0.8, 0.4, 0.2, 0.1}, e[] = {1, 16, 4, 1};
    double order[2];
    CU_ASSERT_EQUAL(verify_error_convergence(4, h, e, order), VERIFY_ASYMPTOTIC);
    CU_ASSERT_DOUBLE_EQUAL(order[0], 2, 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(order[1], 2, 1e-12);
    error_is((const double[]){16, 4, 1.5}, VERIFY_UNSETTLED);
    error_is((const double[]){16, 4, 5}, VERIFY_OSCILLATING);
    error_is((const double[]){4, 16, 5}, VERIFY_OSCILLATING);
    error_is((const double[]){1, 2, 4}, VERIFY_DIVERGING);
    error_is((const double[]){1, 1, 1}, VERIFY_DIVERGING);
    error_is((const double[]){1, NAN, 1}, VERIFY_UNMEASURED);
    error_is((const double[]){1, 0.1, 0}, VERIFY_UNMEASURED);
    error_is((const double[]){0, 0, 0}, VERIFY_UNMEASURED);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"a known limit", known_limit},
        {"small differences", small_differences},
        {"the printed example", printed_example},
        {"two levels", two_levels},
        {"no limit to be seen", no_limit_to_be_seen},
        {"not yet settled", not_yet_settled},
        {"errors", errors},
    };
    return unit_main("grid convergence", tests, sizeof tests / sizeof *tests);
}
