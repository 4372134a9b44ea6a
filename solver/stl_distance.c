/* The signed distance from a closed surface of triangles, by a tree of boxes. */
#include "solver/memory.h"
#include "solver/stl.h"

#include <math.h>
#include <string.h>

enum { LEAF = 4 }; /* triangles */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* --- the tree --- */

/* Orders triangles by their middles along one axis. */
struct ranked {
    double middle;
    uint32_t triangle;
};

static int by_middle(const void *left, const void *right)
{
    const struct ranked *a = left;
    const struct ranked *b = right;
    if (a->middle != b->middle) {
        return a->middle < b->middle ? -1 : 1;
    }
    return a->triangle < b->triangle ? -1 : a->triangle > b->triangle;
}

static void enclose(const struct solver_stl *surface, struct stl_box *box)
{
    for (int i = 0; i < 3; i++) {
        box->lower[i] = INFINITY;
        box->upper[i] = -INFINITY;
        for (uint32_t t = box->first; t < box->first + box->count; t++) {
            for (int c = 0; c < 3; c++) {
                double x = surface->vertex[surface->triangle[surface->order[t]][c]][i];
                box->lower[i] = fmin(box->lower[i], x);
                box->upper[i] = fmax(box->upper[i], x);
            }
        }
    }
}

/* Makes the box of these triangles and those within it; halves, so that the tree is as deep as the count has bits. */
static void divide(struct solver_stl *surface, struct ranked *ranked, uint32_t first, uint32_t count)
{
    struct stl_box *box = &surface->box[surface->box_count++];
    int longest = 0;
    *box = (struct stl_box){.first = first, .count = count};
    enclose(surface, box);
    if (count <= LEAF) {
        return;
    }
    for (int i = 1; i < 3; i++) {
        longest = box->upper[i] - box->lower[i] > box->upper[longest] - box->lower[longest] ? i : longest;
    }
    for (uint32_t t = 0; t < count; t++) {
        uint32_t triangle = surface->order[first + t];
        const uint32_t *of = surface->triangle[triangle];
        ranked[t] = (struct ranked){surface->vertex[of[0]][longest] + surface->vertex[of[1]][longest] +
                                        surface->vertex[of[2]][longest],
                                    triangle};
    }
    qsort(ranked, count, sizeof *ranked, by_middle);
    for (uint32_t t = 0; t < count; t++) {
        surface->order[first + t] = ranked[t].triangle;
    }
    divide(surface, ranked, first, count / 2);
    box->right = (uint32_t)surface->box_count;
    divide(surface, ranked, first + count / 2, count - count / 2);
}

bool stl_plant(struct solver_stl *surface, struct solver_error *error)
{
    struct ranked *ranked = NULL;
    if (!solver_alloc((void **)&surface->box, 2 * surface->count, sizeof *surface->box, "tree of triangles", error) ||
        !solver_alloc((void **)&surface->order, surface->count, sizeof *surface->order, "tree of triangles", error) ||
        !solver_alloc((void **)&ranked, surface->count, sizeof *ranked, "tree of triangles", error)) {
        return false;
    }
    for (size_t t = 0; t < surface->count; t++) {
        surface->order[t] = (uint32_t)t;
    }
    divide(surface, ranked, 0, (uint32_t)surface->count);
    free(ranked);
    return true;
}

/* --- the nearest point --- */

struct nearest {
    double square, side; /* side: along the normal there */
};

/* The point on a triangle nearest to X as weights of its corners (Ericson 2005, Real-Time Collision Detection, 5.1.5);
 * returns the bits of the corners that have weight. */
static unsigned weights(const double *const corner[3], const double X[3], double weight[3])
{
    double ab[3];
    double ac[3];
    double d[3][2]; /* (X - corner) along ab and ac */
    for (int i = 0; i < 3; i++) {
        ab[i] = corner[1][i] - corner[0][i];
        ac[i] = corner[2][i] - corner[0][i];
    }
    for (int c = 0; c < 3; c++) {
        double from[3] = {X[0] - corner[c][0], X[1] - corner[c][1], X[2] - corner[c][2]};
        d[c][0] = dot(ab, from);
        d[c][1] = dot(ac, from);
    }
    weight[0] = weight[1] = weight[2] = 0.0;
    if (d[0][0] <= 0.0 && d[0][1] <= 0.0) {
        weight[0] = 1.0;
        return 1U;
    }
    if (d[1][0] >= 0.0 && d[1][1] <= d[1][0]) {
        weight[1] = 1.0;
        return 2U;
    }
    if (d[2][1] >= 0.0 && d[2][0] <= d[2][1]) {
        weight[2] = 1.0;
        return 4U;
    }
    double of_c = d[0][0] * d[1][1] - d[1][0] * d[0][1];
    if (of_c <= 0.0 && d[0][0] >= 0.0 && d[1][0] <= 0.0) {
        weight[1] = d[0][0] / (d[0][0] - d[1][0]);
        weight[0] = 1.0 - weight[1];
        return 3U;
    }
    double of_b = d[2][0] * d[0][1] - d[0][0] * d[2][1];
    if (of_b <= 0.0 && d[0][1] >= 0.0 && d[2][1] <= 0.0) {
        weight[2] = d[0][1] / (d[0][1] - d[2][1]);
        weight[0] = 1.0 - weight[2];
        return 5U;
    }
    double of_a = d[1][0] * d[2][1] - d[2][0] * d[1][1];
    if (of_a <= 0.0 && d[1][1] - d[1][0] >= 0.0 && d[2][0] - d[2][1] >= 0.0) {
        weight[2] = (d[1][1] - d[1][0]) / (d[1][1] - d[1][0] + d[2][0] - d[2][1]);
        weight[1] = 1.0 - weight[2];
        return 6U;
    }
    double sum = of_a + of_b + of_c;
    weight[1] = of_b / sum;
    weight[2] = of_c / sum;
    weight[0] = 1.0 - weight[1] - weight[2];
    return 7U;
}

static void look_at(const struct solver_stl *surface, uint32_t t, const double X[3], struct nearest *best)
{
    static const int edge_of[8] = {0, 0, 0, 0, 0, 2, 1, 0}; /* by the bits of its ends: 01, 20, 12 */
    const uint32_t *of = surface->triangle[t];
    const double *const corner[3] = {surface->vertex[of[0]], surface->vertex[of[1]], surface->vertex[of[2]]};
    double weight[3];
    double from[3];
    unsigned bits = weights(corner, X, weight);
    for (int i = 0; i < 3; i++) {
        from[i] = X[i] - (weight[0] * corner[0][i] + weight[1] * corner[1][i] + weight[2] * corner[2][i]);
    }
    double square = dot(from, from);
    if (square < best->square) {
        const double *normal = bits == 7U                  ? surface->normal[t]
                               : (bits & (bits - 1U)) != 0 ? surface->at_edge[t][edge_of[bits]]
                                                           : surface->at_vertex[of[bits / 2]];
        best->square = square;
        best->side = dot(from, normal);
    }
}

static double square_from(const struct stl_box *box, const double X[3])
{
    double square = 0.0;
    for (int i = 0; i < 3; i++) {
        double out = fmax(fmax(box->lower[i] - X[i], X[i] - box->upper[i]), 0.0);
        square += out * out;
    }
    return square;
}

static void descend(const struct solver_stl *surface, uint32_t b, const double X[3], struct nearest *best)
{
    const struct stl_box *box = &surface->box[b];
    if (box->right == 0) {
        for (uint32_t t = box->first; t < box->first + box->count; t++) {
            look_at(surface, surface->order[t], X, best);
        }
        return;
    }
    uint32_t half[2] = {b + 1, box->right};
    double square[2] = {square_from(&surface->box[half[0]], X), square_from(&surface->box[half[1]], X)};
    int first = square[1] < square[0] ? 1 : 0;
    for (int k = 0; k < 2; k++) {
        int at = k == 0 ? first : 1 - first;
        if (square[at] < best->square) {
            descend(surface, half[at], X, best);
        }
    }
}

double solver_stl_distance(const struct solver_stl *surface, const double X[3])
{
    struct nearest best = {.square = INFINITY};
    descend(surface, 0, X, &best);
    return copysign(sqrt(best.square), best.side);
}
