/* Every integrator of the table, through the two-register form that integrator.h documents. */
#include "solver/integrator.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { S = SOLVER_STAGES };

typedef void rate_function(double t, const double *U, double *R);

/* One step as the header says. */
static void step(const struct solver_integrator *integrator, size_t size, double t, double dt, rate_function *rate,
                 double *U)
{
    double start[4];
    double R[4];
    double sum[4] = {0};
    memcpy(start, U, size * sizeof *U);
    for (int s = 0; s < integrator->stages; s++) {
        const struct solver_stage *stage = &integrator->stage[s];
        rate(t + stage->time * dt, U, R);
        for (size_t i = 0; i < size; i++) {
            sum[i] += stage->accumulate * R[i];
            U[i] = start[i] + stage->keep * (U[i] - start[i]) + dt * (stage->rate * R[i] + stage->sum * sum[i]);
        }
    }
}

/* The Butcher tableau that the form amounts to: `row` s holds the coefficients of the stage rates in the state that
 * stage s evaluates; row [stages] those of the step. */
struct tableau {
    double row[S + 1][S];
};

static struct tableau tableau_of(const struct solver_integrator *integrator)
{
    struct tableau tableau = {{{0}}};
    double sum[S] = {0};
    for (int s = 0; s < integrator->stages; s++) {
        const struct solver_stage *stage = &integrator->stage[s];
        sum[s] += stage->accumulate;
        for (int j = 0; j < S; j++) {
            tableau.row[s + 1][j] =
                stage->keep * tableau.row[s][j] + (j == s ? stage->rate : 0.0) + stage->sum * sum[j];
        }
    }
    return tableau;
}

/* Largest violation of the conditions of one order (Hairer, Norsett, Wanner: Solving ODEs I, table II.2.1). */
static double violation(const struct solver_integrator *integrator, int order)
{
    struct tableau tableau = tableau_of(integrator);
    double c[S] = {0};
    double Ac[S] = {0};
    double Acc[S] = {0};
    double AAc[S] = {0};
    double worst = 0.0;
    for (int i = 0; i < integrator->stages; i++) {
        for (int j = 0; j < i; j++) {
            c[i] += tableau.row[i][j];
            Ac[i] += tableau.row[i][j] * c[j];
            Acc[i] += tableau.row[i][j] * c[j] * c[j];
            AAc[i] += tableau.row[i][j] * Ac[j];
        }
    }
    double sums[5][9] = {{0}};
    for (int i = 0; i < integrator->stages; i++) {
        double b = tableau.row[integrator->stages][i];
        double A3c = 0.0;
        for (int j = 0; j < i; j++) {
            A3c += tableau.row[i][j] * AAc[j];
        }
        sums[0][0] += b;
        sums[1][0] += b * c[i];
        sums[2][0] += b * c[i] * c[i];
        sums[2][1] += b * Ac[i];
        sums[3][0] += b * c[i] * c[i] * c[i];
        sums[3][1] += b * c[i] * Ac[i];
        sums[3][2] += b * Acc[i];
        sums[3][3] += b * AAc[i];
        sums[4][0] += b * c[i] * c[i] * c[i] * c[i];
        sums[4][1] += b * A3c;
    }
    static const double wanted[5][9] = {
        {1.0}, {1.0 / 2}, {1.0 / 3, 1.0 / 6}, {1.0 / 4, 1.0 / 8, 1.0 / 12, 1.0 / 24}, {1.0 / 5, 1.0 / 120}};
    for (int k = 0; k < 9; k++) {
        worst = fmax(worst, fabs(sums[order - 1][k] - wanted[order - 1][k]));
    }
    return worst;
}

/* The claimed order holds, and is not claimed too low. */
static void test_order_conditions(void)
{
    for (const struct solver_integrator *integrator = solver_integrators(); integrator->name != NULL; integrator++) {
        CU_ASSERT_FATAL(integrator->order >= 1 && integrator->order <= 4);
        for (int order = 1; order <= integrator->order; order++) {
            CU_ASSERT(violation(integrator, order) < 4e-16);
        }
        CU_ASSERT(violation(integrator, integrator->order + 1) > 1e-3);
    }
}

static void test_stages(void)
{
    for (const struct solver_integrator *integrator = solver_integrators(); integrator->name != NULL; integrator++) {
        struct tableau tableau = tableau_of(integrator);
        bool sums = false;
        double weights = 0.0;
        CU_ASSERT_FATAL(integrator->stages >= 1 && integrator->stages <= S);
        for (int s = 0; s < integrator->stages; s++) {
            const struct solver_stage *stage = &integrator->stage[s];
            double time = 0.0;
            for (int j = 0; j < s; j++) {
                time += tableau.row[s][j];
            }
            CU_ASSERT_DOUBLE_EQUAL(stage->time, time, 1e-15);
            CU_ASSERT(s == 0 || stage->time > 0.0);
            CU_ASSERT_DOUBLE_EQUAL(stage->weight, tableau.row[integrator->stages][s], 1e-15);
            weights += stage->weight;
            sums = sums || stage->sum != 0.0;
        }
        CU_ASSERT_DOUBLE_EQUAL(weights, 1.0, 1e-15);
        const struct solver_stage *first = &integrator->stage[0];
        CU_ASSERT(first->time == 0.0 && first->keep == 0.0 && first->sum == 0.0);
        CU_ASSERT_EQUAL(integrator->needs_sum, sums);
    }
}

/* Each stage of a strong stability preserving method is a convex combination of Euler steps no longer than dt. */
static void test_strong_stability(void)
{
    static const char *const names[] = {"euler", "tvd-rk2", "ssp-rk3"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const struct solver_integrator *integrator = solver_integrator_find(names[i]);
        CU_ASSERT_PTR_NOT_NULL_FATAL(integrator);
        for (int s = 0; s < integrator->stages; s++) {
            const struct solver_stage *stage = &integrator->stage[s];
            double of_this_stage = s == 0 ? 1.0 : stage->keep;
            CU_ASSERT(stage->keep >= 0.0 && stage->keep <= 1.0 && stage->rate >= 0.0);
            CU_ASSERT(stage->rate <= of_this_stage);
            CU_ASSERT_EQUAL(stage->sum, 0.0);
        }
    }
}

/* A pendulum whose length changes, made to have a known solution: U = (sin t^2, 1/(1 + t^2)). */
static void nonlinear(double t, const double *U, double *R)
{
    double bell = 1.0 / (1.0 + t * t);
    R[0] = 2.0 * t * cos(t * t) + (U[0] * U[0] - sin(t * t) * sin(t * t)) * U[1];
    R[1] = -2.0 * t * U[1] * U[1] + sin(U[0] * (U[1] - bell));
}

static double error_after(const struct solver_integrator *integrator, int steps)
{
    double U[2] = {0.0, 1.0};
    double end = 1.5;
    for (int i = 0; i < steps; i++) {
        step(integrator, 2, end * i / steps, end / steps, nonlinear, U);
    }
    return hypot(U[0] - sin(end * end), U[1] - 1.0 / (1.0 + end * end));
}

static void test_observed_order(void)
{
    for (const struct solver_integrator *integrator = solver_integrators(); integrator->name != NULL; integrator++) {
        double coarse = error_after(integrator, 200);
        double fine = error_after(integrator, 400);
        double order = log2(coarse / fine);
        printf("\n    %-8s error %.2e, order %.3f", integrator->name, fine, order);
        CU_ASSERT(fine < pow(1.5 / 400, integrator->order)); /* the solution's own scales are one */
        CU_ASSERT(order > integrator->order - 0.1);
        CU_ASSERT(order < integrator->order + 0.3); /* better would mean that the test is blind to the leading error */
    }
}

/* U' = z U for complex z, as a real system. */
static double z_real, z_imaginary;

static void linear(double t, const double *U, double *R)
{
    (void)t;
    R[0] = z_real * U[0] - z_imaginary * U[1];
    R[1] = z_imaginary * U[0] + z_real * U[1];
}

/* With as many stages as orders the stability polynomial is the exponential's, cut off there. */
static void test_stability_polynomial(void)
{
    static const double z[][2] = {{-1.0, 0.0}, {0.0, 1.5}, {-0.7, 1.1}, {0.4, -2.0}, {-2.5, 0.3}};
    for (const struct solver_integrator *integrator = solver_integrators(); integrator->name != NULL; integrator++) {
        CU_ASSERT_EQUAL_FATAL(integrator->stages, integrator->order);
        for (size_t i = 0; i < sizeof z / sizeof *z; i++) {
            double U[2] = {1.0, 0.0};
            double sum[2] = {1.0, 0.0};
            double power[2] = {1.0, 0.0};
            z_real = z[i][0];
            z_imaginary = z[i][1];
            for (int k = 1; k <= integrator->order; k++) { /* z^k / k! */
                double next = (power[0] * z_real - power[1] * z_imaginary) / k;
                power[1] = (power[0] * z_imaginary + power[1] * z_real) / k;
                power[0] = next;
                sum[0] += power[0];
                sum[1] += power[1];
            }
            step(integrator, 2, 0.0, 1.0, linear, U);
            CU_ASSERT_DOUBLE_EQUAL(U[0], sum[0], 2e-15);
            CU_ASSERT_DOUBLE_EQUAL(U[1], sum[1], 2e-15);
        }
    }
}

static void test_table(void)
{
    size_t count = 0;
    for (const struct solver_integrator *integrator = solver_integrators(); integrator->name != NULL; integrator++) {
        CU_ASSERT_PTR_EQUAL(solver_integrator_find(integrator->name), integrator);
        CU_ASSERT_PTR_NOT_NULL(integrator->summary);
        count++;
    }
    CU_ASSERT(count >= 4);
    CU_ASSERT_PTR_NULL(solver_integrator_find("rk5"));
    CU_ASSERT_PTR_NULL(solver_integrator_find(""));
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"the table finds its members", test_table},
        {"stage times, weights and registers fit each other", test_stages},
        {"order conditions hold up to the claimed order and no further", test_order_conditions},
        {"strong stability: convex combinations of Euler steps", test_strong_stability},
        {"observed order on a nonlinear problem", test_observed_order},
        {"stability polynomial is the exponential's", test_stability_polynomial},
    };
    return unit_main("integrators", tests, sizeof tests / sizeof *tests);
}
