/* Rigid walls that stand still, without friction: a plane, and in the plane walls by paths (die.h). Particles do not
 * pass them, and are not held by them. A plane is met by what lies on the surface of a body; a path, which may be
 * sharper than the spacing, by all of it.
 *
 * 004_0c0448173ed5e9bd.txt reflects the momentum of a particle that has passed the wall and puts it back onto it. Here
 * none passes: a surface particle at the distance g from the wall when a step of size dt begins must not approach it
 * faster than g/dt, at that moment and at every stage. A Runge-Kutta step moves it by dt times a mean of the velocities
 * of its stages (x' = v, weights that are positive and sum to 1), so that the step ends at a distance of g - dt g/dt =
 * 0 or more, whatever the integrator. What would approach faster has the excess taken from its velocity along the
 * normal, as an inelastic impact of one particle would; the rebound is the body's. A particle that its body pulls away
 * is let go.
 *
 * Of a curved wall g and the normal are those of the nearest place when the step begins. Around a round corner that
 * keeps particles from passing, too; along a hollow one a particle that slides by d ends d^2/2r behind the wall, some
 * 1e-12 of its spacing in a step, and the next step takes it back: g/dt then counts with its sign. In a corner, and
 * between two walls, each bound is enforced in turn until all hold. Where a face leads a particle along an axis, the
 * wall moves it along the other.
 *
 * The impulse [N s] on the wall is exact: what a stage takes enters the velocity at the end of the step with the
 * product of the weights `keep` of the later stages (integrator.h), and is counted so. Impulse and momentum of the body
 * add up to what they were to round-off. So is the energy that impacts take: what is taken before the first stage
 * changes the velocity v to v + w and the kinetic energy by m w (v + w/2); the stages change that of a step by m w
 * times the mean of the velocities at its start and its end, whatever else changes the velocity in between. */
#ifndef SOLVER_WALL_H
#define SOLVER_WALL_H

#include "solver/die.h"
#include "solver/faces.h"
#include "solver/integrator.h"
#include "solver/scheme.h"
#include "solver/state.h"

/* A bound in this step: the velocity along the normal is at least that. */
struct solver_wall_bound {
    double normal[3]; /* unit, towards the body */
    double least;     /* [m/s] */
};

enum { SOLVER_WALL_BOUNDS = 3 };

/* A particle that may meet a wall. */
struct solver_wall_site {
    uint32_t particle;
    double mass; /* [kg]; per unit thickness in 2D, per unit area in 1D */
    bool led[3]; /* faces hold or move it along this axis */
    size_t bounds;
    struct solver_wall_bound bound[SOLVER_WALL_BOUNDS]; /* [bounds] */
    double start[3], given[3]; /* [m/s] velocity at the start of the step; what its stages add in the end */
};

struct solver_wall {
    size_t dim;
    size_t count; /* of sites; 0: the scene has no wall */
    struct solver_wall_site *site;
    bool plane;                 /* there is one; */
    double point[3], normal[3]; /* [m]; unit, towards the body */
    struct solver_die die;      /* walls by paths; none of it where the scene has none */
    double reach;               /* [m] from which on they count */
    double impulse[3];          /* [N s] handed to walls since the start */
    double stepping[3];         /* by the stages of this step, which may yet fail */
    bool accounted;             /* the scene's balance asks what impacts take */
    double taken;               /* [J] of the energy, by impacts since the start; 0 unless accounted */
};

/* The walls of the body's scene; `geometry` is that of its scheme, `faces` are there. Refuses (SOLVER_BAD_INPUT)
 * schemes in which x' is not v, faces that lead for a time, and faces that hold a particle along a part of a plane's
 * normal. One that is held or moved along all of it goes where it is led. */
bool solver_wall_create(const struct solver_body *body, const struct solver_geometry *geometry,
                        const struct solver_faces *faces, struct solver_wall *wall, struct solver_error *error);
void solver_wall_arrays(const struct solver_wall *wall, size_t particles, struct solver_cost_arrays *arrays);
/* Where nothing is stopped. */
void solver_wall_terms(const struct solver_wall *wall, int stages, struct solver_cost_terms *terms);
void solver_wall_free(struct solver_wall *wall);
/* Refuses (SOLVER_BAD_INPUT) a body of which a part lies behind the wall. */
bool solver_wall_check(const struct solver_wall *wall, const struct solver_body *body, const struct solver_state *state,
                       struct solver_error *error);

/* Before the first stage of a step of size dt. What it takes stays taken if the step fails. */
void solver_wall_begin(struct solver_wall *wall, const struct solver_state *state, double dt);
/* After a stage's update and the constraints of faces. */
void solver_wall_stop(struct solver_wall *wall, const struct solver_state *state,
                      const struct solver_integrator *integrator, int stage);
/* Of a step that has not failed: its impulse and the energy taken are final. */
void solver_wall_end(struct solver_wall *wall, const struct solver_state *state);
/* For checkpoints (keep.h). */
bool solver_wall_keep(struct solver_wall *wall, struct solver_keeper *keeper, struct solver_error *error);

#endif
