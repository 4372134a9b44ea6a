/* Planes of symmetry: a part of a body stands for the whole.
 *
 * The whole cloud and its stencil are made first. Of them the part keeps the particles above the planes, and below, at
 * the end of its arrays, the mirror images that these reach: their neighbours, and the neighbours of those, so that the
 * nearer ones have gradients of their own. What is evolved at an image is that of its particle, reflected, before every
 * evaluation. So each particle sees what it would see in the whole body, and the part moves as the whole does, to
 * round-off: no boundary is in the way. Sums over the part are those over the whole, divided by the number of parts: a
 * particle on a plane counts with half of its volume there. */
#ifndef SOLVER_SYMMETRY_H
#define SOLVER_SYMMETRY_H

#include "solver/cloud.h"
#include "solver/cost.h"
#include "solver/state.h"
#include "solver/stencil.h"

struct solver_symmetry {
    double plane[3];            /* [m]; of the axes that are crossed */
    uint8_t *across;            /* [images] bit i: reflected across axis i; of cloud->image, in its order */
    uint32_t *from;             /* [count] particle of the whole cloud */
    uint8_t *halves;            /* [count] on how many planes a particle lies; images lie below */
    struct solver_cloud *whole; /* until the stencil is there */
};

/* The part of `whole` above the planes of its shape, which takes it over, with the images that pairs nearer than
 * `radius` [m] reach. SOLVER_BAD_INPUT where the cloud is not its own image in the planes. */
bool solver_symmetry_cut(struct solver_cloud *whole, const struct solver_shape *shape, double radius,
                         struct solver_cloud **part, struct solver_error *error);
/* What the part of a cloud keeps of the stencil of the whole, which it takes over; *out is NULL on failure:
 * SOLVER_NO_MEMORY, or SOLVER_BAD_INPUT where the stencil reaches farther than its support. */
bool solver_symmetry_keep(struct solver_stencil *whole, const struct solver_cloud *part, struct solver_stencil **out,
                          struct solver_error *error);
/* Writes all evolved fields of images. */
void solver_symmetry_reflect(const struct solver_cloud *part, struct solver_state *state);
/* Of what is no symmetric part, nothing. The arrays of its cloud and its stencil are theirs to declare. */
void solver_symmetry_arrays(const struct solver_cloud *part, struct solver_cost_arrays *arrays);
void solver_symmetry_terms(const struct solver_cloud *part, struct solver_cost_terms *terms);
void solver_symmetry_free(struct solver_symmetry *symmetry);

#endif
