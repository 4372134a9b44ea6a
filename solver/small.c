#include "solver/small.h"

#include <math.h>
#include <string.h>

/* A column that elimination brings below this part of its size is a combination of those before it: what is left is
 * round-off. */
static const double singular = 1e-12;

static void exchange(double *left, double *right)
{
    double kept = *left;
    *left = *right;
    *right = kept;
}

bool solver_small_solve(size_t size, double A[4][4], double r[4])
{
    double largest[4] = {0};
    for (size_t row = 0; row < size; row++) {
        for (size_t column = 0; column < size; column++) {
            largest[column] = fmax(largest[column], fabs(A[row][column]));
        }
    }
    for (size_t i = 0; i < size; i++) {
        size_t pivot = i;
        for (size_t row = i + 1; row < size; row++) {
            pivot = fabs(A[row][i]) > fabs(A[pivot][i]) ? row : pivot;
        }
        if (!(fabs(A[pivot][i]) > singular * largest[i])) { /* a NaN too */
            return false;
        }
        for (size_t column = 0; column < size; column++) {
            exchange(&A[i][column], &A[pivot][column]);
        }
        exchange(&r[i], &r[pivot]);
        for (size_t row = 0; row < size; row++) {
            double factor = row == i ? 0.0 : A[row][i] / A[i][i];
            for (size_t column = 0; column < size; column++) {
                A[row][column] -= factor * A[i][column];
            }
            r[row] -= factor * r[i];
        }
    }
    for (size_t i = 0; i < size; i++) {
        r[i] /= A[i][i];
    }
    return true;
}

bool solver_small_invert(size_t size, double A[4][4])
{
    double inverse[4][4];
    for (size_t column = 0; column < size; column++) {
        double work[4][4];
        double unit[4] = {0};
        memcpy(work, A, sizeof work);
        unit[column] = 1.0;
        if (!solver_small_solve(size, work, unit)) {
            return false;
        }
        for (size_t row = 0; row < size; row++) {
            inverse[row][column] = unit[row];
        }
    }
    for (size_t row = 0; row < size; row++) {
        memcpy(A[row], inverse[row], size * sizeof(double));
    }
    return true;
}
