/* Summation-by-parts operators along the lines of a lattice: H D = Q, Q + Q^T = diag(-1, 0, ..., 0, 1), H diagonal.
 * As pair vectors C_ab = 2 Q_ab times the quadrature weights of the other axes. The 4-2 coefficients are those of
 * Strand, J. Comput. Phys. 110 (1994), with diagonal norm. */
#include "solver/memory.h"
#include "solver/stencil.h"

#include <math.h>
#include <stdlib.h>

struct line_operator {
    const char *name;
    uint32_t fewest;    /* points a line must have */
    uint32_t reach;     /* largest index distance of a pair */
    uint32_t block;     /* rows of the boundary block */
    double weight[4];   /* H of the boundary rows, in spacings */
    double Q[4][6];     /* upper triangle of the boundary rows: Q[i][j], j > i */
    double interior[3]; /* Q at index distance 1, 2 */
};

static const struct line_operator sbp2 = {
    .name = "sbp2",
    .fewest = 2,
    .reach = 1,
    .block = 1,
    .weight = {1.0 / 2.0},
    .Q = {{0, 1.0 / 2.0}},
    .interior = {0, 1.0 / 2.0},
};

static const struct line_operator sbp4 = {
    .name = "sbp4",
    .fewest = 8,
    .reach = 3,
    .block = 4,
    .weight = {17.0 / 48.0, 59.0 / 48.0, 43.0 / 48.0, 49.0 / 48.0},
    .Q = {{0, 59.0 / 96.0, -1.0 / 12.0, -1.0 / 32.0},
          {0, 0, 59.0 / 96.0, 0.0},
          {0, 0, 0, 59.0 / 96.0, -1.0 / 12.0},
          {0, 0, 0, 0, 2.0 / 3.0, -1.0 / 12.0}},
    .interior = {0, 2.0 / 3.0, -1.0 / 12.0},
};

static double weight(const struct line_operator *line, uint32_t i, uint32_t points)
{
    uint32_t end = i < points - 1 - i ? i : points - 1 - i;
    return end < line->block ? line->weight[end] : 1.0;
}

/* Q_ij for i < j; the right end is the left end mirrored. */
static double entry(const struct line_operator *line, uint32_t i, uint32_t j, uint32_t points)
{
    if (i < line->block) {
        return j < 6 ? line->Q[i][j] : 0.0;
    }
    uint32_t mirrored = points - 1 - j;
    if (mirrored < line->block) {
        uint32_t other = points - 1 - i;
        return other < 6 ? line->Q[mirrored][other] : 0.0;
    }
    return j - i < 3 ? line->interior[j - i] : 0.0;
}

/* Calls for every particle b on a line with a, at most `reach` apart, with Q_ab not zero. Fills b and Q; returns how
 * many. Sites are found through the cloud's lattice indices. */
struct line_pair {
    uint32_t neighbour, axis;
    double Q;
};

static size_t list_pairs(const struct solver_cloud *cloud, const struct line_operator *line,
                         const uint32_t *particle_at, size_t a, struct line_pair *out)
{
    size_t dim = (size_t)cloud->dim;
    const uint32_t *site = cloud->site + a * dim;
    size_t stride[3] = {1, cloud->points[0], (size_t)cloud->points[0] * cloud->points[1]};
    size_t home = 0;
    size_t found = 0;
    for (size_t axis = 0; axis < dim; axis++) {
        home += site[axis] * stride[axis];
    }
    for (uint32_t axis = 0; axis < dim; axis++) {
        uint32_t points = cloud->points[axis];
        uint32_t first = site[axis] > line->reach ? site[axis] - line->reach : 0;
        for (uint32_t j = first; j <= site[axis] + line->reach && j < points; j++) {
            double Q = j == site[axis]  ? 0.0
                       : j > site[axis] ? entry(line, site[axis], j, points)
                                        : -entry(line, j, site[axis], points);
            if (Q != 0.0) {
                size_t at = home + j * stride[axis] - site[axis] * stride[axis];
                out[found++] = (struct line_pair){.neighbour = particle_at[at], .axis = axis, .Q = Q};
            }
        }
    }
    for (size_t i = 1; i < found; i++) { /* ascending neighbours: a handful, insertion sort */
        struct line_pair moved = out[i];
        size_t k = i;
        for (; k > 0 && out[k - 1].neighbour > moved.neighbour; k--) {
            out[k] = out[k - 1];
        }
        out[k] = moved;
    }
    return found;
}

/* Product of the quadrature weights [m] of all axes but `except` (3: of all). */
static double measure(const struct solver_cloud *cloud, const struct line_operator *line, size_t a, size_t except)
{
    size_t dim = (size_t)cloud->dim;
    double product = 1.0;
    for (size_t axis = 0; axis < dim; axis++) {
        if (axis != except) {
            product *= cloud->spacing * weight(line, cloud->site[a * dim + axis], cloud->points[axis]);
        }
    }
    return product;
}

static bool check(const struct solver_cloud *cloud, const struct line_operator *line, struct solver_error *error)
{
    size_t dim = (size_t)cloud->dim;
    for (size_t axis = 0; axis < dim; axis++) {
        if (cloud->points[axis] < line->fewest) {
            return solver_fail(error, SOLVER_BAD_INPUT,
                               "stencil: %s needs at least %u particles along every edge, edge %c has %u; choose a "
                               "larger n, or stencil sbp2 or closed",
                               line->name, line->fewest, "XYZ"[axis], cloud -> points[axis]);
        }
    }
    double tolerance = 1e-9 * cloud->spacing;
    for (size_t a = 0; a < cloud->count; a++) {
        for (size_t axis = 0; axis < dim; axis++) {
            /* particle 0 is the lattice's first site, so its position is the lattice's origin */
            double expected = cloud->X[axis] + cloud->spacing * (double)cloud->site[a * dim + axis];
            if (fabs(cloud->X[a * dim + axis] - expected) > tolerance * (1.0 + (double)cloud->points[axis])) {
                return solver_fail(error, SOLVER_BAD_INPUT,
                                   "stencil: %s works on lattices only, and this cloud is perturbed; use stencil "
                                   "closed or perturb = 0",
                                   line->name);
            }
        }
    }
    return true;
}

static bool build(const struct solver_cloud *cloud, const struct line_operator *line, struct solver_stencil *stencil,
                  struct solver_error *error)
{
    enum { MOST = 18 };
    size_t dim = (size_t)cloud->dim;
    struct solver_graph *graph = &stencil->graph;
    uint32_t *particle_at = NULL;
    struct line_pair pairs[MOST];
    graph->count = cloud->count;
    if (!check(cloud, line, error) ||
        !solver_alloc((void **)&particle_at, cloud->count, sizeof *particle_at, "lattice map", error)) {
        return false;
    }
    for (size_t a = 0; a < cloud->count; a++) {
        size_t at = 0;
        for (size_t axis = dim; axis-- > 0;) {
            at = at * cloud->points[axis] + cloud->site[a * dim + axis];
        }
        particle_at[at] = (uint32_t)a;
    }
    bool ok = solver_alloc((void **)&graph->row, cloud->count + 1, sizeof *graph->row, "neighbour graph", error);
    for (size_t a = 0; ok && a < cloud->count; a++) {
        graph->row[a + 1] = graph->row[a] + list_pairs(cloud, line, particle_at, a, pairs);
    }
    ok = ok &&
         solver_alloc((void **)&graph->neighbour, graph->row[cloud->count], sizeof *graph->neighbour, "neighbour graph",
                      error) &&
         solver_stencil_reserve(stencil, cloud, error);
    for (size_t a = 0; ok && a < cloud->count; a++) {
        size_t found = list_pairs(cloud, line, particle_at, a, pairs);
        stencil->V[a] = measure(cloud, line, a, 3);
        for (size_t i = 0; i < found; i++) {
            size_t ab = graph->row[a] + i;
            graph->neighbour[ab] = pairs[i].neighbour;
            solver_stencil_C(stencil, ab)[pairs[i].axis] = 2.0 * pairs[i].Q * measure(cloud, line, a, pairs[i].axis);
        }
    }
    for (size_t i = 0; ok && i < stencil->face_point_count; i++) {
        struct solver_face_point *point = &stencil->face_point[i];
        size_t axis = point->face / 2;
        point->area[axis] = (point->face % 2 == 0 ? -1.0 : 1.0) * measure(cloud, line, point->particle, axis);
    }
    free(particle_at);
    return ok;
}

bool solver_stencil_sbp2(const struct solver_cloud *cloud, double support, struct solver_stencil *stencil,
                         struct solver_error *error)
{
    (void)support; /* its neighbours follow from its order */
    return build(cloud, &sbp2, stencil, error);
}

bool solver_stencil_sbp4(const struct solver_cloud *cloud, double support, struct solver_stencil *stencil,
                         struct solver_error *error)
{
    (void)support;
    return build(cloud, &sbp4, stencil, error);
}
