/* Boundary conditions: constraints on the velocity of particles, and loads. */
#ifndef SOLVER_FACES_H
#define SOLVER_FACES_H

#include "solver/material.h"
#include "solver/scene.h"
#include "solver/stencil.h"

/* A particle whose velocity is not free. v <- keep v + prescribed v(X, t). A particle on several faces takes the
 * constraints of all of them. */
struct solver_constraint {
    uint32_t particle;
    int motion;      /* face whose velocity formula it follows, or -1 */
    double keep[9];  /* [dim][dim] projection onto the directions left free */
    double until;    /* [s] the motion ends; what other faces hold stays held */
    double after[9]; /* [dim][dim] the projection from then on */
};

struct solver_faces {
    int dim;
    size_t constraint_count;
    struct solver_constraint *constraint; /* by particle */
    size_t load_count;
    struct solver_face_point *load; /* face points that carry a traction formula */
    bool body_force;
};

bool solver_faces_create(const struct solver_scene *scene, const struct solver_stencil *stencil,
                         const struct solver_cloud *cloud, struct solver_faces *faces, struct solver_error *error);
void solver_faces_free(struct solver_faces *faces);

/* Enforces the constraints on v, padded vectors with the given number of lanes, at time t. */
bool solver_faces_constrain(const struct solver_faces *faces, const struct solver_scene *scene,
                            const struct solver_cloud *cloud, double t, size_t lanes, double *v,
                            struct solver_error *error);
/* Adds tractions and body forces at time t to v_rate, of particles with the constants' densities (stride as in
 * material.h); *power [W] becomes their power at velocities v. */
bool solver_faces_load(const struct solver_faces *faces, const struct solver_scene *scene,
                       const struct solver_cloud *cloud, const struct solver_stencil *stencil,
                       const struct solver_material_constants *constants, size_t stride, double t, size_t lanes,
                       const double *v, double *v_rate, double *power, struct solver_error *error);

#endif
