/* Vectors of a group of particles side by side in one register, for processors whose registers are wider than a
 * particle's vector. Each particle has a part of LANES lanes, and no operation takes a number from one part to another:
 * what a particle gets does not depend on which others are beside it, nor on how many. */
#ifndef SOLVER_DIM_GROUP_H
#define SOLVER_DIM_GROUP_H

#include "solver/dim.h"

#ifdef __AVX__
#include <immintrin.h>
#endif

#ifndef GROUP
#if DIM == 3 && defined __AVX512F__
#define GROUP 2
#elif DIM == 2 && defined __AVX512F__
#define GROUP 4
#elif DIM == 2 && defined __AVX__
#define GROUP 2
#else
#define GROUP 1
#endif
#endif

typedef double wide __attribute__((vector_size(GROUP * LANES * sizeof(double))));

#if GROUP == 1
static inline wide join(const vec part[GROUP])
{
    return part[0];
}

static inline wide join_each(const double each[GROUP])
{
    return splat(each[0]);
}

static inline void take_apart(wide a, vec part[GROUP])
{
    part[0] = a;
}
#elif DIM == 3
static inline wide join(const vec part[GROUP])
{
    return _mm512_insertf64x4(_mm512_castpd256_pd512(part[0]), part[1], 1);
}

static inline wide join_each(const double each[GROUP])
{
    return _mm512_mask_broadcastsd_pd(_mm512_set1_pd(each[0]), 0xf0, _mm_set_sd(each[1]));
}

static inline void take_apart(wide a, vec part[GROUP])
{
    part[0] = _mm512_castpd512_pd256(a);
    part[1] = _mm512_extractf64x4_pd(a, 1);
}
#elif GROUP == 2
static inline wide join(const vec part[GROUP])
{
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(part[0]), part[1], 1);
}

static inline wide join_each(const double each[GROUP])
{
    return _mm256_blend_pd(_mm256_set1_pd(each[0]), _mm256_set1_pd(each[1]), 0xc);
}

static inline void take_apart(wide a, vec part[GROUP])
{
    part[0] = _mm256_castpd256_pd128(a);
    part[1] = _mm256_extractf128_pd(a, 1);
}
#else
static inline wide join(const vec part[GROUP])
{
    __m256d low = _mm256_insertf128_pd(_mm256_castpd128_pd256(part[0]), part[1], 1);
    __m256d high = _mm256_insertf128_pd(_mm256_castpd128_pd256(part[2]), part[3], 1);
    return _mm512_insertf64x4(_mm512_castpd256_pd512(low), high, 1);
}

static inline wide join_each(const double each[GROUP])
{
    wide a = _mm512_set1_pd(each[0]);
    a = _mm512_mask_broadcastsd_pd(a, 0x0c, _mm_set_sd(each[1]));
    a = _mm512_mask_broadcastsd_pd(a, 0x30, _mm_set_sd(each[2]));
    return _mm512_mask_broadcastsd_pd(a, 0xc0, _mm_set_sd(each[3]));
}

static inline void take_apart(wide a, vec part[GROUP])
{
    part[0] = _mm512_castpd512_pd128(a);
    part[1] = _mm512_extractf64x2_pd(a, 1);
    part[2] = _mm512_extractf64x2_pd(a, 2);
    part[3] = _mm512_extractf64x2_pd(a, 3);
}
#endif

/* Lanes for __builtin_shufflevector: f(i) for each lane i of a wide vector. */
#if GROUP * (DIM == 3 ? 4 : DIM) == 8
#define EACH_LANE(f) f(0), f(1), f(2), f(3), f(4), f(5), f(6), f(7)
#elif GROUP * (DIM == 3 ? 4 : DIM) == 4
#define EACH_LANE(f) f(0), f(1), f(2), f(3)
#elif GROUP * (DIM == 3 ? 4 : DIM) == 2
#define EACH_LANE(f) f(0), f(1)
#else
#define EACH_LANE(f) f(0)
#endif
enum { WIDTH = GROUP * LANES };
#define OF_PART_0(i)   ((i) / LANES * LANES)
#define OF_PART_1(i)   ((i) / LANES * LANES + 1)
#define OF_PART_2(i)   ((i) / LANES * LANES + 2)
#define OF_PART_3(i)   ((i) / LANES * LANES + 3)
#define EVEN(i)        ((i) / 2 * 2)
#define ODD(i)         ((i) / 2 * 2 + 1)
#define EVEN_OF_TWO(i) ((i) % 2 == 0 ? (i) : WIDTH + (i)-1)
#define ODD_OF_TWO(i)  ((i) % 2 == 0 ? (i) + 1 : WIDTH + (i))
#define OTHER_HALF(i)  ((i) / 4 * 4 + ((i) + 2) % 4)

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

/* Vectors of a field, `stride` apart, and numbers in every lane of their part. */
static inline __attribute__((always_inline)) wide gather(const double *field, size_t stride, const size_t at[GROUP])
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
    double each[GROUP];
    for (int g = 0; g < GROUP; g++) {
        each[g] = field[at[g] * stride];
    }
    return join_each(each);
}

static inline __attribute__((always_inline)) void scatter(double *field, size_t stride, const size_t at[GROUP],
                                                          wide a)
{
    vec part[GROUP];
    take_apart(a, part);
    for (int g = 0; g < GROUP; g++) {
        store(field + at[g] * stride, part[g]);
    }
}

#endif
