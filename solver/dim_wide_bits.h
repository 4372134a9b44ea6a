/* What is done to the bits of the numbers of a wide vector, of IEEE 754: no operation of floating-point numbers counts
 * (cost.h). */
#ifndef SOLVER_DIM_WIDE_BITS_H
#define SOLVER_DIM_WIDE_BITS_H

#include "solver/dim_group.h"

#include <stdint.h>

/* 1 / sqrt(x) of normal numbers above zero, within 3.5 % of itself: the bits of a number, as an integer, are nearly
 * linear in its logarithm, so that those of the guess are a constant less half of them. */
static inline wide guess_inverse_root(wide x)
{
#ifdef SINGLE
    typedef uint32_t bits __attribute__((vector_size(sizeof(wide))));
    return (wide)(0x5f375a86U - ((bits)x >> 1));
#else
    typedef uint64_t bits __attribute__((vector_size(sizeof(wide))));
    return (wide)(0x5fe6eb50c7b537a9U - ((bits)x >> 1));
#endif
}

#endif
