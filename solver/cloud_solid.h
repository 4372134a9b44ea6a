/* Inside of the maker of clouds of solids. Private to cloud_solid*.c. */
#ifndef SOLVER_CLOUD_SOLID_H
#define SOLVER_CLOUD_SOLID_H

#include "solver/cloud_internal.h"
#include "solver/solid.h"

#define SOLID_NONE    UINT32_MAX
#define SOLID_OUTSIDE (UINT32_MAX - 1) /* a cell */
#define SOLID_WHOLE   (UINT32_MAX - 2) /* a cell that lies within the body */

enum {
    SOLID_PARTS = 4, /* of a cell along each axis, where the surface is looked for */
    SOLID_LINE = SOLID_PARTS + 1,
    SOLID_VALUES = SOLID_LINE * SOLID_LINE * SOLID_LINE
};

/* The lattice over the box, with what lies at its nodes. */
struct solid_grid {
    const struct solver_solid *solid;
    size_t dim;
    uint32_t cells[3], points[3]; /* 0 and 1 beyond dim */
    size_t nodes, cell_count;
    double *distance;   /* [nodes] [m] */
    double (*X)[3];     /* [nodes] where the node's particle lies [m] */
    bool *kept;         /* [nodes] there is a particle */
    bool *moved;        /* [nodes] it lies on the surface */
    bool *dropped;      /* [nodes] there must be none: its share was too small */
    uint32_t *particle; /* [nodes] SOLID_NONE: there is none */
    size_t count;       /* particles */
    uint32_t *divided;  /* [cells] place in `value` of a cell that is divided; SOLID_WHOLE, SOLID_OUTSIDE */
    size_t value_count, value_room;
    double (*value)[SOLID_VALUES]; /* [value_count] distances within divided cells [m] */
};

/* Shares of particles: what of the body and its surface is nearest to each. */
struct solid_shares {
    double *V;            /* [count] [m^dim] */
    double (*surface)[3]; /* [count] area vectors [m^(dim - 1)] */
    double (*face)[6];    /* [count] areas on faces X0 to Z1 [m^(dim - 1)] */
    double volume, moment[3], area;
    double volume_rest, moment_rest[3], area_rest; /* what the sums above have lost to round-off */
    double widest;                                 /* [m] largest distance of a piece of surface from its particle */
    double farthest;                               /* [m] the same of a piece of volume */
    double widest_at[3], farthest_at[3];
};

static inline size_t solid_node(const struct solid_grid *grid, const uint32_t at[3])
{
    return ((size_t)at[2] * grid->points[1] + at[1]) * grid->points[0] + at[0];
}

static inline void solid_at(const struct solid_grid *grid, size_t node, uint32_t at[3])
{
    at[0] = (uint32_t)(node % grid->points[0]);
    at[1] = (uint32_t)(node / grid->points[0] % grid->points[1]);
    at[2] = (uint32_t)(node / grid->points[0] / grid->points[1]);
}

/* Place `part` parts of a cell beyond a node along an axis; exact on the box's faces. */
static inline double solid_along(const struct solid_grid *grid, size_t axis, uint32_t at, uint32_t part)
{
    if (axis >= grid->dim) {
        return 0.0;
    }
    double along = ((double)at + (double)part / SOLID_PARTS) / (double)grid->cells[axis];
    return grid->solid->lower[axis] * (1.0 - along) + grid->solid->upper[axis] * along;
}

static inline double solid_square(const double a[3], const double b[3])
{
    double square = 0.0;
    for (int i = 0; i < 3; i++) {
        square += (a[i] - b[i]) * (a[i] - b[i]);
    }
    return square;
}

/* Where a node lies [m]. */
static inline void solid_node_place(const struct solid_grid *grid, size_t node, double X[3])
{
    uint32_t at[3];
    solid_at(grid, node, at);
    for (size_t axis = 0; axis < 3; axis++) {
        X[axis] = solid_along(grid, axis, at[axis], 0);
    }
}

/* Bits of the faces of the box on which a node lies. */
uint32_t solid_faces(const struct solid_grid *grid, const uint32_t at[3]);

/* Chooses the particles: cloud_solid_place.c. */
bool solid_place(struct solid_grid *grid, struct solver_error *error);
/* Moves X [m] along the free axes onto the surface; *found: it got there. False where the distance failed. */
bool solid_project(const struct solid_grid *grid, uint32_t faces, double X[3], bool *found, struct solver_error *error);
/* Looks which cells the surface may pass, and measures distances within them: cloud_solid_share.c. */
bool solid_divide(struct solid_grid *grid, struct solver_error *error);
/* Shares of the particles: cloud_solid_share.c. */
void solid_share(const struct solid_grid *grid, struct solid_shares *shares);
/* The node within two of the given one whose particle, among those `of` which it is true, is nearest to X; SIZE_MAX. */
typedef bool solid_which(const struct solid_grid *grid, size_t node, uint32_t face);
size_t solid_nearest(const struct solid_grid *grid, const uint32_t at[3], const double X[3], solid_which *which,
                     uint32_t face, double *square);

/* Lists the cells that reach into the body: cloud_solid_cells.c. */
bool solid_list_cells(const struct solid_grid *grid, struct solver_cloud *cloud, struct solver_error *error);

#endif
