#include "solver/skin.h"

#include "solver/memory.h"
#include "solver/pieces.h"

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

/* Largest squared way [m^2] that a particle of the piece has gone since the list was made; infinite where a position
 * is not finite. */
static double farthest(const struct solver_skin *skin, const double *x, size_t lanes, struct solver_piece at)
{
    size_t dim = (size_t)skin->cloud->dim;
    double most = 0.0;
    for (size_t a = at.begin; a < at.end; a++) {
        double square = 0.0;
        for (size_t i = 0; i < dim; i++) {
            double d = x[a * lanes + i] - skin->built[a * dim + i];
            square += d * d;
        }
        most = isfinite(square) ? fmax(most, square) : INFINITY;
    }
    return most;
}

static double farthest_of_all(const struct solver_skin *skin, const double *x, size_t lanes)
{
    size_t count = skin->cloud->count;
    double most = 0.0;
#pragma omp parallel for schedule(static) reduction(max : most)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        most = fmax(most, farthest(skin, x, lanes, solver_piece_at(piece, count)));
    }
    return most;
}

bool solver_skin_update(struct solver_skin *skin, const double *x, size_t lanes, struct solver_error *error)
{
    size_t dim = (size_t)skin->cloud->dim;
    double most = farthest_of_all(skin, x, lanes);
    if (!isfinite(most)) {
        return solver_fail(
            error, SOLVER_BROKE_DOWN,
            "a particle's position is not finite, or beyond all bounds: the run is unstable. Try a smaller cfl");
    }
    /* two particles that move towards one another */
    if (skin->updates > 0 && 4.0 * most <= skin->margin * skin->margin) {
        return true;
    }
    struct solver_points now = {
        .dim = skin->cloud->dim, .count = skin->cloud->count, .stride = lanes, .x = x, .body = skin->cloud->body};
    for (size_t a = 0; a < skin->cloud->count; a++) {
        memcpy(skin->built + a * dim, x + a * lanes, dim * sizeof *x);
    }
    skin->updates++;
    return solver_graph_update(&skin->graph, &now, skin->which, skin->radius + skin->margin, error);
}

size_t solver_skin_bytes(const struct solver_skin *skin)
{
    size_t count = skin->cloud->count;
    return (count + 1) * sizeof *skin->graph.row + skin->graph.row[count] * sizeof *skin->graph.neighbour +
           count * (size_t)skin->cloud->dim * sizeof *skin->built;
}
