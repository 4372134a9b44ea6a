/* Which loop of rates a scene has. */
#ifndef SOLVER_DIM_PLAIN_H
#define SOLVER_DIM_PLAIN_H

#include "solver/dim_terms.h"

typedef void rates_loop(const struct solver_upwind *work, size_t begin, size_t end, struct terms terms);

/* One for each combination of what common scenes ask for, with linear reconstruction; `loop` is always inlined. */
static inline __attribute__((always_inline)) void rates_of_one(const struct solver_upwind *work, size_t begin,
                                                               size_t end, bool narrow, rates_loop *loop)
{
    struct terms terms = {.reconstruct = true, .narrow = narrow};
    if (work->frozen && !work->evolves_J) {
        terms.frozen = true;
        loop(work, begin, end, terms);
    } else if (work->frozen) {
        terms.frozen = true;
        terms.volume = true;
        loop(work, begin, end, terms);
    } else if (!work->evolves_J) {
        loop(work, begin, end, terms);
    } else {
        terms.volume = true;
        loop(work, begin, end, terms);
    }
}

/* Of scenes that are plain (is_plain of dim_upwind_terms.h). */
static inline __attribute__((always_inline)) void plain_rates(const struct solver_upwind *work, size_t begin,
                                                              size_t end, rates_loop *loop)
{
    struct terms terms = {.frozen = work->frozen, .volume = work->evolves_J, .narrow = work->narrow != NULL};
    if (!work->reconstruct) { /* rare: not worth a loop each */
        loop(work, begin, end, terms);
    } else if (terms.narrow) {
        rates_of_one(work, begin, end, true, loop);
    } else {
        rates_of_one(work, begin, end, false, loop);
    }
}

#endif
