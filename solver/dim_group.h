/* Vectors of a group of particles side by side in one register, for processors whose registers are wider than a
 * particle's vector. Each particle has a part of LANES lanes, and no operation takes a number from one part to another:
 * what a particle gets does not depend on which others are beside it, nor on how many. */
#ifndef SOLVER_DIM_GROUP_H
#define SOLVER_DIM_GROUP_H

#include "solver/dim.h"

#include <string.h>

/* Where particles of a group are anywhere, in space 512 bits for two of them were no faster than 256 for one: what is
 * saved of arithmetic, putting the vectors of two neighbours together takes. Particles that are abreast (stencil.h)
 * have consecutive numbers, and so have their neighbours: a load brings a whole register, and one number stands for the
 * places of all. HALF_REGISTERS are no wider than 256 bits. */
#define LANES_OF_VEC (DIM == 3 ? 4 : DIM)
#if defined __AVX512F__ && !defined HALF_REGISTERS
#define REGISTER_BYTES 64
#elif defined __AVX__
#define REGISTER_BYTES 32
#else
#define REGISTER_BYTES 16
#endif
#ifdef SINGLE
#define VEC_BYTES (4 * LANES_OF_VEC)
#else
#define VEC_BYTES (8 * LANES_OF_VEC)
#endif
#ifdef ABREAST
#define GROUP (REGISTER_BYTES < VEC_BYTES ? 1 : REGISTER_BYTES / VEC_BYTES)
#elif !defined GROUP
#if DIM == 2 && defined __AVX__ && !defined SINGLE
#define GROUP 2
#else
#define GROUP 1
#endif
#endif
#ifdef ABREAST
enum { PLACES = 1 };
#else
enum { PLACES = GROUP };
#endif

typedef real wide __attribute__((vector_size(GROUP * LANES * sizeof(real))));
/* One number of each particle. */
typedef real many __attribute__((vector_size(GROUP * sizeof(real))));

/* Lanes for __builtin_shufflevector: f(i) for each lane i of a wide vector, or for each particle. */
#define LIST_1(f)  f(0)
#define LIST_2(f)  f(0), f(1)
#define LIST_4(f)  LIST_2(f), f(2), f(3)
#define LIST_8(f)  LIST_4(f), f(4), f(5), f(6), f(7)
#define LIST_16(f) LIST_8(f), f(8), f(9), f(10), f(11), f(12), f(13), f(14), f(15)
#if GROUP == 1
#define EACH_PART    LIST_1
#define EACH_OF_TWOS LIST_2
#elif GROUP == 2
#define EACH_PART    LIST_2
#define EACH_OF_TWOS LIST_4
#elif GROUP == 4
#define EACH_PART    LIST_4
#define EACH_OF_TWOS LIST_8
#elif GROUP == 8
#define EACH_PART    LIST_8
#define EACH_OF_TWOS LIST_16
#else
#define EACH_PART LIST_16
#endif
#if GROUP * LANES_OF_VEC == 1
#define EACH_LANE LIST_1
#elif GROUP * LANES_OF_VEC == 2
#define EACH_LANE LIST_2
#elif GROUP * LANES_OF_VEC == 4
#define EACH_LANE LIST_4
#elif GROUP * LANES_OF_VEC == 8
#define EACH_LANE LIST_8
#else
#define EACH_LANE LIST_16
#endif
enum { WIDTH = GROUP * LANES };
#define OF_PART_0(i)       ((i) / LANES * LANES)
#define OF_PART_1(i)       ((i) / LANES * LANES + 1)
#define OF_PART_2(i)       ((i) / LANES * LANES + (LANES > 2 ? 2 : 0))
#define OF_PART_3(i)       ((i) / LANES * LANES + 3)
#define EVEN(i)            ((i) / 2 * 2)
#define ODD(i)             ((i) / 2 * 2 + 1)
#define EVEN_OF_TWO(i)     ((i) % 2 == 0 ? (i) : WIDTH + (i)-1)
#define ODD_OF_TWO(i)      ((i) % 2 == 0 ? (i) + 1 : WIDTH + (i))
#define OTHER_HALF(i)      ((i) / 4 * 4 + ((i) + 2) % 4)
#define OTHER_OF_TWO(i)    ((i) / 2 * 2 + ((i) + 1) % 2)
#define WITH_0(i)          ((i) % LANES == 0 ? WIDTH + (i) : (i))
#define WITH_1(i)          ((i) % LANES == 1 ? WIDTH + (i) : (i))
#define WITH_2(i)          ((i) % LANES == 2 ? WIDTH + (i) : (i))
#define IN_TURN(i)         ((i) % 2 == 0 ? (i) : WIDTH + (i))
#define IN_TURN_0(i)       ((i) % 2 == 0 ? OF_PART_0(i) : WIDTH + OF_PART_0(i))
#define IN_TURN_1(i)       ((i) % 2 == 0 ? OF_PART_1(i) : WIDTH + OF_PART_1(i))
#define IN_TURN_2(i)       ((i) % 2 == 0 ? OF_PART_2(i) : WIDTH + OF_PART_2(i))
#define FROM_TWOS(i)       ((i) / 2 + (i) % 2 * GROUP)
#define TWICE(i)           ((i) / 4 * 2 + (i) % 2)
#define COLUMN_0(i)        ((i) / 2 * 4 + (i) % 2)
#define COLUMN_1(i)        ((i) / 2 * 4 + 2 + (i) % 2)
#define LOW_OF_COLUMNS(i)  ((i) / 2 % 2 * WIDTH + (i) / 4 * 2 + (i) % 2)
#define HIGH_OF_COLUMNS(i) LOW_OF_COLUMNS((i) + WIDTH)
#define ITSELF(i)          (i)
#define FIRST_LANE(g)      ((g)*LANES)
#define SECOND_LANE(g)     ((g)*LANES + 1)
#define THIRD_LANE(g)      ((g)*LANES + (LANES > 2 ? 2 : 0))

#if GROUP == 1
static inline wide join(const vec part[GROUP])
{
    return part[0];
}

static inline void take_apart(wide a, vec part[GROUP])
{
    part[0] = a;
}
#elif GROUP == 2 && DIM == 2 && !defined SINGLE
static inline wide join(const vec part[GROUP])
{
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(part[0]), part[1], 1);
}

static inline void take_apart(wide a, vec part[GROUP])
{
    part[0] = _mm256_castpd256_pd128(a);
    part[1] = _mm256_extractf128_pd(a, 1);
}
#elif DIM == 3 && GROUP == 2
static inline wide join(const vec part[GROUP])
{
    return __builtin_shufflevector(part[0], part[1], LIST_8(ITSELF));
}

static inline void take_apart(wide a, vec part[GROUP])
{
    part[0] = __builtin_shufflevector(a, a, 0, 1, 2, 3);
    part[1] = __builtin_shufflevector(a, a, 4, 5, 6, 7);
}
#elif DIM == 3
static inline wide join(const vec part[GROUP])
{
    typedef real half __attribute__((vector_size(sizeof(wide) / 2)));
    half low = __builtin_shufflevector(part[0], part[1], LIST_8(ITSELF));
    half high = __builtin_shufflevector(part[2], part[3], LIST_8(ITSELF));
    return __builtin_shufflevector(low, high, LIST_16(ITSELF));
}

static inline void take_apart(wide a, vec part[GROUP])
{
    part[0] = __builtin_shufflevector(a, a, 0, 1, 2, 3);
    part[1] = __builtin_shufflevector(a, a, 4, 5, 6, 7);
    part[2] = __builtin_shufflevector(a, a, 8, 9, 10, 11);
    part[3] = __builtin_shufflevector(a, a, 12, 13, 14, 15);
}
#else
static inline wide join(const vec part[GROUP])
{
    wide joined;
    memcpy(&joined, part, sizeof joined);
    return joined;
}

static inline void take_apart(wide a, vec part[GROUP])
{
    memcpy(part, &a, sizeof a);
}
#endif

/* The same number in every lane, and for each particle. */
#define THE_NUMBER(i) number
static inline wide wide_of(real number)
{
    return (wide){EACH_LANE(THE_NUMBER)};
}

/* Numbers of the places of a group, in every lane of their parts, and for each particle. */
#if defined ABREAST || GROUP == 1
static inline wide join_each(const real each[PLACES])
{
    return wide_of(each[0]);
}

static inline many many_of(const real each[PLACES])
{
    real number = each[0];
    return (many){EACH_PART(THE_NUMBER)};
}
#else
static inline wide join_each(const real each[PLACES])
{
    return _mm256_blend_pd(_mm256_set1_pd(each[0]), _mm256_set1_pd(each[1]), 0xc);
}

static inline many many_of(const real each[PLACES])
{
    return (many){each[0], each[1]};
}
#endif

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

/* The vector of that length along axis I, a constant. */
static inline wide along_axis(real length, int I)
{
    return put_component((wide){0}, wide_of(length), I);
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

/* Component I, a constant, of each particle. */
static inline many component_of(wide a, int I)
{
#if DIM == 1
    (void)I;
    return (many)a;
#else
    return I == 0   ? __builtin_shufflevector(a, a, EACH_PART(FIRST_LANE))
           : I == 1 ? __builtin_shufflevector(a, a, EACH_PART(SECOND_LANE))
                    : __builtin_shufflevector(a, a, EACH_PART(THIRD_LANE));
#endif
}

/* All bits of a lane are set, or none: what a comparison gives. */
typedef __typeof__((wide){0} > (wide){0}) wide_mask;

/* `a` where the mask is set, else 0. */
static inline wide only_where(wide_mask where, wide a)
{
    return (wide)(where & (wide_mask)a);
}

static inline wide larger_of(wide a, wide b)
{
    wide_mask first = a > b;
    return (wide)((first & (wide_mask)a) | (~first & (wide_mask)b));
}

#endif
