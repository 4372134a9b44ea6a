/* Spectra: stability functions against their polynomials, stable steps against the known limits of the methods, and the
 * eigenvalues of a free bar against its frequencies. */
#include "unit.h"

#include "solver/material.h"
#include "solver/spectrum.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void stability_functions_are_the_exponential_to_the_order(void)
{
    const double complex z = -0.3 + 0.7 * _Complex_I;
    for (const struct solver_integrator *integrator = solver_integrators(); integrator->name != NULL; integrator++) {
        double complex term = 1.0, sum = 1.0; /* each has as many stages as its order */
        for (int k = 1; k <= integrator->order; k++) {
            term *= z / k;
            sum += term;
        }
        CU_ASSERT_EQUAL(integrator->order, integrator->stages);
        CU_ASSERT(cabs(solver_stability_function(integrator, z) - sum) < 1e-15);
    }
}

static void stable_steps_are_the_known_limits(void)
{
    const double complex decay = -1.0, oscillation = _Complex_I;
    static const struct {
        const char *name;
        double decay, oscillation;
    } known[] = {{"euler", 2.0, 0.0},
                 {"tvd-rk2", 2.0, 0.0},
                 {"ssp-rk3", 2.51274532661833, 1.73205080756888},
                 {"rk4", 2.78529356340528, 2.82842712474619}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        const struct solver_integrator *integrator = solver_integrator_find(known[i].name);
        CU_ASSERT_DOUBLE_EQUAL(solver_stable_step(integrator, &decay, 1, 1e-12), known[i].decay, 1e-5);
        double step = solver_stable_step(integrator, &oscillation, 1, 1e-12);
        if (known[i].oscillation > 0.0) {
            CU_ASSERT_DOUBLE_EQUAL(step, known[i].oscillation, 1e-5);
        } else {
            CU_ASSERT(step < 0.01); /* what a growth of 1e-12 still allows */
        }
    }
    const double complex still = 0.0;
    CU_ASSERT(isinf(solver_stable_step(solver_integrator_find("rk4"), &still, 1, 1e-12)));
}

/* Along a ray just right of the imaginary axis small steps grow, and larger ones do not: what grows at any shorter step
 * is not stable. */
static void shorter_steps_must_hold_too(void)
{
    const struct solver_integrator *integrator = solver_integrator_find("rk4");
    const double complex growing = 1e-3 + _Complex_I;
    CU_ASSERT(cabs(solver_stability_function(integrator, 2.0 * growing)) < 1.0);
    CU_ASSERT(solver_stable_step(integrator, &growing, 1, 1e-12) < 1e-8);
}

static struct solver_run *bar(const char *const *overrides, size_t count, struct solver_scene **scene)
{
    struct solver_error error;
    struct solver_run *run = NULL;
    if (!solver_scene_load(TEST_SOURCE_DIR "/verify/scenes/free-block.lua", overrides, count, scene, &error) ||
        !solver_run_create(*scene, &run, &error)) {
        CU_FAIL_FATAL("no run of the free block");
    }
    return run;
}

/* Without dissipation the eigenvalues are i times frequencies, the lowest that of half a wave along the bar: pi c / L,
 * to second order in the spacing. */
static void a_free_bar_has_its_frequencies(void)
{
    const char *overrides[] = {"d=1", "n=32", "scheme=jst", "jst.kappa4=0", "material.model=linear-elastic"};
    struct solver_scene *scene = NULL;
    struct solver_run *run = bar(overrides, 5, &scene);
    struct solver_error error;
    double complex *eigenvalue = NULL;
    size_t count = 0;
    CU_ASSERT_FATAL(solver_run_spectrum(run, &eigenvalue, &count, &error));
    double c = solver_material_constants(scene->E, scene->nu, scene->rho).cp;
    double lowest = INFINITY, damping = 0.0;
    for (size_t i = 0; i < count; i++) {
        double frequency = fabs(cimag(eigenvalue[i]));
        damping = fmax(damping, fabs(creal(eigenvalue[i])));
        lowest = frequency > 1e-3 * c ? fmin(lowest, frequency) : lowest;
    }
    CU_ASSERT(fabs(lowest / (M_PI * c) - 1.0) < 2.0 / (32.0 * 32.0));
    CU_ASSERT(damping < 1e-4 * c);
    free(eigenvalue);
    solver_run_free(run);
    solver_scene_free(scene);
}

/* The state is as it was, to the bit: steps go on as if nothing had been asked. */
static void a_spectrum_leaves_the_run_alone(void)
{
    const char *overrides[] = {"d=2", "n=3", "random=1", "material.model=linear-elastic", "threads=1"};
    struct solver_scene *scene[2] = {NULL, NULL};
    struct solver_run *run[2] = {bar(overrides, 5, &scene[0]), bar(overrides, 5, &scene[1])};
    struct solver_output out[2];
    struct solver_error error;
    double complex *eigenvalue = NULL;
    size_t count;
    CU_ASSERT_FATAL(solver_run_spectrum(run[0], &eigenvalue, &count, &error));
    for (int i = 0; i < 2; i++) {
        CU_ASSERT_FATAL(solver_run_steps(run[i], 5, &error) && solver_run_output(run[i], &out[i], &error));
    }
    CU_ASSERT_EQUAL(memcmp(out[0].v, out[1].v, out[0].cloud->count * 2 * sizeof(double)), 0);
    free(eigenvalue);
    for (int i = 0; i < 2; i++) {
        solver_run_free(run[i]);
        solver_scene_free(scene[i]);
    }
}

static void what_has_no_spectrum_is_refused(void)
{
    const char *large[] = {"d=3", "n=8"};
    const char *held[] = {"d=2", "n=3", "angular_momentum=projected"};
    const char *single[] = {"d=2", "n=3", "precision=single"};
    struct {
        const char *const *overrides;
        size_t count;
    } cases[] = {{large, 2}, {held, 3}, {single, 3}};
    for (size_t i = 0; i < 3; i++) {
        struct solver_scene *scene = NULL;
        struct solver_run *run = bar(cases[i].overrides, cases[i].count, &scene);
        struct solver_error error = {.code = SOLVER_OK};
        double complex *eigenvalue = NULL;
        size_t count;
        CU_ASSERT_FALSE(solver_run_spectrum(run, &eigenvalue, &count, &error));
        CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
        CU_ASSERT_PTR_NULL(eigenvalue);
        solver_run_free(run);
        solver_scene_free(scene);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"stability functions are the exponential to the order", stability_functions_are_the_exponential_to_the_order},
        {"stable steps are the known limits", stable_steps_are_the_known_limits},
        {"shorter steps must hold too", shorter_steps_must_hold_too},
        {"a free bar has its frequencies", a_free_bar_has_its_frequencies},
        {"a spectrum leaves the run alone", a_spectrum_leaves_the_run_alone},
        {"what has no spectrum is refused", what_has_no_spectrum_is_refused},
    };
    return unit_main("spectrum", tests, sizeof tests / sizeof *tests);
}
