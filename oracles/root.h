/* Roots of functions, by GSL. */
#ifndef ORACLES_ROOT_H
#define ORACLES_ROOT_H

#include <stdbool.h>

/* Brent's method until its interval no longer shrinks. The function must be a number on the whole interval, and of
 * different signs at its ends, or zero there. False if there is no memory or no convergence. */
bool root_between(double (*function)(double x, void *with), void *with, double lower, double upper, double *root);

#endif
