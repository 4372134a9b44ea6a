/* A root of a function between two places where it has opposite signs. */
#ifndef ORACLES_ROOT_H
#define ORACLES_ROOT_H

#include <gsl/gsl_math.h>
#include <stdbool.h>

/* By Brent's method, until its interval no longer shrinks. False if there is no memory or the signs are alike. */
bool root_between(gsl_function *function, double lower, double upper, double *root);

#endif
