/* Hardening laws: slopes, plastic work, and the flow that brings a stress back to the yield surface. */
#include "solver/hardening.h"
#include "tests/unit/random_tensors.h"
#include "tests/unit/unit.h"

#include <float.h>
#include <gsl/gsl_integration.h>
#include <stdio.h>

static const double mu = 43e9; /* Pa */

/* 000 (Taylor bar), 003 section 6.5 with its saturation, 004 eq. 4.3, and what is extreme. */
static const struct solver_hardening laws[] = {
    {.law = SOLVER_HARDENING_LINEAR, .yield = 0.4e9, .modulus = 0.1e9},
    {.law = SOLVER_HARDENING_LINEAR, .yield = 1, .modulus = 0},
    {.law = SOLVER_HARDENING_SATURATION, .yield = 0.45e9, .modulus = 0.13e9, .saturation = 0.715e9, .rate = 16.93},
    {.law = SOLVER_HARDENING_SATURATION, .yield = 1e6, .saturation = 1e12, .rate = 1e6},
    {.law = SOLVER_HARDENING_SATURATION, .yield = 0.4e9, .modulus = 0.1e9, .saturation = 0.4e9, .rate = 3},
    {.law = SOLVER_HARDENING_POWER, .yield = 55.3e6, .strain = 0.02, .exponent = 0.27},
    {.law = SOLVER_HARDENING_POWER, .yield = 1e3, .strain = 1e-12, .exponent = 0.5},
    {.law = SOLVER_HARDENING_POWER, .yield = 0.4e9, .strain = 4, .exponent = 1},
};
enum { LAWS = sizeof laws / sizeof *laws };

static void expect(size_t law, const char *what, double found, double bound)
{
    bool holds = found <= bound;
    if (!holds) {
        printf("\n    law %zu: %s: %.3e > %.1e", law, what, found, bound);
    }
    CU_ASSERT(holds);
}

static void slopes(void)
{
    static const double step[] = {-2, -1, 1, 2};
    static const double weight[] = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12};
    for (size_t law = 0; law < LAWS; law++) {
        CU_ASSERT_EQUAL(solver_hardening_stress(&laws[law], 0, NULL), laws[law].yield);
        for (double plastic = 1e-6; plastic < 3; plastic *= 3) {
            double scale = laws[law].law == SOLVER_HARDENING_SATURATION ? 1 / (1 / plastic + laws[law].rate) : plastic;
            double slope, difference = 0, size = 1e-3 * scale;
            double stress = solver_hardening_stress(&laws[law], plastic, &slope);
            for (int i = 0; i < 4; i++) {
                difference += weight[i] / size * solver_hardening_stress(&laws[law], plastic + step[i] * size, NULL);
            }
            expect(law, "slope", fabs(difference - slope), 1e-10 * slope + 1e-12 * stress / size);
        }
    }
}

static double stress_at(double plastic, void *with)
{
    return solver_hardening_stress(with, plastic, NULL);
}

/* The work is the integral of the stress, by GSL's adaptive quadrature. */
static void work(void)
{
    gsl_integration_workspace *space = gsl_integration_workspace_alloc(1000);
    for (size_t law = 0; law < LAWS; law++) {
        struct solver_hardening of = laws[law];
        gsl_function function = {stress_at, &of};
        CU_ASSERT_EQUAL(solver_hardening_work(&of, 0), 0);
        double sum = 0, from = 0;
        for (double plastic = 1e-7; plastic < 3; plastic *= 7) { /* by steps that no change of the stress escapes */
            double integral, error;
            CU_ASSERT_EQUAL(gsl_integration_qag(&function, from, plastic, 0, 1e-12, 1000, GSL_INTEG_GAUSS31, space,
                                                &integral, &error),
                            0);
            sum += integral;
            from = plastic;
            expect(law, "work", fabs(solver_hardening_work(&of, plastic) / sum - 1), 1e-11);
        }
    }
    gsl_integration_workspace_free(space);
}

/* Within the surface nothing flows; beyond it the stress comes to lie on it, to round-off. */
static void flow(void)
{
    for (size_t law = 0; law < LAWS; law++) {
        for (int i = 0; i < 2000; i++) {
            double plastic = i % 5 == 0 ? 0 : exp2(uniform(-40, 3));
            double yield = solver_hardening_stress(&laws[law], plastic, NULL);
            double q = yield + (i % 3 == 0 ? yield * exp2(uniform(-52, 0)) : mu * exp2(uniform(-20, 6)));
            double by = solver_hardening_flow(&laws[law], mu, q, plastic), slope;
            double after = solver_hardening_stress(&laws[law], plastic + by, &slope);
            CU_ASSERT(by > 0 || q == yield);
            /* what is lost of the plastic strain when the flow is added to it, and one unit of q */
            double bound = 4 * DBL_EPSILON * (q + slope * (plastic + by));
            expect(law, "distance from the yield surface", fabs(q - 3 * mu * by - after), bound);
            CU_ASSERT_EQUAL(solver_hardening_flow(&laws[law], mu, yield * uniform(0, 1), plastic), 0);
        }
        CU_ASSERT_EQUAL(solver_hardening_flow(&laws[law], mu, NAN, 0), 0);
        CU_ASSERT_EQUAL(solver_hardening_flow(&laws[law], mu, INFINITY, 0), 0);
    }
}

/* Laws that say the same: saturation at once where it begins is linear, and so is a power of one. */
static void the_same(void)
{
    const struct solver_hardening linear = laws[0];
    for (int i = 0; i < 2000; i++) {
        double q = 0.4e9 + mu * exp2(uniform(-30, 3)), plastic = uniform(0, 1);
        double by = solver_hardening_flow(&linear, mu, q, plastic);
        double bound = 1e-15 * (1 + plastic);
        CU_ASSERT_DOUBLE_EQUAL(solver_hardening_flow(&laws[4], mu, q, plastic), by, bound);
        CU_ASSERT_DOUBLE_EQUAL(solver_hardening_flow(&laws[7], mu, q, plastic), by, bound);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"slopes", slopes},
        {"plastic work", work},
        {"flow ends on the yield surface", flow},
        {"laws that are the same", the_same},
    };
    return unit_main("hardening", tests, sizeof tests / sizeof *tests);
}
