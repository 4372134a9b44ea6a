/* J2 plasticity with linear isotropic hardening, as self-checks evaluate it: by the return map, and by the rate
 * equations of Prandtl and Reuss. The oracles themselves have closed forms and use neither. */
#ifndef ORACLES_J2_H
#define ORACLES_J2_H

#include "oracles/oracle.h"

struct j2 {
    double bulk, mu;         /* [Pa] */
    double yield, hardening; /* yield stress at first, and its rise per plastic strain [Pa] */
};

/* sqrt(3/2 dev(stress):dev(stress)), row by row. */
double j2_equivalent(const double stress[9]);

/* From a virgin state to a small strain, in one step of radial return: which is exact where the direction of the
 * deviator does not change on the way. Sets the stress [Pa] and returns the plastic strain. */
double j2_return(const struct j2 *material, const double strain[9], double stress[9]);

struct j2_state {
    double stress[9], strain[9]; /* [Pa], [-] */
    double plastic;              /* accumulated plastic strain [-] */
};

/* Derivatives at a state whose strain changes at `rate`, elastically or along the yield surface. */
void j2_rates(const struct j2 *material, const struct j2_state *at, bool plastic, const double rate[9],
              struct j2_state *derivative);

/* The strain's rate at s; where it depends on the state, `plastic` says how that changes. */
typedef void j2_path(const struct j2 *material, const void *with, double s, const struct j2_state *at, bool plastic,
                     double rate[9]);
/* Integrates the rate equations along a path whose rate keeps its sign, from `from` to `to`, by an embedded
 * Runge-Kutta method to thirteen digits; the place where the stress meets the yield surface is a root. *yielded is that
 * place, `from` if the whole path is plastic, `to` if none of it is. False if there is no memory or no convergence. */
bool j2_follow(const struct j2 *material, j2_path *path, const void *with, double from, double to,
               struct j2_state *state, double *yielded);

#endif
