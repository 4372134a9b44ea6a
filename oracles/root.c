#include "oracles/root.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

bool root_between(double (*function)(double x, void *with), void *with, double lower, double upper, double *root)
{
    gsl_function f = {function, with};
    bool crosses = !(function(lower, with) * function(upper, with) > 0);
    gsl_root_fsolver *solver = crosses ? gsl_root_fsolver_alloc(gsl_root_fsolver_brent) : NULL;
    if (solver == NULL) {
        return false;
    }
    bool found = gsl_root_fsolver_set(solver, &f, lower, upper) == GSL_SUCCESS;
    for (int i = 0, status = GSL_CONTINUE; found && status == GSL_CONTINUE && i < 200; i++) {
        found = gsl_root_fsolver_iterate(solver) == GSL_SUCCESS;
        status = gsl_root_test_interval(gsl_root_fsolver_x_lower(solver), gsl_root_fsolver_x_upper(solver), 0, 4e-16);
    }
    *root = gsl_root_fsolver_root(solver);
    gsl_root_fsolver_free(solver);
    return found;
}
