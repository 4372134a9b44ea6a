/* Boxes for tests of clouds and of what is built on them: edges of different lengths away from the origin, with a
 * spacing that is no power of two. */
#ifndef TESTS_CLOUDS_H
#define TESTS_CLOUDS_H

#include "solver/cloud.h"

#include <CUnit/CUnit.h>
#include <stdio.h>

/* `edge`, edge + 1 and edge + 2 spacings along the axes: no two alike. */
static inline struct solver_box clouds_box(int dim, int edge, double perturb, uint64_t seed)
{
    static const double lower[3] = {-0.3, 0.2, 1.1};
    struct solver_box box = {.dim = dim, .spacing = 0.05, .perturb = perturb, .seed = seed};
    for (int axis = 0; axis < dim; axis++) {
        box.lower[axis] = lower[axis];
        box.upper[axis] = lower[axis] + box.spacing * (edge + axis);
    }
    return box;
}

/* NULL, and a failed assertion with the message, where the cloud cannot be made. */
static inline struct solver_cloud *clouds_make(const struct solver_box *box)
{
    struct solver_cloud *cloud = NULL;
    struct solver_error error = {.code = SOLVER_OK};
    if (!solver_cloud_box(box, &cloud, &error)) {
        (void)printf("no cloud: %s\n", error.text);
        CU_FAIL("solver_cloud_box failed");
    }
    return cloud;
}

/* Uniform in [-1, 1), the same on every machine (SplitMix64). */
static inline double clouds_random(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return 2.0 * (double)((z ^ (z >> 31)) >> 11) * 0x1p-53 - 1.0;
}

#endif
