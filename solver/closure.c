#include "solver/closure.h"

#include "solver/memory.h"
#include "solver/pieces.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Smoothing before and after a coarser space's correction, in products with the matrix. The eigenvalues of M over its
 * diagonal blocks are at most 2: on a pair, (x + y)^2 <= 2 x^2 + 2 y^2. */
enum { PATIENCE = 40 };
static int env(const char *n, int d) { return getenv(n) ? atoi(getenv(n)) : d; }
#define SMOOTH env("SM", 2)
#define GRID_SMOOTH env("GSM", 3)

static const double largest = 2.0;

static size_t width_of(const struct solver_closure *of)
{
    return (size_t)(of->cloud->dim + 1) * of->loops->lanes;
}

/* Calls do_it(begin, end) for all pieces, in parallel. */
#define OVER_PIECES(total, ...)                                                                                        \
    do {                                                                                                               \
        size_t over_total = (total);                                                                                   \
        _Pragma("omp parallel for schedule(static)") for (size_t piece = 0; piece < solver_pieces(over_total);         \
                                                          piece++)                                                     \
        {                                                                                                              \
            struct solver_piece at = solver_piece_at(piece, over_total);                                               \
            __VA_ARGS__;                                                                                               \
        }                                                                                                              \
    } while (false)

/* The polynomial of M / diagonal, of `order`, that leaves least of a residual over all of the spectrum, each part by
 * what a coarser space leaves of it: Chebyshev's of the fourth kind (J. Lottes, "Optimal polynomial smoothers for
 * multigrid V-cycles", 2022). Coefficients of its recurrence. */
static double keep_of(int i)
{
    return (2.0 * i - 1.0) / (2.0 * i + 3.0);
}

static double factor_of(int i)
{
    return (8.0 * i + 4.0) / (2.0 * i + 3.0);
}

static void solve_dense(struct solver_closure_grid *grid, size_t lanes)
{
    size_t n = grid->count;
    const double *L = grid->factor;
    for (size_t lane = 0; lane < lanes; lane++) {
        double *x = grid->next;
        for (size_t i = 0; i < n; i++) {
            double sum = grid->r[i * lanes + lane] * sqrt(grid->diagonal[i]);
            for (size_t j = 0; j < i; j++) {
                sum -= L[i * n + j] * x[j];
            }
            x[i] = sum / L[i * n + i];
        }
        for (size_t i = n; i-- > 0;) {
            x[i] /= L[i * n + i];
            for (size_t j = 0; j < i; j++) {
                x[j] -= L[i * n + j] * x[i];
            }
            grid->x[i * lanes + lane] = x[i] * sqrt(grid->diagonal[i]);
        }
    }
}

static void swap(double **x, double **y)
{
    double *kept = *x;
    *x = *y;
    *y = kept;
}

/* x += d, r -= A d, d = the next step; once each for i = first .. order - 1, and then only x, or x and r. */
static void grid_smooth(struct solver_closure *of, struct solver_closure_grid *grid, int first, bool residual)
{
    for (int i = first; i <= GRID_SMOOTH; i++) {
        bool last = i == GRID_SMOOTH;
        double factor = factor_of(i) / grid->largest;
        if (last && !residual) {
            size_t room = grid->count * of->loops->lanes;
            for (size_t n = 0; n < room; n++) {
                grid->x[n] += grid->d[n];
            }
            return;
        }
        OVER_PIECES(grid->count, of->loops->grid_smooth(grid, keep_of(i) * (i > 0), factor, grid->d, grid->x, grid->r,
                                                        last ? NULL : grid->next, at.begin, at.end));
        swap(&grid->d, &grid->next);
    }
}

/* grid->x from grid->r. */
static void grid_cycle(struct solver_closure *of, int level)
{
    struct solver_closure_grid *grid = &of->grid[level];
    size_t lanes = of->loops->lanes;
    if (level == of->levels - 1) {
        solve_dense(grid, lanes);
        return;
    }
    struct solver_closure_grid *coarse = grid + 1;
    double factor = factor_of(0) / grid->largest;
    for (size_t n = 0; n < grid->count * lanes; n++) {
        grid->x[n] = 0.0;
        grid->d[n] = factor * grid->diagonal[n / lanes] * grid->r[n];
    }
    grid_smooth(of, grid, 1, true);
    OVER_PIECES(coarse->count, of->loops->grid_sum(grid, coarse, grid->r, coarse->r, at.begin, at.end));
    grid_cycle(of, level + 1);
    memset(grid->d, 0, grid->count * lanes * sizeof(double));
    OVER_PIECES(grid->count, of->loops->grid_spread(grid, coarse->x, grid->d, at.begin, at.end));
    grid_smooth(of, grid, 0, false);
}

static void smooth(struct solver_closure *of, double *x, int first, bool residual)
{
    for (int i = first; i <= SMOOTH; i++) {
        bool last = i == SMOOTH;
        if (last && !residual) {
            const double one[4] = {1.0, 1.0, 1.0, 1.0};
            double aligned[4] __attribute__((aligned(64)));
            memcpy(aligned, one, sizeof one);
            OVER_PIECES(of->cloud->count, of->loops->add(of, aligned, of->step, x, at.begin, at.end));
            return;
        }
        OVER_PIECES(of->cloud->count,
                    of->loops->smooth(of, keep_of(i) * (i > 0), factor_of(i) / largest, of->step, x, of->left,
                                      last ? NULL : of->next, at.begin, at.end));
        swap(&of->step, &of->next);
    }
}

void solver_closure_cycle(struct solver_closure *of, const double *r, double *z)
{
    const struct solver_closure_loops *loops = of->loops;
    size_t count = of->cloud->count;
    size_t room = count * width_of(of);
    memcpy(of->left, r, room * sizeof *r);
    memset(z, 0, room * sizeof *z);
    OVER_PIECES(count, loops->precondition(of, factor_of(0) / largest, r, of->step, at.begin, at.end));
    smooth(of, z, 1, true);
    if (getenv("NOCOARSE")) { memcpy(of->step, z, 0); return; }
    OVER_PIECES(of->cell_count, loops->sum_cells(of, of->left, at.begin, at.end));
    OVER_PIECES(of->grid[0].count, loops->sum_splines(of, of->grid[0].r, at.begin, at.end));
    grid_cycle(of, 0);
    memset(of->step, 0, room * sizeof(double));
    OVER_PIECES(count, loops->spread(of, of->grid[0].x, of->step, at.begin, at.end));
    smooth(of, z, 0, false);
}

static void dot(struct solver_closure *of, const double *x, const double *y, double sum[4])
{
    size_t lanes = of->loops->lanes;
    OVER_PIECES(of->cloud->count, of->loops->dot(of, x, y, of->partial + piece * lanes, at.begin, at.end));
    for (size_t lane = 0; lane < lanes; lane++) {
        sum[lane] = 0.0;
        for (size_t piece = 0; piece < solver_pieces(of->cloud->count); piece++) {
            sum[lane] += of->partial[piece * lanes + lane];
        }
    }
}

double solver_closure_largest(const struct solver_closure *of, const double *r)
{
    size_t room = of->cloud->count * width_of(of);
    double most = 0.0;
    bool finite = true;
#pragma omp parallel for schedule(static) reduction(max : most) reduction(&& : finite)
    for (size_t i = 0; i < room; i++) {
        most = fmax(most, fabs(r[i]));
        finite = finite && isfinite(r[i]);
    }
    return finite ? most : NAN;
}

/* Quadratic function `which` of ten, and its slopes, at x. */
static void quadratic(int which, const double x[3], double value[4])
{
    static const int of[10][2] = {{3, 3}, {0, 3}, {1, 3}, {2, 3}, {0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    const double y[4] = {x[0], x[1], x[2], 1.0};
    int i = of[which][0], j = of[which][1];
    value[0] = y[i] * y[j];
    for (int axis = 0; axis < 3; axis++) {
        value[axis + 1] = (i == axis ? y[j] : 0.0) + (j == axis ? y[i] : 0.0);
    }
}

/* Takes from the residual what no change of C can: its part along quadratics, which is round-off of the volumes' and
 * areas' moments, and would grow in the iteration. */
static void take_quadratics(struct solver_closure *of)
{
    size_t count = of->cloud->count, dim = (size_t)of->cloud->dim, lanes = of->loops->lanes;
    double product[10][10] = {{0}}, sum[10][4] = {{0}};
    for (int pass = 0; pass < 2; pass++) {
        for (size_t a = 0; a < count; a++) {
            double x[3] = {0}, *r = of->residual + a * (dim + 1) * lanes, f[10][4];
            for (size_t i = 0; i < dim; i++) {
                x[i] = (of->X[a * lanes + i] - of->middle[i]) * of->per_length;
            }
            for (int q = 0; q < 10; q++) {
                quadratic(q, x, f[q]);
                for (size_t i = 1; i <= dim; i++) {
                    f[q][i] *= of->cloud->spacing * of->per_length;
                }
            }
            for (int q = 0; q < 10; q++) {
                for (size_t i = 0; i <= dim; i++) {
                    for (int p = 0; pass == 0 && p <= q; p++) {
                        product[q][p] += f[q][i] * f[p][i];
                    }
                    for (size_t k = 0; k < dim; k++) {
                        if (pass == 0) {
                            sum[q][k] += f[q][i] * r[i * lanes + k];
                        } else {
                            r[i * lanes + k] -= f[q][i] * sum[q][k];
                        }
                    }
                }
            }
        }
        if (pass == 1) {
            break;
        }
        /* Cholesky; functions that others give, as those of axes that are not there, are left out */
        for (int q = 0; q < 10; q++) {
            double own = product[q][q];
            for (int p = 0; p <= q; p++) {
                for (int m = 0; m < p; m++) {
                    product[q][p] -= product[q][m] * product[p][m];
                }
                if (p < q) {
                    product[q][p] *= product[p][p];
                }
            }
            product[q][q] = product[q][q] > 1e-8 * own && own > 0.0 ? 1.0 / sqrt(product[q][q]) : 0.0;
        }
        for (size_t k = 0; k < dim; k++) {
            for (int q = 0; q < 10; q++) {
                for (int m = 0; m < q; m++) {
                    sum[q][k] -= product[q][m] * sum[m][k];
                }
                sum[q][k] *= product[q][q];
            }
            for (int q = 9; q >= 0; q--) {
                for (int m = q + 1; m < 10; m++) {
                    sum[q][k] -= product[m][q] * sum[m][k];
                }
                sum[q][k] *= product[q][q];
            }
        }
    }
}

double solver_closure_solve(struct solver_closure *of, double enough, int most)
{
    const struct solver_closure_loops *loops = of->loops;
    size_t count = of->cloud->count, lanes = loops->lanes;
    size_t bytes = count * width_of(of) * sizeof(double);
    double square[4] = {0}, before[4], curve[4];
    double factor[4] __attribute__((aligned(64))) = {0};
    double back[4] __attribute__((aligned(64))) = {0};
    double left = solver_closure_largest(of, of->residual), best = left;
    int since = 0;
    if (getenv("QUAD")) take_quadratics(of);
    memset(of->solution, 0, bytes);
    solver_closure_cycle(of, of->residual, of->z);
    OVER_PIECES(count, loops->apply(of, of->z, of->z_image, at.begin, at.end));
    dot(of, of->z, of->z_image, square);
    memcpy(of->direction, of->z, bytes);
    memcpy(of->image, of->z_image, bytes);
    for (int i = 0; i < most && left > enough && since < PATIENCE; i++) {
        solver_closure_cycle(of, of->image, of->back);
        dot(of, of->image, of->back, curve);
        for (size_t lane = 0; lane < lanes; lane++) {
            factor[lane] = curve[lane] > 0.0 ? square[lane] / curve[lane] : 0.0;
            back[lane] = -factor[lane];
        }
        OVER_PIECES(count, loops->add(of, factor, of->direction, of->solution, at.begin, at.end);
                    loops->add(of, back, of->image, of->residual, at.begin, at.end);
                    loops->add(of, back, of->back, of->z, at.begin, at.end));
        OVER_PIECES(count, loops->apply(of, of->z, of->z_image, at.begin, at.end));
        memcpy(before, square, sizeof square);
        dot(of, of->z, of->z_image, square);
        for (size_t lane = 0; lane < lanes; lane++) {
            factor[lane] = before[lane] > 0.0 ? square[lane] / before[lane] : 0.0;
        }
        OVER_PIECES(count, loops->scale_add(of, factor, of->z, of->direction, at.begin, at.end);
                    loops->scale_add(of, factor, of->z_image, of->image, at.begin, at.end));
        of->iterations++;
        left = solver_closure_largest(of, of->residual);
        if (getenv("CLOSURE_TRACE") != NULL) {
            fprintf(stderr, "%d %.2e\n", i, left);
        }
        since = left < 0.5 * best ? 0 : since + 1;
        best = left < 0.5 * best ? left : best;
    }
    return left;
}

bool solver_closure_open(struct solver_closure *of, const struct solver_cloud *cloud, const struct solver_graph *graph,
                         struct solver_error *error)
{
    static const struct solver_closure_loops *const loops[][3] = SOLVER_LOOPS(solver_closure);
    size_t count = cloud->count, dim = (size_t)cloud->dim;
    of->cloud = cloud;
    of->graph = graph;
    of->loops = loops[solver_path()][dim - 1];
    size_t lanes = of->loops->lanes;
    size_t room = count * (dim + 1) * lanes;
    double **vectors[] = {&of->residual, &of->solution, &of->direction, &of->image, &of->z,
                         &of->z_image,  &of->back,     &of->left,      &of->step,  &of->next};
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++) {
        if (!solver_alloc((void **)vectors[i], room, sizeof(double), "multipliers", error)) {
            return false;
        }
    }
    if (!solver_alloc((void **)&of->X, count * lanes, sizeof(double), "places in spacings", error) ||
        !solver_alloc((void **)&of->weight, graph->row[count], sizeof(double), "pair weights", error) ||
        !solver_alloc((void **)&of->inverse, count * (dim + 1) * (dim + 1), sizeof(double), "diagonal blocks", error) ||
        !solver_alloc((void **)&of->partial, solver_pieces(count) * lanes, sizeof(double), "sums", error)) {
        return false;
    }
    double length = 0.0;
    for (size_t i = 0; i < dim; i++) {
        double least = INFINITY, most = -INFINITY;
        for (size_t a = 0; a < count; a++) {
            least = fmin(least, cloud->X[a * dim + i]);
            most = fmax(most, cloud->X[a * dim + i]);
        }
        of->middle[i] = 0.5 * (least + most);
        length = fmax(length, most - least);
    }
    of->per_length = length > 0.0 ? 1.0 / length : 1.0;
    for (size_t a = 0; a < count; a++) {
        for (size_t i = 0; i < dim; i++) {
            of->X[a * lanes + i] = cloud->X[a * dim + i];
        }
    }
    of->scale = 0.5 / cloud->spacing;
    return true;
}

void solver_closure_close(struct solver_closure *of)
{
    solver_closure_grids_free(of);
    free(of->residual);
    free(of->solution);
    free(of->direction);
    free(of->image);
    free(of->z);
    free(of->left);
    free(of->step);
    free(of->next);
    free(of->z_image);
    free(of->back);
    free(of->X);
    free(of->weight);
    free(of->inverse);
    free(of->partial);
}

bool solver_closure_ready(struct solver_closure *of, double radius, struct solver_error *error)
{
    OVER_PIECES(of->cloud->count, of->loops->blocks(of, at.begin, at.end));
    return solver_closure_grids(of, radius, error);
}
