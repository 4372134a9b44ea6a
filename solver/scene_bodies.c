/* Reads where bodies are: a box or a round body by `domain` or several shapes by `bodies`, and what lattice and faces
 * allow each other. */
#include "solver/cloud.h"
#include "solver/scene_internal.h"
#include "solver/stencil.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

int solver_scene_wall(const struct solver_scene *scene, int face)
{
    bool held = scene->face[face] == SOLVER_CLAMPED || scene->face[face] == SOLVER_MOTION;
    return scene->lattice == SOLVER_CENTRES && held ? scene->wall : 0;
}

/* An upper corner above the lower one along every axis. */
static void check_corners(lua_State *L, int dim, const char *key, const double *lower, const double *upper)
{
    for (int d = 0; d < dim; d++) {
        double edge = upper[d] - lower[d];
        if (!(edge > 0) || !isfinite(edge))
            scene_refuse(L, "%s.upper[%d]: expected a number above %s.lower[%d] = %g, got %g", key, d + 1, key, d + 1,
                         lower[d], upper[d]);
    }
}

/* --- one body --- */

/* The list of `count` numbers under `name` in the table on top of the stack. */
static void read_list(lua_State *L, const char *key, const char *name, double *out, int count)
{
    char path[2 * SOLVER_NAME];
    snprintf(path, sizeof path, "%s.%s", key, name);
    lua_getfield(L, -1, name);
    scene_read_numbers(L, path, -1, out, (size_t)count);
    lua_pop(L, 1);
}

static double read_length(lua_State *L, const char *key, const char *name)
{
    char path[2 * SOLVER_NAME];
    snprintf(path, sizeof path, "%s.%s", key, name);
    lua_getfield(L, -1, name);
    double length = scene_read_number(L, path, -1, DBL_MIN, DBL_MAX, "number > 0 [m]");
    lua_pop(L, 1);
    return length;
}

/* Refuses keys of the table on top of the stack that are not among `known`, words with spaces around. */
static void check_keys(lua_State *L, const char *key, const char *known)
{
    for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1)) {
        char word[SOLVER_NAME];
        const char *name = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : "1";
        snprintf(word, sizeof word, " %.60s ", name);
        if (!strstr(known, word))
            scene_refuse(L, "%s.%.60s: unknown key; expected%s", key, name, known);
    }
}

static void read_ring(lua_State *L, const char *key, struct solver_shape *ring)
{
    check_keys(L, key, " shape centre inner outer ");
    ring->kind = SOLVER_SHAPE_RING;
    read_list(L, key, "centre", ring->centre, 2);
    ring->inner = read_length(L, key, "inner");
    ring->outer = read_length(L, key, "outer");
    if (!(ring->inner < ring->outer))
        scene_refuse(L, "%s.outer: expected a number above %s.inner = %g, got %g", key, key, ring->inner, ring->outer);
    for (int d = 0; d < 2; d++) {
        ring->lower[d] = ring->centre[d] - ring->outer;
        ring->upper[d] = ring->centre[d] + ring->outer;
    }
}

/* The body on top of the stack. */
static void read_body(lua_State *L, const struct solver_scene *scene, const char *key, struct solver_shape *shape)
{
    static const char expected[] = "{ shape = \"box\", lower = { ... }, upper = { ... } } or { shape = \"ring\", "
                                   "centre = {x, y}, inner = r, outer = R }";
    char path[2 * SOLVER_NAME];
    if (!lua_istable(L, -1))
        scene_refuse_value(L, key, expected, -1);
    lua_getfield(L, -1, "shape");
    snprintf(path, sizeof path, "%s.shape", key);
    const char *kind = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "";
    if (strcmp(kind, "box") != 0 && strcmp(kind, "ring") != 0)
        scene_refuse_value(L, path, "\"box\" or \"ring\"", -1);
    bool ring = kind[0] == 'r';
    lua_pop(L, 1);
    if (ring) {
        if (scene->dim != 2)
            scene_refuse(L, "%s: a ring lies in the plane; expected dim = 2, got %d", path, scene->dim);
        read_ring(L, key, shape);
    } else {
        check_keys(L, key, " shape lower upper ");
        shape->kind = SOLVER_SHAPE_BOX;
        read_list(L, key, "lower", shape->lower, scene->dim);
        read_list(L, key, "upper", shape->upper, scene->dim);
        check_corners(L, scene->dim, key, shape->lower, shape->upper);
    }
}

/* --- all of them --- */

/* The box around them is the scene's domain. */
static void read_bodies(lua_State *L, struct solver_scene *scene)
{
    scene->shape_count = scene_list_length(L, "bodies", SOLVER_BODIES, false);
    if (scene->shape_count == 0)
        scene_refuse(L, "bodies: expected one body or more, got an empty list");
    for (size_t i = 0; i < scene->shape_count; i++) {
        char key[32];
        snprintf(key, sizeof key, "bodies[%zu]", i + 1);
        lua_rawgeti(L, -1, (lua_Integer)i + 1);
        read_body(L, scene, key, &scene->shape[i]);
        lua_pop(L, 1);
        for (int d = 0; d < scene->dim; d++) {
            scene->lower[d] = i == 0 ? scene->shape[i].lower[d] : fmin(scene->lower[d], scene->shape[i].lower[d]);
            scene->upper[d] = i == 0 ? scene->shape[i].upper[d] : fmax(scene->upper[d], scene->shape[i].upper[d]);
        }
    }
    if (scene->reference_length == 0)
        scene_refuse(L, "reference_length: missing; expected number > 0 [m]: bodies have no edge that stands for all");
    if (scene->lattice != SOLVER_CENTRES)
        scene_refuse(L, "lattice: bodies have their particles in the centres of cells; expected \"centres\", got "
                        "\"nodes\"");
    if (scene->perturb > 0)
        scene_refuse(L, "perturb: expected 0 with bodies, got %g; a domain can be perturbed", scene->perturb);
}

/* --- graded lattices --- */

/* Lines of a box alone have spacings that change, and stencils along lines alone follow them: where pairs are found by
 * a radius there is one for all. */
static void check_grading(lua_State *L, const struct solver_scene *scene)
{
    const struct solver_stencil_builder *builder = solver_stencil_find(scene->stencil);
    for (int d = 0; d < 3; d++) {
        if (solver_grading_is_even(&scene->grading[d]))
            continue;
        const char axis = "XYZ"[d];
        if (d >= scene->dim)
            scene_refuse(L, "grading.%c: a body of dim = %d has no such axis", axis, scene->dim);
        if (scene->shape_count > 0 || scene->domain.kind != SOLVER_SHAPE_BOX)
            scene_refuse(L, "grading.%c: expected 1 but in a domain that is a box", axis);
        if (scene->lattice != SOLVER_NODES)
            scene_refuse(L, "grading.%c: expected lattice = \"nodes\" with it, got \"centres\"", axis);
        if (scene->perturb > 0)
            scene_refuse(L, "grading.%c: expected perturb = 0 with it, got %g", axis, scene->perturb);
        if (strcmp(scene->scheme, "ulsph") == 0)
            scene_refuse(L,
                         "grading.%c: the kernel of scheme = \"ulsph\" has one support for all particles; expected "
                         "upwind or jst",
                         axis);
        if (builder != NULL && !builder->lattice_only)
            scene_refuse(L,
                         "grading.%c: stencil = \"%s\" has one support for all particles; expected sbp2 or sbp4, along "
                         "lattice lines",
                         axis, scene->stencil);
    }
}

/* --- a domain --- */

static const char *const shape_names[] = {"box", "disc", "ball", "cylinder", "solid", "stl"};

/* Refuses a domain that lacks one of its shape's keys, or has one of another's. */
static void check_domain_keys(lua_State *L, enum solver_shape_kind shape)
{
    static const struct {
        const char *key;
        bool of[6]; /* the shapes, in their order */
    } wanted[] = {{"domain.lower", {1, 0, 0, 0, 1, 1}},  {"domain.upper", {1, 0, 0, 0, 1, 1}},
                  {"domain.centre", {0, 1, 1, 1, 0, 0}}, {"domain.radius", {0, 1, 1, 1, 0, 0}},
                  {"domain.length", {0, 0, 0, 1, 0, 0}}, {"domain.distance", {0, 0, 0, 0, 1, 0}},
                  {"domain.file", {0, 0, 0, 0, 0, 1}}};
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        const struct solver_scene_key *key = &solver_scene_keys()[scene_key_find(wanted[i].key)];
        scene_lua_push(L, key->key);
        bool given = !lua_isnil(L, -1);
        if (given && !wanted[i].of[shape])
            scene_refuse(L, "%s: a domain of domain.shape = \"%s\" has none", key->key, shape_names[shape]);
        if (!given && wanted[i].of[shape])
            scene_refuse(L, "%s: missing; expected %s (%s), or bodies = { ... } in place of domain", key->key,
                         key->expects, key->meaning);
        lua_pop(L, 1);
    }
}

/* The plain keys are there; adds the box around. */
static void check_round(lua_State *L, struct solver_scene *scene)
{
    const struct solver_shape *shape = &scene->domain;
    const char *name = shape_names[shape->kind];
    int dim = shape->kind == SOLVER_SHAPE_DISC ? 2 : 3;
    if (scene->dim != dim)
        scene_refuse(L, "domain.shape: a %s lies in %dD; expected dim = %d, got %d", name, dim, dim, scene->dim);
    if (scene->lattice != SOLVER_NODES)
        scene_refuse(L, "lattice: a %s has particles on its surface; expected \"nodes\", got \"centres\"", name);
    if (scene->perturb > 0)
        scene_refuse(L, "perturb: expected 0 with a %s, got %g; a box can be perturbed", name, scene->perturb);
    for (int d = 0; d < scene->dim; d++) {
        double half = d == 2 && shape->kind == SOLVER_SHAPE_CYLINDER ? shape->length / 2 : shape->outer;
        scene->lower[d] = shape->centre[d] - half;
        scene->upper[d] = shape->centre[d] + half;
    }
}

/* The plain keys are there. */
static void check_solid(lua_State *L, const struct solver_scene *scene)
{
    check_corners(L, scene->dim, "domain", scene->lower, scene->upper);
    if (scene->dim < 2)
        scene_refuse(L, "domain.shape: a solid lies in 2D or 3D; expected dim = 2 or 3, got %d", scene->dim);
    if (scene->domain.kind == SOLVER_SHAPE_STL && scene->dim != 3)
        scene_refuse(L, "domain.shape: a file of triangles lies in 3D; expected dim = 3, got %d", scene->dim);
    if (scene->lattice != SOLVER_NODES)
        scene_refuse(L, "lattice: a solid has particles on its surface; expected \"nodes\", got \"centres\"");
    if (scene->perturb > 0)
        scene_refuse(L, "perturb: expected 0 with a solid, got %g; a box can be perturbed", scene->perturb);
}

static void check_domain(lua_State *L, struct solver_scene *scene)
{
    enum solver_shape_kind kind = scene->domain.kind;
    bool box = solver_shape_in_box(kind);
    check_domain_keys(L, kind);
    if (kind == SOLVER_SHAPE_BOX)
        check_corners(L, scene->dim, "domain", scene->lower, scene->upper);
    else if (box)
        check_solid(L, scene);
    else
        check_round(L, scene);
    scene_read_symmetry(L, scene);
    if (scene->reference_length == 0) /* not given */
        scene->reference_length = box ? scene->upper[0] - scene->lower[0] : scene->domain.outer;
}

void scene_read_bodies(lua_State *L, struct solver_scene *scene)
{
    scene_lua_push(L, "domain");
    bool domain = !lua_isnil(L, -1);
    bool bodies = scene_push_table(L, "bodies", "a list of { shape = \"box\" or \"ring\", ... }");
    if (domain && bodies)
        scene_refuse(L, "bodies: the scene has a domain besides; expected one of the two");
    if (bodies)
        read_bodies(L, scene);
    else
        check_domain(L, scene);
    check_grading(L, scene);
    lua_pop(L, 2);
}

/* --- faces --- */

/* Whether a domain has a face (0..6). */
static bool has_face(const struct solver_scene *scene, int face)
{
    enum solver_shape_kind shape = scene->domain.kind;
    if (face < SOLVER_SURFACE && face % 2 == 0 && scene->domain.cut[face / 2])
        return true;
    return shape == SOLVER_SHAPE_BOX        ? face < SOLVER_SURFACE
           : solver_shape_in_box(shape)     ? true
           : shape == SOLVER_SHAPE_CYLINDER ? face >= 4
                                            : face == SOLVER_SURFACE;
}

void scene_check_faces(lua_State *L, const struct solver_scene *scene)
{
    for (int f = 0; f < SOLVER_FACES; f++) {
        char key[16] = "faces.surface", kind[SOLVER_NAME];
        if (f < SOLVER_SURFACE)
            snprintf(key, sizeof key, "faces.%c%d", "XYZ"[f / 2], f % 2);
        if (scene->face[f] == SOLVER_FREE)
            continue;
        scene_word_at(scene_face_kinds, (int)scene->face[f], kind, sizeof kind);
        if (scene->shape_count > 0)
            scene_refuse(L, "%s: '%s' is a condition on a face of the domain, and bodies are free all around", key,
                         kind);
        if (!has_face(scene, f))
            scene_refuse(L, "%s: a domain of domain.shape = \"%s\" has no such face", key,
                         shape_names[scene->domain.kind]);
        if (f == SOLVER_SURFACE &&
            (scene->face[f] == SOLVER_SYMMETRIC || scene->face[f] == SOLVER_SKEW || scene->face[f] == SOLVER_ROLLER))
            scene_refuse(L, "%s: '%s' is a condition on a plane; expected free, clamped, traction or motion", key,
                         kind);
        if (scene->lattice == SOLVER_NODES)
            continue;
        if (solver_scene_wall(scene, f) == 0)
            scene_refuse(L,
                         "%s: '%s' acts on particles that lie on the face; expected lattice = \"nodes\", or free, "
                         "clamped or motion with \"centres\"",
                         key, kind);
        if (isfinite(scene->face_until[f]))
            scene_refuse(L,
                         "%s.free_after: with lattice = \"centres\" a wall moves the face, and let go it would stay, a "
                         "mass too much; expected lattice = \"nodes\"",
                         key);
        if (scene->wall < scene->support)
            scene_refuse(L, "wall: %d layers beyond %s are thinner than the support of %g spacings; expected %d",
                         scene->wall, key, scene->support, (int)ceil(scene->support));
    }
}
