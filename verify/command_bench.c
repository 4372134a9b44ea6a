/* assay bench: what a particle-step costs, beside what the machine allows at best. */
#include "verify/commands.h"
#include "verify/find.h"
#include "verify/overrides.h"
#include "verify/roofline.h"
#include "verify/simulate.h"
#include "verify/study.h"
#include "verify/timing.h"

#include "solver/cost.h"
#include "solver/integrator.h"
#include "solver/path.h"
#include "solver/peak.h"
#include "solver/run.h"
#include "solver/stencil.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Operations of one particle's step, as declared (cost.h); NaN if there is no memory for the list. */
static double flops_of(const struct solver_run *run, int stages)
{
    struct solver_cost_arrays *arrays = calloc(1, sizeof *arrays);
    struct solver_cost_terms *terms = calloc(1, sizeof *terms);
    double flops = NAN;
    if (arrays != NULL && terms != NULL) {
        solver_run_cost(run, arrays, terms);
        flops = solver_cost_flops(terms, stages) / (double)solver_run_facts(run).particles;
    }
    free(arrays);
    free(terms);
    return flops;
}

/* A row is of the first, unless the scene or --set says another; the others are timed in turns with it. */
static const char *const precisions[] = {"double", "mixed", "single"};
enum { PRECISIONS = sizeof precisions / sizeof *precisions };
_Static_assert((int)PRECISIONS <= (int)VERIFY_TURNS, "all of them take their turns");

/* The line of a run that has been timed. */
static void print_row(const struct solver_run *run, const struct solver_facts *facts, int stages, const char *stencil,
                      const char *evolved, const double timed[PRECISIONS])
{
    double seconds = timed[0];
    double particles = (double)facts->particles;
    double flops = flops_of(run, stages);
    double neighbours = (double)facts->pairs / particles;
    double per_particle = seconds / particles;
    double bandwidth = verify_bandwidth(facts->bytes_per_particle * particles, facts->threads);
    double peak = verify_roof_flops(facts->threads);
    double share = verify_roof_share(flops, facts->step_traffic, per_particle, peak, bandwidth);
    (void)printf("%-8s %-6s %10zu %10.1f %7d %10.3g %10.1f %10.2f %8.0f %8.0f %8.0f %10.1f %10.1f %8.0f %%",
                 stencil != NULL ? stencil : "-", evolved != NULL ? evolved : "-", facts->particles, neighbours,
                 facts->threads, facts->setup_seconds / (100.0 * seconds), 1e9 * per_particle,
                 1e9 * per_particle / (neighbours * stages), facts->bytes_per_particle, facts->step_traffic, flops,
                 1e-9 * bandwidth, 1e-9 * peak, 100.0 * share);
    for (int i = 1; i < PRECISIONS; i++) {
        if (isfinite(timed[i])) {
            (void)printf(" %8.2f", seconds / timed[i]);
        } else {
            (void)printf(" %8s", "-");
        }
    }
    (void)printf("\n");
    (void)fflush(stdout);
}

/* A scene in each precision that it can be run in. */
struct bench {
    struct solver_scene *scene[PRECISIONS];
    struct solver_run *run[PRECISIONS];
};

/* `precision`: NULL, the scene's own. */
static bool open_run(const struct verify_options *options, int n, const char *precision, struct bench *bench, int at,
                     struct solver_error *error)
{
    struct verify_options with = *options;
    char text[SOLVER_NAME];
    verify_say_unless(&with, "precision", text, precision);
    return verify_scene_open(&with, n, &bench->scene[at], error) &&
           verify_run_create(bench->scene[at], &bench->run[at], error);
}

/* `stencil` and `evolved` are NULL where the scheme has none. n = 0: the scene's own. */
static bool row(const struct verify_options *options, int n, const char *stencil, const char *evolved,
                struct solver_error *error)
{
    struct verify_options with = *options;
    char text[5][SOLVER_NAME];
    verify_say_unless(&with, "stencil", text[0], stencil);
    verify_say_unless(&with, "evolved", text[1], evolved);
    verify_say_unless(&with, "integrator", text[2], "tvd-rk2");
    verify_say_unless(&with, "cfl", text[3], "0.1"); /* within what sbp4 holds, 0.15; no step takes longer for it */
    verify_say_unless(&with, "threads", text[4], "1");
    struct bench bench = {.scene = {NULL}};
    bool done = open_run(&with, n, NULL, &bench, 0, error);
    bool compared =
        done && strcmp(bench.scene[0]->precision, "double") == 0 && verify_said(options, "precision") == NULL;
    for (int i = 1; compared && i < PRECISIONS; i++) {
        struct solver_error refused; /* few schemes know them all */
        (void)open_run(&with, n, precisions[i], &bench, i, &refused);
    }
    double seconds[PRECISIONS];
    done = done && verify_time_turns(bench.run, PRECISIONS, seconds, error);
    if (done) {
        struct solver_facts facts = solver_run_facts(bench.run[0]);
        int stages = solver_integrator_find(bench.scene[0]->integrator)->stages;
        print_row(bench.run[0], &facts, stages, stencil, evolved, seconds);
    }
    for (int i = 0; i < PRECISIONS; i++) {
        solver_run_free(bench.run[i]);
        solver_scene_free(bench.scene[i]);
    }
    return done;
}

/* A row for each stencil and evolved set, as far as the command line leaves them open; one that the scene refuses, or
 * that breaks down, says so. False if all do. */
static bool rows(const struct verify_options *options, int n, struct solver_error *error)
{
    static const char *const evolved[] = {"pF", "pFJ", "pFHJ"};
    size_t measured = 0;
    for (const struct solver_stencil_builder *builder = solver_stencil_builders(); builder->name != NULL; builder++) {
        for (size_t i = 0; i < sizeof evolved / sizeof *evolved; i++) {
            const char *only_stencil = verify_said(options, "stencil");
            const char *only_evolved = verify_said(options, "evolved");
            bool wanted = (only_stencil == NULL || strcmp(only_stencil, builder->name) == 0) &&
                          (only_evolved == NULL || strcmp(only_evolved, evolved[i]) == 0);
            if (!wanted) {
                continue;
            }
            if (row(options, n, builder->name, evolved[i], error)) {
                measured++;
            } else if (error->code == SOLVER_BAD_INPUT || error->code == SOLVER_BROKE_DOWN) {
                (void)printf("%-8s %-6s %s: %s\n", builder->name, evolved[i],
                             error->code == SOLVER_BAD_INPUT ? "refused" : "broke down", error->text);
            } else {
                return false;
            }
        }
    }
    return measured > 0;
}

static void print_head(void)
{
    (void)printf("path %s: vectors of %d doubles\n\n", solver_path_name(solver_path()), solver_peak()->lanes);
    (void)printf("%-8s %-6s %10s %10s %7s %10s %10s %10s %8s %8s %8s %10s %10s %10s %8s %8s\n", "stencil", "set",
                 "particles", "neighbours", "threads", "set-up/100", "ns/p-step", "ns/nb-rhs", "B/part.", "B moved",
                 "flops", "triad GB/s", "Gflop/s", "of roof", "mixed", "single");
}

static void print_foot(void)
{
    (void)printf(
        "\nset-up/100: time to build cloud and stencil over that of 100 steps. ns/p-step: one particle's step, best "
        "of\n"
        "%d samples. ns/nb-rhs: the same per neighbour and right-hand side. B/part.: memory per particle. B moved: "
        "what\n"
        "a particle's step moves if every array streams once per sweep. flops: its operations as assay cost declares\n"
        "them. triad: bandwidth measured on arrays as large as the run's; Gflop/s: multiply-adds alone. of roof: the\n"
        "time which the slower of traffic and operations takes at these rates, over the time measured; more than all\n"
        "where sweeps find in cache what the ones before have left. mixed, single: how many times as fast that\n"
        "precision is, steps of each taken in turns; -: the scene cannot be run in it, or the row is of another than\n"
        "double itself.\n",
        VERIFY_SAMPLES);
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
    print_head();
    size_t sizes = options->level_count > 0 ? options->level_count : 1;
    for (size_t i = 0; i < sizes; i++) {
        int n = options->level_count > 0 ? options->level[i] : 0;
        if (stencil ? !rows(options, n, &error) : !row(options, n, NULL, NULL, &error)) {
            return verify_complain(&error);
        }
    }
    print_foot();
    return VERIFY_PASSED;
}
