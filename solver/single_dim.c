#include "solver/single.h"

#define WIDE_LOTS
#include "solver/dim_lots.h"

#include <stdbool.h>
#include <string.h>

/* LOT numbers of single precision, anywhere. */
typedef float lot_floats __attribute__((vector_size(LOT * sizeof(float)), aligned(sizeof(float))));

/* GCC 12 makes __builtin_convertvector of several conversions of two. */
static inline lot load_lot_floats(const float *from)
{
#if defined LOT_OF_EIGHT
    return _mm512_cvtps_pd((__m256) * (const lot_floats *)from);
#elif defined __AVX__
    return _mm256_cvtps_pd((__m128) * (const lot_floats *)from);
#else
    return __builtin_convertvector(*(const lot_floats *)from, lot);
#endif
}

static inline void store_lot_floats(float *to, lot value)
{
#if defined LOT_OF_EIGHT
    *(lot_floats *)to = (lot_floats)_mm512_cvtpd_ps(value);
#elif defined __AVX__
    *(lot_floats *)to = (lot_floats)_mm256_cvtpd_ps(value);
#else
    *(lot_floats *)to = __builtin_convertvector(value, lot_floats);
#endif
}

/* A stage of LOT numbers. */
static inline __attribute__((always_inline)) void update_lot(float *U, const float *start, const float *rate,
                                                             float *sum, const struct solver_stage *stage, double dt,
                                                             bool begins)
{
    lot from = load_lot_floats(start);
    lot R = load_lot_floats(rate);
    lot change = stage->rate * R;
    lot kept = from;
    if (!begins) {
        kept += stage->keep * (load_lot_floats(U) - from);
    }
    if (sum != NULL) {
        lot S = stage->accumulate * R;
        if (!begins) {
            lot before = load_lot_floats(sum);
            change += stage->sum * before;
            S += before;
        }
        store_lot_floats(sum, S);
    }
    store_lot_floats(U, kept + dt * change);
}

static inline __attribute__((always_inline)) void update_all(float *U, const float *start, const float *rate,
                                                             float *sum, size_t count, const struct solver_stage *of,
                                                             double dt, bool begins)
{
    const struct solver_stage stage = *of; /* which no number that is stored may be */
    size_t i = 0;
    for (; i + LOT <= count; i += LOT) {
        update_lot(U + i, start + i, rate + i, sum != NULL ? sum + i : NULL, &stage, dt, begins);
    }
    if (i < count) { /* fewer than LOT are left */
        float rest[4][LOT] = {{0}};
        size_t size = (count - i) * sizeof(float);
        memcpy(rest[0], U + i, size);
        memcpy(rest[1], start + i, size);
        memcpy(rest[2], rate + i, size);
        if (sum != NULL) {
            memcpy(rest[3], sum + i, size);
        }
        update_lot(rest[0], rest[1], rest[2], sum != NULL ? rest[3] : NULL, &stage, dt, begins);
        memcpy(U + i, rest[0], size);
        if (sum != NULL) {
            memcpy(sum + i, rest[3], size);
        }
    }
}

static void update(float *U, const float *start, const float *rate, float *sum, size_t count,
                   const struct solver_stage *stage, double dt)
{
    bool begins = stage->time == 0.0;
    if (begins && sum == NULL) {
        update_all(U, start, rate, NULL, count, stage, dt, true);
    } else if (begins) {
        update_all(U, start, rate, sum, count, stage, dt, true);
    } else if (sum == NULL) {
        update_all(U, start, rate, NULL, count, stage, dt, false);
    } else {
        update_all(U, start, rate, sum, count, stage, dt, false);
    }
}

static void widen(const float *restrict from, double *restrict to, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        to[i] = (double)from[i];
    }
}

static void narrow(const double *restrict from, float *restrict to, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        to[i] = (float)from[i];
    }
}

#if DIM == 3
static void widen_measures(const float *from, double *to, size_t count)
{
    struct tensor one = identity();
    for (size_t a = 0; a < count; a++) {
        for (size_t I = 0; I < DIM; I++) {
            size_t at = (a * DIM + I) * LANES;
            store(to + at, load_floats(from + at) + one.column[I]);
        }
    }
}

static void narrow_measures(const double *from, float *to, size_t count)
{
    struct tensor one = identity();
    for (size_t a = 0; a < count; a++) {
        for (size_t I = 0; I < DIM; I++) {
            size_t at = (a * DIM + I) * LANES;
            store_floats(to + at, load(from + at) - one.column[I]);
        }
    }
}
#else
enum { TENSOR = DIM * LANES };
_Static_assert(LOT % TENSOR == 0, "whole tensors fill a lot");

/* Of the identity, entry i of tensors that follow each other. */
static inline double one_at(size_t i)
{
    return i % TENSOR % (LANES + 1) == 0 ? 1.0 : 0.0;
}

static inline lot identities(void)
{
    lot one = {0};
    for (size_t k = 0; k < LOT; k++) {
        one[k] = one_at(k);
    }
    return one;
}

static void widen_measures(const float *from, double *to, size_t count)
{
    lot one = identities();
    size_t i = 0;
    for (; i + LOT <= count * TENSOR; i += LOT) {
        store_lot(to + i, load_lot_floats(from + i) + one);
    }
    for (; i < count * TENSOR; i++) {
        to[i] = (double)from[i] + one_at(i);
    }
}

static void narrow_measures(const double *from, float *to, size_t count)
{
    lot one = identities();
    size_t i = 0;
    for (; i + LOT <= count * TENSOR; i += LOT) {
        store_lot_floats(to + i, load_lot(from + i) - one);
    }
    for (; i < count * TENSOR; i++) {
        to[i] = (float)(from[i] - one_at(i));
    }
}
#endif

const struct solver_single_loops DIM_NAME(solver_single) = {
    .update = update,
    .widen = widen,
    .narrow = narrow,
    .widen_measures = widen_measures,
    .narrow_measures = narrow_measures,
};
