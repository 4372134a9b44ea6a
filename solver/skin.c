#include "solver/skin.h"

#include "solver/keep.h"
#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the spacing: wide enough to be made rarely, narrow enough not to add a ring of neighbours on a lattice. */
static const double margin_of_spacing = 0.2;

bool solver_skin_create(const struct solver_cloud *cloud, double radius, enum solver_pairs which,
                        struct solver_skin *skin, struct solver_error *error)
{
    *skin = (struct solver_skin){
        .cloud = cloud, .radius = radius, .which = which, .margin = margin_of_spacing * cloud->spacing};
    return solver_alloc((void **)&skin->built, cloud->count * (size_t)cloud->dim, sizeof(double), "neighbour list",
                        error) &&
           solver_skin_update(skin, cloud->X, (size_t)cloud->dim, error);
}

void solver_skin_free(struct solver_skin *skin)
{
    solver_graph_free(&skin->graph);
    free(skin->built);
    *skin = (struct solver_skin){.cloud = NULL};
}

/* Squared way [m^2] that a particle has gone since the list was made; not finite where its position is not, or far
 * beyond all bounds. */
static double way(const struct solver_skin *skin, const double *x, size_t lanes, size_t a)
{
    size_t dim = (size_t)skin->cloud->dim;
    double square = 0.0;
    for (size_t i = 0; i < dim; i++) {
        double d = x[a * lanes + i] - skin->built[a * dim + i];
        square += d * d;
    }
    return square;
}

/* The longest of them; infinite where one is not finite. */
static double longest_way(const struct solver_skin *skin, const double *x, size_t lanes)
{
    size_t count = skin->cloud->count;
    double most = 0.0;
#pragma omp parallel for schedule(static) reduction(max : most)
    for (size_t a = 0; a < count; a++) {
        double square = way(skin, x, lanes, a);
        most = isfinite(square) ? fmax(most, square) : INFINITY;
    }
    return most;
}

static bool fail_lost(const struct solver_skin *skin, const double *x, size_t lanes, struct solver_error *error)
{
    size_t dim = (size_t)skin->cloud->dim;
    size_t a = 0;
    while (isfinite(way(skin, x, lanes, a))) {
        a++;
    }
    const double *X = skin->cloud->X + a * dim;
    return solver_fail(error, SOLVER_BROKE_DOWN,
                       "particle %zu at X = (%g, %g, %g) m: position x is not finite, or beyond all bounds", a, X[0],
                       dim > 1 ? X[1] : 0.0, dim > 2 ? X[2] : 0.0);
}

/* Lists the pairs of particles at x. */
static bool list(struct solver_skin *skin, const double *x, size_t lanes, struct solver_error *error)
{
    struct solver_points now = {
        .dim = skin->cloud->dim, .count = skin->cloud->count, .stride = lanes, .x = x, .body = skin->cloud->body};
    return solver_graph_update(&skin->graph, &now, skin->which, skin->radius + skin->margin, error);
}

bool solver_skin_update(struct solver_skin *skin, const double *x, size_t lanes, struct solver_error *error)
{
    size_t dim = (size_t)skin->cloud->dim;
    double most = longest_way(skin, x, lanes);
    if (!isfinite(most)) {
        return fail_lost(skin, x, lanes, error);
    }
    /* two particles that move towards one another */
    if (skin->updates > 0 && 4.0 * most <= skin->margin * skin->margin) {
        return true;
    }
    size_t updates = skin->updates;
    skin->updates = 0; /* there is no list, should this fail */
    if (!list(skin, x, lanes, error)) {
        return false;
    }
    for (size_t a = 0; a < skin->cloud->count; a++) {
        memcpy(skin->built + a * dim, x + a * lanes, dim * sizeof *x);
    }
    skin->updates = updates + 1;
    return true;
}

bool solver_skin_keep(struct solver_skin *skin, const char *name, struct solver_keeper *keeper,
                      struct solver_error *error)
{
    size_t dim = (size_t)skin->cloud->dim;
    return solver_keep(keeper, name, skin->built, dim * sizeof *skin->built, skin->cloud->count, error) &&
           solver_keep(keeper, "how often listed", &skin->updates, sizeof skin->updates, 1, error) &&
           (!keeper->reads || skin->updates == 0 || list(skin, skin->built, dim, error));
}

size_t solver_skin_pairs(const struct solver_skin *skin)
{
    return skin->updates > 0 ? skin->graph.row[skin->cloud->count] : 0;
}

void solver_skin_arrays(const struct solver_skin *skin, const char *group, struct solver_cost_arrays *arrays)
{
    if (skin->built != NULL) {
        size_t dim = (size_t)skin->cloud->dim;
        solver_graph_arrays(&skin->graph, group, arrays);
        solver_cost_array(arrays, group, "places when listed", skin->built, skin->cloud->count * dim,
                          sizeof *skin->built);
    }
}

size_t solver_skin_bytes(const struct solver_skin *skin)
{
    size_t count = skin->cloud->count;
    return (count + 1) * sizeof *skin->graph.row + solver_skin_pairs(skin) * sizeof *skin->graph.neighbour +
           count * (size_t)skin->cloud->dim * sizeof *skin->built;
}
