/* What a particle's rates are made of, for the schemes on the system of upwind.h, whatever their dissipation. */
#ifndef SOLVER_DIM_SUMS_H
#define SOLVER_DIM_SUMS_H

#include "solver/dim_gather.h"
#include "solver/dim_work.h"

/* Sums over the neighbours of the particles of a group, in units of the pair vectors. */
struct sums {
    wide force;       /* twice the internal force: sum_b P_b D_ab + P_a sum_b C_ab */
    wide dissipation; /* twice V_a D(p_a) (eq. 30) */
    many volume;      /* 2 z_p V_a D(J_a) (eq. 30) */
};

/* What sums are multiplied with: the same for particles abreast. */
struct scales {
    real force[PLACES], volume[PLACES];
};

static inline __attribute__((always_inline)) struct scales scales_of(const struct solver_upwind *work,
                                                                     const size_t at[PLACES])
{
    struct scales scales;
    for (int g = 0; g < PLACES; g++) {
        const struct solver_material_constants *of_a = work->constants + at[g] * work->stride;
        double per_V = work->unit / work->V[at[g]];
        scales.force[g] = (real)(0.5 * per_V / of_a->rho);
        scales.volume[g] = work->evolves_J ? (real)(per_V / (2.0 * of_a->zp)) : (real)0.0;
    }
    return scales;
}

/* What dissipation takes of each particle. */
static inline void note_lost(const struct solver_upwind *work, const size_t at[PLACES], struct sums sums)
{
    vec dissipation[GROUP];
    take_apart(sums.dissipation, dissipation);
    for (int g = 0; g < GROUP; g++) {
        size_t a = place(at, g);
        work->lost[2 * a] = -0.5 * dot(load(work->v + a * LANES), dissipation[g]);
        work->lost[2 * a + 1] = sums.volume[g] / (2.0 * work->constants[a * work->stride].zp);
    }
}

/* The rate of J that is motion alone: H : grad v, or div v where H = I. */
static inline __attribute__((always_inline)) many compression(const struct solver_upwind *work, const size_t at[PLACES])
{
    wide G = gather_column(work->F_rate, 0, at);
    if (work->frozen) {
        many sum = component_of(G, 0);
        for (int I = 1; I < DIM; I++) {
            sum += component_of(gather_column(work->F_rate, I, at), I);
        }
        return sum;
    }
    wide products = gather_measure(work->cofactor, 0, at) * G;
    for (int I = 1; I < DIM; I++) {
        products += gather_measure(work->cofactor, I, at) * gather_column(work->F_rate, I, at);
    }
    many sum = component_of(products, 0);
    for (int i = 1; i < DIM; i++) {
        sum += component_of(products, i);
    }
    return sum;
}

static inline __attribute__((always_inline)) void store_H_rates(const struct solver_upwind *work,
                                                                const size_t at[PLACES])
{
    for (int g = 0; g < GROUP; g++) {
        size_t a = place(at, g);
        struct tensor F = work->frozen ? identity() : load_measure(work->F + a * TENSOR);
        store_tensor(work->H_rate + a * TENSOR, tensor_cross(F, load_tensor(work->F_rate + a * TENSOR)));
    }
}

/* `scales` are those of the group. */
static inline __attribute__((always_inline)) void finish(const struct solver_upwind *work, const size_t at[PLACES],
                                                         const struct scales *scales, struct sums sums)
{
    for (int I = 0; I < DIM; I++) {
        sums.force += gather_column(work->P, I, at) * gather_each(work->row_sum + I, DIM, at);
    }
    scatter(work->v_rate, LANES, at, join_each(scales->force) * (sums.force + sums.dissipation));
    if (work->lost != NULL) {
        note_lost(work, at, sums);
    }
    if (work->evolves_J) {
        scatter_many(work->J_rate, at, compression(work, at) + sums.volume * many_of(scales->volume));
    }
    if (work->evolves_H) {
        store_H_rates(work, at);
    }
}

#endif
