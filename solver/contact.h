/* Contact between bodies: wherever two particles of different bodies are nearer than a distance and approach one
 * another, a force along their line stops it within the step. As printed (001_363f711843f01da4.txt eq. 53, 54) it stops
 * the velocity at which they approach now, so that what presses them together in this step they are free to do until
 * the next: pressed bodies go into one another by a velocity that is proportional to the step. Predicted, it stops the
 * velocity at which they would approach at the end of the step. Equal and opposite: momentum is kept to round-off. */
#ifndef SOLVER_CONTACT_H
#define SOLVER_CONTACT_H

#include "solver/scheme.h"
#include "solver/skin.h"

struct solver_contact {
    enum solver_contact_law law;
    double distance;         /* [m] */
    struct solver_skin skin; /* pairs between bodies */
    double *mass;            /* [count] */
    double begin, end;       /* [s] when it first and last acted; NaN: it never did */
};

/* Law and distance as the body's scene says; V: as in struct solver_geometry. */
bool solver_contact_create(const struct solver_body *body, const double *V, struct solver_contact *contact,
                           struct solver_error *error);
void solver_contact_arrays(const struct solver_contact *contact, struct solver_cost_arrays *arrays);
/* Of bodies that are near but do not press each other. */
void solver_contact_terms(const struct solver_contact *contact, struct solver_cost_terms *terms);
void solver_contact_free(struct solver_contact *contact);
/* Adds the forces at positions x, velocities v and time t to the accelerations v_rate, in a step of size dt [s]; padded
 * vectors of `lanes`. SOLVER_BROKE_DOWN where bodies could go through one another within the step. */
bool solver_contact_act(struct solver_contact *contact, const double *x, const double *v, size_t lanes, double t,
                        double dt, double *v_rate, struct solver_error *error);
/* For checkpoints (keep.h). */
bool solver_contact_keep(struct solver_contact *contact, struct solver_keeper *keeper, struct solver_error *error);

#endif
