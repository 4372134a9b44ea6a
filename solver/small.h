/* Dense linear algebra of dimension at most 4, for set-up code. */
#ifndef SOLVER_SMALL_H
#define SOLVER_SMALL_H

#include <stdbool.h>
#include <stddef.h>

/* Solves A x = r in place (r becomes x) by Gauss-Jordan elimination with row exchange; A is [size][size] with row
 * length 4 and is destroyed. False if A is singular to round-off. */
bool solver_small_solve(size_t size, double A[4][4], double r[4]);
/* A <- A^-1, [size][size] with row length 4. False if A is singular to round-off. */
bool solver_small_invert(size_t size, double A[4][4]);

#endif
