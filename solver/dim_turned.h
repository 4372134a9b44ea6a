/* What the flux of J takes of a pair that has turned and been stretched with the body. */
#ifndef SOLVER_DIM_TURNED_H
#define SOLVER_DIM_TURNED_H

#include "solver/dim_inverse_root.h"

/* Of pairs, one in each lane. */
struct turned {
    wide inverse; /* 1 / |along|^2 */
    wide soft;    /* n^2 times the softening (softening of dim_fluxes.h), n^2 = (n . H^Ave N)^2 */
};

/* square: |along|^2; area: along . H^Ave N; shear, bulk: shares of z_p squared at rest; stiffness of both particles if
 * it counts. With q = shear |along|^2 + bulk area^2 the root of q |along|^2 gives both: n^2 is area^2 / |along|^2, the
 * softening |along| / sqrt(q). */
static inline __attribute__((always_inline)) struct turned turned_of(wide square, wide area, wide shear, wide bulk,
                                                                     wide stiffness_a, wide stiffness_b, bool stiffens)
{
    wide of_area = area * area;
    wide q = shear * square + (stiffens ? bulk * larger_of(stiffness_a, stiffness_b) : bulk) * of_area;
    wide root = inverse_root(square * q);
    wide soft = of_area * root;
    return (struct turned){.inverse = root * root * q,
                           .soft = stiffens ? only_where((stiffness_a > 0) & (stiffness_b > 0), soft) : soft};
}

#endif
