/* Rates of particles in ranks with linear kinematics: normals are the axes themselves, so that the fluxes on either
 * side of a particle are differences of its neighbours, with one impedance for each component. */
#ifndef SOLVER_DIM_RANK_LINEAR_H
#define SOLVER_DIM_RANK_LINEAR_H

#include "solver/dim_ranks.h"
#include "solver/dim_sums.h"
#include "solver/dim_terms.h"

#if DIM > 1
/* Of the pairs along an axis of particles on from `at`: neighbours, what their differences are multiplied with, and how
 * often the particle's own stress counts, which flows through one of its faces alone where there is no other. */
struct either_side {
    size_t at[PLACES], back[PLACES], ahead[PLACES];
    wide weight, half_back, half_ahead, own;
};

static inline __attribute__((always_inline)) struct either_side either_side(const struct reach *reach, int I, size_t a)
{
    int own = 2 * ((reach->back[I] == 0) - (reach->ahead[I] == 0));
    return (struct either_side){.at = {a},
                                .back = {a - reach->back[I]},
                                .ahead = {a + reach->ahead[I]},
                                .weight = wide_of(reach->weight[I]),
                                .half_back = wide_of(reach->half[I][0]),
                                .half_ahead = wide_of(reach->half[I][1]),
                                .own = wide_of((real)own)};
}

/* The jump to the next particle less that from the one before, reconstructed. */
static inline __attribute__((always_inline)) wide turn_of(const struct either_side *side, wide back, wide at,
                                                          wide ahead, wide slope_back, wide slope, wide slope_ahead)
{
    return (ahead - at - side->half_ahead * (slope_ahead + slope)) -
           (at - back - side->half_back * (slope + slope_back));
}

/* sum_b A [U'] with lane I that of axis I. */
static inline __attribute__((always_inline)) wide turns_of_pressure(const struct solver_upwind *work,
                                                                    const struct reach *reach, size_t a)
{
    wide sum = {0};
    for (int I = 0; I < DIM; I++) {
        struct either_side side = either_side(reach, I, a);
        const real *p = work->pressure;
        const real *slope = work->pressure_gradient;
        wide turn =
            turn_of(&side, gather_scalars(p, side.back), gather_scalars(p, side.at), gather_scalars(p, side.ahead),
                    gather(slope, LANES, side.back), gather(slope, LANES, side.at), gather(slope, LANES, side.ahead));
        sum = put_component(sum, side.weight * turn, I);
    }
    return sum;
}

static inline __attribute__((always_inline)) void linear_rates_as(const struct solver_upwind *work, size_t begin,
                                                                  size_t end, const struct reach *reach, bool volume)
{
    wide per_rho = wide_of((real)(1.0 / work->constants->rho));
    wide per_z = wide_of((real)(1.0 / work->constants->zp));
    wide z_s = wide_of((real)work->constants->zs);
    wide z_p = wide_of((real)work->constants->zp);
    for (size_t k = 0; k < LANES * (end - begin); k = next_block(k, LANES * (end - begin))) {
        size_t at[PLACES] = {begin + k / LANES};
        wide sum = {0};
        for (int I = 0; I < DIM; I++) {
            struct either_side side = either_side(reach, I, at[0]);
            wide turn = turn_of(&side, gather(work->v, LANES, side.back), gather(work->v, LANES, side.at),
                                gather(work->v, LANES, side.ahead), gather_column(work->F_rate, I, side.back),
                                gather_column(work->F_rate, I, side.at), gather_column(work->F_rate, I, side.ahead));
            wide stress = gather_column(work->P, I, side.ahead) - gather_column(work->P, I, side.back) +
                          side.own * gather_column(work->P, I, side.at);
            sum += side.weight * (stress + put_component(z_s, z_p, I) * turn);
        }
        scatter(work->v_rate, LANES, at, per_rho * sum);
        if (volume) {
            wide turns = per_z * turns_of_pressure(work, reach, at[0]);
            many of_J = component_of(turns, 0);
            for (int I = 1; I < DIM; I++) {
                of_J += component_of(turns, I);
            }
            scatter_many(work->J_rate, at, compression(work, at) + of_J);
        }
        if (work->evolves_H) {
            store_H_rates(work, at);
        }
    }
}

static inline __attribute__((always_inline)) void linear_rates(const struct solver_upwind *work, size_t begin,
                                                               size_t end, const struct reach *reach)
{
    linear_rates_as(work, begin, end, reach, false);
}

static inline __attribute__((always_inline)) void linear_volume_rates(const struct solver_upwind *work, size_t begin,
                                                                      size_t end, const struct reach *reach)
{
    linear_rates_as(work, begin, end, reach, true);
}

static void linear_rates_of_part(const struct solver_upwind *work, const struct part *part, void *none)
{
    (void)none;
    if (work->evolves_J) {
        by_reach(work, part, GROUP, linear_volume_rates);
    } else {
        by_reach(work, part, GROUP, linear_rates);
    }
}
#endif

#endif
