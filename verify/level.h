/* What a study measured at one level, by name. */
#ifndef VERIFY_LEVEL_H
#define VERIFY_LEVEL_H

#include "solver/run.h"
#include "verify/indicators.h"
#include "verify/norms.h"
#include "verify/snapshot.h"
#include "verify/truth.h"

/* A number measured in the run, beside the oracle's. */
struct verify_figure {
    double measured, exact; /* [unit] */
    double error;           /* relative to the exact value; where that is 0, the magnitude of the measured one */
    double rate;            /* observed order of the error from the level before; NaN at the first */
    const char *unit;
    const char *why; /* the error is no number, and what to do; "" if it is one */
};

struct verify_level {
    int n;                       /* spacings along the reference length */
    struct solver_facts facts;   /* spacing h, particles, steps, seconds, ... */
    double ns_per_particle_step; /* [ns], time loop alone */
    bool follows;                /* a level is before it, from which there are orders */
    double error[VERIFY_ERRORS];
    double rate[VERIFY_ERRORS]; /* observed order from the level before to this one; NaN at the first */
    size_t snapshot_count;      /* taken so far */
    struct verify_snapshot snapshot[SOLVER_SNAPSHOTS];
    struct verify_figure figure[SOLVER_FIGURES]; /* of the scene's, in its order */
    double indicator[VERIFY_INDICATORS];         /* [-] */
};

/* A measured value and how a bound holds it. */
struct verify_value {
    double value;   /* NaN: could not be measured */
    const char *op; /* the side that is good: "<=" for errors, ">=" for orders */
    const char *unit;
    const char *why; /* the value is no finite number, and what to do; "" if it is one */
};

/* Why an error is no finite number, and why an order of it is none, beside a level before or not; "" if it is one. */
const char *verify_why_no_error(double error);
const char *verify_why_no_order(double order, double error, bool follows);

/* The error that a gate's name is of, VERIFY_ERRORS if there is none; *is_rate (may be NULL): "rate " stands before it.
 */
size_t verify_level_error(const char *name, bool *is_rate);
/* The value a gate names: an error or "figure NAME" (its error), "rate " and one of these, or "indicator NAME". If the
 * scene cannot have it, fails (SOLVER_BAD_INPUT) with what there is; the text begins with `where`. */
bool verify_level_value(const struct solver_scene *scene, const struct verify_level *level, const char *name,
                        const char *where, struct verify_value *value, struct solver_error *error);

/* Compares the present state of a run that stands at the scene's next snapshot; once the last is taken the errors over
 * all snapshots are there. */
bool verify_level_snapshot(struct verify_level *level, struct solver_run *run, const struct oracle_kind *kind,
                           const struct oracle *oracle, struct solver_error *error);
/* Errors and figures of a finished run; snapshots were taken on the way. */
bool verify_level_measure(struct verify_level *level, const struct solver_scene *scene, struct solver_run *run,
                          const struct solver_output *output, const struct verify_truth *truth,
                          struct solver_error *error);
void verify_level_free(struct verify_level *level);

#endif
