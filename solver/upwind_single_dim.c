/* The loops of upwind_dim.c with fields stored in single precision. */
#include "solver/upwind.h"

#define SINGLE
#define solver_upwind solver_upwind_single
#include "solver/upwind_dim.c"
