/* By how much the step of a composite body in the updated frame is shorter than its waves alone would have it. */
#ifndef SOLVER_ULSPH_STEP_H
#define SOLVER_ULSPH_STEP_H

#include "solver/scheme.h"
#include "solver/ulsph.h"

/* At least 1, from the pairs of the present state. */
double solver_ulsph_step_share(const struct solver_ulsph *work, const struct solver_body *body);

#endif
