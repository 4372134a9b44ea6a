/* The loops of upwind_dim.c in single precision. */
#include "solver/upwind.h"
#include "solver/upwind_abreast.h"
#include "solver/upwind_ranks.h"

#define SINGLE
#define solver_upwind        solver_upwind_single
#define solver_abreast       solver_abreast_single
#define solver_abreast_loops solver_abreast_single_loops
#define solver_rank_others   solver_rank_single_others
#define solver_rank_loops    solver_rank_single_loops
#define solver_ranks         solver_ranks_single
#include "solver/upwind_dim.c" // NOLINT(bugprone-suspicious-include): one source text
