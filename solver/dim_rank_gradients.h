/* Gradients of particles in ranks: differences of the neighbours on either side. */
#ifndef SOLVER_DIM_RANK_GRADIENTS_H
#define SOLVER_DIM_RANK_GRADIENTS_H

#include "solver/dim_ranks.h"

#if DIM > 1
/* How far the neighbours on either side of a particle are along each axis, or 0 if there is none, and the weights of
 * their differences. */
struct reach {
    size_t back[DIM], ahead[DIM];
    double weight[DIM];
};

static struct reach reach_of(const struct solver_rank *rank, int kind)
{
    struct reach reach;
    for (int which = 0; which < DIM; which++) {
        int I = rank->axis[which];
        reach.back[I] = which == 0 ? kind != SOLVER_RANK_FIRST : rank->below[which - 1];
        reach.ahead[I] = which == 0 ? kind != SOLVER_RANK_LAST : rank->above[which - 1];
        reach.weight[I] = rank->weight[which][kind];
    }
    return reach;
}

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

/* Particles [begin, end), a register's width or more, that have both neighbours along their rank. */
static void gradients_inside(const struct solver_upwind *work, size_t begin, size_t end, const struct reach *reach)
{
    size_t count = end - begin;
    wide of[DIM];
    for (size_t k = 0; k < LANES * count; k = next_block(k, LANES * count)) {
        size_t at[PLACES] = {begin + k / LANES};
        slopes_at(work->v + LANES * at[0], LANES, reach, of);
        scatter_columns(work->F_rate, at, of);
    }
    for (size_t k = 0; work->pressure_gradient != NULL && k < count; k = next_block(k, count)) {
        slopes_at(work->pressure + begin + k, 1, reach, of);
        store_vectors(work->pressure_gradient + LANES * (begin + k), of);
    }
}

/* Of one particle. */
static void gradients_at(const struct solver_upwind *work, size_t a, const struct reach *reach)
{
    vec of_pressure = {0};
    for (int I = 0; I < DIM; I++) {
        size_t ahead = a + reach->ahead[I];
        size_t back = a - reach->back[I];
        vec of_v = splat(reach->weight[I]) * (load(work->v + ahead * LANES) - load(work->v + back * LANES));
        store(work->F_rate + (a * DIM + (size_t)I) * LANES, of_v);
        if (work->pressure_gradient != NULL) {
            of_pressure[I] = reach->weight[I] * (work->pressure[ahead] - work->pressure[back]);
        }
    }
    if (work->pressure_gradient != NULL) {
        store(work->pressure_gradient + a * LANES, of_pressure);
    }
}

static void gradients_of_part(const struct solver_upwind *work, const struct part *part, void *none)
{
    (void)none;
    struct reach inside = reach_of(part->rank, SOLVER_RANK_INSIDE);
    size_t begin = part->begin;
    size_t end = part->end;
    if (part->left == 0) {
        struct reach first = reach_of(part->rank, SOLVER_RANK_FIRST);
        gradients_at(work, begin++, &first);
    }
    if (part->right == 0) {
        struct reach last = reach_of(part->rank, SOLVER_RANK_LAST);
        gradients_at(work, --end, &last);
    }
    while (begin < end && end - begin < WIDTH) {
        gradients_at(work, begin++, &inside);
    }
    if (begin < end) {
        gradients_inside(work, begin, end, &inside);
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
