/* The clamped plate that swings in one bending mode, as the scene gives it: 0 <= X <= L, -H/2 <= Y <= H/2, clamped at
 * X = 0, without traction elsewhere. The kinds that answer for it, as a body and by theory, take the same parameters.
 */
#ifndef ORACLES_PLATE_H
#define ORACLES_PLATE_H

#include "oracles/beam.h"
#include "oracles/ritz.h"

struct plate {
    double length, height; /* [m] */
    int mode;              /* 1, 2, ... */
    double tip_velocity;   /* of (L, 0) at t = 0, when the plate is straight [m/s] */
    double E, nu, rho;     /* [Pa], [-], [kg/m^3] */
};

extern const struct oracle_parameter plate_parameters[];

/* False, with `why` filled, if length and height are no plate's or the mode is not a whole number. */
bool plate_read(const double *value, struct plate *plate, char why[ORACLE_WHY]);

/* The `outside` of its kinds. */
double plate_outside(const struct plate *plate, const double X[3]);

struct oracle_beam plate_beam(const struct plate *plate, bool plane_stress);

/* The body in the units of ritz.h, and the frequency [rad/s] that is 1 there. */
struct ritz_problem plate_problem(const struct plate *plate, bool plane_stress);
double plate_frequency(const struct plate *plate);
/* Its mode. False, with `why` filled, if there is no memory or no convergence. */
bool plate_solve(const struct plate *plate, bool plane_stress, struct ritz_limit *result, char why[ORACLE_WHY]);

#endif
