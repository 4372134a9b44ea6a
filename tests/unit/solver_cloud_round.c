/* Clouds of discs, balls and cylinders: moments of volumes and areas, the divergence theorem for quadratic fields,
 * symmetry, cells, refusals. */
#include "tests/unit/round_shapes.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

static size_t dim_of(const struct solver_shape *shape)
{
    return shape->kind == SOLVER_SHAPE_DISC ? 2 : 3;
}

static double volume_of(const struct solver_shape *shape)
{
    double disc = pi * round_radius * round_radius;
    return shape->kind == SOLVER_SHAPE_BALL   ? 4.0 / 3.0 * round_radius * disc
           : shape->kind == SOLVER_SHAPE_DISC ? disc
                                              : disc * round_length;
}

/* Place about the centre, and for points of a face its area vector. */
static void about_centre(const struct solver_shape *shape, const struct solver_cloud *cloud, size_t a, double X[3])
{
    for (size_t i = 0; i < 3; i++) {
        X[i] = i < (size_t)cloud->dim ? cloud->X[a * (size_t)cloud->dim + i] - shape->centre[i] : 0.0;
    }
}

/* sum V = |V|, sum V X = |V| centre; no volume is negative or far from the others. */
static void volumes(void)
{
    for (int s = 0; s < SHAPES; s++) {
        for (int n = 4; n <= 16; n *= 2) {
            struct solver_cloud *cloud = round_cloud(&shapes[s], n);
            double cube = pow(cloud->spacing, cloud->dim), sum = 0.0, first[3] = {0}, least = INFINITY, most = 0.0;
            CU_ASSERT_EQUAL(cloud->dim, (int)dim_of(&shapes[s]));
            for (size_t a = 0; a < cloud->count; a++) {
                double X[3];
                about_centre(&shapes[s], cloud, a, X);
                sum += cloud->V[a];
                for (int i = 0; i < 3; i++) {
                    first[i] += cloud->V[a] * X[i];
                }
                least = fmin(least, cloud->V[a] / cube);
                most = fmax(most, cloud->V[a] / cube);
            }
            CU_ASSERT_DOUBLE_EQUAL(sum / volume_of(&shapes[s]), 1.0, 1e-13);
            for (int i = 0; i < 3; i++) {
                CU_ASSERT_DOUBLE_EQUAL(first[i] / volume_of(&shapes[s]), 0.0, 1e-14);
            }
            CU_ASSERT(least > 0.09 && most < 0.8);
            solver_cloud_free(cloud);
        }
    }
}

/* Every particle at the radius, and no other, has an area on the curved face, along the normal; an end of a cylinder
 * carries the disc's areas. Together they are the surface. */
static void areas(void)
{
    for (int s = 0; s < SHAPES; s++) {
        struct solver_cloud *cloud = round_cloud(&shapes[s], 8);
        size_t curved = shapes[s].kind == SOLVER_SHAPE_BALL ? 3 : 2, expected = 0, wrong = 0;
        double of_face[SOLVER_SURFACE + 1] = {0};
        for (size_t a = 0; a < cloud->count; a++) {
            double X[3];
            about_centre(&shapes[s], cloud, a, X);
            double r = sqrt(X[0] * X[0] + X[1] * X[1] + (curved == 3 ? X[2] * X[2] : 0.0));
            uint32_t tags = fabs(r - round_radius) < 1e-12 ? 1U << SOLVER_SURFACE : 0;
            CU_ASSERT(r < round_radius + 1e-12);
            tags |= curved == 2 && fabs(X[2] + 0.5 * round_length) < 1e-12 ? 1U << 4 : 0;
            tags |= curved == 2 && fabs(X[2] - 0.5 * round_length) < 1e-12 ? 1U << 5 : 0;
            wrong += cloud->tags[a] != tags;
            expected += (size_t)__builtin_popcount(tags);
        }
        CU_ASSERT_EQUAL(wrong, 0);
        CU_ASSERT_EQUAL_FATAL(cloud->face_point_count, expected);
        for (size_t i = 0; i < cloud->face_point_count; i++) {
            const struct solver_face_point *point = &cloud->face_point[i];
            double X[3], normal[3] = {0}, along = 0.0, square = 0.0;
            about_centre(&shapes[s], cloud, point->particle, X);
            for (size_t k = 0; k < 3; k++) {
                bool across = point->face == SOLVER_SURFACE ? k < curved : k == 2;
                normal[k] = !across                         ? 0.0
                            : point->face == SOLVER_SURFACE ? X[k] / round_radius
                                                            : X[k] / (0.5 * round_length);
                along += normal[k] * point->area[k];
                square += point->area[k] * point->area[k];
            }
            CU_ASSERT(i == 0 || point->particle >= cloud->face_point[i - 1].particle);
            CU_ASSERT(cloud->tags[point->particle] >> point->face & 1U);
            CU_ASSERT(along > 0.0);
            CU_ASSERT_DOUBLE_EQUAL(along / sqrt(square), 1.0, 1e-14);
            of_face[point->face] += along;
        }
        double surface = curved == 3 ? 4.0 * pi * round_radius * round_radius : 2.0 * pi * round_radius;
        surface *= shapes[s].kind == SOLVER_SHAPE_CYLINDER ? round_length : 1.0;
        CU_ASSERT_DOUBLE_EQUAL(of_face[SOLVER_SURFACE] / surface, 1.0, 1e-13);
        for (int end = 4; shapes[s].kind == SOLVER_SHAPE_CYLINDER && end < 6; end++) {
            CU_ASSERT_DOUBLE_EQUAL(of_face[end] / (pi * round_radius * round_radius), 1.0, 1e-13);
        }
        solver_cloud_free(cloud);
    }
}

/* The divergence theorem for 1, X_i and X_i X_j: sum over the surface of f B_k = sum V df/dX_k. These are the
 * conditions under which closure and linear exactness are compatible. */
static void divergence_theorem(void)
{
    for (int s = 0; s < SHAPES; s++) {
        for (int n = 4; n <= 16; n *= 2) {
            struct solver_cloud *cloud = round_cloud(&shapes[s], n);
            double volume = volume_of(&shapes[s]), worst = 0.0;
            size_t dim = dim_of(&shapes[s]);
            for (size_t i = 0; i <= dim; i++) {
                for (size_t j = i; j <= dim; j++) { /* factor `dim` is 1 */
                    double left[3] = {0}, right[3] = {0};
                    for (size_t p = 0; p < cloud->face_point_count; p++) {
                        const double *X = cloud->X + cloud->face_point[p].particle * dim;
                        double f = (i < dim ? X[i] : 1.0) * (j < dim ? X[j] : 1.0);
                        for (size_t k = 0; k < dim; k++) {
                            left[k] += f * cloud->face_point[p].area[k];
                        }
                    }
                    for (size_t a = 0; a < cloud->count; a++) {
                        const double *X = cloud->X + a * dim;
                        if (i < dim) {
                            right[i] += cloud->V[a] * (j < dim ? X[j] : 1.0);
                        }
                        if (j < dim) {
                            right[j] += cloud->V[a] * (i < dim ? X[i] : 1.0);
                        }
                    }
                    for (size_t k = 0; k < dim; k++) {
                        worst = fmax(worst, fabs(left[k] - right[k]) / volume);
                        CU_ASSERT_FATAL(isfinite(left[k]) && isfinite(right[k]));
                    }
                }
            }
            (void)printf("%.1e ", worst);
            CU_ASSERT(worst <= 2e-13); /* round-off of as many sums as there are particles */
            solver_cloud_free(cloud);
        }
    }
}

/* The particle nearest to a place. */
static size_t nearest(const struct solver_cloud *cloud, const double X[3], double *distance)
{
    size_t dim = (size_t)cloud->dim, found = 0;
    *distance = INFINITY;
    for (size_t a = 0; a < cloud->count; a++) {
        double square = 0.0;
        for (size_t i = 0; i < dim; i++) {
            double d = cloud->X[a * dim + i] - X[i];
            square += d * d;
        }
        found = square < *distance ? a : found;
        *distance = fmin(*distance, square);
    }
    *distance = sqrt(*distance);
    return found;
}

/* A quarter turn about Z and a mirror image take the cloud to itself, volumes and all; for a ball a turn about X too.
 */
static void symmetry(void)
{
    for (int s = 0; s < SHAPES; s++) {
        struct solver_cloud *cloud = round_cloud(&shapes[s], 4);
        bool ball = shapes[s].kind == SOLVER_SHAPE_BALL;
        for (size_t a = 0; a < cloud->count; a++) {
            double X[3], distance;
            about_centre(&shapes[s], cloud, a, X);
            const double image[3][3] = {{-X[1], X[0], X[2]}, {X[0], -X[1], X[2]}, {X[0], -X[2], X[1]}};
            for (int k = 0; k < (ball ? 3 : 2); k++) {
                double at[3];
                for (int i = 0; i < 3; i++) {
                    at[i] = image[k][i] + shapes[s].centre[i];
                }
                size_t b = nearest(cloud, at, &distance);
                CU_ASSERT(distance <= 1e-15 * 4.0);
                CU_ASSERT_DOUBLE_EQUAL(cloud->V[b] / cloud->V[a], 1.0, 1e-13);
            }
        }
        solver_cloud_free(cloud);
    }
}

/* Jacobian of a cell at its corner c: of the edges that meet there, in the order of the axes. */
static double corner_jacobian(const struct solver_cloud *cloud, const uint32_t *cell, int c)
{
    static const int along[3][8] = {{1, 0, 3, 2, 5, 4, 7, 6}, {3, 2, 1, 0, 7, 6, 5, 4}, {4, 5, 6, 7, 0, 1, 2, 3}};
    static const int sign[3][8] = {
        {1, -1, -1, 1, 1, -1, -1, 1}, {1, 1, -1, -1, 1, 1, -1, -1}, {1, 1, 1, 1, -1, -1, -1, -1}};
    double e[3][3] = {{0}, {0}, {0, 0, 1}};
    size_t dim = (size_t)cloud->dim;
    for (size_t axis = 0; axis < dim; axis++) {
        for (size_t i = 0; i < dim; i++) {
            double step = cloud->X[cell[along[axis][c]] * dim + i] - cloud->X[cell[c] * dim + i];
            e[axis][i] = sign[axis][c] * step;
        }
    }
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/* No cell is folded, and those of a disc together are the polygon through its surface. */
static void cells(void)
{
    for (int s = 0; s < SHAPES; s++) {
        struct solver_cloud *cloud = round_cloud(&shapes[s], 8);
        size_t corners = (size_t)1 << cloud->dim, folded = 0;
        double sum = 0.0;
        for (size_t c = 0; c < cloud->cell_count; c++) {
            for (size_t k = 0; k < corners; k++) {
                CU_ASSERT_FATAL(cloud->cell[c * corners + k] < cloud->count);
                double jacobian = corner_jacobian(cloud, cloud->cell + c * corners, (int)k);
                folded += !(jacobian > 0.0);
                sum += jacobian / (double)corners;
            }
        }
        CU_ASSERT_EQUAL(folded, 0);
        if (cloud->dim == 2) {
            CU_ASSERT_DOUBLE_EQUAL(sum, 32.0 * round_radius * round_radius * sin(2.0 * pi / 64.0), 1e-13);
        }
        solver_cloud_free(cloud);
    }
}

static void refuse(struct solver_shape shape, double spacing, const char *expected)
{
    struct solver_cloud *cloud = NULL;
    struct solver_error error = {.code = SOLVER_OK};
    CU_ASSERT_FALSE(solver_cloud_round(&shape, spacing, &cloud, &error));
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
    struct solver_shape ball = shapes[1], rod = shapes[2], lost = shapes[1];
    refuse(ball, 0.2, "a radius of 0.7 m is 3.5 spacings of 0.2 m");
    refuse(ball, 1.4, "a whole number, one or more");
    refuse(ball, 0.0, "spacings of 0 m");
    refuse(ball, -0.1, "a radius of 0.7 m is -7 spacings");
    refuse(ball, NAN, "a radius of 0.7 m is nan spacings");
    refuse(ball, 1e-7, "choose a smaller n");
    refuse(ball, 1e-3, "more than 2^31 particles");
    refuse(rod, 0.14, "a length of 0.525 m is 3.75 spacings of 0.14 m");
    ball.outer = -0.7;
    refuse(ball, 0.1, "a radius of -0.7 m");
    rod.length = 0.0;
    refuse(rod, 0.1, "a length of 0 m");
    lost.centre[2] = INFINITY;
    refuse(lost, 0.1, "centre Z = inf m");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"volumes", volumes},   {"areas", areas}, {"divergence theorem", divergence_theorem},
        {"symmetry", symmetry}, {"cells", cells}, {"refusals", refusals},
    };
    return unit_main("solver round clouds", tests, sizeof tests / sizeof *tests);
}
