/* What the one-dimensional oracles have in common: a bar in uniaxial stress, P = E (F - 1), in which waves run with
 * c = sqrt(E / rho). Lateral strain is not reported: F is the identity across the bar. Energies are per unit of the
 * cross-section. */
#ifndef ORACLES_BAR_H
#define ORACLES_BAR_H

#include "oracles/oracle.h"

struct bar {
    double lower, upper; /* its ends [m] */
    double E, rho;       /* [Pa], [kg/m^3] */
    double c, Z, T;      /* wave speed [m/s], impedance rho c [kg/(m^2 s)], time of travel from end to end [s] */
};

struct bar bar_make(double lower, double length, double E, double rho);

/* Distance [m] of X from it. */
double bar_outside(const struct bar *bar, const double X[3]);

/* All fields at a point from displacement, velocity and stress. */
void bar_state(const struct bar *bar, double u, double v, double stress, struct oracle_state *state);

/* Of two bars: whether their times of travel are near enough to each other that waves can be followed in both. False
 * with `why` filled in. */
bool bar_pair_fits(const struct bar *first, const struct bar *second, char why[ORACLE_WHY]);
/* Of the second: whether it does not lie so far from the origin that, for the length of its waves of `frequency`
 * [rad/s], places in it are too coarse in double precision. */
bool bar_is_resolved(const struct bar *second, double frequency, char why[ORACLE_WHY]);

/* Adds a front, in order, to those there are; one at the same place (within `near` [m]) with the same speed is the same
 * front: jumps add up. Returns how many there are now; ORACLE_TOO_MANY_FRONTS stays what it is. */
size_t bar_add_front(struct oracle_front front[ORACLE_FRONTS], size_t count, struct oracle_front added, double near);

/* Adds the energies of one bar of a kind at time t, by quadrature between the fronts in pieces of at most `longest`
 * [m], in which the fields are smooth and vary by no more than half a radian. NaN where the fronts are not known. */
void bar_energy(const struct oracle_kind *kind, const struct oracle *oracle, const struct bar *bar, double longest,
                double t, double *kinetic, double *strain);

#endif
