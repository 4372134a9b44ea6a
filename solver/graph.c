#include "solver/graph.h"

#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Cells wider than the radius, by more than round-off in finding a particle's cell, so that neighbours lie in the 3^dim
 * cells around; and than the spacing, so that there are no more of them than particles, whatever the radius. */
struct cells {
    uint32_t size[3];
    double lower[3], width[3];
    size_t *start;      /* [cells + 1] */
    uint32_t *particle; /* [count] sorted by cell, ascending within */
};

static void cell_of(const struct solver_cloud *cloud, const struct cells *cells, size_t a, uint32_t at[3])
{
    size_t dim = (size_t)cloud->dim;
    for (size_t axis = 0; axis < 3; axis++) {
        at[axis] = 0;
        if (axis < dim) {
            double place = (cloud->X[a * dim + axis] - cells->lower[axis]) / cells->width[axis];
            double last = (double)(cells->size[axis] - 1);
            at[axis] = (uint32_t)fmin(fmax(place, 0.0), last);
        }
    }
}

static size_t cell_index(const struct cells *cells, const uint32_t at[3])
{
    return ((size_t)at[2] * cells->size[1] + at[1]) * cells->size[0] + at[0];
}

static bool sort_into_cells(const struct solver_cloud *cloud, double radius, struct cells *cells,
                            struct solver_error *error)
{
    size_t dim = (size_t)cloud->dim;
    size_t total = 1;
    double narrowest = fmax(radius, cloud->spacing) * (1.0 + 1e-9);
    for (size_t axis = 0; axis < 3; axis++) {
        cells->size[axis] = 1;
        if (axis >= dim) {
            continue;
        }
        double low = INFINITY;
        double high = -INFINITY;
        for (size_t a = 0; a < cloud->count; a++) {
            low = fmin(low, cloud->X[a * dim + axis]);
            high = fmax(high, cloud->X[a * dim + axis]);
        }
        cells->lower[axis] = low;
        cells->size[axis] = (uint32_t)fmax(1.0, floor((high - low) / narrowest));
        cells->width[axis] = fmax((high - low) / cells->size[axis], narrowest);
        total *= cells->size[axis];
    }
    if (!solver_alloc((void **)&cells->start, total + 1, sizeof *cells->start, "cell list", error) ||
        !solver_alloc((void **)&cells->particle, cloud->count, sizeof *cells->particle, "cell list", error)) {
        return false;
    }
    uint32_t at[3];
    for (size_t a = 0; a < cloud->count; a++) {
        cell_of(cloud, cells, a, at);
        cells->start[cell_index(cells, at) + 1]++;
    }
    for (size_t c = 0; c < total; c++) {
        cells->start[c + 1] += cells->start[c];
    }
    for (size_t a = cloud->count; a-- > 0;) { /* backwards: start[c + 1] ends as the first of its cell */
        cell_of(cloud, cells, a, at);
        cells->particle[--cells->start[cell_index(cells, at) + 1]] = (uint32_t)a;
    }
    memmove(cells->start, cells->start + 1, total * sizeof *cells->start);
    cells->start[total] = cloud->count;
    return true;
}

static int ascending(const void *left, const void *right)
{
    uint32_t a = *(const uint32_t *)left;
    uint32_t b = *(const uint32_t *)right;
    return a < b ? -1 : a > b;
}

/* Neighbours of a into `out` if it is not NULL; returns their number. */
static size_t neighbours(const struct solver_cloud *cloud, const struct cells *cells, double radius, size_t a,
                         uint32_t *out)
{
    size_t dim = (size_t)cloud->dim;
    size_t found = 0;
    uint32_t at[3];
    uint32_t near[3];
    cell_of(cloud, cells, a, at);
    for (near[2] = at[2] - (at[2] > 0); near[2] <= at[2] + 1 && near[2] < cells->size[2]; near[2]++) {
        for (near[1] = at[1] - (at[1] > 0); near[1] <= at[1] + 1 && near[1] < cells->size[1]; near[1]++) {
            for (near[0] = at[0] - (at[0] > 0); near[0] <= at[0] + 1 && near[0] < cells->size[0]; near[0]++) {
                size_t cell = cell_index(cells, near);
                for (size_t i = cells->start[cell]; i < cells->start[cell + 1]; i++) {
                    size_t b = cells->particle[i];
                    double square = 0.0;
                    for (size_t axis = 0; axis < dim; axis++) {
                        double d = cloud->X[b * dim + axis] - cloud->X[a * dim + axis];
                        square += d * d;
                    }
                    if (b != a && square < radius * radius) {
                        if (out != NULL) {
                            out[found] = (uint32_t)b;
                        }
                        found++;
                    }
                }
            }
        }
    }
    if (out != NULL) {
        qsort(out, found, sizeof *out, ascending);
    }
    return found;
}

bool solver_graph_build(const struct solver_cloud *cloud, double radius, struct solver_graph *graph,
                        struct solver_error *error)
{
    struct cells cells = {.start = NULL};
    *graph = (struct solver_graph){.count = cloud->count};
    if (!(radius > 0.0)) {
        return solver_fail(error, SOLVER_BAD_INPUT, "support: neighbours within %g m; expected a positive radius",
                           radius);
    }
    bool ok = sort_into_cells(cloud, radius, &cells, error) &&
              solver_alloc((void **)&graph->row, cloud->count + 1, sizeof *graph->row, "neighbour graph", error);
    if (ok) {
#pragma omp parallel for schedule(static)
        for (size_t a = 0; a < cloud->count; a++) {
            graph->row[a + 1] = neighbours(cloud, &cells, radius, a, NULL);
        }
        for (size_t a = 0; a < cloud->count; a++) {
            graph->row[a + 1] += graph->row[a];
        }
        ok = solver_alloc((void **)&graph->neighbour, graph->row[cloud->count], sizeof *graph->neighbour,
                          "neighbour graph", error);
    }
    if (ok) {
#pragma omp parallel for schedule(static)
        for (size_t a = 0; a < cloud->count; a++) {
            (void)neighbours(cloud, &cells, radius, a, graph->neighbour + graph->row[a]);
        }
    }
    free(cells.start);
    free(cells.particle);
    if (!ok) {
        solver_graph_free(graph);
    }
    return ok;
}

void solver_graph_free(struct solver_graph *graph)
{
    free(graph->row);
    free(graph->neighbour);
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
