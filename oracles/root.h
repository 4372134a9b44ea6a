/* Roots of functions, by GSL. */
#ifndef ORACLES_ROOT_H
#define ORACLES_ROOT_H

#include <stdbool.h>

/* Brent's method until its interval no longer shrinks. The function must be a number on the whole interval. False if it
 * has one sign at both ends, or there is no memory or no convergence. */
bool root_between(double (*function)(double x, void *with), void *with, double lower, double upper, double *root);

#endif
