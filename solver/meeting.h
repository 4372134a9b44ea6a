/* Where materials meet, the stress of stiff particles moves the mass of light ones, faster than waves run in either. */
#ifndef SOLVER_MEETING_H
#define SOLVER_MEETING_H

#include "solver/scheme.h"

/* What the modulus of a neighbour, that of pair `ab`, counts for in the frequency of particle a, up to a factor that
 * all its neighbours share. */
typedef double solver_meeting_weight(const void *context, size_t a, size_t ab);

/* By how much the step of a composite body is shorter than its waves alone would have it, at least 1. Neighbours in
 * compressed rows, as of graph.h. */
double solver_meeting_share(const struct solver_body *body, const size_t *row, const uint32_t *neighbour,
                            solver_meeting_weight *weight, const void *context);

#endif
