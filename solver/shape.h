/* Shapes of bodies. */
#ifndef SOLVER_SHAPE_H
#define SOLVER_SHAPE_H

#include <stdbool.h>

/* All but the ring are possible domains. A disc and a ring lie in 2D, a ball and a cylinder in 3D. */
enum solver_shape_kind {
    SOLVER_SHAPE_BOX,
    SOLVER_SHAPE_DISC,
    SOLVER_SHAPE_BALL,
    SOLVER_SHAPE_CYLINDER, /* along Z */
    SOLVER_SHAPE_SOLID,    /* where a distance is negative, within a box (solid.h) */
    SOLVER_SHAPE_STL,      /* within a closed surface of triangles, and within a box (stl.h) */
    SOLVER_SHAPE_RING
};

/* By what share of the spacing the layers of a cylinder may lie nearer or farther apart, so that they fit its length.
 */
static const double SOLVER_LAYERS_GIVE = 0.02;

struct solver_shape {
    enum solver_shape_kind kind;
    double lower[3], upper[3]; /* [m] corners of the box, or of the one around another shape */
    double centre[3];          /* [m] of any other shape */
    double inner, outer;       /* [m] radii; only a ring has an inner one */
    double length;             /* [m] of a cylinder */
    bool cut[3];               /* across that axis lies a plane of symmetry; what is above it is there */
    double plane[3];           /* [m] where it lies */
};

/* Whether a domain is a box, or cut out of one: it has the faces X0 to Z1. */
static inline bool solver_shape_in_box(enum solver_shape_kind kind)
{
    return kind == SOLVER_SHAPE_BOX || kind == SOLVER_SHAPE_SOLID || kind == SOLVER_SHAPE_STL;
}

#endif
