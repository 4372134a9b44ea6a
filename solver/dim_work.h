/* Where the numbers of particles and pairs are that the loops of upwind.h work on. */
#ifndef SOLVER_DIM_WORK_H
#define SOLVER_DIM_WORK_H

#include "solver/dim.h"
#include "solver/upwind.h"

enum { TENSOR = DIM * LANES, PAIR = DIM + 1 };

/* Of the pairs of particle a's row, what is added to their numbers for their records. */
static inline size_t pair_shift(const struct solver_upwind *work, size_t a)
{
    return work->shared != NULL ? work->shared[a] - work->row[a] : 0;
}

#endif
