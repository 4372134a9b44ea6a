#include "verify/simulate.h"

#include "solver/record.h"
#include "verify/files.h"
#include "verify/manufactured.h"
#include "verify/progress.h"
#include "verify/truth.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool verify_record(const struct solver_scene *scene, struct solver_run *run, const char *folder, const char *stem,
                   const char *command, char *path, struct solver_error *error)
{
    struct solver_output output;
    return verify_path_join(path, folder, stem, ".vtkhdf", error) && solver_run_output(run, &output, error) &&
           solver_record_write(path, scene, &output, solver_run_history(run), command, ASSAY_VERSION, error);
}

/* Adds to the error where the last good state is, or why it could not be kept. */
static void keep_last_good(const struct solver_scene *scene, struct solver_run *run, const char *folder,
                           const char *command, struct solver_error *error)
{
    char stem[SOLVER_NAME + 16], path[VERIFY_PATH];
    struct solver_error why = {.code = SOLVER_OK};
    (void)snprintf(stem, sizeof stem, "%s.last-good", scene->name);
    bool kept = verify_record(scene, run, folder, stem, command, path, &why);
    size_t used = strlen(error->text);
    (void)snprintf(
        error->text + used, sizeof error->text - used, "%s%.400s",
        kept ? "; the last good state is in " : "; the last good state could not be kept: ", kept ? path : why.text);
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

/* By way of the snapshots whether anybody takes them or not, so that every command makes the same steps. */
static bool advance(const struct solver_scene *scene, struct solver_run *run, verify_take *take, void *context,
                    struct verify_progress *progress, struct solver_error *error)
{
    for (size_t i = 0; i < scene->snapshot_count; i++) {
        if (!solver_run_to(run, scene->snapshot[i], verify_progress_show, progress, error) ||
            (take != NULL && !take(context, run, error))) {
            return false;
        }
    }
    return solver_run_to(run, scene->t_end, verify_progress_show, progress, error);
}

bool verify_simulate(struct solver_scene *scene, const char *folder, const char *command, verify_take *take,
                     void *context, struct solver_run **run, struct solver_error *error)
{
    char label[SOLVER_NAME + 32];
    (void)snprintf(label, sizeof label, "%s, n = %d", scene->name, scene->n);
    struct verify_progress progress;
    verify_progress_begin(&progress, label, scene->t_end);
    *run = NULL;
    if (!verify_run_create(scene, run, error)) {
        verify_progress_end(&progress);
        return false;
    }
    bool done = advance(scene, *run, take, context, &progress, error);
    verify_progress_end(&progress);
    if (!done && error->code == SOLVER_BROKE_DOWN) {
        keep_last_good(scene, *run, folder, command, error);
    }
    if (!done || !arrived(scene, *run, error)) {
        solver_run_free(*run);
        *run = NULL;
        return false;
    }
    return true;
}
