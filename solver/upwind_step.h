/* By how much a body's step is shorter than its waves alone would have it. */
#ifndef SOLVER_UPWIND_STEP_H
#define SOLVER_UPWIND_STEP_H

#include "solver/scheme.h"
#include "solver/stencil.h"

/* Where materials meet on a graded lattice waves are as fast as they are fine: a step by a CFL number is that by min h
 * / c over the particles, which is min h / max c of a body of density rho (h / min h)^2. *paced, [count], which the
 * caller frees: the constants of that, h the smallest spacing of a particle and its neighbours; else NULL. Takes the
 * stencil's `fine`. SOLVER_NO_MEMORY. */
bool solver_upwind_pace(struct solver_stencil *stencil, const struct solver_body *body,
                        struct solver_material_constants **paced, struct solver_error *error);

/* At least 1: by it the step of 000_e9ec29e1bde7947d.txt eq. 41 is divided. */
double solver_upwind_step_share(const struct solver_stencil *stencil, const struct solver_body *body);

#endif
