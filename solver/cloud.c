#include "solver/cloud.h"

#include "solver/cloud_internal.h"
#include "solver/memory.h"
#include "solver/symmetry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

uint64_t cloud_morton(const uint32_t place[3])
{
    uint64_t code = 0;
    for (unsigned bit = 0; bit < CLOUD_GRID_BITS; bit++) {
        for (unsigned axis = 0; axis < 3; axis++) {
            code |= (uint64_t)(place[axis] >> bit & 1U) << (3 * bit + axis);
        }
    }
    return code;
}

bool cloud_reserve(struct solver_cloud *cloud, struct cloud_size size, struct solver_error *error)
{
    size_t dim = (size_t)cloud->dim;
    cloud->count = size.particles;
    cloud->cell_count = size.cells;
    return solver_alloc((void **)&cloud->X, cloud->count * dim, sizeof(double), "particle positions", error) &&
           solver_alloc((void **)&cloud->V, cloud->count, sizeof(double), "particle volumes", error) &&
           solver_alloc((void **)&cloud->tags, cloud->count, sizeof(uint32_t), "particle tags", error) &&
           solver_alloc((void **)&cloud->cell, cloud->cell_count << dim, sizeof(uint32_t), "lattice cells", error);
}

void cloud_lattice_cells(int dim, const uint32_t first[3], const uint32_t body[3], const uint32_t points[3],
                         size_t first_particle, uint32_t *cell)
{
    static const uint32_t corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                          {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    uint32_t cells[3];
    for (int axis = 0; axis < 3; axis++) {
        cells[axis] = axis < dim ? body[axis] - 1 : 1;
    }
    for (uint32_t k = 0; k < cells[2]; k++) {
        for (uint32_t j = 0; j < cells[1]; j++) {
            for (uint32_t i = 0; i < cells[0]; i++) {
                for (size_t c = 0; c < (size_t)1 << dim; c++) {
                    size_t at[3] = {first[0] + i + corner[c][0], first[1] + j + corner[c][1],
                                    first[2] + k + corner[c][2]};
                    *cell++ = (uint32_t)(first_particle + (at[2] * points[1] + at[1]) * points[0] + at[0]);
                }
            }
        }
    }
}

struct ordered {
    uint64_t code; /* the highest bit tells particles of walls */
    uint32_t from;
};

static int by_code(const void *left, const void *right)
{
    const struct ordered *a = left;
    const struct ordered *b = right;
    if (a->code != b->code) {
        return a->code < b->code ? -1 : 1;
    }
    return a->from < b->from ? -1 : a->from > b->from;
}

/* Moves records of `size` bytes into their new order. */
static void permute(void *array, size_t size, const struct ordered *order, size_t count, unsigned char *scratch)
{
    if (array == NULL) {
        return;
    }
    memcpy(scratch, array, count * size);
    for (size_t a = 0; a < count; a++) {
        memcpy((unsigned char *)array + a * size, scratch + order[a].from * size, size);
    }
}

static void renumber(struct solver_cloud *cloud, const struct ordered *order, uint32_t *to)
{
    for (size_t a = 0; a < cloud->count; a++) {
        to[order[a].from] = (uint32_t)a;
    }
    for (size_t i = 0; i < cloud->cell_count << cloud->dim; i++) {
        cloud->cell[i] = to[cloud->cell[i]];
    }
}

static bool in_wall(const struct solver_cloud *cloud, size_t a)
{
    return cloud->tags[a] >> SOLVER_BEYOND_FACE != 0;
}

/* The axes from the one along which the body is shortest to that along which it is longest, in places. */
static void rank_axes(const struct solver_cloud *cloud, uint32_t (*place)[3], unsigned axes[3])
{
    uint32_t least[3] = {UINT32_MAX, UINT32_MAX, UINT32_MAX};
    uint32_t most[3] = {0};
    uint32_t reach[3];
    for (size_t a = 0; a < cloud->count; a++) {
        for (unsigned axis = 0; !in_wall(cloud, a) && axis < 3; axis++) {
            least[axis] = place[a][axis] < least[axis] ? place[a][axis] : least[axis];
            most[axis] = place[a][axis] > most[axis] ? place[a][axis] : most[axis];
        }
    }
    for (unsigned axis = 0; axis < 3; axis++) {
        reach[axis] = most[axis] - least[axis];
    }
    for (unsigned axis = 0; axis < 3; axis++) {
        unsigned rank = 0;
        for (unsigned other = 0; other < 3; other++) {
            rank += reach[other] < reach[axis] || (reach[other] == reach[axis] && other < axis);
        }
        axes[rank] = axis;
    }
}

/* Row by row, plane by plane along the longest axis: what lies between a particle and its neighbours is no more than
 * one of the smallest planes, so that sweeps can follow one another closely (wave.h), and neighbours in other rows and
 * planes are read as streams of their own. */
static uint64_t row_code(const uint32_t place[3], const unsigned axes[3])
{
    return (uint64_t)place[axes[2]] << 2 * CLOUD_GRID_BITS | (uint64_t)place[axes[1]] << CLOUD_GRID_BITS |
           place[axes[0]];
}

bool cloud_order(struct solver_cloud *cloud, uint32_t (*place)[3], struct solver_error *error)
{
    enum { WIDEST = 3 * sizeof(double) };
    size_t count = cloud->count;
    struct ordered *order = NULL;
    unsigned char *scratch = NULL;
    bool ok = solver_alloc((void **)&order, count, sizeof *order, "order of particles", error) &&
              solver_alloc((void **)&scratch, count, WIDEST, "order of particles", error);
    unsigned axes[3];
    rank_axes(cloud, place, axes);
    if (ok) {
        for (size_t a = 0; a < count; a++) {
            bool wall = in_wall(cloud, a);
            order[a] = (struct ordered){(wall ? (uint64_t)1 << 63 : 0) | row_code(place[a], axes), (uint32_t)a};
            cloud->wall_count += wall;
        }
        qsort(order, count, sizeof *order, by_code);
        permute(cloud->X, (size_t)cloud->dim * sizeof *cloud->X, order, count, scratch);
        permute(cloud->V, sizeof *cloud->V, order, count, scratch);
        permute(cloud->tags, sizeof *cloud->tags, order, count, scratch);
        permute(cloud->body, sizeof *cloud->body, order, count, scratch);
        permute(place, sizeof *place, order, count, scratch);
        renumber(cloud, order, (uint32_t *)scratch);
    }
    free(order);
    free(scratch);
    return ok;
}

bool solver_cloud_graded(const struct solver_cloud *cloud)
{
    return cloud->plane[0] != NULL || cloud->plane[1] != NULL || cloud->plane[2] != NULL;
}

double solver_cloud_finest(const struct solver_cloud *cloud)
{
    double finest = cloud->spacing;
    for (int axis = 0; axis < 3; axis++) {
        for (uint32_t i = 0; cloud->plane[axis] != NULL && i + 1 < cloud->points[axis]; i++) {
            finest = fmin(finest, cloud->plane[axis][i + 1] - cloud->plane[axis][i]);
        }
    }
    return finest;
}

void solver_cloud_arrays(const struct solver_cloud *cloud, struct solver_cost_arrays *arrays)
{
    static const char group[] = "cloud";
    size_t dim = (size_t)cloud->dim;
    size_t count = cloud->count;
    solver_cost_array(arrays, group, "positions X", cloud->X, count * dim, sizeof *cloud->X);
    solver_cost_array(arrays, group, "volumes", cloud->V, count, sizeof *cloud->V);
    solver_cost_array(arrays, group, "tags", cloud->tags, count, sizeof *cloud->tags);
    solver_cost_array(arrays, group, "bodies", cloud->body, count, sizeof *cloud->body);
    solver_cost_array(arrays, group, "lattice sites", cloud->site, count * dim, sizeof *cloud->site);
    for (int axis = 0; axis < 3; axis++) {
        solver_cost_array(arrays, group, "planes of a graded lattice", cloud->plane[axis], cloud->points[axis],
                          sizeof *cloud->plane[axis]);
    }
    solver_cost_array(arrays, group, "interfaces", cloud->interface,
                      (size_t)cloud->points[0] + cloud->points[1] + cloud->points[2], sizeof *cloud->interface);
    solver_cost_array(arrays, group, "mirror images", cloud->image, cloud->wall_count, sizeof *cloud->image);
    solver_cost_array(arrays, group, "face points", cloud->face_point, cloud->face_point_count,
                      sizeof *cloud->face_point);
    solver_cost_array(arrays, group, "cells of pictures", cloud->cell, cloud->cell_count << dim, sizeof *cloud->cell);
    solver_cost_array(arrays, group, "quality", cloud->quality, 1, sizeof *cloud->quality);
    solver_cost_array(arrays, group, "itself", cloud, 1, sizeof *cloud);
}

void solver_cloud_free(struct solver_cloud *cloud)
{
    if (cloud == NULL) {
        return;
    }
    free(cloud->X);
    free(cloud->V);
    free(cloud->tags);
    free(cloud->body);
    free(cloud->site);
    for (int axis = 0; axis < 3; axis++) {
        free(cloud->plane[axis]);
    }
    free(cloud->interface);
    free(cloud->face_point);
    free(cloud->image);
    free(cloud->cell);
    free(cloud->quality);
    solver_symmetry_free(cloud->symmetry);
    free(cloud);
}
