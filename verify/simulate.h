/* A run from a loaded scene, with progress on the terminal and the last good state on disk if it breaks down. */
#ifndef VERIFY_SIMULATE_H
#define VERIFY_SIMULATE_H

#include "solver/run.h"

/* Creates a run; one of a scene that starts from its oracle gets the initial state from it, as the scene's own values
 * have it: what oracle.KEY tells the oracle does not reach the run. */
bool verify_run_create(struct solver_scene *scene, struct solver_run **run, struct solver_error *error);

/* Called when the run stands at the scene's next snapshot. */
typedef bool verify_take(void *context, struct solver_run *run, struct solver_error *error);

/* Creates a run and advances it to the scene's end time, by way of its snapshots (take may be NULL). If it breaks down,
 * writes FOLDER/SCENE.last-good.vtkhdf and says so at the end of the error's text. On failure *run is NULL. */
bool verify_simulate(struct solver_scene *scene, const char *folder, const char *command, verify_take *take,
                     void *context, struct solver_run **run, struct solver_error *error);

/* Writes the run's present state to FOLDER/STEM.vtkhdf (and .xdmf) and gives the path (VERIFY_PATH bytes). */
bool verify_record(const struct solver_scene *scene, struct solver_run *run, const char *folder, const char *stem,
                   const char *command, char *path, struct solver_error *error);

#endif
