/* The radial motion of an incompressible neo-Hookean tube in plane strain, between free faces. Lengths here are in
 * inner radii A, times in A sqrt(rho / mu), stresses in mu: nothing is left but the thickness of the wall.
 *
 * Area is kept: r^2 = R^2 + y, where y = x^2 - 1 and x is the inner radius, 1 in the reference. With w = dy/dt / 2 the
 * radial velocity is w / r. The circumferential stress exceeds the radial one by r^2/R^2 - R^2/r^2, so that the
 * momentum equation, integrated from the inner face outwards, gives the radial stress
 *
 *     s = dw/dt ln(r/x) - w^2/2 k + ln(R) - ln(r/x) + y/2 k,   k = 1/x^2 - 1/r^2,
 *
 * and, since it vanishes on the outer face, the equation of motion: J. K. Knowles, Quart. Appl. Math. 18 (1960) 71. */
#ifndef ORACLES_TUBE_H
#define ORACLES_TUBE_H

#include "oracles/oracle.h"
#include "oracles/shell.h"

/* What the scene gives; the self-check reads nothing else. */
struct tube {
    struct shell body; /* of dimension 2 */
    double stretch;    /* x at t = 0 */
    double velocity;   /* of the inner face at t = 0 [m/s] */
    double mu, rho;    /* [Pa], [kg/m^3] */
};
enum { TUBE_STRETCH = 10 }; /* x stays between this and its inverse */

/* The tube at one time, by z = ln x^2: x^2 has all its digits however near to zero it is. */
struct tube_instant {
    double z, y, w, acceleration; /* acceleration: dw/dt */
};

/* One of the solutions between which motion.c interpolates. */
struct tube_node {
    double t, z, rate, second; /* z, dz/dt, d2z/dt2 */
};

struct tube_motion {
    double wall;            /* outer radius^2 - 1 */
    double energy;          /* w^2 ln(outer radius / inner) + y (ln(outer radius in the reference) less the same) */
    double lowest, highest; /* z where the tube turns */
    double period;
    size_t count; /* of nodes, which begin at t = 0 and reach over a period and more; 0 if nothing moves */
    struct tube_node *node;
};

struct oracle {
    struct tube given;
    double speed; /* of shear waves, sqrt(mu / rho) [m/s] */
    struct tube_motion motion;
};

/* Solves it from z and w at t = 0. False, with `why` filled, if x leaves its interval, there is no memory or the solver
 * of the differential equation fails. */
bool tube_move(double wall, double z, double w, struct tube_motion *motion, char why[ORACLE_WHY]);
void tube_free(struct tube_motion *motion);
/* At any time, before 0 as well. */
struct tube_instant tube_at(const struct tube_motion *motion, double t);
/* The radial stress where R^2 = 1 + f. */
double tube_radial_stress(const struct tube_instant *at, double f);
/* Kinetic and strain energy, in units of pi mu A^2 per length. */
void tube_energies(double wall, const struct tube_instant *at, double *kinetic, double *strain);
/* Squared frequency of small oscillations. */
double tube_linear(double wall);

size_t tube_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line, size_t size);

#endif
