/* Neighbour graphs of moving points of several bodies against the sum over all pairs, updated over and over. */
#include "solver/graph.h"
#include "tests/unit/clouds.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <omp.h>
#include <stdint.h>
#include <string.h>

enum { COUNT = 240, STRIDE = 4 };

static double x[COUNT * STRIDE];
static uint32_t body[COUNT];

static struct solver_points points_of(int dim)
{
    return (struct solver_points){.dim = dim, .count = COUNT, .stride = STRIDE, .x = x, .body = body};
}

/* Three bodies in turn, each a cloud of its own size around its own centre; what is beyond dim must not be read. */
static void scatter(int dim, double apart, uint64_t *state)
{
    for (size_t a = 0; a < COUNT; a++) {
        body[a] = (uint32_t)(a % 3);
        for (size_t i = 0; i < STRIDE; i++) {
            double centre = i == 0 ? apart * (double)body[a] : i == 1 ? 0.3 * apart * (double)(body[a] == 1) : 0.0;
            x[a * STRIDE + i] = i < (size_t)dim ? centre + clouds_random(state) : NAN;
        }
    }
}

static void move(int dim, double most, uint64_t *state)
{
    for (size_t a = 0; a < COUNT; a++) {
        for (size_t i = 0; i < (size_t)dim; i++) {
            x[a * STRIDE + i] += most * clouds_random(state);
        }
    }
}

static bool near(const struct solver_points *points, size_t a, size_t b, double radius)
{
    double square = 0.0;
    for (size_t i = 0; i < (size_t)points->dim; i++) {
        double d = points->x[b * points->stride + i] - points->x[a * points->stride + i];
        square += d * d;
    }
    return a != b && square < radius * radius;
}

/* How many entries differ from what all pairs say; *pairs counts the right ones. */
static size_t differences(const struct solver_graph *graph, const struct solver_points *points, enum solver_pairs which,
                          double radius, size_t *pairs)
{
    size_t wrong = graph->count != points->count || graph->row[0] != 0;
    for (size_t a = 0; a < points->count; a++) {
        size_t next = graph->row[a];
        for (size_t b = 0; b < points->count; b++) {
            bool together = points->body == NULL || points->body[a] == points->body[b];
            if (near(points, a, b, radius) && together == (which == SOLVER_PAIRS_WITHIN)) {
                wrong += next >= graph->row[a + 1] || graph->neighbour[next] != b;
                next++;
            }
        }
        wrong += next != graph->row[a + 1];
    }
    *pairs += graph->row[graph->count];
    return wrong;
}

/* One graph through many positions, distances and radii: rows as all pairs say, whatever it held before. */
static void moving(void)
{
    static const double radii[] = {0.3, 0.05, 2.0, 0.3};
    static const double apart[] = {0.0, 1.5, 40.0, 1e7};
    struct solver_error error;
    uint64_t state = 5;
    for (int dim = 1; dim <= 3; dim++) {
        struct solver_graph within = {.row = NULL}, between = {.row = NULL};
        struct solver_points points = points_of(dim);
        size_t pairs[2] = {0};
        for (size_t r = 0; r < 16; r++) {
            double radius = radii[r % 4];
            scatter(dim, apart[r / 4], &state);
            for (int step = 0; step < 4; step++) {
                move(dim, 0.1, &state);
                CU_ASSERT_FATAL(solver_graph_update(&within, &points, SOLVER_PAIRS_WITHIN, radius, &error));
                CU_ASSERT_EQUAL(differences(&within, &points, SOLVER_PAIRS_WITHIN, radius, &pairs[0]), 0);
                CU_ASSERT_FATAL(solver_graph_update(&between, &points, SOLVER_PAIRS_BETWEEN, radius, &error));
                CU_ASSERT_EQUAL(differences(&between, &points, SOLVER_PAIRS_BETWEEN, radius, &pairs[1]), 0);
            }
        }
        CU_ASSERT(pairs[0] > 1000 && pairs[1] > 1000);
        solver_graph_free(&within);
        solver_graph_free(&between);
    }
}

/* Bodies side by side share no pair within, and all pairs between are across; one body has none between. */
static void across(void)
{
    struct solver_graph graph = {.row = NULL};
    struct solver_points points = points_of(2);
    struct solver_error error;
    uint64_t state = 9;
    size_t mixed = 0, own = 0;
    scatter(2, 0.0, &state);
    CU_ASSERT_FATAL(solver_graph_update(&graph, &points, SOLVER_PAIRS_WITHIN, 0.4, &error));
    for (size_t a = 0; a < COUNT; a++) {
        for (size_t ab = graph.row[a]; ab < graph.row[a + 1]; ab++) {
            mixed += body[a] != body[graph.neighbour[ab]];
        }
    }
    CU_ASSERT(graph.row[COUNT] > COUNT);
    CU_ASSERT_EQUAL(mixed, 0);
    CU_ASSERT_FATAL(solver_graph_update(&graph, &points, SOLVER_PAIRS_BETWEEN, 0.4, &error));
    for (size_t a = 0; a < COUNT; a++) {
        for (size_t ab = graph.row[a]; ab < graph.row[a + 1]; ab++) {
            own += body[a] == body[graph.neighbour[ab]];
        }
    }
    CU_ASSERT(graph.row[COUNT] > COUNT);
    CU_ASSERT_EQUAL(own, 0);
    points.body = NULL;
    CU_ASSERT_FATAL(solver_graph_update(&graph, &points, SOLVER_PAIRS_BETWEEN, 0.4, &error));
    CU_ASSERT_EQUAL(graph.row[COUNT], 0);
    solver_graph_free(&graph);
}

/* An update allocates nothing where the last one had room: two bodies that fly apart shed pairs and gain empty space
 * between them in the memory they started with. */
static void reuse(void)
{
    struct solver_graph graph = {.row = NULL};
    struct solver_points points = points_of(3);
    struct solver_error error;
    uint64_t state = 13;
    scatter(3, 0.0, &state);
    CU_ASSERT_FATAL(solver_graph_update(&graph, &points, SOLVER_PAIRS_WITHIN, 0.5, &error));
    struct solver_graph first = graph;
    for (int step = 1; step < 30; step++) {
        for (size_t a = 0; a < COUNT; a++) {
            x[a * STRIDE] += body[a] == 0 ? -ldexp(1.0, step) : ldexp(1.0, step);
        }
        CU_ASSERT_FATAL(solver_graph_update(&graph, &points, SOLVER_PAIRS_WITHIN, 0.5, &error));
        CU_ASSERT(graph.row == first.row && graph.neighbour == first.neighbour);
        CU_ASSERT(graph.cells.start == first.cells.start && graph.cells.particle == first.cells.particle &&
                  graph.cells.cell == first.cells.cell);
    }
    CU_ASSERT(graph.cells.cell_room <= COUNT + 2);
    solver_graph_free(&graph);
    CU_ASSERT(graph.row == NULL && graph.neighbour == NULL && graph.cells.start == NULL);
}

/* Two bodies far apart cost no more than two bodies close by: the longest cell list stays that of one body. */
static void far_apart(void)
{
    static double grid[2 * 32 * 32 * 2];
    static uint32_t of[2 * 32 * 32];
    struct solver_graph graph = {.row = NULL};
    struct solver_points points = {.dim = 2, .count = 2 * 32 * 32, .stride = 2, .x = grid, .body = of};
    struct solver_error error;
    for (double apart = 32.0; apart < 1e6; apart *= 3.7) {
        for (size_t a = 0; a < points.count; a++) {
            size_t line = a % 1024 / 32;
            of[a] = (uint32_t)(a / 1024);
            grid[2 * a] = (double)(a % 32) + apart * of[a];
            grid[2 * a + 1] = (double)line + 0.77 * apart * of[a];
        }
        size_t longest = 0;
        CU_ASSERT_FATAL(solver_graph_update(&graph, &points, SOLVER_PAIRS_WITHIN, 2.4, &error));
        for (size_t a = 0; a < points.count; a++) {
            uint32_t cell = graph.cells.cell[a];
            size_t length = graph.cells.start[cell + 1] - graph.cells.start[cell];
            longest = length > longest ? length : longest;
        }
        CU_ASSERT(longest <= 2 * 9); /* 3 x 3 at most of either body in a cell 2.4 wide */
        CU_ASSERT_EQUAL(graph.row[graph.count], 2 * (30 * 32 * 4 + 31 * 32 * 4 + 31 * 31 * 4 + 30 * 31 * 8));
    }
    solver_graph_free(&graph);
}

static void same_for_any_threads(void)
{
    struct solver_graph one = {.row = NULL}, three = {.row = NULL};
    struct solver_points points = points_of(3);
    struct solver_error error;
    uint64_t state = 17;
    scatter(3, 0.5, &state);
    int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    CU_ASSERT_FATAL(solver_graph_update(&one, &points, SOLVER_PAIRS_WITHIN, 0.7, &error));
    omp_set_num_threads(3);
    CU_ASSERT_FATAL(solver_graph_update(&three, &points, SOLVER_PAIRS_WITHIN, 0.7, &error));
    omp_set_num_threads(threads);
    CU_ASSERT(one.row[COUNT] > COUNT);
    CU_ASSERT_EQUAL_FATAL(one.row[COUNT], three.row[COUNT]);
    CU_ASSERT_EQUAL(memcmp(one.row, three.row, (COUNT + 1) * sizeof *one.row), 0);
    CU_ASSERT_EQUAL(memcmp(one.neighbour, three.neighbour, one.row[COUNT] * sizeof *one.neighbour), 0);
    solver_graph_free(&one);
    solver_graph_free(&three);
}

static void lost_particles(void)
{
    unit_untrapped();
    static const double bad[] = {NAN, INFINITY, -INFINITY, 1.5e308};
    uint64_t state = 3;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct solver_graph graph = {.row = NULL};
        struct solver_points points = points_of(2);
        struct solver_error error = {.code = SOLVER_OK};
        scatter(2, 0.5, &state);
        CU_ASSERT_FATAL(solver_graph_update(&graph, &points, SOLVER_PAIRS_WITHIN, 0.7, &error));
        x[77 * STRIDE + 1] = bad[i];
        x[78 * STRIDE + 1] = -bad[i];
        CU_ASSERT_FALSE(solver_graph_update(&graph, &points, SOLVER_PAIRS_WITHIN, 0.7, &error));
        CU_ASSERT_EQUAL(error.code, SOLVER_BROKE_DOWN);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.text, i < 3 ? "particle 77" : "beyond all bounds"));
        CU_ASSERT(graph.row == NULL && graph.neighbour == NULL && graph.cells.start == NULL);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"moving", moving},       {"across bodies", across},         {"memory reused", reuse},
        {"far apart", far_apart}, {"threads", same_for_any_threads}, {"lost particles", lost_particles},
    };
    return unit_main("solver graph of moving points", tests, sizeof tests / sizeof *tests);
}
