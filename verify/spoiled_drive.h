/* What drives a manufactured body, told wrongly. The motion, its oracle and the solver are right; body force or
 * boundary data are not. */
#ifndef VERIFY_SPOILED_DRIVE_H
#define VERIFY_SPOILED_DRIVE_H

#include "solver/scene.h"

/* The right answer at any place and time, to be made wrong. */
struct verify_driven {
    const struct solver_scene *scene;
    solver_drive *drive;
    const void *context;
    double step; /* about that of the run [s] */
};

struct verify_spoiled_drive {
    const char *what;
    const char *faces; /* kind of the faces it is tried with */
    bool of_order;     /* a small fault, that vanishes with the spacing: it can be seen by the order alone */
    void (*spoil)(const struct verify_driven *right, enum solver_formula formula, const double X[3], double t,
                  double value[3]);
};

/* All of them; ends with a NULL `what`. */
const struct verify_spoiled_drive *verify_spoiled_drives(void);

#endif
