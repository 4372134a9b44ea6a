/* Equations of closed stencils (closure.h) of small clouds, for tests. */
#ifndef TESTS_UNIT_CLOSURES_H
#define TESTS_UNIT_CLOSURES_H

#include "solver/closure.h"
#include "solver/kernel.h"
#include "tests/unit/clouds.h"
#include "tests/unit/unit.h"

#include <math.h>

struct system {
    struct solver_cloud *cloud;
    struct solver_graph graph;
    struct solver_closure closure;
    size_t width;  /* numbers of a vector per particle */
    double radius; /* of the support [m] */
};

/* With weights, neither spline spaces nor a factor yet. */
static inline void open_system(struct system *of, int dim, int edge, double perturb, double support, uint64_t seed)
{
    struct solver_box box = clouds_box(dim, edge, perturb, seed);
    double radius = support * box.spacing * (1.0 - solver_kernel_margin);
    struct solver_error error;
    *of = (struct system){.cloud = clouds_make(&box), .radius = radius};
    CU_ASSERT_PTR_NOT_NULL_FATAL(of->cloud);
    CU_ASSERT_FATAL(solver_graph_build(of->cloud, radius, &of->graph, &error));
    CU_ASSERT_FATAL(solver_closure_open(&of->closure, of->cloud, &of->graph, &error));
    for (size_t a = 0; a < of->cloud->count; a++) {
        for (size_t ab = of->graph.row[a]; ab < of->graph.row[a + 1]; ab++) {
            double square = 0.0, slope;
            for (size_t i = 0; i < (size_t)dim; i++) {
                double d = of->cloud->X[of->graph.neighbour[ab] * (size_t)dim + i] - of->cloud->X[a * (size_t)dim + i];
                square += d * d;
            }
            of->closure.weight[ab] = solver_kernel(2.0 * sqrt(square) / radius, &slope);
        }
    }
    of->width = (size_t)(dim + 1) * of->closure.loops->lanes;
}

static inline void close_system(struct system *of)
{
    solver_closure_close(&of->closure);
    solver_graph_free(&of->graph);
    solver_cloud_free(of->cloud);
}

#endif
