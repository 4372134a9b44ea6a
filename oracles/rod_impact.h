/* Private to the rod impact: what its scene gives. Its self-check takes nothing else from the oracle, but the times at
 * which the force may change, to know where to integrate piece by piece. */
#ifndef ORACLES_ROD_IMPACT_H
#define ORACLES_ROD_IMPACT_H

#include "oracles/oracle.h"

enum { ROD_IMPACT_CHANGES = 4096 };

struct rod_impact_given {
    double E1, rho1, L1, v1; /* left rod [Pa], [kg/m^3], [m], [m/s] */
    double E2, rho2, L2, v2; /* right rod */
    double gap;              /* between them at first [m] */
};

const struct rod_impact_given *rod_impact_given(const struct oracle *oracle);
/* Times at which what leaves the faces changes, until the rods have parted for good [s]. */
size_t rod_impact_changes(const struct oracle *oracle, double time[ROD_IMPACT_CHANGES]);
size_t rod_impact_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                        size_t size);

#endif
