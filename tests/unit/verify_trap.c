/* Floating-point traps strike, in the hot loops and in their threads as elsewhere, and only where they are asked for.
 * Each attempt is a process of its own. */
/* fedisableexcept */
#define _GNU_SOURCE // NOLINT(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

#include "solver/upwind.h"
#include "tests/unit/unit.h"
#include "verify/trap.h"

#include <fenv.h>
#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { STRUCK = 99 };
static volatile double zero = 0.0;
static volatile double large = 1e300;
static volatile double result;

static void divide(void)
{
    result = 1.0 / zero;
}

static void take_root(void)
{
    result = sqrt(zero - 1.0);
}

static void overflow(void)
{
    result = large * large;
}

static void compare_with_nan(void)
{
    volatile double none = NAN;
    result = none < zero ? 1.0 : 0.0;
}

static void underflow(void)
{
    result = 1e-300 * (1e-300 + zero);
}

/* Two particles, each the other's neighbour; the volume of one is zero. */
static void divide_in_hot_loop(void)
{
    static double pair[6] = {1.0, 0.0, 1.0, -1.0, 0.0, 1.0};
    static double v[4] __attribute__((aligned(64))) = {1.0, 2.0, 3.0, 4.0};
    static double rates[16] __attribute__((aligned(64)));
    const size_t row[] = {0, 1, 2};
    const uint32_t neighbour[] = {1, 0};
    double V[2] = {1.0, zero};
    struct solver_upwind work = {.row = row, .neighbour = neighbour, .pair = pair, .unit = 1.0, .V = V, .v = v};
    work.F_rate = rates;
    solver_upwind_2d_baseline.gradients(&work, 0, 2);
}

static void divide_in_thread(void)
{
#pragma omp parallel num_threads(2)
    {
        if (omp_get_thread_num() == 1) {
            result = 1.0 / zero;
        }
    }
}

/* Traps are suspended in threads that are there already, and come back to them. */
static void divide_in_thread_while_suspended(void)
{
    omp_set_num_threads(2); /* as a run does, whatever OMP_NUM_THREADS says */
#pragma omp parallel
    {
        result = 1.0;
    }
    bool were_set = verify_trap_suspend();
    divide_in_thread();
    verify_trap_resume(were_set);
}

static void divide_in_thread_after_that(void)
{
    divide_in_thread_while_suspended();
    divide_in_thread();
}

static void divide_while_suspended(void)
{
    bool were_set = verify_trap_suspend();
    result = 1.0 / zero;
    verify_trap_resume(were_set);
}

static void divide_after_that(void)
{
    divide_while_suspended();
    result = 1.0 / zero;
}

/* Ends with what the process ended with; `said` becomes what it said. */
static int attempt(const char *asked, void (*act)(void), char said[1024])
{
    int ends[2];
    int status = 0;
    CU_ASSERT_FATAL(pipe(ends) == 0);
    (void)fflush(NULL);
    pid_t child = fork();
    CU_ASSERT_FATAL(child >= 0);
    if (child == 0) {
        (void)dup2(ends[1], STDERR_FILENO);
        (void)fedisableexcept(FE_ALL_EXCEPT); /* whatever this program runs with */
        (void)setenv("ASSAY_TRAP", asked, 1);
        verify_trap_from_environment();
        act();
        _exit(0);
    }
    (void)close(ends[1]);
    size_t length = 0;
    for (ssize_t got; (got = read(ends[0], said + length, 1023 - length)) > 0;) {
        length += (size_t)got;
    }
    said[length] = '\0';
    (void)close(ends[0]);
    CU_ASSERT_FATAL(waitpid(child, &status, 0) == child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void strikes(void)
{
    static const struct {
        void (*act)(void);
        const char *says;
    } cases[] = {
        {divide, "division by zero"},
        {take_root, "invalid operation"},
        {overflow, "overflow"},
        {compare_with_nan, "invalid operation"},
        {divide_in_hot_loop, "division by zero"},
        {divide_in_thread, "division by zero"},
        {divide_after_that, "division by zero"},
        {divide_in_thread_after_that, "division by zero"},
    };
    char said[1024];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        int code = attempt("1", cases[i].act, said);
        if (code != STRUCK || strstr(said, cases[i].says) == NULL || strstr(said, "test_verify_trap") == NULL) {
            printf("\n    case %zu ends with %d and says: %s", i, code, said);
        }
        CU_ASSERT_EQUAL(code, STRUCK);
        CU_ASSERT_PTR_NOT_NULL(strstr(said, cases[i].says));
        CU_ASSERT_PTR_NOT_NULL(strstr(said, "test_verify_trap")); /* where */
    }
}

static void does_not_strike(void)
{
    char said[1024];
    CU_ASSERT_EQUAL(attempt("", divide, said), 0);
    CU_ASSERT_EQUAL(attempt("0", divide, said), 0);
    CU_ASSERT_EQUAL(attempt("1", underflow, said), 0);
    CU_ASSERT_EQUAL(attempt("1", divide_while_suspended, said), 0);
    CU_ASSERT_EQUAL(attempt("1", divide_in_thread_while_suspended, said), 0);
}

static const struct unit_test tests[] = {
    {"strikes", strikes},
    {"does not strike", does_not_strike},
};

int main(void)
{
    return unit_main("verify trap", tests, sizeof tests / sizeof *tests);
}
