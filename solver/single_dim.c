#include "solver/single.h"

#define SINGLE
#include "solver/dim.h"

static void update(float *restrict U, const float *restrict start, const float *restrict rate, float *restrict sum,
                   size_t count, const struct solver_stage *stage, double dt)
{
    if (stage->time == 0.0 && sum == NULL) {
        for (size_t i = 0; i < count; i++) {
            U[i] = (float)((double)start[i] + dt * stage->rate * (double)rate[i]);
        }
    } else if (stage->time == 0.0) {
        for (size_t i = 0; i < count; i++) {
            U[i] = (float)((double)start[i] + dt * stage->rate * (double)rate[i]);
            sum[i] = (float)(stage->accumulate * (double)rate[i]);
        }
    } else if (sum == NULL) {
        for (size_t i = 0; i < count; i++) {
            double from = (double)start[i];
            U[i] = (float)(from + stage->keep * ((double)U[i] - from) + dt * stage->rate * (double)rate[i]);
        }
    } else {
        for (size_t i = 0; i < count; i++) {
            double from = (double)start[i];
            double R = (double)rate[i];
            double S = (double)sum[i];
            U[i] = (float)(from + stage->keep * ((double)U[i] - from) + dt * (stage->rate * R + stage->sum * S));
            sum[i] = (float)(S + stage->accumulate * R);
        }
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
    for (size_t a = 0; a < count; a++) {
        struct tensor T = load_measure(from + a * DIM * LANES);
        for (size_t I = 0; I < DIM; I++) {
            *(vec *)(to + (a * DIM + I) * LANES) = T.column[I];
        }
    }
}

static void narrow_measures(const double *from, float *to, size_t count)
{
    struct tensor one = identity();
    for (size_t a = 0; a < count; a++) {
        struct tensor T;
        for (size_t I = 0; I < DIM; I++) {
            T.column[I] = *(const vec *)(from + (a * DIM + I) * LANES) - one.column[I];
        }
        store_tensor(to + a * DIM * LANES, T);
    }
}

const struct solver_single_loops DIM_NAME(solver_single) = {
    .update = update,
    .widen = widen,
    .narrow = narrow,
    .widen_measures = widen_measures,
    .narrow_measures = narrow_measures,
};
