/* A lot: one number of each of LOT particles side by side in a register, for loops over particles that need no
 * neighbour. No operation takes a number from one lane to another: what a particle gets does not depend on which others
 * are beside it, nor on how many. (A group, dim_group.h, has whole vectors of few particles, for loops over pairs.) */
#ifndef SOLVER_DIM_LOTS_H
#define SOLVER_DIM_LOTS_H

#include "solver/dim.h"
#include "solver/dim_flops.h"

#include <math.h>
#include <stdbool.h>

/* Files whose loops gain by it ask for lots as wide as registers of AVX-512. */
#if defined WIDE_LOTS && defined __AVX512F__ && DIM > 1
enum { LOT = 8 };
#define LOT_OF_EIGHT
#else
enum { LOT = 4 };
#endif
typedef double lot __attribute__((vector_size(LOT * sizeof(double))));
/* All bits of a lane are set, or none: what a comparison gives. */
typedef __typeof__((lot){0} > (lot){0}) lot_mask;

static inline lot lot_of(double a)
{
#ifdef LOT_OF_EIGHT
    return (lot){a, a, a, a, a, a, a, a};
#else
    return (lot){a, a, a, a};
#endif
}

static inline lot select_lot(lot_mask where, lot a, lot b)
{
    return (lot)((where & (lot_mask)a) | (~where & (lot_mask)b));
}

/* As fmax; what is no number counts for nothing if it comes second. */
static inline lot larger_lot(lot known, lot other)
{
    return select_lot(other > known, other, known);
}

static inline bool all_lot(lot_mask mask)
{
    return (mask[0] & mask[1] & mask[2] & mask[3]) != 0;
}

static inline lot sqrt_lot(lot a)
{
#if defined LOT_OF_EIGHT
    return _mm512_sqrt_pd(a);
#elif defined __AVX__
    return _mm256_sqrt_pd(a);
#else
    return (lot){sqrt(a[0]), sqrt(a[1]), sqrt(a[2]), sqrt(a[3])};
#endif
}

/* Numbers of LOT particles that follow each other, anywhere. */
typedef double lot_anywhere __attribute__((vector_size(LOT * sizeof(double)), aligned(sizeof(double))));

static inline lot load_lot(const double *from)
{
    return *(const lot_anywhere *)from;
}

static inline void store_lot(double *to, lot value)
{
    *(lot_anywhere *)to = value;
}

/* Tensors of LOT particles, by columns as in dim.h. */
struct tensors {
    lot column[DIM][DIM];
};

#if defined LOT_OF_EIGHT && DIM == 3
/* Vectors of particles k and k + 4 lie in one register, so that its halves are as the lots of four below. */
static inline struct tensors load_tensors(const double *from)
{
    struct tensors T;
    for (int I = 0; I < DIM; I++) {
        lot of[4];
        for (int k = 0; k < 4; k++) {
            of[k] = __builtin_shufflevector(load(from + (k * DIM + I) * LANES),
                                            load(from + ((k + 4) * DIM + I) * LANES), 0, 1, 2, 3, 4, 5, 6, 7);
        }
        lot low[2];
        lot high[2];
        for (int k = 0; k < 2; k++) {
            low[k] = __builtin_shufflevector(of[2 * k], of[2 * k + 1], 0, 8, 2, 10, 4, 12, 6, 14);
            high[k] = __builtin_shufflevector(of[2 * k], of[2 * k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
        }
        T.column[I][0] = __builtin_shufflevector(low[0], low[1], 0, 1, 8, 9, 4, 5, 12, 13);
        T.column[I][1] = __builtin_shufflevector(high[0], high[1], 0, 1, 8, 9, 4, 5, 12, 13);
        T.column[I][2] = __builtin_shufflevector(low[0], low[1], 2, 3, 10, 11, 6, 7, 14, 15);
    }
    return T;
}

static inline void store_tensors(double *to, const struct tensors *T)
{
    lot none = {0};
    for (int I = 0; I < DIM; I++) {
        lot even[2] = {__builtin_shufflevector(T->column[I][0], T->column[I][1], 0, 8, 2, 10, 4, 12, 6, 14),
                       __builtin_shufflevector(T->column[I][2], none, 0, 8, 2, 10, 4, 12, 6, 14)};
        lot odd[2] = {__builtin_shufflevector(T->column[I][0], T->column[I][1], 1, 9, 3, 11, 5, 13, 7, 15),
                      __builtin_shufflevector(T->column[I][2], none, 1, 9, 3, 11, 5, 13, 7, 15)};
        lot of[4] = {__builtin_shufflevector(even[0], even[1], 0, 1, 8, 9, 4, 5, 12, 13),
                     __builtin_shufflevector(odd[0], odd[1], 0, 1, 8, 9, 4, 5, 12, 13),
                     __builtin_shufflevector(even[0], even[1], 2, 3, 10, 11, 6, 7, 14, 15),
                     __builtin_shufflevector(odd[0], odd[1], 2, 3, 10, 11, 6, 7, 14, 15)};
        for (int k = 0; k < 4; k++) {
            store(to + (k * DIM + I) * LANES, __builtin_shufflevector(of[k], of[k], 0, 1, 2, 3));
            store(to + ((k + 4) * DIM + I) * LANES, __builtin_shufflevector(of[k], of[k], 4, 5, 6, 7));
        }
    }
}
#elif defined LOT_OF_EIGHT
/* Tensors of two particles lie in one register. */
static inline struct tensors load_tensors(const double *from)
{
    struct tensors T;
    lot two[4];
    for (int k = 0; k < 4; k++) {
        two[k] = load_lot(from + k * LOT);
    }
    for (int i = 0; i < DIM; i++) {
        lot of[2];
        for (int k = 0; k < 2; k++) { /* of particles 4 k, 4 k + 2 and 4 k + 1, 4 k + 3, column after column */
            of[k] = i == 0 ? __builtin_shufflevector(two[2 * k], two[2 * k + 1], 0, 8, 2, 10, 4, 12, 6, 14)
                           : __builtin_shufflevector(two[2 * k], two[2 * k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
        }
        T.column[0][i] = __builtin_shufflevector(of[0], of[1], 0, 4, 1, 5, 8, 12, 9, 13);
        T.column[1][i] = __builtin_shufflevector(of[0], of[1], 2, 6, 3, 7, 10, 14, 11, 15);
    }
    return T;
}

static inline void store_tensors(double *to, const struct tensors *T)
{
    for (int k = 0; k < 2; k++) { /* the same, backwards */
        lot of[2];
        for (int i = 0; i < DIM; i++) {
            of[i] = k == 0 ? __builtin_shufflevector(T->column[0][i], T->column[1][i], 0, 2, 8, 10, 1, 3, 9, 11)
                           : __builtin_shufflevector(T->column[0][i], T->column[1][i], 4, 6, 12, 14, 5, 7, 13, 15);
        }
        store_lot(to + 2 * k * LOT, __builtin_shufflevector(of[0], of[1], 0, 8, 2, 10, 4, 12, 6, 14));
        store_lot(to + (2 * k + 1) * LOT, __builtin_shufflevector(of[0], of[1], 1, 9, 3, 11, 5, 13, 7, 15));
    }
}
#else
/* Vectors of LOT particles by components, and back. */
static inline void vectors_apart(const vec of[LOT], lot component[DIM])
{
#if DIM == 3
    lot low[2];
    lot high[2];
    for (int k = 0; k < 2; k++) {
        low[k] = __builtin_shufflevector(of[2 * k], of[2 * k + 1], 0, 4, 2, 6);
        high[k] = __builtin_shufflevector(of[2 * k], of[2 * k + 1], 1, 5, 3, 7);
    }
    component[0] = __builtin_shufflevector(low[0], low[1], 0, 1, 4, 5);
    component[1] = __builtin_shufflevector(high[0], high[1], 0, 1, 4, 5);
    component[2] = __builtin_shufflevector(low[0], low[1], 2, 3, 6, 7);
#elif DIM == 2
    lot even = __builtin_shufflevector(of[0], of[2], 0, 1, 2, 3);
    lot odd = __builtin_shufflevector(of[1], of[3], 0, 1, 2, 3);
    component[0] = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
    component[1] = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
#else
    component[0] = (lot){of[0][0], of[1][0], of[2][0], of[3][0]};
#endif
}

static inline void vectors_together(const lot component[DIM], vec of[LOT])
{
#if DIM == 3
    lot none = {0};
    lot even[2] = {__builtin_shufflevector(component[0], component[1], 0, 4, 2, 6),
                   __builtin_shufflevector(component[2], none, 0, 4, 2, 6)};
    lot odd[2] = {__builtin_shufflevector(component[0], component[1], 1, 5, 3, 7),
                  __builtin_shufflevector(component[2], none, 1, 5, 3, 7)};
    of[0] = __builtin_shufflevector(even[0], even[1], 0, 1, 4, 5);
    of[1] = __builtin_shufflevector(odd[0], odd[1], 0, 1, 4, 5);
    of[2] = __builtin_shufflevector(even[0], even[1], 2, 3, 6, 7);
    of[3] = __builtin_shufflevector(odd[0], odd[1], 2, 3, 6, 7);
#elif DIM == 2
    lot even = __builtin_shufflevector(component[0], component[1], 0, 4, 2, 6);
    lot odd = __builtin_shufflevector(component[0], component[1], 1, 5, 3, 7);
    of[0] = __builtin_shufflevector(even, even, 0, 1);
    of[1] = __builtin_shufflevector(odd, odd, 0, 1);
    of[2] = __builtin_shufflevector(even, even, 2, 3);
    of[3] = __builtin_shufflevector(odd, odd, 2, 3);
#else
    for (int k = 0; k < LOT; k++) {
        of[k] = (vec){component[0][k]};
    }
#endif
}

/* Tensors of a field, from that of one particle on. */
static inline struct tensors load_tensors(const double *from)
{
    struct tensors T;
    for (int I = 0; I < DIM; I++) {
        vec of[LOT];
        for (int k = 0; k < LOT; k++) {
            of[k] = load(from + (k * DIM + I) * LANES);
        }
        vectors_apart(of, T.column[I]);
    }
    return T;
}

static inline void store_tensors(double *to, const struct tensors *T)
{
    for (int I = 0; I < DIM; I++) {
        vec of[LOT];
        vectors_together(T->column[I], of);
        for (int k = 0; k < LOT; k++) {
            store(to + (k * DIM + I) * LANES, of[k]);
        }
    }
}
#endif

/* The same tensor in each lane. */
static inline struct tensors tensors_of(struct tensor T)
{
    struct tensors all;
    for (int I = 0; I < DIM; I++) {
        for (int i = 0; i < DIM; i++) {
            all.column[I][i] = lot_of(T.column[I][i]);
        }
    }
    return all;
}

static inline lot dot_lot(const lot a[DIM], const lot b[DIM])
{
    lot sum = a[0] * b[0];
    for (int i = 1; i < DIM; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

#if DIM == 3
static inline void cross_lot(const lot a[3], const lot b[3], lot product[3])
{
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}
#endif

static inline struct tensors cofactors(const struct tensors *F)
{
    struct tensors H;
#if DIM == 3
    cross_lot(F->column[1], F->column[2], H.column[0]);
    cross_lot(F->column[2], F->column[0], H.column[1]);
    cross_lot(F->column[0], F->column[1], H.column[2]);
#elif DIM == 2
    H.column[0][0] = F->column[1][1];
    H.column[0][1] = -F->column[1][0];
    H.column[1][0] = -F->column[0][1];
    H.column[1][1] = F->column[0][0];
#else
    (void)F;
    H.column[0][0] = lot_of(1.0);
#endif
    return H;
}

static inline lot determinants(const struct tensors *F)
{
#if DIM == 3
    lot normal[3];
    cross_lot(F->column[1], F->column[2], normal);
    return dot_lot(F->column[0], normal);
#elif DIM == 2
    return F->column[0][0] * F->column[1][1] - F->column[1][0] * F->column[0][1];
#else
    return F->column[0][0];
#endif
}

/* A : A */
static inline lot squares(const struct tensors *A)
{
    lot sum = dot_lot(A->column[0], A->column[0]);
    for (int I = 1; I < DIM; I++) {
        sum += dot_lot(A->column[I], A->column[I]);
    }
    return sum;
}

#endif
