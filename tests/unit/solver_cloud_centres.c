/* Boxes with particles in the centres of cells: volumes and moments, tags, cells, walls, and what is refused. */
#include "solver/cloud.h"
#include "tests/unit/clouds.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static struct solver_box centred_box(int dim, double perturb)
{
    struct solver_box box = clouds_box(dim, 5, perturb, 7);
    box.centred = true;
    return box;
}

/* sum V = |V|, sum V X = integral of X over the body; every V > 0, and that of a cell where none is moved. */
static void check_volumes(const struct solver_box *box, const struct solver_cloud *cloud)
{
    size_t dim = (size_t)cloud->dim, count = cloud->count - cloud->wall_count;
    double volume = 1.0, sum = 0.0, first[3] = {0};
    for (size_t a = 0; a < count; a++) {
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
    for (size_t a = box->perturb > 0.0 ? count : 0; a < cloud->count; a++) {
        CU_ASSERT_DOUBLE_EQUAL(cloud->V[a] / pow(box->spacing, cloud->dim), 1.0, 1e-14);
    }
}

/* What a place, in spacings from the lower corner, says of tags: next to a face within the first cell of the body, of a
 * wall outside the body. */
static uint32_t expected_tags(const struct solver_box *box, const double *X)
{
    uint32_t next = 0, beyond = 0;
    for (int i = 0; i < box->dim; i++) {
        double from = (X[i] - box->lower[i]) / box->spacing, to = (box->upper[i] - X[i]) / box->spacing;
        next |= (from > 0.0 && from < 1.0 ? 1U : 0U) << (2 * i) | (to > 0.0 && to < 1.0 ? 2U : 0U) << (2 * i);
        beyond |= (from < 0.0 ? 1U : 0U) << (2 * i) | (to < 0.0 ? 2U : 0U) << (2 * i);
    }
    return next << SOLVER_NEXT_TO_FACE | beyond << SOLVER_BEYOND_FACE;
}

static void check_tags(const struct solver_box *box, const struct solver_cloud *cloud)
{
    size_t dim = (size_t)cloud->dim;
    for (size_t a = 0; a < cloud->count; a++) {
        CU_ASSERT_EQUAL(cloud->tags[a], expected_tags(box, cloud->X + a * dim));
        CU_ASSERT_EQUAL(cloud->tags[a] & SOLVER_FACE_BITS, 0);
        CU_ASSERT_EQUAL(cloud->tags[a] >> SOLVER_BEYOND_FACE != 0, a >= cloud->count - cloud->wall_count);
    }
    CU_ASSERT_EQUAL(cloud->face_point_count, 0);
}

/* Positions: half a spacing into each cell, the first one of the lowest layer of walls. */
static void check_sites(const struct solver_box *box, const struct solver_cloud *cloud)
{
    size_t dim = (size_t)cloud->dim, sites = 1, cells = 1, walls = 1;
    bool *seen = calloc(cloud->count, sizeof *seen);
    CU_ASSERT_PTR_NOT_NULL_FATAL(seen);
    for (size_t i = 0; i < dim; i++) {
        size_t body = (size_t)lround((box->upper[i] - box->lower[i]) / box->spacing);
        CU_ASSERT_EQUAL(cloud->points[i], box->wall[2 * i] + body + box->wall[2 * i + 1]);
        sites *= cloud->points[i];
        walls *= body;
        cells *= body - 1;
    }
    CU_ASSERT_EQUAL_FATAL(cloud->count, sites);
    CU_ASSERT_EQUAL(cloud->wall_count, sites - walls);
    CU_ASSERT_EQUAL(cloud->cell_count, cells);
    for (size_t a = 0; a < cloud->count; a++) {
        size_t at = 0;
        for (size_t i = dim; i-- > 0;) {
            double site = (double)cloud->site[a * dim + i] - (double)box->wall[2 * i] + 0.5;
            double most = a < cloud->count - cloud->wall_count ? box->perturb : 0.0;
            CU_ASSERT(fabs(cloud->X[a * dim + i] - box->lower[i] - site * box->spacing) <= most * box->spacing + 1e-14);
            at = at * cloud->points[i] + cloud->site[a * dim + i];
        }
        CU_ASSERT_FATAL(at < cloud->count);
        CU_ASSERT_FALSE(seen[at]);
        seen[at] = true;
    }
    free(seen);
}

/* Cells join particles of the body, a spacing apart along each axis. */
static void check_cells(const struct solver_cloud *cloud)
{
    static const unsigned offset[8] = {0, 1, 3, 2, 4, 5, 7, 6}; /* bit i: one further along axis i */
    size_t dim = (size_t)cloud->dim, width = (size_t)1 << dim;
    for (size_t c = 0; c < cloud->cell_count; c++) {
        const uint32_t *cell = cloud->cell + c * width;
        for (size_t k = 0; k < width; k++) {
            CU_ASSERT_FATAL(cell[k] < cloud->count - cloud->wall_count);
            for (size_t i = 0; i < dim; i++) {
                CU_ASSERT_EQUAL(cloud->site[cell[k] * dim + i], cloud->site[cell[0] * dim + i] + (offset[k] >> i & 1U));
            }
        }
    }
}

static void check(const struct solver_box *box)
{
    struct solver_cloud *cloud = clouds_make(box);
    CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
    check_volumes(box, cloud);
    check_tags(box, cloud);
    check_sites(box, cloud);
    check_cells(cloud);
    solver_cloud_free(cloud);
}

static void boxes(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        for (double perturb = 0.0; perturb < 0.4; perturb += 0.15) {
            struct solver_box box = centred_box(dim, perturb);
            check(&box);
            for (int face = 0; face < 2 * dim; face++) {
                box.wall[face] = 1 + (uint32_t)(face + dim) % 3;
                check(&box);
            }
        }
    }
}

/* Row by row, as on any lattice; walls behind, in rows of their own. */
static void order(void)
{
    struct solver_box box = {.dim = 2, .upper = {0.8, 0.8}, .spacing = 0.1, .centred = true};
    struct solver_cloud *cloud = clouds_make(&box);
    CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
    for (size_t a = 0; a < cloud->count; a++) {
        CU_ASSERT_EQUAL(cloud->site[2 * a] + 8 * cloud->site[2 * a + 1], a);
    }
    solver_cloud_free(cloud);
}

/* A wall changes nothing of the body it stands beside. */
static void walls_stand_apart(void)
{
    struct solver_box box = centred_box(2, 0.0);
    struct solver_cloud *alone = clouds_make(&box);
    box.wall[0] = 3;
    box.wall[3] = 2;
    struct solver_cloud *walled = clouds_make(&box);
    CU_ASSERT_FATAL(alone != NULL && walled != NULL);
    CU_ASSERT_EQUAL_FATAL(walled->count - walled->wall_count, alone->count);
    size_t found = 0;
    for (size_t a = 0; a < alone->count; a++) {
        for (size_t b = 0; b < alone->count; b++) {
            found += walled->X[2 * b] == alone->X[2 * a] && walled->X[2 * b + 1] == alone->X[2 * a + 1] &&
                     walled->V[b] == alone->V[a] && walled->tags[b] == alone->tags[a];
        }
    }
    CU_ASSERT_EQUAL(found, alone->count);
    solver_cloud_free(alone);
    solver_cloud_free(walled);
}

/* Across the face, or both faces, that a particle of a wall lies beyond. */
static void images(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct solver_box box = centred_box(dim, 0.0);
        for (int face = 0; face < 2 * dim; face++) {
            box.wall[face] = 1 + (uint32_t)face % 3;
        }
        struct solver_cloud *cloud = clouds_make(&box);
        CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
        CU_ASSERT_PTR_NULL(cloud->image);
        solver_cloud_free(cloud);
        box.mirrored = true;
        cloud = clouds_make(&box);
        CU_ASSERT_FATAL(cloud != NULL && cloud->image != NULL && cloud->wall_count > 0);
        size_t body = cloud->count - cloud->wall_count, wide = (size_t)dim;
        for (size_t w = 0; w < cloud->wall_count; w++) {
            CU_ASSERT_FATAL(cloud->image[w] < body);
            for (size_t i = 0; i < wide; i++) {
                double X = cloud->X[(body + w) * wide + i];
                double mirror = X < box.lower[i]   ? 2.0 * box.lower[i] - X
                                : X > box.upper[i] ? 2.0 * box.upper[i] - X
                                                   : X;
                CU_ASSERT_DOUBLE_EQUAL(cloud->X[cloud->image[w] * wide + i], mirror, 1e-14);
            }
        }
        solver_cloud_free(cloud);
    }
}

static void refuse(struct solver_box box, const char *expected)
{
    struct solver_cloud *cloud = NULL;
    struct solver_error error = {.code = SOLVER_OK};
    CU_ASSERT_FALSE(solver_cloud_box(&box, &cloud, &error));
    CU_ASSERT_PTR_NULL(cloud);
    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
    if (strstr(error.text, expected) == NULL) {
        (void)printf("\"%s\" does not name \"%s\"\n", error.text, expected);
        CU_FAIL("the message does not say what is wrong");
    }
}

static void refusals(void)
{
    struct solver_box bad = centred_box(2, 0.0);
    bad.upper[1] = bad.lower[1] + bad.spacing;
    refuse(bad, "edge Y of 0.05 m is one spacing");
    bad = centred_box(2, 0.0);
    bad.wall[4] = 1;
    refuse(bad, "wall");
    bad.wall[4] = 0;
    bad.wall[2] = bad.wall[3] = 7;
    bad.mirrored = true;
    refuse(bad, "wall: 7 layers beyond a face across Y, and the body has 6");
    bad = clouds_box(2, 5, 0.0, 7);
    bad.wall[1] = 1;
    refuse(bad, "expected lattice = \"centres\"");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"volumes, tags, sites, cells", boxes},
        {"order", order},
        {"walls stand apart", walls_stand_apart},
        {"images", images},
        {"refusals", refusals},
    };
    return unit_main("solver cloud of centres", tests, sizeof tests / sizeof *tests);
}
