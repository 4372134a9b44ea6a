/* Motions so small that their numbers are denormal: nothing becomes infinite or no number, momentum is kept to the last
 * bit there is, and they are the motions that larger ones are, scaled. They cost up to 20 times as much; results are
 * not rounded to zero to save that. */
#include "tests/unit/runs.h"

#include <float.h>

static const char tiny[] =
    "initial = { velocity = function(X, Y, Z)\n"
    "    return first(1e-310 * sin(2 * X + Y), 2e-310 * cos(3 * Y - X), 1e-310 * sin(X + Z)) end }\n";

static void expect_finite(const char *words)
{
    struct sample sample = start(tiny, "%s", words);
    size_t dim = (size_t)sample.scene->dim;
    double before = 0.0;
    double after = 0.0;
    bool moves = false;
    struct solver_output output = output_of(&sample);
    for (size_t a = 0; a < output.cloud->count; a++) {
        before += output.V[a] * output.p[a * dim];
    }
    advance(&sample, 10);
    output = output_of(&sample);
    for (size_t a = 0; a < output.cloud->count; a++) {
        bool finite = isfinite(output.J[a]) && isfinite(output.pressure[a]) && isfinite(output.von_mises[a]);
        for (size_t i = a * dim; i < (a + 1) * dim; i++) {
            finite = finite && isfinite(output.p[i]) && fabs(output.p[i]) < DBL_MIN && isfinite(output.u[i]);
            moves = moves || output.p[i] != 0.0;
        }
        CU_ASSERT(finite);
        after += output.V[a] * output.p[a * dim];
    }
    CU_ASSERT(moves);
    expect_below("momentum, in last bits of all particles", fabs(after - before),
                 10.0 * (double)output.cloud->count * DBL_TRUE_MIN);
    finish(&sample);
}

static void of_each(void (*expect)(const char *words))
{
    static const char *const words[] = {
        "evolved=pF",
        "evolved=pFHJ",
        "evolved=pFHJ material.model=linear-elastic",
        "evolved=pFHJ material.model=hencky",
        "evolved=pFHJ scheme=jst",
        "scheme=ulsph material.model=linear-elastic ulsph.tension=stress",
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        for (int dim = 1; dim <= 3; dim++) {
            char text[160];
            (void)snprintf(text, sizeof text, "dim=%d %s", dim, words[i]);
            expect(text);
        }
    }
}

static void stays_finite(void)
{
    of_each(expect_finite);
}

enum { STEPS = 10, MOST = 3 * 125 };

/* Momenta after STEPS steps of a motion of this amplitude [m/s]; returns how many numbers. */
static size_t momenta(const char *words, const char *amplitude, double p[MOST])
{
    char motion[256];
    (void)snprintf(motion, sizeof motion,
                   "local a = %s\n"
                   "initial = { velocity = function(X, Y, Z)\n"
                   "    return first(a * sin(2 * X + Y), 2 * a * cos(3 * Y - X), a * sin(X + Z)) end }\n",
                   amplitude);
    struct sample sample = start(motion, "%s", words);
    advance(&sample, STEPS);
    struct solver_output output = output_of(&sample);
    size_t count = output.cloud->count * (size_t)output.cloud->dim;
    CU_ASSERT_FATAL(count <= MOST);
    memcpy(p, output.p, count * sizeof *p);
    finish(&sample);
    return count;
}

/* F is 1 to the last bit at any of these amplitudes, so that all that is left is linear. Scaled by a power of two not a
 * bit differs as long as nothing is denormal; but Hencky's law takes principal directions where all but round-off is
 * isotropic: these have round-off of their own, and which comes first, squares say that only the larger motion has.
 * Denormal, each operation rounds off DBL_TRUE_MIN / 2: the momentum of a particle takes at most 200 pairs of 10
 * operations, in two stages of a step. The updated-Lagrangian scheme divides what it summed up by the particle's
 * volume, 1/512 at a corner of a cube, and takes it times the step, 0.05. */
static void expect_scaled(const char *words)
{
    static double normal[MOST], small[MOST], denormal[MOST];
    size_t count = momenta(words, "0x1p-100", normal);
    CU_ASSERT_EQUAL_FATAL(momenta(words, "0x1p-900", small), count);
    CU_ASSERT_EQUAL_FATAL(momenta(words, "0x1p-1040", denormal), count);
    bool directions = strstr(words, "dim=1") == NULL && strstr(words, "hencky") != NULL;
    double volumes = strstr(words, "ulsph") != NULL ? 0.05 * 512 : 1.0;
    double apart = 0.0, off = 0.0, most = 0.0;
    for (size_t i = 0; i < count; i++) {
        most = fmax(most, fabs(normal[i]));
        apart = fmax(apart, fabs(normal[i] - ldexp(small[i], 800)));
        off = fmax(off, fabs(ldexp(normal[i], -940) - denormal[i]) / DBL_TRUE_MIN);
    }
    CU_ASSERT(apart <= (directions ? 8 * DBL_EPSILON * most : 0.0));
    expect_below("momenta, in last bits", off, volumes * 0.5 * STEPS * 2 * 200 * 10);
}

static void is_the_same_scaled(void)
{
    of_each(expect_scaled);
}

static const struct unit_test tests[] = {
    {"denormal motions stay finite", stays_finite},
    {"denormal motions are the same, scaled", is_the_same_scaled},
};

int main(void)
{
    return unit_main("solver run denormal", tests, sizeof tests / sizeof *tests);
}
