/* Particles that are abreast: inside a lattice each has the row of pairs that the one before it in its row of particles
 * has, moved on by one. */
#include "solver/memory.h"
#include "solver/stencil.h"

#include <string.h>

/* Whether particle a + 1 has all that a has, and each of its neighbours the number after that of a's. */
static bool go_on(const struct solver_stencil *stencil, size_t a)
{
    size_t dim = (size_t)stencil->dim;
    const size_t *row = stencil->graph.row;
    size_t length = row[a + 1] - row[a];
    const uint32_t *of_a = stencil->graph.neighbour + row[a];
    const uint32_t *of_next = stencil->graph.neighbour + row[a + 1];
    const double *sum = stencil->row_sum + a * dim;
    size_t lanes = dim == 3 ? 4 : dim;
    const uint8_t *along = stencil->along + a * lanes;
    bool same = length > 0 && row[a + 2] - row[a + 1] == length && stencil->shared[a] == stencil->shared[a + 1] &&
                memcmp(along, along + lanes, lanes) == 0 && memcmp(sum, sum + dim, dim * sizeof *sum) == 0 &&
                stencil->V[a] == stencil->V[a + 1];
    for (size_t k = 0; same && k < length; k++) {
        same = of_next[k] == of_a[k] + 1;
    }
    return same;
}

bool solver_stencil_find_runs(struct solver_stencil *stencil, struct solver_error *error)
{
    if (stencil->along == NULL || stencil->shared == NULL) {
        return true;
    }
    if (!solver_alloc((void **)&stencil->abreast, stencil->count, sizeof *stencil->abreast, "particles abreast",
                      error)) {
        return false;
    }
    uint8_t *abreast = stencil->abreast;
    for (size_t a = stencil->count; a-- > 0;) {
        bool on = a + 1 < stencil->count && go_on(stencil, a);
        uint8_t next = on ? abreast[a + 1] : 0;
        abreast[a] = next < UINT8_MAX ? (uint8_t)(next + 1) : UINT8_MAX;
    }
    return true;
}
