/* Spectral parts of symmetric tensors, per dimension (dim.h) and a lot at a time (dim_lots.h). */
#ifndef SOLVER_DIM_SPECTRAL_H
#define SOLVER_DIM_SPECTRAL_H

#include "solver/dim_bits.h"

#include <math.h>
#include <stdbool.h>

/* Principal values of symmetric tensors, in no order, and their principal directions, orthonormal. */
struct spectra {
    lot value[DIM];
    lot direction[DIM][DIM];
};

/* One rotation of Jacobi's method in the plane of axes i < j, of what is above the diagonal: A <- R^T A R, Q <- Q R,
 * but not where all is `done`, nor where the angle would change no digit and its tangent might overflow. */
static inline __attribute__((always_inline)) void rotate(lot A[DIM][DIM], lot Q[DIM][DIM], int i, int j, lot_mask done)
{
    lot none = {0};
    lot apart = A[j][j] - A[i][i];
    lot_mask still = done | (magnitude(A[i][j]) <= 0x1p-400 * magnitude(apart));
    lot theta = select_lot(still, none, 0.5 * apart) / select_lot(still, lot_of(1.0), A[i][j]);
    lot t = 1.0 / (magnitude(theta) + sqrt_lot(theta * theta + 1.0));
    t = select_lot(still, none, select_lot(theta < 0.0, -t, t));
    lot c = 1.0 / sqrt_lot(t * t + 1.0);
    lot s = t * c;
    lot change = t * A[i][j];
    A[i][i] -= change;
    A[j][j] += change;
    A[i][j] = none;
    for (int k = 0; k < DIM; k++) {
        if (k != i && k != j) {
            lot *with_i = k < i ? &A[k][i] : &A[i][k];
            lot *with_j = k < j ? &A[k][j] : &A[j][k];
            lot left = *with_i;
            lot right = *with_j;
            *with_i = c * left - s * right;
            *with_j = s * left + c * right;
        }
        lot left = Q[k][i];
        lot right = Q[k][j];
        Q[k][i] = c * left - s * right;
        Q[k][j] = s * left + c * right;
    }
}

/* Whether what is left beside the diagonal is nothing to it. */
static inline __attribute__((always_inline)) lot_mask are_diagonal(lot A[DIM][DIM])
{
    lot diagonal = magnitude(A[0][0]);
    lot beside = {0};
    for (int i = 1; i < DIM; i++) {
        diagonal += magnitude(A[i][i]);
        for (int j = 0; j < i; j++) {
            beside += magnitude(A[j][i]);
        }
    }
    return beside <= 0x1p-61 * diagonal;
}

/* By Jacobi's method, which knows no special case of repeated or nearly repeated values: directions are orthonormal,
 * and values exact, to round-off of the largest value. Only what is above the diagonal is read. */
static inline struct spectra spectra(const struct tensors *T)
{
    lot A[DIM][DIM];
    lot Q[DIM][DIM];
    for (int i = 0; i < DIM; i++) {
        for (int j = 0; j < DIM; j++) {
            A[i][j] = T->column[j][i];
            Q[i][j] = lot_of(i == j ? 1.0 : 0.0);
        }
    }
    for (int sweep = 0; sweep < 6; sweep++) { /* converges quadratically: five reach round-off, in the plane one */
        lot_mask done = are_diagonal(A);
        if (all_lot(done)) {
            break;
        }
        for (int i = 0; i < DIM; i++) {
            for (int j = i + 1; j < DIM; j++) {
                rotate(A, Q, i, j, done);
            }
        }
    }
    struct spectra of;
    for (int k = 0; k < DIM; k++) {
        of.value[k] = A[k][k];
        for (int i = 0; i < DIM; i++) {
            of.direction[k][i] = Q[i][k];
        }
    }
    return of;
}

/* Of one tensor. */
struct spectrum {
    double value[DIM];
    vec direction[DIM];
};

static inline struct spectrum spectrum(struct tensor T)
{
    struct tensors same = tensors_of(T);
    struct spectra all = spectra(&same);
    struct spectrum of = {.value = {0}};
    for (int k = 0; k < DIM; k++) {
        of.value[k] = all.value[k][0];
        of.direction[k] = (vec){0};
        for (int i = 0; i < DIM; i++) {
            of.direction[k][i] = all.direction[k][i][0];
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

/* Operations (cost.h) for one of a lot's tensors: a rotation; as many sweeps as strains usually take. */
enum {
    FLOPS_ROTATE = 17 + 6 * (2 * DIM - 2),
    FLOPS_SWEEPS = DIM == 3 ? 4 : DIM - 1,
    FLOPS_SPECTRUM =
        FLOPS_SWEEPS * (DIM * (DIM - 1) / 2) * FLOPS_ROTATE + (FLOPS_SWEEPS + 1) * (DIM + DIM * (DIM - 1) / 2),
    FLOPS_SPECTRUM_ALONE = LOT * FLOPS_SPECTRUM /* in every lane */
};

#endif
