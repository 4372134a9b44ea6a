/* J2 plasticity with linear isotropic hardening, as self-checks evaluate it: by the return map, and by the rate
 * equations of Prandtl and Reuss. The oracles themselves have closed forms and use neither. */
#ifndef ORACLES_J2_H
#define ORACLES_J2_H

#include "oracles/oracle.h"

struct j2 {
    double bulk, mu;         /* [Pa] */
    double yield, hardening; /* yield stress at first, and its rise per plastic strain [Pa] */
};

/* The extra scalars of every kind of J2 plasticity. */
enum { J2_PLASTIC_STRAIN, J2_YIELD_STRESS };
extern const struct oracle_extra j2_extra[];

/* sqrt(3/2 dev(stress):dev(stress)), row by row. */
double j2_equivalent(const double stress[9]);

struct j2_state {
    double deviator[9], mean; /* of the stress [Pa], apart: near incompressibility the mean is so much larger */
    double strain[9];         /* [-] */
    double plastic;           /* accumulated plastic strain [-] */
};

/* The whole stress, row by row [Pa]. */
void j2_stress(const struct j2_state *state, double stress[9]);

/* From a state to another strain by one step of radial return, which is exact where the deviator moves along a straight
 * line through zero. Returns what the plastic strain has grown by. */
double j2_return(const struct j2 *material, const double strain[9], struct j2_state *state);

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
