#include "solver/graph.h"

#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int ascending(const void *left, const void *right)
{
    uint32_t a = *(const uint32_t *)left;
    uint32_t b = *(const uint32_t *)right;
    return a < b ? -1 : a > b;
}

static void sort(uint32_t *list, size_t count)
{
    enum { SHORT = 96 }; /* below it insertion is faster: lists come as a few ascending runs */
    if (count > SHORT) {
        qsort(list, count, sizeof *list, ascending);
        return;
    }
    for (size_t i = 1; i < count; i++) {
        uint32_t moved = list[i];
        size_t at = i;
        for (; at > 0 && list[at - 1] > moved; at--) {
            list[at] = list[at - 1];
        }
        list[at] = moved;
    }
}

/* What the search for one list needs to know. */
struct search {
    const struct solver_points *points;
    const struct solver_cells *cells;
    enum solver_pairs which;
    double square; /* of the radius */
};

static bool paired(const struct search *search, size_t a, size_t b)
{
    const struct solver_points *points = search->points;
    double square = 0.0;
    for (size_t axis = 0; axis < (size_t)points->dim; axis++) {
        double d = points->x[b * points->stride + axis] - points->x[a * points->stride + axis];
        square += d * d;
    }
    bool together = points->body == NULL || points->body[a] == points->body[b];
    return square < search->square && b != a && together == (search->which == SOLVER_PAIRS_WITHIN);
}

/* The widest support has 268 neighbours on a lattice in 3D; a lattice pressed together to a third of its volume has not
 * as many as this. */
enum { MOST_NEIGHBOURS = 1024 };

/* Neighbours of a into `out` if it is not NULL; returns their number, or one that is too large. */
static size_t neighbours(const struct search *search, size_t a, uint32_t *out)
{
    const struct solver_cells *cells = search->cells;
    uint32_t near[27];
    size_t cell_count = solver_cells_near(cells, a, near);
    size_t found = 0;
    for (size_t c = 0; c < cell_count && found <= MOST_NEIGHBOURS; c++) {
        for (size_t i = cells->start[near[c]]; i < cells->start[near[c] + 1]; i++) {
            uint32_t b = cells->particle[i];
            if (paired(search, a, b)) {
                if (out != NULL) {
                    out[found] = b;
                }
                found++;
            }
        }
    }
    if (out != NULL) {
        sort(out, found);
    }
    return found;
}

/* Room for at least `wanted` entries, old ones lost; when it was too small before, for a quarter more. */
static bool make_room(void **array, size_t *room, size_t wanted, size_t size, struct solver_error *error)
{
    if (*array != NULL && wanted <= *room) {
        return true;
    }
    size_t enough = *array == NULL ? wanted : wanted + wanted / 4;
    free(*array);
    *room = 0;
    if (!solver_alloc(array, enough, size, "neighbour graph", error)) {
        return false;
    }
    *room = enough;
    return true;
}

static bool list_pairs(struct solver_graph *graph, const struct search *search, struct solver_error *error)
{
    size_t count = search->points->count;
    if (!make_room((void **)&graph->row, &graph->row_room, count + 1, sizeof *graph->row, error)) {
        return false;
    }
    graph->count = count;
    graph->row[0] = 0;
#pragma omp parallel for schedule(static)
    for (size_t a = 0; a < count; a++) {
        graph->row[a + 1] = neighbours(search, a, NULL);
    }
    for (size_t a = 0; a < count; a++) {
        if (graph->row[a + 1] > MOST_NEIGHBOURS) {
            return solver_fail(error, SOLVER_BROKE_DOWN,
                               "particle %zu: more than %d others are nearer than %g m: the particles have collapsed "
                               "onto one another",
                               a, MOST_NEIGHBOURS, sqrt(search->square));
        }
        graph->row[a + 1] += graph->row[a];
    }
    if (!make_room((void **)&graph->neighbour, &graph->neighbour_room, graph->row[count], sizeof *graph->neighbour,
                   error)) {
        return false;
    }
#pragma omp parallel for schedule(static)
    for (size_t a = 0; a < count; a++) {
        (void)neighbours(search, a, graph->neighbour + graph->row[a]);
    }
    return true;
}

bool solver_graph_update(struct solver_graph *graph, const struct solver_points *points, enum solver_pairs which,
                         double radius, struct solver_error *error)
{
    struct search search = {.points = points, .cells = &graph->cells, .which = which, .square = radius * radius};
    bool ok = radius > 0.0 ? solver_cells_sort(&graph->cells, points, radius, error)
                           : solver_fail(error, SOLVER_BAD_INPUT,
                                         "support: neighbours within %g m; expected a positive radius", radius);
    if (!ok || !list_pairs(graph, &search, error)) {
        solver_graph_free(graph);
        return false;
    }
    return true;
}

bool solver_graph_build_pairs(const struct solver_cloud *cloud, double radius, enum solver_pairs which,
                              struct solver_graph *graph, struct solver_error *error)
{
    struct solver_points points = {
        .dim = cloud->dim, .count = cloud->count, .stride = (size_t)cloud->dim, .x = cloud->X, .body = cloud->body};
    *graph = (struct solver_graph){.row = NULL};
    bool ok = solver_graph_update(graph, &points, which, radius, error);
    solver_cells_free(&graph->cells);
    return ok;
}

bool solver_graph_build(const struct solver_cloud *cloud, double radius, struct solver_graph *graph,
                        struct solver_error *error)
{
    return solver_graph_build_pairs(cloud, radius, SOLVER_PAIRS_WITHIN, graph, error);
}

void solver_graph_arrays(const struct solver_graph *graph, const char *group, struct solver_cost_arrays *arrays)
{
    const struct solver_cells *cells = &graph->cells;
    solver_cost_array(arrays, group, "rows of neighbours", graph->row, graph->row_room, sizeof *graph->row);
    solver_cost_array(arrays, group, "neighbours", graph->neighbour, graph->neighbour_room, sizeof *graph->neighbour);
    solver_cost_array(arrays, group, "cells: starts", cells->start, cells->cell_room, sizeof *cells->start);
    solver_cost_array(arrays, group, "cells: particles", cells->particle, cells->point_room, sizeof *cells->particle);
    solver_cost_array(arrays, group, "cells: of particles", cells->cell, cells->point_room, sizeof *cells->cell);
}

void solver_graph_free(struct solver_graph *graph)
{
    free(graph->row);
    free(graph->neighbour);
    solver_cells_free(&graph->cells);
    *graph = (struct solver_graph){.row = NULL};
}

size_t solver_graph_find(const struct solver_graph *graph, size_t a, size_t b)
{
    size_t low = graph->row[a];
    size_t high = graph->row[a + 1];
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (graph->neighbour[middle] == b) {
            return middle;
        }
        if (graph->neighbour[middle] < b) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return SIZE_MAX;
}
