/* Whether triangles are a closed surface, and the normals at its faces, edges and vertices. */
#include "solver/memory.h"
#include "solver/stl.h"

#include <math.h>
#include <string.h>

/* An edge of a triangle, from its lower vertex to its higher one. */
struct edge {
    uint32_t low, high;
    uint32_t triangle;
    uint8_t side;
    bool backwards; /* the triangle runs from the higher one to the lower */
};

static int by_ends(const void *left, const void *right)
{
    const struct edge *a = left;
    const struct edge *b = right;
    if (a->low != b->low) {
        return a->low < b->low ? -1 : 1;
    }
    if (a->high != b->high) {
        return a->high < b->high ? -1 : 1;
    }
    return a->triangle < b->triangle ? -1 : a->triangle > b->triangle;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void difference(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = a[i] - b[i];
    }
}

/* Normals of triangles, and their sums at vertices; returns the volume within [m^3]. */
static double set_normals(struct solver_stl *surface)
{
    double volume = 0.0;
    for (size_t t = 0; t < surface->count; t++) {
        const uint32_t *of = surface->triangle[t];
        double side[3][3]; /* from each corner to the next */
        double *normal = surface->normal[t];
        double from[3];
        for (int c = 0; c < 3; c++) {
            difference(surface->vertex[of[(c + 1) % 3]], surface->vertex[of[c]], side[c]);
        }
        for (int i = 0; i < 3; i++) {
            normal[i] = side[0][(i + 1) % 3] * side[1][(i + 2) % 3] - side[0][(i + 2) % 3] * side[1][(i + 1) % 3];
        }
        difference(surface->vertex[of[0]], surface->vertex[0], from);
        volume += dot(from, normal) / 6.0;
        double length = sqrt(dot(normal, normal));
        for (int i = 0; i < 3; i++) { /* corners in a line: no normal, which no sum misses */
            normal[i] = length > 0.0 ? normal[i] / length : 0.0;
        }
        for (int c = 0; c < 3; c++) {
            const double *on = side[c];
            const double *back = side[(c + 2) % 3];
            double cosine = -dot(on, back) / sqrt(dot(on, on) * dot(back, back));
            double angle = acos(fmin(fmax(cosine, -1.0), 1.0));
            for (int i = 0; i < 3; i++) {
                surface->at_vertex[of[c]][i] += angle * normal[i];
            }
        }
    }
    return volume;
}

/* Two triangles at every edge, which run along it in opposite directions; their normals are summed. */
static bool pair_edges(struct solver_stl *surface, struct edge *edge, const char *path, struct solver_error *error)
{
    size_t count = 3 * surface->count;
    for (size_t e = 0; e < count; e++) {
        uint32_t from = surface->triangle[e / 3][e % 3];
        uint32_t to = surface->triangle[e / 3][(e % 3 + 1) % 3];
        edge[e] = (struct edge){.low = from < to ? from : to,
                                .high = from < to ? to : from,
                                .triangle = (uint32_t)(e / 3),
                                .side = (uint8_t)(e % 3),
                                .backwards = from > to};
    }
    qsort(edge, count, sizeof *edge, by_ends);
    for (size_t e = 0, end; e < count; e = end) {
        for (end = e + 1; end < count && edge[end].low == edge[e].low && edge[end].high == edge[e].high;) {
            end++;
        }
        if (end - e != 2 || edge[e].backwards == edge[e + 1].backwards) {
            const double *a = surface->vertex[edge[e].low];
            const double *b = surface->vertex[edge[e].high];
            return solver_fail(
                error, SOLVER_BAD_INPUT,
                "%.400s: is no closed surface: the edge from (%g, %g, %g) to (%g, %g, %g) m belongs to %zu "
                "triangle%s%s; expected two, once in each direction",
                path, a[0], a[1], a[2], b[0], b[1], b[2], end - e, end - e == 1 ? "" : "s",
                end - e == 2 ? " in the same direction" : "");
        }
        for (int i = 0; i < 3; i++) {
            double sum = surface->normal[edge[e].triangle][i] + surface->normal[edge[e + 1].triangle][i];
            surface->at_edge[edge[e].triangle][edge[e].side][i] = sum;
            surface->at_edge[edge[e + 1].triangle][edge[e + 1].side][i] = sum;
        }
    }
    return true;
}

bool stl_close(struct solver_stl *surface, const char *path, struct solver_error *error)
{
    struct edge *edge = NULL;
    size_t count = surface->count;
    if (count == 0) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%.400s: has no triangle with three vertices", path);
    }
    if (!solver_alloc((void **)&surface->normal, count, sizeof *surface->normal, "normals", error) ||
        !solver_alloc((void **)&surface->at_edge, count, sizeof *surface->at_edge, "normals at edges", error) ||
        !solver_alloc((void **)&surface->at_vertex, surface->vertex_count, sizeof *surface->at_vertex,
                      "normals at vertices", error) ||
        !solver_alloc((void **)&edge, 3 * count, sizeof *edge, "edges", error)) {
        return false;
    }
    double volume = set_normals(surface);
    bool good = pair_edges(surface, edge, path, error);
    free(edge);
    if (good && !(volume > 0.0)) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%.400s: is inside out: its volume is %g m^3; triangles must run counterclockwise seen from "
                           "outside",
                           path, volume);
    }
    return good;
}
