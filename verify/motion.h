/* Displacement of all probes over time, kept from a run's history. */
#ifndef VERIFY_MOTION_H
#define VERIFY_MOTION_H

#include "solver/run.h"

struct verify_motion {
    size_t count, probe_count;
    double *time; /* [count] increasing [s]; one block with u, which it owns */
    double *u;    /* [probe_count][3][count] [m] */
};

/* Fails with SOLVER_NO_MEMORY; on success the caller frees. */
bool verify_motion_take(const struct solver_history *history, struct verify_motion *motion, struct solver_error *error);
void verify_motion_free(struct verify_motion *motion);

/* One component of a probe's displacement: [count]. */
const double *verify_motion_component(const struct verify_motion *motion, size_t probe, size_t axis);
/* Displacement of a probe at t [s], cubic through the four rows nearest in order: exact for motions of third degree in
 * time. NaN where t lies outside the rows. */
void verify_motion_at(const struct verify_motion *motion, size_t probe, double t, double u[3]);

#endif
