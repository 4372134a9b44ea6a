/* Corrected kernel gradients: the "corrected gradient of a corrected kernel" of 000_e9ec29e1bde7947d.txt section 3.2,
 * a mixed kernel (constant) and gradient (linear) correction. */
#ifndef SOLVER_KERNEL_H
#define SOLVER_KERNEL_H

#include "solver/cloud.h"
#include "solver/graph.h"

/* Relative margin by which supports are shortened, so that round-off does not decide which lattice neighbours at just
 * that distance take part: none does (the kernel is zero there). */
static const double solver_kernel_margin = 1e-9;

/* The quadratic kernel without its normalisation, which the correction cancels: value and derivative at q = r/h in
 * [0, 2]; beyond 2 both are 0. */
double solver_kernel(double q, double *derivative);

/* g_ab = V_b grad W~_b(X_a) (eq. 12) for every pair of the graph: [pairs][dim] in 1/m, with the sums weighted by
 * volume[count], or by equal volumes where it is NULL. The kernel's support radius is `radius` [m]. Then
 * sum_b (f_b - f_a) g_ab is exact for linear f. */
bool solver_kernel_gradients(const struct solver_cloud *cloud, const struct solver_graph *graph, double radius,
                             const double *volume, double *gradient, struct solver_error *error);

#endif
