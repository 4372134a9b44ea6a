/* The state at one of the scene's snapshot times, compared with the oracle while the run stood there. */
#ifndef VERIFY_SNAPSHOT_H
#define VERIFY_SNAPSHOT_H

#include "verify/norms.h"

/* Stress along a one-dimensional body at one particle. */
struct verify_point {
    double X, computed, exact; /* [m], [Pa], [Pa]: Cauchy stress sigma_xx */
};

struct verify_snapshot {
    double time; /* [s] */
    double error[VERIFY_STATE_ERRORS];
    size_t count;               /* 0 in 2D and 3D */
    struct verify_point *point; /* [count] ascending in X */
};

/* Compares the run's present state with the oracle and, in 1D, keeps its profile. On success the caller frees. */
bool verify_snapshot_take(struct solver_run *run, const struct oracle_kind *kind, const struct oracle *oracle,
                          struct verify_snapshot *snapshot, struct solver_error *error);
void verify_snapshot_free(struct verify_snapshot *snapshot);

#endif
