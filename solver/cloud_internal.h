/* Inside of the makers of clouds: what every shape needs. Private to cloud*.c.
 *
 * A cloud is first made shape by shape, particles as they come, and then ordered. */
#ifndef SOLVER_CLOUD_INTERNAL_H
#define SOLVER_CLOUD_INTERNAL_H

#include "solver/cloud.h"

/* How many particles and cells a shape has. */
struct cloud_size {
    size_t particles, cells;
};

enum { CLOUD_GRID_BITS = 21 }; /* of a place's index along an axis, in codes of all three */

/* Position along a Z-order (Morton) curve of a place on a grid. */
uint64_t cloud_morton(const uint32_t place[3]);
/* Positions, volumes, tags and cells for that many, zeroed. */
bool cloud_reserve(struct solver_cloud *cloud, struct cloud_size size, struct solver_error *error);
/* Orders the particles row by row by their places [count][3], those tagged as beyond a face last, and counts
 * these. Particles at one place stay in the order they have. Cells follow, and so do the places. */
bool cloud_order(struct solver_cloud *cloud, uint32_t (*place)[3], struct solver_error *error);

/* Cells of a lattice: body[axis] points from first[axis] on of points[axis] along each axis, points[0] running first
 * from `first_particle` on. */
void cloud_lattice_cells(int dim, const uint32_t first[3], const uint32_t body[3], const uint32_t points[3],
                         size_t first_particle, uint32_t *cell);

/* Sizes of shapes; they refuse one that does not fit the spacing, or has more particles than can be numbered. */
bool cloud_box_size(const struct solver_box *box, struct cloud_size *size, struct solver_error *error);
bool cloud_ring_size(const struct solver_shape *ring, double spacing, struct cloud_size *size,
                     struct solver_error *error);
/* Write X, V, tags and cells from the given ones on. */
void cloud_box_fill(struct solver_cloud *cloud, const struct solver_box *box, struct cloud_size from);
void cloud_ring_fill(struct solver_cloud *cloud, const struct solver_shape *ring, struct cloud_size from);

#endif
