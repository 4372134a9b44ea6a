/* Dense linear algebra of dimension at most 4 against GSL's LU factorisation, and singular systems refused. */
#include "solver/small.h"
#include "tests/unit/clouds.h"
#include "tests/unit/unit.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

enum { ROUNDS = 200 };
static const double guard = 7.25; /* stands where a system smaller than 4 must not write */

static void fill(size_t size, double A[4][4], double r[4], uint64_t *state)
{
    for (size_t i = 0; i < 4; i++) {
        r[i] = i < size ? clouds_random(state) : guard;
        for (size_t j = 0; j < 4; j++) {
            A[i][j] = i < size && j < size ? clouds_random(state) : guard;
        }
    }
}

/* Solution by GSL into x; returns the reciprocal of |A| |A^-1| (largest entries), 0 if A is singular. */
static double reference(size_t size, double A[4][4], const double r[4], double x[4], double inverse[4][4])
{
    double plain[16], most = 0.0, most_inverse = 0.0;
    gsl_permutation *exchange = gsl_permutation_alloc(size);
    gsl_matrix_view LU = gsl_matrix_view_array(plain, size, size);
    gsl_matrix_view inverted = gsl_matrix_view_array_with_tda(&inverse[0][0], size, size, 4);
    gsl_vector_view solution = gsl_vector_view_array(x, size);
    int sign;
    CU_ASSERT_PTR_NOT_NULL_FATAL(exchange);
    for (size_t i = 0; i < size; i++) {
        x[i] = r[i];
        for (size_t j = 0; j < size; j++) {
            plain[i * size + j] = A[i][j];
            most = fmax(most, fabs(A[i][j]));
        }
    }
    gsl_linalg_LU_decomp(&LU.matrix, exchange, &sign);
    gsl_linalg_LU_svx(&LU.matrix, exchange, &solution.vector);
    gsl_linalg_LU_invert(&LU.matrix, exchange, &inverted.matrix);
    for (size_t i = 0; i < size; i++) {
        for (size_t j = 0; j < size; j++) {
            most_inverse = fmax(most_inverse, fabs(inverse[i][j]));
        }
    }
    gsl_permutation_free(exchange);
    return 1.0 / (most * most_inverse);
}

static void random_systems(void)
{
    uint64_t state = 3;
    for (size_t size = 1; size <= 4; size++) {
        for (int round = 0; round < ROUNDS; round++) {
            double A[4][4], B[4][4], r[4], x[4] = {0}, inverse[4][4] = {{0}};
            fill(size, A, r, &state);
            double condition = reference(size, A, r, x, inverse);
            double allowed = 1e-14 / condition, scale = 0.0;
            memcpy(B, A, sizeof B);
            for (size_t i = 0; i < size; i++) {
                scale = fmax(scale, fabs(x[i]));
            }
            CU_ASSERT(solver_small_invert(size, B));
            CU_ASSERT(solver_small_solve(size, A, r));
            for (size_t i = 0; i < 4; i++) {
                CU_ASSERT(i < size ? fabs(r[i] - x[i]) <= allowed * scale : r[i] == guard);
                for (size_t j = 0; j < 4; j++) {
                    CU_ASSERT(i < size && j < size ? fabs(B[i][j] - inverse[i][j]) <= allowed / condition
                                                   : B[i][j] == guard);
                }
            }
        }
    }
}

/* A zero on the diagonal is no singularity. */
static void exchanges(void)
{
    double A[4][4] = {{0, 2, 0, 0}, {0, 0, 0, 4}, {8, 0, 0, 0}, {0, 0, 16, 0}};
    double r[4] = {2, 8, 24, 64};
    CU_ASSERT(solver_small_solve(4, A, r));
    CU_ASSERT(r[0] == 3.0 && r[1] == 1.0 && r[2] == 4.0 && r[3] == 2.0);
}

/* Unknowns of very different size, as volumes and first moments are, are no singularity either. */
static void scales(void)
{
    double A[4][4] = {{1e-18, 1e-20}, {1e-20, 1e-6}};
    double r[4] = {3e-18, 2e-6};
    CU_ASSERT(solver_small_solve(2, A, r));
    CU_ASSERT_DOUBLE_EQUAL(r[0], 2.98, 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(r[1], 2.0, 1e-12);
}

static void refuse(size_t size, double A[4][4])
{
    double B[4][4], r[4] = {1, 2, 3, 4};
    memcpy(B, A, sizeof B);
    CU_ASSERT(!solver_small_invert(size, B));
    CU_ASSERT(!solver_small_solve(size, A, r));
}

static void singular(void)
{
    unit_untrapped();
    double zero[4][4] = {{0}}, same[4][4] = {{1, 2}, {2, 4}}, hole[4][4] = {{NAN, 1}, {1, 2}};
    refuse(1, zero);
    refuse(4, zero);
    refuse(2, same);
    refuse(2, hole);
}

/* Sums of outer products of too few vectors: singular up to round-off alone, as the moments of neighbours that lie in
 * a line or a plane are. */
static void singular_to_round_off(void)
{
    uint64_t state = 9;
    for (size_t size = 2; size <= 4; size++) {
        for (int round = 0; round < ROUNDS; round++) {
            double A[4][4] = {{0}};
            for (size_t rank = 0; rank + 1 < size; rank++) {
                double u[4], v[4];
                for (size_t i = 0; i < size; i++) {
                    u[i] = clouds_random(&state);
                    v[i] = clouds_random(&state);
                }
                for (size_t i = 0; i < size; i++) {
                    for (size_t j = 0; j < size; j++) {
                        A[i][j] += u[i] * v[j];
                    }
                }
            }
            refuse(size, A);
        }
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"random systems against GSL", random_systems},
        {"rows exchanged", exchanges},
        {"scales", scales},
        {"singular", singular},
        {"singular to round-off", singular_to_round_off},
    };
    return unit_main("solver small", tests, sizeof tests / sizeof *tests);
}
