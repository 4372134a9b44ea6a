/* Private to the bimaterial wave: what its scene gives. Its self-check reads nothing else. */
#ifndef ORACLES_BIMATERIAL_WAVE_H
#define ORACLES_BIMATERIAL_WAVE_H

#include "oracles/oracle.h"

struct bimaterial_wave_given {
    double E1, rho1, L1; /* left material [Pa], [kg/m^3], length [m] */
    double E2, rho2, L2; /* right material */
    double A1, omega;    /* of the prescribed motion A1 (1 - cos(omega t)) [m], [rad/s] */
    double t1;           /* its end [s] */
};

const struct bimaterial_wave_given *bimaterial_wave_given(const struct oracle *oracle);
size_t bimaterial_wave_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                             size_t size);

#endif
