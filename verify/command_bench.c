/* assay bench: what a particle-step costs, beside what the machine's memory allows. */
#include "verify/commands.h"
#include "verify/find.h"
#include "verify/simulate.h"
#include "verify/study.h"

#include "solver/integrator.h"
#include "solver/run.h"
#include "solver/stencil.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { REPEATS = 7 };
static const double shortest_sample = 0.05; /* [s] */

/* Bytes per second of y = a + s b over arrays of `bytes` altogether: the best of several passes, three numbers moved
 * per entry, as STREAM counts. 0 if there is no memory for it. */
static double triad(double bytes, int threads)
{
    size_t count = (size_t)(bytes / (3.0 * sizeof(double))) + 1;
    double *y = malloc(count * sizeof *y);
    double *a = malloc(count * sizeof *a);
    double *b = malloc(count * sizeof *b);
    double best = INFINITY;
    if (y != NULL && a != NULL && b != NULL) {
        double check = 0.0;
#pragma omp parallel for schedule(static) num_threads(threads)
        for (size_t i = 0; i < count; i++) {
            y[i] = 0.0;
            a[i] = (double)i;
            b[i] = 1.0;
        }
        for (int repeat = 0; repeat < 3 * REPEATS; repeat++) {
            double begun = omp_get_wtime();
#pragma omp parallel for schedule(static) num_threads(threads)
            for (size_t i = 0; i < count; i++) {
                y[i] = a[i] + 0.5 * b[i] * (double)repeat;
            }
            best = fmin(best, omp_get_wtime() - begun);
            check += y[(size_t)repeat % count]; /* the sums are wanted: no pass may be left out */
        }
        best = check >= 0.0 ? best : INFINITY;
    }
    double entries = (double)count;
    free(y);
    free(a);
    free(b);
    return isfinite(best) ? 3.0 * sizeof(double) * entries / best : 0.0;
}

/* Seconds per step: the best of several samples, each long enough for the clock. */
static bool time_steps(struct solver_run *run, double *seconds, struct solver_error *error)
{
    size_t steps = 1;
    *seconds = INFINITY;
    for (int repeat = 0; repeat < REPEATS;) {
        double before = solver_run_facts(run).seconds;
        if (!solver_run_steps(run, steps, error)) {
            return false;
        }
        double sample = solver_run_facts(run).seconds - before;
        if (sample < shortest_sample && repeat == 0) {
            steps *= 2;
            continue;
        }
        *seconds = fmin(*seconds, sample / (double)steps);
        repeat++;
    }
    return true;
}

/* What the command line says of a key, or NULL. */
static const char *said(const struct verify_options *options, const char *key)
{
    size_t length = strlen(key);
    for (size_t i = options->override_count; i-- > 0;) {
        if (strncmp(options->override[i], key, length) == 0 && options->override[i][length] == '=') {
            return options->override[i] + length + 1;
        }
    }
    return NULL;
}

/* Adds KEY=VALUE unless the command line says something of the key, or there is no value. */
static void set(struct verify_options *options, const char *key, char text[SOLVER_NAME], const char *value)
{
    if (value != NULL && said(options, key) == NULL && options->override_count < VERIFY_OVERRIDES) {
        (void)snprintf(text, SOLVER_NAME, "%s=%s", key, value);
        options->override[options->override_count++] = text;
    }
}

/* `stencil` and `evolved` are NULL where the scheme has none. */
static bool row(const struct verify_options *options, const char *stencil, const char *evolved,
                struct solver_error *error)
{
    struct verify_options with = *options;
    char text[5][SOLVER_NAME];
    set(&with, "stencil", text[0], stencil);
    set(&with, "evolved", text[1], evolved);
    set(&with, "integrator", text[2], "tvd-rk2");
    set(&with, "cfl", text[3], "0.3");
    set(&with, "threads", text[4], "1");
    struct solver_scene *scene = NULL;
    struct solver_run *run = NULL;
    double seconds;
    bool done = verify_scene_open(&with, 0, &scene, error) && verify_run_create(scene, &run, error) &&
                time_steps(run, &seconds, error);
    if (done) {
        struct solver_facts facts = solver_run_facts(run);
        double particles = (double)facts.particles;
        double neighbours = (double)facts.pairs / particles;
        double per_particle = 1e9 * seconds / particles;
        double bandwidth = triad(facts.bytes_per_particle * particles, facts.threads);
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
            const char *only_stencil = said(options, "stencil");
            const char *only_evolved = said(options, "evolved");
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
        REPEATS);
    return VERIFY_PASSED;
}
