/* A run from a loaded scene, with progress on the terminal and the last whole state on disk if it breaks down. */
#ifndef VERIFY_SIMULATE_H
#define VERIFY_SIMULATE_H

#include "solver/checkpoint.h"
#include "solver/run.h"
#include "verify/pace.h"

/* Creates a run; one of a scene that starts from its oracle gets the initial state from it, as the scene's own values
 * have it: what oracle.KEY tells the oracle does not reach the run. */
bool verify_run_create(struct solver_scene *scene, struct solver_run **run, struct solver_error *error);

/* Called when the run stands at the scene's next snapshot. */
typedef bool verify_take(void *context, struct solver_run *run, struct solver_error *error);

/* Creates a run and advances it to the scene's end time, by way of its snapshots (take may be NULL). If it breaks down,
 * writes FOLDER/SCENE.last-good.vtkhdf and says so at the end of the error's text. If the program is asked to end
 * (signals.h), stops after a step with SOLVER_STOPPED. On failure *run is NULL. */
bool verify_simulate(struct solver_scene *scene, const char *folder, const char *command, verify_take *take,
                     void *context, struct solver_run **run, struct solver_error *error);

/* How a run is kept on disk, as FOLDER/SCENE.checkpoint, and what it goes on from. */
struct verify_keeping {
    struct verify_pace every;
    struct solver_checkpoint *from; /* NULL: the run begins anew; freed, and NULL, once the run stands there */
};

/* The same, without taking snapshots, of a run that is kept: now and then, and when the program is asked to end. */
bool verify_simulate_kept(struct solver_scene *scene, const char *folder, const char *command,
                          struct verify_keeping *keeping, struct solver_run **run, struct solver_error *error);

/* Writes the run's present state to FOLDER/STEM.vtkhdf (and .xdmf) and gives the path (VERIFY_PATH bytes). A folder
 * that has vanished since the run began is made again. */
bool verify_record(const struct solver_scene *scene, struct solver_run *run, const char *folder, const char *stem,
                   const char *command, char *path, struct solver_error *error);

#endif
