/* Jets: a number with its first and second derivatives by X, Y, Z and t, so that a formula written once is its own
 * exact derivatives (forward automatic differentiation). Smooth functions only. */
#ifndef ORACLES_JET_H
#define ORACLES_JET_H

#include <math.h>

enum { JET_VARIABLES = 4, JET_SECOND = 10 }; /* X, Y, Z, t; entries of a symmetric 4 x 4 matrix */

struct jet {
    double value;
    double first[JET_VARIABLES];
    double second[JET_SECOND]; /* upper triangle, row by row: see jet_second */
};

/* d2/dx_i dx_j */
static inline int jet_index(int i, int j)
{
    int low = i < j ? i : j;
    int high = i < j ? j : i;
    return low * (2 * JET_VARIABLES - low - 1) / 2 + high;
}

static inline double jet_second(struct jet a, int i, int j)
{
    return a.second[jet_index(i, j)];
}

static inline struct jet jet_constant(double value)
{
    return (struct jet){.value = value};
}

static inline struct jet jet_variable(double value, int which)
{
    struct jet a = {.value = value};
    a.first[which] = 1.0;
    return a;
}

/* s a + r b */
static inline struct jet jet_combine(double s, struct jet a, double r, struct jet b)
{
    struct jet sum = {.value = s * a.value + r * b.value};
    for (int i = 0; i < JET_VARIABLES; i++) {
        sum.first[i] = s * a.first[i] + r * b.first[i];
    }
    for (int i = 0; i < JET_SECOND; i++) {
        sum.second[i] = s * a.second[i] + r * b.second[i];
    }
    return sum;
}

static inline struct jet jet_add(struct jet a, struct jet b)
{
    return jet_combine(1.0, a, 1.0, b);
}

/* factor a + shift */
static inline struct jet jet_scale(double factor, struct jet a, double shift)
{
    return jet_combine(factor, a, 1.0, jet_constant(shift));
}

static inline struct jet jet_multiply(struct jet a, struct jet b)
{
    struct jet product = {.value = a.value * b.value};
    for (int i = 0; i < JET_VARIABLES; i++) {
        product.first[i] = a.first[i] * b.value + a.value * b.first[i];
        for (int j = i; j < JET_VARIABLES; j++) {
            int ij = jet_index(i, j);
            product.second[ij] =
                a.second[ij] * b.value + a.first[i] * b.first[j] + a.first[j] * b.first[i] + a.value * b.second[ij];
        }
    }
    return product;
}

/* f(a), given f and its first two derivatives there. */
static inline struct jet jet_chain(struct jet a, double f, double df, double ddf)
{
    struct jet result = {.value = f};
    for (int i = 0; i < JET_VARIABLES; i++) {
        result.first[i] = df * a.first[i];
        for (int j = i; j < JET_VARIABLES; j++) {
            int ij = jet_index(i, j);
            result.second[ij] = df * a.second[ij] + ddf * a.first[i] * a.first[j];
        }
    }
    return result;
}

static inline struct jet jet_sin(struct jet a)
{
    return jet_chain(a, sin(a.value), cos(a.value), -sin(a.value));
}

static inline struct jet jet_cos(struct jet a)
{
    return jet_chain(a, cos(a.value), -sin(a.value), -cos(a.value));
}

static inline struct jet jet_log(struct jet a)
{
    return jet_chain(a, log(a.value), 1.0 / a.value, -1.0 / (a.value * a.value));
}

static inline struct jet jet_reciprocal(struct jet a)
{
    double inverse = 1.0 / a.value;
    return jet_chain(a, inverse, -inverse * inverse, 2.0 * inverse * inverse * inverse);
}

static inline struct jet jet_exp(struct jet a)
{
    return jet_chain(a, exp(a.value), exp(a.value), exp(a.value));
}

#endif
