/* Clouds: what the quadrature of a box must satisfy, tags, faces, cells, and refused boxes. */
#include "solver/cloud.h"
#include "tests/unit/clouds.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double shifts[] = {0.0, 0.15, 0.3};
enum { SHIFTS = sizeof shifts / sizeof *shifts };

static size_t product(const uint32_t *of, int count)
{
    size_t all = 1;
    for (int i = 0; i < count; i++) {
        all *= of[i];
    }
    return all;
}

/* sum V = |V|, sum V X = integral of X, every V > 0. */
static void check_volumes(const struct solver_box *box, const struct solver_cloud *cloud)
{
    size_t dim = (size_t)cloud->dim;
    double volume = 1.0, sum = 0.0, first[3] = {0};
    for (size_t a = 0; a < cloud->count; a++) {
        CU_ASSERT(cloud->V[a] > 0.0);
        sum += cloud->V[a];
        for (size_t i = 0; i < dim; i++) {
            first[i] += cloud->V[a] * cloud->X[a * dim + i];
        }
    }
    for (size_t i = 0; i < dim; i++) {
        volume *= box->upper[i] - box->lower[i];
    }
    CU_ASSERT_DOUBLE_EQUAL(sum / volume, 1.0, 1e-13);
    for (size_t i = 0; i < dim; i++) {
        CU_ASSERT_DOUBLE_EQUAL(first[i] / volume, 0.5 * (box->lower[i] + box->upper[i]), 1e-13);
    }
}

/* sum B = 0 and sum X (x) B = |V| I: the divergence theorem for constants and linears. Each face's areas add up. */
static void check_areas(const struct solver_box *box, const struct solver_cloud *cloud)
{
    size_t dim = (size_t)cloud->dim;
    double edge[3] = {1.0, 1.0, 1.0}, sum[3] = {0}, moment[3][3] = {{0}}, of_face[6] = {0};
    for (size_t i = 0; i < dim; i++) {
        edge[i] = box->upper[i] - box->lower[i];
    }
    for (size_t n = 0; n < cloud->face_point_count; n++) {
        const struct solver_face_point *point = &cloud->face_point[n];
        const double *X = cloud->X + point->particle * dim;
        size_t normal = point->face / 2;
        CU_ASSERT_FATAL(point->particle < cloud->count && point->face < 2 * dim);
        CU_ASSERT(n == 0 || point->particle > point[-1].particle ||
                  (point->particle == point[-1].particle && point->face > point[-1].face));
        CU_ASSERT((cloud->tags[point->particle] >> point->face & 1U) == 1U);
        CU_ASSERT(X[normal] == (point->face % 2 ? box->upper : box->lower)[normal]);
        for (size_t j = 0; j < 3; j++) {
            CU_ASSERT(j == normal ? point->area[j] * (point->face % 2 ? 1.0 : -1.0) > 0.0 : point->area[j] == 0.0);
        }
        of_face[point->face] += fabs(point->area[normal]);
        for (size_t j = 0; j < dim; j++) {
            sum[j] += point->area[j];
            for (size_t i = 0; i < dim; i++) {
                moment[i][j] += X[i] * point->area[j];
            }
        }
    }
    double volume = edge[0] * edge[1] * edge[2];
    for (size_t j = 0; j < dim; j++) {
        CU_ASSERT_DOUBLE_EQUAL(sum[j] * edge[j] / volume, 0.0, 1e-13);
        CU_ASSERT_DOUBLE_EQUAL(of_face[2 * j] * edge[j] / volume, 1.0, 1e-13);
        CU_ASSERT_DOUBLE_EQUAL(of_face[2 * j + 1] * edge[j] / volume, 1.0, 1e-13);
        for (size_t i = 0; i < dim; i++) {
            CU_ASSERT_DOUBLE_EQUAL(moment[i][j] / volume, i == j ? 1.0 : 0.0, 1e-13);
        }
    }
}

/* Tags say where a particle is; there are as many on faces, edges and in corners as a box has. */
static void check_tags(const struct solver_box *box, const struct solver_cloud *cloud)
{
    size_t dim = (size_t)cloud->dim;
    size_t found[4] = {0}, expected[4] = {0}, face_points = 0;
    for (size_t a = 0; a < cloud->count; a++) {
        uint32_t tags = 0;
        for (size_t i = 0; i < dim; i++) {
            double X = cloud->X[a * dim + i];
            CU_ASSERT(X >= box->lower[i] && X <= box->upper[i]);
            tags |= (X == box->lower[i] ? 1U : 0U) << (2 * i) | (X == box->upper[i] ? 2U : 0U) << (2 * i);
        }
        CU_ASSERT_EQUAL(cloud->tags[a], tags);
        found[__builtin_popcount(tags)]++;
        face_points += (size_t)__builtin_popcount(tags);
    }
    /* every choice, axis by axis, of "at an end" (2 ways) or "between" (points - 2 ways) */
    for (unsigned choice = 0; choice < 1U << dim; choice++) {
        size_t ways = 1;
        for (size_t i = 0; i < dim; i++) {
            ways *= choice >> i & 1U ? 2 : cloud->points[i] - 2;
        }
        expected[__builtin_popcount(choice)] += ways;
    }
    for (int kind = 0; kind < 4; kind++) {
        CU_ASSERT_EQUAL(found[kind], expected[kind]);
    }
    CU_ASSERT_EQUAL(face_points, cloud->face_point_count);
    CU_ASSERT_EQUAL(cloud->count, product(cloud->points, cloud->dim));
}

/* Signed content of a simplex spanned from X by its neighbours along the axes, times dim!. */
static double corner_content(size_t dim, double d[3][3])
{
    return dim == 1 ? d[0][0]
           : dim == 2
               ? d[0][0] * d[1][1] - d[0][1] * d[1][0]
               : d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) - d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
                     d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
}

/* VTK's order: 0 1 2 3 counterclockwise around the lower face, 4 5 6 7 above them. Seen from each corner, the three
 * edges to corners that differ along one axis span a positive volume. */
static void check_cells(const struct solver_box *box, const struct solver_cloud *cloud)
{
    static const unsigned offset[8] = {0, 1, 3, 2, 4, 5, 7, 6}; /* bit i: one further along axis i */
    size_t dim = (size_t)cloud->dim, width = (size_t)1 << dim;
    size_t cells = 1;
    bool *seen = calloc(cloud->count, sizeof *seen);
    CU_ASSERT_PTR_NOT_NULL_FATAL(seen);
    for (size_t i = 0; i < dim; i++) {
        cells *= cloud->points[i] - 1;
    }
    CU_ASSERT_EQUAL_FATAL(cloud->cell_count, cells);
    for (size_t c = 0; c < cells; c++) {
        const uint32_t *cell = cloud->cell + c * width;
        CU_ASSERT_FATAL(cell[0] < cloud->count);
        CU_ASSERT(!seen[cell[0]]); /* a cell is known by its lowest corner */
        seen[cell[0]] = true;
        for (size_t k = 0; k < width; k++) {
            double d[3][3] = {{0}};
            double sign = 1.0;
            CU_ASSERT_FATAL(cell[k] < cloud->count);
            for (size_t i = 0; i < dim; i++) {
                uint32_t site = cloud->site[cell[0] * dim + i] + (offset[k] >> i & 1U);
                CU_ASSERT_EQUAL(cloud->site[cell[k] * dim + i], site);
                size_t other = 0;
                while (other < width && offset[other] != (offset[k] ^ 1U << i)) {
                    other++;
                }
                sign *= offset[k] >> i & 1U ? -1.0 : 1.0;
                for (size_t j = 0; j < dim; j++) {
                    d[i][j] = (cloud->X[cell[other] * dim + j] - cloud->X[cell[k] * dim + j]) / cloud->spacing;
                }
            }
            double content = sign * corner_content(dim, d);
            CU_ASSERT(box->perturb > 0.0 ? content > 0.0 : fabs(content - 1.0) < 1e-12);
        }
    }
    free(seen);
}

static void boxes(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        for (size_t s = 0; s < SHIFTS; s++) {
            struct solver_box box = clouds_box(dim, 8, shifts[s], 5);
            struct solver_cloud *cloud = clouds_make(&box);
            CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
            CU_ASSERT(cloud->dim == dim && cloud->spacing == box.spacing);
            check_volumes(&box, cloud);
            check_areas(&box, cloud);
            check_tags(&box, cloud);
            if (shifts[s] < 0.2) { /* beyond that a cell may be folded: pictures only */
                check_cells(&box, cloud);
            }
            solver_cloud_free(cloud);
        }
    }
}

/* Trapezoidal weights: half on a face, quarter on an edge, eighth in a corner; and positions on the lattice. */
static void lattice(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct solver_box box = clouds_box(dim, 8, 0.0, 5);
        struct solver_cloud *cloud = clouds_make(&box);
        CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
        double whole = pow(box.spacing, dim);
        for (size_t a = 0; a < cloud->count; a++) {
            double share = 1.0 / (double)(1U << __builtin_popcount(cloud->tags[a]));
            CU_ASSERT_DOUBLE_EQUAL(cloud->V[a] / whole, share, 1e-14);
            for (size_t i = 0; i < (size_t)dim; i++) {
                double X = box.lower[i] + box.spacing * cloud->site[a * (size_t)dim + i];
                CU_ASSERT_DOUBLE_EQUAL(cloud->X[a * (size_t)dim + i], X, 1e-14);
            }
        }
        solver_cloud_free(cloud);
    }
}

/* The smallest box: one spacing along each axis, all particles in corners. */
static void smallest(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct solver_box box = {.dim = dim, .upper = {0.1, 0.1, 0.1}, .spacing = 0.1, .perturb = 0.3};
        struct solver_cloud *cloud = clouds_make(&box);
        CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
        CU_ASSERT_EQUAL(cloud->count, (size_t)1 << dim);
        CU_ASSERT_EQUAL(cloud->cell_count, 1);
        check_volumes(&box, cloud);
        check_areas(&box, cloud);
        check_tags(&box, cloud);
        solver_cloud_free(cloud);
    }
}

/* `expected`: what the message must name. */
static void refuse(struct solver_box box, const char *expected)
{
    struct solver_cloud *cloud = (struct solver_cloud *)&box; /* not NULL */
    struct solver_error error = {.code = SOLVER_OK};
    CU_ASSERT(!solver_cloud_box(&box, &cloud, &error));
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
    const struct solver_box good = {.dim = 3, .upper = {1.0, 1.0, 1.0}, .spacing = 0.25};
    struct solver_cloud *cloud = clouds_make(&good);
    CU_ASSERT_PTR_NOT_NULL(cloud);
    solver_cloud_free(cloud);
    solver_cloud_free(NULL);
    struct solver_box bad = good;
    bad.upper[1] = 1.1;
    refuse(bad, "edge Y of 1.1 m is not a whole number of spacings of 0.25 m");
    bad.upper[1] = 0.0;
    refuse(bad, "edge Y");
    bad.upper[1] = -1.0;
    refuse(bad, "edge Y");
    bad.upper[1] = NAN;
    refuse(bad, "edge Y");
    bad = good;
    bad.upper[2] = INFINITY;
    refuse(bad, "edge Z of inf m is inf spacings");
    bad = good;
    bad.spacing = 1e-4;
    refuse(bad, "choose a smaller n");
    bad.spacing = 1e-7;
    refuse(bad, "edge X of 1 m is 1e+07 spacings");
    static const double no_spacing[] = {0.0, NAN, INFINITY, -0.25};
    for (size_t i = 0; i < sizeof no_spacing / sizeof *no_spacing; i++) {
        bad = good;
        bad.spacing = no_spacing[i];
        bad.upper[0] = bad.upper[1] = bad.upper[2] = no_spacing[i] < 0.0 ? -1.0 : 1.0;
        refuse(bad, "spacing");
    }
    static const double no_shift[] = {-0.1, 0.5, 3.0, NAN, INFINITY};
    for (size_t i = 0; i < sizeof no_shift / sizeof *no_shift; i++) {
        bad = good;
        bad.perturb = no_shift[i];
        refuse(bad, "perturb");
    }
    static const int no_dim[] = {-1, 0, 4};
    for (size_t i = 0; i < sizeof no_dim / sizeof *no_dim; i++) {
        bad = good;
        bad.dim = no_dim[i];
        refuse(bad, "dim");
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"volumes, areas, tags, cells", boxes},
        {"lattice", lattice},
        {"smallest box", smallest},
        {"refused boxes", refusals},
    };
    return unit_main("solver cloud", tests, sizeof tests / sizeof *tests);
}
