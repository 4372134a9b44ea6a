/* Shapes of which a cloud of several bodies is made. */
#ifndef SOLVER_SHAPE_H
#define SOLVER_SHAPE_H

enum solver_shape_kind { SOLVER_SHAPE_BOX, SOLVER_SHAPE_RING };

struct solver_shape {
    enum solver_shape_kind kind;
    double lower[3], upper[3]; /* [m] corners of the box, or of the square around the ring */
    double centre[2];          /* [m] of the ring; it lies in 2D */
    double inner, outer;       /* [m] its radii */
};

#endif
