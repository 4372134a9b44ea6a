/* A rigid plane wall that stands still, without friction: particles on the surface of a body do not pass it, and are
 * not held by it.
 *
 * 004_0c0448173ed5e9bd.txt reflects the momentum of a particle that has passed the wall and puts it back onto it. Here
 * none passes: a surface particle at the distance g from the wall when a step of size dt begins must not approach it
 * faster than g/dt, at that moment and at every stage. A Runge-Kutta step moves it by dt times a mean of the velocities
 * of its stages (x' = v, weights that are positive and sum to 1), so that the step ends at a distance of g - dt g/dt =
 * 0 or more, whatever the integrator. What would approach faster has the excess taken from its velocity along the
 * normal, as an inelastic impact of one particle would; the rebound is the body's. A particle that its body pulls away
 * is let go.
 *
 * The impulse [N s] on the wall is exact: what a stage takes enters the velocity at the end of the step with the
 * product of the weights `keep` of the later stages (integrator.h), and is counted so. Impulse and momentum of the body
 * add up to what they were to round-off. */
#ifndef SOLVER_WALL_H
#define SOLVER_WALL_H

#include "solver/faces.h"
#include "solver/integrator.h"
#include "solver/scheme.h"
#include "solver/state.h"

/* A surface particle that may meet the wall. */
struct solver_wall_site {
    uint32_t particle;
    double mass;  /* [kg]; per unit thickness in 2D, per unit area in 1D */
    double bound; /* [m/s] least velocity along the normal in this step, at most 0 */
};

struct solver_wall {
    size_t dim;
    size_t count; /* of sites; 0: the scene has no wall */
    struct solver_wall_site *site;
    double point[3], normal[3]; /* [m]; unit, towards the body */
    double impulse[3];          /* [N s] handed to the wall since the start */
    double stepping[3];         /* by the stages of this step, which may yet fail */
};

/* The wall of the body's scene; `geometry` is that of its scheme, `faces` are there. Refuses (SOLVER_BAD_INPUT) schemes
 * in which x' is not v, and faces that hold a particle along a part of the normal. One that is held or moved along all
 * of it goes where it is led. */
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
/* Of a step that has not failed: its impulse is final. */
void solver_wall_end(struct solver_wall *wall);

#endif
