/* In place of the solver's own: a __float128 has other bits than a double, and nothing that is done to them counts. */
#ifndef SOLVER_DIM_BITS_H
#define SOLVER_DIM_BITS_H

#include "solver/dim_lots.h"

static inline lot magnitude(lot x)
{
    return larger_lot(x, -x);
}

static inline lot guess_inverse_cube_root(lot x)
{
    lot guess;
    for (int k = 0; k < LOT; k++) {
        guess[k] = (plain)1.0 / (cbrt)((plain)x[k]);
    }
    return guess;
}

#endif
