#include "solver/peak.h"

const struct solver_peak_loops *solver_peak(void)
{
    static const struct solver_peak_loops *const loops[][3] = SOLVER_LOOPS(solver_peak);
    return loops[solver_path()][2];
}
