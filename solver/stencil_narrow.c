/* Pair vectors in single precision. */
#include "solver/memory.h"
#include "solver/stencil.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool solver_stencil_narrow(struct solver_stencil *stencil, struct solver_error *error)
{
    size_t dim = (size_t)stencil->dim;
    if (stencil->transposed != NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "stencil: precision = \"mixed\" is for antisymmetric pair vectors; expected closed, sbp2 or "
                           "sbp4");
    }
    if (!solver_alloc((void **)&stencil->narrow, stencil->records * (dim + 1), sizeof(float), "narrow pair vectors",
                      error)) {
        return false;
    }
    stencil->unit = pow(stencil->spacing, (double)dim - 1.0) / 12.0; /* the denominator of sbp4 */
    memset(stencil->row_sum, 0, stencil->count * dim * sizeof *stencil->row_sum);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < stencil->records * (dim + 1); i++) {
        stencil->narrow[i] = (float)(stencil->pair[i] / stencil->unit);
        stencil->pair[i] = (double)stencil->narrow[i] * stencil->unit;
    }
#pragma omp parallel for schedule(static)
    for (size_t a = 0; a < stencil->count; a++) {
        size_t shift = solver_stencil_shift(stencil, a);
        for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
            for (size_t i = 0; i < dim; i++) {
                stencil->row_sum[a * dim + i] += (double)stencil->narrow[(ab + shift) * (dim + 1) + i];
            }
        }
    }
    return true;
}

void solver_stencil_narrow_only(struct solver_stencil *stencil)
{
    if (stencil->narrow != NULL) {
        free(stencil->pair);
        stencil->pair = NULL;
    }
}
