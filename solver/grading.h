/* Spacings that change along an axis of a box, as bias factors of meshers have it. From one end to the other each is
 * the same multiple of the last; fine at both ends or in the middle, their logarithm follows sin^2 or cos^2, so that
 * they change smoothly there too. Places are a smooth function of their number, which is what keeps orders of accuracy.
 */
#ifndef SOLVER_GRADING_H
#define SOLVER_GRADING_H

#include "solver/error.h"

#include <stdbool.h>
#include <stddef.h>

enum solver_fine { SOLVER_FINE_LOWER, SOLVER_FINE_UPPER, SOLVER_FINE_BOTH, SOLVER_FINE_MIDDLE };

struct solver_grading {
    double ratio; /* of the largest spacing to the smallest; 1, or 0 where nothing was said: all are the same */
    int fine;     /* enum solver_fine: where they are smallest */
};

static inline bool solver_grading_is_even(const struct solver_grading *grading)
{
    return grading->ratio == 1.0 || grading->ratio == 0.0;
}

/* Places X [points] [m] along axis 0, 1 or 2, from `lower` to `upper`, of a grading that is not even. SOLVER_BAD_INPUT
 * where the ratio is none, or the spacings are too few to have it. */
bool solver_grading_places(const struct solver_grading *grading, int axis, double lower, double upper, size_t points,
                           double *X, struct solver_error *error);

#endif
