/* A body of any shape, given by the signed distance to its surface. */
#ifndef SOLVER_SOLID_H
#define SOLVER_SOLID_H

#include "solver/cloud.h"

/* The body is where the distance is negative, within a box. Where it reaches a face of the box, that is a face of the
 * body, X0 to Z1; the rest of its surface is SOLVER_SURFACE. */
struct solver_solid {
    int dim;                   /* 2 or 3 */
    double lower[3], upper[3]; /* [m]; edges are whole numbers of spacings */
    double spacing;            /* [m] */
    /* Distance [m] of X [m] from the surface, negative inside. One that is too small by a factor is good enough, as
     * unions and cuts of shapes give it; one that is too large is refused. */
    bool (*distance)(const void *context, const double X[3], double *distance, struct solver_error *error);
    const void *context;
};

/* Particles on a lattice within the body, those near its surface moved onto it: cloud_solid.c; with its quality.
 * SOLVER_BAD_INPUT where the lattice is too coarse for the shape. */
bool solver_cloud_solid(const struct solver_solid *solid, struct solver_cloud **cloud, struct solver_error *error);

#endif
