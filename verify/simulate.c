#include "verify/simulate.h"

#include "solver/record.h"
#include "verify/checkpoints.h"
#include "verify/files.h"
#include "verify/manufactured.h"
#include "verify/progress.h"
#include "verify/signals.h"
#include "verify/truth.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool verify_record(const struct solver_scene *scene, struct solver_run *run, const char *folder, const char *stem,
                   const char *command, char *path, struct solver_error *error)
{
    struct solver_output output;
    return verify_path_join(path, folder, stem, ".vtkhdf", error) && verify_folder_make(folder, error) &&
           solver_run_output(run, &output, error) &&
           solver_record_write(path, scene, &output, solver_run_history(run), command, ASSAY_VERSION, error);
}

/* Adds to the error where the last whole state is, which of a run that grew is no longer a right one, or why it could
 * not be kept. */
static void keep_last_good(const struct solver_scene *scene, struct solver_run *run, const char *folder,
                           const char *command, struct solver_error *error)
{
    char stem[SOLVER_NAME + 16], path[VERIFY_PATH];
    struct solver_error why = {.code = SOLVER_OK};
    (void)snprintf(stem, sizeof stem, "%s.last-good", scene->name);
    bool kept = verify_record(scene, run, folder, stem, command, path, &why);
    size_t used = strlen(error->text);
    (void)snprintf(error->text + used, sizeof error->text - used, "; the last whole state %s%.400s%s",
                   kept ? "is in " : "could not be kept: ", kept ? path : why.text, kept ? ", for assay render" : "");
}

static bool arrived(const struct solver_scene *scene, struct solver_run *run, struct solver_error *error)
{
    struct solver_output output;
    if (!solver_run_output(run, &output, error)) {
        return false;
    }
    if (!(fabs(output.time - scene->t_end) <= 1e-12 * fabs(scene->t_end))) {
        return solver_fail(error, SOLVER_BROKE_DOWN, "%s: the run stopped at t = %.17g s, not at t_end = %.17g s",
                           scene->name, output.time, scene->t_end);
    }
    return true;
}

static void start_of(const void *context, const double X[3], double u[3], double v[3], double F[9])
{
    const struct verify_truth *truth = context;
    struct oracle_state state;
    truth->kind->state(truth->oracle, X, 0.0, &state);
    memcpy(u, state.u, sizeof state.u);
    memcpy(v, state.v, sizeof state.v);
    memcpy(F, state.F, sizeof state.F);
}

/* What drives the body, and the scene whose faces say how. */
struct drive {
    struct verify_truth truth;
    const struct solver_scene *scene;
};

/* Outward unit normal of a face at X on it. */
static void normal_at(const struct solver_scene *scene, int face, const double X[3], double normal[3])
{
    const struct solver_shape *domain = &scene->domain;
    for (int i = 0; i < 3; i++) {
        bool curved = i < scene->dim && (i < 2 || domain->kind == SOLVER_SHAPE_BALL);
        normal[i] = face == SOLVER_SURFACE ? (curved ? (X[i] - domain->centre[i]) / domain->outer : 0)
                    : i == face / 2        ? (face % 2 == 1 ? 1 : -1)
                                           : 0;
    }
}

/* Velocity or traction on a face, by the state there; the body force of a manufactured solution. */
static void drive_of(const void *context, enum solver_formula formula, const double X[3], double t, double value[3])
{
    const struct drive *drive = context;
    const struct verify_truth *truth = &drive->truth;
    if (formula == SOLVER_BODY_FORCE) {
        verify_body_force(truth->kind, truth->oracle, X, t, value);
        return;
    }
    struct oracle_state state;
    double normal[3];
    int face = (int)(formula - SOLVER_FACE_X0) % SOLVER_FACES;
    truth->kind->state(truth->oracle, X, t, &state);
    if (formula <= SOLVER_FACE_SURFACE && drive->scene->face[face] != SOLVER_TRACTION) {
        memcpy(value, state.v, sizeof state.v);
        return;
    }
    normal_at(drive->scene, face, X, normal);
    for (int i = 0; i < 3; i++) {
        value[i] = state.P[3 * i] * normal[0] + state.P[3 * i + 1] * normal[1] + state.P[3 * i + 2] * normal[2];
    }
}

static void release(void *context)
{
    struct drive *drive = context;
    verify_truth_free(&drive->truth);
    free(drive);
}

bool verify_run_create(struct solver_scene *scene, struct solver_run **run, struct solver_error *error)
{
    bool starts = strcmp(scene->initial_from, "oracle") == 0;
    bool drives = strcmp(scene->loads_from, "oracle") == 0;
    if (!starts && !drives) {
        return solver_run_create(scene, run, error);
    }
    *run = NULL;
    struct drive *drive = calloc(1, sizeof *drive);
    if (drive == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for the oracle");
    }
    size_t told = scene->oracle_told_count;
    scene->oracle_told_count = 0;
    bool done = verify_truth_create(scene, &drive->truth, error);
    scene->oracle_told_count = told;
    if (!done) {
        free(drive);
        return false;
    }
    drive->scene = scene;
    if (starts) {
        solver_scene_start_from(scene, start_of, &drive->truth);
    }
    solver_scene_drive_from(scene, drives ? drive_of : NULL, drive, release); /* the scene's from here on */
    done = solver_run_create(scene, run, error);
    solver_scene_start_from(scene, NULL, NULL);
    return done;
}

/* A run on its way. */
struct journey {
    struct solver_scene *scene;
    struct solver_run *run;
    const char *folder, *command;
    struct verify_progress progress;
    struct verify_checkpoints *checkpoints; /* NULL: it is not kept */
    bool due;                               /* a checkpoint */
    bool failing;                           /* the last could not be written, which has been said */
    double time;                            /* [s] */
    size_t step;
};

/* A solver_progress: stops the run where it is to be kept, or to end. */
static bool watch(void *context, double time, double t_end, size_t step)
{
    struct journey *at = context;
    at->time = time;
    at->step = step;
    at->due = at->checkpoints != NULL && verify_checkpoints_due(at->checkpoints, step);
    (void)verify_progress_show(&at->progress, time, t_end, step);
    return verify_signals_asked() == 0 && !at->due;
}

/* A run outlives a full disk; the checkpoint before is still there. */
static void keep(struct journey *at)
{
    struct solver_error why = {.code = SOLVER_OK};
    bool failed = !verify_checkpoints_write(at->checkpoints, at->run, &why);
    if (failed && !at->failing) {
        verify_progress_end(&at->progress);
        (void)fprintf(stderr, "assay: step %zu: %s; the run goes on\n", at->step, why.text);
    }
    at->failing = failed;
}

static bool stop(struct journey *at, struct solver_error *error)
{
    int number = verify_signals_asked();
    if (at->checkpoints != NULL) {
        return verify_checkpoints_stop(at->checkpoints, at->run, at->time, number, error);
    }
    return solver_fail(
        error, SOLVER_STOPPED,
        "%s: stopped by %s at step %zu, t = %.6g s of %.6g s; of runs that are stopped, assay run alone keeps "
        "anything",
        at->progress.label, verify_signals_name(number), at->step, at->time, at->scene->t_end);
}

static bool go_to(struct journey *at, double t, struct solver_error *error)
{
    while (at->time < t) {
        if (!solver_run_to(at->run, t, watch, at, error)) {
            return false;
        }
        if (verify_signals_asked() != 0) {
            return stop(at, error);
        }
        if (at->due) {
            keep(at);
        }
    }
    return true;
}

/* By way of the snapshots whether anybody takes them or not, so that every command makes the same steps. */
static bool advance(struct journey *at, verify_take *take, void *context, struct solver_error *error)
{
    const struct solver_scene *scene = at->scene;
    for (size_t i = 0; i < scene->snapshot_count; i++) {
        if (!go_to(at, scene->snapshot[i], error) || (take != NULL && !take(context, at->run, error))) {
            return false;
        }
    }
    return go_to(at, scene->t_end, error);
}

/* Of a run that goes on, what its energies are compared with at the end was noted before. */
static bool knows_its_start(const struct journey *at, struct solver_error *error)
{
    return solver_run_history(at->run)->count > 0 ||
           solver_fail(error, SOLVER_BAD_INPUT,
                       "%s: cannot go on from step %zu: the checkpoint's history has no row, so that the energies and "
                       "momenta of the start are not known; those that assay run writes have one; begin anew",
                       at->scene->name, at->step);
}

/* Makes the run, and puts it where it goes on from. */
static bool begin(struct journey *at, struct solver_checkpoint **from, struct solver_error *error)
{
    if (!verify_run_create(at->scene, &at->run, error)) {
        return false;
    }
    if (from == NULL || *from == NULL) {
        return true;
    }
    at->time = at->progress.from = solver_checkpoint_about(*from)->time;
    at->step = solver_checkpoint_about(*from)->step;
    bool restored = solver_checkpoint_restore(*from, at->run, error) && knows_its_start(at, error);
    solver_checkpoint_free(*from);
    *from = NULL;
    return restored;
}

/* From beginning to end. */
static bool travel(struct journey *at, struct solver_checkpoint **from, verify_take *take, void *context,
                   struct solver_run **run, struct solver_error *error)
{
    char label[SOLVER_NAME + 32];
    (void)snprintf(label, sizeof label, "%s, n = %d", at->scene->name, at->scene->n);
    verify_progress_begin(&at->progress, label, at->scene->t_end);
    bool done = begin(at, from, error);
    if (done) {
        verify_progress_go(&at->progress);
        verify_signals_watch();
        done = advance(at, take, context, error);
        verify_signals_leave();
    }
    verify_progress_end(&at->progress);
    if (!done && at->run != NULL && error->code == SOLVER_BROKE_DOWN) {
        keep_last_good(at->scene, at->run, at->folder, at->command, error);
    }
    if (!done || !arrived(at->scene, at->run, error)) {
        solver_run_free(at->run);
        at->run = NULL;
        done = false;
    }
    *run = at->run;
    return done;
}

bool verify_simulate(struct solver_scene *scene, const char *folder, const char *command, verify_take *take,
                     void *context, struct solver_run **run, struct solver_error *error)
{
    struct journey at = {.scene = scene, .folder = folder, .command = command};
    return travel(&at, NULL, take, context, run, error);
}

bool verify_simulate_kept(struct solver_scene *scene, const char *folder, const char *command,
                          struct verify_keeping *keeping, struct solver_run **run, struct solver_error *error)
{
    struct verify_checkpoints checkpoints;
    struct journey at = {.scene = scene, .folder = folder, .command = command, .checkpoints = &checkpoints};
    *run = NULL;
    if (!verify_checkpoints_begin(&checkpoints, scene, folder, command, keeping->from, error)) {
        return false;
    }
    checkpoints.every = keeping->every;
    return travel(&at, &keeping->from, NULL, NULL, run, error);
}
