/* Spectral parts of symmetric tensors, per dimension (dim.h). */
#ifndef SOLVER_DIM_SPECTRAL_H
#define SOLVER_DIM_SPECTRAL_H

#include "solver/dim.h"

#include <math.h>

#if DIM == 3
/* One rotation of Jacobi's method in the plane of axes i and j: A <- R^T A R, Q <- Q R. */
static inline void rotate(double A[3][3], double Q[3][3], int i, int j)
{
    if (A[i][j] == 0.0) {
        return;
    }
    double theta = 0.5 * (A[j][j] - A[i][i]) / A[i][j];
    double t = copysign(1.0, theta) / (fabs(theta) + hypot(theta, 1.0));
    double c = 1.0 / sqrt(t * t + 1.0);
    double s = t * c;
    for (int k = 0; k < 3; k++) {
        double left = A[k][i];
        double right = A[k][j];
        A[k][i] = c * left - s * right;
        A[k][j] = s * left + c * right;
    }
    for (int k = 0; k < 3; k++) {
        double left = A[i][k];
        double right = A[j][k];
        A[i][k] = c * left - s * right;
        A[j][k] = s * left + c * right;
        left = Q[k][i];
        right = Q[k][j];
        Q[k][i] = c * left - s * right;
        Q[k][j] = s * left + c * right;
    }
}

/* sum max(lambda, 0) n (x) n over the principal directions of a symmetric tensor. */
static inline struct tensor positive_part(struct tensor T)
{
    double A[3][3];
    double Q[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            A[i][j] = T.column[j][i];
        }
    }
    for (int sweep = 0; sweep < 6; sweep++) { /* converges quadratically: five reach round-off */
        rotate(A, Q, 0, 1);
        rotate(A, Q, 0, 2);
        rotate(A, Q, 1, 2);
    }
    struct tensor positive = {{{0}}};
    for (int k = 0; k < 3; k++) {
        double lambda = fmax(A[k][k], 0.0);
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) {
                positive.column[j][i] += lambda * Q[i][k] * Q[j][k];
            }
        }
    }
    return positive;
}

#elif DIM == 2
static inline struct tensor positive_part(struct tensor T)
{
    double mean = 0.5 * (T.column[0][0] + T.column[1][1]);
    double radius = hypot(0.5 * (T.column[0][0] - T.column[1][1]), T.column[0][1]);
    double high = mean + radius;
    double low = mean - radius;
    if (low >= 0.0) {
        return T;
    }
    double scale = high > 0.0 ? high / (high - low) : 0.0; /* n (x) n = (T - low I) / (high - low) */
    for (int I = 0; I < DIM; I++) {
        T.column[I][I] -= low;
        T.column[I] *= scale;
    }
    return T;
}

#else
static inline struct tensor positive_part(struct tensor T)
{
    T.column[0][0] = fmax(T.column[0][0], 0.0);
    return T;
}
#endif

#endif
