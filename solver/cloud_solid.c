/* Clouds of solids: particles on a lattice within the body, those near its surface moved onto it (cloud_solid_place.c);
 * volumes and area vectors are what of the body's polyhedron is nearest to each (cloud_solid_share.c), changed a
 * little, so that their moments fit those of the polyhedron and the divergence theorem holds for quadratic fields as a
 * closed stencil needs it (cloud_moments.c). */
#include "solver/cloud_solid.h"
#include "solver/cloud_moments.h"
#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double sliver = 0.2; /* of the share of a box's particle: one with less is left out */
static const double least = 0.15; /* of a cell: a particle at a sharp edge is given as much */
static const double steep = 1.05; /* change of the distance over the way: more than 1 but for round-off and rounding */
static const double reach = 1.5;  /* spacings from the surface to the particle that carries it */
enum { TRIES = 6 };

/* --- the lattice --- */

static bool lay_out(const struct solver_solid *solid, struct solid_grid *grid, struct solver_error *error)
{
    *grid = (struct solid_grid){
        .solid = solid, .dim = (size_t)solid->dim, .cells = {0}, .points = {1, 1, 1}, .nodes = 1, .cell_count = 1};
    if (solid->dim < 2 || solid->dim > 3) {
        return solver_fail(error, SOLVER_BAD_INPUT, "domain: a solid lies in 2D or 3D; got dim = %d", solid->dim);
    }
    for (size_t axis = 0; axis < 3 && axis < grid->dim; axis++) {
        double edge = solid->upper[axis] - solid->lower[axis];
        double spacings = edge / solid->spacing;
        if (!(solid->spacing > 0.0) || !(fabs(spacings - round(spacings)) <= 1e-6) || spacings < 0.5) {
            return solver_fail(error, SOLVER_BAD_INPUT,
                               "domain: the edge of %g m along %c is %g spacings of %g m; expected a whole number, one "
                               "or more",
                               edge, "XYZ"[axis], spacings, solid -> spacing);
        }
        if (spacings > (1 << (CLOUD_GRID_BITS - 1))) {
            return solver_fail(error, SOLVER_BAD_INPUT, "n: the edge along %c is %g spacings; choose a smaller n",
                               "XYZ"[axis], spacings);
        }
        grid->cells[axis] = (uint32_t)lround(spacings);
        grid->points[axis] = grid->cells[axis] + 1;
        grid->nodes *= grid->points[axis];
        grid->cell_count *= grid->cells[axis];
        if (grid->nodes > INT32_MAX) {
            return solver_fail(error, SOLVER_BAD_INPUT, "n: a lattice of more than 2^31 nodes; choose a smaller n");
        }
    }
    return true;
}

static bool reserve_grid(struct solid_grid *grid, struct solver_error *error)
{
    size_t nodes = grid->nodes;
    return solver_alloc((void **)&grid->distance, nodes, sizeof *grid->distance, "distances of nodes", error) &&
           solver_alloc((void **)&grid->X, nodes, sizeof *grid->X, "places of nodes", error) &&
           solver_alloc((void **)&grid->kept, nodes, sizeof *grid->kept, "nodes", error) &&
           solver_alloc((void **)&grid->moved, nodes, sizeof *grid->moved, "nodes", error) &&
           solver_alloc((void **)&grid->dropped, nodes, sizeof *grid->dropped, "nodes", error) &&
           solver_alloc((void **)&grid->particle, nodes, sizeof *grid->particle, "particles of nodes", error) &&
           solver_alloc((void **)&grid->divided, grid->cell_count, sizeof *grid->divided, "cells", error);
}

static void free_grid(struct solid_grid *grid)
{
    free(grid->distance);
    free(grid->X);
    free(grid->kept);
    free(grid->moved);
    free(grid->dropped);
    free(grid->particle);
    free(grid->divided);
    free(grid->value);
}

/* Distances at the nodes; a function that changes faster than its argument is none. */
static bool measure_distances(struct solid_grid *grid, struct solver_error *error)
{
    const struct solver_solid *solid = grid->solid;
    for (size_t node = 0; node < grid->nodes; node++) {
        double X[3];
        uint32_t at[3];
        size_t stride = 1;
        solid_node_place(grid, node, X);
        solid_at(grid, node, at);
        if (!solid->distance(solid->context, X, &grid->distance[node], error)) {
            return false;
        }
        for (size_t axis = 0; axis < 3 && axis < grid->dim; axis++) {
            double change = at[axis] > 0 ? fabs(grid->distance[node] - grid->distance[node - stride]) : 0.0;
            if (!(change <= steep * solid->spacing)) {
                return solver_fail(error, SOLVER_BAD_INPUT,
                                   "domain.distance: changes by %g m over %g m along %c before X = (%g, %g, %g) m; "
                                   "expected a distance, which changes by the way at most",
                                   change, solid->spacing, "XYZ"[axis], X[0], X[1], X[2]);
            }
            stride *= grid->points[axis];
        }
    }
    return true;
}

/* --- the particles --- */

/* A cloud of the kept nodes, ordered; grid->particle follows. */
static bool gather(struct solid_grid *grid, struct solver_cloud *cloud, struct solver_error *error)
{
    uint32_t(*place)[3] = NULL;
    size_t dim = grid->dim;
    size_t made = 0;
    grid->count = 0;
    for (size_t node = 0; node < grid->nodes; node++) {
        grid->count += grid->kept[node];
    }
    if (grid->count == 0) {
        return solver_fail(
            error, SOLVER_BAD_INPUT,
            "n: no node of the lattice lies in the body; choose a larger n, or look whether the distance "
            "is negative inside");
    }
    if (!cloud_reserve(cloud, (struct cloud_size){.particles = grid->count}, error) ||
        !solver_alloc((void **)&place, grid->count, sizeof *place, "lattice sites", error)) {
        return false;
    }
    for (size_t node = 0; node < grid->nodes; node++) {
        if (grid->kept[node]) {
            solid_at(grid, node, place[made]);
            memcpy(cloud->X + made++ * dim, grid->X[node], dim * sizeof *cloud->X);
        }
    }
    bool ordered = cloud_order(cloud, place, error);
    for (size_t node = 0; node < grid->nodes; node++) {
        grid->particle[node] = SOLID_NONE;
    }
    for (size_t a = 0; ordered && a < grid->count; a++) {
        grid->particle[solid_node(grid, place[a])] = (uint32_t)a;
    }
    free(place);
    return ordered;
}

static bool reserve_shares(struct solid_shares *shares, size_t count, struct solver_error *error)
{
    *shares = (struct solid_shares){.V = NULL};
    return solver_alloc((void **)&shares->V, count, sizeof *shares->V, "volumes", error) &&
           solver_alloc((void **)&shares->surface, count, sizeof *shares->surface, "area vectors", error) &&
           solver_alloc((void **)&shares->face, count, sizeof *shares->face, "face areas", error);
}

static void free_shares(struct solid_shares *shares)
{
    free(shares->V);
    free(shares->surface);
    free(shares->face);
}

/* Marks nodes whose share is too small for how they lie, on a face or an edge; returns how many. */
static size_t drop_slivers(struct solid_grid *grid, const struct solid_shares *shares)
{
    double cube = pow(grid->solid->spacing, (double)grid->dim);
    size_t found = 0;
    for (size_t node = 0; node < grid->nodes; node++) {
        uint32_t at[3];
        solid_at(grid, node, at);
        int sides = __builtin_popcount(solid_faces(grid, at)) + (grid->moved[node] ? 1 : 0);
        if (grid->kept[node] && shares->V[grid->particle[node]] < sliver * ldexp(cube, -sides)) {
            grid->dropped[node] = true;
            found++;
        }
    }
    return found;
}

/* --- volumes and areas --- */

/* Least volume of a particle, over that of a cell, by the faces of the box on which it lies. */
static double least_volume(const struct solid_grid *grid, size_t node)
{
    uint32_t at[3];
    solid_at(grid, node, at);
    int faces = __builtin_popcount(solid_faces(grid, at));
    return ldexp(least, faces > 1 ? 1 - faces : 0);
}

/* Particles at sharp edges have little volume and much surface, which makes them stiff: they are given a little more.
 * The correction of moments takes it from all. */
static void raise_small(const struct solid_grid *grid, struct solid_shares *shares)
{
    double cube = pow(grid->solid->spacing, (double)grid->dim);
    for (size_t node = 0; node < grid->nodes; node++) {
        if (grid->kept[node]) {
            double *V = &shares->V[grid->particle[node]];
            *V = fmax(*V, least_volume(grid, node) * cube);
        }
    }
}

static double surface_size(const struct solid_shares *shares, size_t a)
{
    static const double none[3] = {0};
    return sqrt(solid_square(shares->surface[a], none));
}

static bool list_face_points(struct solver_cloud *cloud, const struct solid_shares *shares, struct solver_error *error)
{
    size_t made = 0;
    for (size_t a = 0; a < cloud->count; a++) {
        cloud->tags[a] = surface_size(shares, a) > 0.0 ? 1U << SOLVER_SURFACE : 0U;
        for (uint32_t face = 0; face < SOLVER_SURFACE; face++) {
            cloud->tags[a] |= shares->face[a][face] > 0.0 ? 1U << face : 0U;
        }
        cloud->face_point_count += (size_t)__builtin_popcount(cloud->tags[a]);
    }
    if (!solver_alloc((void **)&cloud->face_point, cloud->face_point_count, sizeof *cloud->face_point, "face points",
                      error)) {
        return false;
    }
    for (size_t a = 0; a < cloud->count; a++) {
        for (uint32_t face = 0; face <= SOLVER_SURFACE; face++) {
            if ((cloud->tags[a] >> face & 1U) == 0) {
                continue;
            }
            struct solver_face_point *point = &cloud->face_point[made++];
            *point = (struct solver_face_point){.particle = (uint32_t)a, .face = face};
            if (face == SOLVER_SURFACE) {
                memcpy(point->area, shares->surface[a], sizeof point->area);
            } else {
                point->area[face / 2] = face % 2 == 0 ? -shares->face[a][face] : shares->face[a][face];
            }
        }
    }
    return true;
}

static bool check_shares(const struct solid_grid *grid, const struct solid_shares *shares, struct solver_error *error)
{
    double most = reach * grid->solid->spacing;
    const double *at = shares->widest > most ? shares->widest_at : shares->farthest_at;
    if (!(shares->volume > 0.0)) {
        return solver_fail(error, SOLVER_BAD_INPUT, "domain: the body is empty: the distance is negative nowhere");
    }
    if (!(shares->widest <= most) || !(shares->farthest <= most)) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "n: the lattice is too coarse for the body at X = (%g, %g, %g) m: the nearest particle%s is "
                           "%g spacings away; choose a larger n",
                           at[0], at[1], at[2], shares->widest > most ? " on the surface" : "",
                           fmax(shares->widest, shares->farthest) / grid->solid->spacing);
    }
    return true;
}

/* Volumes, tags and face points from the shares, corrected. */
static bool finish(const struct solid_grid *grid, const struct solid_shares *shares, struct solver_cloud *cloud,
                   struct solver_error *error)
{
    const struct solver_solid *solid = grid->solid;
    struct solver_cloud_quality *quality = cloud->quality;
    double cube = pow(solid->spacing, (double)grid->dim);
    double face = pow(solid->spacing, (double)grid->dim - 1.0);
    double centroid[3];
    double sum[3] = {0};
    for (int i = 0; i < 3; i++) {
        centroid[i] = shares->moment[i] / shares->volume;
    }
    memcpy(cloud->V, shares->V, cloud->count * sizeof *cloud->V);
    if (!list_face_points(cloud, shares, error)) {
        return false;
    }
    if (!cloud_fit_volumes(cloud, shares->volume, centroid, error) ||
        !cloud_fit_areas(cloud, solid->lower, solid->upper, error)) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "n: the lattice is too coarse for the body: its particles lie in a line or plane, and their "
                           "moments cannot be mended; choose a larger n");
    }
    quality->volume = shares->volume;
    quality->area = shares->area;
    quality->widest = shares->widest / solid->spacing;
    quality->least_volume = INFINITY;
    for (size_t a = 0; a < cloud->count; a++) {
        quality->least_volume = fmin(quality->least_volume, cloud->V[a] / cube);
        quality->correction = fmax(quality->correction, fabs(cloud->V[a] / shares->V[a] - 1.0));
        quality->on_surface += cloud->tags[a] >> SOLVER_SURFACE & 1U;
    }
    for (size_t p = 0; p < cloud->face_point_count; p++) {
        const struct solver_face_point *point = &cloud->face_point[p];
        double plane[3] = {0};
        bool curved = point->face == SOLVER_SURFACE;
        plane[curved ? 0 : point->face / 2] =
            curved ? 0.0 : (point->face % 2 == 0 ? -1.0 : 1.0) * shares->face[point->particle][point->face];
        double change = sqrt(solid_square(point->area, curved ? shares->surface[point->particle] : plane));
        quality->area_correction = fmax(quality->area_correction, change / face);
        for (int i = 0; i < 3; i++) {
            sum[i] += point->area[i];
        }
    }
    quality->closure = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / shares->area;
    if (!(quality->least_volume > 0.0)) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "n: the lattice is too coarse for the body: a particle has a volume of %g cells; choose a "
                           "larger n",
                           quality->least_volume);
    }
    return true;
}

static bool always(const struct solid_grid *grid, size_t node, uint32_t other)
{
    return grid->kept[node] && node != other;
}

static bool measure_places(const struct solid_grid *grid, struct solver_cloud_quality *quality,
                           struct solver_error *error)
{
    quality->nearest = INFINITY;
    for (size_t node = 0; node < grid->nodes; node++) {
        uint32_t at[3];
        double square;
        double off;
        if (!grid->kept[node]) {
            continue;
        }
        solid_at(grid, node, at);
        (void)solid_nearest(grid, at, grid->X[node], always, (uint32_t)node, &square);
        quality->nearest = fmin(quality->nearest, sqrt(square) / grid->solid->spacing);
        if (grid->moved[node]) {
            if (!grid->solid->distance(grid->solid->context, grid->X[node], &off, error)) {
                return false;
            }
            quality->off_surface = fmax(quality->off_surface, fabs(off) / grid->solid->spacing);
        }
    }
    return true;
}

/* --- all together --- */

/* One cloud from the nodes that are not dropped; *again: some turned out too small. */
static bool make(struct solid_grid *grid, struct solver_cloud *cloud, bool *again, struct solver_error *error)
{
    struct solid_shares shares = {.V = NULL};
    bool good = solid_place(grid, error) && gather(grid, cloud, error) && reserve_shares(&shares, grid->count, error);
    if (good) {
        solid_share(grid, &shares);
    }
    *again = good && *again && drop_slivers(grid, &shares) > 0;
    if (good && !*again) {
        raise_small(grid, &shares);
        good = check_shares(grid, &shares, error) && finish(grid, &shares, cloud, error) &&
               measure_places(grid, cloud->quality, error) && solid_list_cells(grid, cloud, error);
    }
    free_shares(&shares);
    return good;
}

bool solver_cloud_solid(const struct solver_solid *solid, struct solver_cloud **out, struct solver_error *error)
{
    struct solid_grid grid;
    struct solver_cloud *cloud = NULL;
    *out = NULL;
    if (!lay_out(solid, &grid, error)) {
        return false;
    }
    bool again = true;
    bool good = reserve_grid(&grid, error) && measure_distances(&grid, error) && solid_divide(&grid, error);
    for (int round = 1; good && again; round++) {
        again = round < TRIES;
        solver_cloud_free(cloud);
        good = solver_alloc((void **)&cloud, 1, sizeof *cloud, "cloud", error) &&
               solver_alloc((void **)&cloud->quality, 1, sizeof *cloud->quality, "quality of the cloud", error);
        if (good) {
            cloud->dim = solid->dim;
            cloud->spacing = solid->spacing;
            good = make(&grid, cloud, &again, error);
        }
    }
    free_grid(&grid);
    if (!good) {
        solver_cloud_free(cloud);
        return false;
    }
    *out = cloud;
    return true;
}
