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

/* Unlike fmax, keeps a NaN, and does not compare with it; a loop that a compiler turns into vectors would. */
double verify_larger(double a, double b);

/* Norms of a field: `count` rows of `width` components, V one weight per row. */
struct verify_norms verify_norms_field(size_t count, size_t width, const double *V, const double *computed,
                                       const double *exact);

/* Fields that are compared. */
enum verify_field {
    VERIFY_p,     /* linear momentum, all components */
    VERIFY_P,     /* normal components of the first Piola-Kirchhoff stress */
    VERIFY_P_ALL, /* all components of it */
    VERIFY_u,     /* displacement, all components */
    VERIFY_F,     /* F - I, all components: the deviation, since |F| itself is 1 and hides it */
    VERIFY_H,     /* cofactor of F less the identity, all components */
    VERIFY_J,     /* Jacobian less 1 */
    VERIFY_SIGMA, /* normal components of the Cauchy stress */
    VERIFY_SIGMA_ALL,
    VERIFY_v,        /* velocity, all components */
    VERIFY_PRESSURE, /* mean Cauchy stress tr(sigma)/3, positive in tension */
    VERIFY_PROBES,   /* displacement at the probes, all components; sums over rows of the time history instead of
                        particles, each with weight 1, so that "probes_abs" is the root mean square error over time */
    VERIFY_PROBES_Y, /* the same along y alone: a deflection */
    VERIFY_FIELDS,
    VERIFY_STATE_FIELDS = VERIFY_PROBES /* those of a state at one time */
};

/* Errors have names: "p", "P", "P_all", "u", "F", "H", "J", "sigma", "sigma_all", "v", "pressure",
 * "probes", "probes_y" are relative L2 norms; with "_abs" absolute L2, with "_max"
 * relative max, with "_abs_max" absolute max, with "_l1" relative L1. With "snapshots_" before the name of a state's
 * error, the largest of it over the scene's snapshots. "probes_nrmse" is probes_abs over the scene's
 * probe_scale, and probes_y_nrmse likewise. "beside" and "beside_abs" are as "probes" and
 * "probes_abs", against another configuration of the scene (beside.h) in place of an oracle. */
enum {
    VERIFY_NORMS = 5,
    VERIFY_STATE_ERRORS = VERIFY_NORMS * VERIFY_STATE_FIELDS, /* these come first */
    VERIFY_SNAPSHOT_ERRORS = VERIFY_NORMS * VERIFY_FIELDS,    /* where those of the snapshots begin */
    VERIFY_PROBES_NRMSE = VERIFY_SNAPSHOT_ERRORS + VERIFY_STATE_ERRORS,
    VERIFY_PROBES_Y_NRMSE,
    VERIFY_BESIDE,
    VERIFY_BESIDE_ABS,
    VERIFY_ERRORS
};

const char *verify_error_name(size_t error);
/* One of the norms, in their order, as what comes after a field's name: "", "_abs", "_max", "_abs_max", "_l1"; as what
 * comes before its meaning: "relative L2 error of the "; and whether it has the field's unit. */
const char *verify_norm_suffix(size_t norm);
const char *verify_norm_meaning(size_t norm);
bool verify_norm_is_absolute(size_t norm);
/* "-" for relative norms, the field's unit for absolute ones. */
const char *verify_error_unit(size_t error);
/* "relative L2 error of the linear momentum, all components" */
const char *verify_error_meaning(size_t error);
/* Whether it is of an exact solution, so that it has an order; a difference from another configuration has none. */
bool verify_error_has_order(size_t error);
/* VERIFY_ERRORS if there is none of that name. */
size_t verify_error_find(const char *name);
/* What names there are, for messages. */
extern const char verify_error_names[];
/* Whether the scene has what the error is of; if not, *lacks says what is missing: "snapshots", an oracle, or a scheme
 * that knows the field. */
bool verify_error_applies(const struct solver_scene *scene, size_t error, const char **lacks);

/* How the values of a field at one point are laid out, and which of them count. */
enum verify_shape { VERIFY_SCALAR, VERIFY_VECTOR, VERIFY_TENSOR };
enum verify_shape verify_field_shape(enum verify_field field);
/* Name and unit of the field of a state: "P_all", "Pa". */
const char *verify_field_name(enum verify_field field);
const char *verify_field_unit(enum verify_field field);
/* Components of a field at one point that count in `dim` dimensions, from a scalar, a vector [>= dim] or a tensor with
 * rows of `row` numbers; returns how many. */
size_t verify_field_take(enum verify_field field, const double *value, size_t row, size_t dim, double out[9]);
/* An oracle's value of a field, whole: a scalar, a vector [3] or a tensor [9]; returns how many numbers. */
size_t verify_field_whole(enum verify_field field, const struct oracle_kind *kind, const struct oracle_state *state,
                          double value[9]);
/* Of that value the components that count. */
size_t verify_field_exact(enum verify_field field, const struct oracle_kind *kind, const struct oracle_state *state,
                          size_t dim, double out[9]);

/* Stores the norms of a field in their order. */
void verify_norms_keep(double error[VERIFY_NORMS], struct verify_norms norms);

/* Errors of the present state against an oracle at its time. False if there is no memory. */
bool verify_norms_state(const struct solver_output *output, const struct oracle_kind *kind, const struct oracle *oracle,
                        double error[VERIFY_STATE_ERRORS], struct solver_error *why);
/* Those of the history's probes; NaN without probes. `scale` [m] is what probes_nrmse is relative to. */
bool verify_norms_probes(const struct solver_history *history, const struct oracle_kind *kind,
                         const struct oracle *oracle, double scale, double error[VERIFY_ERRORS],
                         struct solver_error *why);
/* Takes one more snapshot's errors into those over all of them; the first comes upon NaN. */
void verify_norms_worst(size_t snapshots_before, const double of_snapshot[VERIFY_STATE_ERRORS],
                        double error[VERIFY_ERRORS]);

/* Whether the scene's scheme knows the field that the error is of: not all have F and P. */
bool verify_error_known(const struct solver_scene *scene, size_t error);

#endif
