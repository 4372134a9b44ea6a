/* What those share who write a kind of oracle: creating and freeing one. */
#ifndef ORACLES_KIND_H
#define ORACLES_KIND_H

#include "oracles/oracle.h"

/* Whether all of these are so far from zero and from infinity that products of them neither lose digits nor overflow:
 * fields that do would be a wrong answer without a warning. Where nothing moves they may be zero. */
bool oracle_representable(const double *size, size_t count, bool at_rest);
/* Says so in `why` of the values, which are in the order of the parameters. Returns false. */
bool oracle_out_of_range(const struct oracle_parameter *parameter, const double *value, char why[ORACLE_WHY]);

/* The state where an oracle says nothing: all NaN. */
void oracle_silence(struct oracle_state *state);
/* Distance [m] of X from the box lower <= X <= upper along the first `dim` axes; NaN where X is. */
double oracle_outside_box(int dim, const double *lower, const double *upper, const double *X);

/* A copy of `size` bytes, or false with `why` filled in. */
bool oracle_keep(const void *oracle, size_t size, struct oracle **out, char why[ORACLE_WHY]);
/* Says in `why` that there is no memory. Returns false. */
bool oracle_no_memory(size_t size, char why[ORACLE_WHY]);
/* The `destroy` of a kind that owns no more than its one block. */
void oracle_release(struct oracle *oracle);

#endif
