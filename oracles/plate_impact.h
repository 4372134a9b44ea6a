/* Private to the impacts of plates: what their scenes give, and their equations of state. Their self-check takes
 * nothing else from the oracle. */
#ifndef ORACLES_PLATE_IMPACT_H
#define ORACLES_PLATE_IMPACT_H

#include "oracles/oracle.h"

#include <complex.h>

enum { PLATE_IMPACT_COEFFICIENTS = 3 };

struct plate_impact_given {
    double L, v0, rho;                          /* [m], [m/s], [kg/m^3] */
    double material[PLATE_IMPACT_COEFFICIENTS]; /* in the order of the kind's parameters */
};

struct plate_impact_eos {
    /* Speed [m/s] of a shock that changes the velocity by v0, into the material at rest and without pressure. */
    double (*shock_speed)(const struct plate_impact_given *given);
    /* Speed of sound [m/s] on the Hugoniot curve, where the compression is eta = 1 - rho0/rho and the pressure p. */
    double (*sound_speed)(const struct plate_impact_given *given, double eta, double p);
    /* The compression that no shock may reach. */
    double (*limit)(const struct plate_impact_given *given);
    /* The equation of state itself: pressure [Pa] by compression and internal energy [J/kg] above that of the material
     * at rest. Analytic, so that a complex step differentiates it. */
    double complex (*pressure)(const struct plate_impact_given *given, double complex eta, double complex e);
    size_t coefficients;
};

const struct plate_impact_given *plate_impact_given(const struct oracle *oracle);
size_t plate_impact_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                          size_t size);

extern const struct plate_impact_eos plate_impact_stiffened_gas, plate_impact_mie_grueneisen;

#endif
