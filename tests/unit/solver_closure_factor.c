/* The factor of a closed stencil's equation: a tree that holds every particle once, solutions that solve the equation,
 * the same bytes for any number of threads and on both wide paths, and none where it would cost too much. */
#include "solver/stencil.h"
#include "tests/unit/closures.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

/* False if there is none. */
static bool open_factored(struct system *of, int dim, int edge, double perturb, double support)
{
    struct solver_error error;
    bool made;
    open_system(of, dim, edge, perturb, support, 31);
    CU_ASSERT_FATAL(solver_closure_factor_make(&of->closure, 9e5, &made, &error));
    return made;
}

/* M u of random u, which has a solution. */
static void fill(struct system *of)
{
    struct solver_closure *closure = &of->closure;
    uint64_t state = 5;
    for (size_t i = 0; i < of->cloud->count * of->width; i++) {
        closure->z[i] = i % closure->loops->lanes < (size_t)of->cloud->dim ? clouds_random(&state) : 0.0;
    }
    closure->loops->apply(closure, closure->z, closure->residual, 0, of->cloud->count);
}

/* Takes what a solution gives from the residual; returns the largest that is left. */
static double repeat(struct system *of)
{
    struct solver_closure *closure = &of->closure;
    solver_closure_substitute(closure, closure->residual, closure->z);
    closure->loops->apply(closure, closure->z, closure->image, 0, of->cloud->count);
    for (size_t i = 0; i < of->cloud->count * of->width; i++) {
        closure->residual[i] -= closure->image[i];
    }
    return solver_closure_largest(closure, closure->residual);
}

/* Every particle is at one place, borders ascend and come later, and of every pair the later one is on the border of
 * the earlier one's node or beside it there. */
static void tree(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct system of;
        bool made = open_factored(&of, dim, dim == 1 ? 70 : dim == 2 ? 18 : 6, 0.2, 2.1);
        const struct solver_closure_factor *factor = &of.closure.factor;
        size_t end = 0, wrong = 0;
        CU_ASSERT(made && factor->node_count > 3 && factor->operations > 0.0);
        for (size_t a = 0; a < of.cloud->count; a++) {
            wrong += factor->particle[factor->place[a]] != a;
        }
        for (size_t n = 0; n < factor->node_count; n++) {
            const struct solver_closure_node *node = &factor->node[n];
            const uint32_t *border = factor->border + node->border;
            wrong += node->begin != end;
            end = node->end;
            for (size_t i = 0; i < node->border_count; i++) {
                wrong += border[i] < node->end || (i > 0 && border[i] <= border[i - 1]);
            }
            for (size_t place = node->begin; place < node->end; place++) {
                size_t a = factor->particle[place];
                for (size_t ab = of.graph.row[a]; ab < of.graph.row[a + 1]; ab++) {
                    uint32_t later = factor->place[of.graph.neighbour[ab]];
                    size_t found = later < node->end;
                    for (size_t i = 0; i < node->border_count; i++) {
                        found += border[i] == later;
                    }
                    wrong += found != 1;
                }
            }
        }
        CU_ASSERT_EQUAL(end, of.cloud->count);
        CU_ASSERT_EQUAL(wrong, 0);
        close_system(&of);
    }
}

/* One solution leaves next to nothing, and a second nothing but round-off: on moved particles, on lattices where alpha
 * along axes have no energy, and where nodes have more rows than are eliminated at a time. */
static void solutions(void)
{
    static const struct {
        int dim, edge;
        double perturb, support;
    } cases[] = {{1, 3, 0.0, 2.1},  {1, 120, 0.2, 3.0}, {2, 3, 0.2, 2.0},  {2, 50, 0.0, 2.0},
                 {2, 50, 0.2, 2.6}, {3, 2, 0.1, 2.0},   {3, 7, 0.15, 2.0}, {3, 8, 0.0, 2.0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct system of;
        bool made = open_factored(&of, cases[i].dim, cases[i].edge, cases[i].perturb, cases[i].support);
        fill(&of);
        double first = solver_closure_largest(&of.closure, of.closure.residual);
        double once = repeat(&of), twice = repeat(&of);
        (void)printf("\n    %dD, %5zu particles, perturb %.2f, support %.1f: %.1e, then %.1e is left", cases[i].dim,
                     of.cloud->count, cases[i].perturb, cases[i].support, once / first, twice / first);
        CU_ASSERT(made && once <= 1e-13 * first && twice <= 1e-15 * first);
        close_system(&of);
    }
}

/* Solves on a path with some threads; the caller frees. */
static double *solved(int dim, int edge, int path, int threads, size_t *bytes)
{
    struct system of;
    int before = solver_path();
    solver_path_use(path);
    omp_set_num_threads(threads);
    bool made = open_factored(&of, dim, edge, 0.2, 2.1);
    fill(&of);
    solver_closure_substitute(&of.closure, of.closure.residual, of.closure.z);
    *bytes = of.cloud->count * of.width * sizeof(double);
    double *z = malloc(*bytes);
    CU_ASSERT_PTR_NOT_NULL_FATAL(z);
    CU_ASSERT(made);
    memcpy(z, of.closure.z, *bytes);
    close_system(&of);
    solver_path_use(before);
    return z;
}

static void same_bytes(void)
{
    int most = omp_get_max_threads();
    for (int dim = 1; dim <= 3; dim++) {
        int edge = dim == 1 ? 250 : dim == 2 ? 40 : 7;
        size_t bytes, others;
        for (int path = 0; path < SOLVER_PATHS && solver_path_runs(path); path++) {
            double *one = solved(dim, edge, path, 1, &bytes), *three = solved(dim, edge, path, 3, &others);
            CU_ASSERT(bytes == others && memcmp(one, three, bytes) == 0);
            free(three);
            if (path == 2) {
                double *narrower = solved(dim, edge, 1, 1, &others);
                CU_ASSERT(bytes == others && memcmp(one, narrower, bytes) == 0);
                free(narrower);
            }
            free(one);
        }
    }
    omp_set_num_threads(most);
}

/* Large clouds in 3D take too many operations. */
static void not_made(void)
{
    struct system of;
    bool made = open_factored(&of, 3, 17, 0.2, 2.0);
    CU_ASSERT(!made && of.closure.factor.U == NULL);
    close_system(&of);
}

/* Makes the stencil of a cloud of spacings so many along axes and finds how far, in faces, it is from closure and from
 * the gradients of linear fields; INFINITY, and the error, where there is none. */
static double left_by(int dim, int along, int across, double perturb, double support, struct solver_error *error)
{
    struct solver_box box = {.dim = dim, .spacing = 0.05, .perturb = perturb, .seed = 1};
    for (int axis = 0; axis < dim; axis++) {
        box.upper[axis] = box.spacing * (axis == 0 ? along : across);
    }
    struct solver_cloud *cloud = clouds_make(&box);
    struct solver_stencil *stencil = NULL;
    double worst = INFINITY, face = pow(box.spacing, dim - 1.0);
    size_t d = (size_t)dim;
    if (solver_stencil_create(solver_stencil_find("closed"), cloud, support, &stencil, error)) {
        double *left = calloc(cloud->count * 12, sizeof *left);
        CU_ASSERT_PTR_NOT_NULL_FATAL(left);
        worst = 0.0;
        for (size_t i = 0; i < stencil->face_point_count; i++) {
            for (size_t k = 0; k < d; k++) {
                left[stencil->face_point[i].particle * 12 + k] += stencil->face_point[i].area[k];
            }
        }
        for (size_t a = 0; a < cloud->count; a++) {
            double *of = left + a * 12;
            for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
                size_t b = stencil->graph.neighbour[ab];
                for (size_t k = 0; k < d; k++) {
                    double C = solver_stencil_C(stencil, ab)[k];
                    of[k] += C;
                    for (size_t i = 0; i < d; i++) {
                        of[3 + 3 * k + i] += 0.5 * (cloud->X[b * d + i] - cloud->X[a * d + i]) / box.spacing * C;
                    }
                }
            }
            for (size_t k = 0; k < d; k++) {
                of[3 + 4 * k] -= stencil->V[a] / box.spacing;
            }
            for (size_t n = 0; n < 12; n++) {
                worst = fmax(worst, fabs(of[n]) / face);
            }
        }
        free(left);
    }
    (void)printf("\n    %dD, %d spacings by %d, perturb %.0e: %.1e of a face is left", dim, along, across, perturb,
                 worst);
    solver_stencil_free(stencil);
    solver_cloud_free(cloud);
    return worst;
}

/* Long lattices, and bars of moved particles, whose smooth multipliers have less energy than the factor's shift. */
static void long_bodies(void)
{
    struct solver_error error;
    CU_ASSERT(left_by(2, 590, 8, 0.0, 2.0, &error) < 2e-13);
    CU_ASSERT(left_by(2, 900, 8, 0.0, 2.0, &error) < 2e-13);
    CU_ASSERT(left_by(1, 3000, 0, 0.0, 2.0, &error) < 2e-12);
    CU_ASSERT(left_by(2, 400, 20, 0.15, 2.0, &error) < 2e-13);
    error.text[0] = '\0';
    CU_ASSERT(left_by(2, 900, 8, 0.15, 2.0, &error) > 1.0);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "met only by pair vectors of up to"));
}

/* Lattices that are hardly moved: multipliers along one axis have next to no energy. */
static void hardly_moved(void)
{
    struct solver_error error;
    CU_ASSERT(left_by(2, 30, 30, 1e-3, 2.0, &error) < 2e-13);
    CU_ASSERT(left_by(2, 30, 30, 1e-5, 2.0, &error) < 2e-13);
    CU_ASSERT(left_by(2, 30, 30, 1e-6, 2.0, &error) < 2e-13);
    CU_ASSERT(left_by(3, 5, 5, 1e-7, 2.0, &error) < 2e-13);
    CU_ASSERT(left_by(3, 12, 12, 1e-4, 2.0, &error) < 2e-13);
}

/* Few neighbours, moved far: there is no solution, and that is said. */
static void none_there(void)
{
    struct solver_error error = {.text = ""};
    CU_ASSERT(left_by(2, 12, 12, 0.1, 1.3, &error) > 1.0);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "Either there is none (few neighbours"));
}

/* Rounds of conjugate residuals with the factor: pair vectors, the caller frees. */
static double *rounds(int path, int threads, size_t *bytes)
{
    struct solver_box box = {.dim = 2, .spacing = 0.05, .upper = {1.5, 1.5}, .perturb = 1e-5, .seed = 1};
    struct solver_cloud *cloud = clouds_make(&box);
    struct solver_stencil *stencil = NULL;
    struct solver_error error;
    int before = solver_path();
    solver_path_use(path);
    omp_set_num_threads(threads);
    CU_ASSERT_FATAL(solver_stencil_create(solver_stencil_find("closed"), cloud, 2.0, &stencil, &error));
    *bytes = stencil->pairs * 2 * sizeof(double);
    double *C = malloc(*bytes);
    CU_ASSERT_PTR_NOT_NULL_FATAL(C);
    for (size_t i = 0; i < stencil->pairs * 2; i++) {
        C[i] = solver_stencil_C(stencil, i / 2)[i % 2];
    }
    solver_stencil_free(stencil);
    solver_cloud_free(cloud);
    solver_path_use(before);
    return C;
}

static void same_rounds(void)
{
    int most = omp_get_max_threads();
    size_t bytes, others;
    for (int path = 0; path < SOLVER_PATHS && solver_path_runs(path); path++) {
        double *one = rounds(path, 1, &bytes), *three = rounds(path == 2 ? 1 : path, 3, &others);
        CU_ASSERT(bytes == others && memcmp(one, three, bytes) == 0);
        free(one);
        free(three);
    }
    omp_set_num_threads(most);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"tree", tree},
        {"solutions", solutions},
        {"same bytes for 1 and 3 threads and on both wide paths", same_bytes},
        {"none where it costs too much", not_made},
        {"long bodies", long_bodies},
        {"lattices that are hardly moved", hardly_moved},
        {"none where there is no solution", none_there},
        {"rounds: the same bytes for 1 and 3 threads and on both wide paths", same_rounds},
    };
    return unit_main("solver closure factor", tests, sizeof tests / sizeof *tests);
}
