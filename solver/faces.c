#include "solver/faces.h"

#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Which axes a face constrains, by its kind: the normal, the others, or all. A curved one holds all or none. */
static unsigned constrained_axes(enum solver_face_kind kind, unsigned normal, unsigned dim)
{
    unsigned all = (1U << dim) - 1U;
    switch (kind) {
    case SOLVER_SYMMETRIC:
        return 1U << normal;
    case SOLVER_SKEW:
        return all & ~(1U << normal);
    case SOLVER_CLAMPED:
    case SOLVER_MOTION:
        return all;
    case SOLVER_FREE:
    case SOLVER_TRACTION:
        break;
    }
    return 0;
}

/* A mirror image in one face moves the other way, an image in two as the particle itself. */
static void set_image(struct solver_constraint *constraint, const struct solver_cloud *cloud)
{
    size_t body = cloud->count - cloud->wall_count;
    size_t a = constraint->particle;
    constraint->image = constraint->particle;
    if (cloud->image != NULL && a >= body) {
        constraint->image = cloud->image[a - body];
        constraint->parity = __builtin_popcount(cloud->tags[a] >> SOLVER_BEYOND_FACE) % 2 == 1 ? -1.0 : 1.0;
    }
}

bool solver_faces_create(const struct solver_body *body, const struct solver_geometry *geometry,
                         struct solver_faces *faces, struct solver_error *error)
{
    const struct solver_scene *scene = body->scene;
    const struct solver_cloud *cloud = body->cloud;
    unsigned dim = (unsigned)cloud->dim;
    *faces = (struct solver_faces){.dim = cloud->dim, .body_force = solver_scene_has(scene, SOLVER_BODY_FORCE)};
    size_t most = geometry->face_point_count + cloud->wall_count;
    if (!solver_alloc((void **)&faces->constraint, most, sizeof *faces->constraint, "constraints", error) ||
        !solver_alloc((void **)&faces->load, geometry->face_point_count, sizeof *faces->load, "loads", error)) {
        return false;
    }
    for (size_t a = 0; a < cloud->count; a++) {
        unsigned axes = 0;
        unsigned lasting = 0;
        int motion = -1;
        bool clamped = false;
        for (unsigned face = 0; face < SOLVER_FACES; face++) {
            uint32_t bits = cloud->tags[a] >> SOLVER_ON_FACE | cloud->tags[a] >> SOLVER_BEYOND_FACE;
            if ((bits >> face & 1U) == 0) {
                continue;
            }
            axes |= constrained_axes(scene->face[face], face / 2, dim);
            lasting |= scene->face[face] == SOLVER_MOTION ? 0 : constrained_axes(scene->face[face], face / 2, dim);
            clamped = clamped || scene->face[face] == SOLVER_CLAMPED;
            motion =
                scene->face[face] == SOLVER_MOTION && motion < 0 ? (int)face : motion; /* the first of several leads */
        }
        if (axes == 0) {
            continue;
        }
        struct solver_constraint *constraint = &faces->constraint[faces->constraint_count++];
        constraint->particle = (uint32_t)a;
        set_image(constraint, cloud);
        constraint->motion = clamped ? -1 : motion; /* where a clamped face meets a moving one, it holds */
        constraint->until = constraint->motion >= 0 ? scene->face_until[constraint->motion] : INFINITY;
        for (unsigned axis = 0; axis < dim; axis++) {
            constraint->keep[axis * dim + axis] = (axes >> axis & 1U) != 0 ? 0.0 : 1.0;
            constraint->after[axis * dim + axis] = (lasting >> axis & 1U) != 0 ? 0.0 : 1.0;
        }
    }
    for (size_t i = 0; i < geometry->face_point_count; i++) {
        if (scene->face[geometry->face_point[i].face] == SOLVER_TRACTION) {
            faces->load[faces->load_count++] = geometry->face_point[i];
        }
    }
    return true;
}

void solver_faces_free(struct solver_faces *faces)
{
    free(faces->constraint);
    free(faces->load);
    *faces = (struct solver_faces){.constraint = NULL};
}

static void place(const struct solver_cloud *cloud, size_t a, double X[3])
{
    for (int axis = 0; axis < 3; axis++) {
        X[axis] = axis < cloud->dim ? cloud->X[a * (size_t)cloud->dim + (size_t)axis] : 0.0;
    }
}

/* The velocity that a constraint prescribes at particle a; 0 where it holds. */
static bool prescribe(const struct solver_constraint *constraint, const struct solver_body *body, size_t a, double t,
                      double velocity[3], struct solver_error *error)
{
    double X[3];
    memset(velocity, 0, 3 * sizeof *velocity);
    if (constraint->motion < 0 || t > constraint->until) {
        return true;
    }
    place(body->cloud, a, X);
    return solver_scene_eval(body->scene, (enum solver_formula)(SOLVER_FACE_X0 + constraint->motion), X, t, velocity,
                             (size_t)body->cloud->dim, error);
}

bool solver_faces_constrain(const struct solver_faces *faces, const struct solver_body *body, double t, size_t lanes,
                            double *v, struct solver_error *error)
{
    size_t dim = (size_t)faces->dim;
    for (size_t c = 0; c < faces->constraint_count; c++) {
        const struct solver_constraint *constraint = &faces->constraint[c];
        double *at = v + constraint->particle * lanes;
        const double *of_image = v + constraint->image * lanes;
        double free_part[3] = {0};
        double velocity[3];
        double image_velocity[3];
        bool mirrored = constraint->image != constraint->particle;
        const double *keep = t <= constraint->until ? constraint->keep : constraint->after;
        if (!prescribe(constraint, body, constraint->particle, t, velocity, error) ||
            (mirrored && !prescribe(constraint, body, constraint->image, t, image_velocity, error))) {
            return false;
        }
        for (size_t i = 0; i < dim; i++) {
            free_part[i] = mirrored ? constraint->parity * (of_image[i] - image_velocity[i]) : 0.0;
            for (size_t j = 0; j < dim; j++) {
                free_part[i] += keep[i * dim + j] * at[j];
            }
        }
        for (size_t i = 0; i < dim; i++) {
            at[i] = free_part[i] + velocity[i];
        }
    }
    return true;
}

bool solver_faces_load(const struct solver_faces *faces, const struct solver_body *body,
                       const struct solver_geometry *geometry, double t, size_t lanes, const double *v, double *v_rate,
                       double *power, struct solver_error *error)
{
    const struct solver_scene *scene = body->scene;
    const struct solver_cloud *cloud = body->cloud;
    const struct solver_material_constants *constants = body->constants;
    const double *V = geometry->V;
    size_t stride = body->stride;
    size_t dim = (size_t)faces->dim;
    double X[3];
    double value[3];
    *power = 0.0;
    for (size_t i = 0; i < faces->load_count; i++) {
        const struct solver_face_point *load = &faces->load[i];
        size_t a = load->particle;
        double area = 0.0;
        place(cloud, a, X);
        if (!solver_scene_eval(scene, (enum solver_formula)(SOLVER_FACE_X0 + (int)load->face), X, t, value, dim,
                               error)) {
            return false;
        }
        for (size_t axis = 0; axis < dim; axis++) {
            area += load->area[axis] * load->area[axis];
        }
        area = sqrt(area);
        for (size_t axis = 0; axis < dim; axis++) {
            v_rate[a * lanes + axis] += area * value[axis] / (V[a] * constants[a * stride].rho);
            *power += area * value[axis] * v[a * lanes + axis];
        }
    }
    for (size_t a = 0; faces->body_force && a < cloud->count; a++) {
        place(cloud, a, X);
        if (!solver_scene_eval(scene, SOLVER_BODY_FORCE, X, t, value, dim, error)) {
            return false;
        }
        for (size_t axis = 0; axis < dim; axis++) {
            v_rate[a * lanes + axis] += value[axis] / constants[a * stride].rho;
            *power += V[a] * value[axis] * v[a * lanes + axis];
        }
    }
    return true;
}
