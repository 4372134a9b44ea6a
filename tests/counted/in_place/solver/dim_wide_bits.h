/* In place of the solver's own: a __float128 has other bits than a double, and nothing that is done to them counts. */
#ifndef SOLVER_DIM_WIDE_BITS_H
#define SOLVER_DIM_WIDE_BITS_H

#include "solver/dim_group.h"

static inline wide guess_inverse_root(wide x)
{
    for (int i = 0; i < WIDTH; i++) {
        x[i] = (plain)1.0 / (sqrt)((plain)x[i]);
    }
    return x;
}

#endif
