/* Schemes: the semi-discrete right-hand side. A scheme brings its own geometry (a stencil, or neighbours that change)
 * and its own fields; a run brings everything else. A new scheme is one file scheme_NAME.c and one line in scheme.c. */
#ifndef SOLVER_SCHEME_H
#define SOLVER_SCHEME_H

#include "solver/cloud.h"
#include "solver/error.h"
#include "solver/material.h"
#include "solver/scene.h"
#include "solver/state.h"

#include <stdbool.h>
#include <stddef.h>

struct solver_faces;
struct solver_keeper;

/* What a run gives its scheme. It belongs to the run and outlives the scheme's system. */
struct solver_body {
    const struct solver_scene *scene;
    const struct solver_cloud *cloud;
    const struct solver_material_constants *constants; /* [1], or [count] in a composite body */
    size_t stride;                                     /* 0, or 1 in a composite body */
    const struct solver_faces *faces;                  /* there when rates are evaluated, not before */
};

/* What a system stands on. Arrays belong to it. */
struct solver_geometry {
    const double *V;                            /* [count] volumes in the reference configuration [m^dim]: the weights
                                                   of every sum and norm; V rho0 is a particle's mass */
    const struct solver_face_point *face_point; /* [face_point_count] where loads act */
    size_t face_point_count;
    size_t pairs;
    double bytes;    /* of all that is not a field of the state */
    int passes;      /* times that one evaluation reads it */
    double residual; /* of a stencil (run.h); NAN where there is none */
    double shorter;  /* how many times shorter steps are than the spacing and the fastest wave have them; 1: not */
};

/* One particle, for pictures, files and norms; tensors row by row. */
struct solver_point {
    double sigma[9];         /* [3][3] Cauchy stress [Pa], with its components out of the plane or line */
    double J;                /* volume now over volume in the reference configuration */
    double F[9], H[9], P[9]; /* [dim][dim]; not set unless the scheme has a deformation gradient */
    double P_normal;         /* the component of P out of the plane or line [Pa]; the same, below 3D */
    double plastic_strain;   /* equivalent; where the scene's material flows */
};

/* A value of a scene's key that belongs to the scheme, for lists. */
struct solver_scheme_choice {
    const char *text, *meaning;
};

/* What a scheme promises whatever the scene: each with the overrides that it needs, as `--set` spells them, separated
 * by blanks ("": none), or NULL where it is not promised. Tests hold the scheme to each, and measure what it lacks. */
struct solver_scheme_claims {
    const char *affine;   /* x = F(t) X + t c stays exact to round-off where loads and faces belong to it, on a stencil
                             that keeps constant stress (stencil.h), by an integrator whose order is the degree of the
                             evolved measures in t */
    const char *turning;  /* a body that turns as a whole has no stress but of the integrator's order in the step */
    const char *momentum; /* a free body keeps its linear momentum to round-off */
    const char *angular;  /* and its angular momentum, of materials without linear kinematics; x' = v for it */
};

struct solver_scheme {
    const char *name, *summary;
    const struct solver_scheme_choice *choice; /* ends with a NULL text; NULL: none */
    bool deformation;                          /* it knows F, H and P */
    bool stencil; /* it stands on the scene's stencil: keys evolved, stencil, reconstruction and volume_flux are for it
                   */
    const char *advice; /* what to try when a particle breaks, beside evolving more */
    struct solver_scheme_claims claims;

    /* Geometry and terms, for the scene's keys. The fields come later. */
    bool (*create)(const struct solver_body *body, void **system, struct solver_error *error);
    void (*destroy)(void *system);
    struct solver_geometry (*geometry)(const void *system);
    /* What it has allocated but for its fields, and what its right-hand side computes (cost.h). */
    void (*arrays)(const void *system, struct solver_cost_arrays *arrays);
    void (*terms)(const void *system, struct solver_cost_terms *terms);
    /* Fills the table of fields (state.h) and returns its rows. */
    size_t (*fields)(void *system, struct solver_field table[SOLVER_STATE_FIELDS]);
    /* Turns the state (state.h), and what else holds addresses of evolved fields. NULL: nothing does. */
    void (*turn)(void *system, struct solver_state *state);
    /* The other fields of the initial state; v and x are there. */
    bool (*start)(void *system, struct solver_error *error);
    /* Once before each step of size dt; NULL: nothing to do. What it changes of the state is kept if the step fails. */
    bool (*prepare)(void *system, double dt, struct solver_error *error);
    /* All rates of the present state, without tractions and body forces, in two sweeps over particles [begin, end), in
     * a thread: the second may read what the first has left at neighbours, neither what it leaves there itself.
     * Neighbours are those of a graph at rest. `start`: of the state at the start of the step, where that has been
     * turned. */
    void (*gradients)(const void *system, bool start, size_t begin, size_t end);
    void (*rates)(const void *system, bool start, size_t begin, size_t end);
    const struct solver_graph *(*graph)(const void *system);
    /* The same of all particles at time t, in a step of size dt, of a scheme that has no such sweeps; else NULL. */
    bool (*evaluate)(void *system, double t, double dt, struct solver_error *error);
    /* After a stage's update of the state to time t and the constraints of faces; NULL: nothing to do. Changes
     * velocities and what else the stage left open, and what the integrator sums of it; what follows from that is
     * refreshed. */
    bool (*correct)(void *system, const struct solver_state *state, const struct solver_integrator *integrator,
                    int stage, double t, double dt, struct solver_error *error);
    /* Iterations that corrections have taken since the start; NaN where the scene needs none. NULL: it never does. */
    double (*iterations)(const void *system);
    /* What follows from a changed state, particle by particle. Particles [begin, end); runs in a thread. */
    void (*refresh)(void *system, size_t begin, size_t end);
    /* Of the waves in particles [begin, end) the fastest [m/s]; in a thread. The longest step [s] that the scene's CFL
     * number allows where none is faster. */
    double (*fastest)(const void *system, size_t begin, size_t end);
    double (*largest_step)(const void *system, double fastest);
    /* First particle in [begin, end) whose state is broken (not finite, or without volume), else end. In a thread. */
    size_t (*first_broken)(const void *system, size_t begin, size_t end);
    /* Of such a particle, whose velocity is finite: what is broken. */
    const char *(*complaint)(const void *system, size_t particle);
    void (*look)(const void *system, size_t particle, struct solver_point *point);
    /* Strain energy per unit reference volume [J/m^3]. */
    double (*energy)(const void *system, size_t particle);
    /* Power [W] that the dissipation of the rates evaluated last takes, where the scene's balance asks; NULL: it is not
     * measured. */
    double (*lost)(const void *system);
    /* Plastic work per unit reference volume since the start [J/m^3]; NULL: the scheme knows no plastic flow. */
    double (*dissipated)(const void *system, size_t particle);
    const struct solver_scheme *single; /* the same with its state in single precision; NULL: there is none */
    /* What outlives a step and is not a field, for checkpoints (keep.h); NULL: there is nothing. */
    bool (*keep)(void *system, struct solver_keeper *keeper, struct solver_error *error);
};

/* All rates of the present state, at time t in a step of size dt. */
bool solver_scheme_evaluate(const struct solver_scheme *scheme, void *system, size_t count, double t, double dt,
                            struct solver_error *error);
/* The longest step [s] that the scene's CFL number allows. */
double solver_scheme_largest_step(const struct solver_scheme *scheme, const void *system, size_t count);

/* The table, ends with NULL. */
const struct solver_scheme *const *solver_schemes(void);
const struct solver_scheme *solver_scheme_find(const char *name);

extern const struct solver_scheme solver_scheme_upwind, solver_scheme_upwind_single, solver_scheme_jst,
    solver_scheme_ulsph;

#endif
