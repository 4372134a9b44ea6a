/* Neighbour graph of particles, at rest or moving, in compressed sparse rows. */
#ifndef SOLVER_GRAPH_H
#define SOLVER_GRAPH_H

#include "solver/cells.h"
#include "solver/cloud.h"
#include "solver/cost.h"

/* Which pairs a graph has. */
enum solver_pairs {
    SOLVER_PAIRS_WITHIN, /* of the same body */
    SOLVER_PAIRS_BETWEEN /* of different bodies */
};

struct solver_graph {
    size_t count;
    size_t *row;         /* [count + 1] first pair of each particle */
    uint32_t *neighbour; /* [row[count]] ascending within a row; never the particle itself */
    size_t row_room, neighbour_room;
    struct solver_cells cells; /* kept for the next update */
};

/* Makes *graph, zeroed before its first use, list all such pairs of points nearer than `radius` [m]. Symmetric: a lists
 * b whenever b lists a. Work and memory grow with points and pairs, however far apart the points are, and nothing is
 * allocated where the last update had as many. SOLVER_BROKE_DOWN where a position is not finite, or where so many
 * points lie together that pairs would grow as the square of points; after a failure the graph is empty. */
bool solver_graph_update(struct solver_graph *graph, const struct solver_points *points, enum solver_pairs which,
                         double radius, struct solver_error *error);
/* The same for a cloud at rest, into a new graph that keeps no cells. */
bool solver_graph_build_pairs(const struct solver_cloud *cloud, double radius, enum solver_pairs which,
                              struct solver_graph *graph, struct solver_error *error);
/* Its pairs within bodies. */
bool solver_graph_build(const struct solver_cloud *cloud, double radius, struct solver_graph *graph,
                        struct solver_error *error);
/* The room it has, cells included. */
void solver_graph_arrays(const struct solver_graph *graph, const char *group, struct solver_cost_arrays *arrays);
void solver_graph_free(struct solver_graph *graph);
/* Index of the pair (a, b), or SIZE_MAX where they are no neighbours. */
size_t solver_graph_find(const struct solver_graph *graph, size_t a, size_t b);

#endif
