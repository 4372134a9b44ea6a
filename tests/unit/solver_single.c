/* A state stored in single precision: what rounding it takes away, and what it must not. */
#include "tests/unit/runs.h"

#include <float.h>

enum { STEPS = 50 };

/* As smooth_motion, of any strength: after a tenth of the time to cross the body, strains are of its order. */
static const char *motion(double strength)
{
    static char text[512];
    (void)snprintf(
        text, sizeof text,
        "local s = %g\n"
        "initial = { velocity = function(X, Y, Z)\n"
        "    return first(s * (0.03 + 0.05 * sin(2 * X + Y + 0.3)), s * (0.02 + 0.04 * cos(3 * Y - X + Z)),\n"
        "    s * 0.05 * sin(2 * Z + X + 0.2)) end }\n",
        strength);
    return text;
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

/* Largest relative difference of displacement, momentum and stress. */
static double difference(struct sample *one, struct sample *other)
{
    struct solver_output a = output_of(one);
    struct solver_output b = output_of(other);
    size_t dim = (size_t)a.cloud->dim;
    double of_vectors = fmax(apart(a.u, b.u, a.cloud->count * dim), apart(a.p, b.p, a.cloud->count * dim));
    return fmax(of_vectors, apart(a.P, b.P, a.cloud->count * dim * dim));
}

static const char *const bodies[] = {
    "dim=3 stencil=sbp2 evolved=pF",
    "dim=3 stencil=closed perturb=0.1 evolved=pFHJ",
    "dim=3 stencil=closed perturb=0.1 evolved=pF material.model=linear-elastic",
    "dim=3 n=12 stencil=sbp4 evolved=pFJ cfl=0.2",
    "dim=3 stencil=sbp2 evolved=pFHJ material.model=linear-elastic integrator=rk4",
    "dim=2 n=9 stencil=closed perturb=0.1 evolved=pFHJ material.model=hencky",
    "dim=2 n=9 stencil=closed perturb=0.1 evolved=pFJ reconstruction=least-squares",
    "dim=2 n=9 stencil=sbp2 evolved=pFJ material.model=neo-hookean-polyconvex integrator=ssp-rk3",
    "dim=1 n=40 stencil=sbp4 evolved=pF reconstruction=none",
    "dim=1 n=40 stencil=sbp2 evolved=pFHJ",
};

static struct sample run_with(const char *precision, double strength, const char *settings)
{
    struct sample sample = start(motion(strength), "precision=%s %s", precision, settings);
    advance(&sample, STEPS);
    return sample;
}

/* Each stage rounds what it stores once, by half a unit in the last place, FLT_EPSILON / 2: of a hundred stages and
 * more that is below a hundred times as much, and something is rounded. Displacements and strains are stored, not
 * places and F, so that a motion a million times smaller is not rounded more. */
static void near_double(const char *precision, double strength)
{
    for (size_t i = 0; i < sizeof bodies / sizeof *bodies; i++) {
        struct sample wide = run_with("double", strength, bodies[i]);
        struct sample other = run_with(precision, strength, bodies[i]);
        double apart_by = difference(&wide, &other);
        expect_below(bodies[i], apart_by, 50.0 * (double)FLT_EPSILON);
        CU_ASSERT(apart_by > 1e-9 || strcmp(precision, "mixed") == 0); /* which sbp2 does not round */
        finish(&wide);
        finish(&other);
    }
}

static void test_near_double(void)
{
    near_double("single", 1.0);
}

static void test_small_motions(void)
{
    near_double("single", 1e-6);
    near_double("mixed", 1e-6); /* a body at rest has no strain */
}

/* Nor is a body far from the origin: a million of its lengths away it does the same, bit for bit, where its particles
 * lie at places that a double holds. */
static void test_far_away(void)
{
    static const char text[] = "local far = %d\n"
                               "domain = { lower = each(far), upper = each(far + 1) }\n"
                               "initial = { velocity = function(X, Y, Z) X = X - far; Y = d > 1 and Y - far or 0\n"
                               "    return first(0.05 * sin(2 * X + Y), 0.04 * cos(3 * Y - X), 0.02 * X) end,\n"
                               "    F = function() if dim == 1 then return 1 elseif dim == 2 then return\n"
                               "    1, 0, 0, 1 end return 1, 0, 0, 0, 1, 0, 0, 0, 1 end }\n";
    for (int dim = 1; dim <= 3; dim++) {
        struct sample sample[2];
        struct solver_output output[2];
        for (int far = 0; far < 2; far++) {
            char elsewhere[512];
            (void)snprintf(elsewhere, sizeof elsewhere, text, far * 1048576);
            sample[far] = start(elsewhere, "dim=%d n=4 precision=single stencil=sbp2", dim);
            advance(&sample[far], STEPS);
            output[far] = output_of(&sample[far]);
        }
        size_t bytes = output[0].cloud->count * (size_t)dim * sizeof(double);
        CU_ASSERT_EQUAL(memcmp(output[0].u, output[1].u, bytes), 0);
        CU_ASSERT_EQUAL(memcmp(output[0].v, output[1].v, bytes), 0);
        CU_ASSERT_EQUAL(memcmp(output[0].P, output[1].P, bytes * (size_t)dim), 0);
        finish(&sample[0]);
        finish(&sample[1]);
    }
}

/* Forces are equal and opposite to round-off of a double; each particle's velocity is then rounded on its own. */
static void test_conserves(void)
{
    for (size_t i = 0; i < sizeof bodies / sizeof *bodies; i++) {
        struct sample sample = start(motion(1.0), "precision=single history=20 %s", bodies[i]);
        struct solver_facts facts = solver_run_facts(sample.run);
        advance_to(&sample, STEPS * 0.8 * sample.scene->cfl * facts.spacing / wave_speed(&sample));
        const struct solver_history *history = solver_run_history(sample.run);
        const struct solver_totals *first = &history->totals[0];
        const struct solver_totals *last = &history->totals[history->count - 1];
        double scale = sqrt(2.0 * facts.mass * first->kinetic);
        CU_ASSERT_FATAL(history->count > 5);
        for (int axis = 0; axis < sample.scene->dim; axis++) {
            expect_below(bodies[i], fabs(last->linear[axis] - first->linear[axis]) / scale, 10.0 * (double)FLT_EPSILON);
        }
        double before = first->kinetic + first->strain;
        expect_below("energy gained", (last->kinetic + last->strain - before) / before, 1e-6);
        finish(&sample);
    }
}

/* Half the bytes of the state, and of the pairs. */
static void test_bytes(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct sample wide = start(motion(1.0), "dim=%d precision=double evolved=pFHJ", dim);
        struct sample mixed = start(motion(1.0), "dim=%d precision=mixed evolved=pFHJ", dim);
        struct sample single = start(motion(1.0), "dim=%d precision=single evolved=pFHJ", dim);
        struct solver_facts of_wide = solver_run_facts(wide.run);
        struct solver_facts of_mixed = solver_run_facts(mixed.run);
        struct solver_facts of_single = solver_run_facts(single.run);
        CU_ASSERT_EQUAL(of_single.state_bytes, 0.5 * of_wide.state_bytes);
        CU_ASSERT(of_single.bytes_per_particle < of_mixed.bytes_per_particle - of_single.state_bytes);
        CU_ASSERT(of_single.step_traffic <
                  (dim == 1 ? 0.8 : 0.6) * of_wide.step_traffic); /* indices are what they were */
        finish(&wide);
        finish(&mixed);
        finish(&single);
    }
}

/* What would overflow, or vanish, is refused. */
static void test_sizes(void)
{
    static const char text[] = "domain = { lower = each(0), upper = each(%g) }\n"
                               "initial = { velocity = function(X) return first(1e-3, 0, 0) end }\n";
    for (int large = 0; large < 2; large++) {
        char body[256];
        (void)snprintf(body, sizeof body, text, large ? 1e9 : 1e-9);
        struct solver_error error = refusal(body, "dim=2 precision=single");
        CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "expected a spacing in [1e-7, 1e7] m"));
        (void)snprintf(body, sizeof body, text, large ? 1e7 : 1e-6);
        struct sample sample = start(body, "dim=2 precision=single t_end=1e6");
        advance(&sample, STEPS);
        struct solver_output output = output_of(&sample);
        for (size_t a = 0; a < output.cloud->count; a++) {
            CU_ASSERT(fabs(output.v[2 * a] - 1e-3) < 1e-8 && fabs(output.v[2 * a + 1]) < 1e-8);
        }
        finish(&sample);
    }
}

/* A broken particle is named, and the last good state is there. */
static void test_breakdown(void)
{
    static const char torn[] = "initial = { velocity = function(X, Y, Z)\n"
                               "    return first(X < 0.5 and 3 or -3, Y, 0) end }\n";
    struct sample sample = start(torn, "dim=2 n=8 precision=single cfl=2 evolved=pF");
    bool ok = solver_run_steps(sample.run, 400, &sample.error);
    CU_ASSERT_FALSE(ok);
    CU_ASSERT_EQUAL(sample.error.code, SOLVER_BROKE_DOWN);
    CU_ASSERT_PTR_NOT_NULL(strstr(sample.error.text, "particle"));
    struct solver_output output = output_of(&sample);
    for (size_t a = 0; a < output.cloud->count; a++) {
        CU_ASSERT(isfinite(output.J[a]) && output.J[a] > 0.0 && isfinite(output.u[2 * a]));
    }
    finish(&sample);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"near double precision", test_near_double},
        {"small motions", test_small_motions},
        {"far away", test_far_away},
        {"momentum and energy", test_conserves},
        {"bytes", test_bytes},
        {"sizes", test_sizes},
        {"breakdown", test_breakdown},
    };
    return unit_main("single precision", tests, sizeof tests / sizeof *tests);
}
