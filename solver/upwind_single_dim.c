/* The loops of upwind_dim.c in single precision. */
#include "solver/upwind.h"

#define SINGLE
#define solver_upwind solver_upwind_single
#include "solver/upwind_dim.c" // NOLINT(bugprone-suspicious-include): one source text
