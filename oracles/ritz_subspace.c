#include "oracles/ritz_system.h"

#include <gsl/gsl_eigen.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Vectors iterated beside the wanted one: each step shrinks what is foreign to it by the ratio of squared frequencies
 * to the first mode that is left out. */
enum { GUARD = 3, STEPS = 60 };
static const double STANDS =
    1e-9; /* largest change of a step, relative to the largest entry; the next would be far smaller */

static bool allocate_subspace(const struct ritz_system *s, size_t wanted, struct ritz_subspace *space)
{
    *space = (struct ritz_subspace){.count = wanted + 1 + GUARD};
    space->vector = calloc(space->count, s->unknowns * sizeof(double));
    space->massed = calloc(space->count, s->unknowns * sizeof(double));
    space->next = calloc(space->count, s->unknowns * sizeof(double));
    space->next_massed = calloc(space->count, s->unknowns * sizeof(double));
    space->square = calloc(space->count, sizeof(double));
    return space->vector != NULL && space->massed != NULL && space->next != NULL && space->next_massed != NULL &&
           space->square != NULL;
}

/* Any start will do that is orthogonal to no mode: a fixed sequence without pattern. */
static void start(const struct ritz_system *s, struct ritz_subspace *space)
{
    for (size_t i = 0; i < space->count * s->unknowns; i++) {
        size_t row = i / s->unknowns;
        double x = 0.6180339887498949 * (double)(i + 1) * (double)(row + 1);
        space->vector[i] = x - floor(x) - 0.5;
    }
    for (size_t k = 0; k < space->count; k++) {
        ritz_system_mass(s, space->vector + k * s->unknowns, space->massed + k * s->unknowns);
    }
}

static double product(const double *a, const double *b, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

/* to = sum_k weight[k][column] from_k for every column. */
static void combine(const struct ritz_subspace *space, const gsl_matrix *weight, const double *from, size_t n,
                    double *to)
{
    memset(to, 0, space->count * n * sizeof *to);
    for (size_t column = 0; column < space->count; column++) {
        for (size_t k = 0; k < space->count; k++) {
            double w = gsl_matrix_get(weight, k, column);
            for (size_t i = 0; i < n; i++) {
                to[column * n + i] += w * from[k * n + i];
            }
        }
    }
}

/* Rayleigh-Ritz in the span of `next`: A next = M vector, so no product with A is needed. */
static bool project(struct ritz_subspace *space, size_t n, gsl_eigen_gensymmv_workspace *work, gsl_matrix *A,
                    gsl_matrix *M, gsl_matrix *weight)
{
    for (size_t i = 0; i < space->count; i++) {
        for (size_t j = 0; j <= i; j++) {
            gsl_matrix_set(A, i, j, product(space->next + i * n, space->massed + j * n, n));
            gsl_matrix_set(M, i, j, product(space->next + i * n, space->next_massed + j * n, n));
        }
    }
    gsl_vector_view square = gsl_vector_view_array(space->square, space->count);
    return gsl_eigen_gensymmv(A, M, &square.vector, weight, work) == GSL_SUCCESS &&
           gsl_eigen_gensymmv_sort(&square.vector, weight, GSL_EIGEN_SORT_VAL_ASC) == GSL_SUCCESS;
}

static void normalise(struct ritz_subspace *space, size_t n)
{
    for (size_t k = 0; k < space->count; k++) {
        double scale = 1 / sqrt(product(space->vector + k * n, space->massed + k * n, n));
        for (size_t i = 0; i < n; i++) {
            space->vector[k * n + i] *= scale;
            space->massed[k * n + i] *= scale;
        }
    }
}

/* Largest change of the wanted vector, relative to its largest entry; both have mass 1, but a sign of their own. */
static double change(const double *before, const double *after, size_t n)
{
    double same = 0, opposite = 0, size = 0;
    for (size_t i = 0; i < n; i++) {
        same = fmax(same, fabs(after[i] - before[i]));
        opposite = fmax(opposite, fabs(after[i] + before[i]));
        size = fmax(size, fabs(after[i]));
    }
    return fmin(same, opposite) / size;
}

static bool iterate(const struct ritz_system *s, struct ritz_subspace *space, size_t wanted)
{
    size_t q = space->count, n = s->unknowns;
    gsl_matrix *A = gsl_matrix_alloc(q, q), *M = gsl_matrix_alloc(q, q), *weight = gsl_matrix_alloc(q, q);
    gsl_eigen_gensymmv_workspace *work = gsl_eigen_gensymmv_alloc(q);
    bool going = A != NULL && M != NULL && weight != NULL && work != NULL, done = false;
    start(s, space);
    for (int step = 0; going && !done && step < STEPS; step++) {
        memcpy(space->next, space->massed, q * n * sizeof(double));
        for (size_t k = 0; k < q; k++) {
            skyline_solve(&s->stiffness, space->next + k * n);
            ritz_system_mass(s, space->next + k * n, space->next_massed + k * n);
        }
        going = project(space, n, work, A, M, weight);
        if (going) {
            combine(space, weight, space->next_massed, n, space->massed);
            memcpy(space->next_massed, space->vector + wanted * n, n * sizeof(double));
            combine(space, weight, space->next, n, space->vector);
            normalise(space, n);
            double moved = change(space->next_massed, space->vector + wanted * n, n);
            done = moved < STANDS;
        }
    }
    gsl_eigen_gensymmv_free(work);
    gsl_matrix_free(A);
    gsl_matrix_free(M);
    gsl_matrix_free(weight);
    return done;
}

bool ritz_subspace_find(const struct ritz_system *system, size_t wanted, struct ritz_subspace *space)
{
    return allocate_subspace(system, wanted, space) && iterate(system, space, wanted);
}

void ritz_subspace_free(struct ritz_subspace *space)
{
    free(space->vector);
    free(space->massed);
    free(space->next);
    free(space->next_massed);
    free(space->square);
}
