/* Measures of the time history that need no oracle. */
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
        *value = islessequal(off, *value) || isnan(*value) ? *value : off; /* a NaN stays */
    }
    return true;
}

bool verify_distance(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                     struct solver_error *error)
{
    const struct solver_history *history = in->history;
    size_t from = argument[1].probe, to = argument[2].probe;
    double square = 0;
    (void)error;
    for (size_t i = 0; history->count > 0 && i < 3; i++) {
        const double *u = history->probe_u + 3 * (history->count - 1) * history->probe_count;
        double apart = history->probe_X[to][i] + u[3 * to + i] - history->probe_X[from][i] - u[3 * from + i];
        square += apart * apart;
    }
    *value = history->count > 0 ? sqrt(square) : NAN;
    return true;
}

bool verify_energy_lost(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                        struct solver_error *error)
{
    const struct solver_history *history = in->history;
    (void)argument;
    (void)error;
    *value = NAN;
    if (history->count > 0) {
        const struct solver_totals *first = &history->totals[0], *last = &history->totals[history->count - 1];
        double supply = first->kinetic + first->strain;
        *value = (supply + last->external - last->kinetic - last->strain - last->plastic) / supply;
    }
    return true;
}

bool verify_energy_rise(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                        struct solver_error *error)
{
    const struct solver_history *history = in->history;
    double lowest = INFINITY;
    double supply = 0;
    (void)argument;
    (void)error;
    *value = history->count > 0 ? 0 : NAN;
    for (size_t i = 0; i < history->count; i++) {
        const struct solver_totals *now = &history->totals[i];
        double energy = now->kinetic + now->strain - now->external;
        lowest = fmin(lowest, energy);
        supply = fmax(supply, now->kinetic + now->strain);
        *value = islessequal(energy - lowest, *value) || isnan(*value) ? *value : energy - lowest; /* a NaN stays */
    }
    *value /= supply;
    return true;
}

bool verify_volume_change(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                          struct solver_error *error)
{
    const struct solver_history *history = in->history;
    (void)argument;
    (void)error;
    *value = history->count > 0 && history->incompressible ? 0 : NAN;
    for (size_t i = 0; i < history->count; i++) {
        double change = history->totals[i].volume_change;
        *value = islessequal(change, *value) || isnan(*value) ? *value : change; /* a NaN stays */
    }
    return true;
}

bool verify_iterations(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                       struct solver_error *error)
{
    const struct solver_history *history = in->history;
    (void)argument;
    (void)error;
    *value = history->count > 0 && history->incompressible
                 ? history->totals[history->count - 1].iterations / (double)in->level->facts.steps
                 : NAN;
    return true;
}

/* The most kinetic and strain energy there was; SOLVER_BAD_INPUT where the scene keeps no balance. */
static bool supply_of(const struct verify_measuring *in, double *supply, struct solver_error *error)
{
    const struct solver_history *history = in->history;
    if (!in->scene->balance) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%s: figures: this one needs balance = true", in->scene->path);
    }
    *supply = 0;
    for (size_t i = 0; i < history->count; i++) {
        *supply = fmax(*supply, history->totals[i].kinetic + history->totals[i].strain);
    }
    return true;
}

bool verify_energy_balance(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                           struct solver_error *error)
{
    const struct solver_history *history = in->history;
    double supply = 0;
    (void)argument;
    if (!supply_of(in, &supply, error)) {
        return false;
    }
    *value = history->count > 0 ? 0 : NAN;
    for (size_t i = 0; i < history->count; i++) {
        const struct solver_totals *first = &history->totals[0], *now = &history->totals[i];
        double there = now->kinetic + now->strain + now->plastic + now->numerical + now->impact - now->external;
        double gap = fabs(there - first->kinetic - first->strain) / supply;
        *value = islessequal(gap, *value) || isnan(*value) ? *value : gap; /* a NaN stays */
    }
    return true;
}

bool verify_numerical_dissipation(const struct verify_measuring *in, const struct verify_argument *argument,
                                  double *value, struct solver_error *error)
{
    double supply = 0;
    (void)argument;
    if (!supply_of(in, &supply, error)) {
        return false;
    }
    *value = in->history->count > 0 ? in->history->totals[in->history->count - 1].numerical / supply : NAN;
    return true;
}

bool verify_impact_loss(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                        struct solver_error *error)
{
    double supply = 0;
    (void)argument;
    if (!supply_of(in, &supply, error)) {
        return false;
    }
    *value = in->history->count > 0 ? in->history->totals[in->history->count - 1].impact / supply : NAN;
    return true;
}
