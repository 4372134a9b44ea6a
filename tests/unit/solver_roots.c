/* |x|^(-2/3) of solver/dim_roots.h, over all numbers there are, and as the loops of every path have it. */
#define DIM 1
#pragma GCC diagnostic ignored "-Wpsabi" /* vectors are passed within this file alone */
#include "solver/dim_roots.h"

#include "solver/material.h"
#include "solver/path.h"
#include "tests/unit/random_tensors.h"
#include "tests/unit/unit.h"

#include <fenv.h>
#include <float.h>
#include <stdio.h>

enum { OF_AN_EXPONENT = 200 };

/* Units in the last place between a value and the true one, by long double's 11 bits more. */
static double ulps_off(double x, double value)
{
    long double root = cbrtl(fabsl((long double)x));
    long double exact = 1.0L / (root * root);
    int exponent;
    (void)frexp((double)exact, &exponent);
    return (double)(fabsl((long double)value - exact) / ldexpl(1.0L, exponent - DBL_MANT_DIG));
}

static double root_of(double x)
{
    lot roots = inverse_square_of_cube_root((lot){x, 1.0, -x, 8.0});
    CU_ASSERT_EQUAL(roots[0], roots[2]); /* whatever the sign, and the lane */
    return roots[0];
}

/* Of every exponent, and nothing that traps would strike at. */
static void test_all_exponents(void)
{
    double worst = 0.0;
    CU_ASSERT_EQUAL(feclearexcept(FE_ALL_EXCEPT), 0);
    for (int exponent = DBL_MIN_EXP - DBL_MANT_DIG; exponent < DBL_MAX_EXP; exponent++) {
        for (int i = 0; i < OF_AN_EXPONENT; i++) {
            double x = ldexp(i == 0 ? 1.0 : i == 1 ? 2.0 - DBL_EPSILON : uniform(1.0, 2.0), exponent);
            worst = fmax(worst, ulps_off(x, root_of(x)));
        }
    }
    CU_ASSERT_EQUAL(fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW), 0);
    printf("\n    at most %.3f ulp off", worst);
    CU_ASSERT(worst <= 2.0);
    CU_ASSERT_EQUAL(root_of(1.0), 1.0);
}

static void test_no_root(void)
{
    unit_untrapped();
    CU_ASSERT(root_of(0.0) > 1e200 && isfinite(root_of(0.0)));
    CU_ASSERT(isnan(inverse_square_of_cube_root(lot_of(INFINITY))[0]));
    CU_ASSERT(isnan(inverse_square_of_cube_root(lot_of(-INFINITY))[0]));
    CU_ASSERT(isnan(inverse_square_of_cube_root(lot_of(NAN))[0]));
}

/* Where H is zero, all that is left of the polyconvex reading's stress is mu |J|^(-2/3) F. What H is a factor of must
 * be a number. */
static void test_paths(void)
{
    enum { COUNT = 64 };
    static const struct solver_material_constants unit = {.rho = 1.0, .mu = 1.0};
    double F[COUNT];
    double H[COUNT] = {0};
    double J[COUNT];
    double P[4][COUNT];
    double worst = 0.0;
    for (int i = 0; i < COUNT; i++) {
        F[i] = 1.0;
    }
    for (int round = 0; round < 1000; round++) {
        for (int i = 0; i < COUNT; i++) {
            J[i] = (i % 2 == 0 ? 1.0 : -1.0) * exp2(uniform(-600.0, 1000.0));
        }
        for (int path = 0; path < SOLVER_PATHS && solver_path_runs(path); path++) {
            solver_path_use(path);
            solver_material_find("neo-hookean-polyconvex")->in[0]->stress_range(&unit, 0, 0, COUNT, F, H, J, P[path]);
            for (int i = 0; i < COUNT; i++) {
                worst = fmax(worst, ulps_off(J[i], P[path][i]));
                CU_ASSERT(path < 2 || P[path][i] == P[1][i]);
            }
        }
    }
    printf("\n    at most %.3f ulp off", worst);
    CU_ASSERT(worst <= 2.0);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"within 2 ulp for every exponent", test_all_exponents},
        {"what has none", test_no_root},
        {"so on every path, wide ones with the same bits", test_paths},
    };
    return unit_main("roots", tests, sizeof tests / sizeof *tests);
}
