/* Measures of the stress along a one-dimensional body. */
#include "verify/measures.h"

#include <math.h>
#include <stdlib.h>

/* Extreme value of the parabola through three points, the middle one of which is largest in magnitude. */
static double vertex(const struct verify_point *p)
{
    double left = p[0].X - p[1].X, right = p[2].X - p[1].X;
    double s = (p[0].computed - p[1].computed) / left, e = (p[2].computed - p[1].computed) / right;
    double bend = (e - s) / (right - left), slope = s - bend * left;
    return bend == 0 ? p[1].computed : p[1].computed - slope * slope / (4 * bend);
}

double verify_peak(size_t count, const struct verify_point *point, double from, double to)
{
    size_t first = 0, last = count, largest = count;
    while (first < count && point[first].X < from) {
        first++;
    }
    while (last > first && point[last - 1].X > to) {
        last--;
    }
    for (size_t i = first; i < last; i++) {
        if (isnan(point[i].computed)) {
            return NAN;
        }
        largest = largest == count || fabs(point[i].computed) > fabs(point[largest].computed) ? i : largest;
    }
    return largest <= first || largest + 1 >= last ? NAN : vertex(&point[largest - 1]);
}

static double peak_in(const struct verify_measuring *in, const struct verify_argument *window)
{
    const struct verify_snapshot *snapshot = &in->level->snapshot[window->snapshot];
    return verify_peak(snapshot->count, snapshot->point, window->from, window->to);
}

bool verify_stress_ratio(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                         struct solver_error *error)
{
    (void)error;
    *value = peak_in(in, &argument[0]) / peak_in(in, &argument[1]);
    return true;
}

/* Whether the exact solution has nothing at X yet and the nearest front on one side is coming, farther away than
 * `beyond`: what is zero to round-off beside the peak is nothing. */
static bool is_ahead(const struct verify_truth *truth, double X, double t, double peak, double beyond,
                     const struct oracle_front *front, size_t count)
{
    const double place[3] = {X, 0, 0};
    const struct oracle_front *left = NULL, *right = NULL;
    struct oracle_state state;
    truth->kind->state(truth->oracle, place, t, &state);
    for (size_t i = 0; i < count; i++) { /* in the order of X; interfaces of materials stand still */
        if (front[i].speed != 0) {
            left = front[i].X <= X ? &front[i] : left;
            right = front[i].X >= X && right == NULL ? &front[i] : right;
        }
    }
    bool clear = (left == NULL || X - left->X > beyond) && (right == NULL || right->X - X > beyond);
    bool coming = (left != NULL && left->speed > 0) || (right != NULL && right->speed < 0);
    return coming && clear && fabs(state.P[0]) <= 1e-12 * peak && state.u[0] == 0 && state.v[0] == 0;
}

/* Takes the largest stress ahead of the fronts, over the snapshot's exact peak, into *largest, which stays NaN as long
 * as no particle is ahead. False if a stress is none. */
static bool take_ahead(const struct verify_truth *truth, const struct verify_snapshot *snapshot, double beyond,
                       struct oracle_front *front, double *largest)
{
    size_t count = truth->kind->fronts(truth->oracle, snapshot->time, front);
    double peak = 0;
    for (size_t i = 0; i < snapshot->count; i++) {
        peak = fmax(peak, fabs(snapshot->point[i].exact));
    }
    for (size_t i = 0; count != ORACLE_TOO_MANY_FRONTS && i < snapshot->count; i++) {
        const struct verify_point *point = &snapshot->point[i];
        if (is_ahead(truth, point->X, snapshot->time, peak, beyond, front, count)) {
            *largest = fmax(*largest, fabs(point->computed) / peak);
            if (isnan(point->computed)) {
                return false;
            }
        }
    }
    return true;
}

bool verify_stress_ahead(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                         struct solver_error *error)
{
    struct oracle_front *front = calloc(ORACLE_FRONTS, sizeof *front);
    if (front == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for the fronts of the oracle");
    }
    double largest = NAN;
    bool all = true;
    for (size_t i = 0; i < in->level->snapshot_count; i++) {
        all = take_ahead(in->truth, &in->level->snapshot[i], argument[0].length, front, &largest) && all;
    }
    *value = all ? largest : NAN;
    free(front);
    return true;
}
