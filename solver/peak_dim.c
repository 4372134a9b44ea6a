#include "solver/peak.h"

#include "solver/dim.h"

#if defined __AVX512F__
enum { WIDEST = 8 };
#elif defined __AVX__
enum { WIDEST = 4 };
#else
enum { WIDEST = 2 };
#endif

#if defined __FMA__ || defined __aarch64__
enum { FUSED = 1 };
#else
enum { FUSED = 0 };
#endif

typedef double widest __attribute__((vector_size(WIDEST * sizeof(double))));

/* More of them than the latency of one, times those that start in a cycle; all fit the registers. */
enum { CHAINS = 12 };

static double multiply_add(size_t rounds, double *sum)
{
    widest chain[CHAINS];
    for (int i = 0; i < CHAINS; i++) {
        chain[i] = (widest){0} + (1.0 + i);
    }
    widest factor = (widest){0} + 0.999999;
    widest term = (widest){0} + 1e-6;
    for (size_t round = 0; round < rounds; round++) {
#pragma GCC unroll 12
        for (int i = 0; i < CHAINS; i++) {
            chain[i] = chain[i] * factor + term;
        }
    }
    *sum = 0.0;
    for (int i = 0; i < CHAINS; i++) {
        for (int lane = 0; lane < WIDEST; lane++) {
            *sum += chain[i][lane];
        }
    }
    return 2.0 * WIDEST * CHAINS * (double)rounds;
}

const struct solver_peak_loops DIM_NAME(solver_peak) = {.lanes = WIDEST, .fused = FUSED, .multiply_add = multiply_add};
