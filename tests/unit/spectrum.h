/* Principal values and directions (solver/dim_spectral.h) against GSL, on matrices that are hard to tell the
 * directions of. The dimension is that of the file that includes this. */
#ifndef TESTS_SPECTRUM_H
#define TESTS_SPECTRUM_H

#pragma GCC diagnostic ignored "-Wpsabi" /* vectors are passed within this file alone */
#include "solver/dim_spectral.h"
#include "tests/unit/random_tensors.h"
#include "tests/unit/unit.h"

#include <float.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_sort_double.h>
#include <stdio.h>

enum { TURNS = 200 };

/* Principal values of which some are the same, or nearly, or far apart, or nothing. */
static const double hostile[][3] = {{0, 0, 0},
                                    {1, 1, 1},
                                    {1, 1, 2},
                                    {2, 1, 1},
                                    {1, 1 + 1e-15, 1 - 1e-15},
                                    {1, 1 + 1e-12, 2},
                                    {1, 1 + 1e-8, 1 - 1e-8},
                                    {1, 1 + 1e-8, 1 + 1e-16},
                                    {-1, 1, 1e-9},
                                    {1e8, 1, 1e-8},
                                    {1e150, 1e150, 1},
                                    {1e-150, 2e-150, 3e-150},
                                    {1e-300, 1e-310, 0},
                                    {1, 0, 0},
                                    {-3, -3, 5}};
enum { HOSTILE = sizeof hostile / sizeof *hostile };

/* R diag(values) R^T, symmetric to the bit. */
static inline struct tensor turned(const double *values, bool aligned)
{
    double R[9];
    double nearly = uniform(0, 1) < 0.5 ? 1e-9 : 1.0; /* axes that are those of the lattice, but for a little */
    struct tensor T = {{{0}}};
    unit_tensor(DIM, R);
    if (!aligned) {
        random_rotation(DIM, R);
    }
    if (!aligned && nearly < 1.0) {
        unit_tensor(DIM, R);
        R[1] = nearly;
        R[DIM] = -nearly;
    }
    for (int i = 0; i < DIM; i++) {
        for (int j = 0; j <= i; j++) {
            double sum = 0.0;
            for (int k = 0; k < DIM; k++) {
                sum += R[i * DIM + k] * values[k] * R[j * DIM + k];
            }
            T.column[j][i] = T.column[i][j] = sum;
        }
    }
    return T;
}

static inline double largest_of(struct tensor T)
{
    double rows[9];
    to_rows(T, rows);
    return largest_entry((size_t)DIM * DIM, rows);
}

/* Values by GSL's QR method, increasing. */
static inline void by_gsl(struct tensor T, double *values)
{
    double rows[9];
    to_rows(T, rows);
    gsl_eigen_symm_workspace *work = gsl_eigen_symm_alloc(DIM);
    gsl_matrix_view matrix = gsl_matrix_view_array(rows, DIM, DIM);
    gsl_vector_view vector = gsl_vector_view_array(values, DIM);
    CU_ASSERT_EQUAL_FATAL(gsl_eigen_symm(&matrix.matrix, &vector.vector, work), 0);
    gsl_eigen_symm_free(work);
    gsl_sort(values, 1, DIM);
}

static inline void expect(const char *what, const double *values, double found, double bound)
{
    bool holds = found <= bound;
    if (!holds) {
        printf("\n    %s of %g, %g, %g: %.3e > %.1e", what, values[0], values[1], values[2], found, bound);
    }
    CU_ASSERT(holds);
}

static inline void check_one(const double *values, bool aligned)
{
    struct tensor T = turned(values, aligned);
    struct spectrum of = spectrum(T);
    double size = largest_of(T);
    double scale = size > 0.0 ? size : 1.0;
    double expected[3];
    double found[3];
    by_gsl(T, expected);
    memcpy(found, of.value, DIM * sizeof *found);
    gsl_sort(found, 1, DIM);
    for (int k = 0; k < DIM; k++) {
        /* either is good to a few units of the largest: five sweeps of three rotations are, to sixteen */
        expect("value", values, fabs(found[k] - expected[k]), 32 * DBL_EPSILON * size + DBL_MIN);
        vec image = {0};
        for (int J = 0; J < DIM; J++) {
            image += T.column[J] / scale * of.direction[k][J];
        }
        image -= of.value[k] / scale * of.direction[k];
        expect("T n - value n", values, sqrt(dot(image, image)), 16 * DBL_EPSILON);
        for (int l = 0; l < DIM; l++) {
            expect("directions, orthonormal", values, fabs(dot(of.direction[k], of.direction[l]) - (k == l)),
                   16 * DBL_EPSILON);
        }
    }
}

static inline void hostile_matrices(void)
{
    for (size_t h = 0; h < HOSTILE; h++) {
        check_one(hostile[h], true);
        for (int i = 0; i < TURNS; i++) {
            check_one(hostile[h], false);
        }
    }
}

static inline void random_matrices(void)
{
    for (int i = 0; i < 20 * TURNS; i++) {
        double values[3];
        for (int k = 0; k < 3; k++) {
            values[k] = uniform(-1, 1) * exp2(uniform(-30, 30));
        }
        check_one(values, false);
    }
}

/* What is no number stays none, and ends. */
static inline void not_a_number(void)
{
    unit_untrapped();
    struct tensor T = turned(hostile[2], false);
    T.column[0][0] = NAN;
    struct spectrum of = spectrum(T);
    bool any = false;
    for (int k = 0; k < DIM; k++) {
        any = any || isnan(of.value[k]);
    }
    CU_ASSERT(any);
}

static inline int spectrum_main(const char *suite)
{
    static const struct unit_test tests[] = {
        {"hostile matrices", hostile_matrices},
        {"random matrices of sixty orders of size", random_matrices},
        {"what is no number", not_a_number},
    };
    return unit_main(suite, tests, sizeof tests / sizeof *tests);
}

#endif
