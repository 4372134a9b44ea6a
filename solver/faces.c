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
    case SOLVER_ROLLER:
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

static bool is_moved(enum solver_face_kind kind)
{
    return kind == SOLVER_MOTION || kind == SOLVER_ROLLER;
}

/* The formula of the traction that a face prescribes; SOLVER_FORMULAS if it prescribes none. */
static enum solver_formula traction_of(const struct solver_scene *scene, unsigned face)
{
    enum solver_formula shear = (enum solver_formula)(SOLVER_SHEAR_X0 + (int)face);
    if (scene->face[face] == SOLVER_TRACTION) {
        return (enum solver_formula)(SOLVER_FACE_X0 + (int)face);
    }
    return scene->face[face] == SOLVER_ROLLER && solver_scene_has(scene, shear) ? shear : SOLVER_FORMULAS;
}

/* A mirror image in one face moves the other way, an image in two as the particle itself. */
static void set_image(struct solver_constraint *constraint, const struct solver_cloud *cloud)
{
    size_t body = cloud->count - cloud->wall_count;
    size_t a = constraint->particle;
    constraint->image = constraint->particle;
    if (cloud->image != NULL && cloud->symmetry == NULL && a >= body) {
        constraint->image = cloud->image[a - body];
        constraint->parity = __builtin_popcount(cloud->tags[a] >> SOLVER_BEYOND_FACE) % 2 == 1 ? -1.0 : 1.0;
    }
}

/* Adds what one face does to a particle on it, or in the wall beyond it. */
static void add_face(const struct solver_scene *scene, unsigned face, unsigned dim,
                     struct solver_constraint *constraint)
{
    enum solver_face_kind kind = scene->face[face];
    unsigned axes = constrained_axes(kind, face / 2, dim);
    for (unsigned i = 0; i < dim; i++) {
        struct solver_held *axis = &constraint->axis[i];
        if ((axes >> i & 1U) == 0) {
            continue;
        }
        axis->held = true;
        axis->after = axis->after || !is_moved(kind);
        if (is_moved(kind) && axis->motion < 0) { /* the first of several leads */
            axis->motion = (int)face;
            axis->until = scene->face_until[face];
        }
    }
}

/* Whether the face acts on a particle that lies on it: not on one outside of the part that is moved. */
static bool reaches(const struct solver_scene *scene, const struct solver_cloud *cloud, size_t a, unsigned face)
{
    double give = 1e-9 * cloud->spacing;
    bool within = true;
    for (size_t i = 0; i < (size_t)cloud->dim; i++) {
        double X = cloud->X[a * (size_t)cloud->dim + i];
        within = within && X >= scene->face_within[face][0][i] - give && X <= scene->face_within[face][1][i] + give;
    }
    return within;
}

/* The constraint of particle a; false if it has none. A moved face leads all axes, where it meets rollers and faces
 * that hold along theirs; where a clamped face meets it, that holds. */
static bool constrain_by_faces(const struct solver_scene *scene, const struct solver_cloud *cloud, size_t a,
                               struct solver_constraint *constraint)
{
    unsigned dim = (unsigned)cloud->dim;
    uint32_t bits = cloud->tags[a] >> SOLVER_ON_FACE | cloud->tags[a] >> SOLVER_BEYOND_FACE;
    bool clamped = false;
    bool any = false;
    for (unsigned i = 0; i < dim; i++) {
        constraint->axis[i] = (struct solver_held){.motion = -1, .until = INFINITY};
    }
    for (int rollers = 0; rollers < 2; rollers++) {
        for (unsigned face = 0; face < SOLVER_FACES; face++) {
            if ((bits >> face & 1U) != 0 && (scene->face[face] == SOLVER_ROLLER) == (rollers == 1) &&
                reaches(scene, cloud, a, face)) {
                add_face(scene, face, dim, constraint);
                clamped = clamped || scene->face[face] == SOLVER_CLAMPED;
            }
        }
    }
    for (unsigned i = 0; i < dim; i++) {
        struct solver_held *axis = &constraint->axis[i];
        axis->motion = clamped ? -1 : axis->motion;
        any = any || axis->held;
    }
    return any;
}

/* Room for the constraints and loads that there are, and none where there are none. */
static bool reserve(struct solver_faces *faces, const struct solver_body *body, const struct solver_geometry *geometry,
                    struct solver_error *error)
{
    const struct solver_scene *scene = body->scene;
    size_t constraints = 0;
    size_t loads = 0;
    for (size_t a = 0; a < body->cloud->count; a++) {
        struct solver_constraint constraint = {.particle = (uint32_t)a};
        constraints += constrain_by_faces(scene, body->cloud, a, &constraint) ? 1 : 0;
    }
    for (size_t i = 0; i < geometry->face_point_count; i++) {
        loads += traction_of(scene, geometry->face_point[i].face) != SOLVER_FORMULAS ? 1 : 0;
    }
    return (constraints == 0 ||
            solver_alloc((void **)&faces->constraint, constraints, sizeof *faces->constraint, "constraints", error)) &&
           (loads == 0 || solver_alloc((void **)&faces->load, loads, sizeof *faces->load, "loads", error));
}

bool solver_faces_create(const struct solver_body *body, const struct solver_geometry *geometry,
                         struct solver_faces *faces, struct solver_error *error)
{
    const struct solver_scene *scene = body->scene;
    const struct solver_cloud *cloud = body->cloud;
    *faces = (struct solver_faces){.dim = cloud->dim, .force_time = NAN};
    if (!reserve(faces, body, geometry, error) ||
        (solver_scene_has(scene, SOLVER_BODY_FORCE) &&
         !solver_alloc((void **)&faces->force, cloud->count * (size_t)cloud->dim, sizeof *faces->force, "body force",
                       error))) {
        return false;
    }
    for (size_t a = 0; a < cloud->count; a++) {
        struct solver_constraint constraint = {.particle = (uint32_t)a};
        if (constrain_by_faces(scene, cloud, a, &constraint)) {
            set_image(&constraint, cloud);
            faces->constraint[faces->constraint_count++] = constraint;
        }
    }
    for (unsigned face = 0; face < SOLVER_FACES; face++) {
        faces->moved = faces->moved || is_moved(scene->face[face]);
    }
    for (size_t i = 0; i < geometry->face_point_count; i++) {
        if (traction_of(scene, geometry->face_point[i].face) != SOLVER_FORMULAS) {
            faces->load[faces->load_count++] = geometry->face_point[i];
        }
    }
    return solver_faces_list_still(faces, error);
}

void solver_faces_free(struct solver_faces *faces)
{
    free(faces->constraint);
    free(faces->still);
    free(faces->load);
    free(faces->force);
    *faces = (struct solver_faces){.constraint = NULL};
}

static void place(const struct solver_cloud *cloud, size_t a, double X[3])
{
    for (int axis = 0; axis < 3; axis++) {
        X[axis] = axis < cloud->dim ? cloud->X[a * (size_t)cloud->dim + (size_t)axis] : 0.0;
    }
}

/* The velocity that a constraint prescribes at particle a, along each axis; 0 where it holds. */
static bool prescribe(const struct solver_constraint *constraint, const struct solver_body *body, size_t a, double t,
                      double velocity[3], struct solver_error *error)
{
    size_t dim = (size_t)body->cloud->dim;
    double X[3];
    double of_face[3];
    int asked = -1;
    place(body->cloud, a, X);
    for (size_t i = 0; i < dim; i++) {
        const struct solver_held *axis = &constraint->axis[i];
        velocity[i] = 0.0;
        if (axis->motion < 0 || t > axis->until) {
            continue;
        }
        if (axis->motion != asked &&
            !solver_scene_eval(body->scene, (enum solver_formula)(SOLVER_FACE_X0 + axis->motion), X, t, of_face, dim,
                               error)) {
            return false;
        }
        asked = axis->motion;
        velocity[i] = of_face[i];
    }
    return true;
}

/* Gives the particle the velocity that is prescribed, and its image's that of the image. */
static void set_velocity(const struct solver_faces *faces, const struct solver_constraint *constraint, double t,
                         const struct solver_vectors *v, const double velocity[3], const double image_velocity[3])
{
    bool mirrored = constraint->image != constraint->particle;
    for (size_t i = 0; i < (size_t)faces->dim; i++) {
        bool held = solver_held_at(&constraint->axis[i], t);
        double of_image = solver_vectors_get(v, constraint->image, i);
        double own = solver_vectors_get(v, constraint->particle, i);
        double free_part = mirrored ? constraint->parity * (of_image - image_velocity[i]) : 0.0;
        solver_vectors_set(v, constraint->particle, i, free_part + (held ? 0.0 : own) + velocity[i]);
    }
}

bool solver_faces_constrain(const struct solver_faces *faces, const struct solver_body *body, double t,
                            struct solver_vectors v, struct solver_error *error)
{
    if (faces->only_hold) {
        solver_faces_hold(faces, v, 0, body->cloud->count);
        return true;
    }
    for (size_t c = 0; c < faces->constraint_count; c++) {
        const struct solver_constraint *constraint = &faces->constraint[c];
        double velocity[3] = {0};
        double image_velocity[3] = {0};
        bool mirrored = constraint->image != constraint->particle;
        if (!prescribe(constraint, body, constraint->particle, t, velocity, error) ||
            (mirrored && !prescribe(constraint, body, constraint->image, t, image_velocity, error))) {
            return false;
        }
        set_velocity(faces, constraint, t, &v, velocity, image_velocity);
    }
    return true;
}

/* Of a mirrored wall's velocity and its image's the face has the mean, where they are opposite against it. */
double solver_faces_driven(const struct solver_faces *faces, const struct solver_body *body, double t,
                           struct solver_vectors v)
{
    double energy = 0.0;
    for (size_t c = 0; c < faces->constraint_count; c++) {
        const struct solver_constraint *constraint = &faces->constraint[c];
        size_t a = constraint->particle;
        size_t other = constraint->parity < 0.0 ? constraint->image : a;
        double square = 0.0;
        for (size_t i = 0; i < (size_t)faces->dim; i++) {
            if (constraint->axis[i].motion >= 0 && solver_held_at(&constraint->axis[i], t)) {
                double of_face = 0.5 * (solver_vectors_get(&v, a, i) + solver_vectors_get(&v, other, i));
                square += of_face * of_face;
            }
        }
        energy += 0.5 * body->constants[a * body->stride].rho * body->cloud->V[a] * square;
    }
    return energy;
}

/* Asks for the body force at time t, unless it is that of the last time. Formulas of the scene share an interpreter;
 * what stands in for them may be asked by several threads. */
static bool ask_body_force(struct solver_faces *faces, const struct solver_body *body, double t,
                           struct solver_error *error)
{
    const struct solver_cloud *cloud = body->cloud;
    size_t dim = (size_t)faces->dim;
    bool good = true;
    if (t == faces->force_time) {
        return true;
    }
    faces->force_time = NAN;
#pragma omp parallel for schedule(static) if (body->scene->drive != NULL)
    for (size_t a = 0; a < solver_cloud_driven(cloud); a++) {
        double X[3];
        struct solver_error why;
        place(cloud, a, X);
        if (!solver_scene_eval(body->scene, SOLVER_BODY_FORCE, X, t, faces->force + a * dim, dim, &why)) {
#pragma omp critical(solver_body_force)
            {
                *error = good ? why : *error;
                good = false;
            }
        }
    }
    faces->force_time = good ? t : NAN;
    return good;
}

/* Adds to an acceleration. */
static void accelerate(const struct solver_vectors *v_rate, size_t a, size_t axis, double by)
{
    solver_vectors_set(v_rate, a, axis, solver_vectors_get(v_rate, a, axis) + by);
}

static bool add_body_force(struct solver_faces *faces, const struct solver_body *body,
                           const struct solver_geometry *geometry, double t, const struct solver_vectors *v,
                           const struct solver_vectors *v_rate, double *power, struct solver_error *error)
{
    size_t dim = (size_t)faces->dim;
    if (!ask_body_force(faces, body, t, error)) {
        return false;
    }
    for (size_t a = 0; a < solver_cloud_driven(body->cloud); a++) {
        const double *force = faces->force + a * dim;
        for (size_t axis = 0; axis < dim; axis++) {
            accelerate(v_rate, a, axis, force[axis] / body->constants[a * body->stride].rho);
            *power += geometry->V[a] * force[axis] * solver_vectors_get(v, a, axis);
        }
    }
    return true;
}

bool solver_faces_load(struct solver_faces *faces, const struct solver_body *body,
                       const struct solver_geometry *geometry, double t, struct solver_vectors v,
                       struct solver_vectors v_rate, double *power, struct solver_error *error)
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
        if (!solver_scene_eval(scene, traction_of(scene, load->face), X, t, value, dim, error)) {
            return false;
        }
        for (size_t axis = 0; axis < dim; axis++) {
            area += load->area[axis] * load->area[axis];
        }
        area = sqrt(area);
        for (size_t axis = 0; axis < dim; axis++) {
            accelerate(&v_rate, a, axis, area * value[axis] / (V[a] * constants[a * stride].rho));
            *power += area * value[axis] * solver_vectors_get(&v, a, axis);
        }
    }
    return faces->force == NULL || add_body_force(faces, body, geometry, t, &v, &v_rate, power, error);
}

void solver_faces_arrays(const struct solver_faces *faces, const struct solver_body *body,
                         struct solver_cost_arrays *arrays)
{
    static const char group[] = "faces";
    solver_cost_array(arrays, group, "constraints", faces->constraint, faces->constraint_count,
                      sizeof *faces->constraint);
    solver_cost_array(arrays, group, "particles held", faces->still, faces->constraint_count, sizeof *faces->still);
    solver_cost_array(arrays, group, "loads", faces->load, faces->load_count, sizeof *faces->load);
    solver_cost_array(arrays, group, "body force", faces->force, body->cloud->count * (size_t)faces->dim,
                      sizeof *faces->force);
}

void solver_faces_terms(const struct solver_faces *faces, const struct solver_body *body,
                        struct solver_cost_terms *terms)
{
    double dim = faces->dim;
    double constrained = 0.0;
    double driven = 0.0;
    for (size_t c = 0; c < faces->constraint_count && !faces->only_hold; c++) {
        bool mirrored = faces->constraint[c].image != faces->constraint[c].particle;
        constrained += dim * (mirrored ? 4.0 : 2.0);
        driven += 4.0;
        for (int i = 0; i < faces->dim; i++) {
            driven += faces->constraint[c].axis[i].motion >= 0 ? 4.0 : 0.0;
        }
    }
    double of_force = faces->force != NULL ? 5.0 * dim * (double)body->cloud->count : 0.0;
    solver_cost_term(terms, "faces that hold or move", 0, constrained);
    solver_cost_once(terms, "energy of moved faces", faces->moved ? driven : 0.0);
    solver_cost_term(terms, "tractions", 0, (double)faces->load_count * (2.0 * dim + 1.0 + 7.0 * dim));
    solver_cost_term(terms, "body force", 0, of_force);
}
