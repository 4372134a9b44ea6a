/* The loops of upwind.h over particles in ranks (stencil_ranks.h), every pair's flux once. */
#ifndef SOLVER_UPWIND_RANKS_H
#define SOLVER_UPWIND_RANKS_H

#include "solver/upwind.h"

/* Gradients and rates of those in [begin, end) that are in ranks; `others` does what is left, a range at a time. */
typedef void solver_rank_others(const struct solver_upwind *work, size_t begin, size_t end);
struct solver_rank_loops {
    void (*gradients)(const struct solver_upwind *work, size_t begin, size_t end, solver_rank_others *others);
    void (*rates)(const struct solver_upwind *work, size_t begin, size_t end, solver_rank_others *others);
};

typedef void solver_rank_single_others(const struct solver_upwind_single *work, size_t begin, size_t end);
struct solver_rank_single_loops {
    void (*gradients)(const struct solver_upwind_single *work, size_t begin, size_t end,
                      solver_rank_single_others *others);
    void (*rates)(const struct solver_upwind_single *work, size_t begin, size_t end, solver_rank_single_others *others);
};

#endif
