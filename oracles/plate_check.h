/* What the self-checks of the plates share: how one starts, and the energies of its mode. */
#ifndef ORACLES_PLATE_CHECK_H
#define ORACLES_PLATE_CHECK_H

#include "oracles/plate.h"
#include "oracles/self_check_parts.h"

/* At t = 0: nothing is bent, and the middle of the free end has its velocity. */
void plate_check_starts(struct self_check *check, const struct plate *plate);

struct plate_energies {
    double kinetic, strain; /* per metre of width [J/m] */
};
/* Of the whole plate at time t, from the fields. */
typedef struct plate_energies plate_quadrature(const struct self_check *check, double t);
/* An eighth of a period after the start both energies of a mode are equal: that is Rayleigh's quotient. `bound`: of
 * what either energy may be off, relative to their sum. */
void plate_check_energies(struct self_check *check, plate_quadrature *quadrature, double bound);

#endif
