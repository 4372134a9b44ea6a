/* Closed pair vectors: the antisymmetric part of the corrected kernel gradient, moved by the least weighted square
 * change onto
 *     sum_b C_ab = -B_a                          (closure: a constant stress gives no force)
 *     1/2 sum_b (X_b - X_a) (x) C_ab = V_a I     (a linear field is differentiated exactly)
 * once, in the reference configuration. Component k of C decouples from the others and sees the same matrix: with
 * multipliers (alpha, beta) per particle the change on a pair is
 *     w_ab [ alpha_a - alpha_b + (X_b - X_a)/2 . (beta_a + beta_b) ],
 * and the multipliers solve M (alpha, beta) = residuals, M sparse, symmetric and semi-definite: alpha quadratic with
 * beta = grad alpha gives no change. Its condition number grows like n^6 (conjugate gradients: thousands of
 * iterations), so M, shifted by a round-off-sized multiple of the identity, is factorised once (CHOLMOD) and the
 * shift's effect is removed by iterating on the residual of C itself. */
#include "solver/kernel.h"
#include "solver/memory.h"
#include "solver/stencil.h"

#include <cholmod.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rounds of the outer iteration; each shrinks the residual by shift / (smallest eigenvalue of M). */
enum { ROUNDS = 12 };
static const double shift = 1e-11;
/* Residual, relative to the largest entry of C, that counts as round-off. */
static const double round_off = 2e-14;
/* Residual that is still accepted, with its size reported: NUMERICS.md found no effect on errors at 1e-6. */
static const double acceptable = 1e-9;

struct projection {
    const struct solver_cloud *cloud;
    struct solver_stencil *stencil;
    double *weight;   /* [pairs] */
    double *residual; /* [dim] blocks of [count][dim + 1]: closure, then linear exactness */
    cholmod_common common;
    cholmod_factor *factor;
};

/* Half the pair's distance, in spacings: beta is scaled alike, so that M's blocks are of one size. */
static void half_distance(const struct solver_cloud *cloud, size_t a, size_t b, double half[3])
{
    size_t dim = (size_t)cloud->dim;
    for (size_t i = 0; i < dim; i++) {
        half[i] = 0.5 * (cloud->X[b * dim + i] - cloud->X[a * dim + i]) / cloud->spacing;
    }
}

/* Fills the upper triangle of M + shift by columns. Column blocks run over b, row blocks over a <= b. */
static cholmod_sparse *assemble(struct projection *work)
{
    const struct solver_graph *graph = &work->stencil->graph;
    size_t dim = (size_t)work->cloud->dim;
    size_t width = dim + 1;
    size_t count = work->cloud->count;
    size_t blocks = (graph->row[count]) / 2 + count;
    cholmod_sparse *M = cholmod_l_allocate_sparse(count * width, count * width, blocks * width * width, true, true, 1,
                                                  CHOLMOD_REAL, &work->common);
    if (M == NULL) {
        return NULL;
    }
    SuiteSparse_long *start = M->p;
    SuiteSparse_long *row = M->i;
    double *value = M->x;
    SuiteSparse_long filled = 0;
    for (size_t b = 0; b < count; b++) {
        double diagonal[4][4] = {{0}};
        for (size_t ba = graph->row[b]; ba < graph->row[b + 1]; ba++) {
            double g[4] = {1.0, 0, 0, 0};
            half_distance(work->cloud, b, graph->neighbour[ba], g + 1);
            for (size_t i = 0; i < width; i++) {
                for (size_t j = 0; j < width; j++) {
                    diagonal[i][j] += work->weight[ba] * g[i] * g[j];
                }
            }
        }
        for (size_t j = 0; j < width; j++) {
            start[b * width + j] = filled;
            for (size_t ba = graph->row[b]; ba < graph->row[b + 1] && graph->neighbour[ba] < b; ba++) {
                /* as seen from a: pair vector g = (1, d/2) for a and (-1, d/2) for b, d = X_b - X_a */
                size_t a = graph->neighbour[ba];
                double g[4] = {1.0, 0, 0, 0};
                half_distance(work->cloud, a, b, g + 1);
                for (size_t i = 0; i < width; i++) {
                    row[filled] = (SuiteSparse_long)(a * width + i);
                    value[filled++] = work->weight[ba] * g[i] * (j == 0 ? -1.0 : g[j]);
                }
            }
            for (size_t i = 0; i <= j; i++) {
                row[filled] = (SuiteSparse_long)(b * width + i);
                value[filled++] = diagonal[i][j] + (i == j ? shift * diagonal[0][0] : 0.0);
            }
        }
    }
    start[count * width] = filled;
    return M;
}

/* Residuals of both constraints; returns the largest, relative to the largest area vector. */
static double residuals(struct projection *work, const double *area)
{
    const struct solver_graph *graph = &work->stencil->graph;
    size_t dim = (size_t)work->cloud->dim;
    size_t width = dim + 1;
    size_t count = work->cloud->count;
    double worst = 0.0;
    for (size_t a = 0; a < count; a++) {
        for (size_t k = 0; k < dim; k++) {
            double *r = work->residual + (k * count + a) * width;
            memset(r, 0, width * sizeof *r);
            r[0] = -area[a * dim + k];
            r[k + 1] = work->stencil->V[a] / work->cloud->spacing;
        }
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            const double *C = solver_stencil_C(work->stencil, ab);
            double half[3];
            half_distance(work->cloud, a, graph->neighbour[ab], half);
            for (size_t k = 0; k < dim; k++) {
                double *r = work->residual + (k * count + a) * width;
                r[0] -= C[k];
                for (size_t i = 0; i < dim; i++) {
                    r[i + 1] -= half[i] * C[k];
                }
            }
        }
    }
    double face = pow(work->cloud->spacing, (double)dim - 1.0);
    for (size_t i = 0; i < dim * count * width; i++) {
        double size = fabs(work->residual[i]) / face;
        worst = isnan(worst) || isgreaterequal(worst, size) ? worst : size; /* a NaN stays, which fmax would lose */
    }
    return worst;
}

/* C += w (alpha_a - alpha_b + d/2 . (beta_a + beta_b)) for one component, both directions of a pair exactly opposite.
 */
static void change(struct projection *work, size_t k, const double *multiplier)
{
    const struct solver_graph *graph = &work->stencil->graph;
    size_t dim = (size_t)work->cloud->dim;
    size_t width = dim + 1;
    for (size_t a = 0; a < work->cloud->count; a++) {
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            size_t b = graph->neighbour[ab];
            if (b < a) {
                continue;
            }
            double half[3];
            half_distance(work->cloud, a, b, half);
            const double *of_a = multiplier + a * width;
            const double *of_b = multiplier + b * width;
            double step = of_a[0] - of_b[0];
            for (size_t i = 0; i < dim; i++) {
                step += half[i] * (of_a[i + 1] + of_b[i + 1]);
            }
            double *C = solver_stencil_C(work->stencil, ab) + k;
            *C += work->weight[ab] * step;
            solver_stencil_C(work->stencil, solver_graph_find(graph, b, a))[k] = -*C;
        }
    }
}

static bool solve_once(struct projection *work, struct solver_error *error)
{
    size_t dim = (size_t)work->cloud->dim;
    size_t unknowns = work->cloud->count * (dim + 1);
    cholmod_dense right = {.nrow = unknowns,
                           .ncol = dim,
                           .nzmax = unknowns * dim,
                           .d = unknowns,
                           .x = work->residual,
                           .xtype = CHOLMOD_REAL,
                           .dtype = CHOLMOD_DOUBLE};
    cholmod_dense *multiplier = cholmod_l_solve(CHOLMOD_A, work->factor, &right, &work->common);
    if (multiplier == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "stencil closed: no memory for the solve with %zu unknowns",
                           unknowns);
    }
    for (size_t k = 0; k < dim; k++) {
        change(work, k, (const double *)multiplier->x + k * unknowns);
    }
    cholmod_l_free_dense(&multiplier, &work->common);
    return true;
}

static bool factorise(struct projection *work, struct solver_error *error)
{
    cholmod_sparse *M = assemble(work);
    bool ok = M != NULL;
    if (ok) {
        work->factor = cholmod_l_analyze(M, &work->common);
        ok = work->factor != NULL && cholmod_l_factorize(M, work->factor, &work->common) &&
             work->common.status == CHOLMOD_OK;
    }
    cholmod_l_free_sparse(&M, &work->common);
    if (ok) {
        return true;
    }
    return work->common.status == CHOLMOD_NOT_POSDEF
               ? solver_fail(error, SOLVER_BAD_INPUT,
                             "stencil closed: the neighbours do not suffice for closure and linear exactness; choose a "
                             "larger support (2.0 or more)")
               : solver_fail(error, SOLVER_NO_MEMORY,
                             "stencil closed: no memory to factorise the projection of %zu particles; choose a smaller "
                             "n, or stencil sbp2 on a lattice",
                             work->cloud->count);
}

static bool project(struct projection *work, struct solver_error *error)
{
    size_t dim = (size_t)work->cloud->dim;
    double *area = NULL;
    if (!solver_alloc((void **)&area, work->cloud->count * dim, sizeof *area, "boundary areas", error)) {
        return false;
    }
    for (size_t i = 0; i < work->stencil->face_point_count; i++) {
        const struct solver_face_point *point = &work->stencil->face_point[i];
        for (size_t k = 0; k < dim; k++) {
            area[point->particle * dim + k] += point->area[k];
        }
    }
    double before = INFINITY;
    double worst = residuals(work, area);
    bool ok = factorise(work, error);
    for (int round = 0; ok && round < ROUNDS && worst > round_off && worst < 0.5 * before; round++) {
        ok = solve_once(work, error);
        before = worst;
        worst = residuals(work, area);
    }
    free(area);
    if (ok && !(worst < acceptable)) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "stencil closed: closure and linear exactness cannot both be met (residual %.1e); choose a "
                           "larger support, or a smaller perturb",
                           worst);
    }
    return ok;
}

/* First guess: antisymmetric part of V_a g_ab, kernel sums with equal volumes. The particles' own volumes there (half
 * on faces) would pull the guess away from linear exactness at the boundary. */
static bool guess(struct projection *work, double radius, struct solver_error *error)
{
    const struct solver_cloud *cloud = work->cloud;
    const struct solver_graph *graph = &work->stencil->graph;
    size_t dim = (size_t)cloud->dim;
    double *gradient = NULL;
    bool ok = solver_alloc((void **)&gradient, work->stencil->pairs * dim, sizeof(double), "kernel gradients", error) &&
              solver_kernel_gradients(cloud, graph, radius, NULL, gradient, error);
    for (size_t a = 0; ok && a < cloud->count; a++) {
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            size_t b = graph->neighbour[ab];
            size_t ba = solver_graph_find(graph, b, a);
            double square = 0.0;
            for (size_t k = 0; k < dim; k++) {
                double d = cloud->X[b * dim + k] - cloud->X[a * dim + k];
                square += d * d;
                solver_stencil_C(work->stencil, ab)[k] =
                    cloud->V[a] * gradient[ab * dim + k] - cloud->V[b] * gradient[ba * dim + k];
            }
            double slope;
            work->weight[ab] = solver_kernel(2.0 * sqrt(square) / radius, &slope);
        }
    }
    free(gradient);
    return ok;
}

bool solver_stencil_closed(const struct solver_cloud *cloud, double support, struct solver_stencil *stencil,
                           struct solver_error *error)
{
    double radius = support * cloud->spacing * (1.0 - solver_kernel_margin);
    size_t dim = (size_t)cloud->dim;
    struct projection work = {.cloud = cloud, .stencil = stencil};
    if (!solver_graph_build(cloud, radius, &stencil->graph, error) || !solver_stencil_reserve(stencil, cloud, error)) {
        return false;
    }
    cholmod_l_start(&work.common);
    work.common.print = 0;
    work.common.supernodal = CHOLMOD_SUPERNODAL;
    bool ok =
        solver_alloc((void **)&work.weight, stencil->pairs, sizeof(double), "pair weights", error) &&
        solver_alloc((void **)&work.residual, cloud->count * dim * (dim + 1), sizeof(double), "residuals", error) &&
        guess(&work, radius, error) && project(&work, error);
    free(work.weight);
    free(work.residual);
    cholmod_l_free_factor(&work.factor, &work.common);
    cholmod_l_finish(&work.common);
    return ok;
}
