#include "solver/closure.h"

#include "solver/memory.h"
#include "solver/pieces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Steps before and after a coarser space's correction: on particles, on the finest grid, and how many more on each
 * coarser one, where they cost next to nothing; and iterations that may pass before the residual is halved. Measured:
 * 103 823 moved particles take 102 iterations without more on coarser grids, 84 with them; other numbers of steps on
 * particles and on the finest grid cost as much or more. */
enum { SMOOTH = 7, GRID_SMOOTH = 3, GRID_MORE = 4, PATIENCE = 40 };
/* Bound of the eigenvalues of M over its diagonal blocks: on a pair, (x + y)^2 <= 2 x^2 + 2 y^2. */
static const double largest = 2.0;
/* The cycle rounds to single precision, and z, moved step by step, is made anew when the residual has fallen so far. */
static const double anew = 1e-3;
/* With a factor, what is left is smooth, and the largest residual tells nothing of it: z . M z does, and has fallen as
 * far as round-off lets it when sqrt(z . M z) is this part of what it was. */
static const double few = 1e-6;
/* Pairs of less than this part of the heaviest weight count for smoothing by bounds on the diagonal. Measured: from
 * 0.05 on iterations grow, first where the support is short. */
static const double hardly = 2e-2;

static size_t width_of(const struct solver_closure *of)
{
    return (size_t)(of->cloud->dim + 1) * of->loops->lanes;
}

/* Does it for all pieces `at` of a total, in parallel. */
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

/* --- the cycle --- */

/* Smoothing is the polynomial in M / diagonal that leaves least of an error, each part of it by what a coarser space
 * leaves: Chebyshev's of the fourth kind (J. Lottes, "Optimal polynomial smoothers for multigrid V-cycles", 2023).
 * Coefficients of its recurrence: step i + 1 is keep(i) of the last and factor(i) of the residual. */
static double keep_of(int i)
{
    return i > 0 ? (2.0 * i - 1.0) / (2.0 * i + 3.0) : 0.0;
}

static double factor_of(int i)
{
    return (8.0 * i + 4.0) / (2.0 * i + 3.0);
}

static void swap(double **x, double **y)
{
    double *kept = *x;
    *x = *y;
    *y = kept;
}

/* All components at once: their sums do not wait for each other. */
static void solve_dense(struct solver_closure_grid *grid, size_t lanes)
{
    size_t n = grid->count;
    for (size_t i = 0; i < n; i++) {
        const double *L = grid->factor + i * n;
        double sum[4] = {0.0};
        for (size_t j = 0; j < i; j++) {
            for (size_t lane = 0; lane < lanes; lane++) {
                sum[lane] += L[j] * grid->x[j * lanes + lane];
            }
        }
        for (size_t lane = 0; lane < lanes; lane++) {
            size_t at = i * lanes + lane;
            grid->x[at] = (grid->r[at] * sqrt(grid->diagonal[i]) - sum[lane]) / L[i];
        }
    }
    for (size_t i = n; i-- > 0;) {
        const double *L = grid->factor + i * n;
        double *x = grid->x + i * lanes;
        for (size_t lane = 0; lane < lanes; lane++) {
            x[lane] /= L[i];
        }
        for (size_t j = 0; j < i; j++) {
            for (size_t lane = 0; lane < lanes; lane++) {
                grid->x[j * lanes + lane] -= L[j] * x[lane];
            }
        }
        for (size_t lane = 0; lane < lanes; lane++) {
            x[lane] *= sqrt(grid->diagonal[i]);
        }
    }
}

/* Takes all steps from `first` on, grid->d being the step before it; the last leaves no residual where none is asked
 * for. */
static void grid_smooth(struct solver_closure *of, int level, int first, bool residual)
{
    struct solver_closure_grid *grid = &of->grid[level];
    int steps = GRID_SMOOTH + GRID_MORE * level;
    for (int i = first; i < steps + residual; i++) {
        double *next = i < steps ? grid->next : NULL;
        OVER_PIECES(grid->count, of->loops->grid_smooth(grid, keep_of(i), factor_of(i) / grid->largest, grid->d,
                                                        grid->x, grid->r, next, at.begin, at.end));
        swap(&grid->d, &grid->next);
    }
    for (size_t n = 0; !residual && n < grid->count * of->loops->lanes; n++) {
        grid->x[n] += grid->d[n];
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
    grid_smooth(of, level, 1, true);
    OVER_PIECES(coarse->count, of->loops->grid_sum(grid, grid->r, coarse->r, at.begin, at.end));
    grid_cycle(of, level + 1);
    memset(grid->d, 0, grid->count * lanes * sizeof(double));
    OVER_PIECES(grid->count, of->loops->grid_spread(grid, coarse->x, grid->d, at.begin, at.end));
    grid_smooth(of, level, 0, false);
}

/* The same on the particles, all steps but the first. */
static void smooth(struct solver_closure *of)
{
    for (int i = 1; i < SMOOTH; i++) {
        OVER_PIECES(of->cloud->count,
                    of->smoother->smooth(of, (float)keep_of(i), (float)(factor_of(i) / largest), at.begin, at.end));
        float *kept = of->now;
        of->now = of->last;
        of->last = kept;
    }
}

/* Smoothing makes small, rough changes, which single precision holds. What they leave, and what the splines do, is seen
 * in double: splines are large and smooth, and of their differences next to nothing must be left. */
void solver_closure_cycle(struct solver_closure *of, const double *r, double *z)
{
    const struct solver_closure_loops *loops = of->loops;
    const struct solver_closure_smoother *smoother = of->smoother;
    size_t count = of->cloud->count;
    float factor = (float)(factor_of(0) / largest);
    for (int half = 0; half < 2; half++) {
        OVER_PIECES(count, smoother->start(of, factor, r, half > 0 ? of->z_image : NULL, at.begin, at.end));
        smooth(of);
        OVER_PIECES(count, smoother->finish(of, half > 0, z, at.begin, at.end));
        if (half == 0) {
            OVER_PIECES(count, loops->apply(of, z, of->z_image, at.begin, at.end));
            OVER_PIECES(of->cell_count, loops->sum_cells(of, r, of->z_image, at.begin, at.end));
            OVER_PIECES(of->grid[0].count, loops->sum_splines(of, of->grid[0].r, at.begin, at.end));
            grid_cycle(of, 0);
            OVER_PIECES(count, loops->spread(of, of->grid[0].x, z, at.begin, at.end));
            OVER_PIECES(count, loops->apply(of, z, of->z_image, at.begin, at.end));
        }
    }
}

/* --- the iteration --- */

static void sum_pieces(const struct solver_closure *of, double sum[4])
{
    size_t lanes = of->loops->lanes;
    for (size_t lane = 0; lane < lanes; lane++) {
        sum[lane] = 0.0;
        for (size_t piece = 0; piece < solver_pieces(of->cloud->count); piece++) {
            sum[lane] += of->partial[piece * lanes + lane];
        }
    }
}

/* x . y of each component. */
static void dot(struct solver_closure *of, const double *x, const double *y, double sum[4])
{
    OVER_PIECES(of->cloud->count, of->loops->dot(x, y, of->partial + piece * of->loops->lanes, at.begin, at.end));
    sum_pieces(of, sum);
}

/* y = M x, and x . y of each component. */
static void apply_dot(struct solver_closure *of, const double *x, double *y, double sum[4])
{
    OVER_PIECES(of->cloud->count, of->loops->apply(of, x, y, at.begin, at.end);
                of->loops->dot(x, y, of->partial + piece * of->loops->lanes, at.begin, at.end));
    sum_pieces(of, sum);
}

/* sign x / y of each component; 0 where a component has nothing left. */
static void ratio(const struct solver_closure *of, double sign, const double x[4], const double y[4], double out[4])
{
    for (size_t lane = 0; lane < of->loops->lanes; lane++) {
        out[lane] = y[lane] > 0.0 ? sign * x[lane] / y[lane] : 0.0;
    }
}

static double largest_of_pieces(const struct solver_closure *of)
{
    double most = 0.0, failed = 0.0;
    for (size_t piece = 0; piece < solver_pieces(of->cloud->count); piece++) {
        most = fmax(most, of->partial[piece]);
        failed += 0.0 * of->partial[piece];
    }
    return most + failed;
}

double solver_closure_largest(const struct solver_closure *of, const double *r)
{
    OVER_PIECES(of->cloud->count, of->partial[piece] = of->loops->largest(r, at.begin, at.end));
    return largest_of_pieces(of);
}

/* z = approximately M^-1 r. */
static void precondition(struct solver_closure *of, const double *r, double *z)
{
    if (of->factor.U != NULL) {
        solver_closure_substitute(of, r, z);
    } else {
        solver_closure_cycle(of, r, z);
    }
}

static double total(const double sum[4], size_t lanes)
{
    double of_all = 0.0;
    for (size_t lane = 0; lane < lanes; lane++) {
        of_all += sum[lane];
    }
    return of_all;
}

double solver_closure_solve(struct solver_closure *of, double enough, int most)
{
    const struct solver_closure_loops *loops = of->loops;
    size_t count = of->cloud->count;
    size_t bytes = count * width_of(of) * sizeof(double);
    double square[4] = {0}, before[4], curve[4];
    double factor[4] __attribute__((aligned(64))) = {0};
    double back[4] __attribute__((aligned(64))) = {0};
    double left = solver_closure_largest(of, of->residual), best = left, refreshed = left;
    memset(of->solution, 0, bytes);
    precondition(of, of->residual, of->z);
    apply_dot(of, of->z, of->z_image, square);
    memcpy(of->direction, of->z, bytes);
    memcpy(of->image, of->z_image, bytes);
    bool direct = of->factor.U != NULL;
    double first = total(square, loops->lanes), least = first;
    for (int i = 0, since = 0; i < most && left > enough && since < PATIENCE; i++, since++) {
        precondition(of, of->image, of->back);
        dot(of, of->image, of->back, curve);
        ratio(of, 1.0, square, curve, factor);
        ratio(of, -1.0, square, curve, back);
        OVER_PIECES(count, loops->add(of, factor, of->direction, of->solution, at.begin, at.end);
                    loops->add(of, back, of->image, of->residual, at.begin, at.end);
                    loops->add(of, back, of->back, of->z, at.begin, at.end);
                    of->partial[piece] = loops->largest(of->residual, at.begin, at.end));
        left = largest_of_pieces(of);
        if (left < anew * refreshed) {
            precondition(of, of->residual, of->z);
            refreshed = left;
        }
        memcpy(before, square, sizeof square);
        apply_dot(of, of->z, of->z_image, square);
        ratio(of, 1.0, square, before, factor);
        OVER_PIECES(count, loops->scale_add(of, factor, of->z, of->direction, at.begin, at.end);
                    loops->scale_add(of, factor, of->z_image, of->image, at.begin, at.end));
        of->iterations++;
        if (left < 0.5 * best) {
            best = left;
            since = 0;
        }
        if (direct && total(square, loops->lanes) < 0.5 * least) {
            least = total(square, loops->lanes);
            since = 0;
            if (least <= few * few * first) {
                break;
            }
        }
    }
    return left;
}

bool solver_closure_open(struct solver_closure *of, const struct solver_cloud *cloud, const struct solver_graph *graph,
                         struct solver_error *error)
{
    static const struct solver_closure_loops *const loops[][3] = SOLVER_LOOPS(solver_closure);
    static const struct solver_front_loops *const fronts[][3] = SOLVER_LOOPS(solver_front);
    static const struct solver_closure_smoother *const smoothers[][3] = SOLVER_LOOPS(solver_closure_smoother);
    size_t count = cloud->count, dim = (size_t)cloud->dim;
    of->cloud = cloud;
    of->graph = graph;
    of->loops = loops[solver_path()][dim - 1];
    of->smoother = smoothers[solver_path()][dim - 1];
    of->fronts = fronts[solver_path()][dim - 1];
    of->scale = 0.5 / cloud->spacing;
    size_t lanes = of->loops->lanes;
    size_t room = count * (dim + 1) * lanes;
    double **const vectors[] = {&of->residual, &of->solution, &of->direction, &of->image,
                                &of->z,        &of->z_image,  &of->back};
    float **const narrow[] = {&of->rest, &of->now, &of->last};
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++) {
        if (!solver_alloc((void **)vectors[i], room, sizeof(double), "multipliers", error)) {
            return false;
        }
    }
    for (size_t i = 0; i < sizeof narrow / sizeof *narrow; i++) {
        if (!solver_alloc((void **)narrow[i], count * of->smoother->width, sizeof(float), "multipliers", error)) {
            return false;
        }
    }
    if (!solver_alloc((void **)&of->X, count * lanes, sizeof(double), "places", error) ||
        !solver_alloc((void **)&of->weight, graph->row[count], sizeof(double), "pair weights", error) ||
        !solver_alloc((void **)&of->strong_row, count + 1, sizeof *of->strong_row, "pair weights", error) ||
        !solver_alloc((void **)&of->inverse, count * 16, sizeof(float), "diagonal blocks", error) ||
        !solver_alloc((void **)&of->partial, solver_pieces(count) * lanes, sizeof(double), "sums", error)) {
        return false;
    }
    for (size_t a = 0; a < count; a++) {
        for (size_t i = 0; i < dim; i++) {
            of->X[a * lanes + i] = cloud->X[a * dim + i];
        }
    }
    return true;
}

/* Which pairs smoothing sees. */
static bool strong_pairs(struct solver_closure *of, struct solver_error *error)
{
    const struct solver_graph *graph = of->graph;
    size_t count = graph->count;
    double heaviest = 0.0;
    for (size_t ab = 0; ab < graph->row[count]; ab++) {
        heaviest = fmax(heaviest, of->weight[ab]);
    }
    of->weak = hardly * heaviest;
    for (size_t a = 0; a < count; a++) {
        of->strong_row[a + 1] = of->strong_row[a];
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            of->strong_row[a + 1] += of->weight[ab] >= of->weak;
        }
    }
    size_t pairs = of->strong_row[count];
    return solver_alloc((void **)&of->strong, pairs, sizeof *of->strong, "pair weights", error) &&
           solver_alloc((void **)&of->pair, pairs * 4, sizeof(float), "pair weights", error);
}

bool solver_closure_ready(struct solver_closure *of, double radius, struct solver_error *error)
{
    if (!strong_pairs(of, error)) {
        return false;
    }
    OVER_PIECES(of->cloud->count, of->smoother->prepare(of, at.begin, at.end));
    return solver_closure_grids(of, radius, error);
}

void solver_closure_close(struct solver_closure *of)
{
    solver_closure_grids_free(of);
    solver_closure_factor_free(&of->factor);
    free(of->residual);
    free(of->solution);
    free(of->direction);
    free(of->image);
    free(of->z);
    free(of->z_image);
    free(of->back);
    free(of->rest);
    free(of->now);
    free(of->last);
    free(of->X);
    free(of->weight);
    free(of->strong_row);
    free(of->strong);
    free(of->pair);
    free(of->inverse);
    free(of->partial);
}
