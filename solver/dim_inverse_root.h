/* 1 / sqrt(x) of each lane. Divisions and roots of the processor take longer than all else that the loops over pairs do
 * (16 to 24 cycles for a register of doubles), and the estimates that some processors have differ. */
#ifndef SOLVER_DIM_INVERSE_ROOT_H
#define SOLVER_DIM_INVERSE_ROOT_H

#include "solver/dim_wide_bits.h"

#include <stdbool.h>

/* One step of the binomial series: with e = 1 - x r^2, x^(-1/2) = r (1 - e)^(-1/2). */
static inline wide nearer_inverse_root(wide x, wide r)
{
    wide e = (real)1.0 - (x * r) * r;
    wide series = ((real)(5.0 / 16.0) * e + (real)(3.0 / 8.0)) * e + (real)0.5;
    return r + r * (e * series);
}

/* Within 2 units in the last place of normal numbers above zero, whatever their size. The guess is off by 0.035 of
 * itself, so that e < 0.071; then by 7e-6, and by 1e-20 and round-off. */
static inline wide inverse_root(wide x)
{
    return nearer_inverse_root(x, nearer_inverse_root(x, guess_inverse_root(x)));
}

enum { FLOPS_INVERSE_ROOT = 2 * 10 }; /* its operations (cost.h), of each lane */

#endif
