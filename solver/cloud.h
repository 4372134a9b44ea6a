/* A cloud: particles in the reference configuration. */
#ifndef SOLVER_CLOUD_H
#define SOLVER_CLOUD_H

#include "solver/cost.h"
#include "solver/error.h"
#include "solver/grading.h"
#include "solver/shape.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A particle's share of one face of the body. Particles on edges have two of these, in corners three. */
struct solver_face_point {
    uint32_t particle;
    uint32_t face;  /* 0..5: X0, X1, Y0, Y1, Z0, Z1; SOLVER_SURFACE */
    double area[3]; /* outward area vector [m^2; m in 2D; 1 in 1D] */
};

/* Bits of a tag, of the first of seven faces. Particles lie on faces, or all in the centres of cells. */
enum {
    SOLVER_SURFACE = 6, /* the curved face of a round body */
    SOLVER_ON_FACE = 0,
    SOLVER_NEXT_TO_FACE = 8,
    SOLVER_BEYOND_FACE = 16, /* particles of a wall */
    SOLVER_FACE_BITS = 0x7f
};

/* How well a cloud fits a body of any shape (solid.h). The polyhedron is that of the distance's zero, linear between
 * points a quarter of a spacing apart. */
struct solver_cloud_quality {
    double volume, area;    /* [m^dim, m^(dim - 1)] of the polyhedron; the cloud's volumes sum to it */
    double closure;         /* |sum B| over the area */
    double correction;      /* largest change of a volume by the correction of moments, over the volume */
    double area_correction; /* the same of an area vector, over the spacing^(dim - 1) */
    double least_volume;    /* of a particle, over the spacing^dim */
    double nearest;         /* least distance of two particles, over the spacing */
    double off_surface;     /* largest distance of a particle on the surface from it, over the spacing */
    double widest;          /* largest distance of a piece of the surface from its particle, over the spacing */
    size_t on_surface;      /* particles on the surface, faces of the box left out */
};

struct solver_cloud {
    int dim;
    size_t count;            /* particles, row by row and plane by plane; those of walls come after the others */
    size_t wall_count;       /* of walls: outside the body, with volumes of their own, only there to hold or move it */
    double spacing;          /* [m]; of a graded lattice the mean */
    double *X;               /* [count][dim] [m] */
    double *V;               /* [count] [m^dim]; sums to the body's volume, first moments exact */
    uint32_t *tags;          /* [count]; bit f of each of the above: lies on face f, next to it, or beyond it */
    uint32_t *body;          /* [count] which body; NULL: there is one */
    size_t face_point_count; /* 0 where no particle lies on a face */
    struct solver_face_point *face_point; /* [face_point_count] */
    uint32_t points[3];                   /* particles along each axis of the lattice, with walls; 0: no lattice */
    uint32_t *site;                       /* [count][dim] lattice indices of each particle; NULL: no lattice */
    double *plane[3];   /* [points] places of the lattice's planes along each axis [m]; NULL where they are even */
    uint8_t *interface; /* [sum of points] whether materials meet on a plane of the lattice, along each axis after the
                           other (interfaces.h); NULL: nowhere, or nobody has looked */
    uint32_t *image;    /* [wall_count] particle of the body of which each particle of a wall is the mirror image;
                           NULL unless asked for */
    struct solver_symmetry *symmetry; /* NULL, or a part stands for the body, and "walls" are its images (symmetry.h) */
    size_t cell_count;
    uint32_t *cell;                       /* [cell_count][2^dim] particles of each lattice cell, in VTK's order for
                                             line, quad and hexahedron (triangles are quads that name a particle twice): for pictures and
                                             files only; none of walls */
    struct solver_cloud_quality *quality; /* of a body of any shape; NULL: of another */
};

struct solver_box {
    int dim;
    double lower[3], upper[3];        /* [m] */
    double spacing;                   /* [m]; every edge must be a whole number of spacings */
    struct solver_grading grading[3]; /* of the spacings along each axis; then `spacing` is their mean */
    double perturb; /* particles not on a face move by up to this fraction of the spacing along each axis */
    uint64_t seed;
    bool centred;     /* particles in the centres of cells, none on a face */
    uint32_t wall[6]; /* layers of particles beyond each face; only where particles are in the centres of cells */
    bool mirrored;    /* walls are mirror images: they are not thicker than the body, and the cloud lists images */
};

/* A box lattice with particles on its boundary: volumes and areas are those of the trapezoidal rule. Or with particles
 * in the centres of cells: each has its cell's volume, and there are no face points; walls continue the lattice. Where
 * the lattice is perturbed the volumes are corrected so that zeroth and first moments stay exact (NUMERICS: the
 * constraints of a closed stencil are compatible only then). A graded lattice has particles on its boundary, and none
 * is moved. */
bool solver_cloud_box(const struct solver_box *box, struct solver_cloud **cloud, struct solver_error *error);
/* Several bodies, in the order of their shapes; all with particles in the centres of cells and without walls, ordered
 * together. SOLVER_BAD_INPUT where a shape is not a whole number of spacings thick, or two overlap. */
bool solver_cloud_bodies(int dim, const struct solver_shape *shape, size_t shape_count, double spacing,
                         struct solver_cloud **cloud, struct solver_error *error);
/* A disc, a ball or a cylinder, with particles on its surface, in concentric shells a spacing apart; around a shell
 * they are pi/4 of a spacing apart, near the corners of a ball's shells less. Volumes sum to the body's and have its
 * first moments, and area vectors along the exact normals satisfy the divergence theorem for quadratic fields
 * (cloud_round.c). SOLVER_BAD_INPUT where radius or length is not a whole number of spacings. */
bool solver_cloud_round(const struct solver_shape *shape, double spacing, struct solver_cloud **cloud,
                        struct solver_error *error);
/* Particles whose state is their own: all but the images of a part of a symmetric body. */
static inline size_t solver_cloud_driven(const struct solver_cloud *cloud)
{
    return cloud->symmetry != NULL ? cloud->count - cloud->wall_count : cloud->count;
}
/* The smallest distance of neighbours on a lattice, or the spacing [m]. */
double solver_cloud_finest(const struct solver_cloud *cloud);
/* Whether spacings change along some axis. */
bool solver_cloud_graded(const struct solver_cloud *cloud);
void solver_cloud_arrays(const struct solver_cloud *cloud, struct solver_cost_arrays *arrays);
void solver_cloud_free(struct solver_cloud *cloud);

#endif
