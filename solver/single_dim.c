#include "solver/single.h"

#include "solver/dim.h"

#include <stdbool.h>
#include <string.h>

/* A stage of LANES numbers. */
static inline __attribute__((always_inline)) void update_lanes(float *U, const float *start, const float *rate,
                                                               float *sum, const struct solver_stage *stage, double dt,
                                                               bool begins)
{
    vec from = load_floats(start);
    vec R = load_floats(rate);
    vec change = stage->rate * R;
    vec kept = from;
    if (!begins) {
        kept += stage->keep * (load_floats(U) - from);
    }
    if (sum != NULL) {
        vec S = stage->accumulate * R;
        if (!begins) {
            vec before = load_floats(sum);
            change += stage->sum * before;
            S += before;
        }
        store_floats(sum, S);
    }
    store_floats(U, kept + dt * change);
}

static inline __attribute__((always_inline)) void update_all(float *U, const float *start, const float *rate,
                                                             float *sum, size_t count, const struct solver_stage *stage,
                                                             double dt, bool begins)
{
    size_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        update_lanes(U + i, start + i, rate + i, sum != NULL ? sum + i : NULL, stage, dt, begins);
    }
    if (i < count) { /* fewer than LANES are left */
        float rest[4][LANES] = {{0}};
        size_t size = (count - i) * sizeof(float);
        memcpy(rest[0], U + i, size);
        memcpy(rest[1], start + i, size);
        memcpy(rest[2], rate + i, size);
        if (sum != NULL) {
            memcpy(rest[3], sum + i, size);
        }
        update_lanes(rest[0], rest[1], rest[2], sum != NULL ? rest[3] : NULL, stage, dt, begins);
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

const struct solver_single_loops DIM_NAME(solver_single) = {
    .update = update,
    .widen = widen,
    .narrow = narrow,
    .widen_measures = widen_measures,
    .narrow_measures = narrow_measures,
};
