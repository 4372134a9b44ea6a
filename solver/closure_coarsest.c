/* The coarsest of the grids of closure.h, whose equation is solved by a dense factor. */
#include "solver/closure.h"
#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>

/* Of the matrix, whose diagonal is 1: what is added, and the energy that quadratics get. */
static const double shift = 1e-3, held = 1e4;

/* Takes from v what it has of the `made` orthonormal vectors before it, and scales it to one; false if it had little
 * else. */
static bool orthonormal(double *v, const double *vector, int made, size_t n)
{
    double kept = 0.0;
    double square = 0.0;
    for (int pass = 0; pass < 2; pass++) { /* twice: the first leaves round-off of what it takes */
        for (int before = 0; before < made; before++) {
            const double *u = vector + (size_t)before * n;
            double product = 0.0;
            for (size_t i = 0; i < n; i++) {
                product += u[i] * v[i];
            }
            for (size_t i = 0; i < n; i++) {
                v[i] -= product * u[i];
            }
        }
        square = 0.0;
        for (size_t i = 0; i < n; i++) {
            square += v[i] * v[i];
        }
        kept = pass == 0 ? square : kept;
    }
    bool anything = square > 0.25 * kept && square > 0.0;
    for (size_t i = 0; anything && i < n; i++) {
        v[i] /= sqrt(square);
    }
    return anything;
}

/* Adds the projector onto quadratic functions, which have no energy, to the matrix L, scaled as it is. Coefficients of
 * 1, x, x^2 are 1, xi, xi^2 - 1/4, xi a spline's centre in cells; those of products are products. */
static bool hold_quadratics(const struct solver_closure_grid *grid, double *L, struct solver_error *error)
{
    size_t n = grid->count;
    double *vector = NULL; /* [10][n], orthonormal */
    int made = 0;
    if (!solver_alloc((void **)&vector, 10 * n, sizeof(double), "coarsest splines", error)) {
        return false;
    }
    for (int degree = 0; degree < 27; degree++) {
        const int of_axis[3] = {degree % 3, degree / 3 % 3, degree / 9};
        bool beyond = (grid->dim < 2 && of_axis[1] > 0) || (grid->dim < 3 && of_axis[2] > 0);
        if (beyond || of_axis[0] + of_axis[1] + of_axis[2] > 2) {
            continue;
        }
        double *v = vector + (size_t)made * n;
        size_t middle = n / 2 * 3;
        for (size_t i = 0; i < n; i++) {
            v[i] = grid->diagonal[i] > 0.0 ? 1.0 / sqrt(grid->diagonal[i]) : 0.0;
            for (size_t axis = 0; axis < 3; axis++) { /* beyond dim, all places and degrees are 0 */
                int32_t from = grid->at[i * 3 + axis] - grid->at[middle + axis];
                double xi = from;
                v[i] *= of_axis[axis] == 0 ? 1.0 : of_axis[axis] == 1 ? xi : xi * xi - 0.25;
            }
        }
        made += orthonormal(v, vector, made, n);
    }
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) {
            for (int m = 0; m < made; m++) {
                L[i * n + j] += held * vector[(size_t)m * n + i] * vector[(size_t)m * n + j];
            }
        }
    }
    free(vector);
    return true;
}

/* The Cholesky factor of the matrix, scaled to a unit diagonal and shifted so that it has one. */
bool solver_closure_factorise(struct solver_closure_grid *grid, struct solver_error *error)
{
    size_t n = grid->count;
    if (!solver_alloc((void **)&grid->factor, n * n, sizeof(double), "coarsest splines", error)) {
        return false;
    }
    double *L = grid->factor;
    for (size_t i = 0; i < n; i++) {
        for (size_t at = grid->row[i] * SOLVER_CLOSURE_LINE; at < grid->row[i + 1] * SOLVER_CLOSURE_LINE; at++) {
            if (grid->value[at] != 0.0) {
                size_t j = grid->column[at / SOLVER_CLOSURE_LINE] + at % SOLVER_CLOSURE_LINE;
                L[i * n + j] = grid->value[at] * sqrt(grid->diagonal[i] * grid->diagonal[j]);
            }
        }
        L[i * n + i] = 1.0 + shift;
    }
    if (!hold_quadratics(grid, L, error)) {
        return false;
    }
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j <= i; j++) {
            double sum = L[i * n + j];
            for (size_t k = 0; k < j; k++) {
                sum -= L[i * n + k] * L[j * n + k];
            }
            L[i * n + j] = i == j ? sqrt(fmax(sum, shift)) : sum / L[j * n + j];
        }
    }
    return true;
}
