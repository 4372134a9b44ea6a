/* Boundary conditions: constraints on the velocity of particles, and loads. What holds or moves a face acts on the
 * particles that lie on it, or on those of the wall beyond it. */
#ifndef SOLVER_FACES_H
#define SOLVER_FACES_H

#include "solver/scheme.h"

/* A particle whose velocity is not free. Along an axis that is held it is 0, along one that is driven that of a face's
 * formula at X and t. A particle on several faces takes the constraints of all of them. One of a mirrored wall moves
 * against its image in the body, so that the face between them has the prescribed velocity, and the velocity is as
 * smooth across the face as it is within the body. */
struct solver_constraint {
    uint32_t particle;
    struct solver_held {
        bool held, after; /* the velocity along the axis is not free; nor is it after `until` */
        int motion;       /* face whose velocity formula it follows until then, or -1 */
        double until;     /* [s] */
    } axis[3];
    uint32_t image; /* particle of whose velocity relative to the face's it has `parity` times; or itself */
    double parity;
};

/* Whether the velocity along a constraint's axis is prescribed at time t. */
static inline bool solver_held_at(const struct solver_held *axis, double t)
{
    return t <= axis->until ? axis->held : axis->after;
}

/* A particle that does not move along the axes of these bits, ever. */
struct solver_still {
    uint32_t particle, axes;
};

struct solver_faces {
    int dim;
    size_t constraint_count;
    struct solver_constraint *constraint; /* by particle */
    bool only_hold;                       /* constraints do no more than hold particles along axes; */
    struct solver_still *still;           /* [constraint_count] which then stand here, too; else NULL */
    bool moved;                           /* some face is moved, which does work that nobody measures */
    size_t load_count;
    struct solver_face_point *load; /* face points of faces that prescribe a traction, or one across the normal */
    double *force;                  /* [count][dim] body force [N/m^3] at force_time; NULL: the scene has none */
    double force_time; /* [s]; stages of a step share times, and what a formula says of one is asked once */
};

/* `geometry` is that of the body's scheme, here and below. */
bool solver_faces_create(const struct solver_body *body, const struct solver_geometry *geometry,
                         struct solver_faces *faces, struct solver_error *error);
void solver_faces_free(struct solver_faces *faces);

void solver_faces_arrays(const struct solver_faces *faces, const struct solver_body *body,
                         struct solver_cost_arrays *arrays);
void solver_faces_terms(const struct solver_faces *faces, const struct solver_body *body,
                        struct solver_cost_terms *terms);

/* Enforces the constraints on v at time t. */
bool solver_faces_constrain(const struct solver_faces *faces, const struct solver_body *body, double t,
                            struct solver_vectors v, struct solver_error *error);
/* The same of particles [begin, end), in a thread, where faces only hold. */
void solver_faces_hold(const struct solver_faces *faces, struct solver_vectors v, size_t begin, size_t end);
/* Fills in `only_hold` and `still` from the constraints. */
bool solver_faces_list_still(struct solver_faces *faces, struct solver_error *error);
/* Kinetic energy [J] that particles have of the motion of the faces which move them at time t; v as it is then. */
double solver_faces_driven(const struct solver_faces *faces, const struct solver_body *body, double t,
                           struct solver_vectors v);
/* Adds tractions and body forces at time t, per unit of reference area and volume, to v_rate; *power [W] becomes their
 * power at velocities v. */
bool solver_faces_load(struct solver_faces *faces, const struct solver_body *body,
                       const struct solver_geometry *geometry, double t, struct solver_vectors v,
                       struct solver_vectors v_rate, double *power, struct solver_error *error);

#endif
