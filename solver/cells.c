#include "solver/cells.h"

#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the radius, by which cells are wider: more than round-off in finding a cell, up to `farthest` of them
 * from the first. */
static const double margin = 1e-6;
static const double farthest = 0x1p30;

static size_t most_cells(size_t points)
{
    return points > 27 ? points : 27; /* 27: a grid folded along three axes has no fewer */
}

static bool bounds(const struct solver_points *points, double lower[3], double upper[3], struct solver_error *error)
{
    size_t dim = (size_t)points->dim;
    for (size_t axis = 0; axis < dim; axis++) {
        double low = INFINITY;
        double high = -INFINITY;
        size_t lost = points->count;
#pragma omp parallel for schedule(static) reduction(min : low, lost) reduction(max : high)
        for (size_t a = 0; a < points->count; a++) {
            double x = points->x[a * points->stride + axis];
            low = x < low ? x : low;
            high = x > high ? x : high;
            lost = !isfinite(x) && a < lost ? a : lost;
        }
        if (lost < points->count || (points->count > 0 && !isfinite(high - low))) {
            return solver_fail(error, SOLVER_BROKE_DOWN,
                               "particle %zu: its position is not finite, or beyond all bounds",
                               lost < points->count ? lost : 0);
        }
        lower[axis] = low;
        upper[axis] = high;
    }
    return true;
}

/* Sizes of the grid. A folded axis keeps three cells at least, so that those around a cell are three. */
static size_t lay_out(struct solver_cells *cells, const struct solver_points *points, double radius,
                      const double upper[3])
{
    enum { FOLDED_LEAST = 3 };
    double allowed = (double)most_cells(points->count);
    double longest = 0.0;
    for (int axis = 0; axis < points->dim; axis++) {
        longest = fmax(longest, upper[axis] - cells->lower[axis]);
    }
    cells->width = fmax(radius * (1.0 + margin), longest / farthest);
    for (int axis = 0; axis < 3; axis++) {
        double span = axis < points->dim ? (upper[axis] - cells->lower[axis]) / cells->width : 0.0;
        cells->size[axis] = (int64_t)fmax(span, 0.0) + 1;
        cells->folded[axis] = 0;
    }
    while ((double)cells->size[0] * (double)cells->size[1] * (double)cells->size[2] > allowed) {
        int axis = cells->size[0] >= cells->size[1] && cells->size[0] >= cells->size[2] ? 0
                   : cells->size[1] >= cells->size[2]                                   ? 1
                                                                                        : 2;
        int64_t half = (cells->size[axis] + 1) / 2;
        cells->size[axis] = half > FOLDED_LEAST ? half : FOLDED_LEAST;
        cells->folded[axis] = 1;
    }
    return (size_t)(cells->size[0] * cells->size[1] * cells->size[2]);
}

static bool reserve(struct solver_cells *cells, size_t count, size_t total, struct solver_error *error)
{
    if (count > cells->point_room) {
        free(cells->particle);
        free(cells->cell);
        cells->particle = NULL;
        cells->cell = NULL;
        cells->point_room = 0;
        if (!solver_alloc((void **)&cells->particle, count, sizeof *cells->particle, "cell list", error) ||
            !solver_alloc((void **)&cells->cell, count, sizeof *cells->cell, "cell list", error)) {
            return false;
        }
        cells->point_room = count;
    }
    if (total + 2 > cells->cell_room) {
        /* as many as there can ever be for this number of points, so that moving points never ask for more */
        size_t room = most_cells(count) + 2;
        free(cells->start);
        cells->start = NULL;
        cells->cell_room = 0;
        if (!solver_alloc((void **)&cells->start, room, sizeof *cells->start, "cell list", error)) {
            return false;
        }
        cells->cell_room = room;
    }
    return true;
}

static uint32_t cell_at(const struct solver_cells *cells, const int64_t at[3])
{
    return (uint32_t)((at[2] * cells->size[1] + at[1]) * cells->size[0] + at[0]);
}

static uint32_t cell_of(const struct solver_cells *cells, const struct solver_points *points, size_t a)
{
    int64_t at[3] = {0};
    for (int axis = 0; axis < points->dim; axis++) {
        int64_t place = (int64_t)((points->x[a * points->stride + (size_t)axis] - cells->lower[axis]) / cells->width);
        at[axis] = place % cells->size[axis]; /* the place itself where the axis is not folded */
    }
    return cell_at(cells, at);
}

bool solver_cells_sort(struct solver_cells *cells, const struct solver_points *points, double radius,
                       struct solver_error *error)
{
    double upper[3] = {0};
    if (!bounds(points, cells->lower, upper, error)) {
        return false;
    }
    size_t total = lay_out(cells, points, radius, upper);
    if (!reserve(cells, points->count, total, error)) {
        return false;
    }
#pragma omp parallel for schedule(static)
    for (size_t a = 0; a < points->count; a++) {
        cells->cell[a] = cell_of(cells, points, a);
    }
    /* start[c + 2] counts cell c; then start[c + 1] is its first point, and, as points come, its next */
    memset(cells->start, 0, (total + 2) * sizeof *cells->start);
    for (size_t a = 0; a < points->count; a++) {
        cells->start[cells->cell[a] + 2]++;
    }
    for (size_t c = 2; c < total + 2; c++) {
        cells->start[c] += cells->start[c - 1];
    }
    for (size_t a = 0; a < points->count; a++) {
        cells->particle[cells->start[cells->cell[a] + 1]++] = (uint32_t)a;
    }
    return true;
}

void solver_cells_free(struct solver_cells *cells)
{
    free(cells->start);
    free(cells->particle);
    free(cells->cell);
    *cells = (struct solver_cells){.start = NULL};
}

/* The places next to `at` and itself along one axis; returns how many. */
static int beside(const struct solver_cells *cells, int axis, int64_t at, int64_t place[3])
{
    int found = 0;
    for (int64_t next = at - 1; next <= at + 1; next++) {
        if (next >= 0 && next < cells->size[axis]) {
            place[found++] = next;
        } else if (cells->folded[axis]) {
            place[found++] = next < 0 ? cells->size[axis] - 1 : 0;
        }
    }
    return found;
}

size_t solver_cells_near(const struct solver_cells *cells, size_t a, uint32_t near[27])
{
    int64_t cell = cells->cell[a];
    int64_t place[3][3];
    int64_t at[3] = {cell % cells->size[0], cell / cells->size[0] % cells->size[1],
                     cell / (cells->size[0] * cells->size[1])};
    int counts[3];
    size_t found = 0;
    for (int axis = 0; axis < 3; axis++) {
        counts[axis] = beside(cells, axis, at[axis], place[axis]);
    }
    for (int k = 0; k < counts[2]; k++) {
        for (int j = 0; j < counts[1]; j++) {
            for (int i = 0; i < counts[0]; i++) {
                near[found++] = cell_at(cells, (const int64_t[3]){place[0][i], place[1][j], place[2][k]});
            }
        }
    }
    return found;
}
