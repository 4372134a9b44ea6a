#include "solver/hardening.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

static double power(const struct solver_hardening *hardening, double plastic)
{
    return hardening->yield * pow(1.0 + plastic / hardening->strain, hardening->exponent);
}

double solver_hardening_stress(const struct solver_hardening *hardening, double plastic, double *slope)
{
    double stress = hardening->yield + hardening->modulus * plastic;
    double by_plastic = hardening->modulus;
    if (hardening->law == SOLVER_HARDENING_SATURATION) {
        double rise = hardening->saturation - hardening->yield;
        stress -= rise * expm1(-hardening->rate * plastic);
        by_plastic += rise * hardening->rate * exp(-hardening->rate * plastic);
    } else if (hardening->law == SOLVER_HARDENING_POWER) {
        stress = power(hardening, plastic);
        by_plastic = stress * hardening->exponent / (hardening->strain + plastic);
    }
    if (slope != NULL) {
        *slope = by_plastic;
    }
    return stress;
}

double solver_hardening_work(const struct solver_hardening *hardening, double plastic)
{
    double work = (hardening->yield + 0.5 * hardening->modulus * plastic) * plastic;
    if (hardening->law == SOLVER_HARDENING_SATURATION) {
        double rise = hardening->saturation - hardening->yield;
        work += rise * (plastic + expm1(-hardening->rate * plastic) / hardening->rate);
    } else if (hardening->law == SOLVER_HARDENING_POWER) {
        double higher = hardening->exponent + 1.0;
        work = hardening->yield * hardening->strain / higher * expm1(higher * log1p(plastic / hardening->strain));
    }
    return work;
}

/* The yield stress is concave in the plastic strain, and rises at least with H: the first bracket holds the root. */
static double newton(const struct solver_hardening *hardening, double mu, double q, double plastic, double excess)
{
    double rises = hardening->law == SOLVER_HARDENING_SATURATION ? hardening->modulus : 0.0;
    double low = 0.0;
    double high = excess / (3.0 * mu + rises);
    double flow = high;
    for (int i = 0; i < 200; i++) { /* bisection alone needs no more */
        double slope;
        double residual = q - 3.0 * mu * flow - solver_hardening_stress(hardening, plastic + flow, &slope);
        low = residual > 0.0 ? flow : low;
        high = residual > 0.0 ? high : flow;
        double next = flow + residual / (3.0 * mu + slope);
        if (!(next > low && next < high)) {
            next = 0.5 * (low + high);
        }
        if (residual == 0.0 || fabs(next - flow) <= DBL_EPSILON * flow) {
            return residual == 0.0 ? flow : next;
        }
        flow = next;
    }
    return flow;
}

double solver_hardening_flow(const struct solver_hardening *hardening, double mu, double q, double plastic)
{
    double excess = q - solver_hardening_stress(hardening, plastic, NULL);
    if (!isfinite(excess) || excess <= 0.0) {
        return 0.0;
    }
    return hardening->law == SOLVER_HARDENING_LINEAR ? excess / (3.0 * mu + hardening->modulus)
                                                     : newton(hardening, mu, q, plastic, excess);
}
