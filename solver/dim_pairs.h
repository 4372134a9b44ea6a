/* What the loops of upwind.h take from the pairs of a group of particles, in double or in single precision. */
#ifndef SOLVER_DIM_PAIRS_H
#define SOLVER_DIM_PAIRS_H

#include "solver/dim_group.h"
#include "solver/dim_sums.h"

/* Particles whose pairs are summed together. A row that ends before the longest goes on with its last pair, idle: with
 * weights of zero, which change no sum. */
struct group {
    size_t count;                              /* of them; parts beyond repeat the last */
    size_t at[GROUP], row[GROUP], last[GROUP]; /* particle, its first and its last pair */
    size_t shift[GROUP];                       /* from its pairs to their records */
    size_t shortest, longest;                  /* row */
};

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

/* The k-th pair of each particle of a group, its record, and the neighbour. */
struct pairs {
    size_t ab[GROUP], record[GROUP], b[GROUP];
    bool idle[GROUP];
};

static inline __attribute__((always_inline)) struct pairs pairs_of(const struct solver_upwind *work,
                                                                   const struct group *group, size_t k, bool idle)
{
    struct pairs pairs;
    for (int g = 0; g < GROUP; g++) {
        size_t ab = group->row[g] + k;
        pairs.idle[g] = idle && ab > group->last[g];
        pairs.ab[g] = pairs.idle[g] ? group->last[g] : ab;
        pairs.record[g] = pairs.ab[g] + group->shift[g];
        pairs.b[g] = work->neighbour[pairs.ab[g]];
    }
    return pairs;
}

/* Weights of a pair: each in every lane, and together, where what is beyond DIM has no meaning. */
struct weights {
    wide each[DIM], together;
};

/* C_ab and A_ab. */
struct pair {
    struct weights C;
    wide A;
};

/* Where the weights of pairs are, `stride` apart: the number[g]-th. */
static inline __attribute__((always_inline)) void weights_at(const double *weights, size_t stride,
                                                             const struct pairs *pairs, const size_t number[GROUP],
                                                             const double *from[GROUP])
{
    static const double none[PAIR] = {0};
    for (int g = 0; g < GROUP; g++) {
        from[g] = pairs->idle[g] ? none : weights + number[g] * stride;
    }
}

static inline __attribute__((always_inline)) wide weight(const double *const from[GROUP], int I)
{
    real each[GROUP];
    for (int g = 0; g < GROUP; g++) {
        each[g] = (real)from[g][I];
    }
    return join_each(each);
}

/* Weights that are `stride` numbers apart, DIM of each pair or more. */
static inline __attribute__((always_inline)) struct weights load_weights(const double *const from[GROUP], size_t stride)
{
    struct weights w;
    vec together[GROUP];
    for (int g = 0; g < GROUP; g++) {
        together[g] = (vec){0};
        for (int I = 0; I < DIM; I++) {
            together[g][I] = (real)from[g][I];
        }
#ifndef SINGLE
        typedef vec loose __attribute__((aligned(sizeof(double))));
        if (stride >= LANES) {
            together[g] = *(const loose *)from[g];
        }
#else
        (void)stride;
#endif
    }
    w.together = join(together);
    for (int I = 0; I < DIM; I++) {
        w.each[I] = GROUP > 1 ? spread(w.together, I) : weight(from, I);
    }
    return w;
}

static inline __attribute__((always_inline)) struct pair load_narrow(const struct solver_upwind *work,
                                                                     const struct pairs *pairs)
{
    static const float none[PAIR] = {0};
    struct pair pair;
    vec together[GROUP];
    real A[GROUP];
    for (int g = 0; g < GROUP; g++) {
        const float *from = pairs->idle[g] ? none : work->narrow + pairs->record[g] * PAIR;
#if DIM == 3
        together[g] = load_floats(from);
#else
        together[g] = (vec){0};
        for (int I = 0; I < DIM; I++) {
            together[g][I] = (real)from[I];
        }
#endif
        A[g] = (real)from[DIM];
    }
    pair.C.together = join(together);
    for (int I = 0; I < DIM; I++) {
        pair.C.each[I] = spread(pair.C.together, I);
    }
    pair.A = LANES > DIM ? spread(pair.C.together, DIM) : join_each(A);
    return pair;
}

static inline __attribute__((always_inline)) struct pair load_pair(const struct solver_upwind *work,
                                                                   const struct pairs *pairs, bool narrow)
{
    if (narrow) {
        return load_narrow(work, pairs);
    }
    const double *from[GROUP];
    weights_at(work->pair, PAIR, pairs, pairs->record, from);
    return (struct pair){.C = load_weights(from, PAIR), .A = weight(from, DIM)};
}

#endif
