/* Vectors of a group of particles side by side in one register, for processors whose registers are wider than a
 * particle's vector. Each particle has a part of LANES lanes, and no operation takes a number from one part to another:
 * what a particle gets does not depend on which others are beside it, nor on how many. */
#ifndef SOLVER_DIM_GROUP_H
#define SOLVER_DIM_GROUP_H

#include "solver/dim.h"

/* In space 512 bits for two particles were no faster than 256 for one: what is saved of arithmetic, putting the vectors
 * of two neighbours together takes. */
#if DIM == 2 && defined __AVX__ && !defined SINGLE
#define GROUP 2
#else
#define GROUP 1
#endif

typedef real wide __attribute__((vector_size(GROUP * LANES * sizeof(real))));

#if GROUP == 1
static inline wide join(const vec part[GROUP])
{
    return part[0];
}

static inline wide join_each(const real each[GROUP])
{
    return splat(each[0]);
}

static inline void take_apart(wide a, vec part[GROUP])
{
    part[0] = a;
}
#else
static inline wide join(const vec part[GROUP])
{
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(part[0]), part[1], 1);
}

static inline wide join_each(const real each[GROUP])
{
    return _mm256_blend_pd(_mm256_set1_pd(each[0]), _mm256_set1_pd(each[1]), 0xc);
}

static inline void take_apart(wide a, vec part[GROUP])
{
    part[0] = _mm256_castpd256_pd128(a);
    part[1] = _mm256_extractf128_pd(a, 1);
}
#endif

/* Lanes for __builtin_shufflevector: f(i) for each lane i of a wide vector. */
#if DIM == 3 || GROUP == 2
#define EACH_LANE(f) f(0), f(1), f(2), f(3)
#elif DIM == 2
#define EACH_LANE(f) f(0), f(1)
#else
#define EACH_LANE(f) f(0)
#endif
enum { WIDTH = GROUP * LANES };
#define OF_PART_0(i)    ((i) / LANES * LANES)
#define OF_PART_1(i)    ((i) / LANES * LANES + 1)
#define OF_PART_2(i)    ((i) / LANES * LANES + 2)
#define OF_PART_3(i)    ((i) / LANES * LANES + 3)
#define EVEN(i)         ((i) / 2 * 2)
#define ODD(i)          ((i) / 2 * 2 + 1)
#define EVEN_OF_TWO(i)  ((i) % 2 == 0 ? (i) : WIDTH + (i)-1)
#define ODD_OF_TWO(i)   ((i) % 2 == 0 ? (i) + 1 : WIDTH + (i))
#define OTHER_HALF(i)   ((i) / 4 * 4 + ((i) + 2) % 4)
#define OTHER_OF_TWO(i) ((i) / 2 * 2 + ((i) + 1) % 2)
#define WITH_0(i)       ((i) % LANES == 0 ? WIDTH + (i) : (i))
#define WITH_1(i)       ((i) % LANES == 1 ? WIDTH + (i) : (i))
#define WITH_2(i)       ((i) % LANES == 2 ? WIDTH + (i) : (i))

/* Component I, a constant, in every lane of its part. */
static inline wide spread(wide a, int I)
{
#if DIM == 3
    return I == 0   ? __builtin_shufflevector(a, a, EACH_LANE(OF_PART_0))
           : I == 1 ? __builtin_shufflevector(a, a, EACH_LANE(OF_PART_1))
           : I == 2 ? __builtin_shufflevector(a, a, EACH_LANE(OF_PART_2))
                    : __builtin_shufflevector(a, a, EACH_LANE(OF_PART_3));
#elif DIM == 2
    return I == 0 ? __builtin_shufflevector(a, a, EACH_LANE(OF_PART_0))
                  : __builtin_shufflevector(a, a, EACH_LANE(OF_PART_1));
#else
    (void)I;
    return a;
#endif
}

/* Component I, a constant, of `part`, and the others of `whole`. */
static inline wide put_component(wide whole, wide part, int I)
{
#if DIM == 1
    (void)whole;
    (void)I;
    return part;
#else
    return I == 0   ? __builtin_shufflevector(whole, part, EACH_LANE(WITH_0))
           : I == 1 ? __builtin_shufflevector(whole, part, EACH_LANE(WITH_1))
                    : __builtin_shufflevector(whole, part, EACH_LANE(WITH_2));
#endif
}

/* The unit vector along axis I, a constant. */
static inline wide unit_along(int I)
{
    real each[GROUP];
    for (int g = 0; g < GROUP; g++) {
        each[g] = 1;
    }
    return put_component((wide){0}, join_each(each), I);
}

/* a . b of each particle, in every lane of its part. */
static inline wide spread_dot(wide a, wide b)
{
    wide dot = a * b;
#if DIM > 1
    dot += __builtin_shufflevector(dot, dot, EACH_LANE(OTHER_OF_TWO));
#endif
#if DIM == 3
    dot += __builtin_shufflevector(dot, dot, EACH_LANE(OTHER_HALF));
#endif
    return dot;
}

/* a . b and c . d of each particle, in every lane of its part: half the shuffles of two dots. Lanes beyond DIM are
 * zero. */
static inline void spread_dots(wide a, wide b, wide c, wide d, wide *ab, wide *cd)
{
    wide first = a * b;
    wide second = c * d;
#if DIM == 1
    *ab = first;
    *cd = second;
#else
    wide both = __builtin_shufflevector(first, second, EACH_LANE(EVEN_OF_TWO)) +
                __builtin_shufflevector(first, second, EACH_LANE(ODD_OF_TWO));
#if DIM == 3
    both += __builtin_shufflevector(both, both, EACH_LANE(OTHER_HALF));
#endif
    *ab = __builtin_shufflevector(both, both, EACH_LANE(EVEN));
    *cd = __builtin_shufflevector(both, both, EACH_LANE(ODD));
#endif
}

/* Vectors of a field, `stride` apart; numbers in every lane of their part, of an array and of a scalar field. */
static inline __attribute__((always_inline)) wide gather(const real *field, size_t stride, const size_t at[GROUP])
{
    vec part[GROUP];
    for (int g = 0; g < GROUP; g++) {
        part[g] = load(field + at[g] * stride);
    }
    return join(part);
}

static inline __attribute__((always_inline)) wide gather_each(const double *field, size_t stride,
                                                              const size_t at[GROUP])
{
    real each[GROUP];
    for (int g = 0; g < GROUP; g++) {
        each[g] = (real)field[at[g] * stride];
    }
    return join_each(each);
}

static inline __attribute__((always_inline)) wide gather_scalars(const real *field, const size_t at[GROUP])
{
    real each[GROUP];
    for (int g = 0; g < GROUP; g++) {
        each[g] = field[at[g]];
    }
    return join_each(each);
}

static inline __attribute__((always_inline)) void scatter(real *field, size_t stride, const size_t at[GROUP], wide a)
{
    vec part[GROUP];
    take_apart(a, part);
    for (int g = 0; g < GROUP; g++) {
        store(field + at[g] * stride, part[g]);
    }
}

#endif
