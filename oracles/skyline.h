/* Symmetric positive definite systems whose rows begin late: row i of the lower triangle is stored from its first
 * entry that is not zero up to the diagonal. The factor of Cholesky fills no more than that, and every inner loop is a
 * scalar product of two stretches of memory. */
#ifndef ORACLES_SKYLINE_H
#define ORACLES_SKYLINE_H

#include <stdbool.h>
#include <stddef.h>

struct skyline {
    size_t rows;
    size_t *first; /* [rows] column of each row's first entry */
    size_t *start; /* [rows + 1] where it is in `entry` */
    double *entry;
};

/* Zero entries; takes a copy of `first`. False if there is no memory; then `skyline` holds nothing. */
bool skyline_create(struct skyline *skyline, size_t rows, const size_t *first);
void skyline_free(struct skyline *skyline);

/* Adds to entry (row, column), in either triangle; it must be within its row's stretch. */
void skyline_add(struct skyline *skyline, size_t row, size_t column, double value);
/* Replaces the matrix by its factor L, A = L L^T. False if it is not positive definite. */
bool skyline_factorise(struct skyline *skyline);
/* Replaces b [rows] by the solution of L L^T x = b. */
void skyline_solve(const struct skyline *factor, double *b);

#endif
