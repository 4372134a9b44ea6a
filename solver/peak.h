/* What the processor can do at best: multiply-adds in the widest vectors of a path (path.h), without memory. */
#ifndef SOLVER_PEAK_H
#define SOLVER_PEAK_H

#include "solver/path.h"

#include <stddef.h>

struct solver_peak_loops {
    int lanes;  /* doubles in the widest vector */
    bool fused; /* multiply-adds are one instruction, and round once */
    /* Does `rounds` rounds of multiply-adds that do not wait for each other, and returns the operations done, two for
     * each lane of each. *sum depends on all of them, so that none can be left out. */
    double (*multiply_add)(size_t rounds, double *sum);
};

SOLVER_DECLARE_LOOPS(struct solver_peak_loops, solver_peak);

/* That of the path in use, for as many threads as will call it at once. */
const struct solver_peak_loops *solver_peak(void);

#endif
