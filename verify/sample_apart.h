/* Reading in a process of its own, so that a library that crashes, runs without end or asks for any amount of memory
 * does so there. */
#ifndef VERIFY_SAMPLE_APART_H
#define VERIFY_SAMPLE_APART_H

#include "verify/sample.h"

/* Adds the samples of a file of so many bytes. */
typedef bool verify_sample_reader(const char *path, size_t bytes, struct verify_samples *samples,
                                  struct solver_error *error);

/* What `read` reads, in a process of its own that may use so many seconds of one core; what comes back is checked
 * again, since a process that was led astray may have sent it. If the process does not end well, SOLVER_BAD_INPUT. */
bool verify_sample_apart(verify_sample_reader *read, unsigned seconds, const char *path, size_t bytes,
                         struct verify_samples *samples, struct solver_error *error);

#endif
