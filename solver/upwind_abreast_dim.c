/* The loops of dim_aligned.h once more, for particles that are abreast. */
#define ABREAST
#include "solver/upwind_abreast.h"

#include "solver/dim_aligned.h"

/* In space 512 bits for two particles of double precision take 0.9 to 1.15 times the time of 256 for one. On the
 * baseline registers are narrow, and tests count operations. */
enum { IS_WORTH = GROUP > 1 && REGISTER_BYTES > 16 && (DIM < 3 || IN_SINGLE) };

const struct solver_abreast_loops DIM_NAME(solver_abreast) = {
    .least = IS_WORTH ? GROUP : SIZE_MAX,
    /* not even compiled where nothing calls them */
    .gradients = IS_WORTH ? aligned_gradients : NULL,
    .rates = IS_WORTH ? aligned_rates : NULL,
};
