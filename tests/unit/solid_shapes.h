/* Bodies for tests of clouds of any shape, by their distances. */
#ifndef TESTS_SOLID_SHAPES_H
#define TESTS_SOLID_SHAPES_H

#include "solver/solid.h"

#include <CUnit/CUnit.h>
#include <math.h>
#include <stdio.h>

/* About its own middle. */
struct solid_shape {
    const char *name;
    int dim;
    double lower[3], upper[3]; /* m */
    double (*distance)(const double X[3]);
    double volume, area; /* exact */
};

static const double solid_middle[3] = {0.3, -1.1, 0.2}; /* m: no body is about the origin */

static inline double solid_disc(const double X[3])
{
    return sqrt(X[0] * X[0] + X[1] * X[1]) - 0.7;
}

static inline double solid_ball(const double X[3])
{
    return sqrt(X[0] * X[0] + X[1] * X[1] + X[2] * X[2]) - 0.7;
}

static inline double solid_ring(const double X[3])
{
    return sqrt(pow(sqrt(X[0] * X[0] + X[1] * X[1]) - 0.7, 2) + X[2] * X[2]) - 0.35;
}

static inline double solid_hole(const double X[3])
{
    return 0.3 - sqrt(X[0] * X[0] + X[1] * X[1]);
}

static inline double solid_whole(const double X[3])
{
    (void)X;
    return -1.0;
}

#define SOLID_PI 3.14159265358979323846
/* Edges are a whole number of spacings for a spacing of 0.7 / n, n a multiple of 4. */
static const struct solid_shape solid_shapes[] = {
    {"disc", 2, {-0.875, -0.875}, {0.875, 0.875}, solid_disc, 0.49 * SOLID_PI, 1.4 * SOLID_PI},
    {"quarter of a disc", 2, {0, 0}, {0.875, 0.875}, solid_disc, 0.1225 * SOLID_PI, 0.35 * SOLID_PI + 1.4},
    {"plate with a hole", 2, {-0.7, -0.7}, {0.7, 0.7}, solid_hole, 1.96 - 0.09 * SOLID_PI, 5.6 + 0.6 * SOLID_PI},
    {"ball", 3, {-0.875, -0.875, -0.875}, {0.875, 0.875, 0.875}, solid_ball, 0.343 * 4 / 3 * SOLID_PI, 1.96 * SOLID_PI},
    {"cylinder", 3, {-0.875, -0.875, -0.35}, {0.875, 0.875, 0.35}, solid_disc, 0.343 * SOLID_PI, 1.96 * SOLID_PI},
    {"ring",
     3,
     {-1.225, -1.225, -0.525},
     {1.225, 1.225, 0.525},
     solid_ring,
     2 * SOLID_PI *SOLID_PI * 0.08575,
     4 * SOLID_PI *SOLID_PI * 0.245},
    {"block", 3, {-0.35, -0.525, -0.7}, {0.35, 0.525, 0.7}, solid_whole, 0.7 * 1.05 * 1.4, 6.37},
};
enum { SOLID_SHAPES = sizeof solid_shapes / sizeof *solid_shapes };

static inline bool solid_distance(const void *context, const double X[3], double *distance, struct solver_error *error)
{
    const struct solid_shape *shape = context;
    double about[3];
    (void)error;
    for (int i = 0; i < 3; i++) {
        about[i] = i < shape->dim ? X[i] - solid_middle[i] : 0.0;
    }
    *distance = shape->distance(about);
    return true;
}

static inline struct solver_solid solid_of(const struct solid_shape *shape, int n)
{
    struct solver_solid solid = {.dim = shape->dim, .spacing = 0.7 / n, .distance = solid_distance, .context = shape};
    for (int i = 0; i < shape->dim; i++) {
        solid.lower[i] = shape->lower[i] + solid_middle[i];
        solid.upper[i] = shape->upper[i] + solid_middle[i];
    }
    return solid;
}

static inline struct solver_cloud *solid_cloud(const struct solid_shape *shape, int n)
{
    struct solver_solid solid = solid_of(shape, n);
    struct solver_cloud *cloud = NULL;
    struct solver_error error = {.code = SOLVER_OK};
    if (!solver_cloud_solid(&solid, &cloud, &error)) {
        (void)printf("%s: %s\n", shape->name, error.text);
        CU_FAIL_FATAL("no cloud");
    }
    return cloud;
}

#endif
