/* What the self-checks of all kinds of J2 plasticity have in common. */
#ifndef ORACLES_J2_CHECK_H
#define ORACLES_J2_CHECK_H

#include "oracles/j2.h"
#include "oracles/self_check_parts.h"

/* The state of the material at time t by the return map, with the displacement gradient G then; whether it
 * flows. */
typedef bool j2_map(const struct self_check *check, double t, const double G[9], struct j2_state *state);

/* Lines: the extra scalars are those of the return map, and the stress is on or within the yield surface they tell of;
 * at finite strain that of Kirchhoff. */
void j2_check(struct self_check *check, const struct j2 *material, j2_map *map);

/* Work dissipated or stored by hardening on the way to a plastic strain [J/m^3]. */
double j2_plastic_work(const struct j2 *material, double plastic);

#endif
