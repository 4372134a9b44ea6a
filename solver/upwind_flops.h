/* Floating-point operations of the loops of upwind.h, term by term: an addition, multiplication or division of two
 * numbers is one, padding is none. Whoever changes a loop changes its row. */
#ifndef SOLVER_UPWIND_FLOPS_H
#define SOLVER_UPWIND_FLOPS_H

#include "solver/upwind.h"

/* Of one evaluation of all rates, and of what follows from the state that they lead to; 0 for a scheme or a choice
 * that the table does not count. */
double solver_upwind_flops(const struct solver_upwind *work, int dim, size_t count, size_t pairs);

#endif
