/* Contact between bodies: wherever two particles of different bodies are nearer than a distance and approach one
 * another, an impulse along their line stops it (001_363f711843f01da4.txt eq. 53, 54: the force is that impulse over
 * the step, so it is given once per completed step, whatever the integrator's stages are). Equal and opposite: momentum
 * is kept to round-off. */
#ifndef SOLVER_CONTACT_H
#define SOLVER_CONTACT_H

#include "solver/scheme.h"
#include "solver/skin.h"

struct solver_contact {
    enum solver_contact_law law;
    double distance;         /* [m] */
    struct solver_skin skin; /* pairs between bodies */
    double *mass;            /* [count] */
    double *impulse;         /* [impulse_room] of each pair over their distance [kg/s] */
    size_t impulse_room;
};

/* Law and distance as the body's scene says; V: as in struct solver_geometry. */
bool solver_contact_create(const struct solver_body *body, const double *V, struct solver_contact *contact,
                           struct solver_error *error);
void solver_contact_free(struct solver_contact *contact);
/* Gives the impulses to velocities v of particles at x, padded vectors of `lanes`. */
bool solver_contact_apply(struct solver_contact *contact, const double *x, size_t lanes, double *v,
                          struct solver_error *error);

#endif
