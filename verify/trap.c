/* feenableexcept, dladdr */
#define _GNU_SOURCE // NOLINT(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

#include "verify/trap.h"

#include <fenv.h>
#include <stdlib.h>

#ifdef __GLIBC__

#include <dlfcn.h>
#include <execinfo.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { TRAPPED = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW, FRAMES = 32, EXIT_TRAPPED = 99 };

static const char *kind_of(int code)
{
    return code == FPE_FLTDIV   ? "division by zero"
           : code == FPE_FLTOVF ? "overflow"
           : code == FPE_FLTINV ? "invalid operation"
                                : "arithmetic exception";
}

/* The program is beyond repair, so that what is not safe in a handler is worth trying. */
static void strike(int number, siginfo_t *info, void *context)
{
    char text[512];
    void *frame[FRAMES];
    Dl_info place = {.dli_fname = NULL};
    (void)number;
    (void)context;
    (void)fedisableexcept(FE_ALL_EXCEPT);
    const char *base = dladdr(info->si_addr, &place) != 0 ? place.dli_fbase : NULL;
    const char *file = place.dli_fname != NULL ? place.dli_fname : "unknown";
    int length = snprintf(
        text, sizeof text, "ASSAY_TRAP: %s in %s+0x%lx %s\nASSAY_TRAP: addr2line -fie %s 0x%lx says which line\n",
        kind_of(info->si_code), file, (unsigned long)((const char *)info->si_addr - base),
        place.dli_sname != NULL ? place.dli_sname : "", file, (unsigned long)((const char *)info->si_addr - base));
    if (length > 0 && write(STDERR_FILENO, text, strnlen(text, sizeof text)) < 0) {
        _exit(EXIT_TRAPPED);
    }
    backtrace_symbols_fd(frame, backtrace(frame, FRAMES), STDERR_FILENO);
    _exit(EXIT_TRAPPED);
}

void verify_trap_from_environment(void)
{
    const char *asked = getenv("ASSAY_TRAP");
    if (asked == NULL || asked[0] == '\0' || strcmp(asked, "0") == 0) {
        return;
    }
    struct sigaction action = {.sa_flags = SA_SIGINFO};
    action.sa_sigaction = strike;
    void *frame[1];
    (void)backtrace(frame, 1); /* loads what the handler needs */
    if (sigaction(SIGFPE, &action, NULL) != 0 || feenableexcept(TRAPPED) == -1) {
        (void)fprintf(stderr, "ASSAY_TRAP: floating-point traps are not to be had\n");
        exit(EXIT_TRAPPED);
    }
}

/* In the threads that there are as well; those that come later take after the one that makes them. */
static void in_all_threads(int (*set)(int))
{
#ifdef _OPENMP
#pragma omp parallel
#endif
    {
        (void)feclearexcept(FE_ALL_EXCEPT);
        (void)set(TRAPPED);
    }
}

bool verify_trap_suspend(void)
{
    bool were_set = (fegetexcept() & TRAPPED) != 0;
    if (were_set) {
        in_all_threads(fedisableexcept);
    }
    return were_set;
}

void verify_trap_resume(bool were_set)
{
    if (were_set) {
        in_all_threads(feenableexcept);
    }
}

#else

#include <stdio.h>

void verify_trap_from_environment(void)
{
    if (getenv("ASSAY_TRAP") != NULL) {
        (void)fprintf(stderr, "ASSAY_TRAP: this C library has no floating-point traps\n");
        exit(99);
    }
}

bool verify_trap_suspend(void)
{
    return false;
}

void verify_trap_resume(bool were_set)
{
    (void)were_set;
}

#endif
