/* What is done to the bits of the numbers of a lot, doubles of IEEE 754: no operation of floating-point numbers counts
 * (cost.h). */
#ifndef SOLVER_DIM_BITS_H
#define SOLVER_DIM_BITS_H

#include "solver/dim_lots.h"

#include <stdint.h>

typedef uint64_t lot_bits __attribute__((vector_size(LOT * sizeof(uint64_t))));

static inline lot magnitude(lot x)
{
    return (lot)((lot_bits)x & (UINT64_MAX >> 1));
}

/* x^(-1/3) of normal numbers above zero, with 1 - x guess^3 within 0.105: the upper half of a number's bits, as an
 * integer, is nearly linear in its logarithm, so that of the guess is a constant less a third of it. That is computed
 * in floating-point numbers from 2^52 on, whose last bits are an integer's. */
static inline lot guess_inverse_cube_root(lot x)
{
    const uint64_t from_2_52 = 0x4330000000000000U;
    lot upper = (lot)(((lot_bits)x >> 32) | from_2_52);
    lot third = upper * (-1.0 / 3.0) + (0x1p52 * 4.0 / 3.0 + 1430187164.0);
    return (lot)((lot_bits)third << 32);
}

#endif
