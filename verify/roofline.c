#include "verify/roofline.h"

#include "solver/peak.h"

#include <math.h>
#include <omp.h>

enum { PASSES = 21, ROUNDS = 2000000 /* milliseconds */ };

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
