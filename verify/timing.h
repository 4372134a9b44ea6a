/* How long steps take, and what memory can do. */
#ifndef VERIFY_TIMING_H
#define VERIFY_TIMING_H

#include "solver/run.h"

enum { VERIFY_SAMPLES = 7, VERIFY_TURNS = 3 };

/* Bytes per second of y = a + s b over arrays of `bytes` altogether: the best of several passes, three numbers moved
 * per entry, as STREAM counts. 0 if there is no memory for it. */
double verify_bandwidth(double bytes, int threads);
/* Seconds on a clock: of the calling thread's own time, which does not run while other programs have its core, where it
 * is the only one; else that on the wall. */
double verify_clock(int threads);
/* Seconds per step by that clock: the best of VERIFY_SAMPLES, each long enough for the clock. */
bool verify_time_steps(struct solver_run *run, double *seconds, struct solver_error *error);
/* The same of at most VERIFY_TURNS runs, seconds[count], whose samples are taken in turns, so that they can be compared
 * on a machine that others use too. Runs that are NULL, and others than the first that break down, have NaN. */
bool verify_time_turns(struct solver_run *const *run, size_t count, double *seconds, struct solver_error *error);

#endif
