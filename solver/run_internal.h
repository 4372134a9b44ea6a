/* What a run holds; for run.c, run_cloud.c, run_step.c and run_output.c only. */
#ifndef SOLVER_RUN_INTERNAL_H
#define SOLVER_RUN_INTERNAL_H

#include "solver/contact.h"
#include "solver/faces.h"
#include "solver/projection.h"
#include "solver/run.h"
#include "solver/scheme.h"
#include "solver/state.h"
#include "solver/wall.h"

struct solver_run {
    const struct solver_scene *scene;
    struct solver_cloud *cloud;
    struct solver_cloud shown;                   /* the same without its walls, for all that the run shows */
    struct solver_material_constants *constants; /* of the body, or of each particle of a composite one */
    struct solver_body body;                     /* the three above, for the scheme */
    const struct solver_scheme *scheme;
    void *system; /* the scheme's; NULL until it is made */
    const struct solver_integrator *integrator;
    struct solver_faces faces;
    struct solver_contact contact;
    struct solver_wall wall;
    struct solver_projection projection;
    struct solver_state state;
    double time, external, numerical; /* [s]; [J], the last where the scene's balance asks */
    size_t step;
    int threads;
    double setup_seconds, seconds;
    double *output; /* arrays of solver_output, one block; made when first asked for */
    struct solver_history history;
    size_t history_room;
    uint32_t probe[SOLVER_PROBES];
};

/* The cloud of the scene, and what of it the run shows: run_cloud.c. */
bool solver_run_cloud(struct solver_run *run, struct solver_error *error);
/* Monotonic clock [s]. */
double solver_run_clock(void);
/* What follows from a changed state. */
void solver_run_refresh(struct solver_run *run);
/* The linear momentum per unit reference volume over the velocity: the density rho0 [kg/m^3] of particle a. */
static inline double solver_run_density(const struct solver_run *run, size_t a)
{
    return run->constants[a * run->body.stride].rho;
}
/* Fails with SOLVER_BROKE_DOWN if any particle's state is broken. */
bool solver_run_check(struct solver_run *run, struct solver_error *error);
/* Appends the present state to the history. */
bool solver_run_note(struct solver_run *run, struct solver_error *error);
/* For checkpoints (keep.h). */
bool solver_run_keep_history(struct solver_run *run, struct solver_keeper *keeper, struct solver_error *error);
void solver_run_output_arrays(const struct solver_run *run, struct solver_cost_arrays *arrays);
void solver_run_output_free(struct solver_run *run);

#endif
