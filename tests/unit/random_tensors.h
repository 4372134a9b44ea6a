/* What the tests of materials share: a fixed stream of random numbers, and dense tensors [dim][dim] row by row. */
#ifndef TESTS_RANDOM_TENSORS_H
#define TESTS_RANDOM_TENSORS_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Uniform in [low, high): SplitMix64, the same numbers on every machine. */
static inline double uniform(double low, double high)
{
    static uint64_t state = 20240607;
    uint64_t z = state += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    z ^= z >> 31;
    return low + (high - low) * ((double)(z >> 11) * 0x1p-53);
}

static inline void unit_tensor(size_t dim, double *T)
{
    for (size_t i = 0; i < dim * dim; i++) {
        T[i] = i / dim == i % dim ? 1.0 : 0.0;
    }
}

/* C = A B */
static inline void multiply(size_t dim, const double *A, const double *B, double *C)
{
    for (size_t i = 0; i < dim; i++) {
        for (size_t j = 0; j < dim; j++) {
            C[i * dim + j] = 0.0;
            for (size_t k = 0; k < dim; k++) {
                C[i * dim + j] += A[i * dim + k] * B[k * dim + j];
            }
        }
    }
}

/* A rotation: one turn in each coordinate plane. In 1D the identity. */
static inline void random_rotation(size_t dim, double *R)
{
    unit_tensor(dim, R);
    for (size_t i = 0; i < dim; i++) {
        for (size_t j = i + 1; j < dim; j++) {
            double angle = uniform(0.0, 6.283185307179586);
            double turn[9];
            double product[9];
            unit_tensor(dim, turn);
            turn[i * dim + i] = turn[j * dim + j] = cos(angle);
            turn[j * dim + i] = sin(angle);
            turn[i * dim + j] = -sin(angle);
            multiply(dim, R, turn, product);
            memcpy(R, product, dim * dim * sizeof *R);
        }
    }
}

static inline void random_direction(size_t dim, double *N)
{
    double length = 0.0;
    while (!(length > 0.1 && length <= 1.0)) {
        length = 0.0;
        for (size_t i = 0; i < dim; i++) {
            N[i] = uniform(-1.0, 1.0);
            length += N[i] * N[i];
        }
        length = sqrt(length);
    }
    for (size_t i = 0; i < dim; i++) {
        N[i] /= length;
    }
}

/* R diag(stretches) Q with stretches from 1/2 to 2, so that det F > 0. */
static inline void random_deformation(size_t dim, double *F)
{
    double R[9];
    double Q[9];
    random_rotation(dim, R);
    random_rotation(dim, Q);
    for (size_t j = 0; j < dim; j++) {
        double stretch = exp2(uniform(-1.0, 1.0));
        for (size_t i = 0; i < dim; i++) {
            R[i * dim + j] *= stretch;
        }
    }
    multiply(dim, R, Q, F);
}

/* By minors: H_iI = dJ/dF_iI. */
static inline void cofactor_of(size_t dim, const double *F, double *H)
{
    for (size_t i = 0; i < dim; i++) {
        for (size_t j = 0; j < dim; j++) {
            size_t i1 = (i + 1) % dim;
            size_t j1 = (j + 1) % dim;
            size_t i2 = (i + 2) % dim;
            size_t j2 = (j + 2) % dim;
            if (dim == 1) {
                H[0] = 1.0;
            } else if (dim == 2) {
                H[i * 2 + j] = i == j ? F[i1 * 2 + j1] : -F[i1 * 2 + j1];
            } else {
                H[i * 3 + j] = F[i1 * 3 + j1] * F[i2 * 3 + j2] - F[i1 * 3 + j2] * F[i2 * 3 + j1];
            }
        }
    }
}

static inline double determinant_of(size_t dim, const double *F)
{
    double H[9];
    double J = 0.0;
    cofactor_of(dim, F, H);
    for (size_t j = 0; j < dim; j++) {
        J += F[j] * H[j];
    }
    return J;
}

/* Cofactor and Jacobian of F, or their linearisation about F = I. */
static inline void measures_of(bool linear, size_t dim, const double *F, double *H, double *J)
{
    if (!linear) {
        cofactor_of(dim, F, H);
        *J = determinant_of(dim, F);
        return;
    }
    *J = 1.0;
    for (size_t i = 0; i < dim; i++) {
        *J += F[i * dim + i] - 1.0;
    }
    for (size_t i = 0; i < dim * dim; i++) {
        size_t transposed = i % dim * dim + i / dim;
        H[i] = i == transposed ? *J - (F[i] - 1.0) : -F[transposed];
    }
}

static inline double largest_entry(size_t count, const double *values)
{
    double largest = 0.0;
    for (size_t i = 0; i < count; i++) {
        largest = fmax(largest, fabs(values[i]));
    }
    return largest;
}

/* Keeps the larger of two, and a NaN, which fmax would lose. */
static inline void keep_larger(double *largest, double next)
{
    *largest = isnan(*largest) || *largest >= next ? *largest : next;
}

/* Largest difference; NaN if any entry is. */
static inline double largest_difference(size_t count, const double *left, const double *right)
{
    double largest = 0.0;
    for (size_t i = 0; i < count; i++) {
        double d = fabs(left[i] - right[i]);
        if (isnan(d)) {
            return d;
        }
        largest = fmax(largest, d);
    }
    return largest;
}

#endif
