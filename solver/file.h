/* Whole or absent: a file is written beside its name, flushed to disk and then renamed, so that a full disk or a kill
 * leaves the previous file as it was. */
#ifndef SOLVER_FILE_H
#define SOLVER_FILE_H

#include "solver/error.h"

#include <stddef.h>

/* Room for "PATH.partial-PID". */
enum { SOLVER_FILE_PATH = 4096 + 32 };

/* A part of what a file is to hold. */
struct solver_file_part {
    const void *bytes;
    size_t size;
};

/* Writes parts, one after the other, beside `path` and flushes them to disk; `staged` receives the name. On failure
 * nothing is left behind. SOLVER_IO. */
bool solver_file_stage_parts(const char *path, const struct solver_file_part *part, size_t count,
                             char staged[SOLVER_FILE_PATH], struct solver_error *error);
/* The same of one part. */
bool solver_file_stage(const char *path, const void *bytes, size_t size, char staged[SOLVER_FILE_PATH],
                       struct solver_error *error);
/* Gives a staged file its name, in one step. On failure the staged file is removed. SOLVER_IO. */
bool solver_file_commit(const char staged[SOLVER_FILE_PATH], const char *path, struct solver_error *error);
/* Both in one: for a file that stands alone. */
bool solver_file_replace(const char *path, const void *bytes, size_t size, struct solver_error *error);

/* Removes what processes that are no more, killed while they wrote, have left beside `path`. */
void solver_file_sweep(const char *path);

#endif
