/* Paths: the hot loops (*_dim.c) are compiled for several instruction sets, and the processor decides which of them
 * run. A program is so one for all machines of its kind and as fast as one made for the machine at hand. avx2 and
 * avx512 give the same bits; baseline, without fused multiply-adds, differs from them by round-off. */
#ifndef SOLVER_PATH_H
#define SOLVER_PATH_H

#include "solver/error.h"

#include <stdbool.h>

/* SOLVER_LOOPS(f) is the initializer of an array [SOLVER_PATHS][3] of the addresses of f_1d_baseline and its like,
 * SOLVER_DECLARE_LOOPS(type, f) declares them. SOLVER_WIDE_PATHS: the build has more than the baseline. */
#define SOLVER_LOOPS_ON(name, path)                                                                                    \
    {                                                                                                                  \
        &name##_1d_##path, &name##_2d_##path, &name##_3d_##path                                                        \
    }
#define SOLVER_DECLARE_LOOPS_ON(type, name, path) extern const type name##_1d_##path, name##_2d_##path, name##_3d_##path
#ifdef SOLVER_WIDE_PATHS
enum { SOLVER_PATHS = 3 };
#define SOLVER_LOOPS(name)                                                                                             \
    {                                                                                                                  \
        SOLVER_LOOPS_ON(name, baseline), SOLVER_LOOPS_ON(name, avx2), SOLVER_LOOPS_ON(name, avx512)                    \
    }
#define SOLVER_DECLARE_LOOPS(type, name)                                                                               \
    SOLVER_DECLARE_LOOPS_ON(type, name, baseline);                                                                     \
    SOLVER_DECLARE_LOOPS_ON(type, name, avx2);                                                                         \
    SOLVER_DECLARE_LOOPS_ON(type, name, avx512)
#else
enum { SOLVER_PATHS = 1 };
#define SOLVER_LOOPS(name)                                                                                             \
    {                                                                                                                  \
        SOLVER_LOOPS_ON(name, baseline)                                                                                \
    }
#define SOLVER_DECLARE_LOOPS(type, name) SOLVER_DECLARE_LOOPS_ON(type, name, baseline)
#endif

/* The path in use: the widest that the processor knows, or the one that the environment variable ASSAY_ISA names. */
int solver_path(void);
/* "baseline", "avx2" or "avx512", in order; NULL beyond the last that was built. */
const char *solver_path_name(int path);
/* Whether the processor knows it. */
bool solver_path_runs(int path);
/* Fails (SOLVER_BAD_INPUT) if ASSAY_ISA names no path, or one that the processor does not know; the widest is then in
 * use. */
bool solver_path_check(struct solver_error *error);
/* Another path, for runs created from now on; for tests. */
void solver_path_use(int path);

#endif
