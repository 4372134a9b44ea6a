#include "verify/trace.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double *displacement_of(const struct solver_history *history, size_t row, size_t probe)
{
    return history->probe_u + (row * history->probe_count + probe) * 3;
}

static int liveliest(const struct solver_history *history, size_t probe)
{
    double reach[3] = {0};
    for (size_t row = 0; row < history->count; row++) {
        for (int axis = 0; axis < 3; axis++) {
            reach[axis] = fmax(reach[axis], fabs(displacement_of(history, row, probe)[axis]));
        }
    }
    return reach[0] >= reach[1] && reach[0] >= reach[2] ? 0 : reach[1] >= reach[2] ? 1 : 2;
}

bool verify_trace_take(const struct solver_history *history, size_t probe, struct verify_trace *trace,
                       struct solver_error *error)
{
    *trace = (struct verify_trace){.axis = liveliest(history, probe), .count = history->count};
    trace->time = calloc(history->count, 2 * sizeof *trace->time);
    if (trace->time == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for the trace of a probe, %zu rows", history->count);
    }
    trace->displacement = trace->time + history->count;
    memcpy(trace->name, history->probe_name[probe], sizeof trace->name);
    memcpy(trace->X, history->probe_X[probe], sizeof trace->X);
    for (size_t row = 0; row < history->count; row++) {
        trace->time[row] = history->totals[row].time;
        trace->displacement[row] = displacement_of(history, row, probe)[trace->axis];
    }
    return true;
}

void verify_trace_free(struct verify_trace *trace)
{
    free(trace->time);
    *trace = (struct verify_trace){.count = 0};
}
