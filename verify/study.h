/* A convergence study: levels -> errors -> observed orders -> gates. */
#ifndef VERIFY_STUDY_H
#define VERIFY_STUDY_H

#include "solver/scene.h"
#include "verify/beside.h"
#include "verify/files.h"
#include "verify/gates.h"
#include "verify/level.h"
#include "verify/trace.h"
#include "verify/truth.h"

#include <stddef.h>

struct verify_study {
    const struct solver_scene *scene; /* as loaded for the finest level done */
    const struct verify_truth *truth;
    size_t level_count;
    struct verify_level level[SOLVER_LEVELS];
    /* Conserved quantities at the finest level: over time, at the start and at the end. */
    size_t total_count;
    struct solver_totals *totals; /* [total_count] */
    struct solver_totals first, last;
    struct verify_gates gates;
    size_t trace_count;
    struct verify_trace trace[SOLVER_PROBES]; /* at the finest level */
    const struct verify_beside *beside;
    struct verify_motion motion; /* at the finest level, if something was run beside it */
    /* Files written, "" where not. */
    char record[VERIFY_PATH], picture[VERIFY_PATH], exact_picture[VERIFY_PATH];
};

/* Observed order log(e1 / e2) / log(h1 / h2), negative where the error grows. An error of zero at the finer level
 * alone gives infinity; at both, or any value that is no error or spacing, NaN: no order was observed. */
double verify_order(double e1, double h1, double e2, double h2);

/* Adds a level that has n, facts and errors, and takes over what it holds: fills in its time per particle-step and its
 * observed orders. */
void verify_study_add(struct verify_study *study, const struct verify_level *level);

/* Keeps a run's history, its totals and the traces of its probes; verify_study_free gives them back, and the levels'
 * snapshots. */
bool verify_study_history(struct verify_study *study, const struct solver_history *history, struct solver_error *error);
void verify_study_free(struct verify_study *study);

/* Judges the scene's gates on the finest level. */
bool verify_study_judge(struct verify_study *study, struct solver_error *error);

/* One line: what the gates say. */
const char *verify_verdict(const struct verify_study *study);

/* The published value of an error at n spacings; NaN if there is none, or if the command line
 * changed what is simulated (material, times, parameters, ...) rather than how. */
double verify_published(const struct solver_scene *scene, int n, const char *error_name);

/* Whether the scene's scheme stands on the scene's stencil. */
bool verify_has_stencil(const struct solver_scene *scene);
/* Errors worth a column: those published and those that gates name, as far as the scheme knows their fields; where
 * there are none p and P, or sigma where the scheme has no P. Without an oracle none of these; last, where
 * there is one, the differences from the configuration beside. Fails
 * (SOLVER_BAD_INPUT) on a published name that is no error. */
bool verify_shown(const struct solver_scene *scene, size_t shown[VERIFY_ERRORS], size_t *count,
                  struct solver_error *error);
/* Of those, the ones that are the largest over the snapshots: which error of a state each is the largest of. */
size_t verify_shown_snapshots(const size_t *shown, size_t shown_count, size_t of_state[VERIFY_STATE_ERRORS]);

#endif
