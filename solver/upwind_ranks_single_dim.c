/* The loops of upwind_ranks_dim.c in single precision. In space columns of tensors of two particles are put together in
 * a register, of which half is filled: of four, that takes longer than it saves. */
#include "solver/upwind_ranks.h"

#define SINGLE
#if DIM == 3
#define HALF_REGISTERS
#endif
#define solver_upwind      solver_upwind_single
#define solver_rank_others solver_rank_single_others
#define solver_rank_loops  solver_rank_single_loops
#define solver_ranks       solver_ranks_single
#include "solver/upwind_ranks_dim.c" // NOLINT(bugprone-suspicious-include): one source text
