#include "verify/timing.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <time.h>

static const double shortest_sample = 0.02; /* [s] */

double verify_clock(int threads)
{
    struct timespec at;
    (void)clock_gettime(threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &at);
    return (double)at.tv_sec + 1e-9 * (double)at.tv_nsec;
}

double verify_bandwidth(double bytes, int threads)
{
    size_t count = (size_t)(bytes / (3.0 * sizeof(double))) + 1;
    double *y = malloc(count * sizeof *y);
    double *a = malloc(count * sizeof *a);
    double *b = malloc(count * sizeof *b);
    double best = INFINITY;
    if (y != NULL && a != NULL && b != NULL) {
        double check = 0.0;
        /* small arrays several times over in a sample, that the clock and the start of threads do not count */
        size_t times = 1 + (size_t)(4e6 / bytes);
#pragma omp parallel for schedule(static) num_threads(threads)
        for (size_t i = 0; i < count; i++) {
            y[i] = 0.0;
            a[i] = (double)i;
            b[i] = 1.0;
        }
        for (int pass = 0; pass < 3 * VERIFY_SAMPLES; pass++) {
            double begun = verify_clock(threads);
#pragma omp parallel num_threads(threads)
            for (size_t time = 0; time < times; time++) {
                double factor = 0.5 * (double)(pass + (int)time);
#pragma omp for schedule(static) nowait
                for (size_t i = 0; i < count; i++) {
                    y[i] = a[i] + factor * b[i];
                }
            }
            best = fmin(best, (verify_clock(threads) - begun) / (double)times);
            check += y[(size_t)pass % count]; /* the sums are wanted: no pass may be left out */
        }
        best = check >= 0.0 ? best : INFINITY;
    }
    double entries = (double)count;
    free(y);
    free(a);
    free(b);
    return isfinite(best) ? 3.0 * sizeof(double) * entries / best : 0.0;
}

/* Seconds that so many steps take. */
static bool sample(struct solver_run *run, size_t steps, double *seconds, struct solver_error *error)
{
    int threads = solver_run_facts(run).threads;
    double before = verify_clock(threads);
    bool done = solver_run_steps(run, steps, error);
    *seconds = verify_clock(threads) - before;
    return done;
}

/* Steps that are long enough for the clock. */
static bool enough(struct solver_run *run, size_t *steps, struct solver_error *error)
{
    double seconds = 0;
    for (*steps = 1; sample(run, *steps, &seconds, error); *steps *= 2) {
        if (seconds >= shortest_sample) {
            return true;
        }
    }
    return false;
}

bool verify_time_turns(struct solver_run *const *run, size_t count, double *seconds, struct solver_error *error)
{
    for (size_t i = 0; i < count; i++) {
        seconds[i] = INFINITY;
    }
    size_t steps[VERIFY_TURNS] = {0};
    bool dropped[VERIFY_TURNS] = {false};
    for (size_t i = 0; i < count && !dropped[0]; i++) {
        dropped[i] = run[i] == NULL || !enough(run[i], &steps[i], error);
    }
    for (size_t turn = 0; turn < VERIFY_SAMPLES * count && !dropped[0]; turn++) {
        size_t i = turn % count;
        double taken = 0;
        dropped[i] = dropped[i] || !sample(run[i], steps[i], &taken, error);
        seconds[i] = !dropped[i] ? fmin(seconds[i], taken / (double)steps[i]) : NAN;
    }
    return !dropped[0];
}

bool verify_time_steps(struct solver_run *run, double *seconds, struct solver_error *error)
{
    return verify_time_turns(&run, 1, seconds, error);
}
