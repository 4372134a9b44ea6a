/* What a run holds; for run.c, run_step.c and run_output.c only. */
#ifndef SOLVER_RUN_INTERNAL_H
#define SOLVER_RUN_INTERNAL_H

#include "solver/faces.h"
#include "solver/run.h"
#include "solver/state.h"
#include "solver/stencil.h"

/* Particles per piece of work. A piece's result does not depend on who does it, and pieces are combined in order, so
 * results are the same for any number of threads. */
enum { SOLVER_PIECE = 256 };

struct solver_run {
    const struct solver_scene *scene;
    struct solver_cloud *cloud;
    struct solver_stencil *stencil;
    struct solver_stencil_residuals residuals;
    struct solver_faces faces;
    const struct solver_integrator *integrator;
    const struct solver_upwind_loops *loops;
    struct solver_upwind work;
    struct solver_material_constants *constants; /* of the body, or of each particle of a composite one */
    struct solver_state state;
    double time, external; /* [s], [J] */
    size_t step;
    int threads;
    double setup_seconds, seconds;
    double *output; /* arrays of solver_output, one block; made when first asked for */
    struct solver_history history;
    size_t history_room;
    uint32_t probe[SOLVER_PROBES];
};

/* Monotonic clock [s]. */
double solver_run_clock(void);
/* Stresses of the present state. */
void solver_run_stresses(struct solver_run *run);
/* Fails with SOLVER_BROKE_DOWN if any particle's state is broken. */
bool solver_run_check(struct solver_run *run, struct solver_error *error);
/* Appends the present state to the history. */
bool solver_run_note(struct solver_run *run, struct solver_error *error);
void solver_run_output_free(struct solver_run *run);

#endif
