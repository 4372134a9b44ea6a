#include "render/mesh.h"

#include "render/fail.h"
#include "render/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double smooth = 0.766; /* cosine of 40 degrees: a larger angle between neighbours is a crease */

enum render_kind render_quad_corners(const uint32_t quad[4], uint32_t corner[4])
{
    int count = 0;
    for (int i = 0; i < 4; i++) {
        bool seen = false;
        for (int j = 0; j < count; j++)
            seen = seen || corner[j] == quad[i];
        if (!seen)
            corner[count++] = quad[i];
    }
    return (enum render_kind)(count - 1);
}

static bool check_surface(const struct render_surface *surface, char why[RENDER_WHY])
{
    if (surface->vertex_count == 0 || surface->quad_count == 0)
        return render_fail(why, "surface: %zu vertices and %zu quads; there is nothing to draw", surface->vertex_count,
                           surface->quad_count);
    if (!surface->position || !surface->scalar || !surface->quad)
        return render_fail(why, "surface: positions, scalars or quads are missing");
    for (size_t i = 0; i < surface->vertex_count; i++) {
        const double *x = surface->position + 3 * i;
        if (!isfinite(x[0]) || !isfinite(x[1]) || !isfinite(x[2]))
            return render_fail(why, "surface: vertex %zu of %zu lies at {%g, %g, %g}; expected finite positions", i,
                               surface->vertex_count, x[0], x[1], x[2]);
    }
    for (size_t i = 0; i < 4 * surface->quad_count; i++)
        if (surface->quad[i] >= surface->vertex_count)
            return render_fail(why, "surface: quad %zu names vertex %u, but there are only %zu", i / 4,
                               surface->quad[i], surface->vertex_count);
    return true;
}

/* Unit normal of a quad, from its diagonals (a triangle's edges); zero for lines. */
static void face_normal(const struct render_surface *surface, size_t quad, double normal[3])
{
    const uint32_t *v = surface->quad + 4 * quad;
    double one[3], other[3];
    const double(*x)[3] = (const double(*)[3])surface->position;
    for (int i = 0; i < 3; i++) {
        one[i] = x[v[2]][i] - x[v[0]][i];
        other[i] = x[v[3]][i] - x[v[1]][i];
    }
    render_cross(one, other, normal);
    render_unit(normal, normal);
}

/* For each vertex its quads: those of vertex i are list[first[i]] .. list[first[i + 1] - 1]. */
static void list_quads(const struct render_surface *surface, size_t *first, size_t *list)
{
    for (size_t i = 0; i < 4 * surface->quad_count; i++)
        first[surface->quad[i]]++;
    for (size_t i = 1; i <= surface->vertex_count; i++)
        first[i] += first[i - 1];
    for (size_t i = 4 * surface->quad_count; i-- > 0;)
        list[--first[surface->quad[i]]] = i / 4;
}

/* Corner normals: the mean of the face normals around a vertex that differ little from this quad's own. Those that
 * look the other way round are turned, so that the winding does not matter. */
static void average_normals(const struct render_surface *surface, const double (*face)[3], const size_t *first,
                            const size_t *list, double (*normal)[4][3])
{
    for (size_t q = 0; q < surface->quad_count; q++)
        for (int c = 0; c < 4; c++) {
            const uint32_t vertex = surface->quad[4 * q + (size_t)c];
            double sum[3] = {0};
            for (size_t k = first[vertex]; k < first[vertex + 1]; k++) {
                const double *other = face[list[k]], cosine = render_dot(face[q], other);
                if (fabs(cosine) > smooth)
                    for (int i = 0; i < 3; i++)
                        sum[i] += cosine < 0 ? -other[i] : other[i];
            }
            render_unit(sum, normal[q][c]);
        }
}

struct edge {
    uint32_t low, high;
    size_t quad;
    bool upward; /* the quad runs from low to high */
};

static int compare_edges(const void *one, const void *other)
{
    const struct edge *a = one, *b = other;
    if (a->low != b->low)
        return a->low < b->low ? -1 : 1;
    if (a->high != b->high)
        return a->high < b->high ? -1 : 1;
    return a->quad < b->quad ? -1 : a->quad > b->quad;
}

/* All sides of all quads of area, sorted so that the quads on both sides of an edge follow each other. */
static size_t list_sides(const struct render_surface *surface, struct edge *side)
{
    size_t count = 0;
    for (size_t q = 0; q < surface->quad_count; q++) {
        uint32_t corner[4];
        const enum render_kind kind = render_quad_corners(surface->quad + 4 * q, corner);
        if (kind < RENDER_TRIANGLE)
            continue;
        const int corners = (int)kind + 1;
        for (int c = 0; c < corners; c++) {
            const uint32_t a = corner[c], b = corner[(c + 1) % corners];
            side[count++] = (struct edge){a < b ? a : b, a < b ? b : a, q, a < b};
        }
    }
    qsort(side, count, sizeof *side, compare_edges);
    return count;
}

/* Whether all quads that have a normal have the same one, whichever way round they are. */
static bool lies_flat(const double (*face)[3], size_t quads)
{
    size_t first = 0;
    while (first < quads && render_norm(face[first]) <= 0)
        first++;
    for (size_t q = first; q < quads; q++)
        if (render_norm(face[q]) > 0 && fabs(render_dot(face[q], face[first])) < 1 - 1e-9)
            return false;
    return true;
}

/* Whether the quads that meet in an edge make it one worth drawing. Of a flat body its rim is: where quads lie over one
 * another, as beside a curved rim that corners of cells were moved to, an even number of them meets within. */
static bool worth_drawing(const struct edge *side, size_t quads, const double (*face)[3], const double eye[3],
                          bool flat)
{
    if (flat)
        return quads % 2 == 1;
    if (quads != 2)
        return true;                                               /* a rim, or several sheets meet */
    const double turn = side[0].upward == side[1].upward ? -1 : 1; /* the two are wound against each other */
    const double *one = face[side[0].quad], *other = face[side[1].quad];
    const bool crease = turn * render_dot(one, other) < smooth;
    const bool silhouette = turn * render_dot(one, eye) * render_dot(other, eye) < 0;
    return crease || silhouette;
}

static void keep_edges(const struct edge *side, size_t sides, const double (*face)[3], const double eye[3],
                       struct render_mesh *mesh)
{
    for (size_t i = 0, next; i < sides; i = next) {
        for (next = i + 1; next < sides && side[next].low == side[i].low && side[next].high == side[i].high;)
            next++;
        if (worth_drawing(side + i, next - i, face, eye, mesh->flat)) {
            mesh->edge[mesh->edge_count][0] = side[i].low;
            mesh->edge[mesh->edge_count++][1] = side[i].high;
        }
    }
}

/* The end of edge e that is not v. */
static uint32_t across(const struct render_mesh *mesh, size_t e, uint32_t v)
{
    return mesh->edge[e][0] == v ? mesh->edge[e][1] : mesh->edge[e][0];
}

/* Of an edge that ends in the open at v: whether it and at most one more lead to where edges meet, or end again. Then
 * it is no feature of the body, but how rough its surface is. `link` is the exclusive or of the edges at a vertex. */
static bool is_whisker(const struct render_mesh *mesh, const uint8_t *degree, const size_t *link, uint32_t v,
                       size_t edge[2])
{
    edge[0] = edge[1] = link[v];
    uint32_t end = across(mesh, edge[0], v);
    if (degree[end] == 2) {
        edge[1] = link[end] ^ edge[0];
        end = across(mesh, edge[1], end);
    }
    return degree[end] != 2;
}

/* Leaves out edges that end in the open after one or two. */
static void drop_whiskers(struct render_mesh *mesh, size_t vertices, uint8_t *degree, size_t *link, bool *dropped)
{
    for (size_t e = 0; e < mesh->edge_count; e++)
        for (int k = 0; k < 2; k++) {
            uint8_t *at = &degree[mesh->edge[e][k]];
            *at = *at < 3 ? (uint8_t)(*at + 1) : *at; /* 3: three or more */
            link[mesh->edge[e][k]] ^= e;
        }
    for (uint32_t v = 0; v < vertices; v++) {
        size_t edge[2];
        if (degree[v] == 1 && is_whisker(mesh, degree, link, v, edge))
            dropped[edge[0]] = dropped[edge[1]] = true;
    }
    size_t kept = 0;
    for (size_t e = 0; e < mesh->edge_count; e++)
        if (!dropped[e]) {
            memmove(mesh->edge[kept], mesh->edge[e], sizeof mesh->edge[e]);
            kept++;
        }
    mesh->edge_count = kept;
}

bool render_mesh_build(const struct render_surface *surface, const double eye[3], struct render_mesh *mesh,
                       char why[RENDER_WHY])
{
    *mesh = (struct render_mesh){0};
    if (!check_surface(surface, why))
        return false;
    const size_t quads = surface->quad_count;
    double(*face)[3] = calloc(quads, sizeof *face);
    size_t *first = calloc(surface->vertex_count + 1, sizeof *first);
    size_t *list = calloc(quads, 4 * sizeof *list);
    struct edge *side = calloc(quads, 4 * sizeof *side);
    mesh->normal = calloc(quads, sizeof *mesh->normal);
    mesh->edge = calloc(quads, 4 * sizeof *mesh->edge);
    uint8_t *degree = calloc(surface->vertex_count + 1, sizeof *degree);
    bool *dropped = calloc(quads, 4 * sizeof *dropped);
    const bool fits = face && first && list && side && mesh->normal && mesh->edge && degree && dropped;
    if (fits) {
        for (size_t q = 0; q < quads; q++)
            face_normal(surface, q, face[q]);
        list_quads(surface, first, list);
        average_normals(surface, (const double(*)[3])face, first, list, mesh->normal);
        mesh->flat = lies_flat((const double(*)[3])face, quads);
        keep_edges(side, list_sides(surface, side), (const double(*)[3])face, eye, mesh);
        memset(first, 0, (surface->vertex_count + 1) * sizeof *first);
        drop_whiskers(mesh, surface->vertex_count, degree, first, dropped);
    }
    free(degree);
    free(dropped);
    free(face);
    free(first);
    free(list);
    free(side);
    if (fits)
        return true;
    render_mesh_free(mesh);
    return render_fail(why, "no memory for drawing a surface of %zu quads", quads);
}

void render_mesh_free(struct render_mesh *mesh)
{
    free(mesh->normal);
    free(mesh->edge);
    *mesh = (struct render_mesh){0};
}
