#include "solver/wall.h"

#include "solver/keep.h"
#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PASSES = 20 }; /* over the bounds of a site, until all hold; one is enough at right angles */

/* What must be free of a normal's square where faces lead a particle along an axis: a wall across that axis would throw
 * it out sideways, and is left to the face. */
static const double LEAST_FREE = 0.01;

/* How far x lies on the body's side of the plane. */
static double distance(const struct solver_wall *wall, const double *x)
{
    double sum = 0.0;
    for (size_t i = 0; i < wall->dim; i++) {
        sum += (x[i] - wall->point[i]) * wall->normal[i];
    }
    return sum;
}

static bool has_plane(const struct solver_scene *scene)
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
    return why == NULL || solver_fail(error, SOLVER_BAD_INPUT, "%s: %s: %s", scene->path,
                                      has_plane(scene) ? "rigid_wall" : "die", why);
}

static bool is_on_surface(const struct solver_geometry *geometry, size_t point)
{
    const struct solver_face_point *at = &geometry->face_point[point];
    return at->area[0] != 0.0 || at->area[1] != 0.0 || at->area[2] != 0.0;
}

/* Which axes of a particle faces lead, and whether that ever ends. */
static void note_led(const struct solver_wall *wall, const struct solver_constraint *constraint, bool led[3],
                     bool *ends)
{
    for (size_t i = 0; i < wall->dim; i++) {
        const struct solver_held *axis = &constraint->axis[i];
        bool counts = axis->held && (wall->die.count > 0 || wall->normal[i] != 0.0);
        led[i] = counts;
        *ends = *ends || (counts && isfinite(axis->until));
    }
}

/* Of the axes that the plane's normal has a part of, how many are led: 0, 1 for some, 2 for all. */
static int part_led(const struct solver_wall *wall, const bool led[3])
{
    bool some = false;
    bool all = true;
    for (size_t i = 0; i < wall->dim; i++) {
        bool counts = wall->normal[i] != 0.0;
        some = some || (counts && led[i]);
        all = all && (!counts || led[i]);
    }
    return !wall->plane || !some ? 0 : all ? 2 : 1;
}

/* Sites of the particles that are `marked`, but for those whose velocity along the normal is not free. */
static bool take_sites(struct solver_wall *wall, const struct solver_body *body, const struct solver_geometry *geometry,
                       const struct solver_faces *faces, const bool *marked, struct solver_error *error)
{
    const char *key = wall->plane ? "rigid_wall" : "die";
    size_t c = 0; /* constraints are in the order of particles */
    for (size_t a = 0; a < body->cloud->count; a++) {
        struct solver_wall_site site = {.particle = (uint32_t)a};
        bool ends = false;
        if (c < faces->constraint_count && faces->constraint[c].particle == a) {
            note_led(wall, &faces->constraint[c++], site.led, &ends);
        }
        int led = part_led(wall, site.led);
        if (!marked[a]) {
            continue;
        }
        if (ends || led == 1) {
            return solver_fail(error, SOLVER_BAD_INPUT,
                               "%s: %s: faces hold or move a particle of the surface along the wall's normal %s; "
                               "expected all of it, always, or nothing",
                               body->scene->path, key, ends ? "for a time" : "in part");
        }
        site.mass = geometry->V[a] * body->constants[a * body->stride].rho;
        if (led == 0 || wall->die.count > 0) {
            wall->site[wall->count++] = site;
        }
    }
    return wall->count > 0 || solver_fail(error, SOLVER_BAD_INPUT,
                                          "%s: %s: faces hold or move all of the surface, nothing of which can meet it",
                                          body->scene->path, key);
}

static void set_plane(struct solver_wall *wall, const struct solver_scene *scene)
{
    const double *n = scene->rigid_wall.normal;
    double length = hypot(hypot(n[0], n[1]), n[2]);
    wall->plane = true;
    for (size_t i = 0; i < wall->dim; i++) {
        wall->normal[i] = n[i] / length;
        wall->point[i] = scene->rigid_wall.point[i];
    }
}

bool solver_wall_create(const struct solver_body *body, const struct solver_geometry *geometry,
                        const struct solver_faces *faces, struct solver_wall *wall, struct solver_error *error)
{
    const struct solver_scene *scene = body->scene;
    size_t count = body->cloud->count;
    bool *marked = NULL;
    *wall = (struct solver_wall){
        .dim = (size_t)body->cloud->dim, .reach = body->cloud->spacing, .accounted = body->scene->balance};
    if (!has_plane(scene) && scene->die_count == 0) {
        return true;
    }
    if (has_plane(scene)) {
        set_plane(wall, scene);
    }
    if (!check(body, error) || !solver_die_create(scene, &wall->die, error) ||
        !solver_alloc((void **)&wall->site, count, sizeof *wall->site, "places that may meet the wall", error) ||
        !solver_alloc((void **)&marked, count, sizeof *marked, "marks of the surface", error)) {
        return false;
    }
    for (size_t i = 0; i < geometry->face_point_count; i++) {
        marked[geometry->face_point[i].particle] |= is_on_surface(geometry, i);
    }
    if (wall->die.count > 0) {
        memset(marked, 1, count * sizeof *marked);
    }
    bool good = take_sites(wall, body, geometry, faces, marked, error);
    free(marked);
    return good;
}

/* How far x lies behind the nearest place of a wall by a path; 0: before it, or beyond its ends. */
static double behind(const struct solver_wall *wall, size_t w, const double *x)
{
    struct solver_die_near near[SOLVER_DIE_NEAR];
    size_t count = solver_die_look(&wall->die, w, x, near);
    double least = 0.0;
    for (size_t i = 0; i < count; i++) {
        least = fmin(least, near[i].gap);
    }
    return -least;
}

bool solver_wall_check(const struct solver_wall *wall, const struct solver_body *body, const struct solver_state *state,
                       struct solver_error *error)
{
    double least = 0.0;
    double deepest = 0.0;
    size_t deepest_wall = 0;
    for (size_t a = 0; wall->count > 0 && a < state->count; a++) {
        const double *x = state->x + a * state->lanes;
        least = wall->plane ? fmin(least, distance(wall, x)) : least;
        for (size_t w = 0; w < wall->die.wall_count; w++) {
            double way = behind(wall, w, x);
            deepest_wall = way > deepest ? w : deepest_wall;
            deepest = fmax(deepest, way);
        }
    }
    double give = 1e-9 * body->cloud->spacing;
    if (least < -give) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: rigid_wall: the body reaches %g m behind the wall; expected all of it on the side that "
                           "the normal points to",
                           body->scene->path, -least);
    }
    return deepest <= give || solver_fail(error, SOLVER_BAD_INPUT,
                                          "%s: die[%zu]: the body reaches %g m behind the wall; expected all of it to "
                                          "the left of the path",
                                          body->scene->path, deepest_wall + 1, deepest);
}

void solver_wall_free(struct solver_wall *wall)
{
    free(wall->site);
    solver_die_free(&wall->die);
    *wall = (struct solver_wall){.site = NULL};
}

/* Brings the velocity of a site to one bound; false if it keeps it. */
static bool enforce(const struct solver_wall *wall, struct solver_wall_site *site,
                    const struct solver_wall_bound *bound, double *v, double share, double impulse[3])
{
    double excess = bound->least;
    double free_part = 0.0; /* of the normal's square */
    for (size_t i = 0; i < wall->dim; i++) {
        excess -= v[i] * bound->normal[i];
        free_part += site->led[i] ? 0.0 : bound->normal[i] * bound->normal[i];
    }
    if (!(excess > 0.0) || free_part < LEAST_FREE) {
        return false;
    }
    for (size_t i = 0; i < wall->dim; i++) {
        if (!site->led[i]) {
            double change = excess * bound->normal[i] / free_part;
            v[i] += change;
            site->given[i] += share * change;
            impulse[i] -= share * site->mass * change;
        }
    }
    return true;
}

/* Brings all sites to their bounds; what is taken goes into `impulse`, `share` times. In order, whatever the threads.
 */
static void stop(const struct solver_wall *wall, const struct solver_state *state, double share, double impulse[3])
{
    for (size_t s = 0; s < wall->count; s++) {
        struct solver_wall_site *site = &wall->site[s];
        double *v = state->v + site->particle * state->lanes;
        bool changed = site->bounds > 0;
        for (int pass = 0; changed && pass < PASSES; pass++) {
            changed = false;
            for (size_t i = 0; i < site->bounds; i++) {
                changed = enforce(wall, site, &site->bound[i], v, share, impulse) || changed;
            }
            changed = changed && site->bounds > 1;
        }
    }
}

static void add_bound(struct solver_wall_site *site, const double *normal, size_t dim, double least)
{
    if (site->bounds < SOLVER_WALL_BOUNDS) {
        struct solver_wall_bound *bound = &site->bound[site->bounds++];
        *bound = (struct solver_wall_bound){.least = least};
        memcpy(bound->normal, normal, dim * sizeof *normal);
    }
}

static void find_bounds(const struct solver_wall *wall, struct solver_wall_site *site, const double *x, double dt)
{
    site->bounds = 0;
    if (wall->plane) {
        add_bound(site, wall->normal, wall->dim, -fmax(distance(wall, x), 0.0) / dt);
    }
    for (size_t w = 0; w < wall->die.wall_count; w++) {
        struct solver_die_near near[SOLVER_DIE_NEAR];
        size_t count = solver_die_look(&wall->die, w, x, near);
        for (size_t i = 0; i < count; i++) {
            if (fabs(near[i].gap) < wall->reach) {
                add_bound(site, near[i].normal, wall->dim, -near[i].gap / dt);
            }
        }
    }
}

void solver_wall_begin(struct solver_wall *wall, const struct solver_state *state, double dt)
{
    for (size_t s = 0; s < wall->count; s++) {
        struct solver_wall_site *site = &wall->site[s];
        find_bounds(wall, site, state->x + site->particle * state->lanes, dt);
        memcpy(site->start, state->v + site->particle * state->lanes, wall->dim * sizeof *site->start);
        memset(site->given, 0, sizeof site->given);
    }
    stop(wall, state, 1.0, wall->impulse);
    for (size_t s = 0; wall->accounted && s < wall->count; s++) {
        struct solver_wall_site *site = &wall->site[s];
        for (size_t i = 0; i < wall->dim; i++) {
            wall->taken -= site->mass * site->given[i] * (site->start[i] + 0.5 * site->given[i]);
            site->start[i] += site->given[i];
            site->given[i] = 0.0;
        }
    }
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

void solver_wall_end(struct solver_wall *wall, const struct solver_state *state)
{
    for (size_t s = 0; wall->accounted && s < wall->count; s++) {
        const struct solver_wall_site *site = &wall->site[s];
        const double *end = state->v + site->particle * state->lanes;
        for (size_t i = 0; i < wall->dim; i++) {
            wall->taken -= site->mass * site->given[i] * 0.5 * (site->start[i] + end[i]);
        }
    }
    for (size_t i = 0; i < wall->dim; i++) {
        wall->impulse[i] += wall->stepping[i];
    }
}

bool solver_wall_keep(struct solver_wall *wall, struct solver_keeper *keeper, struct solver_error *error)
{
    return wall->count == 0 ||
           (solver_keep(keeper, "impulse on the wall", wall->impulse, sizeof wall->impulse, 1, error) &&
            solver_keep(keeper, "energy taken by the wall", &wall->taken, sizeof wall->taken, 1, error));
}

void solver_wall_arrays(const struct solver_wall *wall, size_t particles, struct solver_cost_arrays *arrays)
{
    solver_cost_array(arrays, "wall", "places that may meet it", wall->site, particles, sizeof *wall->site);
    solver_cost_array(arrays, "wall", "pieces of paths", wall->die.piece, wall->die.room, sizeof *wall->die.piece);
}

/* All pieces of paths are looked at; what is stopped by them, near them alone, is not counted. */
void solver_wall_terms(const struct solver_wall *wall, int stages, struct solver_cost_terms *terms)
{
    double dim = (double)wall->dim;
    double sites = (double)wall->count;
    double account = wall->accounted ? 11.0 * dim : 0.0;
    double plane = wall->plane ? 3.0 * dim + 1.0 + (1.0 + (double)stages) * 4.0 * dim : 0.0;
    solver_cost_once(terms, "wall", sites * (plane + account));
    solver_cost_once(terms, "walls by paths", sites * (double)wall->die.count * (SOLVER_COST_FUNCTION + 14.0));
}
