#include "verify/commands.h"
#include "verify/figures.h"
#include "verify/find.h"
#include "verify/picture.h"
#include "verify/report.h"
#include "verify/restart.h"
#include "verify/signals.h"
#include "verify/simulate.h"
#include "verify/terminal.h"
#include "verify/trade_pick.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void print_facts(const struct solver_scene *scene, const struct solver_facts *facts)
{
    char residual[VERIFY_RESIDUAL];
    double particle_steps = (double)facts->particles * (double)facts->steps;
    (void)printf("%s (%s)\n", scene->title, scene->path);
    char graded[48] = "";
    if (facts->finest < facts->spacing) {
        (void)snprintf(graded, sizeof graded, " (mean; smallest %.6g m)", facts->finest);
    }
    (void)printf("  %zu particles, spacing %.6g m%s, %zu pairs, %zu steps to t = %.6g s on %d thread%s\n",
                 facts->particles, facts->spacing, graded, facts->pairs, facts->steps, scene->t_end, facts->threads,
                 facts->threads == 1 ? "" : "s");
    (void)printf("  set up in %.3f s, ran for %.3f s: %.1f ns per particle-step\n", facts->setup_seconds,
                 facts->seconds, 1e9 * facts->seconds / particle_steps);
    (void)printf("  %.0f bytes per particle, %.0f of them fields of the scheme%s\n", facts->bytes_per_particle,
                 facts->state_bytes, verify_residual(residual, facts));
    if (facts->shorter > 1.0) {
        (void)printf("  steps %.3g times shorter than the spacing and the fastest wave have them, where %s\n",
                     facts->shorter, scene->perturb > 0.0 ? "particles crowd" : "materials meet");
    }
}

/* How well the cloud of a body of any shape fits it. */
static void print_quality(const struct solver_cloud *cloud)
{
    static const char *const unit[] = {"m", "m^2", "m^3"};
    const struct solver_cloud_quality *quality = cloud->quality; /* of a solid, in 2D or 3D */
    if (quality == NULL) {
        return;
    }
    (void)printf("  body of %.6g %s within %.6g %s; %zu particles on its surface, off it by %.1e spacings at most\n",
                 quality->volume, unit[cloud->dim - 1], quality->area, unit[cloud->dim - 2], quality->on_surface,
                 quality->off_surface);
    (void)printf("  areas sum to %.1e of it; volumes from %.2f of a cell, changed by %.1e, areas by %.1e of a side\n",
                 quality->closure, quality->least_volume, quality->correction, quality->area_correction);
    (void)printf("  particles from %.2f spacings apart, the surface up to %.2f from its own\n", quality->nearest,
                 quality->widest);
}

/* A scene, where its results go, and the command line that its record holds. */
struct work {
    struct solver_scene *scene;
    struct verify_keeping keeping;
    char folder[VERIFY_PATH];
    char line[VERIFY_COMMAND_LINE];
};

/* Record of a finished run, at `path`. Who asks the program to end meanwhile is heard once it is written: what has been
 * computed is not lost. */
static bool keep(const struct work *work, struct solver_run *run, char path[VERIFY_PATH], struct solver_error *error)
{
    const struct solver_scene *scene = work->scene;
    verify_signals_watch();
    bool kept = verify_record(scene, run, work->folder, scene->name, work->line, path, error);
    verify_signals_leave();
    int number = verify_signals_asked();
    return kept && (number == 0 ||
                    solver_fail(error, SOLVER_STOPPED,
                                "%s: stopped by %s when the run was over; its record is in %.400s, for assay render",
                                scene->name, verify_signals_name(number), path));
}

/* The picture is drawn from the record as read back, which proves that it can be. */
static bool draw(const struct solver_scene *scene, const char *folder, const char *record_path,
                 struct solver_error *error)
{
    char picture_path[VERIFY_PATH];
    struct solver_record *record = NULL;
    if (!verify_path_join(picture_path, folder, scene->name, ".png", error) ||
        !solver_record_read(record_path, &record, error)) {
        return false;
    }
    bool drawn = verify_picture_write(picture_path, record, scene->has_view ? &scene->view : NULL, scene->title,
                                      record_path, error);
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
    print_quality(output.cloud);
    return true;
}

static bool open_work(struct work *work, const struct verify_options *options, struct solver_error *error)
{
    work->keeping.every = options->checkpoint;
    if (options->restart != NULL) {
        return verify_restart_open(options, &work->scene, &work->keeping, work->line, error) &&
               verify_restart_folder(options, work->folder, error);
    }
    memcpy(work->line, options->line, sizeof work->line);
    return verify_scene_open(options, 0, &work->scene, error) && verify_picture_check(work->scene, error) &&
           verify_out_folder(options, work->scene->name, work->folder, error);
}

/* `pick`: NULL, or what the configuration was picked by; its gates are then judged. */
static bool run_scene(struct work *work, struct verify_pick *pick, struct solver_error *error)
{
    struct solver_scene *scene = work->scene;
    struct solver_run *run = NULL;
    bool ran = pick != NULL ? verify_simulate(scene, work->folder, work->line, verify_pick_take, pick, &run, error)
                            : verify_simulate_kept(scene, work->folder, work->line, &work->keeping, &run, error);
    if (!ran) {
        return false;
    }
    const struct solver_facts facts = solver_run_facts(run);
    print_facts(scene, &facts);
    const struct solver_history *history = solver_run_history(run);
    if (history->count > 0) {
        verify_terminal_totals(stdout, scene, &history->totals[0], &history->totals[history->count - 1]);
    }
    char record_path[VERIFY_PATH];
    bool kept = keep(work, run, record_path, error) && judge(scene, run, &facts, error) &&
                draw(scene, work->folder, record_path, error) &&
                (pick == NULL || verify_pick_judge(pick, scene, run, error));
    solver_run_free(run);
    return kept;
}

/* The scene as the study says that it reaches the error; its oracle judges. */
static bool run_picked(struct work *work, const struct verify_options *options, struct verify_pick *pick,
                       struct solver_error *error)
{
    struct solver_scene *scene = work->scene;
    struct solver_scene *picked = NULL;
    bool done = verify_pick_open(options, scene, pick, error) &&
                verify_scene_open(&pick->options, pick->run.n, &picked, error) &&
                verify_truth_create(picked, &pick->truth, error) && verify_figures_check(picked, &pick->truth, error) &&
                (pick->truth.proven ||
                 solver_fail(error, SOLVER_BAD_INPUT, "%s: the oracle does not prove itself; assay verify says where",
                             scene->path)) &&
                (work->scene = picked) != NULL && run_scene(work, pick, error);
    work->scene = scene;
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
static bool pick_and_run(struct work *work, const struct verify_options *options, bool *passed,
                         struct solver_error *error)
{
    struct verify_pick *pick = calloc(1, sizeof *pick);
    if (pick == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for a study");
    }
    bool done = run_picked(work, options, pick, error);
    *passed = pick->gates.pass;
    verify_pick_free(pick);
    free(pick);
    return done;
}

/* Options that go together. */
static bool check(const struct verify_options *options, struct solver_error *error)
{
    bool checkpoints = options->restart != NULL || options->checkpoint.steps > 0 || options->checkpoint.seconds > 0.0;
    if (options->study != NULL && options->error == NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT, "--study says nothing without --error");
    }
    if (options->error != NULL && checkpoints) {
        return solver_fail(
            error, SOLVER_BAD_INPUT,
            "--error goes with neither --checkpoint nor --restart: what was picked is judged as a whole");
    }
    return true;
}

int verify_command_run(const struct verify_options *options)
{
    struct solver_error error = {.code = SOLVER_OK};
    struct work *work = calloc(1, sizeof *work);
    bool passed = true;
    if (work == NULL) {
        (void)solver_fail(&error, SOLVER_NO_MEMORY, "no memory for a run");
        return verify_complain(&error);
    }
    bool done = check(options, &error) && open_work(work, options, &error) &&
                (options->error != NULL ? pick_and_run(work, options, &passed, &error) : run_scene(work, NULL, &error));
    solver_checkpoint_free(work->keeping.from);
    solver_scene_free(work->scene);
    free(work);
    return !done ? verify_complain(&error) : passed ? VERIFY_PASSED : VERIFY_FAILED;
}
