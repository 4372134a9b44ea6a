#include "verify/motion.h"

#include <math.h>
#include <stdlib.h>

enum { POINTS = 4 };

bool verify_motion_take(const struct solver_history *history, struct verify_motion *motion, struct solver_error *error)
{
    size_t rows = history->count, width = 3 * history->probe_count;
    *motion = (struct verify_motion){.count = rows, .probe_count = history->probe_count};
    motion->time = calloc(rows + 1, (width + 1) * sizeof *motion->time); /* one more, so that none is no failure */
    if (motion->time == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for the motion of %zu probes, %zu rows",
                           history->probe_count, rows);
    }
    motion->u = motion->time + rows;
    for (size_t row = 0; row < rows; row++) {
        motion->time[row] = history->totals[row].time;
        for (size_t i = 0; i < width; i++) {
            motion->u[i * rows + row] = history->probe_u[row * width + i];
        }
    }
    return true;
}

void verify_motion_free(struct verify_motion *motion)
{
    free(motion->time);
    *motion = (struct verify_motion){.count = 0};
}

const double *verify_motion_component(const struct verify_motion *motion, size_t probe, size_t axis)
{
    return motion->u + (3 * probe + axis) * motion->count;
}

/* The last row at or before t, by bisection; t lies within the rows. */
static size_t row_before(const struct verify_motion *motion, double t)
{
    size_t low = 0, high = motion->count;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (motion->time[middle] <= t) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

void verify_motion_at(const struct verify_motion *motion, size_t probe, double t, double u[3])
{
    size_t points = motion->count < POINTS ? motion->count : POINTS;
    u[0] = u[1] = u[2] = NAN;
    if (points == 0 || !isgreaterequal(t, motion->time[0]) || !islessequal(t, motion->time[motion->count - 1])) {
        return;
    }
    size_t before = row_before(motion, t);
    size_t first = before > 0 ? before - 1 : 0;
    first = first + points > motion->count ? motion->count - points : first;
    const double *time = motion->time + first;
    u[0] = u[1] = u[2] = 0;
    for (size_t i = 0; i < points; i++) { /* Lagrange's polynomial of row i */
        double weight = 1;
        for (size_t j = 0; j < points; j++) {
            weight *= j == i ? 1 : (t - time[j]) / (time[i] - time[j]);
        }
        for (size_t axis = 0; axis < 3; axis++) {
            u[axis] += weight * verify_motion_component(motion, probe, axis)[first + i];
        }
    }
}
