/* Motions so small that their numbers are denormal: nothing becomes infinite or no number, and momentum is kept to the
 * last bit there is. They cost up to 20 times as much; results are not rounded to zero to save that. */
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

static void stays_finite(void)
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
            expect_finite(text);
        }
    }
}

static const struct unit_test tests[] = {
    {"denormal motions stay finite", stays_finite},
};

int main(void)
{
    return unit_main("solver run denormal", tests, sizeof tests / sizeof *tests);
}
