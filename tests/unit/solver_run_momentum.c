/* Runs: a free body keeps its linear momentum. */
#include "tests/unit/runs.h"

/* Pair forces are equal and opposite. */
static const char *const antisymmetric[] = {
    "n=4 stencil=closed support=2.1 perturb=0.15 evolved=pFHJ",
    "n=4 stencil=closed support=2.1 perturb=0.15 evolved=pF material.model=linear-elastic",
    "n=4 stencil=sbp2 evolved=pFHJ",
    "n=4 stencil=sbp2 evolved=pFJ material.model=linear-elastic",
    "n=8 stencil=sbp4 evolved=pF",
    "n=4 stencil=closed support=2.1 evolved=pFJ reconstruction=least-squares",
    "dim=2 n=8 stencil=closed support=2.1 perturb=0.15",
    "dim=1 n=16 stencil=sbp4",
};

static void total_momentum(const struct solver_output *output, long double total[3], double *scale)
{
    size_t dim = (size_t)output->cloud->dim;
    memset(total, 0, 3 * sizeof *total);
    *scale = 0.0;
    for (size_t a = 0; a < output->cloud->count; a++) {
        for (size_t i = 0; i < dim; i++) {
            total[i] += (long double)output->V[a] * (long double)output->p[a * dim + i];
            *scale += output->V[a] * fabs(output->p[a * dim + i]);
        }
    }
}

/* Largest change of linear momentum over 1000 steps, relative to what there is. */
static double momentum_change(const char *settings)
{
    struct sample sample = start(smooth_motion, "%s", settings);
    long double before[3];
    long double after[3];
    double scale;
    double later;
    struct solver_output output = output_of(&sample);
    total_momentum(&output, before, &scale);
    advance(&sample, 1000);
    output = output_of(&sample);
    total_momentum(&output, after, &later);
    double change = 0.0;
    for (int i = 0; i < 3; i++) {
        change = fmax(change, fabs((double)(after[i] - before[i])) / scale);
    }
    finish(&sample);
    return change;
}

static void test_linear_momentum(void)
{
    for (size_t i = 0; i < sizeof antisymmetric / sizeof *antisymmetric; i++) {
        double change = momentum_change(antisymmetric[i]);
        printf("\n    %.1e  %s", change, antisymmetric[i]);
        expect_below(antisymmetric[i], change, 1e-12);
    }
    /* not antisymmetric, but the divergence is the adjoint of the gradient: pair forces are opposite all the same */
    static const char sph[] = "n=4 stencil=sph support=2.0 evolved=pF";
    double change = momentum_change(sph);
    printf("\n    %.1e  %s", change, sph);
    expect_below(sph, change, 1e-12);
}

/* The measure sees a force, however small. */
static void test_measure_sees(void)
{
    struct sample sample = start("body_force = function() return first(1e-9, 0, 0) end\n", "dim=3");
    advance(&sample, 10);
    long double total[3];
    double scale;
    struct solver_output output = output_of(&sample);
    total_momentum(&output, total, &scale);
    CU_ASSERT_DOUBLE_EQUAL((double)total[0] / (1e-9 * output.time), 1.0,
                           1e-12); /* force on the unit block, times time */
    CU_ASSERT_DOUBLE_EQUAL(scale / (1e-9 * output.time), 1.0, 1e-12);
    finish(&sample);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"linear momentum over 1000 steps", test_linear_momentum},
        {"the measure sees a small force", test_measure_sees},
    };
    return unit_main("momentum", tests, sizeof tests / sizeof *tests);
}
