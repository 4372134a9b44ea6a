/* Particles of a solid: nodes of the lattice within it, and near its surface nodes moved onto it.
 *
 * Every node nearer to the surface than half a spacing may be moved onto it, from inside or outside. Nodes on faces of
 * the box stay on them: they go to where the surface meets the face. Those on more faces go first, then the nearest
 * ones, and none comes nearer to one that is there than CLOSEST. A line of the lattice that crosses the surface has
 * such a node near the crossing if it is steep enough, and one of the axes is, so the surface is covered. */
#include "solver/cloud_solid.h"
#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double within = 0.5;     /* spacings from the surface: nodes that may move */
static const double farthest = 0.9;   /* spacings that a node may move */
static const double closest = 0.6;    /* spacings between particles on the surface */
static const double clearance = 0.35; /* spacings between the surface and a particle that lies within */
enum { ROUNDS = 40 };

uint32_t solid_faces(const struct solid_grid *grid, const uint32_t at[3])
{
    uint32_t faces = 0;
    for (size_t axis = 0; axis < 3 && axis < grid->dim; axis++) {
        faces |= (at[axis] == 0 ? 1U << (2 * axis) : 0U) | (at[axis] == grid->cells[axis] ? 2U << (2 * axis) : 0U);
    }
    return faces;
}

static bool ask(const struct solid_grid *grid, const double X[3], double *distance, struct solver_error *error)
{
    return grid->solid->distance(grid->solid->context, X, distance, error);
}

/* Slope of the distance along the axes that the faces leave free; returns its square. NAN after an error. */
static double slope(const struct solid_grid *grid, uint32_t faces, const double X[3], double out[3],
                    struct solver_error *error)
{
    double step = 1e-5 * grid->solid->spacing;
    double square = 0.0;
    for (size_t axis = 0; axis < 3; axis++) {
        double near[3] = {X[0], X[1], X[2]};
        double low;
        double high;
        out[axis] = 0.0;
        if (axis >= grid->dim || (faces >> (2 * axis) & 3U) != 0) {
            continue;
        }
        near[axis] = X[axis] - step;
        if (!ask(grid, near, &low, error)) {
            return NAN;
        }
        near[axis] = X[axis] + step;
        if (!ask(grid, near, &high, error)) {
            return NAN;
        }
        out[axis] = (high - low) / (2.0 * step);
        square += out[axis] * out[axis];
    }
    return square;
}

bool solid_project(const struct solid_grid *grid, uint32_t faces, double X[3], bool *found, struct solver_error *error)
{
    const struct solver_solid *solid = grid->solid;
    double distance = INFINITY;
    for (int round = 0, last = ROUNDS; round < last; round++) {
        double normal[3] = {0};
        if (!ask(grid, X, &distance, error)) {
            return false;
        }
        if (fabs(distance) <= 1e-9 * solid->spacing) { /* one more step makes it round-off */
            last = round + 1;
        }
        double square = slope(grid, faces, X, normal, error);
        if (isnan(square)) {
            return false;
        }
        if (square < 1e-2) { /* the surface is parallel to the face, or the distance has its ridge here */
            break;
        }
        for (size_t axis = 0; axis < 3 && axis < grid->dim; axis++) {
            double step = distance * normal[axis] / square;
            step = fmin(fmax(step, -0.5 * solid->spacing), 0.5 * solid->spacing);
            X[axis] = fmin(fmax(X[axis] - step, solid->lower[axis]), solid->upper[axis]);
        }
    }
    *found = fabs(distance) <= 1e-6 * solid->spacing;
    return true;
}

/* A node that may move, in the order of who goes first. */
struct candidate {
    int faces;
    double distance;
    size_t node;
};

static int by_rank(const void *left, const void *right)
{
    const struct candidate *a = left;
    const struct candidate *b = right;
    if (a->faces != b->faces) {
        return a->faces > b->faces ? -1 : 1;
    }
    if (a->distance != b->distance) {
        return a->distance < b->distance ? -1 : 1;
    }
    return a->node < b->node ? -1 : a->node > b->node;
}

size_t solid_nearest(const struct solid_grid *grid, const uint32_t at[3], const double X[3], solid_which *which,
                     uint32_t face, double *square)
{
    enum { REACH = 2 };
    uint32_t first[3];
    uint32_t last[3];
    size_t found = SIZE_MAX;
    *square = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        first[axis] = at[axis] > REACH ? at[axis] - REACH : 0;
        last[axis] = at[axis] + REACH < grid->cells[axis] ? at[axis] + REACH : grid->cells[axis];
    }
    for (uint32_t k = first[2]; k <= last[2]; k++) {
        for (uint32_t j = first[1]; j <= last[1]; j++) {
            for (uint32_t i = first[0]; i <= last[0]; i++) {
                size_t node = solid_node(grid, (uint32_t[3]){i, j, k});
                double to = grid->kept[node] && which(grid, node, face) ? solid_square(X, grid->X[node]) : INFINITY;
                if (to < *square) {
                    *square = to;
                    found = node;
                }
            }
        }
    }
    return found;
}

static bool is_moved(const struct solid_grid *grid, size_t node, uint32_t face)
{
    (void)face;
    return grid->moved[node];
}

/* Moves a node onto the surface, unless that is too far or another is there. */
static bool move(struct solid_grid *grid, size_t node, struct solver_error *error)
{
    double spacing = grid->solid->spacing;
    double X[3] = {grid->X[node][0], grid->X[node][1], grid->X[node][2]};
    double square;
    uint32_t at[3];
    bool found;
    solid_at(grid, node, at);
    if (!solid_project(grid, solid_faces(grid, at), X, &found, error)) {
        return false;
    }
    if (!found || solid_square(X, grid->X[node]) > farthest * farthest * spacing * spacing) {
        return true;
    }
    if (solid_nearest(grid, at, X, is_moved, 0, &square) == SIZE_MAX ||
        square > closest * closest * spacing * spacing) {
        memcpy(grid->X[node], X, sizeof X);
        grid->kept[node] = grid->moved[node] = true;
    }
    return true;
}

static bool move_nodes(struct solid_grid *grid, struct solver_error *error)
{
    struct candidate *list = NULL;
    size_t count = 0;
    if (!solver_alloc((void **)&list, grid->nodes, sizeof *list, "nodes near the surface", error)) {
        return false;
    }
    for (size_t node = 0; node < grid->nodes; node++) {
        uint32_t at[3];
        solid_at(grid, node, at);
        if (!grid->dropped[node] && fabs(grid->distance[node]) <= within * grid->solid->spacing) {
            list[count++] =
                (struct candidate){__builtin_popcount(solid_faces(grid, at)), fabs(grid->distance[node]), node};
        }
    }
    qsort(list, count, sizeof *list, by_rank);
    bool good = true;
    for (size_t i = 0; good && i < count; i++) {
        good = move(grid, list[i].node, error);
    }
    free(list);
    return good;
}

/* Nodes inside that have not moved keep their place, unless they are too near to the surface or to one that has. */
static void keep_inner(struct solid_grid *grid)
{
    double spacing = grid->solid->spacing;
    for (size_t node = 0; node < grid->nodes; node++) {
        uint32_t at[3];
        double square;
        if (grid->kept[node] || grid->dropped[node] || grid->distance[node] > -clearance * spacing) {
            continue;
        }
        solid_at(grid, node, at);
        (void)solid_nearest(grid, at, grid->X[node], is_moved, 0, &square);
        grid->kept[node] = grid->distance[node] < -within * spacing || square >= within * within * spacing * spacing;
    }
}

bool solid_place(struct solid_grid *grid, struct solver_error *error)
{
    for (size_t node = 0; node < grid->nodes; node++) {
        uint32_t at[3];
        solid_at(grid, node, at);
        for (size_t axis = 0; axis < 3; axis++) {
            grid->X[node][axis] = solid_along(grid, axis, at[axis], 0);
        }
        grid->kept[node] = grid->moved[node] = false;
    }
    if (!move_nodes(grid, error)) {
        return false;
    }
    keep_inner(grid);
    return true;
}
