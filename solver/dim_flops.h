/* Operations of dim.h, dim_sums.h and dim_lots.h, as cost.h counts them. */
#ifndef SOLVER_DIM_FLOPS_H
#define SOLVER_DIM_FLOPS_H

#include "solver/cost.h"
#include "solver/dim.h"

enum {
    FLOPS_TENSOR = DIM * LANES, /* one operation on each entry */
    FLOPS_DOT = LANES + DIM - 1,
    FLOPS_SPREAD_DOTS = DIM == 3   ? 4 * LANES
                        : DIM == 2 ? 3 * LANES
                                   : 2,
    FLOPS_DOTS_IN_TURN = DIM == 3   ? 4 * LANES
                         : DIM == 2 ? 3 * LANES
                                    : 1,
    FLOPS_TRACE = DIM - 1,
    FLOPS_CONTRACT = (2 * DIM - 1) * LANES + DIM - 1,
    FLOPS_COFACTOR = DIM == 3 ? 9 * LANES : 0, /* in the plane signs and places change */
    FLOPS_DETERMINANT = DIM == 3   ? 3 * LANES + FLOPS_DOT
                        : DIM == 2 ? 3
                                   : 0,
    FLOPS_TENSOR_CROSS = DIM == 3 ? 21 * LANES : 0,
    FLOPS_ADD_SCALED = 2 * FLOPS_TENSOR /* one vector, times each component of another, added to a tensor */
};

/* Of one particle of a lot (dim_lots.h). */
enum {
    LOT_DOT = 2 * DIM - 1,
    LOT_COFACTOR = DIM == 3 ? 27 : 0,
    LOT_DETERMINANT = DIM == 3   ? 9 + LOT_DOT
                      : DIM == 2 ? 3
                                 : 0,
    LOT_SQUARES = DIM * LOT_DOT + DIM - 1
};

#endif
