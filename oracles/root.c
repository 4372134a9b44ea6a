#include "oracles/root.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

bool root_between(gsl_function *function, double lower, double upper, double *root)
{
    double ends = GSL_FN_EVAL(function, lower) * GSL_FN_EVAL(function, upper);
    gsl_root_fsolver *solver = ends <= 0 ? gsl_root_fsolver_alloc(gsl_root_fsolver_brent) : NULL;
    if (solver == NULL) {
        return false;
    }
    bool found = gsl_root_fsolver_set(solver, function, lower, upper) == GSL_SUCCESS;
    for (int i = 0, status = GSL_CONTINUE; found && status == GSL_CONTINUE && i < 200; i++) {
        found = gsl_root_fsolver_iterate(solver) == GSL_SUCCESS;
        status = gsl_root_test_interval(gsl_root_fsolver_x_lower(solver), gsl_root_fsolver_x_upper(solver), 0, 4e-16);
    }
    *root = gsl_root_fsolver_root(solver);
    gsl_root_fsolver_free(solver);
    return found;
}
