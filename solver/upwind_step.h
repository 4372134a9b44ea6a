/* By how much a body's step is shorter than its waves alone would have it. */
#ifndef SOLVER_UPWIND_STEP_H
#define SOLVER_UPWIND_STEP_H

#include "solver/scheme.h"
#include "solver/stencil.h"

/* At least 1: by it the step of 000_e9ec29e1bde7947d.txt eq. 41 is divided. */
double solver_upwind_step_share(const struct solver_stencil *stencil, const struct solver_body *body);

#endif
