/* Clouds of several bodies: rings and boxes, their volumes, symmetry to the bit, cells without holes, and refusals. */
#include "solver/cloud.h"
#include "solver/graph.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

static struct solver_shape ring(double x, double y, double inner, double outer)
{
    return (struct solver_shape){.kind = SOLVER_SHAPE_RING, .centre = {x, y}, .inner = inner, .outer = outer};
}

static struct solver_shape box(double x, double y, double width, double height)
{
    return (struct solver_shape){.kind = SOLVER_SHAPE_BOX, .lower = {x, y}, .upper = {x + width, y + height, 0.0}};
}

static struct solver_cloud *make(const struct solver_shape *shape, size_t count, double spacing)
{
    struct solver_cloud *cloud = NULL;
    struct solver_error error = {.code = SOLVER_OK};
    if (!solver_cloud_bodies(2, shape, count, spacing, &cloud, &error)) {
        (void)printf("no cloud: %s\n", error.text);
        CU_FAIL("solver_cloud_bodies failed");
    }
    CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
    return cloud;
}

/* sum V = |V| and sum V X = |V| centre, to round-off; every particle between the radii, and about a spacing from the
 * next. */
static void check_ring(const struct solver_shape *shape, double spacing)
{
    struct solver_cloud *cloud = make(shape, 1, spacing);
    double area = pi * (shape->outer - shape->inner) * (shape->outer + shape->inner);
    double sum = 0.0, first[2] = {0};
    CU_ASSERT_PTR_NULL(cloud->body);
    CU_ASSERT(cloud->wall_count == 0 && cloud->face_point_count == 0);
    for (size_t a = 0; a < cloud->count; a++) {
        double x = cloud->X[2 * a] - shape->centre[0], y = cloud->X[2 * a + 1] - shape->centre[1];
        double layer = (hypot(x, y) - shape->inner) / spacing - 0.5;
        CU_ASSERT(fabs(layer - round(layer)) < 1e-9 && layer > -0.1);
        CU_ASSERT(layer < (shape->outer - shape->inner) / spacing - 0.9);
        CU_ASSERT(cloud->V[a] > 0.75 * spacing * spacing && cloud->V[a] < 1.35 * spacing * spacing);
        sum += cloud->V[a];
        first[0] += cloud->V[a] * cloud->X[2 * a];
        first[1] += cloud->V[a] * cloud->X[2 * a + 1];
    }
    CU_ASSERT_DOUBLE_EQUAL(sum / area, 1.0, 1e-13);
    for (int i = 0; i < 2; i++) {
        CU_ASSERT_DOUBLE_EQUAL(first[i] / area, shape->centre[i], 1e-14 * (1.0 + fabs(shape->centre[i])));
    }
    solver_cloud_free(cloud);
}

static void rings(void)
{
    const struct solver_shape thick = ring(0.1, -0.2, 0.03, 0.04), wide = ring(0.0, 0.0, 2.0, 3.0),
                              solid = ring(-1.0, 1.0, 0.25, 2.0);
    check_ring(&thick, 1e-3);
    check_ring(&thick, 5e-3);
    check_ring(&wide, 0.125);
    check_ring(&solid, 0.25);
}

/* The paper's two rings have 4386 particles; with the nearest whole number in each quarter of a layer, 0.14 % more. */
static void paper(void)
{
    const struct solver_shape pair[] = {ring(-0.041, 0.0, 0.03, 0.04), ring(0.041, 0.0, 0.03, 0.04)};
    struct solver_cloud *cloud = make(pair, 2, 1e-3);
    (void)printf("%zu particles (published: 4386) ", cloud->count);
    CU_ASSERT_EQUAL(cloud->count, 4392);
    solver_cloud_free(cloud);
}

/* The particle that is the image of a under X -> sign X, to the bit, of the wanted body and with the same volume. */
static bool has_image(const struct solver_cloud *cloud, size_t a, double sign_x, double sign_y, uint32_t body)
{
    for (size_t b = 0; b < cloud->count; b++) {
        if (cloud->X[2 * b] == sign_x * cloud->X[2 * a] && cloud->X[2 * b + 1] == sign_y * cloud->X[2 * a + 1]) {
            return (cloud->body == NULL || cloud->body[b] == body) && cloud->V[b] == cloud->V[a];
        }
    }
    return false;
}

/* Two rings on either side of x = 0 are mirror images; each of itself about y = 0, and about both axes around 0. */
static void symmetry(void)
{
    const struct solver_shape pair[] = {ring(-0.0413, 0.0, 0.03, 0.04), ring(0.0413, 0.0, 0.03, 0.04)};
    const struct solver_shape one = ring(0.0, 0.0, 0.7, 1.1);
    struct solver_cloud *cloud = make(pair, 2, 2e-3);
    size_t lost = 0;
    CU_ASSERT_PTR_NOT_NULL_FATAL(cloud->body);
    for (size_t a = 0; a < cloud->count; a++) {
        lost += !has_image(cloud, a, -1.0, 1.0, 1 - cloud->body[a]);
        lost += !has_image(cloud, a, 1.0, -1.0, cloud->body[a]);
    }
    solver_cloud_free(cloud);
    cloud = make(&one, 1, 0.1);
    for (size_t a = 0; a < cloud->count; a++) {
        lost += !has_image(cloud, a, -1.0, 1.0, 0);
        lost += !has_image(cloud, a, 1.0, -1.0, 0);
    }
    CU_ASSERT_EQUAL(lost, 0);
    solver_cloud_free(cloud);
}

/* Twice the signed area of a triangle of particles. */
static double doubled_area(const struct solver_cloud *cloud, uint32_t a, uint32_t b, uint32_t c)
{
    const double *p = cloud->X + 2 * a, *q = cloud->X + 2 * b, *r = cloud->X + 2 * c;
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

static double polygon(size_t corners, double radius)
{
    return 0.5 * (double)corners * radius * radius * sin(2.0 * pi / (double)corners);
}

/* Cells turn counterclockwise, none is folded, and together they have the area between the polygons through the
 * innermost and outermost particles: no holes and no overlaps. */
static void cells(void)
{
    for (int n = 3; n <= 60; n += 3) {
        double spacing = 0.4 / n;
        const struct solver_shape one = ring(0.3, 0.2, 0.6, 1.0);
        struct solver_cloud *cloud = make(&one, 1, spacing);
        double sum = 0.0, inner = 0.6 + 0.5 * spacing, outer = 1.0 - 0.5 * spacing;
        size_t folded = 0, innermost = 0, outermost = 0;
        for (size_t c = 0; c < cloud->cell_count; c++) {
            const uint32_t *q = cloud->cell + 4 * c;
            bool triangle = q[0] == q[3];
            for (int k = 0; k < 4; k++) {
                CU_ASSERT_FATAL(q[k] < cloud->count);
                double turn = doubled_area(cloud, q[k], q[(k + 1) % 4], q[(k + 2) % 4]);
                folded += triangle ? turn < 0.0 : !(turn > 0.0);
            }
            sum += 0.5 * (doubled_area(cloud, q[0], q[1], q[2]) + doubled_area(cloud, q[0], q[2], q[3]));
        }
        for (size_t a = 0; a < cloud->count; a++) {
            double r = hypot(cloud->X[2 * a] - 0.3, cloud->X[2 * a + 1] - 0.2);
            innermost += fabs(r - inner) < 0.1 * spacing;
            outermost += fabs(r - outer) < 0.1 * spacing;
        }
        CU_ASSERT_EQUAL(folded, 0);
        CU_ASSERT_DOUBLE_EQUAL(sum, polygon(outermost, outer) - polygon(innermost, inner), 1e-12);
        solver_cloud_free(cloud);
    }
}

/* Boxes and a ring: each keeps its own volume, and the graph finds the pairs of each alone. */
static void together(void)
{
    const struct solver_shape shape[] = {box(0.0, 0.0, 1.0, 0.5), ring(3.0, 0.5, 0.5, 1.0), box(0.0, 0.5, 0.6, 1.0)};
    const double volume[] = {0.5, 0.75 * pi, 0.6};
    struct solver_cloud *cloud = make(shape, 3, 0.1);
    struct solver_graph graph;
    struct solver_error error;
    double sum[3] = {0}, lowest[3] = {9.0, 9.0, 9.0};
    size_t across = 0, touching = 0;
    CU_ASSERT_PTR_NOT_NULL_FATAL(cloud->body);
    for (size_t a = 0; a < cloud->count; a++) {
        CU_ASSERT_FATAL(cloud->body[a] < 3);
        sum[cloud->body[a]] += cloud->V[a];
        lowest[cloud->body[a]] = fmin(lowest[cloud->body[a]], cloud->X[2 * a + 1]);
    }
    for (int b = 0; b < 3; b++) {
        CU_ASSERT_DOUBLE_EQUAL(sum[b] / volume[b], 1.0, 1e-13);
    }
    CU_ASSERT(fabs(lowest[0] - 0.05) < 1e-14 && fabs(lowest[2] - 0.55) < 1e-14);
    CU_ASSERT_FATAL(solver_graph_build(cloud, 0.24, &graph, &error));
    for (size_t a = 0; a < cloud->count; a++) {
        for (size_t ab = graph.row[a]; ab < graph.row[a + 1]; ab++) {
            across += cloud->body[a] != cloud->body[graph.neighbour[ab]];
        }
    }
    CU_ASSERT(graph.row[cloud->count] > 10 * cloud->count);
    CU_ASSERT_EQUAL(across, 0);
    solver_graph_free(&graph);
    CU_ASSERT_FATAL(solver_graph_build_pairs(cloud, 0.11, SOLVER_PAIRS_BETWEEN, &graph, &error));
    touching = graph.row[cloud->count];
    CU_ASSERT_EQUAL(touching, 12); /* six particles of one box below six of the other */
    solver_graph_free(&graph);
    solver_cloud_free(cloud);
}

/* One order of all, row by row, whatever their body. */
static void order(void)
{
    const struct solver_shape shape[] = {box(0.0, 0.0, 1.6, 0.8), box(0.0, 0.8, 1.6, 0.8)};
    struct solver_cloud *cloud = make(shape, 2, 0.1);
    CU_ASSERT_EQUAL_FATAL(cloud->count, 256);
    for (size_t a = 0; a < 256; a++) {
        size_t row = a / 16;
        CU_ASSERT_DOUBLE_EQUAL(cloud->X[2 * a], 0.1 * ((double)(a % 16) + 0.5), 1e-14);
        CU_ASSERT_DOUBLE_EQUAL(cloud->X[2 * a + 1], 0.1 * ((double)row + 0.5), 1e-14);
    }
    CU_ASSERT(cloud->body[0] == 0 && cloud->body[255] == 1);
    solver_cloud_free(cloud);
}

static void refuse(int dim, const struct solver_shape *shape, size_t count, double spacing, const char *expected)
{
    struct solver_cloud *cloud = NULL;
    struct solver_error error = {.code = SOLVER_OK};
    CU_ASSERT_FALSE(solver_cloud_bodies(dim, shape, count, spacing, &cloud, &error));
    CU_ASSERT_PTR_NULL(cloud);
    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
    if (strstr(error.text, expected) == NULL) {
        (void)printf("\"%s\" does not name \"%s\"\n", error.text, expected);
        CU_FAIL("the message does not say what is wrong");
    }
}

static void refusals(void)
{
    unit_untrapped();
    const struct solver_shape good = ring(0.0, 0.0, 0.5, 1.0), thin = ring(0.0, 0.0, 0.5, 0.55),
                              inside_out = ring(0.0, 0.0, 1.0, 0.5), disc = ring(0.0, 0.0, 0.0, 0.5),
                              lost = ring(NAN, 0.0, 0.5, 1.0), endless = ring(0.0, 0.0, 0.5, INFINITY);
    refuse(3, &good, 1, 0.1, "bodies[1]: ring: it lies in 2D");
    refuse(2, &good, 1, 0.15, "a thickness of 0.5 m is 3.33333 spacings of 0.15 m");
    refuse(2, &thin, 1, 0.05, "two or more");
    refuse(2, &inside_out, 1, 0.1, "0 < inner < outer");
    refuse(2, &disc, 1, 0.1, "0 < inner < outer");
    refuse(2, &lost, 1, 0.1, "a centre that is finite");
    refuse(2, &endless, 1, 0.1, "spacings");
    refuse(2, &good, 1, 5e-6, "choose a smaller n");
    const struct solver_shape uneven[] = {box(0.0, 0.0, 1.0, 1.0), box(2.0, 0.0, 1.0, 1.05)};
    refuse(2, uneven, 2, 0.1, "bodies[2]: edge Y of 1.05 m is not a whole number of spacings");
    const struct solver_shape far[] = {box(0.0, 0.0, 1.0, 1.0), box(1e6, 0.0, 1.0, 1.0)};
    refuse(2, far, 2, 0.1, "choose a smaller n");
    static const double overlap[] = {0.95, 0.9, 0.55, 0.0};
    for (size_t i = 0; i < sizeof overlap / sizeof *overlap; i++) {
        const struct solver_shape both[] = {box(0.0, 0.0, 1.0, 1.0), box(overlap[i], 0.35, 1.0, 1.0)};
        refuse(2, both, 2, 0.1, "overlap");
    }
    const struct solver_shape rings_overlap[] = {ring(0.0, 0.0, 0.5, 1.0), ring(1.9, 0.0, 0.5, 1.0)};
    refuse(2, rings_overlap, 2, 0.1, "numbers ");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"rings", rings},       {"the paper's rings", paper}, {"symmetry", symmetry},
        {"cells", cells},       {"together", together},       {"order", order},
        {"refusals", refusals},
    };
    return unit_main("solver cloud of bodies", tests, sizeof tests / sizeof *tests);
}
