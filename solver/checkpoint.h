/* Checkpoints: a run on disk, whole, so that it can be gone on with as if nothing had happened. A run that is restored
 * and goes on gives the same bytes, in every record, history and probe, as one that was never interrupted, for any
 * number of threads of either: all that one step hands to the next is there to the bit (keep.h), and the order of sums
 * does not depend on threads. That holds for the build that wrote it (build.h): one of another compiler or of other
 * loops is refused, and so is one that keeps other things than this; one of another version is for the caller to
 * refuse. */
#ifndef SOLVER_CHECKPOINT_H
#define SOLVER_CHECKPOINT_H

#include "solver/run.h"

/* What the run is of, beside its state. Texts that are read belong to the checkpoint. */
struct solver_checkpoint_about {
    const char *scene_path;     /* as it was loaded from */
    const char *scene_file;     /* the same, from the root */
    const char *scene_text;     /* all of it */
    const char *overrides;      /* "KEY=value\n" lines */
    const char *command;        /* the command line that the run began with, which its record will hold */
    const char *version;        /* of the program */
    const char *build, *loops;  /* of the solver (build.h) */
    double every_seconds, time; /* [s] between checkpoints, 0: none for the sake of time; of the run */
    size_t every_steps, step;   /* likewise; of the run */
};

struct solver_checkpoint;

/* Writes the run as it is now to PATH, whole or not at all; `about` without time and step, which are the run's, and
 * without build and loops, which are the solver's. Needs no memory that grows with the run. SOLVER_IO leaves the file
 * as it was. */
bool solver_checkpoint_write(const char *path, const struct solver_run *run,
                             const struct solver_checkpoint_about *about, struct solver_error *error);

/* Reads a checkpoint; refuses (SOLVER_BAD_INPUT) what is foreign, cut short, damaged, of another kind, or of a build
 * that may give other bits. */
bool solver_checkpoint_read(const char *path, struct solver_checkpoint **checkpoint, struct solver_error *error);
void solver_checkpoint_free(struct solver_checkpoint *checkpoint);
const struct solver_checkpoint_about *solver_checkpoint_about(const struct solver_checkpoint *checkpoint);

/* Puts a run, which has just been created from the checkpoint's scene, where the checkpoint has it. Refuses what does
 * not fit it (SOLVER_BAD_INPUT); the run is then of no use. */
bool solver_checkpoint_restore(struct solver_checkpoint *checkpoint, struct solver_run *run,
                               struct solver_error *error);

#endif
