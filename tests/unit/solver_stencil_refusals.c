/* Stencils that are damaged, clouds and supports that a builder must refuse, the least-squares gradient, and the
 * same bytes for any number of threads. */
#include "solver/stencil.h"
#include "tests/unit/clouds.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <omp.h>
#include <string.h>

struct made {
    struct solver_cloud *cloud;
    struct solver_stencil *stencil;
};

/* A stencil on a perturbed cloud, or, for builders that need one, on a lattice with enough points for each of them. */
static struct made make(const struct solver_stencil_builder *builder, int dim)
{
    struct solver_box box = clouds_box(dim, builder->lattice_only ? 7 : 5, builder->lattice_only ? 0.0 : 0.15, 23);
    struct made made = {.cloud = clouds_make(&box)};
    struct solver_error error = {.code = SOLVER_OK};
    CU_ASSERT_PTR_NOT_NULL_FATAL(made.cloud);
    CU_ASSERT_FATAL(solver_stencil_create(builder, made.cloud, dim == 1 ? 3.0 : 2.1, &made.stencil, &error));
    return made;
}

static void discard(struct made *made)
{
    solver_stencil_free(made->stencil);
    solver_cloud_free(made->cloud);
}

static double largest_C(const struct solver_stencil *stencil)
{
    double largest = 0.0;
    for (size_t ab = 0; ab < stencil->pairs; ab++) {
        for (int i = 0; i < stencil->dim; i++) {
            largest = fmax(largest, fabs(solver_stencil_C(stencil, ab)[i]));
        }
    }
    return largest;
}

/* One entry of C moved by a part of the largest: each residual must show exactly that much. Every residual starts at
 * round-off. */
static void damage_one_entry(struct made *made, size_t a, size_t axis)
{
    struct solver_stencil *stencil = made->stencil;
    size_t dim = (size_t)stencil->dim;
    size_t ab = stencil->graph.row[a];
    size_t b = stencil->graph.neighbour[ab];
    double *entry = &solver_stencil_C(stencil, ab)[axis];
    double kept = *entry, largest = largest_C(stencil);
    double step = -1e-6 * copysign(largest, kept); /* towards zero: the largest entry stays the largest */
    double distance = 0.0;
    for (size_t i = 0; i < dim; i++) {
        distance = fmax(distance, fabs(made->cloud->X[b * dim + i] - made->cloud->X[a * dim + i]));
    }
    struct solver_stencil_residuals before = solver_stencil_check(stencil, made->cloud);
    CU_ASSERT(before.antisymmetry <= 1e-13 && before.closure <= 1e-12 && before.linear <= 1e-12);
    *entry += step;
    struct solver_stencil_residuals after = solver_stencil_check(stencil, made->cloud);
    *entry = kept;
    CU_ASSERT_DOUBLE_EQUAL(after.antisymmetry, 1e-6, 2e-12);
    CU_ASSERT_DOUBLE_EQUAL(after.closure, 1e-6, 2e-12);
    CU_ASSERT_DOUBLE_EQUAL(after.linear / (0.5 * distance * fabs(step) / stencil->V[a]), 1.0, 1e-5);
}

/* Both directions of a pair moved oppositely: antisymmetry cannot show it, the others must. */
static void damage_a_pair(struct made *made, size_t a)
{
    struct solver_stencil *stencil = made->stencil;
    size_t ab = stencil->graph.row[a];
    size_t ba = solver_graph_find(&stencil->graph, stencil->graph.neighbour[ab], a);
    double *there = solver_stencil_C(stencil, ab), *back = solver_stencil_C(stencil, ba);
    double kept = there[0], step = 1e-6 * largest_C(stencil);
    there[0] = kept - copysign(step, kept);
    back[0] = -there[0];
    struct solver_stencil_residuals after = solver_stencil_check(stencil, made->cloud);
    there[0] = kept;
    back[0] = -kept;
    CU_ASSERT(after.antisymmetry <= 1e-13);
    CU_ASSERT_DOUBLE_EQUAL(after.closure, 1e-6, 2e-12);
    CU_ASSERT(after.linear > 1e-8);
}

/* A boundary area belongs to closure alone, a volume to linear exactness alone. */
static void damage_area_and_volume(struct made *made)
{
    struct solver_stencil *stencil = made->stencil;
    struct solver_face_point *point = &stencil->face_point[stencil->face_point_count / 2];
    double *area = &point->area[point->face / 2], kept = *area;
    *area *= 1.0 + 1e-6;
    struct solver_stencil_residuals after = solver_stencil_check(stencil, made->cloud);
    *area = kept;
    CU_ASSERT_DOUBLE_EQUAL(after.closure * largest_C(stencil) / fabs(kept), 1e-6, 1e-11);
    CU_ASSERT(after.antisymmetry <= 1e-13 && after.linear <= 1e-12);
    double *V = &stencil->V[stencil->count / 2];
    kept = *V;
    *V *= 1.0 + 1e-6;
    after = solver_stencil_check(stencil, made->cloud);
    *V = kept;
    CU_ASSERT_DOUBLE_EQUAL(after.linear, 1e-6, 2e-12);
    CU_ASSERT(after.antisymmetry <= 1e-13 && after.closure <= 1e-12);
}

/* What is no number must not pass for a small one. */
static void damaged_with_nan(void)
{
    unit_untrapped();
    struct made made = make(solver_stencil_find("sbp2"), 2);
    solver_stencil_C(made.stencil, made.stencil->pairs / 2)[0] = NAN;
    struct solver_stencil_residuals after = solver_stencil_check(made.stencil, made.cloud);
    CU_ASSERT(!(after.antisymmetry <= 1e-6));
    CU_ASSERT(!(after.closure <= 1e-6));
    CU_ASSERT(!(after.linear <= 1e-6));
    discard(&made);
}

/* Nor in what a stencil is built from. */
static void volume_is_nan(void)
{
    unit_untrapped();
    struct solver_box box = clouds_box(2, 8, 0.15, 1);
    struct solver_cloud *cloud = clouds_make(&box);
    struct solver_stencil *stencil = NULL;
    struct solver_error error = {.code = SOLVER_OK};
    CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
    cloud->V[cloud->count / 2] = NAN;
    CU_ASSERT(!solver_stencil_create(solver_stencil_find("closed"), cloud, 2.1, &stencil, &error));
    CU_ASSERT(!solver_stencil_create(solver_stencil_find("sph"), cloud, 2.1, &stencil, &error));
    CU_ASSERT_PTR_NULL(stencil);
    solver_stencil_free(stencil);
    solver_cloud_free(cloud);
}

static void damaged(void)
{
    for (const struct solver_stencil_builder *b = solver_stencil_builders(); b->name != NULL; b++) {
        for (int dim = 1; dim <= 3 && b->antisymmetric && b->closed; dim++) {
            struct made made = make(b, dim);
            const size_t places[] = {0, made.stencil->count / 3, made.stencil->count - 1};
            for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
                for (size_t axis = 0; axis < (size_t)dim; axis++) {
                    damage_one_entry(&made, places[i], axis);
                }
                damage_a_pair(&made, places[i]);
            }
            damage_area_and_volume(&made);
            discard(&made);
        }
    }
}

/* grad f_a = sum_b (f_b - f_a) g_ab of linear f, on every builder's graph; the stencil grows by the weights. */
static void least_squares(void)
{
    for (const struct solver_stencil_builder *b = solver_stencil_builders(); b->name != NULL; b++) {
        for (int dim = 1; dim <= 3; dim++) {
            struct made made = make(b, dim);
            const struct solver_stencil *stencil = made.stencil;
            struct solver_error error;
            size_t width = (size_t)dim, bytes = solver_stencil_bytes(stencil);
            double worst = 0.0;
            CU_ASSERT_PTR_NULL(stencil->least_squares);
            CU_ASSERT_FATAL(solver_stencil_add_least_squares(made.stencil, made.cloud, &error));
            CU_ASSERT_EQUAL(solver_stencil_bytes(stencil) - bytes, stencil->pairs * width * sizeof(double));
            for (size_t a = 0; a < stencil->count; a++) {
                for (size_t i = 0; i < width * width; i++) { /* d X_(i / dim) / d X_(i % dim) */
                    double sum = 0.0;
                    for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
                        size_t other = stencil->graph.neighbour[ab];
                        sum += (made.cloud->X[other * width + i / width] - made.cloud->X[a * width + i / width]) *
                               stencil->least_squares[ab * width + i % width];
                    }
                    double off = fabs(sum - (i / width == i % width ? 1.0 : 0.0));
                    worst = isnan(worst) || worst >= off ? worst : off;
                }
            }
            CU_ASSERT(worst <= 1e-13);
            discard(&made);
        }
    }
}

/* Weights 1/|d|^2, checked where the sum can be done by hand: on a 1D line each of n neighbours weighs d/(n d^2). */
static void least_squares_by_hand(void)
{
    struct made made = make(solver_stencil_find("closed"), 1);
    const struct solver_stencil *stencil = made.stencil;
    struct solver_error error;
    CU_ASSERT_FATAL(solver_stencil_add_least_squares(made.stencil, made.cloud, &error));
    for (size_t a = 0; a < stencil->count; a++) {
        double n = (double)(stencil->graph.row[a + 1] - stencil->graph.row[a]);
        for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
            double d = made.cloud->X[stencil->graph.neighbour[ab]] - made.cloud->X[a];
            CU_ASSERT_DOUBLE_EQUAL(stencil->least_squares[ab] * n * d, 1.0, 1e-12);
        }
    }
    discard(&made);
}

/* `expected`: a list that ends with NULL, all of which the message must name. */
static void refuse(const char *name, const struct solver_box *box, double support, const char *const *expected)
{
    struct solver_cloud *cloud = clouds_make(box);
    struct solver_stencil *stencil = NULL;
    struct solver_error error = {.code = SOLVER_OK};
    CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
    CU_ASSERT(!solver_stencil_create(solver_stencil_find(name), cloud, support, &stencil, &error));
    CU_ASSERT_PTR_NULL(stencil);
    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
    for (; *expected != NULL; expected++) {
        if (strstr(error.text, *expected) == NULL) {
            (void)printf("%s: \"%s\" does not name \"%s\"\n", name, error.text, *expected);
            CU_FAIL("the message does not say what is wrong");
        }
    }
    solver_stencil_free(stencil);
    solver_cloud_free(cloud);
}

static void refusals(void)
{
    unit_untrapped();
    static const char *const few[] = {"support", "particle", "too few neighbours", "choose a larger support", NULL};
    static const char *const radius[] = {"support", "positive", NULL};
    static const char *const closed[] = {"closed", "choose a larger support", NULL};
    static const char *const points[] = {"sbp4", "at least 8 particles", "edge X has 7", "larger n", NULL};
    static const char *const perturbed[] = {"perturbed", "closed or perturb = 0", NULL};
    for (int dim = 1; dim <= 3; dim++) {
        struct solver_box lattice = clouds_box(dim, 6, 0.0, 1), shifted = clouds_box(dim, 8, 0.1, 1);
        refuse("sph", &lattice, 0.9, few);
        refuse("closed", &lattice, 0.9, few);
        refuse("sph", &lattice, 1.0, few); /* neighbours at the radius are none: the kernel is zero there */
        refuse("closed", &shifted, 0.5, few);
        refuse("sph", &lattice, 0.0, radius);
        refuse("closed", &lattice, -2.0, radius);
        refuse("closed", &lattice, NAN, radius);
        refuse("sbp4", &lattice, 2.1, points);
        refuse("sbp2", &shifted, 2.1, perturbed);
        refuse("sbp4", &shifted, 2.1, perturbed);
    }
    /* nearest neighbours on a shifted line: as many unknowns as pairs, more constraints than that */
    struct solver_box line = clouds_box(1, 8, 0.1, 1);
    refuse("closed", &line, 1.5, closed);
    CU_ASSERT_PTR_NULL(solver_stencil_find("sbp6"));
    CU_ASSERT_PTR_NULL(solver_stencil_find(""));
    solver_stencil_free(NULL);
}

/* Whatever support a scene may ask for: `closed` keeps its promises or says that it cannot. */
static void any_support(void)
{
    size_t refused = 0, taken = 0;
    for (int dim = 1; dim <= 3; dim++) {
        for (double support = 1.1; support < 3.2; support += dim < 3 ? 0.1 : 0.3) {
            for (int perturbed = 0; perturbed < 2; perturbed++) {
                struct solver_box box = clouds_box(dim, dim < 3 ? 8 : 4, 0.2 * perturbed, 29);
                struct solver_cloud *cloud = clouds_make(&box);
                struct solver_stencil *stencil = NULL;
                struct solver_error error = {.code = SOLVER_OK};
                CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
                if (solver_stencil_create(solver_stencil_find("closed"), cloud, support, &stencil, &error)) {
                    struct solver_stencil_residuals found = solver_stencil_check(stencil, cloud);
                    bool kept = found.antisymmetry == 0.0 && found.closure <= 1e-9 && found.linear <= 1e-8;
                    CU_ASSERT(kept);
                    taken++;
                } else {
                    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
                    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "choose a larger support"));
                    refused++;
                }
                solver_stencil_free(stencil);
                solver_cloud_free(cloud);
            }
        }
    }
    (void)printf("%zu taken, %zu refused ", taken, refused);
    CU_ASSERT(taken > 20 && refused > 0);
}

static void same_bytes(void)
{
    int most = omp_get_max_threads();
    for (const struct solver_stencil_builder *b = solver_stencil_builders(); b->name != NULL; b++) {
        omp_set_num_threads(1);
        struct made one = make(b, 3);
        omp_set_num_threads(4);
        struct made four = make(b, 3);
        const struct solver_stencil *x = one.stencil, *y = four.stencil;
        CU_ASSERT_FATAL(x->pairs == y->pairs && x->count == y->count);
        CU_ASSERT_EQUAL(memcmp(x->pair, y->pair, x->pairs * 4 * sizeof *x->pair), 0);
        CU_ASSERT_EQUAL(memcmp(x->row_sum, y->row_sum, x->count * 3 * sizeof *x->row_sum), 0);
        CU_ASSERT((x->transposed == NULL) == (y->transposed == NULL));
        if (x->transposed != NULL && y->transposed != NULL) {
            CU_ASSERT_EQUAL(memcmp(x->transposed, y->transposed, x->pairs * 3 * sizeof *x->transposed), 0);
        }
        discard(&one);
        discard(&four);
    }
    omp_set_num_threads(most);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"damaged stencils", damaged},
        {"damaged with a NaN", damaged_with_nan},
        {"a volume is NaN", volume_is_nan},
        {"least squares", least_squares},
        {"least squares by hand", least_squares_by_hand},
        {"refusals", refusals},
        {"any support", any_support},
        {"same bytes for 1 and 4 threads", same_bytes},
    };
    return unit_main("solver stencil refusals", tests, sizeof tests / sizeof *tests);
}
