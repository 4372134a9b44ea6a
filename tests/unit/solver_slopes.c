/* Slopes along lattice lines where spacings change or materials meet: small bodies lose energy by their eigenvalues
 * with those that a scene has unless it asks for others, and gain with those of the stencil. */
#include "solver/run.h"
#include "solver/spectrum.h"
#include "tests/unit/runs.h"

#include <stdlib.h>

/* Beyond a plane, or a slanted one, E is `stiff` times, rho `heavy` times what it is before. */
struct body {
    const char *settings;
    double stiff, heavy, slant, beyond;
    double before, after; /* growth per step with slopes of the stencil, at least, and with others, at most */
};

static const struct body bodies[] = {
    {"dim=1 n=24 stencil=sbp4 evolved=pFJ grading.X=10", 1, 1, 0, 0, 1e-3, 1e-7},
    {"dim=1 n=11 stencil=sbp4 evolved=pFJ grading.X=4", 1, 1, 0, 0, 1e-3, 1e-7},
    {"dim=2 n=8 stencil=sbp4 evolved=pF grading.X=4 grading.fine_X=both", 1, 1, 0, 0, 1e-2, 1e-7},
    {"dim=2 n=8 stencil=sbp4 evolved=pFJ grading.X=4 grading.fine_X=both", 1, 1, 0, 0, 1e-2, 1e-7},
    {"dim=2 n=8 stencil=sbp4 evolved=pFJ", 0.01, 0.01, 0.3, 0.5, 1e-3, 2e-5},
    {"dim=1 n=12 stencil=sbp4 evolved=pFJ", 100, 1, 0, 0.9, 1e-2, 2e-5},
    {"dim=1 n=12 stencil=sbp4 evolved=pF", 0.01, 100, 0, 0.01, 5e-3, 2e-5},
    {"dim=2 n=6 stencil=sbp2 evolved=pF", 0.01, 0.01, 0, 0.9, 5e-3, 2e-5},
    {"dim=1 n=12 stencil=sbp2 evolved=pF grading.X=10", 0.01, 0.01, 0, 0.8, 5e-3, 2e-5},
    {"dim=1 n=12 stencil=sbp2 evolved=pFJ grading.X=10", 0.01, 0.01, 0, 0.8, 1e-3, 2e-5},
    {"dim=1 n=24 stencil=sbp2 evolved=pF grading.X=10 grading.fine_X=middle", 0.01, 0.01, 0, 0.9, 0, 2e-5},
    {"dim=1 n=24 stencil=sbp4 evolved=pFJ grading.X=10", 100, 1, 0, 0.9, 0, 2e-5},
};
enum { BODIES = sizeof bodies / sizeof *bodies };

static double growth_of(const struct body *body, const char *slopes)
{
    char material[512] = "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2 }\n";
    if (body->stiff != 1.0 || body->heavy != 1.0) {
        (void)snprintf(material, sizeof material,
                       "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2, at = function(X, Y, Z)\n"
                       "    local beyond = X - %g * (d > 1 and Y or 0) > %g\n"
                       "    return beyond and 3 * %g or 3, 0.3, beyond and 2 * %g or 2 end }\n",
                       body->slant, body->beyond, body->stiff, body->heavy);
    }
    struct sample sample = start(material, "threads=1 integrator=rk4 cfl=0.8 %s %s", body->settings, slopes);
    double complex *eigenvalue = NULL;
    size_t count;
    double growth = 0.0;
    double step = solver_run_facts(sample.run).step;
    CU_ASSERT_FATAL(solver_run_spectrum(sample.run, &eigenvalue, &count, &sample.error));
    for (size_t i = 0; i < count; i++) {
        growth = fmax(growth, creal(eigenvalue[i]) * step);
    }
    free(eigenvalue);
    finish(&sample);
    return growth;
}

/* Where materials meet eigenvalues are rounded to 1e-5. */
static void test_growth(void)
{
    for (size_t i = 0; i < BODIES; i++) {
        expect_below(bodies[i].settings, growth_of(&bodies[i], ""), bodies[i].after);
        if (bodies[i].before > 0.0) {
            expect_below("slopes of the stencil", bodies[i].before, growth_of(&bodies[i], "reconstruction=stencil"));
        }
    }
}

/* A run tells the same: it has lost energy in the end, or ends before. */
static bool loses_energy(const char *slopes)
{
    static const char motion[] = "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2 }\n"
                                 "history = 10\n"
                                 "initial = { velocity = function(X, Y, Z) return 1e-3 * cos(math.pi * X), 0 end }\n";
    struct sample sample = start(motion,
                                 "dim=2 n=8 stencil=sbp4 evolved=pF integrator=rk4 cfl=0.8 grading.X=4 "
                                 "grading.fine_X=both threads=1 t_end=200 %s",
                                 slopes);
    bool loses = solver_run_to(sample.run, 200.0, NULL, NULL, &sample.error);
    if (loses) {
        const struct solver_history *history = solver_run_history(sample.run);
        const struct solver_totals *first = &history->totals[0];
        const struct solver_totals *last = &history->totals[history->count - 1];
        CU_ASSERT(history->count > 5 && last->time > 100.0);
        loses = last->kinetic + last->strain < first->kinetic + first->strain;
    }
    finish(&sample);
    return loses;
}

static void test_run(void)
{
    CU_ASSERT(loses_energy(""));
    CU_ASSERT_FALSE(loses_energy("reconstruction=stencil"));
}

static void test_default(void)
{
    static const char one[] = "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2 }\n";
    static const char two[] = "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2,\n"
                              "             at = function(X) return X > 0.5 and 6 or 3, 0.3, 2 end }\n";
    static const struct {
        const char *material, *words, *slopes;
    } scenes[] = {
        {one, "stencil=sbp4", "stencil"},
        {one, "stencil=sbp4 grading.X=2", "lattice"},
        {one, "stencil=sbp4 grading.Y=2 precision=mixed", "lattice"},
        {one, "stencil=sbp4 grading.X=2 precision=single", "least-squares"},
        {one, "stencil=sbp4 grading.X=2 scheme=jst", "stencil"},
        {one, "stencil=sbp4 grading.X=2 reconstruction=stencil", "stencil"},
        {one, "stencil=sbp4 grading.X=2 incompressible.solver=poisson material.nu=0.5 evolved=pFJ", "stencil"},
        {one, "stencil=sbp2 grading.X=2", "stencil"},
        {two, "stencil=sbp2", "lattice"},
        {two, "stencil=sbp4", "lattice"},
        {two, "stencil=sbp4 precision=single", "lattice"},
        {two, "stencil=sbp2 grading.X=2 precision=single", "least-squares"},
        {two, "stencil=closed", "stencil"},
    };
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct sample sample = start(scenes[i].material, "dim=2 n=12 %s", scenes[i].words);
        CU_ASSERT_STRING_EQUAL(sample.scene->reconstruction, scenes[i].slopes);
        finish(&sample);
    }
    static const char lattice[] = "reconstruction=lattice";
    expect_refused(one, "lattice is for scheme = \"upwind\"", "dim=2 stencil=closed %s", lattice);
    expect_refused(one, "lattice is for scheme = \"upwind\"", "dim=2 stencil=sbp2 scheme=jst %s", lattice);
    expect_refused(one, "expected stencil, least-squares or none", "dim=2 precision=single grading.X=2 %s", lattice);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"spectra of uneven bodies", test_growth},
        {"a run over many steps", test_run},
        {"which slopes a scene has", test_default},
    };
    return unit_main("slopes", tests, sizeof tests / sizeof *tests);
}
