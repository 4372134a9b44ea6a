/* Clouds: the order of particles in memory, and the random shift that depends on seed and site alone. */
#include "solver/cloud.h"
#include "tests/unit/clouds.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Whether a comes before b row by row: along the last axis, then the one before it. */
static bool before(const uint32_t *a, const uint32_t *b, size_t dim)
{
    size_t axis = dim - 1;
    while (axis > 0 && a[axis] == b[axis]) {
        axis--;
    }
    return a[axis] < b[axis];
}

static void order(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct solver_box box = clouds_box(dim, 8, 0.15, 5);
        struct solver_cloud *cloud = clouds_make(&box);
        CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
        size_t width = (size_t)dim;
        for (size_t a = 0; a + 1 < cloud->count; a++) {
            CU_ASSERT(before(cloud->site + a * width, cloud->site + (a + 1) * width, width));
        }
        solver_cloud_free(cloud);
    }
}

/* Whichever way a body lies, planes go along its longest axis and rows along its shortest: no neighbour along an axis
 * is farther away in memory than the particles of the smallest plane. */
static void locality(void)
{
    static const double sizes[][3] = {{0.3, 0.4, 0.9}, {0.9, 0.3, 0.4}, {0.4, 0.9, 0.3}, {0.9, 0.4, 0.3}};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        struct solver_box box = {.dim = 3, .upper = {sizes[k][0], sizes[k][1], sizes[k][2]}, .spacing = 0.1};
        struct solver_cloud *cloud = clouds_make(&box);
        CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
        CU_ASSERT_EQUAL_FATAL(cloud->count, 200);
        for (size_t a = 0; a < cloud->count; a++) {
            for (size_t b = a + 1; b < cloud->count; b++) {
                size_t apart = 0;
                for (size_t i = 0; i < 3; i++) {
                    apart += (size_t)labs((long)cloud->site[a * 3 + i] - (long)cloud->site[b * 3 + i]);
                }
                CU_ASSERT(apart != 1 || b - a <= 20);
            }
        }
        solver_cloud_free(cloud);
    }
}

static bool same_bytes(const struct solver_cloud *a, const struct solver_cloud *b)
{
    size_t dim = (size_t)a->dim;
    return a->count == b->count && memcmp(a->X, b->X, a->count * dim * sizeof *a->X) == 0 &&
           memcmp(a->V, b->V, a->count * sizeof *a->V) == 0;
}

/* Shifts come from seed and site alone; they fill [-perturb, perturb] evenly along each axis and leave the boundary. */
static void check_shifts(const struct solver_cloud *moved, const struct solver_cloud *still, double perturb)
{
    size_t dim = (size_t)moved->dim, inside = 0;
    double mean[3] = {0}, square[3][3] = {{0}}, furthest = 0.0;
    for (size_t a = 0; a < moved->count; a++) {
        double shift[3] = {0};
        for (size_t i = 0; i < dim; i++) {
            shift[i] = (moved->X[a * dim + i] - still->X[a * dim + i]) / (perturb * moved->spacing);
            CU_ASSERT((moved->tags[a] == 0) == (shift[i] != 0.0));
            furthest = fmax(furthest, fabs(shift[i]));
        }
        inside += moved->tags[a] == 0;
        for (size_t i = 0; i < dim && moved->tags[a] == 0; i++) {
            mean[i] += shift[i];
            for (size_t j = 0; j < dim; j++) {
                square[i][j] += shift[i] * shift[j];
            }
        }
    }
    double n = (double)inside;
    CU_ASSERT(furthest <= 1.0 + 1e-12 && furthest > 0.95);
    for (size_t i = 0; i < dim; i++) { /* five standard deviations of the mean, of the variance, of a covariance */
        CU_ASSERT_DOUBLE_EQUAL(mean[i] / n, 0.0, 5.0 * sqrt(1.0 / 3.0 / n));
        for (size_t j = 0; j < dim; j++) {
            CU_ASSERT_DOUBLE_EQUAL(square[i][j] / n, i == j ? 1.0 / 3.0 : 0.0,
                                   5.0 * (i == j ? sqrt(4.0 / 45.0 / n) : 1.0 / 3.0 / sqrt(n)));
        }
    }
}

static void seeds(void)
{
    static const int edge[4] = {0, 200, 20, 8};
    for (int dim = 1; dim <= 3; dim++) {
        struct solver_box box = clouds_box(dim, edge[dim], 0.2, 7);
        struct solver_cloud *first = clouds_make(&box), *again = clouds_make(&box);
        box.seed = 8;
        struct solver_cloud *other = clouds_make(&box);
        box.perturb = 0.0;
        struct solver_cloud *still = clouds_make(&box);
        box.seed = 7;
        struct solver_cloud *still_again = clouds_make(&box);
        CU_ASSERT_FATAL(first && again && other && still && still_again);
        CU_ASSERT(same_bytes(first, again));
        CU_ASSERT(same_bytes(still, still_again));
        check_shifts(first, still, 0.2);
        check_shifts(other, still, 0.2);
        for (size_t a = 0; a < first->count; a++) {
            CU_ASSERT(first->tags[a] != 0 || first->X[a * (size_t)dim] != other->X[a * (size_t)dim]);
        }
        solver_cloud_free(first);
        solver_cloud_free(again);
        solver_cloud_free(other);
        solver_cloud_free(still);
        solver_cloud_free(still_again);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"row by row", order},
        {"locality", locality},
        {"seeds", seeds},
    };
    return unit_main("solver cloud order", tests, sizeof tests / sizeof *tests);
}
