/* Ranks (stencil_ranks.h) and what lies between them, one after the other. */
#ifndef SOLVER_DIM_RANKS_H
#define SOLVER_DIM_RANKS_H

#include "solver/dim_gather.h"
#include "solver/stencil_ranks.h"
#include "solver/upwind_ranks.h"

#if DIM > 1
/* Fewer particles than LEAST go with the others: on all paths the same, as bits differ by round-off. Between those at
 * the ends there are then as many as a register has lanes. PAD of them fill the widest. */
enum { PAD = 64 / sizeof(real), LEAST = (DIM == 2 ? PAD : 8) + 2 };
_Static_assert(LEAST >= WIDTH + 2, "a register may hold more than one part");

static inline wide load_wide(const real *from)
{
    return *(const wide_anywhere *)from;
}

static inline void store_wide(real *to, wide a)
{
    *(wide_anywhere *)to = a;
}

/* The next of `count` numbers that a register takes, after those from k on: the last ones may have some in common. */
static inline size_t next_block(size_t k, size_t count)
{
    size_t next = k + WIDTH;
    return next >= count ? count : next + WIDTH <= count ? next : count - WIDTH;
}

/* Numbers of two registers that take turns. */
#define LOW_OF_BOTH(i)  ((i) / 2 + (i) % 2 * WIDTH)
#define HIGH_OF_BOTH(i) (WIDTH / 2 + LOW_OF_BOTH(i))

static inline void store_in_turn(real *to, wide first, wide second)
{
    store_wide(to, __builtin_shufflevector(first, second, EACH_LANE(LOW_OF_BOTH)));
    store_wide(to + WIDTH, __builtin_shufflevector(first, second, EACH_LANE(HIGH_OF_BOTH)));
}

/* Of a rank, particles [begin, end), which have neighbours beside them in it or not; place `at` is the first one's. */
struct part {
    const struct solver_rank *rank;
    size_t begin, end, left, right, at;
};

/* The first rank that ends after particle a. */
static size_t first_rank(const struct solver_upwind *work, size_t a)
{
    size_t low = 0;
    size_t high = work->rank_count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (work->rank[middle].end > a) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

/* Registers of the baseline are narrow, and tests count its operations. */
static bool has_ranks(const struct solver_upwind *work)
{
    return REGISTER_BYTES > 16 && work->rank != NULL;
}

/* How far the neighbours on either side of a particle are along each axis, or 0 if there is none, in particles and half
 * of it in m, and the weights of their differences. */
struct reach {
    size_t back[DIM], ahead[DIM];
    real weight[DIM], half[DIM][2];
};

static inline __attribute__((always_inline)) struct reach reach_of(const struct solver_rank *rank, int kind)
{
    struct reach reach;
    for (int I = 0; I < DIM; I++) {
        bool along = I == rank->axis;
        reach.back[I] = along && kind == SOLVER_RANK_FIRST ? 0 : rank->back[I];
        reach.ahead[I] = along && kind == SOLVER_RANK_LAST ? 0 : rank->ahead[I];
        reach.weight[I] = (real)rank->weight[I][kind];
        reach.half[I][0] = along && kind == SOLVER_RANK_FIRST ? 0 : (real)rank->half[I][0];
        reach.half[I][1] = along && kind == SOLVER_RANK_LAST ? 0 : (real)rank->half[I][1];
    }
    return reach;
}

typedef void solver_rank_reach(const struct solver_upwind *work, size_t begin, size_t end, const struct reach *reach);

/* The particles of a part, by a loop that takes `least` at a time. As many are taken for one at an end of its rank, and
 * the others of them then done again. */
static inline __attribute__((always_inline)) void by_reach(const struct solver_upwind *work, const struct part *part,
                                                           size_t least, solver_rank_reach *loop)
{
    size_t begin = part->begin;
    size_t end = part->end;
    if (part->left == 0) {
        struct reach first = reach_of(part->rank, SOLVER_RANK_FIRST);
        loop(work, begin, begin + least, &first);
        begin++;
    }
    if (part->right == 0) {
        struct reach last = reach_of(part->rank, SOLVER_RANK_LAST);
        loop(work, end - least, end, &last);
        end--;
    }
    struct reach inside = reach_of(part->rank, SOLVER_RANK_INSIDE);
    loop(work, begin, end, &inside);
}

typedef void solver_rank_part(const struct solver_upwind *work, const struct part *part, void *with);

/* Particles [begin, end), those in ranks by `each`. */
static void for_ranks(const struct solver_upwind *work, size_t begin, size_t end, solver_rank_part *each, void *with,
                      solver_rank_others *others)
{
    size_t done = begin;
    for (size_t r = first_rank(work, begin); r < work->rank_count && work->rank[r].begin < end; r++) {
        const struct solver_rank *rank = work->rank + r;
        size_t first = rank->begin > begin ? rank->begin : begin;
        size_t last = rank->end < end ? rank->end : end;
        if (last - first < LEAST) {
            continue;
        }
        if (done < first) {
            others(work, done, first);
        }
        struct part part = {.rank = rank,
                            .begin = first,
                            .end = last,
                            .left = first > rank->begin,
                            .right = last < rank->end,
                            .at = PAD + (first - rank->begin)};
        each(work, &part, with);
        done = last;
    }
    if (done < end) {
        others(work, done, end);
    }
}
#endif

#endif
