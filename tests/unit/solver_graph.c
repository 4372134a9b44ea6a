/* Neighbour graphs against the sum over all pairs, on lattices, perturbed lattices and random clouds in 1, 2 and 3
 * dimensions. */
#include "solver/graph.h"
#include "tests/unit/clouds.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Ascending, no self, and exactly the pairs closer than radius. */
static void check(const struct solver_cloud *cloud, double radius)
{
    struct solver_graph graph;
    struct solver_error error = {.code = SOLVER_OK};
    size_t dim = (size_t)cloud->dim, n = cloud->count, missed = 0, wrong = 0, unsorted = 0;
    bool built = solver_graph_build(cloud, radius, &graph, &error);
    CU_ASSERT_FATAL(built);
    CU_ASSERT(graph.count == n && graph.row[0] == 0);
    for (size_t a = 0; a < n; a++) {
        size_t next = graph.row[a];
        CU_ASSERT_FATAL(graph.row[a] <= graph.row[a + 1]);
        for (size_t b = 0; b < n; b++) {
            double square = 0.0;
            for (size_t i = 0; i < dim; i++) {
                double d = cloud->X[b * dim + i] - cloud->X[a * dim + i];
                square += d * d;
            }
            bool near = b != a && square < radius * radius;
            size_t found = solver_graph_find(&graph, a, b);
            if (near) {
                missed += next >= graph.row[a + 1] || graph.neighbour[next] != b || found != next;
                next++;
            } else {
                wrong += found != SIZE_MAX;
            }
        }
        unsorted += next != graph.row[a + 1];
    }
    CU_ASSERT_EQUAL(missed, 0);
    CU_ASSERT_EQUAL(wrong, 0);
    CU_ASSERT_EQUAL(unsorted, 0);
    solver_graph_free(&graph);
    CU_ASSERT(graph.row == NULL && graph.neighbour == NULL);
}

/* Radii from none to all; whole numbers of spacings put lattice neighbours at, not within, the radius. */
static const double radii[] = {0.5, 1.0, 1.2, 1.999999999, 2.0, 2.1, 3.0, 7.3, 100.0};
enum { RADII = sizeof radii / sizeof *radii };

static void lattices(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        for (int perturbed = 0; perturbed < 2; perturbed++) {
            struct solver_box box = clouds_box(dim, dim < 3 ? 9 : 5, 0.15 * perturbed, 3);
            struct solver_cloud *cloud = clouds_make(&box);
            CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
            for (size_t r = 0; r < RADII; r++) {
                check(cloud, radii[r] * cloud->spacing);
            }
            solver_cloud_free(cloud);
        }
    }
}

/* A known count: 1D lattice neighbours within 2.1 spacings are two on each side. */
static void counted(void)
{
    struct solver_box box = clouds_box(1, 9, 0.0, 3);
    struct solver_cloud *cloud = clouds_make(&box);
    struct solver_graph graph;
    struct solver_error error;
    CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
    CU_ASSERT_FATAL(solver_graph_build(cloud, 2.1 * cloud->spacing, &graph, &error));
    CU_ASSERT_EQUAL(graph.row[cloud->count], 6 * 4 + 2 * 3 + 2 * 2);
    CU_ASSERT(graph.neighbour[0] == 1 && graph.neighbour[1] == 2);
    CU_ASSERT_EQUAL(solver_graph_find(&graph, 0, 2), 1);
    CU_ASSERT_EQUAL(solver_graph_find(&graph, 0, 3), SIZE_MAX);
    solver_graph_free(&graph);
    solver_cloud_free(cloud);
}

/* Particles anywhere, `stretch` times further apart along X; every third one close to the one before it. */
static struct solver_cloud scattered(int dim, size_t count, double stretch, double *X)
{
    uint64_t state = 21;
    for (size_t a = 0; a < count; a++) {
        for (size_t i = 0; i < (size_t)dim; i++) {
            double *at = X + a * (size_t)dim + i;
            *at =
                a % 3 == 2 ? at[-dim] + 1e-3 * clouds_random(&state) : (i == 0 ? stretch : 1.0) * clouds_random(&state);
        }
    }
    return (struct solver_cloud){.dim = dim, .count = count, .spacing = 0.1, .X = X};
}

static void random_clouds(void)
{
    enum { COUNT = 300 };
    double X[3 * COUNT];
    for (int dim = 1; dim <= 3; dim++) {
        for (size_t r = 0; r < RADII; r++) {
            struct solver_cloud even = scattered(dim, COUNT, 1.0, X);
            check(&even, 0.1 * radii[r]);
            struct solver_cloud bar = scattered(dim, COUNT, 50.0, X);
            check(&bar, 0.1 * radii[r]);
        }
    }
}

/* One particle, and many at one place. */
static void degenerate(void)
{
    double X[3 * 20] = {0};
    struct solver_cloud one = {.dim = 3, .count = 1, .spacing = 0.1, .X = X};
    struct solver_cloud many = {.dim = 3, .count = 20, .spacing = 0.1, .X = X};
    check(&one, 0.1);
    check(&many, 0.1);
}

static void same_bytes(void)
{
    struct solver_box box = clouds_box(3, 8, 0.15, 3);
    struct solver_cloud *cloud = clouds_make(&box);
    struct solver_graph first, again;
    struct solver_error error;
    CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
    CU_ASSERT_FATAL(solver_graph_build(cloud, 2.1 * cloud->spacing, &first, &error));
    CU_ASSERT_FATAL(solver_graph_build(cloud, 2.1 * cloud->spacing, &again, &error));
    size_t pairs = first.row[cloud->count];
    CU_ASSERT(pairs > 0 && pairs == again.row[cloud->count]);
    CU_ASSERT_EQUAL(memcmp(first.neighbour, again.neighbour, pairs * sizeof *first.neighbour), 0);
    solver_graph_free(&first);
    solver_graph_free(&again);
    solver_cloud_free(cloud);
}

/* Cells follow the spacing where the radius is smaller: a radius near zero must not ask for memory without end. */
static void tiny_radius(void)
{
    struct solver_box box = clouds_box(3, 5, 0.0, 3);
    struct solver_cloud *cloud = clouds_make(&box);
    CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
    check(cloud, 1e-6 * cloud->spacing);
    check(cloud, 1e-300);
    solver_cloud_free(cloud);
}

static void refusals(void)
{
    unit_untrapped();
    static const double bad[] = {0.0, -0.1, NAN, -INFINITY};
    struct solver_box box = clouds_box(2, 5, 0.0, 3);
    struct solver_cloud *cloud = clouds_make(&box);
    CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct solver_graph graph;
        struct solver_error error = {.code = SOLVER_OK};
        CU_ASSERT(!solver_graph_build(cloud, bad[i], &graph, &error));
        CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "support"));
        CU_ASSERT(graph.row == NULL && graph.neighbour == NULL);
    }
    solver_cloud_free(cloud);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"lattices", lattices},      {"counted", counted},       {"random clouds", random_clouds},
        {"degenerate", degenerate},  {"same bytes", same_bytes}, {"tiny radius", tiny_radius},
        {"refused radii", refusals},
    };
    return unit_main("solver graph", tests, sizeof tests / sizeof *tests);
}
