/* Reads n and the levels of a study; refuses an n whose lattice does not fit the bodies, or the machine. */
#include "solver/scene_internal.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <unistd.h>

/* "18 kB", "3.1 GB" */
static void bytes_text(double bytes, char *out, size_t size)
{
    static const char *const unit[] = {"kB", "MB", "GB", "TB"};
    size_t i = 0;
    for (bytes /= 1e3; bytes >= 1e3 && i < 3; i++)
        bytes /= 1e3;
    snprintf(out, size, "%.3g %s", bytes, unit[i]);
}

/* Whole number of spacings along a length called `what`; they may differ from the spacing by a share of `give`. */
static double spacings_within(lua_State *L, const struct solver_scene *scene, const char *key, double n,
                              const char *what, double length, double give)
{
    double spacing = scene->reference_length / n, spacings = length / spacing;
    if (!(fabs(spacings - round(spacings)) <= give * spacings) || round(spacings) < 1)
        scene_refuse(L, "%s = %.15g: %s, %g m, is %.6g spacings of %g m; expected a whole number", key, n, what, length,
                     spacings, spacing);
    return round(spacings);
}

static double whole_spacings(lua_State *L, const struct solver_scene *scene, const char *key, double n,
                             const char *what, double length)
{
    return spacings_within(L, scene, key, n, what, length, 1e-9);
}

/* Particles of a box, `body` being its name with a colon, or "". */
static double box_particles(lua_State *L, const struct solver_scene *scene, const char *key, double n, const char *body,
                            const double *lower, const double *upper)
{
    double particles = 1;
    for (int d = 0; d < scene->dim; d++) {
        char what[64];
        snprintf(what, sizeof what, "%sthe edge along %c", body, "XYZ"[d]);
        double spacings = whole_spacings(L, scene, key, n, what, upper[d] - lower[d]);
        if (scene->lattice == SOLVER_CENTRES && spacings < 2)
            scene_refuse(L, "%s = %.15g: %s is one spacing; with lattice = \"centres\" at least two are needed", key, n,
                         what);
        for (int f = 2 * d; f < 2 * d + 2; f++)
            spacings += solver_scene_wall(scene, f);
        particles *= spacings + (scene->lattice == SOLVER_NODES ? 1 : 0);
    }
    return particles;
}

static double ring_particles(lua_State *L, const struct solver_scene *scene, const char *key, double n,
                             const char *body, const struct solver_shape *ring)
{
    static const double pi = 3.14159265358979323846;
    char what[64];
    snprintf(what, sizeof what, "%sthe ring's thickness", body);
    double layers = whole_spacings(L, scene, key, n, what, ring->outer - ring->inner);
    if (layers < 2)
        scene_refuse(L, "%s = %.15g: %s is one spacing; at least two are needed", key, n, what);
    return layers * pi * (ring->inner + ring->outer) / (scene->reference_length / n);
}

static double round_particles(lua_State *L, const struct solver_scene *scene, const char *key, double n)
{
    const struct solver_shape *shape = &scene->domain;
    double shells = whole_spacings(L, scene, key, n, "the domain's radius", shape->outer);
    double particles =
        shape->kind == SOLVER_SHAPE_CYLINDER
            ? spacings_within(L, scene, key, n, "the domain's length", shape->length, SOLVER_LAYERS_GIVE) + 1
            : 1;
    for (int axis = 0; axis < (shape->kind == SOLVER_SHAPE_BALL ? 3 : 2); axis++)
        particles *= (shape->cut[axis] ? 1 : 2) * shells + 1;
    return particles;
}

static double count_particles(lua_State *L, const struct solver_scene *scene, const char *key, double n)
{
    double particles = 0;
    if (scene->shape_count == 0 && !solver_shape_in_box(scene->domain.kind))
        return round_particles(L, scene, key, n);
    if (scene->shape_count == 0)
        return box_particles(L, scene, key, n, "", scene->lower, scene->upper);
    for (size_t i = 0; i < scene->shape_count; i++) {
        const struct solver_shape *shape = &scene->shape[i];
        char body[32];
        snprintf(body, sizeof body, "bodies[%zu]: ", i + 1);
        particles += shape->kind == SOLVER_SHAPE_RING
                         ? ring_particles(L, scene, key, n, body, shape)
                         : box_particles(L, scene, key, n, body, shape->lower, shape->upper);
    }
    return particles;
}

static void check_lattice(lua_State *L, const struct solver_scene *scene, const char *key, double n)
{
    static const double per_particle[] = {0, 800, 1500, 3000}; /* bytes of state, stencil and integrator, rounded up */
    double particles = count_particles(L, scene, key, n);
    double needed = particles * per_particle[scene->dim];
    double memory = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    char needed_text[32], memory_text[32];
    bytes_text(needed, needed_text, sizeof needed_text);
    bytes_text(memory, memory_text, sizeof memory_text);
    if (needed > memory)
        scene_refuse(L, "%s = %.15g: asks for %.3g particles and about %s of memory; this machine has %s", key, n,
                     particles, needed_text, memory_text);
    if (particles > 2147483648.0 || n > INT_MAX)
        scene_refuse(L,
                     "%s = %.15g: asks for %.3g particles and about %s of memory; at most 2^31 particles are possible",
                     key, n, particles, needed_text);
}

/* The whole number on top of the stack. */
static int read_n(lua_State *L, const struct solver_scene *scene, const char *key)
{
    double n = scene_read_number(L, key, -1, 1, 1e300, "whole number >= 1");
    if (n != floor(n))
        scene_refuse_value(L, key, "whole number >= 1", -1);
    check_lattice(L, scene, key, n);
    return (int)n;
}

void scene_read_resolution(lua_State *L, struct solver_scene *scene)
{
    scene_lua_push(L, "n");
    scene->n = read_n(L, scene, "n");
    lua_pop(L, 1);
    scene_lua_push(L, "levels");
    if (lua_isnil(L, -1)) {
        scene->levels[0] = scene->n;
        scene->level_count = 1;
    } else {
        double level[SOLVER_LEVELS];
        size_t count = lua_istable(L, -1) ? lua_rawlen(L, -1) : 0;
        if (count < 1 || count > SOLVER_LEVELS)
            scene_refuse_value(L, "levels", "list of 1 to 16 increasing whole numbers >= 1", -1);
        scene_read_numbers(L, "levels", -1, level, count);
        for (size_t i = 0; i < count; i++) {
            char key[32];
            snprintf(key, sizeof key, "levels[%zu]", i + 1);
            lua_rawgeti(L, -1, (lua_Integer)i + 1);
            scene->levels[i] = read_n(L, scene, key);
            lua_pop(L, 1);
            if (i > 0 && scene->levels[i] <= scene->levels[i - 1])
                scene_refuse(L, "%s: expected increasing values of n, got %d after %d", key, scene->levels[i],
                             scene->levels[i - 1]);
        }
        scene->level_count = count;
    }
    lua_pop(L, 1);
}
