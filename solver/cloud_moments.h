/* The least changes of a cloud's volumes and area vectors that make their moments fit: NUMERICS.md, "the constraints
 * are compatible only if ...". Private to cloud*.c. */
#ifndef SOLVER_CLOUD_MOMENTS_H
#define SOLVER_CLOUD_MOMENTS_H

#include "solver/cloud.h"

/* V_a <- V_a (1 + c0 + c . (X_a - centroid)/h) such that sum V = volume and sum V X = volume centroid. Two rounds, so
 * that round-off in the first is corrected by the second. Particles of walls stay as they are. */
bool cloud_fit_volumes(struct solver_cloud *cloud, double volume, const double centroid[3], struct solver_error *error);
/* Changes component k of area vectors by their size times a polynomial of degree 2 in X, such that for 1, X_i and
 * X_i X_j the divergence theorem holds: sum f B_k = sum V df/dX_k. That is what makes closure and linear exactness of a
 * stencil compatible (stencil_closed.c). Those on faces X0 to Z1 stay normal to them. Volumes must fit already. */
bool cloud_fit_areas(struct solver_cloud *cloud, const double lower[3], const double upper[3],
                     struct solver_error *error);

#endif
