/* The columns of a record's time history. */
#include "solver/record_format.h"

#include "solver/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Momenta and energies are per unit thickness in 2D, per unit area in 1D: their units by dimension. */
static const char *const momentum_unit[] = {"", "kg/(m s)", "kg/s", "kg m/s"};
static const char *const angular_unit[] = {"", "kg/s", "kg m/s", "kg m^2/s"};
static const char *const energy_unit[] = {"", "J/m^2", "J/m", "J"};

/* Writes one column, or only counts it while the record has no columns yet. */
struct columns {
    struct solver_record *record;
    const struct solver_history *history;
    size_t next;
};

static void column(struct columns *at, const char *name, const char *unit, const double *first, size_t stride)
{
    struct solver_record *record = at->record;
    if (record->history != NULL) {
        (void)snprintf(record->history_name[at->next], sizeof record->history_name[0], "%s", name);
        (void)snprintf(record->history_unit[at->next], sizeof record->history_unit[0], "%s", unit);
        for (size_t row = 0; row < record->history_count; row++) {
            record->history[row * record->history_columns + at->next] = first[row * stride];
        }
    }
    at->next++;
}

static void components(struct columns *at, const char *name, const char *unit, const double *first, size_t stride,
                       int from, int to)
{
    for (int i = from; i < to; i++) {
        char full[2 * SOLVER_NAME + 2];
        (void)snprintf(full, sizeof full, "%s_%c", name, "xyz"[i]);
        column(at, full, unit, first == NULL ? NULL : first + i, stride);
    }
}

static void probe_columns(struct columns *at, int dim)
{
    const struct solver_history *history = at->history;
    for (size_t k = 0; history != NULL && k < history->probe_count; k++) {
        char name[2 * SOLVER_NAME];
        size_t stride = 3 * history->probe_count;
        const double *u = history->count > 0 ? history->probe_u + 3 * k : NULL;
        const double *v = history->count > 0 ? history->probe_v + 3 * k : NULL;
        (void)snprintf(name, sizeof name, "probe_%s_u", history->probe_name[k]);
        components(at, name, "m", u, stride, 0, dim);
        (void)snprintf(name, sizeof name, "probe_%s_v", history->probe_name[k]);
        components(at, name, "m/s", v, stride, 0, dim);
    }
}

static void all_columns(struct columns *at, const double *total_energy)
{
    const int dim = at->record->dim;
    const size_t stride = sizeof(struct solver_totals) / sizeof(double);
    _Static_assert(sizeof(struct solver_totals) % sizeof(double) == 0, "totals are rows of doubles");
    static const struct solver_totals none; /* with no rows nothing of it is read */
    const struct solver_totals *totals = at->history != NULL && at->history->count > 0 ? at->history->totals : &none;
    column(at, "time", "s", &totals->time, stride);
    components(at, "linear_momentum", momentum_unit[dim], totals->linear, stride, 0, dim);
    /* A plane body turns about z alone, a line not at all. */
    components(at, "angular_momentum", angular_unit[dim], totals->angular, stride, dim == 3 ? 0 : 2, dim == 1 ? 2 : 3);
    column(at, "kinetic_energy", energy_unit[dim], &totals->kinetic, stride);
    column(at, "strain_energy", energy_unit[dim], &totals->strain, stride);
    column(at, "total_energy", energy_unit[dim], total_energy, 1);
    column(at, "external_work", energy_unit[dim], &totals->external, stride);
    if (at->history != NULL && at->history->flows) {
        column(at, "plastic_work", energy_unit[dim], &totals->plastic, stride);
    }
    if (at->history != NULL && at->history->incompressible) {
        column(at, "iterations", "-", &totals->iterations, stride);
        column(at, "volume_change", "-", &totals->volume_change, stride);
    }
    if (at->history != NULL && at->history->balanced) {
        column(at, "numerical_dissipation", energy_unit[dim], &totals->numerical, stride);
        column(at, "impact_loss", energy_unit[dim], &totals->impact, stride);
    }
    if (at->history != NULL && at->history->walled) {
        components(at, "wall_impulse", momentum_unit[dim], totals->wall, stride, 0, dim);
    }
    probe_columns(at, dim);
}

static bool names_fit(const struct solver_history *history, struct solver_error *error)
{
    const size_t most = SOLVER_NAME - sizeof "probe__u_x";
    for (size_t k = 0; history != NULL && k < history->probe_count; k++) {
        if (strlen(history->probe_name[k]) > most) {
            return solver_fail(error, SOLVER_BAD_INPUT,
                               "probe \"%s\": a record's column takes names of at most %zu characters",
                               history->probe_name[k], most);
        }
    }
    return true;
}

bool record_take_history(struct solver_record *record, const struct solver_history *history, struct solver_error *error)
{
    if (!names_fit(history, error)) {
        return false;
    }
    struct columns at = {.record = record, .history = history};
    all_columns(&at, NULL); /* counts */
    record->history_count = history == NULL ? 0 : history->count;
    record->history_columns = at.next;
    const size_t rows = record->history_count;
    void *name, *unit, *value, *energy;
    if (!solver_alloc(&name, at.next, sizeof *record->history_name, "record's history", error)) {
        return false;
    }
    record->history_name = name;
    if (!solver_alloc(&unit, at.next, sizeof *record->history_unit, "record's history", error)) {
        return false;
    }
    record->history_unit = unit;
    if (!solver_alloc(&value, rows * at.next, sizeof(double), "record's history", error)) {
        return false;
    }
    record->history = value;
    if (!solver_alloc(&energy, rows, sizeof(double), "record's history", error)) {
        return false;
    }
    double *total = energy;
    for (size_t row = 0; row < rows; row++) {
        total[row] = history->totals[row].kinetic + history->totals[row].strain;
    }
    at.next = 0;
    all_columns(&at, total);
    free(energy);
    return true;
}
