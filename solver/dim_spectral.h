/* Spectral parts of symmetric tensors, per dimension (dim.h). */
#ifndef SOLVER_DIM_SPECTRAL_H
#define SOLVER_DIM_SPECTRAL_H

#include "solver/dim.h"

#include <math.h>
#include <stdbool.h>

/* Principal values of a symmetric tensor, in no order, and its principal directions, orthonormal. */
struct spectrum {
    double value[DIM];
    vec direction[DIM];
};

/* One rotation of Jacobi's method in the plane of axes i and j: A <- R^T A R, Q <- Q R. */
static inline void rotate(double A[DIM][DIM], double Q[DIM][DIM], int i, int j)
{
    double apart = A[j][j] - A[i][i];
    if (fabs(A[i][j]) <= 0x1p-400 * fabs(apart)) { /* the angle would change no digit, and theta might overflow */
        A[i][j] = A[j][i] = 0.0;
        return;
    }
    double theta = 0.5 * apart / A[i][j];
    double t = copysign(1.0, theta) / (fabs(theta) + hypot(theta, 1.0));
    double c = 1.0 / sqrt(t * t + 1.0);
    double s = t * c;
    for (int k = 0; k < DIM; k++) {
        double left = A[k][i];
        double right = A[k][j];
        A[k][i] = c * left - s * right;
        A[k][j] = s * left + c * right;
    }
    for (int k = 0; k < DIM; k++) {
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

/* Whether what is left beside the diagonal is nothing to it. */
static inline bool is_diagonal(double A[DIM][DIM])
{
    double diagonal = 0.0;
    double beside = 0.0;
    for (int i = 0; i < DIM; i++) {
        diagonal += fabs(A[i][i]);
        for (int j = 0; j < i; j++) {
            beside += fabs(A[i][j]) + fabs(A[j][i]);
        }
    }
    return beside <= 0x1p-60 * diagonal;
}

/* By Jacobi's method, which knows no special case of repeated or nearly repeated values: directions are orthonormal,
 * and values exact, to round-off of the largest value. */
static inline struct spectrum spectrum(struct tensor T)
{
    double A[DIM][DIM];
    double Q[DIM][DIM] = {{0}};
    for (int i = 0; i < DIM; i++) {
        Q[i][i] = 1.0;
        for (int j = 0; j < DIM; j++) {
            A[i][j] = T.column[j][i];
        }
    }
    for (int sweep = 0; sweep < 6 && !is_diagonal(A); sweep++) { /* converges quadratically: five reach round-off */
        for (int i = 0; i < DIM; i++) {
            for (int j = i + 1; j < DIM; j++) {
                rotate(A, Q, i, j);
            }
        }
    }
    struct spectrum of = {.value = {0}};
    for (int k = 0; k < DIM; k++) {
        of.value[k] = A[k][k];
        of.direction[k] = (vec){0};
        for (int i = 0; i < DIM; i++) {
            of.direction[k][i] = Q[i][k];
        }
    }
    return of;
}

#if DIM == 3
/* sum max(lambda, 0) n (x) n over the principal directions of a symmetric tensor. */
static inline struct tensor positive_part(struct tensor T)
{
    struct spectrum of = spectrum(T);
    struct tensor positive = {{{0}}};
    for (int k = 0; k < DIM; k++) {
        for (int J = 0; J < DIM; J++) {
            positive.column[J] += (fmax(of.value[k], 0.0) * of.direction[k][J]) * of.direction[k];
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
