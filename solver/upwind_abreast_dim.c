/* The loops of dim_aligned.h once more, for particles that are abreast. */
#define ABREAST
#include "solver/upwind_abreast.h"

#include "solver/dim_aligned.h"

const struct solver_abreast_loops DIM_NAME(solver_abreast) = {
    .least = REGISTER_BYTES > 16 && GROUP > 1 ? GROUP : SIZE_MAX, /* not on the baseline, which tests count on */
    .gradients = aligned_gradients,
    .rates = aligned_rates,
};
