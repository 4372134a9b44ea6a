/* A padded vector field of the particles, stored in double or in single precision: for what is not worth a loop for
 * each. */
#ifndef SOLVER_VECTORS_H
#define SOLVER_VECTORS_H

#include <stddef.h>

struct solver_vectors {
    double *wide;  /* [count][lanes]; NULL where they are stored in */
    float *single; /* single precision; else NULL */
    size_t lanes;
};

static inline double solver_vectors_get(const struct solver_vectors *field, size_t a, size_t i)
{
    size_t at = a * field->lanes + i;
    return field->single != NULL ? (double)field->single[at] : field->wide[at];
}

static inline void solver_vectors_set(const struct solver_vectors *field, size_t a, size_t i, double value)
{
    size_t at = a * field->lanes + i;
    if (field->single != NULL) {
        field->single[at] = (float)value;
    } else {
        field->wide[at] = value;
    }
}

#endif
