/* Explicit Runge-Kutta methods in two-register form. Stage s, with R the rate at U and time t + time * dt:
 *     S += accumulate R
 *     U <- U0 + keep (U - U0) + dt (rate R + sum S)
 * The first stage is at time 0 with keep = 0, sum = 0, and no later one is at time 0. What has no rate stays as it is,
 * to the bit. */
#ifndef SOLVER_INTEGRATOR_H
#define SOLVER_INTEGRATOR_H

#include <stdbool.h>

enum { SOLVER_STAGES = 4 };

struct solver_stage {
    double time; /* of the stage, as a fraction of the step */
    double keep, rate;
    double accumulate, sum;
    double weight; /* of the stage in the quadrature over the step */
};

struct solver_integrator {
    const char *name, *summary;
    int order, stages;
    bool needs_sum; /* whether any stage uses S */
    struct solver_stage stage[SOLVER_STAGES];
};

/* The table, ends with a NULL name. */
const struct solver_integrator *solver_integrators(void);
const struct solver_integrator *solver_integrator_find(const char *name);

#endif
