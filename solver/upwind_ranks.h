/* The rates of upwind.h of particles in ranks (stencil_ranks.h), every pair's flux once. */
#ifndef SOLVER_UPWIND_RANKS_H
#define SOLVER_UPWIND_RANKS_H

#include "solver/upwind.h"

/* Rates of those in [begin, end) that are in ranks, where that is worth it; `others` does what is left, a range at a
 * time. It does all of them where what dissipation takes is asked for (lost). */
typedef void solver_rank_others(const struct solver_upwind *work, size_t begin, size_t end);
struct solver_rank_loops {
    void (*rates)(const struct solver_upwind *work, size_t begin, size_t end, solver_rank_others *others);
};

#endif
