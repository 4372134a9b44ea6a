/* What a pair reads of its neighbour is asked for ahead of time. */
#ifndef SOLVER_DIM_FETCH_H
#define SOLVER_DIM_FETCH_H

#include "solver/dim_pairs.h"

/* Neighbours lie all over memory, and the work on a pair is shorter than the way there: where that is beyond the
 * processor's own cache, what a neighbour brings is asked for so many pairs ahead; `last` is the pair up to which. */
enum { AHEAD = 16, LINE = 64 / sizeof(real) };

static inline __attribute__((always_inline)) void fetch(const struct solver_upwind *work, const real *slope, size_t ab,
                                                        size_t last)
{
    size_t b = work->neighbour[ab + AHEAD < last ? ab + AHEAD : last];
    for (int i = 0; i < TENSOR; i += LINE) {
        __builtin_prefetch(work->P + b * TENSOR + i);
        __builtin_prefetch(slope + b * TENSOR + i);
    }
    if (IN_SINGLE) { /* half of them lie across two lines */
        __builtin_prefetch(work->P + b * TENSOR + TENSOR - 1);
        __builtin_prefetch(slope + b * TENSOR + TENSOR - 1);
    }
    if (IN_SINGLE && !work->frozen) {
        __builtin_prefetch(work->x + b * LANES);
    }
    __builtin_prefetch(work->v + b * LANES);
    __builtin_prefetch(work->X + b * LANES);
}

/* For the k-th pair of each particle of a group. */
static inline __attribute__((always_inline)) void fetch_pairs(const struct solver_upwind *work, const real *slope,
                                                              const struct pairs *pairs, size_t last)
{
    for (int g = 0; g < PLACES; g++) {
        fetch(work, slope, pairs->ab[g], last);
    }
}

#endif
