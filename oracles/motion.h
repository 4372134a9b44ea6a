/* Manufactured motions: formulas x(X, t) = X + u(X, t) of any shape, written once as jets, from which velocity,
 * acceleration, deformation gradient and its gradient follow exactly. Which forces drive a body so is up to its
 * material: a motion knows none. */
#ifndef ORACLES_MOTION_H
#define ORACLES_MOTION_H

#include "oracles/jet.h"

#include <stdbool.h>

struct oracle_motion_shape {
    double L;         /* length over which the motion varies [m] */
    double period;    /* [s] */
    double amplitude; /* [-]; what it scales, the motion says */
};

/* Kinematics at one place and time; axes from dim on are as at rest. */
struct oracle_kinematics {
    double u[3];        /* displacement [m] */
    double v[3], a[3];  /* [m/s], [m/s^2] */
    double F[9];        /* dx_i/dX_I, row by row */
    double dF[3][3][3]; /* d2x_i/dX_I dX_J [1/m] */
};

struct oracle_motion {
    const char *name, *summary;
    const char *amplitude; /* what the amplitude is */
    double most, typical;  /* largest amplitude at which the body stays whole for any dim, and a usual one */
    int least_dim;
    bool isochoric;    /* det F = 1 everywhere and always */
    bool proportional; /* the logarithmic strain keeps its direction in the material, and grows from t = 0 on */
    /* u of the first dim axes. */
    void (*displace)(const struct oracle_motion_shape *shape, int dim, const struct jet X[3], struct jet t,
                     struct jet u[3]);
};

/* All of them; ends with a NULL name. */
const struct oracle_motion *oracle_motions(void);

/* The motion at X [m], t [s]. */
void oracle_motion_at(const struct oracle_motion *motion, const struct oracle_motion_shape *shape, int dim,
                      const double X[3], double t, struct oracle_kinematics *at);

#endif
