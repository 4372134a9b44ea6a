/* The discrete problem of ritz.h: A z = omega^2 M z over products of functions of x and of y. */
#ifndef ORACLES_RITZ_SYSTEM_H
#define ORACLES_RITZ_SYSTEM_H

#include "oracles/axis.h"
#include "oracles/skyline.h"

/* Unknowns z: a block for each component of each x function, with the coefficients of the y functions in order; of u_x
 * without function 0, for u_x is zero on y = 0 by symmetry. */
struct ritz_system {
    double lambda;            /* mu = rho = 1 */
    const struct axis *x, *y; /* not owned */
    struct axis_matrices of_x, of_y;
    int *block;    /* [x->functions][2] first unknown of the block; -1 on the clamp */
    bool *coupled; /* [x->functions][2][x->functions][2] whether two blocks have entries in A */
    size_t unknowns;
    struct skyline stiffness; /* A, or its factor */
};

/* Assembles A and factorises it. False if there is no memory or A is not positive definite; to be freed either way. */
bool ritz_system_create(struct ritz_system *system, const struct axis *x, const struct axis *y, double lambda);
void ritz_system_free(struct ritz_system *system);

/* Whether there is an unknown for component 0 or 1 of x function a times y function j, and which. */
bool ritz_system_unknown(const struct ritz_system *system, int a, int component, int j, size_t *index);

/* out = M z. */
void ritz_system_mass(const struct ritz_system *system, const double *z, double *out);

/* The lowest modes, by subspace iteration: [count] vectors with z^T M z = 1 and their omega^2. */
struct ritz_subspace {
    size_t count;
    double *vector, *massed;    /* [count][unknowns]: z and M z */
    double *next, *next_massed; /* the same, one step on */
    double *square;             /* [count] omega^2 */
};

/* Until vector `wanted` (from 0) stands. False if there is no memory or it does not come to stand; to be freed either
 * way. */
bool ritz_subspace_find(const struct ritz_system *system, size_t wanted, struct ritz_subspace *space);
void ritz_subspace_free(struct ritz_subspace *space);

#endif
