/* Measures of what symmetry holds still. */
#include "verify/measures.h"

#include <math.h>

bool verify_drift(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                  struct solver_error *error)
{
    const struct solver_history *history = in->history;
    size_t axis = argument[1].axis;
    (void)error;
    *value = history->count > 0 ? 0 : NAN;
    for (size_t i = 0; i < history->count; i++) {
        const double *u = history->probe_u + 3 * (i * history->probe_count + argument[0].probe);
        double off = hypot(u[(axis + 1) % 3], u[(axis + 2) % 3]);
        *value = off <= *value || isnan(*value) ? *value : off; /* a NaN stays */
    }
    return true;
}
