#include "verify/roofline.h"

#include "solver/peak.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>

enum { PASSES = 21, ROUNDS = 2000000 /* milliseconds */ };

double verify_roof_bandwidth(double bytes, int threads)
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
        for (int pass = 0; pass < PASSES; pass++) {
            double begun = omp_get_wtime();
#pragma omp parallel num_threads(threads)
            for (size_t time = 0; time < times; time++) {
                double factor = 0.5 * (double)(pass + (int)time);
#pragma omp for schedule(static) nowait
                for (size_t i = 0; i < count; i++) {
                    y[i] = a[i] + factor * b[i];
                }
            }
            best = fmin(best, (omp_get_wtime() - begun) / (double)times);
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

double verify_roof_flops(int threads)
{
    const struct solver_peak_loops *loops = solver_peak();
    double best = 0.0;
    for (int pass = 0; pass < PASSES; pass++) {
        double flops = 0.0;
        double begun = omp_get_wtime();
#pragma omp parallel num_threads(threads) reduction(+ : flops)
        {
            double sum;
            flops += loops->multiply_add(ROUNDS, &sum);
            flops += sum > 0.0 ? 0.0 : 1.0; /* the sums are wanted */
        }
        best = fmax(best, flops / (omp_get_wtime() - begun));
    }
    return best;
}

double verify_roof_share(double flops, double bytes, double seconds, double peak, double bandwidth)
{
    return fmax(flops / peak, bytes / bandwidth) / seconds;
}
