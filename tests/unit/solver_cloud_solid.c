/* Clouds of bodies of any shape: volumes and areas, the divergence theorem for quadratic fields, places, faces, what
 * the closed stencil keeps on them, refusals. */
#include "tests/unit/solid_shapes.h"
#include "tests/unit/stencil_properties.h"
#include "tests/unit/unit.h"

#include <stdlib.h>
#include <string.h>

/* Spacings along the radius for what need not be looked at finely. */
static int coarse(const struct solid_shape *shape)
{
    return shape->dim == 2 ? 8 : 4;
}

/* Volume and area of the polyhedron, which the cloud has to round-off, are of second order. */
static void sizes(void)
{
    for (int s = 0; s < SOLID_SHAPES; s++) {
        double error[2][2] = {{0}};
        for (int level = 0; level < 2; level++) {
            struct solver_cloud *cloud = solid_cloud(&solid_shapes[s], level == 0 ? 4 : 8);
            double sum = 0.0;
            for (size_t a = 0; a < cloud->count; a++) {
                CU_ASSERT(cloud->V[a] > 0.0);
                sum += cloud->V[a];
            }
            CU_ASSERT_DOUBLE_EQUAL(sum / cloud->quality->volume, 1.0, 1e-13);
            error[level][0] = fabs(cloud->quality->volume / solid_shapes[s].volume - 1.0);
            error[level][1] = fabs(cloud->quality->area / solid_shapes[s].area - 1.0);
            solver_cloud_free(cloud);
        }
        (void)printf("%s %.1e %.1e ", solid_shapes[s].name, error[1][0], error[1][1]);
        CU_ASSERT(error[1][0] < 1e-13 || (error[1][0] < 3e-3 && error[0][0] > 3.4 * error[1][0]));
        CU_ASSERT(error[1][1] < 1e-13 || (error[1][1] < 3e-3 && error[0][1] > 3.4 * error[1][1]));
    }
}

/* Sum over the surface of f B_k against sum V df/dX_k for 1, X_i and X_i X_j (a factor of index `dim` is 1). */
static double divergence_error(const struct solver_cloud *cloud)
{
    size_t dim = (size_t)cloud->dim;
    double worst = 0.0;
    for (size_t i = 0; i <= dim; i++) {
        for (size_t j = i; j <= dim; j++) {
            double left[3] = {0}, right[3] = {0};
            for (size_t p = 0; p < cloud->face_point_count; p++) {
                const double *X = cloud->X + cloud->face_point[p].particle * dim;
                for (size_t k = 0; k < dim; k++) {
                    left[k] += (i < dim ? X[i] : 1.0) * (j < dim ? X[j] : 1.0) * cloud->face_point[p].area[k];
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
                properties_worse(&worst, fabs(left[k] - right[k]) / cloud->quality->volume);
            }
        }
    }
    return worst;
}

static void divergence_theorem(void)
{
    for (int s = 0; s < SOLID_SHAPES; s++) {
        for (int n = 4; n <= coarse(&solid_shapes[s]); n *= 2) {
            struct solver_cloud *cloud = solid_cloud(&solid_shapes[s], n);
            double worst = divergence_error(cloud);
            (void)printf("%.1e ", worst);
            CU_ASSERT(worst <= 2e-13); /* round-off of as many sums as there are particles */
            solver_cloud_free(cloud);
        }
    }
}

/* What the quality says is so; every particle with an area on the surface lies on it, every other within. */
static void places(void)
{
    for (int s = 0; s < SOLID_SHAPES; s++) {
        struct solver_cloud *cloud = solid_cloud(&solid_shapes[s], coarse(&solid_shapes[s]));
        const struct solver_cloud_quality *quality = cloud->quality;
        size_t dim = (size_t)cloud->dim, on_surface = 0;
        double nearest = INFINITY, off = 0.0, least = INFINITY;
        for (size_t a = 0; a < cloud->count; a++) {
            double X[3] = {0}, distance;
            memcpy(X, cloud->X + a * dim, dim * sizeof *X);
            (void)solid_distance(&solid_shapes[s], X, &distance, NULL);
            bool on = (cloud->tags[a] >> SOLVER_SURFACE & 1U) != 0;
            on_surface += on;
            off = on ? fmax(off, fabs(distance) / cloud->spacing) : off;
            CU_ASSERT(on || distance < -0.3 * cloud->spacing);
            least = fmin(least, cloud->V[a] / pow(cloud->spacing, cloud->dim));
            for (size_t b = 0; b < a; b++) {
                double square = 0.0;
                for (size_t i = 0; i < dim; i++) {
                    square += pow(cloud->X[a * dim + i] - cloud->X[b * dim + i], 2);
                }
                nearest = fmin(nearest, sqrt(square) / cloud->spacing);
            }
        }
        CU_ASSERT_EQUAL(on_surface, quality->on_surface);
        CU_ASSERT_DOUBLE_EQUAL(nearest, quality->nearest, 1e-12);
        CU_ASSERT_DOUBLE_EQUAL(least, quality->least_volume, 1e-12);
        CU_ASSERT_DOUBLE_EQUAL(off, quality->off_surface, 1e-15);
        CU_ASSERT(nearest > 0.55 && least > 0.09 && off < 1e-9 && quality->widest < 1.2);
        CU_ASSERT(quality->closure < 1e-14 && quality->correction < 0.03 && quality->area_correction < 0.03);
        solver_cloud_free(cloud);
    }
}

/* Where the box is the surface the cloud is that of the box: volumes, tags and areas. */
static void faces_of_a_box(void)
{
    const struct solid_shape *shape = &solid_shapes[SOLID_SHAPES - 1];
    struct solver_cloud *cloud = solid_cloud(shape, 8), *box_cloud = NULL;
    struct solver_solid solid = solid_of(shape, 8);
    struct solver_box box = {.dim = 3, .spacing = solid.spacing};
    struct solver_error error;
    memcpy(box.lower, solid.lower, sizeof box.lower);
    memcpy(box.upper, solid.upper, sizeof box.upper);
    CU_ASSERT_FATAL(solver_cloud_box(&box, &box_cloud, &error));
    CU_ASSERT_EQUAL_FATAL(cloud->count, box_cloud->count);
    CU_ASSERT_EQUAL_FATAL(cloud->face_point_count, box_cloud->face_point_count);
    double cube = pow(box.spacing, 3), face = pow(box.spacing, 2);
    for (size_t a = 0; a < cloud->count; a++) {
        CU_ASSERT_EQUAL(cloud->tags[a], box_cloud->tags[a]);
        CU_ASSERT_DOUBLE_EQUAL(cloud->V[a] / cube, box_cloud->V[a] / cube, 1e-12);
        for (int i = 0; i < 3; i++) {
            CU_ASSERT_DOUBLE_EQUAL(cloud->X[3 * a + (size_t)i], box_cloud->X[3 * a + (size_t)i], 1e-15);
        }
    }
    for (size_t p = 0; p < cloud->face_point_count; p++) {
        const struct solver_face_point *point = &cloud->face_point[p], *of_box = &box_cloud->face_point[p];
        CU_ASSERT(point->particle == of_box->particle && point->face == of_box->face);
        for (int i = 0; i < 3; i++) {
            CU_ASSERT_DOUBLE_EQUAL(point->area[i] / face, of_box->area[i] / face, 1e-12);
        }
    }
    solver_cloud_free(cloud);
    solver_cloud_free(box_cloud);
}

/* The rim of a cylinder's end, or of a hole, has particles with areas on both, and those of plane faces are normal. */
static void rims(void)
{
    for (int s = 0; s < SOLID_SHAPES; s++) {
        struct solver_cloud *cloud = solid_cloud(&solid_shapes[s], coarse(&solid_shapes[s]));
        size_t rims = 0, rounded = 0;
        for (size_t a = 0; a < cloud->count; a++) {
            bool on = (cloud->tags[a] >> SOLVER_SURFACE & 1U) != 0;
            rounded += on;
            rims += on && (cloud->tags[a] & 0x3fU) != 0;
        }
        for (size_t p = 0; p < cloud->face_point_count; p++) {
            const struct solver_face_point *point = &cloud->face_point[p];
            for (uint32_t i = 0; i < 3 && point->face < SOLVER_SURFACE; i++) {
                CU_ASSERT(i == point->face / 2 ? point->area[i] * (point->face % 2 == 0 ? -1.0 : 1.0) > 0.0
                                               : point->area[i] == 0.0);
            }
        }
        bool cut = strcmp(solid_shapes[s].name, "cylinder") == 0 || strstr(solid_shapes[s].name, "quarter") != NULL;
        CU_ASSERT(cut ? rims >= 2 && rims < rounded : rims == 0);
        solver_cloud_free(cloud);
    }
}

/* The closed stencil meets its constraints to round-off, and so a constant stress makes no force and gradient and
 * divergence are adjoint. */
static void closed(void)
{
    const struct solver_stencil_builder *builder = solver_stencil_find("closed");
    for (int s = 0; s < SOLID_SHAPES; s++) {
        struct solver_cloud *cloud = solid_cloud(&solid_shapes[s], solid_shapes[s].dim == 2 ? 12 : 4);
        struct solver_stencil *stencil = NULL;
        struct solver_error error = {.text = ""};
        struct stencil_properties found = {.antisymmetry = 0.0};
        bool made = solver_stencil_create(builder, cloud, 2.2, &stencil, &error);
        (void)printf("%s", error.text);
        CU_ASSERT_FATAL(made);
        double *area = properties_areas(stencil);
        struct solver_stencil_residuals residuals = solver_stencil_check(stencil, cloud);
        properties_pairs(stencil, area, &found);
        properties_identities(stencil, area, &found);
        CU_ASSERT(found.antisymmetry == 0.0 && found.closure <= 1e-11 && residuals.linear <= 1e-11);
        CU_ASSERT(found.stress <= 1e-11 && found.parts <= 1e-11 && found.adjoint <= 1e-14);
        free(area);
        solver_stencil_free(stencil);
        solver_cloud_free(cloud);
    }
}

/* Cells name particles, and their outer sides are closed: together they have the polygon's area in 2D. */
static void cells(void)
{
    for (int s = 0; s < SOLID_SHAPES; s++) {
        struct solver_cloud *cloud = solid_cloud(&solid_shapes[s], coarse(&solid_shapes[s]));
        size_t corners = (size_t)1 << cloud->dim, wrong = 0;
        double sum = 0.0;
        for (size_t c = 0; c < cloud->cell_count * corners; c++) {
            wrong += cloud->cell[c] >= cloud->count;
        }
        CU_ASSERT(cloud->cell_count > 0 && wrong == 0);
        for (size_t c = 0; wrong == 0 && cloud->dim == 2 && c < cloud->cell_count; c++) {
            for (size_t k = 0; k < 4; k++) {
                const double *a = cloud->X + 2 * (size_t)cloud->cell[4 * c + k];
                const double *b = cloud->X + 2 * (size_t)cloud->cell[4 * c + (k + 1) % 4];
                sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
            }
        }
        CU_ASSERT(cloud->dim == 3 || fabs(sum / solid_shapes[s].volume - 1.0) < 0.02);
        solver_cloud_free(cloud);
    }
}

static bool on_any_face(const struct solver_cloud *cloud, uint32_t particle)
{
    return (cloud->tags[particle] & ((2U << SOLVER_SURFACE) - 1U)) != 0;
}

/* How many sides of all cells run between these two, either way. */
static size_t sides_between(const struct solver_cloud *cloud, uint32_t a, uint32_t b)
{
    size_t count = 0;
    for (size_t side = 0; side < 4 * cloud->cell_count; side++) {
        uint32_t from = cloud->cell[side], to = cloud->cell[side % 4 == 3 ? side - 3 : side + 1];
        count += (from == a && to == b) || (from == b && to == a);
    }
    return count;
}

/* Sides that an odd number of cells has, the rim of a picture, which do not run along the surface. */
static size_t notches(const struct solver_cloud *cloud)
{
    size_t count = 0;
    for (size_t side = 0; side < 4 * cloud->cell_count; side++) {
        uint32_t a = cloud->cell[side], b = cloud->cell[side % 4 == 3 ? side - 3 : side + 1];
        if (a != b && !(on_any_face(cloud, a) && on_any_face(cloud, b))) {
            count += sides_between(cloud, a, b) % 2;
        }
    }
    return count;
}

static void rim(void)
{
    for (int s = 0; s < SOLID_SHAPES && solid_shapes[s].dim == 2; s++) {
        for (int n = 4; n <= 12; n += 4) {
            struct solver_cloud *cloud = solid_cloud(&solid_shapes[s], n);
            CU_ASSERT_EQUAL(notches(cloud), 0);
            solver_cloud_free(cloud);
        }
    }
}

static void refuse(const struct solver_solid *solid, const char *expected)
{
    struct solver_cloud *cloud = NULL;
    struct solver_error error = {.code = SOLVER_OK};
    CU_ASSERT_FALSE(solver_cloud_solid(solid, &cloud, &error));
    CU_ASSERT_PTR_NULL(cloud);
    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
    if (strstr(error.text, expected) == NULL) {
        (void)printf("\"%s\" does not name \"%s\"\n", error.text, expected);
        CU_FAIL("the message does not say what is wrong");
    }
}

static double nowhere(const double X[3])
{
    (void)X;
    return 0.1;
}

static double square_of(const double X[3])
{
    return 4.0 * (X[0] * X[0] + X[1] * X[1] - 0.49);
}

static double thin(const double X[3])
{
    return fabs(X[0] - 0.04) - 0.02; /* a sheet of a quarter of a spacing, between lattice planes */
}

static bool failing(const void *context, const double X[3], double *distance, struct solver_error *error)
{
    *distance = 0.0;
    (void)context;
    return solver_fail(error, SOLVER_BAD_INPUT, "no distance at %g", X[0]);
}

static double not_a_number(const double X[3])
{
    return X[0] > 0.5 ? NAN : X[0];
}

static void refusals(void)
{
    unit_untrapped();
    struct solid_shape shape = solid_shapes[0];
    struct solver_solid solid = solid_of(&shape, 8), off = solid, line = solid, small = solid, still = solid;
    off.spacing = 0.08;
    refuse(&off, "the edge of 1.75 m along X is 21.875 spacings of 0.08 m; expected a whole number");
    off.spacing = -0.1;
    refuse(&off, "expected a whole number");
    off.spacing = NAN;
    refuse(&off, "spacings of nan m");
    small.spacing = 1.75 / (1 << 22);
    refuse(&small, "choose a smaller n");
    line.dim = 1;
    refuse(&line, "a solid lies in 2D or 3D; got dim = 1");
    still.distance = failing;
    refuse(&still, "no distance at");
    shape.distance = nowhere;
    refuse(&solid, "no node of the lattice lies in the body");
    shape.distance = square_of;
    refuse(&solid, "expected a distance, which changes by the way at most");
    shape.distance = not_a_number;
    refuse(&solid, "expected a distance");
    shape.distance = thin;
    refuse(&solid, "choose a larger n");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"sizes", sizes},       {"divergence theorem", divergence_theorem},
        {"places", places},     {"faces of a box", faces_of_a_box},
        {"rims", rims},         {"closed stencil", closed},
        {"cells", cells},       {"the rim of cells", rim},
        {"refusals", refusals},
    };
    return unit_main("solver clouds of any shape", tests, sizeof tests / sizeof *tests);
}
