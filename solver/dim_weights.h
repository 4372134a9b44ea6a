/* Weights of the pairs of a group, in double or in single precision, for pairs that lie anyhow. */
#ifndef SOLVER_DIM_WEIGHTS_H
#define SOLVER_DIM_WEIGHTS_H

#include "solver/dim_pairs.h"

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
