/* Lattices whose spacing changes along an axis: their places, and what stencils along their lines keep of what they
 * promise on even ones. */
#include "solver/stencil.h"
#include "tests/unit/stencil_properties.h"
#include "tests/unit/unit.h"

#include <string.h>

static const double exact = 1e-12; /* round-off of sums over a row, relative */

/* --- places --- */

static struct solver_grading grading_of(double ratio, int fine)
{
    return (struct solver_grading){.ratio = ratio, .fine = fine};
}

static void places_have_the_ratio(void)
{
    double X[26];
    struct solver_error error;
    for (int fine = 0; fine < 4; fine++) {
        for (size_t points = 4; points <= 26; points++) {
            struct solver_grading grading = grading_of(10.0, fine);
            double least = INFINITY, most = 0.0;
            CU_ASSERT_FATAL(solver_grading_places(&grading, 0, -0.3, 1.4, points, X, &error));
            for (size_t i = 0; i + 1 < points; i++) {
                least = fmin(least, X[i + 1] - X[i]);
                most = fmax(most, X[i + 1] - X[i]);
            }
            CU_ASSERT(X[0] == -0.3 && X[points - 1] == 1.4);
            CU_ASSERT(least > 0.0 && fabs(most / least / 10.0 - 1.0) < 1e-12);
        }
    }
}

static void places_are_fine_where_asked(void)
{
    enum { POINTS = 13 };
    double X[4][POINTS];
    struct solver_error error;
    for (int fine = 0; fine < 4; fine++) {
        struct solver_grading grading = grading_of(10.0, fine);
        CU_ASSERT_FATAL(solver_grading_places(&grading, 0, 0.0, 1.0, POINTS, X[fine], &error));
    }
    for (size_t i = 0; i + 1 < POINTS; i++) { /* each spacing the same multiple of the last, and the mirror image */
        double h = X[0][i + 1] - X[0][i];
        CU_ASSERT_DOUBLE_EQUAL(h, (X[0][1] - X[0][0]) * pow(10.0, (double)i / (POINTS - 2)), 1e-15);
        CU_ASSERT_DOUBLE_EQUAL(h, X[1][POINTS - 1 - i] - X[1][POINTS - 2 - i], 1e-15);
    }
    for (size_t i = 0; i < POINTS; i++) {
        CU_ASSERT_DOUBLE_EQUAL(X[2][i] + X[2][POINTS - 1 - i], 1.0, 1e-15);
        CU_ASSERT_DOUBLE_EQUAL(X[3][i] + X[3][POINTS - 1 - i], 1.0, 1e-15);
    }
    CU_ASSERT(X[2][1] < 0.5 * X[2][7] - 0.5 * X[2][6] && X[3][1] > 3.0 * (X[3][7] - X[3][6]));
}

static void places_are_refused(void)
{
    static const struct {
        double ratio;
        int fine;
        size_t points;
        const char *why;
    } cases[] = {{0.5, SOLVER_FINE_LOWER, 9, "expected a number >= 1"},
                 {-1.0, SOLVER_FINE_LOWER, 9, "expected a number >= 1"},
                 {NAN, SOLVER_FINE_LOWER, 9, "expected a number >= 1"},
                 {INFINITY, SOLVER_FINE_LOWER, 9, "expected a number >= 1"},
                 {10.0, SOLVER_FINE_UPPER, 2, "choose a larger n"},
                 {10.0, SOLVER_FINE_BOTH, 3, "choose a larger n"}};
    double X[9];
    unit_untrapped();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct solver_error error = {.code = SOLVER_OK};
        struct solver_grading grading = grading_of(cases[i].ratio, cases[i].fine);
        CU_ASSERT(!solver_grading_places(&grading, 1, 0.0, 1.0, cases[i].points, X, &error));
        CU_ASSERT(error.code == SOLVER_BAD_INPUT && strstr(error.text, cases[i].why) != NULL);
        CU_ASSERT(strncmp(error.text, "grading.Y: ", 11) == 0);
    }
}

/* --- clouds and stencils --- */

/* Fine at one end, at both and in the middle, along one, two and three axes. */
static struct solver_box graded_box(int dim, int edge)
{
    static const struct solver_grading along[3] = {
        {10.0, SOLVER_FINE_LOWER}, {4.0, SOLVER_FINE_BOTH}, {3.0, SOLVER_FINE_MIDDLE}};
    struct solver_box box = clouds_box(dim, edge, 0.0, 1);
    memcpy(box.grading, along, sizeof along);
    return box;
}

static struct solver_stencil *stencil_of(const char *builder, const struct solver_cloud *cloud)
{
    struct solver_error error = {.code = SOLVER_OK};
    struct solver_stencil *stencil = NULL;
    if (!solver_stencil_create(solver_stencil_find(builder), cloud, 2.0, &stencil, &error)) {
        (void)printf("\n    %s: %s", builder, error.text);
        CU_FAIL_FATAL("no stencil");
    }
    return stencil;
}

/* What follows from antisymmetry, closure and exactness for X holds to round-off, as on even lattices. */
static void stencils_keep_their_promises(void)
{
    for (const struct solver_stencil_builder *builder = solver_stencil_builders(); builder->name != NULL; builder++) {
        for (int dim = 1; dim <= 3 && builder->lattice_only; dim++) {
            struct solver_box box = graded_box(dim, 11);
            struct solver_cloud *cloud = clouds_make(&box);
            CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
            struct solver_stencil *stencil = stencil_of(builder->name, cloud);
            struct stencil_properties found = properties_measure(cloud, stencil, &box);
            CU_ASSERT(found.antisymmetry == 0.0 && found.closure <= exact);
            CU_ASSERT(found.stress <= 10.0 * exact && found.parts <= exact && found.adjoint <= exact);
            CU_ASSERT(found.volume <= exact && found.moment <= exact);
            CU_ASSERT(found.area <= exact && found.area_moment <= exact);
            CU_ASSERT(found.inner[1] <= exact && found.outer[1] <= exact);
            CU_ASSERT(found.inner[2] >
                      1e-5); /* no polynomial in X of a higher degree is one in the numbers of planes */
            solver_stencil_free(stencil);
            solver_cloud_free(cloud);
        }
    }
}

/* Volumes and areas of the cloud itself, those of the trapezoidal rule. */
static void clouds_fill_their_box(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct solver_box box = graded_box(dim, 7);
        struct solver_cloud *cloud = clouds_make(&box);
        CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
        double volume = 0.0, whole = 1.0, area[6] = {0}, finest = INFINITY;
        for (int axis = 0; axis < dim; axis++) {
            whole *= box.upper[axis] - box.lower[axis];
            for (uint32_t i = 0; i + 1 < cloud->points[axis]; i++) {
                finest = fmin(finest, cloud->plane[axis][i + 1] - cloud->plane[axis][i]);
            }
        }
        for (size_t a = 0; a < cloud->count; a++) {
            volume += cloud->V[a];
        }
        for (size_t i = 0; i < cloud->face_point_count; i++) {
            area[cloud->face_point[i].face] += cloud->face_point[i].area[cloud->face_point[i].face / 2];
        }
        CU_ASSERT_DOUBLE_EQUAL(volume / whole, 1.0, 1e-14);
        for (int face = 0; face < 2 * dim; face++) {
            double across = whole / (box.upper[face / 2] - box.lower[face / 2]);
            CU_ASSERT_DOUBLE_EQUAL(area[face] / across, face % 2 == 0 ? -1.0 : 1.0, 1e-14);
        }
        CU_ASSERT(solver_cloud_finest(cloud) == finest && finest < 0.5 * cloud->spacing);
        solver_cloud_free(cloud);
    }
}

/* Largest error of the slope of sin(5 X), over its largest. */
static double slope_error(const char *builder, int cells, double ratio, int fine)
{
    struct solver_box box = {.dim = 1, .upper = {1.0}, .spacing = 1.0 / cells};
    box.grading[0] = grading_of(ratio, fine);
    struct solver_cloud *cloud = clouds_make(&box);
    CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
    struct solver_stencil *stencil = stencil_of(builder, cloud);
    double *f = properties_field(cloud->count);
    double square = 0.0;
    for (size_t a = 0; a < cloud->count; a++) {
        f[a] = sin(5.0 * cloud->X[a]);
    }
    for (size_t a = 0; a < cloud->count; a++) {
        double g[3];
        properties_gradient(stencil, f, a, g);
        double error = g[0] / stencil->V[a] / 5.0 - cos(5.0 * cloud->X[a]);
        square += stencil->V[a] * error * error;
    }
    free(f);
    solver_stencil_free(stencil);
    solver_cloud_free(cloud);
    return sqrt(square);
}

/* In the mean square of a slope rows at the ends, of first order with sbp2 and second with sbp4, cost half an order. */
static void slopes_converge(void)
{
    for (int fine = 0; fine < 4; fine++) {
        double sbp2 = log2(slope_error("sbp2", 80, 10.0, fine) / slope_error("sbp2", 160, 10.0, fine));
        double sbp4 = log2(slope_error("sbp4", 80, 10.0, fine) / slope_error("sbp4", 160, 10.0, fine));
        (void)printf("\n    fine %d: orders of the slope: sbp2 %.2f, sbp4 %.2f", fine, sbp2, sbp4);
        CU_ASSERT(sbp2 > 1.4 && sbp4 > 2.4);
    }
}

/* Spectral norm of W^-1/2 Q W^-1/2, by iteration: what bounds the time step. */
static double spectral_norm(const struct solver_stencil *stencil)
{
    size_t count = stencil->count;
    double *x = properties_random(count, 5), *y = properties_field(count);
    double norm = 0.0;
    for (int round = 0; round < 400; round++) {
        double square = 0.0;
        for (size_t a = 0; a < count; a++) {
            y[a] = 0.0;
            for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
                size_t b = stencil->graph.neighbour[ab];
                y[a] += 0.5 * solver_stencil_C(stencil, ab)[0] * x[b] / sqrt(stencil->V[a] * stencil->V[b]);
            }
            square += y[a] * y[a];
        }
        norm = sqrt(square);
        for (size_t a = 0; a < count; a++) {
            x[a] = y[a] / norm;
        }
    }
    free(x);
    free(y);
    return norm;
}

/* A step by the CFL number is as safe as on an even line, and not much shorter than need be. */
static void steps_go_by_the_smallest(void)
{
    static const char *const builders[] = {"sbp2", "sbp4"};
    for (size_t b = 0; b < 2; b++) {
        double even = 0.0;
        for (int fine = -1; fine < 4; fine++) {
            struct solver_box box = {.dim = 1, .upper = {1.0}, .spacing = 1.0 / 24.0};
            box.grading[0] = grading_of(fine < 0 ? 1.0 : 100.0, fine < 0 ? 0 : fine);
            struct solver_cloud *cloud = clouds_make(&box);
            CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
            struct solver_stencil *stencil = stencil_of(builders[b], cloud);
            double norm = spectral_norm(stencil) * stencil->finest;
            even = fine < 0 ? norm : even;
            CU_ASSERT(fine < 0 ? stencil->finest == cloud->spacing : norm <= even && norm > 0.5 * even);
            CU_ASSERT(stencil->finest <= 1.05 * solver_cloud_finest(cloud));
            solver_stencil_free(stencil);
            solver_cloud_free(cloud);
        }
    }
}

/* Even axes of a graded lattice have the very pair vectors of even lattices, so that rows along them are kept once. */
static void rows_are_shared_along_even_axes(void)
{
    struct solver_error error;
    struct solver_box box = clouds_box(3, 20, 0.0, 1);
    box.grading[0] = grading_of(10.0, SOLVER_FINE_LOWER);
    struct solver_cloud *cloud = clouds_make(&box);
    CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
    struct solver_stencil *whole = stencil_of("sbp2", cloud), *shared = stencil_of("sbp2", cloud);
    CU_ASSERT(solver_stencil_share(shared, &error) && shared->shared != NULL);
    CU_ASSERT(shared->records < whole->records / 4);
    for (size_t a = 0; a < whole->count; a++) {
        size_t shift = solver_stencil_shift(shared, a);
        for (size_t ab = whole->graph.row[a]; ab < whole->graph.row[a + 1]; ab++) {
            const double *one = solver_stencil_C(whole, ab), *other = solver_stencil_C(shared, ab + shift);
            CU_ASSERT(one[0] == other[0] && one[1] == other[1] && one[2] == other[2] && one[3] == other[3]);
        }
    }
    solver_stencil_free(whole);
    solver_stencil_free(shared);
    solver_cloud_free(cloud);
}

/* --- what does not fit --- */

static void clouds_are_refused(void)
{
    struct solver_box centred = graded_box(2, 7), moved = graded_box(2, 7);
    centred.centred = true;
    moved.perturb = 0.1;
    const struct solver_box *boxes[] = {&centred, &moved};
    for (size_t i = 0; i < 2; i++) {
        struct solver_error error = {.code = SOLVER_OK};
        struct solver_cloud *cloud = NULL;
        CU_ASSERT(!solver_cloud_box(boxes[i], &cloud, &error) && cloud == NULL);
        CU_ASSERT(error.code == SOLVER_BAD_INPUT && strstr(error.text, "grading.X") != NULL);
    }
}

static void stencils_are_refused(void)
{
    struct solver_box box = graded_box(1, 11);
    for (const struct solver_stencil_builder *builder = solver_stencil_builders(); builder->name != NULL; builder++) {
        struct solver_error error = {.code = SOLVER_OK};
        struct solver_stencil *stencil = NULL;
        box.grading[0] = grading_of(1e6, SOLVER_FINE_LOWER); /* neighbouring spacings differ four times */
        struct solver_cloud *cloud = clouds_make(&box);
        bool made = solver_stencil_create(builder, cloud, 3.0, &stencil, &error);
        CU_ASSERT(made ==
                  (strcmp(builder->name, "sbp2") == 0)); /* its weights are half of the gaps, whatever they are */
        CU_ASSERT(made || error.code == SOLVER_BAD_INPUT);
        CU_ASSERT(made || strstr(error.text, builder->lattice_only ? "change too fast" : "one support") != NULL);
        solver_stencil_free(stencil);
        solver_cloud_free(cloud);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"places have the ratio", places_have_the_ratio},
        {"places are fine where asked", places_are_fine_where_asked},
        {"places that are refused", places_are_refused},
        {"clouds fill their box", clouds_fill_their_box},
        {"stencils keep their promises", stencils_keep_their_promises},
        {"slopes converge", slopes_converge},
        {"steps go by the smallest spacing", steps_go_by_the_smallest},
        {"rows are shared along even axes", rows_are_shared_along_even_axes},
        {"clouds that are refused", clouds_are_refused},
        {"stencils that are refused", stencils_are_refused},
    };
    return unit_main("solver grading", tests, sizeof tests / sizeof *tests);
}
