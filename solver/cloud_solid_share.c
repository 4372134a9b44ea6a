/* What of a solid and its surface is nearest to each particle.
 *
 * Cells of the lattice that the surface may pass are divided into parts, these into triangles or tetrahedra along their
 * diagonals (Kuhn's division, alike on both sides of every face), and each is cut by the linear function through the
 * distances at its corners. The pieces make up one closed polyhedron, so that area vectors sum to zero and volumes and
 * moments satisfy the divergence theorem to round-off. Each piece goes to the particle that is nearest to its centroid:
 * pieces of volume to any, pieces of the surface to one that lies on it, pieces of a face of the box to one on that. */
#include "solver/cloud_solid.h"
#include "solver/simplex.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct cell {
    const struct solid_grid *grid;
    struct solid_shares *shares;
    uint32_t at[3];
    const double *value; /* [SOLID_VALUES] [m] */
};

/* Adds to a sum of many terms of one size, which would lose digits otherwise (Kahan 1965). */
static void add(double *sum, double *rest, double term)
{
    double whole = term - *rest;
    double next = *sum + whole;
    *rest = (next - *sum) - whole;
    *sum = next;
}

static bool any(const struct solid_grid *grid, size_t node, uint32_t face)
{
    (void)grid;
    (void)node;
    (void)face;
    return true;
}

static bool on_surface(const struct solid_grid *grid, size_t node, uint32_t face)
{
    (void)face;
    return grid->moved[node];
}

static bool on_face(const struct solid_grid *grid, size_t node, uint32_t face)
{
    uint32_t at[3];
    solid_at(grid, node, at);
    return (solid_faces(grid, at) >> face & 1U) != 0;
}

/* The particle that takes a piece; remembers the largest distance. SOLID_NONE where there is none within two cells. */
static uint32_t taker(const struct cell *cell, const double centroid[3], solid_which *which, uint32_t face,
                      double *farthest, double *farthest_at)
{
    double square;
    uint32_t at[3];
    for (size_t axis = 0; axis < 3; axis++) { /* the node nearest to the piece */
        double along = axis < cell->grid->dim ? (centroid[axis] - solid_along(cell->grid, axis, cell->at[axis], 0)) /
                                                    cell->grid->solid->spacing
                                              : 0.0;
        at[axis] = cell->at[axis] + (along > 0.5 ? 1U : 0U);
    }
    size_t node = solid_nearest(cell->grid, at, centroid, which, face, &square);
    if (square > *farthest * *farthest) {
        *farthest = sqrt(square);
        memcpy(farthest_at, centroid, 3 * sizeof *farthest_at);
    }
    return node == SIZE_MAX ? SOLID_NONE : cell->grid->particle[node];
}

static void take_volume(const struct cell *cell, double volume, const double centroid[3])
{
    struct solid_shares *shares = cell->shares;
    uint32_t a = taker(cell, centroid, any, 0, &shares->farthest, shares->farthest_at);
    add(&shares->volume, &shares->volume_rest, volume);
    for (int i = 0; i < 3; i++) {
        add(&shares->moment[i], &shares->moment_rest[i], volume * centroid[i]);
    }
    if (a != SOLID_NONE) {
        shares->V[a] += volume;
    }
}

static void take_surface(const struct cell *cell, const struct simplices *cut, const double outward[3])
{
    struct solid_shares *shares = cell->shares;
    for (size_t s = 0; s < cut->count; s++) {
        double centroid[3];
        double area[3];
        double measure = simplex_measure(cut->size, cut->corner[s], centroid);
        if (measure == 0.0) {
            continue;
        }
        uint32_t a = taker(cell, centroid, on_surface, 0, &shares->widest, shares->widest_at);
        simplex_area(cut->size, cut->corner[s], outward, area);
        add(&shares->area, &shares->area_rest, measure);
        for (int i = 0; a != SOLID_NONE && i < 3; i++) {
            shares->surface[a][i] += area[i];
        }
    }
}

static void take_face(const struct cell *cell, const struct simplices *inside, uint32_t face)
{
    struct solid_shares *shares = cell->shares;
    for (size_t s = 0; s < inside->count; s++) {
        double centroid[3];
        double measure = simplex_measure(inside->size, inside->corner[s], centroid);
        if (measure == 0.0) {
            continue;
        }
        uint32_t a = taker(cell, centroid, on_face, face, &shares->widest, shares->widest_at);
        add(&shares->area, &shares->area_rest, measure);
        if (a != SOLID_NONE) {
            shares->face[a][face] += measure;
        }
    }
}

/* From an inner to an outer corner. */
static void direction_out(size_t size, const double (*corner)[3], const double *value, double outward[3])
{
    size_t low = 0;
    size_t high = 0;
    for (size_t i = 1; i < size; i++) {
        low = value[i] < value[low] ? i : low;
        high = value[i] > value[high] ? i : high;
    }
    for (int i = 0; i < 3; i++) {
        outward[i] = corner[high][i] - corner[low][i];
    }
}

/* One simplex of a part: `step` are the offsets of its corners. */
static void cut_simplex(const struct cell *cell, const uint32_t part[3], size_t size, const uint32_t (*step)[3])
{
    size_t dim = cell->grid->dim;
    double corner[4][3] = {{0}};
    double value[4] = {0};
    double outward[3];
    struct simplices inside;
    struct simplices cut;
    uint32_t faces = ~0U; /* of the box on which all corners lie */
    for (size_t c = 0; c < size; c++) {
        uint32_t in[3] = {part[0] + step[c][0], part[1] + step[c][1], part[2] + step[c][2]};
        uint32_t at_end = 0;
        for (size_t axis = 0; axis < 3; axis++) {
            uint32_t along = cell->at[axis] * SOLID_PARTS + in[axis];
            corner[c][axis] = solid_along(cell->grid, axis, cell->at[axis], in[axis]);
            at_end |= axis >= dim ? 0U
                                  : (along == 0 ? 1U << (2 * axis) : 0U) |
                                        (along == cell->grid->cells[axis] * SOLID_PARTS ? 2U << (2 * axis) : 0U);
        }
        value[c] = cell->value[(in[2] * SOLID_LINE + in[1]) * SOLID_LINE + in[0]];
        faces &= at_end;
    }
    simplex_cut(size, corner, value, &inside, &cut);
    if (size == dim) { /* a side of a simplex, on a face of the box or not */
        if (faces != 0) {
            take_face(cell, &inside, (uint32_t)__builtin_ctz(faces));
        }
        return;
    }
    for (size_t s = 0; s < inside.count; s++) {
        double centroid[3];
        double volume = simplex_measure(size, inside.corner[s], centroid);
        if (volume > 0.0) {
            take_volume(cell, volume, centroid);
        }
    }
    direction_out(size, corner, value, outward);
    take_surface(cell, &cut, outward);
}

/* The simplices of a part: one for each order in which its axes are walked from its lower to its upper corner, and the
 * sides that leave out the first or the last corner, which may lie on faces of the box. In the upper half of the box
 * an axis is walked the other way, so that the division is its own mirror image. */
static void cut_part(const struct cell *cell, const uint32_t part[3])
{
    static const uint32_t order[6][3] = {{0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {2, 0, 1}, {1, 2, 0}, {2, 1, 0}};
    size_t dim = cell->grid->dim;
    uint32_t flip[3];
    for (size_t axis = 0; axis < 3; axis++) {
        flip[axis] =
            axis < dim && 2 * (cell->at[axis] * SOLID_PARTS + part[axis]) >= cell->grid->cells[axis] * SOLID_PARTS;
    }
    for (size_t o = 0; o < (dim == 2 ? 2 : 6); o++) {
        uint32_t step[4][3] = {{flip[0], flip[1], flip[2]}};
        for (size_t c = 0; c < dim; c++) {
            memcpy(step[c + 1], step[c], sizeof step[c]);
            step[c + 1][order[o][c]] = 1 - flip[order[o][c]];
        }
        cut_simplex(cell, part, dim + 1, (const uint32_t(*)[3])step);
        cut_simplex(cell, part, dim, (const uint32_t(*)[3])step);
        cut_simplex(cell, part, dim, (const uint32_t(*)[3])(step + 1));
    }
}

static void share_parts(const struct cell *cell)
{
    uint32_t deep = cell->grid->dim == 3 ? SOLID_PARTS : 1;
    for (uint32_t k = 0; k < deep; k++) {
        for (uint32_t j = 0; j < SOLID_PARTS; j++) {
            for (uint32_t i = 0; i < SOLID_PARTS; i++) {
                cut_part(cell, (uint32_t[3]){i, j, k});
            }
        }
    }
}

/* A cell well inside, with particles at its corners, is shared by them, and so are its sides on faces of the box. */
static bool share_whole(const struct cell *cell)
{
    const struct solid_grid *grid = cell->grid;
    struct solid_shares *shares = cell->shares;
    size_t corners = (size_t)1 << grid->dim;
    size_t node[8];
    uint32_t faces[8];
    for (size_t c = 0; c < corners; c++) {
        uint32_t at[3] = {cell->at[0] + (c & 1U), cell->at[1] + (c >> 1 & 1U), cell->at[2] + (c >> 2 & 1U)};
        node[c] = solid_node(grid, at);
        faces[c] = solid_faces(grid, at);
        if (!grid->kept[node[c]] || grid->moved[node[c]]) {
            return false;
        }
    }
    double share = pow(0.5 * grid->solid->spacing, (double)grid->dim);
    double side = pow(0.5 * grid->solid->spacing, (double)grid->dim - 1.0);
    for (size_t c = 0; c < corners; c++) {
        uint32_t a = grid->particle[node[c]];
        shares->V[a] += share;
        add(&shares->volume, &shares->volume_rest, share);
        for (int i = 0; i < 3; i++) {
            add(&shares->moment[i], &shares->moment_rest[i],
                share * grid->X[node[c]][i]); /* their mean is the cell's middle */
        }
        for (uint32_t face = 0; face < 6; face++) {
            bool on = (faces[c] >> face & 1U) != 0;
            shares->face[a][face] += on ? side : 0.0;
            add(&shares->area, &shares->area_rest, on ? side : 0.0);
        }
    }
    return true;
}

/* Index of a cell, which is that of its place among cells. */
static void cell_at(const struct solid_grid *grid, size_t c, uint32_t at[3])
{
    at[0] = (uint32_t)(c % grid->cells[0]);
    at[1] = (uint32_t)(c / grid->cells[0] % grid->cells[1]);
    at[2] = (uint32_t)(c / grid->cells[0] / grid->cells[1]);
}

static bool ask(const struct solid_grid *grid, const uint32_t at[3], const uint32_t part[3], double *value,
                struct solver_error *error)
{
    double X[3];
    for (size_t axis = 0; axis < 3; axis++) {
        X[axis] = solid_along(grid, axis, at[axis], part[axis]);
    }
    return grid->solid->distance(grid->solid->context, X, value, error);
}

/* Distances at the corners of a cell's parts, into a new place. */
static bool ask_all(struct solid_grid *grid, const uint32_t at[3], uint32_t *place, struct solver_error *error)
{
    if (grid->value_count == grid->value_room) {
        size_t room = 2 * grid->value_room + 64;
        double(*grown)[SOLID_VALUES] = realloc(grid->value, room * sizeof *grown);
        if (grown == NULL) {
            return solver_fail(error, SOLVER_NO_MEMORY, "no memory for distances within %zu cells; choose a smaller n",
                               room);
        }
        grid->value = grown;
        grid->value_room = room;
    }
    double *value = grid->value[grid->value_count];
    uint32_t deep = grid->dim == 3 ? SOLID_LINE : 1;
    for (uint32_t k = 0; k < deep; k++) {
        for (uint32_t j = 0; j < SOLID_LINE; j++) {
            for (uint32_t i = 0; i < SOLID_LINE; i++) {
                if (!ask(grid, at, (uint32_t[3]){i, j, k}, value++, error)) {
                    return false;
                }
            }
        }
    }
    *place = (uint32_t)grid->value_count++;
    return true;
}

bool solid_divide(struct solid_grid *grid, struct solver_error *error)
{
    double half = 0.5 * sqrt((double)grid->dim) * grid->solid->spacing;
    uint32_t mid[3] = {SOLID_PARTS / 2, SOLID_PARTS / 2, SOLID_PARTS / 2};
    for (size_t c = 0; c < grid->cell_count; c++) {
        uint32_t at[3];
        double middle;
        cell_at(grid, c, at);
        if (!ask(grid, at, mid, &middle, error)) {
            return false;
        }
        grid->divided[c] = middle > half * (1.0 + 1e-9) ? SOLID_OUTSIDE : SOLID_WHOLE;
        if (fabs(middle) <= half * (1.0 + 1e-9) && !ask_all(grid, at, &grid->divided[c], error)) {
            return false;
        }
    }
    return true;
}

void solid_share(const struct solid_grid *grid, struct solid_shares *shares)
{
    double within[SOLID_VALUES]; /* of a cell that lies within, but has no particles of its own at all corners */
    struct cell cell = {.grid = grid, .shares = shares};
    for (size_t i = 0; i < SOLID_VALUES; i++) {
        within[i] = -grid->solid->spacing;
    }
    for (size_t c = 0; c < grid->cell_count; c++) {
        cell_at(grid, c, cell.at);
        if (grid->divided[c] == SOLID_OUTSIDE || (grid->divided[c] == SOLID_WHOLE && share_whole(&cell))) {
            continue;
        }
        cell.value = grid->divided[c] == SOLID_WHOLE ? within : grid->value[grid->divided[c]];
        share_parts(&cell);
    }
}
