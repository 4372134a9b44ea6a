/* A cloud: particles in the reference configuration. */
#ifndef SOLVER_CLOUD_H
#define SOLVER_CLOUD_H

#include "solver/error.h"

#include <stddef.h>
#include <stdint.h>

/* A particle's share of one face of the body. Particles on edges have two of these, in corners three. */
struct solver_face_point {
    uint32_t particle;
    uint32_t face;  /* 0..5: X0, X1, Y0, Y1, Z0, Z1 */
    double area[3]; /* outward area vector [m^2; m in 2D; 1 in 1D] */
};

struct solver_cloud {
    int dim;
    size_t count;   /* particles, ordered along a space-filling curve */
    double spacing; /* [m] */
    double *X;      /* [count][dim] [m] */
    double *V;      /* [count] [m^dim]; sums to the body's volume, first moments exact */
    uint32_t *tags; /* [count]; bit f: lies on face f */
    uint32_t *body; /* [count] which body; NULL: there is one */
    size_t face_point_count;
    struct solver_face_point *face_point; /* [face_point_count] */
    uint32_t points[3];                   /* particles along each axis of the lattice */
    uint32_t *site;                       /* [count][dim] lattice indices of each particle */
    size_t cell_count;
    uint32_t *cell; /* [cell_count][2^dim] particles of each lattice cell, in VTK's order for
                       line, quad and hexahedron: for pictures and files only */
};

struct solver_box {
    int dim;
    double lower[3], upper[3]; /* [m] */
    double spacing;            /* [m]; every edge must be a whole number of spacings */
    double perturb;            /* interior particles move by up to this fraction of the spacing along each axis */
    uint64_t seed;
};

/* A box lattice with particles on its boundary. Volumes and areas are those of the trapezoidal rule; where the
 * lattice is perturbed the volumes are corrected so that zeroth and first moments stay exact (NUMERICS: the
 * constraints of a closed stencil are compatible only then). */
bool solver_cloud_box(const struct solver_box *box, struct solver_cloud **cloud, struct solver_error *error);
void solver_cloud_free(struct solver_cloud *cloud);

#endif
