/* Gradients of particles in ranks: differences of the neighbours on either side. */
#ifndef SOLVER_DIM_RANK_GRADIENTS_H
#define SOLVER_DIM_RANK_GRADIENTS_H

#include "solver/dim_ranks.h"

#if DIM == 2
/* How far the neighbours on either side of a particle are, or 0 if there is none, along its rank and across, and the
 * weights of either difference. */
struct reach {
    size_t back[2], ahead[2];
    double weight[2];
    int axis;
};

static struct reach reach_of(const struct solver_rank *rank, int kind)
{
    return (struct reach){.back = {kind != SOLVER_RANK_FIRST, rank->below},
                          .ahead = {kind != SOLVER_RANK_LAST, rank->above},
                          .weight = {rank->weight[0][kind], rank->weight[1][kind]},
                          .axis = rank->axis};
}

/* The difference along or across (which), of a field with `lanes` numbers for each particle, at `from`. */
static inline __attribute__((always_inline)) wide slope_at(const real *from, size_t lanes, const struct reach *reach,
                                                           int which)
{
    wide ahead = load_wide(from + lanes * reach->ahead[which]);
    return wide_of(reach->weight[which]) * (ahead - load_wide(from - lanes * reach->back[which]));
}

/* Particles [begin, end), a register's width or more, that have both neighbours along their rank. */
static void gradients_inside(const struct solver_upwind *work, size_t begin, size_t end, const struct reach *reach)
{
    size_t count = end - begin;
    int first = reach->axis; /* which difference is along the first axis */
    for (size_t k = 0; k < 2 * count; k = next_block(k, 2 * count)) {
        const real *v = work->v + 2 * begin + k;
        real *to = work->F_rate + 4 * begin + 2 * k;
        wide of[2] = {slope_at(v, 2, reach, first), slope_at(v, 2, reach, 1 - first)};
        store_wide(to, __builtin_shufflevector(of[0], of[1], EACH_LANE(LOW_OF_COLUMNS)));
        store_wide(to + WIDTH, __builtin_shufflevector(of[0], of[1], EACH_LANE(HIGH_OF_COLUMNS)));
    }
    for (size_t k = 0; work->pressure_gradient != NULL && k < count; k = next_block(k, count)) {
        const real *pressure = work->pressure + begin + k;
        store_in_turn(work->pressure_gradient + 2 * (begin + k), slope_at(pressure, 1, reach, first),
                      slope_at(pressure, 1, reach, 1 - first));
    }
}

/* Of one particle. */
static void gradients_at(const struct solver_upwind *work, size_t a, const struct reach *reach)
{
    for (int which = 0; which < 2; which++) {
        int I = which == 0 ? reach->axis : 1 - reach->axis;
        size_t ahead = a + reach->ahead[which];
        size_t back = a - reach->back[which];
        for (int i = 0; i < 2; i++) {
            work->F_rate[4 * a + 2 * (size_t)I + (size_t)i] =
                reach->weight[which] * (work->v[2 * ahead + (size_t)i] - work->v[2 * back + (size_t)i]);
        }
        if (work->pressure_gradient != NULL) {
            work->pressure_gradient[2 * a + (size_t)I] =
                reach->weight[which] * (work->pressure[ahead] - work->pressure[back]);
        }
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
    gradients_inside(work, begin, end, &inside);
}

static void gradients(const struct solver_upwind *work, size_t begin, size_t end, solver_rank_others *others)
{
    if (has_ranks(work)) {
        for_ranks(work, begin, end, gradients_of_part, NULL, others);
    } else {
        others(work, begin, end);
    }
}
#endif

#endif
