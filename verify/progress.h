/* One line on the terminal that says how far a run is; silent where standard error is not a terminal. */
#ifndef VERIFY_PROGRESS_H
#define VERIFY_PROGRESS_H

#include <stdbool.h>
#include <stddef.h>

struct verify_progress {
    const char *label;   /* "swinging-cube, n = 24" */
    double t_end;        /* [s] of the whole run, whatever part of it is under way */
    double from;         /* [s] of the run where it went on from a checkpoint; 0 */
    bool on;             /* standard error is a terminal */
    double begun, shown; /* [s] on the monotonic clock: when steps began, and when the line was last written */
};

/* [s] on the monotonic clock. */
double verify_now(void);

void verify_progress_begin(struct verify_progress *progress, const char *label, double t_end);
/* The run is set up: from here on steps take their time. */
void verify_progress_go(struct verify_progress *progress);
/* A solver_progress: context is the struct verify_progress. Never stops the run. */
bool verify_progress_show(void *context, double time, double t_end, size_t step);
/* Clears the line. */
void verify_progress_end(struct verify_progress *progress);

#endif
