/* Neighbour graph of a cloud in compressed sparse rows. */
#ifndef SOLVER_GRAPH_H
#define SOLVER_GRAPH_H

#include "solver/cloud.h"

struct solver_graph {
    size_t count;
    size_t *row;         /* [count + 1] first pair of each particle */
    uint32_t *neighbour; /* [row[count]] ascending within a row; never the particle itself */
};

/* All pairs closer than `radius` [m], found through cell lists. Symmetric: a lists b whenever b lists a. */
bool solver_graph_build(const struct solver_cloud *cloud, double radius, struct solver_graph *graph,
                        struct solver_error *error);
void solver_graph_free(struct solver_graph *graph);
/* Index of the pair (a, b), or SIZE_MAX where they are no neighbours. */
size_t solver_graph_find(const struct solver_graph *graph, size_t a, size_t b);

#endif
