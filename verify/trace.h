/* Displacement of a probe over time, of the component that moves most. */
#ifndef VERIFY_TRACE_H
#define VERIFY_TRACE_H

#include "solver/run.h"

struct verify_trace {
    char name[SOLVER_NAME];
    double X[3]; /* [m] */
    int axis;    /* 0, 1, 2 */
    size_t count;
    double *time, *displacement; /* [count] each, one block that `time` owns; [s], [m] */
};

/* Fails with SOLVER_NO_MEMORY; on success the caller frees. */
bool verify_trace_take(const struct solver_history *history, size_t probe, struct verify_trace *trace,
                       struct solver_error *error);
void verify_trace_free(struct verify_trace *trace);

#endif
