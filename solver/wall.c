#include "solver/wall.h"

#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How far x lies on the body's side of the wall. */
static double distance(const struct solver_wall *wall, const double *x)
{
    double sum = 0.0;
    for (size_t i = 0; i < wall->dim; i++) {
        sum += (x[i] - wall->point[i]) * wall->normal[i];
    }
    return sum;
}

static double along_normal(const struct solver_wall *wall, const double *v)
{
    double sum = 0.0;
    for (size_t i = 0; i < wall->dim; i++) {
        sum += v[i] * wall->normal[i];
    }
    return sum;
}

static bool has_wall(const struct solver_scene *scene)
{
    const double *n = scene->rigid_wall.normal;
    return n[0] != 0.0 || n[1] != 0.0 || n[2] != 0.0;
}

static bool check(const struct solver_body *body, struct solver_error *error)
{
    const struct solver_scene *scene = body->scene;
    const struct solver_scheme *scheme = solver_scheme_find(scene->scheme);
    const char *why = scheme == NULL || !scheme->stencil
                          ? "the scheme moves particles by other velocities than their own; expected scheme = "
                            "\"upwind\" or \"jst\""
                      : scene->lattice != SOLVER_NODES
                          ? "it meets particles that lie on the surface; expected lattice = \"nodes\""
                          : NULL;
    return why == NULL || solver_fail(error, SOLVER_BAD_INPUT, "%s: rigid_wall: %s", scene->path, why);
}

static bool is_on_surface(const struct solver_geometry *geometry, size_t point)
{
    const struct solver_face_point *at = &geometry->face_point[point];
    return at->area[0] != 0.0 || at->area[1] != 0.0 || at->area[2] != 0.0;
}

/* Along how many axes that the normal has a part of a particle moves as faces say, and whether that ever ends. */
static int held_axes(const struct solver_wall *wall, const struct solver_constraint *constraint, bool *ends)
{
    int held = 0;
    for (size_t i = 0; i < wall->dim; i++) {
        const struct solver_held *axis = &constraint->axis[i];
        bool counts = axis->held && wall->normal[i] != 0.0;
        held += counts ? 1 : 0;
        *ends = *ends || (counts && isfinite(axis->until));
    }
    return held;
}

/* Sites of the particles that are `marked`, but for those whose velocity along the normal is not free. */
static bool take_sites(struct solver_wall *wall, const struct solver_body *body, const struct solver_geometry *geometry,
                       const struct solver_faces *faces, const bool *marked, struct solver_error *error)
{
    int parts = 0;
    size_t c = 0; /* constraints are in the order of particles */
    for (size_t i = 0; i < wall->dim; i++) {
        parts += wall->normal[i] != 0.0 ? 1 : 0;
    }
    for (size_t a = 0; a < body->cloud->count; a++) {
        bool ends = false;
        bool constrained = c < faces->constraint_count && faces->constraint[c].particle == a;
        int held = constrained ? held_axes(wall, &faces->constraint[c], &ends) : 0;
        c += constrained ? 1 : 0;
        if (!marked[a]) {
            continue;
        }
        if (ends || (held > 0 && held < parts)) {
            return solver_fail(error, SOLVER_BAD_INPUT,
                               "%s: rigid_wall: faces hold or move a particle of the surface along the wall's normal "
                               "%s; expected all of it, always, or nothing",
                               body->scene->path, ends ? "for a time" : "in part");
        }
        if (held == 0) {
            double rho = body->constants[a * body->stride].rho;
            wall->site[wall->count++] =
                (struct solver_wall_site){.particle = (uint32_t)a, .mass = geometry->V[a] * rho};
        }
    }
    return wall->count > 0 || solver_fail(error, SOLVER_BAD_INPUT,
                                          "%s: rigid_wall: faces hold or move all of the surface, nothing of which can "
                                          "meet it",
                                          body->scene->path);
}

bool solver_wall_create(const struct solver_body *body, const struct solver_geometry *geometry,
                        const struct solver_faces *faces, struct solver_wall *wall, struct solver_error *error)
{
    const struct solver_scene *scene = body->scene;
    size_t count = body->cloud->count;
    bool *marked = NULL;
    *wall = (struct solver_wall){.dim = (size_t)body->cloud->dim};
    if (!has_wall(scene)) {
        return true;
    }
    const double *n = scene->rigid_wall.normal;
    double length = hypot(hypot(n[0], n[1]), n[2]);
    for (size_t i = 0; i < wall->dim; i++) {
        wall->normal[i] = n[i] / length;
        wall->point[i] = scene->rigid_wall.point[i];
    }
    if (!check(body, error) ||
        !solver_alloc((void **)&wall->site, count, sizeof *wall->site, "places that may meet the wall", error) ||
        !solver_alloc((void **)&marked, count, sizeof *marked, "marks of the surface", error)) {
        return false;
    }
    for (size_t i = 0; i < geometry->face_point_count; i++) {
        marked[geometry->face_point[i].particle] |= is_on_surface(geometry, i);
    }
    bool good = take_sites(wall, body, geometry, faces, marked, error);
    free(marked);
    return good;
}

bool solver_wall_check(const struct solver_wall *wall, const struct solver_body *body, const struct solver_state *state,
                       struct solver_error *error)
{
    double least = 0.0;
    for (size_t a = 0; wall->count > 0 && a < state->count; a++) {
        least = fmin(least, distance(wall, state->x + a * state->lanes));
    }
    return least >= -1e-9 * body->cloud->spacing ||
           solver_fail(error, SOLVER_BAD_INPUT,
                       "%s: rigid_wall: the body reaches %g m behind the wall; expected all of it on the side that the "
                       "normal points to",
                       body->scene->path, -least);
}

void solver_wall_free(struct solver_wall *wall)
{
    free(wall->site);
    *wall = (struct solver_wall){.site = NULL};
}

/* Brings all sites to their bounds; what is taken goes into `impulse`, `share` times. In order, whatever the threads.
 */
static void stop(const struct solver_wall *wall, const struct solver_state *state, double share, double impulse[3])
{
    for (size_t s = 0; s < wall->count; s++) {
        const struct solver_wall_site *site = &wall->site[s];
        double *v = state->v + site->particle * state->lanes;
        double excess = site->bound - along_normal(wall, v);
        if (excess > 0.0) {
            for (size_t i = 0; i < wall->dim; i++) {
                v[i] += excess * wall->normal[i];
                impulse[i] -= share * site->mass * excess * wall->normal[i];
            }
        }
    }
}

void solver_wall_begin(struct solver_wall *wall, const struct solver_state *state, double dt)
{
    for (size_t s = 0; s < wall->count; s++) {
        struct solver_wall_site *site = &wall->site[s];
        site->bound = -fmax(distance(wall, state->x + site->particle * state->lanes), 0.0) / dt;
    }
    stop(wall, state, 1.0, wall->impulse);
    memset(wall->stepping, 0, sizeof wall->stepping);
}

void solver_wall_stop(struct solver_wall *wall, const struct solver_state *state,
                      const struct solver_integrator *integrator, int stage)
{
    double share = 1.0;
    for (int later = stage + 1; later < integrator->stages; later++) {
        share *= integrator->stage[later].keep;
    }
    stop(wall, state, share, wall->stepping);
}

void solver_wall_end(struct solver_wall *wall)
{
    for (size_t i = 0; i < wall->dim; i++) {
        wall->impulse[i] += wall->stepping[i];
    }
}

void solver_wall_arrays(const struct solver_wall *wall, size_t particles, struct solver_cost_arrays *arrays)
{
    solver_cost_array(arrays, "wall", "places that may meet it", wall->site, particles, sizeof *wall->site);
}

void solver_wall_terms(const struct solver_wall *wall, int stages, struct solver_cost_terms *terms)
{
    double dim = (double)wall->dim;
    double stop = 2.0 * dim + 1.0;
    solver_cost_once(terms, "wall", (double)wall->count * (3.0 * dim + 1.0 + (1.0 + (double)stages) * stop));
}
