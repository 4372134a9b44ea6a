/* Private to the plastic wave: what its scene gives. Its self-check takes nothing else from the oracle. */
#ifndef ORACLES_PLASTIC_WAVE_H
#define ORACLES_PLASTIC_WAVE_H

#include "oracles/oracle.h"

struct plastic_wave_given {
    double L, v0;                   /* [m], [m/s] */
    double E, nu, rho;              /* [Pa], [-], [kg/m^3] */
    double yield_stress, hardening; /* [Pa] */
};

const struct plastic_wave_given *plastic_wave_given(const struct oracle *oracle);
size_t plastic_wave_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                          size_t size);

#endif
