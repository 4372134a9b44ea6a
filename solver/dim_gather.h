/* Fields at the particles of a group, and at the neighbours of their pairs. */
#ifndef SOLVER_DIM_GATHER_H
#define SOLVER_DIM_GATHER_H

#include "solver/dim_turns.h"

/* Vectors of a field, `stride` apart (of particles abreast LANES, and no more); numbers in every lane of their part, of
 * an array (of particles abreast the same for all) and of a scalar field, and for each particle. */
#ifdef ABREAST
typedef wide wide_anywhere __attribute__((aligned(sizeof(real))));
typedef many many_anywhere __attribute__((aligned(sizeof(real))));

static inline __attribute__((always_inline)) wide gather(const real *field, size_t stride, const size_t at[PLACES])
{
    return *(const wide_anywhere *)(field + at[0] * stride);
}

static inline __attribute__((always_inline)) many gather_many(const real *field, const size_t at[PLACES])
{
    return *(const many_anywhere *)(field + at[0]);
}

/* Numbers of particles, in turn, in the lanes of each: by doubling, as GCC 12 takes wider steps through memory. */
static inline wide from_twos(many first, many second)
{
#if DIM == 1
    (void)second;
    return (wide)first;
#else
    typedef real two_each __attribute__((vector_size(2 * sizeof(many))));
    two_each both = __builtin_shufflevector(first, second, EACH_OF_TWOS(FROM_TWOS));
#if DIM == 2
    return (wide)both;
#else
    return __builtin_shufflevector(both, both, EACH_LANE(TWICE));
#endif
#endif
}

static inline __attribute__((always_inline)) wide gather_scalars(const real *field, const size_t at[PLACES])
{
    return from_twos(gather_many(field, at), gather_many(field, at));
}

static inline __attribute__((always_inline)) void scatter(real *field, size_t stride, const size_t at[PLACES], wide a)
{
    *(wide_anywhere *)(field + at[0] * stride) = a;
}

static inline __attribute__((always_inline)) void scatter_many(real *field, const size_t at[PLACES], many a)
{
    *(many_anywhere *)(field + at[0]) = a;
}
#else
static inline __attribute__((always_inline)) wide gather(const real *field, size_t stride, const size_t at[PLACES])
{
    vec part[GROUP];
    for (int g = 0; g < GROUP; g++) {
        part[g] = load(field + at[g] * stride);
    }
    return join(part);
}

static inline __attribute__((always_inline)) wide gather_scalars(const real *field, const size_t at[PLACES])
{
    real each[GROUP];
    for (int g = 0; g < GROUP; g++) {
        each[g] = field[at[g]];
    }
    return join_each(each);
}

static inline __attribute__((always_inline)) void scatter(real *field, size_t stride, const size_t at[PLACES], wide a)
{
    vec part[GROUP];
    take_apart(a, part);
    for (int g = 0; g < GROUP; g++) {
        store(field + at[g] * stride, part[g]);
    }
}

static inline __attribute__((always_inline)) void scatter_many(real *field, const size_t at[PLACES], many a)
{
    for (int g = 0; g < GROUP; g++) {
        field[at[g]] = a[g];
    }
}
#endif

static inline __attribute__((always_inline)) wide gather_each(const double *field, size_t stride,
                                                              const size_t at[PLACES])
{
    real each[PLACES];
    for (int g = 0; g < PLACES; g++) {
        each[g] = (real)field[at[g] * stride];
    }
    return join_each(each);
}

/* Where particle g of a group is. */
static inline size_t place(const size_t at[PLACES], int g)
{
    return PLACES == 1 ? at[0] + (size_t)g : at[g % PLACES];
}

/* Numbers of a scalar field at the neighbours of pairs. */
static inline __attribute__((always_inline)) wide gather_in_turn(const real *field, const size_t *const at[TURNS])
{
#ifdef ABREAST
    return from_twos(gather_many(field, at[0]), gather_many(field, at[TURNS - 1]));
#else
    wide of[TURNS];
    for (int k = 0; k < TURNS; k++) {
        of[k] = gather_scalars(field, at[k]);
    }
    return in_turn(of);
#endif
}

/* Column I, a constant, of tensors. */
static inline __attribute__((always_inline)) wide gather_column(const real *field, int I, const size_t at[PLACES])
{
    enum { STRIDE = DIM * LANES };
#if !defined ABREAST || DIM == 1 || GROUP == 1
    return gather(field + I * LANES, STRIDE, at);
#elif DIM == 2
    wide low = *(const wide_anywhere *)(field + at[0] * STRIDE);
    wide high = *(const wide_anywhere *)(field + at[0] * STRIDE + WIDTH);
    return I == 0 ? __builtin_shufflevector(low, high, EACH_LANE(COLUMN_0))
                  : __builtin_shufflevector(low, high, EACH_LANE(COLUMN_1));
#else
    vec part[GROUP];
    for (int g = 0; g < GROUP; g++) {
        part[g] = load(field + (at[0] + (size_t)g) * STRIDE + I * LANES);
    }
    return join(part);
#endif
}

/* The same of F and H, which lack the identity in single precision. */
static inline __attribute__((always_inline)) wide gather_measure(const real *field, int I, const size_t at[PLACES])
{
    wide column = gather_column(field, I, at);
    return IN_SINGLE ? column + along_axis(1, I) : column;
}

static inline __attribute__((always_inline)) void scatter_columns(real *field, const size_t at[PLACES],
                                                                  const wide column[DIM])
{
    enum { STRIDE = DIM * LANES };
#if !defined ABREAST || DIM == 1 || GROUP == 1
    for (int I = 0; I < DIM; I++) {
        scatter(field + I * LANES, STRIDE, at, column[I]);
    }
#elif DIM == 2
    real *to = field + at[0] * STRIDE;
    *(wide_anywhere *)to = __builtin_shufflevector(column[0], column[1], EACH_LANE(LOW_OF_COLUMNS));
    *(wide_anywhere *)(to + WIDTH) = __builtin_shufflevector(column[0], column[1], EACH_LANE(HIGH_OF_COLUMNS));
#else
    for (int I = 0; I < DIM; I++) {
        vec part[GROUP];
        take_apart(column[I], part);
        for (int g = 0; g < GROUP; g++) {
            store(field + (at[0] + (size_t)g) * STRIDE + I * LANES, part[g]);
        }
    }
#endif
}

#endif
