/* Going on from a checkpoint: the scene as it holds it, and where results go. */
#ifndef VERIFY_RESTART_H
#define VERIFY_RESTART_H

#include "verify/files.h"
#include "verify/options.h"
#include "verify/simulate.h"

/* Reads --restart FILE: the scene with the overrides that the run began with, the checkpoint, how often to write the
 * next (unless --checkpoint said so) and the command line of the beginning. Of --set, threads alone is taken, which no
 * result depends on, and not noted. Refuses (SOLVER_BAD_INPUT) checkpoints of another version of the program, and one
 * whose scene's file has changed since, unless --as-stored is given. On failure there may be a checkpoint to free. */
bool verify_restart_open(const struct verify_options *options, struct solver_scene **scene,
                         struct verify_keeping *keeping, char line[VERIFY_COMMAND_LINE], struct solver_error *error);
/* --out, or the folder that the checkpoint is in. */
bool verify_restart_folder(const struct verify_options *options, char folder[VERIFY_PATH], struct solver_error *error);

#endif
