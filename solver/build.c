#include "solver/build.h"

#include "solver/peak.h"

const char *solver_build(void)
{
    return SOLVER_BUILD; /* CMakeLists.txt */
}

const char *solver_build_loops(void)
{
    return solver_peak()->fused ? "fused" : "separate";
}
