/* The spectrum of a run: eigenvalues of the matrix that takes a small change of its state to the change of its rates.
 * With an integrator's stability function they say, without a step being made, up to which CFL number it is stable. */
#ifndef SOLVER_SPECTRUM_H
#define SOLVER_SPECTRUM_H

#include "solver/integrator.h"
#include "solver/run.h"

#include <complex.h>
#include <stddef.h>

enum { SOLVER_SPECTRUM_LARGEST = 1200 }; /* unknowns: the work grows with their cube */

/* Eigenvalues [1/s] about the present state, in *eigenvalue, [count], which the caller frees. The matrix is made of
 * differences of rates, which is exact where these are linear (linear kinematics). Unknowns that nothing depends on,
 * each with the eigenvalue 0, are left out. The run is as it was afterwards. SOLVER_BAD_INPUT where there are too many
 * unknowns, loads or what else makes rates depend on time, or a state in single precision; SOLVER_NO_MEMORY;
 * SOLVER_BROKE_DOWN where the eigenvalues do not converge. */
bool solver_run_spectrum(struct solver_run *run, double complex **eigenvalue, size_t *count,
                         struct solver_error *error);

/* R(z): what one step makes of the solution of y' = (z / dt) y. */
double complex solver_stability_function(const struct solver_integrator *integrator, double complex z);

/* The largest dt [s] such that at it, and at all shorter steps, |R(lambda dt)| <= 1 + growth for all of these
 * eigenvalues; to 1e-6 of itself. Zero where even the shortest step grows by more. Those of defective matrices are off
 * by 1e-8 of the largest, so that a growth below 1e-6 cannot be told from none. */
double solver_stable_step(const struct solver_integrator *integrator, const double complex *eigenvalue, size_t count,
                          double growth);

#endif
