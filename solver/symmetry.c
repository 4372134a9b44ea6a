#include "solver/symmetry.h"

#include "solver/graph.h"
#include "solver/memory.h"
#include "solver/pieces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Places that differ by less, in spacings, are the same. */
static const double same = 1e-6;

/* How a particle of the whole is kept: not at all, as one of the part, as a neighbour of those, or one of these. */
enum keep { NOT, PART, NEAR, FAR };

struct cutting {
    const struct solver_cloud *whole;
    const struct solver_shape *shape;
    struct solver_graph graph;
    uint8_t *keep; /* [count] enum keep */
    size_t count[FAR + 1];
    size_t cells, face_points; /* of the part */
};

/* Distance of particle a above the plane across `axis`, in spacings; 1 where there is none. */
static double above(const struct cutting *of, size_t a, size_t axis)
{
    const struct solver_cloud *cloud = of->whole;
    size_t dim = (size_t)cloud->dim;
    if (axis >= dim || !of->shape->cut[axis]) {
        return 1.0;
    }
    return (cloud->X[a * dim + axis] - of->shape->plane[axis]) / cloud->spacing;
}

static bool is_above(const struct cutting *of, size_t a)
{
    return above(of, a, 0) > -same && above(of, a, 1) > -same && above(of, a, 2) > -same;
}

/* Whether all corners of a cell are of the part. */
static bool has_cell(const struct cutting *of, size_t c)
{
    size_t corners = (size_t)1 << of->whole->dim;
    const uint32_t *cell = of->whole->cell + c * corners;
    bool inside = true;
    for (size_t k = 0; k < corners; k++) {
        inside = inside && of->keep[cell[k]] == PART;
    }
    return inside;
}

/* Marks the particles that are kept, and counts them and what they are corners of. */
static void mark(struct cutting *of)
{
    const struct solver_graph *graph = &of->graph;
    size_t count = of->whole->count;
    for (size_t a = 0; a < count; a++) {
        of->keep[a] = is_above(of, a) ? PART : NOT;
    }
    for (int ring = PART; ring < FAR; ring++) {
        for (size_t a = 0; a < count; a++) {
            for (size_t ab = graph->row[a]; of->keep[a] == ring && ab < graph->row[a + 1]; ab++) {
                uint8_t *of_b = &of->keep[graph->neighbour[ab]];
                *of_b = *of_b == NOT ? (uint8_t)(ring + 1) : *of_b;
            }
        }
    }
    for (size_t a = 0; a < count; a++) {
        of->count[of->keep[a]]++;
    }
    for (size_t c = 0; c < of->whole->cell_count; c++) {
        of->cells += has_cell(of, c) ? 1 : 0;
    }
    for (size_t i = 0; i < of->whole->face_point_count; i++) {
        of->face_points += of->keep[of->whole->face_point[i].particle] == PART ? 1 : 0;
    }
}

/* --- which particle an image is of --- */

struct placed {
    double height; /* along the last axis */
    uint32_t particle;
};

static int by_height(const void *left, const void *right)
{
    const struct placed *a = left;
    const struct placed *b = right;
    return a->height < b->height ? -1 : a->height > b->height;
}

static bool is_at(const struct solver_cloud *cloud, size_t a, const double X[3])
{
    size_t dim = (size_t)cloud->dim;
    double square = 0.0;
    for (size_t i = 0; i < dim; i++) {
        square += (cloud->X[a * dim + i] - X[i]) * (cloud->X[a * dim + i] - X[i]);
    }
    return square < same * same * cloud->spacing * cloud->spacing;
}

/* The particle at X, of `count` that are sorted by height; SIZE_MAX: there is none. */
static size_t find(const struct solver_cloud *cloud, const struct placed *placed, size_t count, const double X[3])
{
    double low = X[cloud->dim - 1] - same * cloud->spacing;
    size_t begin = 0;
    for (size_t end = count; begin < end;) {
        size_t middle = begin + (end - begin) / 2;
        if (placed[middle].height < low) {
            begin = middle + 1;
        } else {
            end = middle;
        }
    }
    for (; begin < count && placed[begin].height < low + 2.0 * same * cloud->spacing; begin++) {
        if (is_at(cloud, placed[begin].particle, X)) {
            return placed[begin].particle;
        }
    }
    return SIZE_MAX;
}

/* Particles of the part that the images are of, and across which axes. */
static bool pair_up(const struct cutting *of, struct solver_cloud *part, struct solver_error *error)
{
    size_t dim = (size_t)part->dim;
    size_t body = part->count - part->wall_count;
    struct placed *placed = NULL;
    bool found = true;
    if (!solver_alloc((void **)&placed, body, sizeof *placed, "mirror images", error)) {
        return false;
    }
    for (size_t a = 0; a < body; a++) {
        placed[a] = (struct placed){part->X[a * dim + dim - 1], (uint32_t)a};
    }
    qsort(placed, body, sizeof *placed, by_height);
    for (size_t w = 0; found && w < part->wall_count; w++) {
        double X[3] = {0};
        for (size_t i = 0; i < dim; i++) {
            bool crossed = !(above(of, part->symmetry->from[body + w], i) > -same);
            X[i] = part->X[(body + w) * dim + i];
            X[i] = crossed ? 2.0 * of->shape->plane[i] - X[i] : X[i];
            part->symmetry->across[w] |= (uint8_t)((crossed ? 1U : 0U) << i);
        }
        size_t a = find(part, placed, body, X);
        part->image[w] = (uint32_t)a;
        found = a != SIZE_MAX;
    }
    free(placed);
    return found || solver_fail(error, SOLVER_BAD_INPUT,
                                "domain.symmetry: the particles below a plane are no mirror image of those above");
}

/* --- the part of the cloud --- */

static bool reserve(const struct cutting *of, struct solver_cloud *part, struct solver_error *error)
{
    size_t dim = (size_t)of->whole->dim;
    struct solver_symmetry *symmetry = NULL;
    part->dim = of->whole->dim;
    part->spacing = of->whole->spacing;
    part->wall_count = of->count[NEAR] + of->count[FAR];
    part->count = of->count[PART] + part->wall_count;
    if (!solver_alloc((void **)&symmetry, 1, sizeof *symmetry, "symmetry", error)) {
        return false;
    }
    part->symmetry = symmetry;
    memcpy(symmetry->plane, of->shape->plane, sizeof symmetry->plane);
    return solver_alloc((void **)&part->X, part->count * dim, sizeof(double), "particle positions", error) &&
           solver_alloc((void **)&part->V, part->count, sizeof(double), "particle volumes", error) &&
           solver_alloc((void **)&part->tags, part->count, sizeof(uint32_t), "particle tags", error) &&
           solver_alloc((void **)&part->image, part->wall_count, sizeof(uint32_t), "mirror images", error) &&
           solver_alloc((void **)&part->cell, of->cells << dim, sizeof(uint32_t), "cells", error) &&
           solver_alloc((void **)&part->face_point, of->face_points, sizeof *part->face_point, "face points", error) &&
           solver_alloc((void **)&symmetry->across, part->wall_count, sizeof(uint8_t), "mirror images", error) &&
           solver_alloc((void **)&symmetry->halves, part->count, sizeof(uint8_t), "symmetry", error) &&
           solver_alloc((void **)&symmetry->from, part->count, sizeof(uint32_t), "symmetry", error);
}

/* Particles above the planes, then images; `to` becomes where those of the whole are. */
static void take_particles(const struct cutting *of, struct solver_cloud *part, uint32_t *to)
{
    size_t dim = (size_t)part->dim;
    size_t made = 0;
    for (int images = 0; images < 2; images++) {
        for (size_t a = 0; a < of->whole->count; a++) {
            if (of->keep[a] == NOT || (of->keep[a] != PART) != (images == 1)) {
                continue;
            }
            unsigned halves = 0;
            to[a] = (uint32_t)made;
            part->symmetry->from[made] = (uint32_t)a;
            memcpy(part->X + made * dim, of->whole->X + a * dim, dim * sizeof(double));
            for (size_t i = 0; images == 0 && i < dim; i++) {
                bool on = fabs(above(of, a, i)) < same;
                halves += on ? 1 : 0;
                part->tags[made] |= (on ? 1U : 0U) << 2 * i;
            }
            part->symmetry->halves[made] = (uint8_t)halves;
            if (images == 0) { /* an image has no volume of its own, and lies on no face */
                part->tags[made] |= of->whole->tags[a];
                part->V[made] = ldexp(of->whole->V[a], -(int)halves);
            }
            made++;
        }
    }
}

/* Cells with all corners above, and what face points have there. */
static void take_surface(const struct cutting *of, struct solver_cloud *part, const uint32_t *to)
{
    size_t corners = (size_t)1 << part->dim;
    for (size_t c = 0; c < of->whole->cell_count; c++) {
        if (has_cell(of, c)) {
            for (size_t k = 0; k < corners; k++) {
                part->cell[part->cell_count * corners + k] = to[of->whole->cell[c * corners + k]];
            }
            part->cell_count++;
        }
    }
    for (size_t i = 0; i < of->whole->face_point_count; i++) {
        struct solver_face_point point = of->whole->face_point[i];
        if (of->keep[point.particle] != PART) {
            continue;
        }
        point.particle = to[point.particle];
        for (size_t k = 0; k < 3; k++) {
            bool out_of_plane = (part->tags[point.particle] >> 2 * k & 1U) != 0 && of->shape->cut[k];
            point.area[k] = out_of_plane ? 0.0 : ldexp(point.area[k], -(int)part->symmetry->halves[point.particle]);
        }
        part->face_point[part->face_point_count++] = point;
    }
}

static bool fill(struct cutting *of, struct solver_cloud *part, struct solver_error *error)
{
    uint32_t *to = NULL;
    bool done = reserve(of, part, error) &&
                solver_alloc((void **)&to, of->whole->count, sizeof *to, "numbers of particles", error);
    if (done) {
        take_particles(of, part, to);
        take_surface(of, part, to);
        done = pair_up(of, part, error);
    }
    free(to);
    return done;
}

bool solver_symmetry_cut(struct solver_cloud *whole, const struct solver_shape *shape, double radius,
                         struct solver_cloud **out, struct solver_error *error)
{
    struct cutting of = {.whole = whole, .shape = shape};
    struct solver_cloud *part = NULL;
    bool done = solver_graph_build(whole, radius, &of.graph, error) &&
                solver_alloc((void **)&of.keep, whole->count, sizeof *of.keep, "symmetry", error) &&
                solver_alloc((void **)&part, 1, sizeof *part, "cloud", error);
    if (done) {
        mark(&of);
        done = fill(&of, part, error);
    }
    solver_graph_free(&of.graph);
    free(of.keep);
    if (done) {
        part->symmetry->whole = whole;
    } else {
        solver_cloud_free(part);
        solver_cloud_free(whole);
    }
    *out = done ? part : NULL;
    return done;
}

void solver_symmetry_arrays(const struct solver_cloud *part, struct solver_cost_arrays *arrays)
{
    static const char group[] = "symmetry";
    const struct solver_symmetry *symmetry = part->symmetry;
    if (symmetry != NULL) {
        solver_cost_array(arrays, group, "planes crossed", symmetry->across, part->wall_count, sizeof(uint8_t));
        solver_cost_array(arrays, group, "halvings", symmetry->halves, part->count, sizeof(uint8_t));
        solver_cost_array(arrays, group, "particles of the whole", symmetry->from, part->count, sizeof(uint32_t));
        solver_cost_array(arrays, group, "itself", symmetry, 1, sizeof *symmetry);
    }
}

void solver_symmetry_terms(const struct solver_cloud *part, struct solver_cost_terms *terms)
{
    if (part->symmetry != NULL) { /* places alone: signs are free */
        solver_cost_term(terms, "mirror images", 0, (double)part->wall_count * part->dim);
    }
}

void solver_symmetry_free(struct solver_symmetry *symmetry)
{
    if (symmetry != NULL) {
        solver_cloud_free(symmetry->whole);
        free(symmetry->across);
        free(symmetry->from);
        free(symmetry->halves);
        free(symmetry);
    }
}

/* --- the part of the stencil --- */

/* Number of a particle of the whole in the part; UINT32_MAX: it is not kept. */
static bool number(const struct solver_cloud *part, size_t whole_count, uint32_t **to, struct solver_error *error)
{
    if (!solver_alloc((void **)to, whole_count, sizeof **to, "numbers of particles", error)) {
        return false;
    }
    for (size_t a = 0; a < whole_count; a++) {
        (*to)[a] = UINT32_MAX;
    }
    for (size_t a = 0; a < part->count; a++) {
        (*to)[part->symmetry->from[a]] = (uint32_t)a;
    }
    return true;
}

static bool is_complete(const struct solver_stencil *whole, const uint32_t *to, size_t from)
{
    bool complete = true;
    for (size_t ab = whole->graph.row[from]; ab < whole->graph.row[from + 1]; ab++) {
        complete = complete && to[whole->graph.neighbour[ab]] != UINT32_MAX;
    }
    return complete;
}

/* A row that lacks a neighbour, far below the planes, is left empty. */
static bool count_pairs(const struct solver_stencil *whole, const struct solver_cloud *part, const uint32_t *to,
                        struct solver_graph *graph, struct solver_error *error)
{
    size_t body = part->count - part->wall_count;
    graph->count = part->count;
    graph->row_room = part->count + 1;
    if (!solver_alloc((void **)&graph->row, part->count + 1, sizeof *graph->row, "rows of neighbours", error)) {
        return false;
    }
    for (size_t a = 0; a < part->count; a++) {
        size_t from = part->symmetry->from[a];
        bool complete = is_complete(whole, to, from);
        if (!complete && a < body) {
            return solver_fail(error, SOLVER_BAD_INPUT,
                               "domain.symmetry: the stencil reaches farther than its support");
        }
        graph->row[a + 1] = graph->row[a] + (complete ? whole->graph.row[from + 1] - whole->graph.row[from] : 0);
    }
    graph->neighbour_room = graph->row[part->count];
    return solver_alloc((void **)&graph->neighbour, graph->neighbour_room, sizeof *graph->neighbour, "neighbours",
                        error);
}

struct numbered {
    uint32_t neighbour;
    size_t pair; /* of the whole */
};

static int by_neighbour(const void *left, const void *right)
{
    const struct numbered *a = left;
    const struct numbered *b = right;
    return a->neighbour < b->neighbour ? -1 : a->neighbour > b->neighbour;
}

static bool take_rows(const struct solver_stencil *whole, const struct solver_cloud *part, const uint32_t *to,
                      struct solver_stencil *kept, struct solver_error *error)
{
    size_t dim = (size_t)whole->dim;
    struct numbered *order = NULL;
    if (!solver_alloc((void **)&order, whole->count, sizeof *order, "rows of neighbours", error)) {
        return false;
    }
    for (size_t a = 0; a < part->count; a++) {
        size_t from = part->symmetry->from[a];
        size_t first = kept->graph.row[a];
        size_t count = kept->graph.row[a + 1] - first;
        for (size_t k = 0; k < count; k++) {
            size_t pair = whole->graph.row[from] + k;
            order[k] = (struct numbered){to[whole->graph.neighbour[pair]], pair};
        }
        qsort(order, count, sizeof *order, by_neighbour);
        for (size_t k = 0; k < count; k++) {
            size_t pair = order[k].pair;
            kept->graph.neighbour[first + k] = order[k].neighbour;
            memcpy(solver_stencil_C(kept, first + k), solver_stencil_C(whole, pair), (dim + 1) * sizeof(double));
            if (kept->transposed != NULL && whole->transposed != NULL) {
                memcpy(kept->transposed + (first + k) * dim, whole->transposed + pair * dim, dim * sizeof(double));
            }
            if (kept->least_squares != NULL && whole->least_squares != NULL) {
                memcpy(kept->least_squares + (first + k) * dim, whole->least_squares + pair * dim,
                       dim * sizeof(double));
            }
        }
        memcpy(kept->row_sum + a * dim, whole->row_sum + from * dim, dim * sizeof(double));
        kept->V[a] = whole->V[from];
        kept->own[a] =
            a < part->count - part->wall_count ? ldexp(whole->V[from], -(int)part->symmetry->halves[a]) : 0.0;
    }
    free(order);
    return true;
}

bool solver_symmetry_keep(struct solver_stencil *whole, const struct solver_cloud *part, struct solver_stencil **out,
                          struct solver_error *error)
{
    size_t dim = (size_t)whole->dim;
    struct solver_stencil *kept = NULL;
    uint32_t *to = NULL;
    bool done = solver_alloc((void **)&kept, 1, sizeof *kept, "stencil", error) &&
                number(part, whole->count, &to, error) && count_pairs(whole, part, to, &kept->graph, error) &&
                solver_stencil_reserve(kept, part, error) &&
                solver_alloc((void **)&kept->own, part->count, sizeof(double), "volumes", error) &&
                (whole->transposed == NULL || solver_alloc((void **)&kept->transposed, kept->pairs * dim,
                                                           sizeof(double), "transposed pair vectors", error)) &&
                (whole->least_squares == NULL || solver_alloc((void **)&kept->least_squares, kept->pairs * dim,
                                                              sizeof(double), "least-squares gradient", error)) &&
                take_rows(whole, part, to, kept, error);
    free(to);
    solver_stencil_free(whole);
    if (!done) {
        solver_stencil_free(kept);
    }
    *out = done ? kept : NULL;
    return done;
}

/* --- the state of images --- */

/* A scalar, a padded vector, or a tensor of padded columns: each index across a plane changes the sign. */
static void reflect(const double *from, double *to, size_t width, size_t lanes, unsigned across)
{
    for (size_t i = 0; lanes > 0 && i < width; i++) {
        unsigned turns = width == 1 ? 0 : across >> i % lanes & 1U;
        turns ^= width > lanes ? across >> i / lanes & 1U : 0;
        to[i] = turns != 0 ? -from[i] : from[i];
    }
}

void solver_symmetry_reflect(const struct solver_cloud *part, struct solver_state *state)
{
    const struct solver_symmetry *symmetry = part->symmetry;
    size_t body = part->count - part->wall_count;
#pragma omp parallel for schedule(static)
    for (size_t w = 0; w < part->wall_count; w++) {
        unsigned across = symmetry->across[w];
        for (size_t f = 0; f < state->field_count && state->field[f].evolved; f++) {
            size_t width = state->field[f].width;
            double *of_field = state->U + state->field[f].offset;
            reflect(of_field + part->image[w] * width, of_field + (body + w) * width, width, state->lanes, across);
        }
        for (size_t i = 0; i < (size_t)part->dim; i++) { /* a place is reflected in the plane */
            double shift = (across >> i & 1U) != 0 ? 2.0 * symmetry->plane[i] : 0.0;
            state->x[(body + w) * state->lanes + i] += shift;
        }
    }
}
