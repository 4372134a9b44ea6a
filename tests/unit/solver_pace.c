/* Steps of composite bodies on graded lattices: by the smallest spacing over wave speed of any particle and its
 * neighbours, not by the smallest spacing of one place and the fastest wave of another; short enough by their
 * eigenvalues, and longer than those of either alone where coarse places are stiff. */
#include "solver/run.h"
#include "solver/spectrum.h"
#include "tests/unit/runs.h"

#include <stdlib.h>

/* Beyond a plane, or a slanted one, E is `stiff` times, rho `heavy` times what it is before. */
struct composite {
    double stiff, heavy, slant;
};

static struct sample body_of(const char *settings, const char *material, struct composite of)
{
    char more[512];
    (void)snprintf(more, sizeof more,
                   "material = { model = '%s', E = 3, nu = 0.3, rho = 2, at = function(X, Y, Z)\n"
                   "    local beyond = X - %g * (d > 1 and Y or 0) > 0.3\n"
                   "    return beyond and 3 * %g or 3, 0.3, beyond and 2 * %g or 2 end }\n",
                   material, of.slant, of.stiff, of.heavy);
    return start(more, "threads=1 %s", settings);
}

/* The largest stable step over the scene's: by eigenvalues, with the scene's integrator. Those of bodies so uneven are
 * rounded to a growth of 1e-5 per step. */
static double margin_of(const char *settings, struct composite of)
{
    struct sample sample = body_of(settings, "linear-elastic", of);
    double complex *eigenvalue = NULL;
    size_t count;
    double step = solver_run_facts(sample.run).step;
    CU_ASSERT_FATAL(solver_run_spectrum(sample.run, &eigenvalue, &count, &sample.error));
    double stable = solver_stable_step(solver_integrator_find(sample.scene->integrator), eigenvalue, count, 1e-4);
    free(eigenvalue);
    finish(&sample);
    return stable / step;
}

static const char *const fine[] = {"lower", "upper", "both", "middle"};

static const struct composite bodies[] = {{100, 1, 0},   {0.01, 1, 0},    {1, 100, 0},    {1, 0.01, 0},
                                          {100, 100, 0}, {0.01, 0.01, 0}, {100, 0.01, 0}, {0.01, 100, 0},
                                          {100, 1, 0.3}, {0.01, 1, 0.3},  {100, 100, 0.3}};
enum { STRAIGHT = 8, BODIES = sizeof bodies / sizeof *bodies };

/* At CFL numbers that even lattices of one material hold. What grows however short the step is not looked at: {p,F,J}
 * on sbp4 where the fine end of a lattice is at a face, whatever the material, by 1e-4 per step (solver_slopes.c). */
static void test_stable(void)
{
    static const char *const rows[] = {
        "dim=1 n=24 grading.X=10 stencil=sbp2 evolved=pF integrator=rk4 cfl=0.9",
        "dim=1 n=24 grading.X=10 stencil=sbp2 evolved=pFJ integrator=tvd-rk2 cfl=0.3",
        "dim=1 n=24 grading.X=10 stencil=sbp4 evolved=pF integrator=rk4 cfl=0.8",
        "dim=1 n=24 grading.X=10 stencil=sbp2 evolved=pF scheme=jst integrator=rk4 cfl=0.9",
        "dim=2 n=6 grading.X=4 grading.Y=2 stencil=sbp2 evolved=pF integrator=rk4 cfl=0.9",
        "dim=2 n=6 grading.X=4 grading.Y=2 stencil=sbp2 evolved=pF scheme=jst integrator=rk4 cfl=0.9",
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        double least = INFINITY;
        for (size_t b = 0; b < (rows[r][4] == '1' ? STRAIGHT : BODIES); b++) {
            for (size_t f = 0; f < 4; f++) {
                char words[256];
                (void)snprintf(words, sizeof words, "%s grading.fine_X=%s", rows[r], fine[f]);
                double margin = margin_of(words, bodies[b]);
                least = fmin(least, margin);
                if (!(margin >= 1.0)) {
                    (void)printf("\n    %s, E times %g, rho times %g, slant %g: %.3f", words, bodies[b].stiff,
                                 bodies[b].heavy, bodies[b].slant, margin);
                    CU_FAIL("the step is too long");
                }
            }
        }
        (void)printf("\n    %s: RK4's or RK2's limit over it %.3f and more", rows[r], least);
    }
}

static double step_of(const char *words, const char *material, struct composite of)
{
    struct sample sample = body_of(words, material, of);
    double step = solver_run_facts(sample.run).step;
    finish(&sample);
    return step;
}

/* Where the fine end is of soft material, ten times as slow, the step is longer than by the fastest wave and the finest
 * place: by as much as the places are coarser where the stiff one begins, 3.5 times on a line. Where it is stiff it is
 * the same. So in all materials, precisions and schemes. */
static void test_saved(void)
{
    static const char *const materials[] = {"linear-elastic", "neo-hookean", "hencky"};
    static const char *const kinds[] = {"scheme=upwind", "scheme=jst", "scheme=upwind precision=single",
                                        "scheme=upwind precision=mixed"};
    static const struct composite soft = {100, 1, 0};
    static const struct composite stiff = {0.01, 1, 0};
    for (size_t m = 0; m < 3; m++) {
        for (size_t k = 0; k < 4; k++) {
            for (int dim = 1; dim <= 3; dim++) {
                char words[256];
                (void)snprintf(words, sizeof words, "dim=%d n=%d stencil=sbp2 evolved=pF grading.X=10 %s", dim,
                               dim == 1 ? 24 : 10, kinds[k]);
                double all_stiff = step_of(words, materials[m], (struct composite){1, 1, 0}) / 10.0;
                double saved = step_of(words, materials[m], soft) / all_stiff;
                double spent = step_of(words, materials[m], stiff) / (10.0 * all_stiff);
                CU_ASSERT(saved > 3.1 && saved < 3.6);
                CU_ASSERT(spent > 0.999 && spent < 1.001);
                if (m == 0 && k == 0) {
                    (void)printf("\n    %dD: steps %.2f times as long as by the fastest wave and the finest place", dim,
                                 saved);
                }
            }
        }
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"short enough by their eigenvalues", test_stable},
        {"longer where stiff places are coarse", test_saved},
    };
    return unit_main("pace", tests, sizeof tests / sizeof *tests);
}
