/* Cofactors of many tensors. In the plane that of one, in memory, is its four numbers backwards, and two of them change
 * their sign. */
#ifndef SOLVER_DIM_COFACTORS_H
#define SOLVER_DIM_COFACTORS_H

#include "solver/dim_lots.h"

static inline void cofactor_range(const double *F, size_t count, double *H)
{
    enum { NUMBERS = DIM * LANES };
    size_t a = 0;
#if DIM == 2
    for (; a + LOT / NUMBERS <= count; a += LOT / NUMBERS) {
        lot numbers = load_lot(F + a * NUMBERS);
#ifdef LOT_OF_EIGHT
        lot back = __builtin_shufflevector(numbers, numbers, 3, 2, 1, 0, 7, 6, 5, 4);
        store_lot(H + a * NUMBERS, select_lot((lot){0, 1, 1, 0, 0, 1, 1, 0} > 0.0, -back, back));
#else
        lot back = __builtin_shufflevector(numbers, numbers, 3, 2, 1, 0);
        store_lot(H + a * NUMBERS, select_lot((lot){0, 1, 1, 0} > 0.0, -back, back));
#endif
    }
#endif
    for (; a < count; a++) {
        store_tensor(H + a * NUMBERS, cofactor(load_tensor(F + a * NUMBERS)));
    }
}

#endif
