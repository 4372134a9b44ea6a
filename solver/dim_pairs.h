/* What the loops of upwind.h take from a pair of the stencil, in double or in single precision. */
#ifndef SOLVER_DIM_PAIRS_H
#define SOLVER_DIM_PAIRS_H

#include "solver/dim_sums.h"

/* Weights of a pair: each in every lane, and together, where what is beyond DIM has no meaning. */
struct weights {
    vec each[DIM], together;
};

/* C_ab and A_ab. */
struct pair {
    struct weights C;
    vec A;
};

/* Weights that are `stride` numbers apart. */
static inline __attribute__((always_inline)) struct weights load_weights(const double *from, size_t stride)
{
    typedef vec loose __attribute__((aligned(sizeof(double))));
    struct weights w = {.together = {0}};
    for (int I = 0; I < DIM; I++) {
        w.each[I] = splat(from[I]);
        w.together[I] = from[I];
    }
    if (stride >= LANES) {
        w.together = *(const loose *)from;
    }
    return w;
}

static inline __attribute__((always_inline)) struct pair load_pair(const struct solver_upwind *work, size_t record,
                                                                   bool narrow)
{
    struct pair pair;
    if (!narrow) {
        pair.C = load_weights(work->pair + record * PAIR, PAIR);
        pair.A = splat(work->pair[record * PAIR + DIM]);
        return pair;
    }
    const float *from = work->narrow + record * PAIR;
#if DIM == 3
    typedef narrow_vec loose __attribute__((aligned(sizeof(float))));
    vec together = widen_vec(*(const loose *)from);
#else
    vec together = {0};
    for (int I = 0; I < DIM; I++) {
        together[I] = (double)from[I];
    }
#endif
    pair.C.together = together;
    for (int I = 0; I < DIM; I++) {
        pair.C.each[I] = spread(together, I);
    }
    pair.A = LANES > DIM ? spread(together, DIM) : splat((double)from[DIM]);
    return pair;
}

#endif
