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
#include "solver/wave.h"

/* Of a stage: three, which go as one wave, with those of other stages where the body is large, unless something that
 * acts on all particles at once cuts in. */
enum solver_sweep { SOLVER_SWEEP_GRADIENTS, SOLVER_SWEEP_RATES, SOLVER_SWEEP_UPDATE, SOLVER_STAGE_SWEEPS };
enum { SOLVER_STEP_SWEEPS = SOLVER_STAGES * SOLVER_STAGE_SWEEPS };

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
    struct solver_wave wave[SOLVER_STEP_SWEEPS + 1]; /* by sweeps; those that the scene's steps take */
    bool acts_on_rates, acts_on_state;               /* something does, on all at once, and ends a wave */
    bool by_stages;                                  /* stages end waves as well */
    double fastest;                                  /* [m/s] wave of the present state; 0: not known */
    double time, external, numerical;                /* [s]; [J], the last where the scene's balance asks */
    double driven; /* [sqrt J] by so much the root of the energy can have grown by faces that are moved, at most */
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

/* Work over a step [J]. */
struct solver_work {
    double external, numerical; /* of the loads; taken by the scheme's dissipation, where the scene's balance asks */
};

/* How many sweeps of a step, which has SOLVER_STAGE_SWEEPS a stage, go as one wave, from `first` on. */
int solver_run_wave(const struct solver_run *run, int first);
/* Whether stages should end waves, by the bytes of the body and of the window, which is what a step's sweeps have
 * between them; a stage's have less. They should where the window is more than the processor's own cache and the body
 * lies in the cache before memory, so that passing through it for each stage costs little; and where the body lies in
 * memory, if the window is so much more than that cache, half of it for each stage, that it goes to memory as well.
 * Never where the system tells of no last cache. */
bool solver_run_parts(double body, double window, int stages);
/* No more of the last cache counts: large processors name what all their cores share. Of 480 MiB so named one core had
 * 29 GB/s up to 32 MiB, 26 at 64, 20 at 128, and 17 at 256 as from memory. */
static const double SOLVER_WITHIN_REACH = 80.0 * 1048576.0;
/* The same of a run. */
bool solver_run_parts_stages(const struct solver_run *run);
/* The waves of a step, which have been found once; no result depends on whether stages end them. */
bool solver_run_make_waves(struct solver_run *run, bool by_stages, struct solver_error *error);
/* All stages of a step. After a failure the state is that of the start. *whole: no particle is broken; else it is not
 * known. */
bool solver_run_stages(struct solver_run *run, double dt, struct solver_work *work, bool *whole,
                       struct solver_error *error);
/* The state at the start of the step again: after a stage that failed, or a step that broke a particle. */
void solver_run_take_back(struct solver_run *run);

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
