/* |x|^(-2/3), LOT at a time. The C library's cbrt takes one number at a time, a third of a step in the plane; those for
 * vectors that some libraries have give other bits for other widths, and the paths avx2 and avx512 (path.h) must give
 * the same. */
#ifndef SOLVER_DIM_ROOTS_H
#define SOLVER_DIM_ROOTS_H

#include "solver/dim_bits.h"

/* Within 2 units in the last place (1.8 were found) of every number but zero, of which it is a large one, above 1e200;
 * of infinities and of what is no number it is none. Nothing is divided, and nothing overflows.
 * With e = 1 - x r^3, x^(-1/3) = r (1 - e)^(-1/3) and x^(-2/3) = r^2 (1 - e)^(-2/3). By the first terms of the
 * binomial series, r is off by 0.035 of itself at first, then by 1.5e-6, and x^(-2/3) by 1e-22 and round-off. */
static inline __attribute__((always_inline)) lot inverse_square_of_cube_root(lot x)
{
    lot_mask small = magnitude(x) < 0x1p-1000; /* not far from those that are not normal */
    lot one = lot_of(1.0);
    lot scaled = magnitude(x) * select_lot(small, lot_of(0x1p60), one);
    lot r = guess_inverse_cube_root(scaled);
    lot e = 1.0 - (scaled * r) * (r * r);
    lot series = ((35.0 / 243.0 * e + 14.0 / 81.0) * e + 2.0 / 9.0) * e + 1.0 / 3.0;
    r += r * (e * series);
    lot square = r * r;
    e = 1.0 - (scaled * r) * square;
    lot root = square + square * (e * ((40.0 / 81.0 * e + 5.0 / 9.0) * e + 2.0 / 3.0));
    return root * select_lot(small, lot_of(0x1p40), one);
}

enum { LOT_ROOT = 1 + 4 + 6 + 3 + 4 + 7 + 1 }; /* its operations (cost.h), for each number */

#endif
