/* Stencils whose pairs all lie along reference axes, as those of lattices: rows are sorted by axis, so that loops over
 * pairs know which component of a pair vector there is. */
#include "solver/memory.h"
#include "solver/stencil.h"

#include <stdlib.h>
#include <string.h>

/* The axis along which b lies from a, and C_ab as well: all else of either is exactly zero. `dim` if there is none. */
static size_t axis_of(const struct solver_stencil *stencil, const double *X, size_t a, size_t ab)
{
    size_t dim = (size_t)stencil->dim;
    const double *C = solver_stencil_C(stencil, ab);
    const double *X_b = X + stencil->graph.neighbour[ab] * dim;
    size_t axis = dim;
    size_t found = 0;
    for (size_t i = 0; i < dim; i++) {
        bool apart = X_b[i] != X[a * dim + i];
        if (apart) {
            axis = i;
            found++;
        } else if (C[i] != 0.0) {
            return dim;
        }
    }
    return found == 1 ? axis : dim;
}

/* Numbers of a row: dim, padded as vectors are (dim.h). */
static size_t lanes(const struct solver_stencil *stencil)
{
    return stencil->dim == 3 ? 4 : (size_t)stencil->dim;
}

/* How many pairs of each row lie along each axis; false if one lies along none, or there are too many for a byte. */
static bool count_along(const struct solver_stencil *stencil, const double *X, uint8_t *along)
{
    size_t dim = (size_t)stencil->dim;
    for (size_t a = 0; a < stencil->count; a++) {
        for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
            size_t axis = axis_of(stencil, X, a, ab);
            uint8_t *count = along + a * lanes(stencil) + axis;
            if (axis == dim || *count == UINT8_MAX) {
                return false;
            }
            ++*count;
        }
    }
    return true;
}

/* One pair of a row, while it is sorted. */
struct moved {
    uint32_t neighbour;
    double record[4];
};

/* Sorts the row of particle a by axis; along each, pairs stay in their order. */
static void sort_row(struct solver_stencil *stencil, const double *X, size_t a, struct moved *row)
{
    size_t dim = (size_t)stencil->dim;
    size_t bytes = (dim + 1) * sizeof(double);
    size_t first = stencil->graph.row[a];
    size_t count = 0;
    for (size_t axis = 0; axis < dim; axis++) {
        for (size_t ab = first; ab < stencil->graph.row[a + 1]; ab++) {
            if (axis_of(stencil, X, a, ab) == axis) {
                row[count].neighbour = stencil->graph.neighbour[ab];
                memcpy(row[count].record, solver_stencil_C(stencil, ab), bytes);
                count++;
            }
        }
    }
    for (size_t k = 0; k < count; k++) {
        stencil->graph.neighbour[first + k] = row[k].neighbour;
        memcpy(solver_stencil_C(stencil, first + k), row[k].record, bytes);
    }
}

bool solver_stencil_align(struct solver_stencil *stencil, const struct solver_cloud *cloud, struct solver_error *error)
{
    size_t dim = (size_t)stencil->dim;
    uint8_t *along = NULL;
    struct moved *row = NULL;
    if (stencil->transposed != NULL || stencil->least_squares != NULL) {
        return true;
    }
    bool done =
        solver_alloc((void **)&along, stencil->count * lanes(stencil), sizeof *along, "pairs along axes", error) &&
        solver_alloc((void **)&row, dim * UINT8_MAX, sizeof *row, "pairs along axes", error);
    if (done && count_along(stencil, cloud->X, along)) {
        for (size_t a = 0; a < stencil->count; a++) {
            sort_row(stencil, cloud->X, a, row);
        }
        stencil->along = along;
    } else {
        free(along);
    }
    free(row);
    return done;
}
