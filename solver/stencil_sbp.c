/* Summation-by-parts operators along the lines of a lattice: H D = Q, Q + Q^T = diag(-1, 0, ..., 0, 1), H diagonal.
 * As pair vectors C_ab = 2 Q_ab times the quadrature weights of the other axes.
 *
 * On a graded lattice the weights are w = Q X, those that make D X = 1. They sum to the length and have its first
 * moment, since 1^T Q = (-1, 0, ..., 0, 1) and X^T Q X = [X^2]/2; what follows from Q alone, antisymmetry and closure,
 * stays. So D is the operator in a coordinate whose steps are even, d/dX = (dX/di)^-1 d/di, both by the same rows.
 *
 * The face measure of the dissipation is that of the faces between nearest neighbours, not max(0, N . C_ab): the 4-2
 * operator's C_ab are no face areas (4/3 and -1/6 of one), and its long pairs near the boundary would smear. */
#include "solver/memory.h"
#include "solver/stencil.h"

#include <math.h>
#include <stdlib.h>

/* Neighbours of a particle: at most five on either side, on three lines. */
enum { MOST_PAIRS = 30 };

struct line_operator {
    const char *name;
    uint32_t fewest;    /* points a line must have */
    uint32_t reach;     /* largest index distance of a pair */
    uint32_t block;     /* rows of the boundary block */
    double face;        /* face measure in the interior, in face areas */
    double weight[6];   /* H of the boundary rows, in spacings */
    double Q[6][8];     /* upper triangle of the boundary rows: Q[i][j], j > i */
    double interior[3]; /* Q at index distance 1, 2 */
};

static const struct line_operator sbp2 = {
    .name = "sbp2",
    .fewest = 2,
    .reach = 1,
    .block = 1,
    .face = 1.0,
    .weight = {1.0 / 2.0},
    .Q = {{0, 1.0 / 2.0}},
    .interior = {0, 1.0 / 2.0},
};

/* Upwind dissipation of a whole face has the eigenvalue -2 (c_p + 2 c_s) / h on the mode that alternates along all
 * axes, c_s < 0.87 c_p. RK4 takes -2.78: at CFL 0.8, the step at which RK4 is still accurate on this operator, it must
 * not be more than 0.63 of that. Measured on the swinging cube, n = 24,
 * CFL 0.8, 78 steps: a whole face blows up, 0.8 of one does not. */
#define SBP4_FACE 0.6

/* The closure with four rows: Strand, J. Comput. Phys. 110 (1994). For lines too short for the other. */
static const struct line_operator sbp4_short = {
    .name = "sbp4",
    .fewest = 8,
    .reach = 3,
    .block = 4,
    .face = SBP4_FACE,
    .weight = {17.0 / 48.0, 59.0 / 48.0, 43.0 / 48.0, 49.0 / 48.0},
    .Q = {{0, 59.0 / 96.0, -1.0 / 12.0, -1.0 / 32.0},
          {0, 0, 59.0 / 96.0, 0.0},
          {0, 0, 0, 59.0 / 96.0, -1.0 / 12.0},
          {0, 0, 0, 0, 2.0 / 3.0, -1.0 / 12.0}},
    .interior = {0, 2.0 / 3.0, -1.0 / 12.0},
};

/* A closure with six rows. Exactness for quadratics leaves five numbers free (Q01, Q02, Q03, Q12, Q13); they minimise
 * sum_i H_i (e3_i^2 + 4e-4 e4_i^2), e3 and e4 the errors on cubics and quartics centred at row i, with the spectral
 * radius of D below 1.975 / h, so that RK4 stays stable at CFL 0.8 in 3D (sqrt(3) 1.975 0.8 < 2.83). The error on
 * cubics, sqrt(sum H e3^2) = 0.75, is 0.40 of Strand's 1.89; that is what the boundary contributes at leading order. */
static const struct line_operator sbp4 = {
    .name = "sbp4",
    .fewest = 12,
    .reach = 5,
    .block = 6,
    .face = SBP4_FACE,
    .weight = {1513841.0 / 4500000.0, 573711.0 / 437500.0, 5864653.0 / 7875000.0, 18249821.0 / 15750000.0,
               3281853.0 / 3500000.0, 3185099.0 / 3150000.0},
    .Q = {{0, 61221.0 / 100000.0, -6939.0 / 250000.0, -103833.0 / 1000000.0, 12791.0 / 2250000.0, 123247.0 / 9000000.0},
          {0, 0, 13251.0 / 31250.0, 65079.0 / 250000.0, -150561.0 / 3500000.0, -50961.0 / 1750000.0},
          {0, 0, 0, 6376189.0 / 15750000.0, 46547.0 / 15750000.0, -60463.0 / 5250000.0},
          {0, 0, 0, 0, 36407221.0 / 63000000.0, -4143.0 / 250000.0},
          {0, 0, 0, 0, 0, 5641637.0 / 9000000.0, -1.0 / 12.0},
          {0, 0, 0, 0, 0, 0, 2.0 / 3.0, -1.0 / 12.0}},
    .interior = {0, 2.0 / 3.0, -1.0 / 12.0},
};

/* A piece of a line, from one end or interface to the next. */
struct piece {
    uint32_t first, points;
};

/* Whether lines along the axis end at i, on either side, since materials meet there: what reaches across would take the
 * gradient of one for that of the other. Operators that reach to the next particle only end there anyway. */
static bool ends_at(const struct solver_cloud *cloud, const struct line_operator *line, size_t axis, uint32_t i)
{
    if (cloud->interface == NULL || line->block == 1) {
        return false;
    }
    size_t from = 0;
    for (size_t k = 0; k < axis; k++) {
        from += cloud->points[k];
    }
    return cloud->interface[from + i] != 0;
}

/* The piece that holds points i and i + 1, at the end of a line i - 1 and i; as much of it as boundary blocks reach. */
static struct piece piece_at(const struct solver_cloud *cloud, const struct line_operator *line, size_t axis,
                             uint32_t i)
{
    enum { FAR = 2 * 8 };
    uint32_t points = cloud->points[axis];
    if (cloud->interface == NULL) {
        return (struct piece){0, points};
    }
    uint32_t first = i + 1 < points ? i : i - 1;
    uint32_t last = first + 1;
    uint32_t least = first > FAR ? first - FAR : 0;
    uint32_t most = points - last > FAR ? last + FAR : points - 1;
    while (first > least && !ends_at(cloud, line, axis, first)) {
        first--;
    }
    while (last < most && !ends_at(cloud, line, axis, last)) {
        last++;
    }
    return (struct piece){first, last - first + 1};
}

static double weight_in(const struct line_operator *line, uint32_t i, uint32_t points)
{
    uint32_t end = i < points - 1 - i ? i : points - 1 - i;
    return end < line->block ? line->weight[end] : 1.0;
}

/* Quadrature weight; on an interface that of an end twice. */
static double weight(const struct solver_cloud *cloud, const struct line_operator *line, size_t axis, uint32_t i)
{
    struct piece piece = piece_at(cloud, line, axis, i);
    return weight_in(line, i - piece.first, piece.points) * (ends_at(cloud, line, axis, i) ? 2.0 : 1.0);
}

static double entry_in(const struct line_operator *line, uint32_t i, uint32_t j, uint32_t points)
{
    if (i < line->block) {
        return j < 8 ? line->Q[i][j] : 0.0;
    }
    uint32_t mirrored = points - 1 - j;
    if (mirrored < line->block) {
        uint32_t other = points - 1 - i;
        return other < 8 ? line->Q[mirrored][other] : 0.0;
    }
    return j - i < 3 ? line->interior[j - i] : 0.0;
}

/* Q_ij for i < j; the right end is the left end mirrored. Nothing crosses an interface. */
static double entry(const struct solver_cloud *cloud, const struct line_operator *line, size_t axis, uint32_t i,
                    uint32_t j)
{
    struct piece piece = piece_at(cloud, line, axis, i);
    return j - piece.first < piece.points ? entry_in(line, i - piece.first, j - piece.first, piece.points) : 0.0;
}

/* Q_ij for any two points of a line. */
static double row_entry(const struct solver_cloud *cloud, const struct line_operator *line, size_t axis, uint32_t i,
                        uint32_t j)
{
    return j == i ? 0.0 : j > i ? entry(cloud, line, axis, i, j) : -entry(cloud, line, axis, j, i);
}

/* (Q X)_i [m] of a graded line, of points from `first` to `last`; rows of Q sum to zero. */
static double differentiated(const struct solver_cloud *cloud, const struct line_operator *line, size_t axis,
                             uint32_t i, uint32_t first, uint32_t last)
{
    const double *X = cloud->plane[axis];
    double sum = 0.0;
    for (uint32_t j = i > first + line->reach ? i - line->reach : first; j <= i + line->reach && j <= last; j++) {
        sum += row_entry(cloud, line, axis, i, j) * (X[j] - X[i]);
    }
    return sum;
}

/* Quadrature weight [m]. */
static double width(const struct solver_cloud *cloud, const struct line_operator *line, size_t axis, uint32_t i)
{
    return cloud->plane[axis] == NULL ? cloud->spacing * weight(cloud, line, axis, i)
                                      : differentiated(cloud, line, axis, i, 0, cloud->points[axis] - 1);
}

/* Quadrature weight of a piece's k-th point over half of the gaps to its neighbours in it: of an even line, */
static double even_room(const struct line_operator *line, struct piece piece, uint32_t k)
{
    return weight_in(line, k, piece.points) * (k == 0 || k + 1 == piece.points ? 2.0 : 1.0);
}

/* and of any. */
static double room(const struct solver_cloud *cloud, const struct line_operator *line, size_t axis, struct piece piece,
                   uint32_t k)
{
    const double *X = cloud->plane[axis];
    if (X == NULL) {
        return even_room(line, piece, k);
    }
    uint32_t i = piece.first + k;
    uint32_t last = piece.first + piece.points - 1;
    double gaps = X[i < last ? i + 1 : i] - X[k > 0 ? i - 1 : i];
    return differentiated(cloud, line, axis, i, piece.first, last) / (0.5 * gaps);
}

/* Face measure between points i and i + 1, in face areas. A row's faces may not enclose more than its quadrature
 * weight, 1/2 sum A h <= H h, or the smallest rows would limit the time step. */
static double face(const struct solver_cloud *cloud, const struct line_operator *line, size_t axis, uint32_t i)
{
    struct piece piece = piece_at(cloud, line, axis, i);
    uint32_t k = i - piece.first;
    return line->face * fmin(1.0, fmin(room(cloud, line, axis, piece, k), room(cloud, line, axis, piece, k + 1)));
}

/* Quadrature weights [m] of the lines along each axis, [points] each after the other. */
struct widths {
    double *all, *axis[3];
};

/* What the weight of a point on a graded line may be, over what it is on an even one with the same gaps. Where spacings
 * change much from one to the next, rows of higher order take what lies far for what is near; in the end weights fall
 * below zero. */
static const double narrowest = 0.5, widest = 2.0;

/* The weights on a graded line are positive and like those of an even one; `finest` is then what a step by a CFL number
 * goes by, as D is at most that of the even line over the least of w_i / H_i. */
static bool check_widths(const struct solver_cloud *cloud, const struct line_operator *line, size_t axis,
                         const double *of, double *finest, struct solver_error *error)
{
    const double *X = cloud->plane[axis];
    for (uint32_t i = 0; X != NULL && i < cloud->points[axis]; i++) {
        struct piece piece = piece_at(cloud, line, axis, i);
        double ratio = room(cloud, line, axis, piece, i - piece.first) / even_room(line, piece, i - piece.first);
        if (!(ratio >= narrowest && ratio <= widest)) {
            return solver_fail(
                error, SOLVER_BAD_INPUT,
                "grading.%c: spacings change too fast for stencil %s, whose weight of the point at %g m is "
                "%.2g times that on an even line; expected %g to %g: choose a larger n, a smaller ratio, or "
                "stencil sbp2",
                "XYZ"[axis], line -> name, X[i], ratio, narrowest, widest);
        }
        *finest = fmin(*finest, of[i] / weight(cloud, line, axis, i));
    }
    return true;
}

static bool make_widths(const struct solver_cloud *cloud, const struct line_operator *line, struct widths *widths,
                        double *finest, struct solver_error *error)
{
    size_t points = (size_t)cloud->points[0] + cloud->points[1] + cloud->points[2];
    *finest = cloud->spacing;
    if (!solver_alloc((void **)&widths->all, points, sizeof *widths->all, "weights of lines", error)) {
        return false;
    }
    bool good = true;
    double *next = widths->all;
    for (size_t axis = 0; good && axis < (size_t)cloud->dim; axis++) {
        for (uint32_t i = 0; i < cloud->points[axis]; i++) {
            next[i] = width(cloud, line, axis, i);
        }
        good = check_widths(cloud, line, axis, next, finest, error);
        widths->axis[axis] = next;
        next += cloud->points[axis];
    }
    return good;
}

/* A neighbour on one of the lines through a particle. */
struct line_pair {
    uint32_t neighbour, axis;
    double Q, face;
};

/* All of them, by ascending particle; returns how many. `out` has room for MOST_PAIRS. */
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
            double Q = row_entry(cloud, line, axis, site[axis], j);
            if (Q != 0.0) {
                size_t at = home + j * stride[axis] - site[axis] * stride[axis];
                bool next = j + 1 == site[axis] || j == site[axis] + 1;
                double A = next ? face(cloud, line, axis, j < site[axis] ? j : site[axis]) : 0.0;
                out[found++] = (struct line_pair){.neighbour = particle_at[at], .axis = axis, .Q = Q, .face = A};
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
static double measure(const struct solver_cloud *cloud, const struct widths *widths, size_t a, size_t except)
{
    size_t dim = (size_t)cloud->dim;
    double product = 1.0;
    for (size_t axis = 0; axis < dim; axis++) {
        if (axis != except) {
            product *= widths->axis[axis][cloud->site[a * dim + axis]];
        }
    }
    return product;
}

/* What a step by a CFL number goes by at particle a [m]. */
static double fine(const struct solver_cloud *cloud, const struct line_operator *line, const struct widths *widths,
                   size_t a)
{
    double least = INFINITY;
    for (size_t axis = 0; axis < (size_t)cloud->dim; axis++) {
        uint32_t i = cloud->site[a * (size_t)cloud->dim + axis];
        least = fmin(least, widths->axis[axis][i] / weight(cloud, line, axis, i));
    }
    return least;
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
            uint32_t site = cloud->site[a * dim + axis];
            const double *plane = cloud->plane[axis];
            double expected = plane != NULL ? plane[site] : cloud->X[axis] + cloud->spacing * (double)site;
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
    size_t dim = (size_t)cloud->dim;
    struct solver_graph *graph = &stencil->graph;
    uint32_t *particle_at = NULL;
    struct widths widths = {.all = NULL};
    double finest;
    struct line_pair pairs[MOST_PAIRS];
    graph->count = cloud->count;
    if (!check(cloud, line, error) || !make_widths(cloud, line, &widths, &finest, error) ||
        !solver_alloc((void **)&particle_at, cloud->count, sizeof *particle_at, "lattice map", error)) {
        free(widths.all);
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
    graph->row_room = ok ? cloud->count + 1 : 0;
    graph->neighbour_room = ok ? graph->row[cloud->count] : 0;
    stencil->finest = finest;
    bool composite = cloud->interface != NULL;
    ok = ok && (!composite || !solver_cloud_graded(cloud) ||
                solver_alloc((void **)&stencil->fine, cloud->count, sizeof *stencil->fine, "spacings", error));
    for (size_t a = 0; ok && stencil->fine != NULL && a < cloud->count; a++) {
        stencil->fine[a] = fine(cloud, line, &widths, a);
    }
    for (size_t a = 0; ok && a < cloud->count; a++) {
        size_t found = list_pairs(cloud, line, particle_at, a, pairs);
        stencil->V[a] = measure(cloud, &widths, a, 3);
        for (size_t i = 0; i < found; i++) {
            size_t ab = graph->row[a] + i;
            graph->neighbour[ab] = pairs[i].neighbour;
            double area = measure(cloud, &widths, a, pairs[i].axis);
            solver_stencil_C(stencil, ab)[pairs[i].axis] = 2.0 * pairs[i].Q * area;
            solver_stencil_C(stencil, ab)[dim] = pairs[i].face * area;
        }
    }
    for (size_t i = 0; ok && i < stencil->face_point_count; i++) {
        struct solver_face_point *point = &stencil->face_point[i];
        size_t axis = point->face / 2;
        point->area[axis] = (point->face % 2 == 0 ? -1.0 : 1.0) * measure(cloud, &widths, point->particle, axis);
    }
    free(widths.all);
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
    uint32_t shortest = UINT32_MAX;
    for (size_t axis = 0; axis < (size_t)cloud->dim; axis++) {
        for (uint32_t i = 0; i + 1 < cloud->points[axis]; i++) {
            struct piece piece = piece_at(cloud, &sbp4, axis, i);
            shortest = piece.points < shortest ? piece.points : shortest;
        }
    }
    return build(cloud, shortest < sbp4.fewest ? &sbp4_short : &sbp4, stencil, error);
}
