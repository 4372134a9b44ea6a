#include "solver/interfaces.h"

#include "solver/memory.h"

#include <stdlib.h>
#include <string.h>

/* How many particles of each plane differ from their neighbours before it, along one axis. */
static void count_differing(const struct solver_cloud *cloud, const struct solver_material_constants *constants,
                            const uint32_t *particle_at, size_t axis, size_t *differing)
{
    size_t dim = (size_t)cloud->dim;
    size_t stride[3] = {1, cloud->points[0], (size_t)cloud->points[0] * cloud->points[1]};
    for (size_t a = 0; a < cloud->count; a++) {
        const uint32_t *site = cloud->site + a * dim;
        size_t home = 0;
        for (size_t i = 0; i < 3 && i < dim; i++) {
            home += site[i] * stride[i];
        }
        if (site[axis] > 0 && !solver_material_same(&constants[a], &constants[particle_at[home - stride[axis]]])) {
            differing[site[axis]]++;
        }
    }
}

/* Planes that differ from both sides, each of which is of one kind as far as the next plane. */
static void mark(const size_t *differing, size_t of_a_plane, uint32_t points, uint8_t *interface)
{
    uint32_t last = 0;
    for (uint32_t s = 2; s + 2 < points; s++) {
        bool meet = differing[s] == of_a_plane && differing[s + 1] == of_a_plane && differing[s - 1] == 0 &&
                    differing[s + 2] == 0;
        if (meet && s - last + 1 >= SOLVER_INTERFACES_APART && points - s >= SOLVER_INTERFACES_APART) {
            interface[s] = 1;
            last = s;
        }
    }
}

bool solver_interfaces_find(struct solver_cloud *cloud, const struct solver_material_constants *constants,
                            struct solver_error *error)
{
    size_t dim = (size_t)cloud->dim;
    size_t sites = 1;
    size_t planes = 0;
    for (size_t i = 0; i < dim; i++) {
        sites *= cloud->points[i];
        planes += cloud->points[i];
    }
    if (cloud->site == NULL || sites != cloud->count) {
        return true;
    }
    uint32_t *particle_at = NULL;
    size_t *differing = NULL;
    bool ok = solver_alloc((void **)&particle_at, sites, sizeof *particle_at, "lattice map", error) &&
              solver_alloc((void **)&differing, planes, sizeof *differing, "interfaces", error) &&
              solver_alloc((void **)&cloud->interface, planes, sizeof *cloud->interface, "interfaces", error);
    for (size_t a = 0; ok && a < cloud->count; a++) {
        size_t at = 0;
        for (size_t axis = dim; axis-- > 0;) {
            at = at * cloud->points[axis] + cloud->site[a * dim + axis];
        }
        particle_at[at] = (uint32_t)a;
    }
    size_t from = 0;
    for (size_t axis = 0; ok && axis < dim; axis++) {
        count_differing(cloud, constants, particle_at, axis, differing + from);
        mark(differing + from, sites / cloud->points[axis], cloud->points[axis], cloud->interface + from);
        from += cloud->points[axis];
    }
    free(differing);
    free(particle_at);
    return ok;
}

bool solver_interfaces_there(const struct solver_cloud *cloud)
{
    size_t planes = (size_t)cloud->points[0] + cloud->points[1] + cloud->points[2];
    return cloud->interface != NULL && memchr(cloud->interface, 1, planes) != NULL;
}
