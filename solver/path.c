#include "solver/path.h"

#include <stdatomic.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

static const char *const names[] = {"baseline", "avx2", "avx512"};

const char *solver_path_name(int path)
{
    return path >= 0 && path < SOLVER_PATHS ? names[path] : NULL;
}

/* The levels x86-64-v3 and x86-64-v4 that these paths are compiled for, and no less. */
bool solver_path_runs(int path)
{
#ifdef SOLVER_WIDE_PATHS
    bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
              __builtin_cpu_supports("bmi2");
    bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
              __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
              __builtin_cpu_supports("avx512vl");
    return path == 0 || (path == 1 && v3) || (path == 2 && v4);
#else
    return path == 0;
#endif
}

static int named(const char *name)
{
    int path = 0;
    while (path < SOLVER_PATHS && strcmp(names[path], name) != 0) {
        path++;
    }
    return path;
}

static int widest(void)
{
    int path = SOLVER_PATHS - 1;
    while (!solver_path_runs(path)) {
        path--;
    }
    return path;
}

static atomic_int in_use = -1;

int solver_path(void)
{
    int path = atomic_load(&in_use);
    if (path < 0) {
        const char *asked = getenv("ASSAY_ISA");
        path = asked != NULL ? named(asked) : SOLVER_PATHS;
        path = path < SOLVER_PATHS && solver_path_runs(path) ? path : widest();
        atomic_store(&in_use, path);
    }
    return path;
}

bool solver_path_check(struct solver_error *error)
{
    const char *asked = getenv("ASSAY_ISA");
    if (asked == NULL || asked[0] == '\0' || solver_path_runs(named(asked))) {
        return true;
    }
    return named(asked) == SOLVER_PATHS
               ? solver_fail(error, SOLVER_BAD_INPUT,
                             "environment: ASSAY_ISA is \"%s\"; expected %s, or nothing, for the widest that the "
                             "processor knows",
                             asked, SOLVER_PATHS > 1 ? "baseline, avx2 or avx512" : "baseline")
               : solver_fail(error, SOLVER_BAD_INPUT,
                             "environment: ASSAY_ISA is \"%s\", which this processor does not know; expected at most "
                             "%s",
                             asked, names[widest()]);
}

void solver_path_use(int path)
{
    atomic_store(&in_use, path);
}
