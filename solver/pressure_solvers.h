/* The solvers of the pressure's equation (pressure.h), and what they share. */
#ifndef SOLVER_PRESSURE_SOLVERS_H
#define SOLVER_PRESSURE_SOLVERS_H

#include "solver/pressure.h"

/* From v_int in `predicted` and a first guess of the increment [count] of the pressure: the increment, and the velocity
 * in work->v that goes with it. Fails (SOLVER_BROKE_DOWN) where the tolerance is not reached. */
bool solver_pressure_poisson(struct solver_pressure *of, double *increment, struct solver_error *error);
bool solver_pressure_pseudo_time(struct solver_pressure *of, double *increment, struct solver_error *error);

/* out = (tau D M^-1 D^T + S + V / (kappa tau)) q */
void solver_pressure_apply(const struct solver_pressure *of, const double *q, double *out);
/* v = v_int + tau times the acceleration of the increment. */
void solver_pressure_velocity(const struct solver_pressure *of, const double *increment);
/* residual = D v - S p - V (p - p_ref) / (kappa tau), p = p_stage + increment; with eta times the Laplacian of p. What
 * of it no pressure balances is taken away. */
void solver_pressure_residual(const struct solver_pressure *of, const double *increment, double eta);
/* Of the residual: the largest share of a particle's volume that it is over tau. */
double solver_pressure_left(const struct solver_pressure *of);
/* Sum of x y over particles, in an order that does not depend on threads; y NULL: of x. */
double solver_pressure_dot(const struct solver_pressure *of, const double *x, const double *y);
/* Fails, with how far it got. */
bool solver_pressure_give_up(const struct solver_pressure *of, double left, struct solver_error *error);

#endif
