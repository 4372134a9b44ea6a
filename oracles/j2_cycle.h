/* Private to the cycles of J2 plasticity: what their scenes give. Their self-check takes nothing else from the oracle.
 */
#ifndef ORACLES_J2_CYCLE_H
#define ORACLES_J2_CYCLE_H

#include "oracles/oracle.h"

enum { J2_CYCLES = 100 };

struct j2_cycle_given {
    double amplitude, period; /* of the strain [-], [s] */
    int cycles;
    double E, nu, rho;              /* [Pa], [-], [kg/m^3] */
    double yield_stress, hardening; /* [Pa] */
};

/* The component of F - I that changes, and what counts as strain. */
struct j2_cycle_path {
    int component;    /* row by row: 0 stretches along X, 1 shears along X across Y */
    bool logarithmic; /* Hencky's strain, and Kirchhoff's stress by it */
};

const struct j2_cycle_given *j2_cycle_given(const struct oracle *oracle);
const struct j2_cycle_path *j2_cycle_path(const struct oracle *oracle);
size_t j2_cycle_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                      size_t size);

#endif
