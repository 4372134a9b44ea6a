/* Included before all else where the solver is compiled to be counted: every `double` is a __float128, whose additions,
 * subtractions, multiplications and divisions are calls of the compiler's library, which counter.c stands in front of.
 * What has its own doubles, headers of libraries, comes first. */
#ifndef TESTS_COUNTED_H
#define TESTS_COUNTED_H

#include <CUnit/CUnit.h>
#include <errno.h>
#include <float.h>
#include <lauxlib.h>
#include <limits.h>
#include <lua.h>
#include <lualib.h>
#include <math.h>
#include <omp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* Operations since the program began. */
extern unsigned long counted;

#define COUNTED(cost, call) (counted += (cost), call)
#define sqrt(x)             COUNTED(1, sqrt(x))
#define cbrt(x)             COUNTED(20, cbrt(x))
#define exp(x)              COUNTED(20, exp(x))
#define expm1(x)            COUNTED(20, expm1(x))
#define log(x)              COUNTED(20, log(x))
#define log1p(x)            COUNTED(20, log1p(x))
#define sinh(x)             COUNTED(20, sinh(x))
#define tanh(x)             COUNTED(20, tanh(x))
#define hypot(x, y)         COUNTED(20, hypot(x, y))
#define pow(x, y)           COUNTED(20, pow(x, y))

/* True ones, for what is printed. Floats are counted as doubles are. */
typedef double plain;
#define double __float128
#define float __float128

#endif
