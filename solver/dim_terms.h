/* What the scene asks of the loops of upwind.h, and the impedances of a group's particles. */
#ifndef SOLVER_DIM_TERMS_H
#define SOLVER_DIM_TERMS_H

#include "solver/dim_gather.h"
#include "solver/dim_work.h"

/* Constants where the sums are called, so that each combination is a loop of its own. */
struct terms {
    bool frozen, reconstruct, transposed, volume, whole, composite, narrow;
};

/* Impedances of a pair: z v jumps in the acoustic Riemann problem of eq. 27, 28, with 2 z_a z_b / (z_a + z_b) where
 * materials meet. */
struct impedances {
    wide p, s;
    real shear[PLACES], bulk[PLACES]; /* shares of mu and kappa in the square of z_p, at rest */
};

/* A constant of particles. */
static inline __attribute__((always_inline)) wide constant(const struct solver_upwind *work, const double *of_first,
                                                           const size_t at[PLACES])
{
    return gather_each(of_first, work->stride * (sizeof *work->constants / sizeof(double)), at);
}

/* Of particles; with the shares if `shares`. */
static inline __attribute__((always_inline)) struct impedances impedances(const struct solver_upwind *work,
                                                                          const size_t at[PLACES], bool shares)
{
    struct impedances z = {.p = constant(work, &work->constants->zp, at),
                           .s = constant(work, &work->constants->zs, at)};
    for (int g = 0; shares && g < PLACES; g++) {
        const struct solver_material_constants *of = work->constants + at[g] * work->stride;
        double modulus = of->zp * of->cp;
        z.shear[g] = (real)(4.0 / 3.0 * of->mu / modulus);
        z.bulk[g] = (real)(of->kappa / modulus);
    }
    return z;
}

#endif
