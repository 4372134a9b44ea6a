/* Several bodies in one cloud. */
#include "solver/cloud_internal.h"
#include "solver/graph.h"
#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static struct solver_box box_of(int dim, const struct solver_shape *shape, double spacing)
{
    struct solver_box box = {.dim = dim, .spacing = spacing, .centred = true};
    memcpy(box.lower, shape->lower, sizeof box.lower);
    memcpy(box.upper, shape->upper, sizeof box.upper);
    return box;
}

static bool size_of(int dim, const struct solver_shape *shape, double spacing, struct cloud_size *size,
                    struct solver_error *error)
{
    if (shape->kind == SOLVER_SHAPE_RING) {
        return dim == 2 ? cloud_ring_size(shape, spacing, size, error)
                        : solver_fail(error, SOLVER_BAD_INPUT, "ring: it lies in 2D; expected dim = 2, got %d", dim);
    }
    struct solver_box box = box_of(dim, shape, spacing);
    return cloud_box_size(&box, size, error);
}

static void fill(struct solver_cloud *cloud, const struct solver_shape *shape, struct cloud_size from)
{
    if (shape->kind == SOLVER_SHAPE_RING) {
        cloud_ring_fill(cloud, shape, from);
    } else {
        struct solver_box box = box_of(cloud->dim, shape, cloud->spacing);
        cloud_box_fill(cloud, &box, from);
    }
}

/* Sizes of all bodies, and their sum. */
static bool measure(int dim, const struct solver_shape *shape, size_t count, double spacing, struct cloud_size *size,
                    struct cloud_size *total, struct solver_error *error)
{
    *total = (struct cloud_size){0};
    for (size_t b = 0; b < count; b++) {
        struct solver_error why = {.code = SOLVER_OK};
        if (!size_of(dim, &shape[b], spacing, &size[b], &why)) {
            return solver_fail(error, why.code, "bodies[%zu]: %s", b + 1, why.text);
        }
        total->particles += size[b].particles;
        total->cells += size[b].cells;
        if (total->particles > INT32_MAX) {
            return solver_fail(error, SOLVER_BAD_INPUT, "n: more than 2^31 particles; choose a smaller n");
        }
    }
    return true;
}

/* Places on a grid of the spacing over all bodies. */
static bool list_places(const struct solver_cloud *cloud, uint32_t (*place)[3], struct solver_error *error)
{
    size_t dim = (size_t)cloud->dim;
    for (size_t axis = 0; axis < dim; axis++) {
        double low = INFINITY;
        for (size_t a = 0; a < cloud->count; a++) {
            low = fmin(low, cloud->X[a * dim + axis]);
        }
        for (size_t a = 0; a < cloud->count; a++) {
            double along = (cloud->X[a * dim + axis] - low) / cloud->spacing + 0.5;
            if (!(along < 1U << CLOUD_GRID_BITS)) {
                return solver_fail(error, SOLVER_BAD_INPUT,
                                   "bodies: they reach over more than %u spacings of %g m along %c; choose a smaller n",
                                   1U << CLOUD_GRID_BITS, cloud->spacing, "XYZ"[axis]);
            }
            place[a][axis] = (uint32_t)along;
        }
    }
    return true;
}

/* Particles of bodies that only touch are a spacing apart; some of bodies that overlap are nearer than the diagonal of
 * half a cell. */
static bool check_apart(const struct solver_cloud *cloud, struct solver_error *error)
{
    struct solver_graph graph;
    bool apart = true;
    if (!solver_graph_build_pairs(cloud, 0.9 * cloud->spacing, SOLVER_PAIRS_BETWEEN, &graph, error)) {
        return false;
    }
    for (size_t a = 0; apart && a < cloud->count; a++) {
        if (graph.row[a + 1] > graph.row[a]) {
            const double *X = cloud->X + a * (size_t)cloud->dim;
            apart = solver_fail(error, SOLVER_BAD_INPUT,
                                "bodies: numbers %u and %u overlap at (%g, %g, %g) m; expected them to lie apart, or "
                                "to touch at most",
                                cloud->body[a] + 1, cloud->body[graph.neighbour[graph.row[a]]] + 1, X[0],
                                cloud->dim > 1 ? X[1] : 0.0, cloud->dim > 2 ? X[2] : 0.0);
        }
    }
    solver_graph_free(&graph);
    return apart;
}

static bool make(struct solver_cloud *cloud, const struct solver_shape *shape, const struct cloud_size *size,
                 size_t count, struct solver_error *error)
{
    struct cloud_size from = {0};
    uint32_t(*place)[3] = NULL;
    for (size_t b = 0; b < count; b++) {
        fill(cloud, &shape[b], from);
        for (size_t a = 0; cloud->body != NULL && a < size[b].particles; a++) {
            cloud->body[from.particles + a] = (uint32_t)b;
        }
        from.particles += size[b].particles;
        from.cells += size[b].cells;
    }
    bool ok = solver_alloc((void **)&place, cloud->count, sizeof *place, "order of particles", error) &&
              list_places(cloud, place, error) && cloud_order(cloud, place, error) &&
              (cloud->body == NULL || check_apart(cloud, error));
    free(place);
    return ok;
}

bool solver_cloud_bodies(int dim, const struct solver_shape *shape, size_t count, double spacing,
                         struct solver_cloud **out, struct solver_error *error)
{
    struct solver_cloud *cloud = NULL;
    struct cloud_size *size = NULL;
    struct cloud_size total;
    *out = NULL;
    bool ok = solver_alloc((void **)&size, count, sizeof *size, "bodies", error) &&
              solver_alloc((void **)&cloud, 1, sizeof *cloud, "cloud", error);
    if (ok) {
        cloud->dim = dim;
        cloud->spacing = spacing;
        ok =
            measure(dim, shape, count, spacing, size, &total, error) && cloud_reserve(cloud, total, error) &&
            (count < 2 || solver_alloc((void **)&cloud->body, total.particles, sizeof *cloud->body, "bodies", error)) &&
            make(cloud, shape, size, count, error);
    }
    free(size);
    if (!ok) {
        solver_cloud_free(cloud);
        return false;
    }
    *out = cloud;
    return true;
}
