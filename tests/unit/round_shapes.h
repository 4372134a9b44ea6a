/* Round bodies for tests: three shapes away from the origin. */
#ifndef TESTS_ROUND_SHAPES_H
#define TESTS_ROUND_SHAPES_H

#include "solver/cloud.h"

#include <CUnit/CUnit.h>
#include <stdio.h>

static const double round_radius = 0.7, round_length = 0.525; /* m */

/* Lengths are a whole number of spacings for n a multiple of 4. */
static const struct solver_shape shapes[] = {
    {.kind = SOLVER_SHAPE_DISC, .centre = {0.3, -1.1}, .outer = 0.7},
    {.kind = SOLVER_SHAPE_BALL, .centre = {0.3, -1.1, 0.2}, .outer = 0.7},
    {.kind = SOLVER_SHAPE_CYLINDER, .centre = {0.3, -1.1, 0.2}, .outer = 0.7, .length = 0.525},
};
enum { SHAPES = sizeof shapes / sizeof *shapes };

static inline struct solver_cloud *round_cloud(const struct solver_shape *shape, int n)
{
    struct solver_cloud *cloud = NULL;
    struct solver_error error = {.code = SOLVER_OK};
    if (!solver_cloud_round(shape, round_radius / n, &cloud, &error)) {
        (void)printf("%s\n", error.text);
        CU_FAIL_FATAL("no cloud");
    }
    return cloud;
}

#endif
