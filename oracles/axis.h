/* Continuous piecewise polynomials along one axis, from which products span a space on a rectangle.
 *
 * Every element has its own degree. Its functions are the two linear ones that are 1 at one end and 0 at the other, and
 * bubbles (P_k - P_(k-2)) / sqrt(2 (2k - 1)), k = 2 ... degree: integrals of Legendre polynomials, whose derivatives
 * are orthonormal on [-1, 1]. So stiffness matrices stay well conditioned up to any degree, and functions couple only
 * where their orders differ by two at most; the two at the ends count as order 1. */
#ifndef ORACLES_AXIS_H
#define ORACLES_AXIS_H

#include <stdbool.h>
#include <stddef.h>

enum { AXIS_ELEMENTS = 48, AXIS_DEGREE = 16 };

struct axis {
    int elements;
    double node[AXIS_ELEMENTS + 1]; /* ends of the elements, increasing */
    int degree[AXIS_ELEMENTS];      /* 1 ... AXIS_DEGREE */
    int first[AXIS_ELEMENTS + 1];   /* function at each node; those between are the bubbles, order 2 and upwards */
    int functions;
    bool nested; /* node functions are hats that reach from the node before to the end of the axis, and at the ends
                    straight lines from end to end: what is smooth has small coefficients, where it is a difference of
                    large ones between nodes that lie close. Evaluation is by hats that reach from node to node. */
};

/* Sets `first` and `functions` from the degrees. */
void axis_number(struct axis *axis);

/* Of one function: its order, and the elements it lives in, from `begin` to below `end`. */
struct axis_function {
    int order, begin, end;
};
struct axis_function axis_function(const struct axis *axis, int function);
/* Whether products of the two or of their derivatives can have an integral other than zero. */
bool axis_coupled(const struct axis *axis, int a, int b);

/* Values and derivatives at x of the functions first[element] ... first[element + 1]. */
void axis_evaluate(const struct axis *axis, int element, double x, double value[AXIS_DEGREE + 1],
                   double slope[AXIS_DEGREE + 1]);
/* The element that holds x; the first or last for x beyond the ends. */
int axis_element(const struct axis *axis, double x);

/* Turns coefficients [functions] of a nested axis into those that go with axis_evaluate. */
void axis_unnest(const struct axis *axis, double *coefficient);

/* Integrals of f_a f_b, f_a' f_b' and f_a f_b', each [functions][functions] and exact but for round-off. */
struct axis_matrices {
    double *mass, *stiffness, *mixed;
};
/* False if there is no memory. */
bool axis_integrate(const struct axis *axis, struct axis_matrices *matrices);
void axis_free(struct axis_matrices *matrices);

#endif
