/* One source text, compiled for DIM = 1, 2 and 3: names and padded vector types.
 *
 * Layout in memory: a vector field is [count][LANES], a tensor field [count][DIM][LANES], column by column
 * (T[a][I] = T e_I), lanes beyond DIM are zero. A vector is then one load, P C = sum_I P[I] C_I is DIM multiply-adds,
 * and what a pair needs of its neighbour is contiguous. */
#ifndef SOLVER_DIM_H
#define SOLVER_DIM_H

#include <stddef.h>

#ifdef __AVX__
#include <immintrin.h>
#endif

#define SOLVER_DIM_PASTE(name, dim, path)  name##_##dim##d_##path
#define SOLVER_DIM_EXPAND(name, dim, path) SOLVER_DIM_PASTE(name, dim, path)
/* DIM_NAME(f) is f_3d_avx2 for the dimension and path (path.h) that are compiled. */
#define DIM_NAME(name) SOLVER_DIM_EXPAND(name, DIM, PATH)

/* Fields are numbers of double precision, or of single, and so is what is computed with them. */
#ifdef SINGLE
enum { IN_SINGLE = 1 };
typedef float real;
#else
enum { IN_SINGLE = 0 };
typedef double real;
#endif

#if DIM == 3
enum { LANES = 4 };
#elif DIM == 2
enum { LANES = 2 };
#elif DIM == 1
enum { LANES = 1 };
#else
#error "DIM must be 1, 2 or 3"
#endif
typedef real vec __attribute__((vector_size(LANES * sizeof(real))));

static inline vec load(const real *from)
{
    return *(const vec *)from;
}

static inline void store(real *to, vec value)
{
    *(vec *)to = value;
}

/* LANES numbers of single precision, anywhere. GCC 12 makes __builtin_convertvector of four two conversions of two. */
static inline vec load_floats(const float *from)
{
    typedef float floats __attribute__((vector_size(LANES * sizeof(float)), aligned(sizeof(float))));
#if defined SINGLE
    return *(const floats *)from;
#elif DIM == 3 && defined __AVX__
    return _mm256_cvtps_pd(*(const floats *)from);
#else
    return __builtin_convertvector(*(const floats *)from, vec);
#endif
}

static inline void store_floats(float *to, vec value)
{
    typedef float floats __attribute__((vector_size(LANES * sizeof(float)), aligned(sizeof(float))));
#if defined SINGLE
    *(floats *)to = value;
#elif DIM == 3 && defined __AVX__
    *(floats *)to = _mm256_cvtpd_ps(value);
#else
    *(floats *)to = __builtin_convertvector(value, floats);
#endif
}

static inline real sum_of(vec a)
{
    real sum = a[0];
    for (int i = 1; i < DIM; i++) {
        sum += a[i];
    }
    return sum;
}

static inline real dot(vec a, vec b)
{
    return sum_of(a * b);
}

static inline vec splat(real a)
{
#if DIM == 3
    return (vec){a, a, a, a};
#elif DIM == 2
    return (vec){a, a};
#else
    return (vec){a};
#endif
}

/* A tensor by columns. */
struct tensor {
    vec column[DIM];
};

static inline struct tensor load_tensor(const real *from)
{
    struct tensor T;
    for (int I = 0; I < DIM; I++) {
        T.column[I] = load(from + I * LANES);
    }
    return T;
}

static inline void store_tensor(real *to, struct tensor T)
{
    for (int I = 0; I < DIM; I++) {
        store(to + I * LANES, T.column[I]);
    }
}

static inline struct tensor identity(void)
{
    struct tensor T = {{{0}}};
    for (int I = 0; I < DIM; I++) {
        T.column[I][I] = 1.0;
    }
    return T;
}

/* F and H, which lack the identity in single precision. */
static inline struct tensor load_measure(const real *from)
{
    struct tensor T = load_tensor(from);
#ifdef SINGLE
    struct tensor one = identity();
    for (int I = 0; I < DIM; I++) {
        T.column[I] += one.column[I];
    }
#endif
    return T;
}

static inline real trace(struct tensor A)
{
    real sum = A.column[0][0];
    for (int I = 1; I < DIM; I++) {
        sum += A.column[I][I];
    }
    return sum;
}

/* A : B */
static inline real contract(struct tensor A, struct tensor B)
{
    vec sum = A.column[0] * B.column[0];
    for (int I = 1; I < DIM; I++) {
        sum += A.column[I] * B.column[I];
    }
    real total = sum[0];
    for (int i = 1; i < DIM; i++) {
        total += sum[i];
    }
    return total;
}

static inline struct tensor transpose(struct tensor A)
{
    struct tensor T = {{{0}}};
    for (int I = 0; I < DIM; I++) {
        for (int i = 0; i < DIM; i++) {
            T.column[i][I] = A.column[I][i];
        }
    }
    return T;
}

#if DIM == 3
/* Its third component stands first until the last shuffle: that is one shuffle fewer. */
static inline vec cross(vec a, vec b)
{
    vec turned = a * __builtin_shufflevector(b, b, 1, 2, 0, 3) - __builtin_shufflevector(a, a, 1, 2, 0, 3) * b;
    return __builtin_shufflevector(turned, turned, 1, 2, 0, 3);
}
#endif

/* The derivative of the in-plane cofactor: A x B of 000_e9ec29e1bde7947d.txt (section 2) in 3D, so that cof F =
 * 1/2 F x F; below 3D the cofactor is linear in F (2D) or constant (1D) and A does not enter. */
static inline struct tensor tensor_cross(struct tensor A, struct tensor B)
{
#if DIM == 3
    struct tensor T = {{cross(A.column[1], B.column[2]) + cross(B.column[1], A.column[2]),
                        cross(A.column[2], B.column[0]) + cross(B.column[2], A.column[0]),
                        cross(A.column[0], B.column[1]) + cross(B.column[0], A.column[1])}};
#elif DIM == 2
    (void)A;
    struct tensor T = {{{B.column[1][1], -B.column[1][0]}, {-B.column[0][1], B.column[0][0]}}};
#else
    (void)A;
    (void)B;
    struct tensor T = {{{0.0}}};
#endif
    return T;
}

static inline struct tensor cofactor(struct tensor F)
{
#if DIM == 3
    struct tensor H = {
        {cross(F.column[1], F.column[2]), cross(F.column[2], F.column[0]), cross(F.column[0], F.column[1])}};
    return H;
#elif DIM == 2
    return tensor_cross(F, F);
#else
    (void)F;
    return identity();
#endif
}

static inline real determinant(struct tensor F)
{
#if DIM == 3
    return dot(F.column[0], cross(F.column[1], F.column[2]));
#elif DIM == 2
    return F.column[0][0] * F.column[1][1] - F.column[1][0] * F.column[0][1];
#else
    return F.column[0][0];
#endif
}

/* Row-major [DIM][DIM] of plain numbers to columns and back. */
static inline struct tensor from_rows(const double *rows)
{
    struct tensor T = {{{0}}};
    for (int i = 0; i < DIM; i++) {
        for (int I = 0; I < DIM; I++) {
            T.column[I][i] = (real)rows[i * DIM + I];
        }
    }
    return T;
}

static inline void to_rows(struct tensor T, double *rows)
{
    for (int i = 0; i < DIM; i++) {
        for (int I = 0; I < DIM; I++) {
            rows[i * DIM + I] = T.column[I][i];
        }
    }
}

#endif
