#include "verify/commands.h"
#include "verify/figures.h"
#include "verify/find.h"
#include "verify/picture.h"
#include "verify/report.h"
#include "verify/simulate.h"
#include "verify/terminal.h"
#include "verify/trade_pick.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void print_facts(const struct solver_scene *scene, const struct solver_facts *facts)
{
    char residual[VERIFY_RESIDUAL];
    double particle_steps = (double)facts->particles * (double)facts->steps;
    (void)printf("%s (%s)\n", scene->title, scene->path);
    (void)printf("  %zu particles, spacing %.6g m, %zu pairs, %zu steps to t = %.6g s on %d threads\n",
                 facts->particles, facts->spacing, facts->pairs, facts->steps, scene->t_end, facts->threads);
    (void)printf("  set up in %.3f s, ran for %.3f s: %.1f ns per particle-step\n", facts->setup_seconds,
                 facts->seconds, 1e9 * facts->seconds / particle_steps);
    (void)printf("  %.0f bytes per particle, %.0f of them fields of the scheme%s\n", facts->bytes_per_particle,
                 facts->state_bytes, verify_residual(residual, facts));
}

/* Record and picture of a finished run. The picture is drawn from the record as read back, which proves that it can
 * be. */
static bool keep(const struct solver_scene *scene, struct solver_run *run, const char *folder, const char *line,
                 struct solver_error *error)
{
    char record_path[VERIFY_PATH], picture_path[VERIFY_PATH];
    struct solver_record *record = NULL;
    if (!verify_record(scene, run, folder, scene->name, line, record_path, error) ||
        !verify_path_join(picture_path, folder, scene->name, ".png", error) ||
        !solver_record_read(record_path, &record, error)) {
        return false;
    }
    bool drawn = verify_picture_write(picture_path, record, scene->has_view ? &scene->view : NULL, scene->title, error);
    solver_record_free(record);
    if (drawn) {
        (void)printf("record     %s\npicture    %s\n", record_path, picture_path);
    }
    return drawn;
}

static bool judge(const struct solver_scene *scene, struct solver_run *run, const struct solver_facts *facts,
                  struct solver_error *error)
{
    struct solver_output output;
    double value[VERIFY_INDICATORS];
    if (!solver_run_output(run, &output, error) ||
        !verify_indicators_measure(scene, &output, solver_run_history(run), facts, value, error)) {
        return false;
    }
    verify_terminal_indicators(stdout, value);
    return true;
}

/* `pick`: NULL, or what the configuration was picked by; its gates are then judged. */
static bool run_scene(struct solver_scene *scene, const struct verify_options *options, struct verify_pick *pick,
                      struct solver_error *error)
{
    char folder[VERIFY_PATH];
    struct solver_run *run = NULL;
    if (!verify_out_folder(options, scene->name, folder, error) ||
        !verify_simulate(scene, folder, options->line, pick != NULL ? verify_pick_take : NULL, pick, &run, error)) {
        return false;
    }
    const struct solver_facts facts = solver_run_facts(run);
    print_facts(scene, &facts);
    const struct solver_history *history = solver_run_history(run);
    if (history->count > 0) {
        verify_terminal_totals(stdout, scene, &history->totals[0], &history->totals[history->count - 1]);
    }
    bool kept = judge(scene, run, &facts, error) && keep(scene, run, folder, options->line, error) &&
                (pick == NULL || verify_pick_judge(pick, scene, run, error));
    solver_run_free(run);
    return kept;
}

/* The scene as the study says that it reaches the error; its oracle judges. */
static bool run_picked(const struct solver_scene *scene, const struct verify_options *options, struct verify_pick *pick,
                       struct solver_error *error)
{
    struct solver_scene *picked = NULL;
    bool done = verify_pick_open(options, scene, pick, error) &&
                verify_scene_open(&pick->options, pick->run.n, &picked, error) &&
                verify_truth_create(picked, &pick->truth, error) && verify_figures_check(picked, &pick->truth, error) &&
                (pick->truth.proven ||
                 solver_fail(error, SOLVER_BAD_INPUT, "%s: the oracle does not prove itself; assay verify says where",
                             scene->path)) &&
                run_scene(picked, options, pick, error);
    if (done) {
        verify_print_gates(stdout, &pick->gates);
        (void)printf("%s\n", pick->gates.pass
                                 ? "PASS: the error is what was asked for, and what the study says"
                                 : "FAIL: the study does not hold for this run; make another: assay trade");
    }
    solver_scene_free(picked);
    return done;
}

/* The same, with room for all it needs; *passed: both gates do. */
static bool pick_and_run(const struct solver_scene *scene, const struct verify_options *options, bool *passed,
                         struct solver_error *error)
{
    struct verify_pick *pick = calloc(1, sizeof *pick);
    if (pick == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for a study");
    }
    bool done = run_picked(scene, options, pick, error);
    *passed = pick->gates.pass;
    verify_pick_free(pick);
    free(pick);
    return done;
}

int verify_command_run(const struct verify_options *options)
{
    struct solver_error error = {.code = SOLVER_OK};
    struct solver_scene *scene = NULL;
    bool passed = true, done = options->study == NULL || options->error != NULL ||
                               solver_fail(&error, SOLVER_BAD_INPUT, "--study says nothing without --error");
    done = done && verify_scene_open(options, 0, &scene, &error) &&
           (options->error != NULL ? pick_and_run(scene, options, &passed, &error)
                                   : run_scene(scene, options, NULL, &error));
    solver_scene_free(scene);
    return !done ? verify_complain(&error) : passed ? VERIFY_PASSED : VERIFY_FAILED;
}
