/* Tensor fields as the loops have them (solver/dim.h), of materials in any dimension. */
#ifndef TESTS_PADDED_H
#define TESTS_PADDED_H

#include "tests/unit/materials.h"

#include <stdlib.h>

/* A padded tensor field (solver/dim.h) from row-major tensors and back. */
static inline size_t lanes_of(size_t dim)
{
    return dim == 3 ? 4 : dim;
}

static inline double *padded_field(size_t dim, size_t count)
{
    double *field = aligned_alloc(64, (count * dim * lanes_of(dim) * sizeof(double) + 63) / 64 * 64);
    CU_ASSERT_PTR_NOT_NULL_FATAL(field);
    memset(field, 0, count * dim * lanes_of(dim) * sizeof(double));
    return field;
}

static inline double *entry(size_t dim, double *field, size_t a, size_t i, size_t I)
{
    return field + (a * dim + I) * lanes_of(dim) + i;
}

static inline void pad(size_t dim, const double *rows, size_t a, double *field)
{
    for (size_t k = 0; k < dim * dim; k++) {
        *entry(dim, field, a, k / dim, k % dim) = rows[k];
    }
}

#endif
