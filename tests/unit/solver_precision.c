/* Pair vectors in single precision: what rounding them takes away, and what it must not. */
#include "solver/stencil.h"
#include "tests/unit/runs.h"

#include <float.h>

enum { STEPS = 50 };

static struct sample run_with(const char *precision, const char *settings)
{
    struct sample sample = start(smooth_motion, "precision=%s %s", precision, settings);
    advance(&sample, STEPS);
    return sample;
}

/* Largest difference between two arrays, relative to the largest entry of the first. */
static double apart(const double *left, const double *right, size_t count)
{
    double most = 0.0;
    double scale = DBL_MIN;
    for (size_t i = 0; i < count; i++) {
        most = fmax(most, fabs(left[i] - right[i]));
        scale = fmax(scale, fabs(left[i]));
    }
    return most / scale;
}

/* Largest relative difference of momentum and stress. */
static double difference(struct sample *one, struct sample *other)
{
    struct solver_output a = output_of(one);
    struct solver_output b = output_of(other);
    size_t dim = (size_t)a.cloud->dim;
    return fmax(apart(a.p, b.p, a.cloud->count * dim), apart(a.P, b.P, a.cloud->count * dim * dim));
}

static const char *const rounded[] = {
    "dim=3 stencil=closed perturb=0.1 evolved=pFHJ",
    "dim=3 stencil=closed perturb=0.1 evolved=pF material.model=linear-elastic",
    "dim=3 n=12 stencil=sbp4 evolved=pFJ cfl=0.2",
    "dim=2 n=9 stencil=closed perturb=0.1 evolved=pFHJ",
    "dim=2 n=9 stencil=closed perturb=0.1 evolved=pFJ reconstruction=least-squares",
    "dim=1 n=40 stencil=sbp4 evolved=pF reconstruction=none",
};

/* The size of a number rounded to single precision, and no larger; but not none: something is rounded. */
static void test_near_double(void)
{
    for (size_t i = 0; i < sizeof rounded / sizeof *rounded; i++) {
        struct sample wide = run_with("double", rounded[i]);
        struct sample mixed = run_with("mixed", rounded[i]);
        double apart_by = difference(&wide, &mixed);
        if (!(apart_by < 1e-5 && apart_by > 1e-12)) {
            printf("\n    %s: differs by %.2e", rounded[i], apart_by);
        }
        CU_ASSERT(apart_by < 1e-5);
        CU_ASSERT(apart_by > 1e-12);
        finish(&wide);
        finish(&mixed);
    }
}

/* Weights that single precision holds are not rounded, only in other units. */
static void test_exact_on_lattices(void)
{
    static const char *const settings[] = {"dim=3 stencil=sbp2 evolved=pFHJ", "dim=2 n=9 stencil=sbp2 evolved=pF",
                                           "dim=1 n=40 stencil=sbp2 evolved=pFJ"};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        struct sample wide = run_with("double", settings[i]);
        struct sample mixed = run_with("mixed", settings[i]);
        expect_below(settings[i], difference(&wide, &mixed), 1e-12);
        expect_below("closure and linear exactness", solver_run_facts(mixed.run).stencil_residual, 1e-14);
        finish(&wide);
        finish(&mixed);
    }
}

/* Forces are opposite and equal to round-off of a double, and nothing feeds energy in. */
static void test_conserves(void)
{
    for (size_t i = 0; i < sizeof rounded / sizeof *rounded; i++) {
        struct sample sample = start(smooth_motion, "precision=mixed history=20 %s", rounded[i]);
        struct solver_facts facts = solver_run_facts(sample.run);
        advance_to(&sample, STEPS * 0.8 * sample.scene->cfl * facts.spacing / wave_speed(&sample));
        const struct solver_history *history = solver_run_history(sample.run);
        const struct solver_totals *first = &history->totals[0];
        const struct solver_totals *last = &history->totals[history->count - 1];
        double scale = sqrt(2.0 * facts.mass * first->kinetic);
        CU_ASSERT_FATAL(history->count > 5);
        for (int axis = 0; axis < sample.scene->dim; axis++) {
            expect_below(rounded[i], fabs(last->linear[axis] - first->linear[axis]) / scale, 1e-13);
        }
        double before = first->kinetic + first->strain;
        expect_below("energy gained", (last->kinetic + last->strain - before) / before, 1e-6);
        finish(&sample);
    }
}

/* Four bytes less for each number of a pair, and nothing else more; of lattices too small to share rows. */
static void test_bytes(void)
{
    for (size_t dim = 1; dim <= 3; dim++) {
        struct sample wide = start(smooth_motion, "dim=%zu precision=double stencil=sbp2 n=2", dim);
        struct sample mixed = start(smooth_motion, "dim=%zu precision=mixed stencil=sbp2 n=2", dim);
        struct solver_facts of_wide = solver_run_facts(wide.run);
        struct solver_facts of_mixed = solver_run_facts(mixed.run);
        double saved = (double)(of_wide.pairs * (dim + 1) * (sizeof(double) - sizeof(float)));
        double bytes = (of_wide.bytes_per_particle - of_mixed.bytes_per_particle) * (double)of_wide.particles;
        CU_ASSERT_DOUBLE_EQUAL(bytes, saved, 1e-6 * saved);
        finish(&wide);
        finish(&mixed);
    }
}

static void test_refused(void)
{
    struct solver_stencil stencil = {.dim = 1, .transposed = (double[]){0.0}};
    struct solver_error error;
    CU_ASSERT_FALSE(solver_stencil_narrow(&stencil, &error));
    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "antisymmetric"));
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"near double precision", test_near_double},      {"exact on lattices", test_exact_on_lattices},
        {"momentum and energy", test_conserves},          {"bytes", test_bytes},
        {"refused where it means nothing", test_refused},
    };
    return unit_main("precision", tests, sizeof tests / sizeof *tests);
}
