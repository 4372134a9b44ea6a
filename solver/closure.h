/* The equation of a closed stencil's multipliers (stencil_closed.c): M u = r for all components of C at once.
 *
 * A vector u is [count][dim + 1][lanes]: alpha, then beta by components, each for every component k of C, which do not
 * couple. On a pair, with half its distance d/2 in spacings,
 *     step_ab(u) = w_ab [ alpha_a - alpha_b + d/2 . (beta_a + beta_b) ],       M u at a = sum_b (1, d/2) step_ab(u),
 * so u . M u = sum over pairs step^2 / w. Of smooth alpha with beta = grad alpha only third derivatives are left, so
 * that the condition number grows like n^6. The preconditioner is one cycle over nested spaces: particles, then
 * quadratic splines alpha(X), beta = grad alpha, on grids that are coarser by 2 each (closure_grid.c), with polynomial
 * smoothing, on particles in single precision (closure_smooth_dim.c), and a dense solution on the coarsest. The
 * iteration is that of conjugate residuals: M is singular, quadratic alpha have no energy, and what round-off leaves of
 * r there would grow in conjugate gradients. Work and memory grow with the number of pairs, but on a lattice whose
 * support holds nearest layers only: there alpha that vary along one axis alone have no energy either, and iterations
 * grow with the number of particles along an edge. In 1D and 2D, and of small clouds in 3D, a factor of M takes less
 * time (closure_factor.h), and spline spaces are for what it leaves. */
#ifndef SOLVER_CLOSURE_H
#define SOLVER_CLOSURE_H

#include "solver/closure_factor.h"
#include "solver/graph.h"
#include "solver/path.h"

enum { SOLVER_CLOSURE_LEVELS = 24, SOLVER_CLOSURE_REACH = 3, SOLVER_CLOSURE_LINE = 8 };

/* Margin of the cells of splines, relative to the particles' spacing: round-off decides nothing. */
static const double solver_closure_slack = 1e-6;

/* Quadratic splines on square cells: spline i along an axis lives on cells i - 2, i - 1 and i. */
struct solver_closure_grid {
    int dim;
    size_t count;             /* splines that are not zero on every particle */
    uint64_t *key;            /* [count] place of each as one number, ascending */
    int32_t *at;              /* [count][3] place of each along the axes */
    size_t *row;              /* [count + 1] the matrix: first line along axis 0 of each spline's */
    uint32_t *column;         /* [lines] the first spline of each line, behind which the others follow */
    double *value;            /* [lines][SOLVER_CLOSURE_LINE] zeros where a line is shorter */
    double *diagonal;         /* [count] its inverse */
    uint32_t *parent;         /* [count][2^dim] on the next coarser grid; NULL on the coarsest */
    size_t *child_row;        /* [coarser count + 1] the same the other way round */
    uint32_t *child;          /* [child_row[coarser count]] */
    double *factor;           /* [count][count] on the coarsest: its Cholesky factor */
    double largest;           /* bound of the eigenvalues of matrix / diagonal */
    double *x, *r, *d, *next; /* [count][lanes], zeros behind d and next for lines that end there */
};

struct solver_closure {
    const struct solver_cloud *cloud;
    const struct solver_graph *graph;
    const struct solver_closure_loops *loops;
    const struct solver_closure_smoother *smoother;
    const struct solver_front_loops *fronts;
    struct solver_closure_factor factor; /* closure_factor.h; without nodes where there is none */
    double *X;                           /* [count][lanes] places [m] */
    double scale;   /* half a spacing's reciprocal [1/m]: turns distances into halves in spacings */
    double *weight; /* [pairs] */
    /* cells of the finest grid */
    double origin[3], width; /* [m] */
    size_t cell_count;
    int32_t *cell_at;        /* [cell_count][3] */
    size_t *cell_start;      /* [cell_count + 1] first particle of each */
    uint32_t *cell_particle; /* [count] */
    uint32_t *cell_of;       /* [count] */
    uint32_t *cell_spline;   /* [cell_count][3^dim] */
    uint32_t *spline_cell;   /* [splines][3^dim] the same the other way round; UINT32_MAX: no such cell */
    double *cell_sum;        /* [cell_count][3^dim][lanes] */
    int levels;
    struct solver_closure_grid grid[SOLVER_CLOSURE_LEVELS];
    /* the iteration, [count][dim + 1][lanes] each */
    double *residual, *solution, *direction, *image, *z, *z_image, *back;
    double *partial; /* [pieces][lanes] */
    /* smoothing, in single precision (closure_smooth_dim.c) */
    double weak;              /* pairs of less weight are on the diagonal only */
    size_t *strong_row;       /* [count + 1] first of the others, of each particle */
    uint32_t *strong;         /* [strong pairs] the neighbour */
    float *pair;              /* [strong pairs][4] sqrt(w) (-1, d/2) */
    float *inverse;           /* [count][4][4] of the blocks on M's diagonal */
    float *rest, *now, *last; /* [count][smoother's width] */
    int iterations;           /* taken so far, in all solutions */
};

struct solver_closure_loops {
    size_t lanes;
    void (*apply)(const struct solver_closure *of, const double *u, double *out, size_t begin, size_t end);
    void (*dot)(const double *x, const double *y, double *sum, size_t begin, size_t end);
    double (*largest)(const double *x, size_t begin, size_t end); /* NaN where numbers fail */
    /* x += factor y, or x = factor x + y, a factor per component */
    void (*add)(const struct solver_closure *of, const double *factor, const double *y, double *x, size_t begin,
                size_t end);
    void (*scale_add)(const struct solver_closure *of, const double *factor, const double *y, double *x, size_t begin,
                      size_t end);
    /* What step(u) gives on each pair from a, times face, is added to C of `pair`, [pairs][dim + 1]. */
    void (*change)(const struct solver_closure *of, const double *u, double face, double *pair, size_t begin,
                   size_t end);
    /* r = (-B_a, V_a I / spacing) - sum_b (1, d/2) C_ab, times per_face */
    void (*residuals)(const struct solver_closure *of, const double *area, const double *V, double per_face,
                      const double *pair, double *r, size_t begin, size_t end);
    /* The finest splines: their matrix's rows from pairs that begin in cells [begin, end), dense over 7^dim
     * neighbours; sums of r - image over particles; values on particles, added to u. */
    void (*assemble)(const struct solver_closure *of, double *dense, size_t begin, size_t end);
    void (*sum_cells)(const struct solver_closure *of, const double *r, const double *image, size_t begin, size_t end);
    void (*sum_splines)(const struct solver_closure *of, double *r, size_t begin, size_t end);
    void (*spread)(const struct solver_closure *of, const double *x, double *u, size_t begin, size_t end);
    /* On a grid: x += d, r -= A d, next = keep d + factor * diagonal^-1 r; from a grid to the next coarser one, and
     * back, adding. */
    void (*grid_smooth)(const struct solver_closure_grid *grid, double keep, double factor, const double *d, double *x,
                        double *r, double *next, size_t begin, size_t end);
    void (*grid_sum)(const struct solver_closure_grid *fine, const double *r, double *out, size_t begin, size_t end);
    void (*grid_spread)(const struct solver_closure_grid *fine, const double *x, double *out, size_t begin, size_t end);
};
SOLVER_DECLARE_LOOPS(struct solver_closure_loops, solver_closure);

/* Smoothing: `now` is the change made so far, `last` what it was a step before, and M now should be `rest`. */
struct solver_closure_smoother {
    size_t width;
    void (*prepare)(struct solver_closure *of, size_t begin, size_t end);
    /* rest = r - image, last = 0, now = factor * M's diagonal blocks^-1 rest; without an image it is 0 */
    void (*start)(const struct solver_closure *of, float factor, const double *r, const double *image, size_t begin,
                  size_t end);
    /* last = now + keep (now - last) + factor * blocks^-1 (rest - M now) */
    void (*smooth)(const struct solver_closure *of, float keep, float factor, size_t begin, size_t end);
    /* z = now, or z += now */
    void (*finish)(const struct solver_closure *of, bool add, double *z, size_t begin, size_t end);
};
SOLVER_DECLARE_LOOPS(struct solver_closure_smoother, solver_closure_smoother);

/* What a spline at a place has of parent 0 or 1 along an axis: the next coarser spline is (1, 3, 3, 1) / 4 of these. */
static inline double solver_closure_share(int32_t place, int parent)
{
    return (place & 1) == parent ? 0.75 : 0.25;
}

/* Sets up for a cloud and its graph; *of is zeroed before. The caller then fills in weights, the same both ways, and
 * calls `ready` with the radius [m] of the graph. */
bool solver_closure_open(struct solver_closure *of, const struct solver_cloud *cloud, const struct solver_graph *graph,
                         struct solver_error *error);
bool solver_closure_ready(struct solver_closure *of, double radius, struct solver_error *error);
void solver_closure_close(struct solver_closure *of);
/* The grids of it, for solver_closure_ready. */
bool solver_closure_grids(struct solver_closure *of, double radius, struct solver_error *error);
/* The Cholesky factor of the coarsest grid's matrix, scaled to a unit diagonal and shifted so that it has one. */
bool solver_closure_factorise(struct solver_closure_grid *grid, struct solver_error *error);
void solver_closure_grids_free(struct solver_closure *of);
/* z = approximately M^-1 r, the same symmetric positive operator each time. */
void solver_closure_cycle(struct solver_closure *of, const double *r, double *z);
/* The largest entry of a vector, or NaN. */
double solver_closure_largest(const struct solver_closure *of, const double *r);
/* Solves M solution = residual until the largest residual is below `enough`, which residual then holds, or no longer
 * falls; returns it, NaN where numbers fail. */
double solver_closure_solve(struct solver_closure *of, double enough, int most);

#endif
