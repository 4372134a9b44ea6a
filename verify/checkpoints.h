/* When a run that goes on is written to disk, and what is said when it was asked to end. */
#ifndef VERIFY_CHECKPOINTS_H
#define VERIFY_CHECKPOINTS_H

#include "solver/checkpoint.h"
#include "verify/files.h"
#include "verify/pace.h"

/* A run that was going for less than this [s] is not kept when it is asked to end, unless checkpoints were asked for or
 * it went on from one: to begin anew is no loss. */
#define VERIFY_WORTH_KEEPING 5.0

/* Of one run. */
struct verify_checkpoints {
    const struct solver_scene *scene;
    const char *command;    /* that the run began with */
    const char *folder;     /* made again if it vanishes while the run goes on */
    char file[VERIFY_PATH]; /* the scene's, from the root, so that a change is noticed from any folder */
    struct verify_pace every;
    bool resumed; /* the run went on from a checkpoint */
    char path[VERIFY_PATH];
    double begun, written; /* [s] on the monotonic clock: the run, the last that was written, or tried, or the start */
    bool there;            /* one has been written, at `step` */
    size_t step;
};

/* Checkpoints are FOLDER/SCENE.checkpoint, each in place of the one before. `from`: what the run goes on from, or NULL.
 */
bool verify_checkpoints_begin(struct verify_checkpoints *checkpoints, const struct solver_scene *scene,
                              const char *folder, const char *command, const struct solver_checkpoint *from,
                              struct solver_error *error);
/* Whether one is due after this step. */
bool verify_checkpoints_due(const struct verify_checkpoints *checkpoints, size_t step);
/* Writes one. SOLVER_IO leaves the one before as it was. */
bool verify_checkpoints_write(struct verify_checkpoints *checkpoints, const struct solver_run *run,
                              struct solver_error *error);
/* Of a run that stands at `time`, having been asked to end by a signal: keeps it where that is worth it, and says so,
 * with the command that goes on, as a SOLVER_STOPPED; always false. */
bool verify_checkpoints_stop(struct verify_checkpoints *checkpoints, const struct solver_run *run, double time,
                             int number, struct solver_error *error);

#endif
