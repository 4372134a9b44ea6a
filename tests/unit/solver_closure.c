/* The multipliers of a closed stencil: nested spaces that are what they claim, iterations that do not grow with the
 * cloud, equations without a solution, and the same bytes for any number of threads. */
#include "solver/memory.h"
#include "solver/small.h"
#include "tests/unit/closures.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

static void open_ready(struct system *of, int dim, int edge, double perturb, double support)
{
    struct solver_error error;
    open_system(of, dim, edge, perturb, support, 29);
    CU_ASSERT_FATAL(solver_closure_ready(&of->closure, of->radius, &error));
}

/* Splines x of a level, as multipliers of particles. */
static double *on_particles(struct system *of, int level, const double *x)
{
    struct solver_closure *closure = &of->closure;
    struct solver_error error;
    size_t lanes = closure->loops->lanes;
    double *fine = NULL, *coarse = NULL;
    CU_ASSERT_FATAL(solver_alloc((void **)&coarse, closure->grid[level].count * lanes, sizeof *x, "splines", &error));
    memcpy(coarse, x, closure->grid[level].count * lanes * sizeof *x);
    for (; level > 0; level--) {
        const struct solver_closure_grid *grid = &closure->grid[level - 1];
        CU_ASSERT_FATAL(solver_alloc((void **)&fine, grid->count * lanes, sizeof *x, "splines", &error));
        closure->loops->grid_spread(grid, coarse, fine, 0, grid->count);
        free(coarse);
        coarse = fine;
    }
    CU_ASSERT_FATAL(solver_alloc((void **)&fine, of->cloud->count * of->width, sizeof *x, "multipliers", &error));
    closure->loops->spread(closure, coarse, fine, 0, of->cloud->count);
    free(coarse);
    return fine;
}

/* x . A x of a level's matrix is u . M u of what x is on particles; and 0 for x that are quadratic functions. */
static void energies(struct system *of, int level)
{
    struct solver_closure *closure = &of->closure;
    const struct solver_closure_grid *grid = &closure->grid[level];
    size_t lanes = closure->loops->lanes, room = of->cloud->count * of->width;
    double *x = NULL, *image = closure->image, scale = 0.0;
    struct solver_error error;
    uint64_t state = 7;
    CU_ASSERT_FATAL(solver_alloc((void **)&x, grid->count * lanes, sizeof *x, "splines", &error));
    for (int quadratic = 0; quadratic < 2; quadratic++) {
        for (size_t i = 0; i < grid->count; i++) {
            double xi = grid->at[i * 3], eta = of->cloud->dim > 1 ? grid->at[i * 3 + 1] : 0.0;
            x[i * lanes] = quadratic ? xi * xi - 0.25 + 3.0 * xi - xi * eta : clouds_random(&state);
        }
        double of_matrix = 0.0, of_particles = 0.0;
        for (size_t i = 0; i < grid->count; i++) {
            for (size_t at = grid->row[i] * SOLVER_CLOSURE_LINE; at < grid->row[i + 1] * SOLVER_CLOSURE_LINE; at++) {
                if (grid->value[at] != 0.0) {
                    size_t j = grid->column[at / SOLVER_CLOSURE_LINE] + at % SOLVER_CLOSURE_LINE;
                    of_matrix += x[i * lanes] * grid->value[at] * x[j * lanes];
                    scale += fabs(x[i * lanes] * grid->value[at] * x[j * lanes]);
                }
            }
        }
        double *u = on_particles(of, level, x);
        closure->loops->apply(closure, u, image, 0, of->cloud->count);
        for (size_t i = 0; i < room; i += lanes) {
            of_particles += u[i] * image[i];
        }
        CU_ASSERT(fabs(of_matrix - of_particles) <= 1e-12 * scale);
        CU_ASSERT(of_particles >= 0.0);
        CU_ASSERT(quadratic ? of_particles <= 1e-14 * scale : of_particles > 1e-8 * scale);
        free(u);
    }
    free(x);
}

static void spaces(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct system of;
        open_ready(&of, dim, dim == 1 ? 90 : dim == 2 ? 50 : 12, 0.2, 2.1);
        CU_ASSERT(of.closure.levels >= 3);
        for (int level = 0; level < of.closure.levels; level++) {
            energies(&of, level);
        }
        close_system(&of);
    }
}

/* The right-hand side of random changes of pairs, which has a solution. */
static void fill(struct system *of)
{
    uint64_t state = 3;
    double *u = of->closure.z;
    for (size_t i = 0; i < of->cloud->count * of->width; i++) {
        u[i] = i % of->closure.loops->lanes < (size_t)of->cloud->dim ? clouds_random(&state) : 0.0;
    }
    of->closure.loops->apply(&of->closure, u, of->closure.residual, 0, of->cloud->count);
}

/* Takes from M u what weak pairs give beside the diagonal, and adds what they give on it once more; returns how many
 * pairs are weak. */
static size_t without_weak(const struct system *of, const double *u, double *image)
{
    const struct solver_closure *closure = &of->closure;
    size_t lanes = closure->loops->lanes, dim = (size_t)of->cloud->dim, weak = 0;
    for (size_t a = 0; a < of->cloud->count; a++) {
        for (size_t ab = of->graph.row[a]; ab < of->graph.row[a + 1]; ab++) {
            size_t b = of->graph.neighbour[ab];
            double g[4] = {1.0};
            if (closure->weight[ab] >= closure->weak) {
                continue;
            }
            weak++;
            for (size_t i = 0; i < dim; i++) {
                g[i + 1] = closure->scale * (closure->X[b * lanes + i] - closure->X[a * lanes + i]);
            }
            for (size_t k = 0; k < dim; k++) {
                double of_a = u[a * of->width + k], of_b = -u[b * of->width + k];
                for (size_t i = 1; i <= dim; i++) {
                    of_a += g[i] * u[a * of->width + i * lanes + k];
                    of_b += g[i] * u[b * of->width + i * lanes + k];
                }
                for (size_t i = 0; i <= dim; i++) {
                    image[a * of->width + i * lanes + k] += closure->weight[ab] * g[i] * (of_a - of_b);
                }
            }
        }
    }
    return weak;
}

/* out = D^-1 v, D the block of particle a on the diagonal; returns how large its largest sum would be without signs. */
static double over_own(const struct system *of, size_t a, const double v[4], double out[4])
{
    const struct solver_closure *closure = &of->closure;
    size_t lanes = closure->loops->lanes, dim = (size_t)of->cloud->dim;
    double block[4][4] = {{0.0}};
    for (size_t ab = of->graph.row[a]; ab < of->graph.row[a + 1]; ab++) {
        size_t b = of->graph.neighbour[ab];
        double g[4] = {1.0}, weight = (closure->weight[ab] < closure->weak ? 2.0 : 1.0) * closure->weight[ab];
        for (size_t i = 0; i < dim; i++) {
            g[i + 1] = closure->scale * (closure->X[b * lanes + i] - closure->X[a * lanes + i]);
        }
        for (size_t n = 0; n < 16; n++) {
            block[n / 4][n % 4] += weight * g[n / 4] * g[n % 4];
        }
    }
    CU_ASSERT_FATAL(solver_small_invert(dim + 1, block));
    double most = 0.0;
    for (size_t i = 0; i <= dim; i++) {
        double sizes = 0.0;
        for (size_t j = 0; j <= dim; j++) {
            out[i] += block[i][j] * v[j];
            sizes += fabs(block[i][j] * v[j]);
        }
        most = fmax(most, sizes);
    }
    return most;
}

/* Smoothing sees the same matrix, but for its precision and weak pairs, and numbers that stand for nothing stay zero:
 * a step from u is to u - D^-1 M u, D the blocks on the diagonal. */
static void narrow_matrix(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct system of;
        open_ready(&of, dim, 9, 0.2, 2.1);
        struct solver_closure *closure = &of.closure;
        size_t lanes = closure->loops->lanes, width = closure->smoother->width, d = (size_t)dim;
        uint64_t state = 11;
        for (size_t a = 0; a < of.cloud->count; a++) {
            for (size_t n = 0; n < (d + 1) * d; n++) {
                size_t i = n / d, k = n % d;
                closure->now[a * width + k * 4 + i] = (float)clouds_random(&state);
                closure->z[a * of.width + i * lanes + k] = (double)closure->now[a * width + k * 4 + i];
            }
        }
        closure->loops->apply(closure, closure->z, closure->image, 0, of.cloud->count);
        size_t weak = without_weak(&of, closure->z, closure->image);
        CU_ASSERT(dim == 1 || (weak > of.cloud->count && 4 * weak < 3 * of.graph.row[of.cloud->count]));
        closure->smoother->smooth(closure, 0.0f, 1.0f, 0, of.cloud->count);
        double largest = 0.0, worst = 0.0, beyond = 0.0;
        for (size_t column = 0; column < of.cloud->count * width / 4; column++) {
            size_t a = column * 4 / width, k = column % (width / 4);
            double image[4] = {0.0}, step[4] = {0.0};
            for (size_t i = 0; k < d && i <= d; i++) {
                image[i] = closure->image[a * of.width + i * lanes + k];
            }
            largest = fmax(largest, over_own(&of, a, image, step));
            for (size_t i = 0; i < 4; i++) {
                double made = (double)closure->now[column * 4 + i] - (double)closure->last[column * 4 + i];
                worst = fmax(worst, fabs(made - step[i]));
                beyond = fmax(beyond, k < d && i <= d ? 0.0 : fabs(made));
            }
        }
        CU_ASSERT(largest > 0.1 && worst <= 2e-7 * largest);
        CU_ASSERT_EQUAL(beyond, 0.0);
        close_system(&of);
    }
}

/* Numbers below a float's usual range, which would take long, count as zero while it smooths, and only then. */
static void tiny_changes(void)
{
    volatile float tiny = 1e-40f;
    for (int dim = 1; dim <= 3; dim++) {
        struct system of;
        open_ready(&of, dim, 9, 0.0, 2.1);
        struct solver_closure *closure = &of.closure;
        size_t numbers = of.cloud->count * closure->smoother->width, made = 0;
        for (size_t at = 0; at < numbers; at++) {
            closure->now[at] = tiny;
        }
        closure->smoother->smooth(closure, 1.0f, 1.0f, 0, of.cloud->count);
        for (size_t at = 0; at < numbers; at++) {
            made += closure->last[at] != 0.0f;
        }
        CU_ASSERT_EQUAL(made, 0);
        CU_ASSERT(tiny * 2.0f > tiny);
        close_system(&of);
    }
}

/* Eight digits take few iterations, and hardly more for ten times as many particles; in 1D, where a particle has four
 * neighbours, and on lattices they grow slowly. In 2D the bounds hold only where the coarsest grid is not too coarse.
 */
static void iterations(void)
{
    static const struct {
        int dim, edge[2];
        double perturb, support;
        int most;
    } cases[] = {
        {1, {40, 400}, 0.2, 3.0, 60}, {2, {12, 48}, 0.2, 2.0, 34}, {2, {12, 48}, 0.45, 2.6, 28},
        {3, {6, 16}, 0.15, 2.0, 40},  {3, {6, 16}, 0.0, 2.2, 40},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        for (int size = 0; size < 2; size++) {
            struct system of;
            open_ready(&of, cases[i].dim, cases[i].edge[size], cases[i].perturb, cases[i].support);
            fill(&of);
            double first = solver_closure_largest(&of.closure, of.closure.residual);
            double left = solver_closure_solve(&of.closure, 1e-8 * first, 1000);
            (void)printf("\n    %dD, %6zu particles, perturb %.2f, support %.1f: %d iterations", cases[i].dim,
                         of.cloud->count, cases[i].perturb, cases[i].support, of.closure.iterations);
            CU_ASSERT(left <= 1e-8 * first && of.closure.iterations <= cases[i].most);
            close_system(&of);
        }
    }
}

/* What no change of pairs can give: all particles draw the same way. The iteration stops, and says what is left. */
static void no_solution(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct system of;
        open_ready(&of, dim, 8, 0.2, 2.2);
        for (size_t a = 0; a < of.cloud->count; a++) {
            of.closure.residual[a * of.width] = 1e-3;
        }
        double left = solver_closure_solve(&of.closure, 1e-12, 1000);
        CU_ASSERT(left >= 1e-3 && left < 1.0);
        CU_ASSERT(of.closure.iterations < 200);
        unit_untrapped();
        of.closure.residual[0] = NAN;
        CU_ASSERT(isnan(solver_closure_solve(&of.closure, 1e-12, 1000)));
        unit_trapped();
        close_system(&of);
    }
}

static void same_bytes(void)
{
    int most = omp_get_max_threads();
    for (int dim = 1; dim <= 3; dim++) {
        struct system one, three;
        int edge = dim == 1 ? 900 : dim == 2 ? 40 : 11;
        omp_set_num_threads(1);
        open_ready(&one, dim, edge, 0.2, 2.1);
        fill(&one);
        (void)solver_closure_solve(&one.closure, 0.0, 20);
        omp_set_num_threads(3);
        open_ready(&three, dim, edge, 0.2, 2.1);
        fill(&three);
        (void)solver_closure_solve(&three.closure, 0.0, 20);
        size_t bytes = one.cloud->count * one.width * sizeof(double);
        CU_ASSERT(one.closure.iterations == 20 && one.cloud->count > 800);
        CU_ASSERT_EQUAL(memcmp(one.closure.solution, three.closure.solution, bytes), 0);
        CU_ASSERT_EQUAL(memcmp(one.closure.residual, three.closure.residual, bytes), 0);
        close_system(&one);
        close_system(&three);
    }
    omp_set_num_threads(most);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"nested spaces", spaces},      {"matrix in single precision", narrow_matrix},
        {"tiny changes", tiny_changes}, {"iterations", iterations},
        {"no solution", no_solution},   {"same bytes for 1 and 3 threads", same_bytes},
    };
    return unit_main("solver closure", tests, sizeof tests / sizeof *tests);
}
