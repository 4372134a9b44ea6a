/* Private to the free top: what its scene gives. Its self-check takes nothing else from the oracle, but how long to
 * look and how near the separatrix the motion is, which says how it magnifies round-off. */
#ifndef ORACLES_FREE_TOP_H
#define ORACLES_FREE_TOP_H

#include "oracles/oracle.h"

struct free_top_given {
    double side[3]; /* of the box, centred, each longer than the next [m] */
    double spin[3]; /* angular velocity at t = 0 [rad/s] */
    double rho;     /* [kg/m^3] */
};

const struct free_top_given *free_top_given(const struct oracle *oracle);
/* Period of the angular velocity as the body sees it [s]. */
double free_top_period(const struct oracle *oracle);
/* 1 - m, m the parameter of its elliptic functions: 0 is the separatrix, on which a turn about the middle axis never
 * ends. */
double free_top_distance(const struct oracle *oracle);
size_t free_top_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                      size_t size);

#endif
