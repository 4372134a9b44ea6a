/* The quadratic kernel and the corrected gradients built on it. */
#include "solver/kernel.h"
#include "solver/memory.h"
#include "tests/unit/clouds.h"
#include "tests/unit/unit.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* W(q) = 3/16 q^2 - 3/4 q + 3/4 in [0, 2] and zero beyond: values by hand. */
static void values(void)
{
    static const double at[][3] = {{0.0, 0.75, -0.75}, {1.0, 0.1875, -0.375}, {0.5, 0.421875, -0.5625},
                                   {2.0, 0.0, 0.0},    {2.5, 0.0, 0.0},       {1e300, 0.0, 0.0}};
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        double slope = NAN;
        CU_ASSERT_DOUBLE_EQUAL(solver_kernel(at[i][0], &slope), at[i][1], 1e-15);
        CU_ASSERT_DOUBLE_EQUAL(slope, at[i][2], 1e-15);
    }
}

/* Central differences are exact for a quadratic: what is left is round-off over the step. Across q = 2 too, where
 * value and slope go to zero. */
static void derivative(void)
{
    const double step = 1e-4;
    for (double q = step; q < 2.2; q += 0.01) {
        double slope, unused;
        double difference = (solver_kernel(q + step, &unused) - solver_kernel(q - step, &unused)) / (2.0 * step);
        double before = solver_kernel(q, &slope);
        CU_ASSERT_DOUBLE_EQUAL(slope, difference, fabs(q - 2.0) < step ? step : 1e-11);
        CU_ASSERT(q >= 2.0 ? before == 0.0 && slope == 0.0 : before > 0.0 && slope < 0.0);
    }
}

struct made {
    struct solver_cloud *cloud;
    struct solver_graph graph;
    double radius;
    double *gradient; /* [pairs][dim] */
};

static bool make(int dim, double perturb, double support, bool own_volumes, struct made *out,
                 struct solver_error *error)
{
    struct solver_box box = clouds_box(dim, dim < 3 ? 8 : 6, perturb, 17);
    *out = (struct made){.cloud = clouds_make(&box), .radius = support * box.spacing};
    CU_ASSERT_PTR_NOT_NULL_FATAL(out->cloud);
    return solver_graph_build(out->cloud, out->radius, &out->graph, error) &&
           solver_alloc((void **)&out->gradient, out->graph.row[out->cloud->count] * (size_t)dim, sizeof(double),
                        "gradients", error) &&
           solver_kernel_gradients(out->cloud, &out->graph, out->radius, own_volumes ? out->cloud->V : NULL,
                                   out->gradient, error);
}

static void discard(struct made *made)
{
    free(made->gradient);
    solver_graph_free(&made->graph);
    solver_cloud_free(made->cloud);
}

/* sum_b (X_b - X_a) (x) g_ab = I: largest entry of the difference. A NaN comes out as one. */
static double linear_error(const struct made *made)
{
    size_t dim = (size_t)made->cloud->dim;
    const double *X = made->cloud->X;
    double worst = 0.0;
    for (size_t a = 0; a < made->cloud->count; a++) {
        double sum[3][3] = {{0}};
        for (size_t ab = made->graph.row[a]; ab < made->graph.row[a + 1]; ab++) {
            size_t b = made->graph.neighbour[ab];
            for (size_t i = 0; i < dim; i++) {
                for (size_t j = 0; j < dim; j++) {
                    sum[i][j] += (X[b * dim + i] - X[a * dim + i]) * made->gradient[ab * dim + j];
                }
            }
        }
        for (size_t i = 0; i < dim; i++) {
            for (size_t j = 0; j < dim; j++) {
                double error = fabs(sum[i][j] - (i == j ? 1.0 : 0.0));
                worst = isnan(worst) || worst >= error ? worst : error;
            }
        }
    }
    return worst;
}

static void linear_exactness(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        for (int variant = 0; variant < 4; variant++) {
            struct made made;
            struct solver_error error;
            CU_ASSERT_FATAL(make(dim, variant & 1 ? 0.15 : 0.0, 2.1, variant & 2, &made, &error));
            CU_ASSERT(linear_error(&made) <= 1e-13);
            discard(&made);
        }
    }
}

/* Equal and own volumes are the same thing only where all volumes are equal, and far from the boundary they are. */
static void volumes_matter(void)
{
    struct made own, equal;
    struct solver_error error;
    double inside = 0.0, near = 0.0;
    CU_ASSERT_FATAL(make(2, 0.0, 2.1, true, &own, &error));
    CU_ASSERT_FATAL(make(2, 0.0, 2.1, false, &equal, &error));
    for (size_t a = 0; a < own.cloud->count; a++) {
        bool far = true;
        for (size_t i = 0; i < 2; i++) {
            uint32_t at = own.cloud->site[a * 2 + i];
            far = far && at >= 3 && at + 3 < own.cloud->points[i];
        }
        for (size_t i = 2 * own.graph.row[a]; i < 2 * own.graph.row[a + 1]; i++) {
            double *worst = far ? &inside : &near;
            *worst = fmax(*worst, fabs(own.gradient[i] - equal.gradient[i]) * own.cloud->spacing);
        }
    }
    CU_ASSERT(inside <= 1e-14);
    CU_ASSERT(near > 1e-2);
    discard(&own);
    discard(&equal);
}

/* V_b W_b(x) / sum_c V_c W_c(x) for every neighbour of a, at x; `centre` is a's own share, which counts as V_a W(0):
 * its kernel has its tip at X_a, where its gradient is zero by symmetry. */
static void shepard(const struct made *made, size_t a, const double x[3], double *out)
{
    size_t dim = (size_t)made->cloud->dim, from = made->graph.row[a], to = made->graph.row[a + 1];
    double unused;
    double sum = made->cloud->V[a] * solver_kernel(0.0, &unused);
    for (size_t ab = from; ab < to; ab++) {
        size_t b = made->graph.neighbour[ab];
        double square = 0.0;
        for (size_t i = 0; i < dim; i++) {
            double d = x[i] - made->cloud->X[b * dim + i];
            square += d * d;
        }
        out[ab - from] = made->cloud->V[b] * solver_kernel(2.0 * sqrt(square) / made->radius, &unused);
        sum += out[ab - from];
    }
    for (size_t ab = from; ab < to; ab++) {
        out[ab - from] /= sum;
    }
}

/* The gradients once more, independently: the corrected kernel differentiated by differences, then the linear
 * correction M^-1 by GSL (000_e9ec29e1bde7947d.txt section 3.2). */
static void check_particle(const struct made *made, size_t a, double *worst)
{
    enum { MOST = 200 };
    size_t dim = (size_t)made->cloud->dim, from = made->graph.row[a], count = made->graph.row[a + 1] - from;
    const double *X = made->cloud->X;
    double step = 1e-5 * made->cloud->spacing;
    double up[MOST], down[MOST], raw[MOST][3], moment[9] = {0}, inverse[9];
    int sign;
    CU_ASSERT_FATAL(count <= MOST);
    for (size_t j = 0; j < dim; j++) {
        double x[3] = {0};
        memcpy(x, X + a * dim, dim * sizeof *x);
        x[j] += step;
        shepard(made, a, x, up);
        x[j] -= 2.0 * step;
        shepard(made, a, x, down);
        for (size_t n = 0; n < count; n++) {
            size_t b = made->graph.neighbour[from + n];
            raw[n][j] = (up[n] - down[n]) / (2.0 * step);
            for (size_t i = 0; i < dim; i++) {
                moment[j * dim + i] += raw[n][j] * (X[b * dim + i] - X[a * dim + i]);
            }
        }
    }
    gsl_matrix_view M = gsl_matrix_view_array(moment, dim, dim), inverted = gsl_matrix_view_array(inverse, dim, dim);
    gsl_permutation *exchange = gsl_permutation_alloc(dim);
    CU_ASSERT_PTR_NOT_NULL_FATAL(exchange);
    gsl_linalg_LU_decomp(&M.matrix, exchange, &sign);
    gsl_linalg_LU_invert(&M.matrix, exchange, &inverted.matrix);
    gsl_permutation_free(exchange);
    for (size_t n = 0; n < count; n++) {
        for (size_t i = 0; i < dim; i++) {
            double expected = 0.0;
            for (size_t j = 0; j < dim; j++) {
                expected += inverse[i * dim + j] * raw[n][j];
            }
            double error = fabs(made->gradient[(from + n) * dim + i] - expected) * made->cloud->spacing;
            *worst = isnan(*worst) || *worst >= error ? *worst : error;
        }
    }
}

static void against_differences(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct made made;
        struct solver_error error;
        double worst = 0.0;
        CU_ASSERT_FATAL(make(dim, 0.15, 2.1, true, &made, &error));
        for (size_t a = 0; a < made.cloud->count; a++) {
            check_particle(&made, a, &worst);
        }
        (void)printf("%dD %.1e ", dim, worst);
        CU_ASSERT(worst <= 1e-8); /* differences: step^2 is 1e-10, round-off over the step 1e-11 */
        discard(&made);
    }
}

/* Particles on a line askew, whose moments are singular up to round-off alone, must not get gradients of 1e16. */
static void collinear(void)
{
    enum { COUNT = 6, ROUNDS = 50 };
    static const double along[3] = {1.0, 0.37, 0.21};
    uint64_t state = 31;
    for (int dim = 2; dim <= 3; dim++) {
        for (int round = 0; round < ROUNDS; round++) {
            double X[3 * COUNT], gradient[3 * COUNT * COUNT];
            struct solver_cloud cloud = {.dim = dim, .count = COUNT, .spacing = 0.1, .X = X};
            struct solver_graph graph;
            struct solver_error error = {.code = SOLVER_OK};
            for (size_t a = 0; a < COUNT; a++) {
                double at = 0.1 * ((double)a + 0.3 * clouds_random(&state));
                for (size_t i = 0; i < (size_t)dim; i++) {
                    X[a * (size_t)dim + i] = at * along[i];
                }
            }
            CU_ASSERT_FATAL(solver_graph_build(&cloud, 0.25, &graph, &error));
            CU_ASSERT(!solver_kernel_gradients(&cloud, &graph, 0.25, NULL, gradient, &error));
            CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "too few neighbours"));
            solver_graph_free(&graph);
        }
    }
}

/* Supports that leave a particle alone, or with neighbours on a line only, are refused; whatever is not refused is
 * right. */
static void small_supports(void)
{
    size_t refused = 0, taken = 0;
    for (int dim = 1; dim <= 3; dim++) {
        for (double support = 0.75; support < 1.8; support += 0.05) {
            for (int perturbed = 0; perturbed < 2; perturbed++) {
                struct made made;
                struct solver_error error = {.code = SOLVER_OK};
                if (make(dim, 0.3 * perturbed, support, true, &made, &error)) {
                    CU_ASSERT(linear_error(&made) <= 1e-11);
                    taken++;
                } else {
                    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
                    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "too few neighbours"));
                    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "choose a larger support"));
                    refused++;
                }
                discard(&made);
            }
        }
    }
    CU_ASSERT(refused > 10 && taken > 10);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"values", values},
        {"derivative", derivative},
        {"linear exactness", linear_exactness},
        {"volumes matter near the boundary only", volumes_matter},
        {"gradients against differences", against_differences},
        {"collinear particles", collinear},
        {"small supports", small_supports},
    };
    return unit_main("solver kernel", tests, sizeof tests / sizeof *tests);
}
