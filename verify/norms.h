/* Error norms, written down once.
 *
 * With e = computed - exact at each particle, |.| the Euclidean norm over the components counted, V the stencil's
 * volumes (the quadrature weights of the discrete method) and sums over all particles:
 *
 *   relative L2   sqrt(sum V |e|^2 / sum V |exact|^2)      [-]
 *   relative L1   sum V |e| / sum V |exact|                [-]
 *   absolute L2   sqrt(sum V |e|^2 / sum V)                [unit of the field]
 *   relative max  max |e| / max |exact|                    [-]
 *   absolute max  max |e|                                  [unit of the field]
 *
 * A relative norm against a field that is exactly zero says nothing and is NaN. A NaN anywhere in the field makes
 * every norm of it NaN. */
#ifndef VERIFY_NORMS_H
#define VERIFY_NORMS_H

#include "oracles/oracle.h"
#include "solver/run.h"

#include <stddef.h>

struct verify_norms {
    double relative_l2, absolute_l2, relative_max, absolute_max, relative_l1;
};

/* Norms of a field: `count` rows of `width` components, V one weight per row. */
struct verify_norms verify_norms_field(size_t count, size_t width, const double *V, const double *computed,
                                       const double *exact);

/* Fields that are compared. */
enum verify_field {
    VERIFY_p,      /* linear momentum, all components */
    VERIFY_P,      /* normal components of the first Piola-Kirchhoff stress */
    VERIFY_P_ALL,  /* all components of it */
    VERIFY_u,      /* displacement, all components */
    VERIFY_F,      /* F - I, all components: the deviation, since |F| itself is 1 and hides it */
    VERIFY_PROBES, /* displacement at the probes, all components; sums over rows of the time history instead of
                      particles, each with weight 1, so that "probes_abs" is the root mean square error over time */
    VERIFY_FIELDS
};

/* Errors have names: "p", "P", "P_all", "u", "F", "probes" are relative L2 norms; with "_abs" absolute L2, with "_max"
 * relative max, with "_abs_max" absolute max, with "_l1" relative L1. */
enum { VERIFY_NORMS = 5, VERIFY_ERRORS = VERIFY_NORMS * VERIFY_FIELDS };

const char *verify_error_name(size_t error);
/* "-" for relative norms, the field's unit for absolute ones. */
const char *verify_error_unit(size_t error);
/* "relative L2 error of the linear momentum, all components" */
const char *verify_error_meaning(size_t error);
/* VERIFY_ERRORS if there is none of that name. */
size_t verify_error_find(const char *name);

/* All errors of a run against an oracle: of the present state at its time, and of the history; without probes those of
 * the probes are NaN. False if there is no memory. */
bool verify_norms_measure(const struct solver_output *output, const struct solver_history *history,
                          const struct oracle_kind *kind, const struct oracle *oracle, double error[VERIFY_ERRORS],
                          struct solver_error *why);

#endif
