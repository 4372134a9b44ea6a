/* What a particle's rates are made of, for the schemes on the system of upwind.h, whatever their dissipation. */
#ifndef SOLVER_DIM_SUMS_H
#define SOLVER_DIM_SUMS_H

#include "solver/dim.h"
#include "solver/upwind.h"

enum { TENSOR = DIM * LANES, PAIR = DIM + 1 };

/* Of the pairs of particle a's row, what is added to their numbers for their records. */
static inline size_t pair_shift(const struct solver_upwind *work, size_t a)
{
    return work->shared != NULL ? work->shared[a] - work->row[a] : 0;
}

/* Sums over the neighbours of one particle, in units of the pair vectors. */
struct sums {
    vec force;       /* twice the internal force: sum_b P_b D_ab + P_a sum_b C_ab */
    vec dissipation; /* twice V_a D(p_a) (eq. 30) */
    real volume;     /* 2 z_p V_a D(J_a) (eq. 30) */
};

static inline __attribute__((always_inline)) void finish(const struct solver_upwind *work, size_t a, struct sums sums)
{
    const struct solver_material_constants *of_a = work->constants + a * work->stride;
    real per_V = (real)(work->unit / work->V[a]);
    for (int I = 0; I < DIM; I++) {
        sums.force += load(work->P + a * TENSOR + I * LANES) * (real)work->row_sum[a * DIM + (size_t)I];
    }
    store(work->v_rate + a * LANES, (real)(0.5 * per_V / of_a->rho) * (sums.force + sums.dissipation));
    if (work->lost != NULL) {
        work->lost[2 * a] = -0.5 * dot(load(work->v + a * LANES), sums.dissipation);
        work->lost[2 * a + 1] = sums.volume / (2.0 * of_a->zp);
    }
    struct tensor G = load_tensor(work->F_rate + a * TENSOR);
    if (work->evolves_J) {
        real compression = work->frozen ? trace(G) : contract(load_measure(work->cofactor + a * TENSOR), G);
        work->J_rate[a] = (real)(compression + sums.volume * per_V / (2.0 * of_a->zp));
    }
    if (work->evolves_H) {
        struct tensor F = work->frozen ? identity() : load_measure(work->F + a * TENSOR);
        store_tensor(work->H_rate + a * TENSOR, tensor_cross(F, G));
    }
}

#endif
