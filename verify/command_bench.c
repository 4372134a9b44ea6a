/* assay bench: what a particle-step costs, beside what the machine's memory allows. */
#include "verify/commands.h"
#include "verify/find.h"
#include "verify/overrides.h"
#include "verify/simulate.h"
#include "verify/study.h"
#include "verify/timing.h"

#include "solver/integrator.h"
#include "solver/run.h"
#include "solver/stencil.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* `stencil` and `evolved` are NULL where the scheme has none. */
static bool row(const struct verify_options *options, const char *stencil, const char *evolved,
                struct solver_error *error)
{
    struct verify_options with = *options;
    char text[5][SOLVER_NAME];
    verify_say_unless(&with, "stencil", text[0], stencil);
    verify_say_unless(&with, "evolved", text[1], evolved);
    verify_say_unless(&with, "integrator", text[2], "tvd-rk2");
    verify_say_unless(&with, "cfl", text[3], "0.3");
    verify_say_unless(&with, "threads", text[4], "1");
    struct solver_scene *scene = NULL;
    struct solver_run *run = NULL;
    double seconds;
    bool done = verify_scene_open(&with, 0, &scene, error) && verify_run_create(scene, &run, error) &&
                verify_time_steps(run, &seconds, error);
    if (done) {
        struct solver_facts facts = solver_run_facts(run);
        double particles = (double)facts.particles;
        double neighbours = (double)facts.pairs / particles;
        double per_particle = 1e9 * seconds / particles;
        double bandwidth = verify_bandwidth(facts.bytes_per_particle * particles, facts.threads);
        double limit = bandwidth > 0.0 ? 1e9 * facts.step_traffic / bandwidth : NAN;
        (void)printf("%-8s %-6s %10zu %10.1f %8.1f %10.1f %10.2f %8.0f %8.0f %10.1f %8.0f %%\n",
                     stencil != NULL ? stencil : "-", evolved != NULL ? evolved : "-", facts.particles, neighbours,
                     facts.setup_seconds, per_particle,
                     per_particle / (neighbours * solver_integrator_find(scene->integrator)->stages),
                     facts.bytes_per_particle, facts.step_traffic, 1e-9 * bandwidth, 100.0 * limit / per_particle);
        (void)fflush(stdout);
    }
    solver_run_free(run);
    solver_scene_free(scene);
    return done;
}

/* A row for each stencil and evolved set, as far as the command line leaves them open. */
static bool rows(const struct verify_options *options, struct solver_error *error)
{
    static const char *const evolved[] = {"pF", "pFJ", "pFHJ"};
    for (const struct solver_stencil_builder *builder = solver_stencil_builders(); builder->name != NULL; builder++) {
        for (size_t i = 0; i < sizeof evolved / sizeof *evolved; i++) {
            const char *only_stencil = verify_said(options, "stencil");
            const char *only_evolved = verify_said(options, "evolved");
            bool wanted = (only_stencil == NULL || strcmp(only_stencil, builder->name) == 0) &&
                          (only_evolved == NULL || strcmp(only_evolved, evolved[i]) == 0);
            if (wanted && !row(options, builder->name, evolved[i], error)) {
                return false;
            }
        }
    }
    return true;
}

int verify_command_bench(const struct verify_options *options)
{
    struct solver_error error = {.code = SOLVER_OK};
    struct solver_scene *scene = NULL;
    if (!verify_scene_open(options, 0, &scene, &error)) {
        return verify_complain(&error);
    }
    bool stencil = verify_has_stencil(scene);
    solver_scene_free(scene);
    (void)printf("%-8s %-6s %10s %10s %8s %10s %10s %8s %8s %10s %10s\n", "stencil", "set", "particles", "neighbours",
                 "set-up s", "ns/p-step", "ns/nb-rhs", "B/part.", "B moved", "triad GB/s", "of limit");
    if (stencil ? !rows(options, &error) : !row(options, NULL, NULL, &error)) {
        return verify_complain(&error);
    }
    (void)printf(
        "\nns/p-step: one particle's step, best of %d samples. ns/nb-rhs: the same per neighbour and right-hand side.\n"
        "B/part.: memory per particle. B moved: what a step moves if every array streams once per pass.\n"
        "of limit: the time which that traffic takes at the triad bandwidth measured on arrays as large as the\n"
        "run's, over the time measured. Well under 100 %%: arithmetic limits, not memory.\n",
        VERIFY_SAMPLES);
    return VERIFY_PASSED;
}
