/* Groups of particles and their pairs, for the loops of upwind.h. */
#ifndef SOLVER_DIM_PAIRS_H
#define SOLVER_DIM_PAIRS_H

#include "solver/dim_gather.h"
#include "solver/dim_work.h"

/* Particles whose pairs are summed together. A row that ends before the longest goes on with its last pair, idle: with
 * weights of zero, which change no sum. */
struct group {
    size_t count;                                 /* of them; parts beyond repeat the last */
    size_t at[PLACES], row[PLACES], last[PLACES]; /* particle, its first and its last pair */
    size_t shift[PLACES];                         /* from its pairs to their records */
    size_t shortest, longest;                     /* row */
};

#ifdef ABREAST
enum { SAME_SCALES = 1 }; /* of all groups of a run */

/* The next particles from a on of those before `end`, which are abreast and no fewer than a group: the last groups may
 * have some in common. */
static inline __attribute__((always_inline)) struct group next_group(const struct solver_upwind *work, size_t a,
                                                                     size_t end)
{
    size_t first = a + GROUP <= end ? a : end - GROUP;
    size_t length = work->row[first + 1] - work->row[first];
    return (struct group){.count = GROUP,
                          .at = {first},
                          .row = {work->row[first]},
                          .last = {work->row[first + 1] - 1},
                          .shift = {pair_shift(work, first)},
                          .shortest = length,
                          .longest = length};
}
#else
enum { SAME_SCALES = 0 };

/* The next particles from a on: as many as fit, up to one without pairs, or that alone. */
static inline __attribute__((always_inline)) struct group next_group(const struct solver_upwind *work, size_t a,
                                                                     size_t end)
{
    size_t first = work->row[a + 1] - work->row[a];
    struct group group = {.count = 1, .shortest = first, .longest = first};
    bool more = group.longest > 0;
    for (int g = 0; g < GROUP; g++) {
        size_t next = a + (size_t)g;
        more = more && next < end && work->row[next + 1] > work->row[next];
        group.count = more ? (size_t)g + 1 : group.count;
        group.at[g] = a + group.count - 1;
        group.row[g] = work->row[group.at[g]];
        group.last[g] = work->row[group.at[g] + 1] - 1;
        group.shift[g] = pair_shift(work, group.at[g]);
        size_t length = work->row[group.at[g] + 1] - group.row[g];
        group.longest = length > group.longest ? length : group.longest;
        group.shortest = length < group.shortest ? length : group.shortest;
    }
    return group;
}
#endif

/* The k-th pair of each particle of a group, its record, and the neighbour; of particles abreast that of the first. */
struct pairs {
    size_t ab[PLACES], record[PLACES], b[PLACES];
    bool idle[PLACES];
};

/* Of particle g of a group; an idle one is the last of the row. */
static inline __attribute__((always_inline)) void set_pair(const struct solver_upwind *work, const struct group *group,
                                                           int g, size_t ab, bool idle, struct pairs *pairs)
{
    pairs->idle[g] = idle;
    pairs->ab[g] = idle ? group->last[g] : ab;
    pairs->record[g] = pairs->ab[g] + group->shift[g];
    pairs->b[g] = work->neighbour[pairs->ab[g]];
}

static inline __attribute__((always_inline)) struct pairs pairs_of(const struct solver_upwind *work,
                                                                   const struct group *group, size_t k, bool idle)
{
    struct pairs pairs;
    for (int g = 0; g < PLACES; g++) {
        size_t ab = group->row[g] + k;
        set_pair(work, group, g, ab, idle && ab > group->last[g], &pairs);
    }
    return pairs;
}

#endif
