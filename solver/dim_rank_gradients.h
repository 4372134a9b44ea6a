/* Gradients of particles in ranks: differences of the neighbours on either side. */
#ifndef SOLVER_DIM_RANK_GRADIENTS_H
#define SOLVER_DIM_RANK_GRADIENTS_H

#include "solver/dim_ranks.h"

#if DIM > 1
/* Derivatives along each axis of a field with `lanes` numbers for each particle, at `from`. */
static inline __attribute__((always_inline)) void slopes_at(const real *from, size_t lanes, const struct reach *reach,
                                                            wide of[DIM])
{
    for (int I = 0; I < DIM; I++) {
        wide ahead = load_wide(from + lanes * reach->ahead[I]);
        of[I] = wide_of(reach->weight[I]) * (ahead - load_wide(from - lanes * reach->back[I]));
    }
}

/* Numbers of two registers that take turns, by twos. */
static inline void store_twos_in_turn(real *to, wide first, wide second)
{
    store_wide(to, __builtin_shufflevector(first, second, EACH_LANE(LOW_OF_COLUMNS)));
    store_wide(to + WIDTH, __builtin_shufflevector(first, second, EACH_LANE(HIGH_OF_COLUMNS)));
}

/* Vectors of as many particles as a register has lanes, by their components. */
static inline void store_vectors(real *to, const wide of[DIM])
{
#if DIM == 2
    store_in_turn(to, of[0], of[1]);
#else
    wide none = {0};
    wide low = __builtin_shufflevector(of[0], of[1], EACH_LANE(LOW_OF_BOTH));
    wide high = __builtin_shufflevector(of[0], of[1], EACH_LANE(HIGH_OF_BOTH));
    store_twos_in_turn(to, low, __builtin_shufflevector(of[2], none, EACH_LANE(LOW_OF_BOTH)));
    store_twos_in_turn(to + 2 * WIDTH, high, __builtin_shufflevector(of[2], none, EACH_LANE(HIGH_OF_BOTH)));
#endif
}

static inline __attribute__((always_inline)) void gradients_of_v(const struct solver_upwind *work, size_t begin,
                                                                 size_t end, const struct reach *reach)
{
    wide of[DIM];
    for (size_t k = 0; k < LANES * (end - begin); k = next_block(k, LANES * (end - begin))) {
        size_t at[PLACES] = {begin + k / LANES};
        slopes_at(work->v + LANES * at[0], LANES, reach, of);
        scatter_columns(work->F_rate, at, of);
    }
}

static inline __attribute__((always_inline)) void gradients_of_pressure(const struct solver_upwind *work, size_t begin,
                                                                        size_t end, const struct reach *reach)
{
    wide of[DIM];
    for (size_t k = 0; k < end - begin; k = next_block(k, end - begin)) {
        slopes_at(work->pressure + begin + k, 1, reach, of);
        store_vectors(work->pressure_gradient + LANES * (begin + k), of);
    }
}

static void gradients_of_part(const struct solver_upwind *work, const struct part *part, void *none)
{
    (void)none;
    by_reach(work, part, GROUP, gradients_of_v);
    if (work->pressure_gradient != NULL) {
        by_reach(work, part, WIDTH, gradients_of_pressure);
    }
}

static void gradients(const struct solver_upwind *work, size_t begin, size_t end, solver_rank_others *others)
{
    if (has_ranks(work)) {
        for_ranks(work, begin, end, gradients_of_part, NULL, others);
    } else {
        others(work, begin, end);
    }
}
#else
static void gradients(const struct solver_upwind *work, size_t begin, size_t end, solver_rank_others *others)
{
    others(work, begin, end);
}
#endif

#endif
