#include "golden/golden.h"
#include "golden/tolerance.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool refuse(struct solver_error *error, const char *what, const char *stored, const char *fresh)
{
    return solver_fail(error, SOLVER_BAD_INPUT,
                       "records cannot be compared: %s: the stored one has %.200s, the fresh one %.200s", what, stored,
                       fresh);
}

static bool same_number(const char *what, size_t stored, size_t fresh, struct solver_error *error)
{
    char a[32], b[32];
    (void)snprintf(a, sizeof a, "%zu", stored);
    (void)snprintf(b, sizeof b, "%zu", fresh);
    return stored == fresh || refuse(error, what, a, b);
}

static bool some(const char *what, size_t count, struct solver_error *error)
{
    return count > 0 || solver_fail(error, SOLVER_BAD_INPUT, "records cannot be compared: they have no %s", what);
}

/* The same particles in the same order, but for the last bits of a perturbed lattice. */
static bool same_places(const struct solver_record *stored, const struct solver_record *fresh,
                        struct solver_error *error)
{
    double reach = 0.0;
    for (size_t i = 0; i < 3 * stored->count; i++) {
        reach = fmax(reach, fabs(stored->X[i]));
    }
    for (size_t i = 0; i < 3 * stored->count; i++) {
        /* Written so that a NaN on either side is refused. */
        if (!(fabs(stored->X[i] - fresh->X[i]) <= 8.0 * DBL_EPSILON * reach) || !isfinite(stored->X[i])) {
            char what[64], a[32], b[32];
            (void)snprintf(what, sizeof what, "%c of particle %zu", "XYZ"[i % 3], i / 3);
            (void)snprintf(a, sizeof a, "%.17g m", stored->X[i]);
            (void)snprintf(b, sizeof b, "%.17g m", fresh->X[i]);
            return refuse(error, what, a, b);
        }
    }
    return true;
}

static bool same_cells(const struct solver_record *stored, const struct solver_record *fresh,
                       struct solver_error *error)
{
    const size_t corners = stored->cell_count * (size_t)stored->cell_width;
    for (size_t i = 0; i < corners; i++) {
        char what[64];
        (void)snprintf(what, sizeof what, "particle at corner %zu of all cells", i);
        if (!same_number(what, stored->cell[i], fresh->cell[i], error)) {
            return false;
        }
    }
    return true;
}

static bool same_body(const struct solver_record *stored, const struct solver_record *fresh, struct solver_error *error)
{
    if (strcmp(stored->scene_name, fresh->scene_name) != 0) {
        return refuse(error, "scene", stored->scene_name, fresh->scene_name);
    }
    return same_number("dimension", (size_t)stored->dim, (size_t)fresh->dim, error) &&
           same_number("particles", stored->count, fresh->count, error) && some("particles", stored->count, error) &&
           same_number("steps", stored->step, fresh->step, error) &&
           same_number("cells", stored->cell_count, fresh->cell_count, error) &&
           same_number("corners of a cell", (size_t)stored->cell_width, (size_t)fresh->cell_width, error) &&
           same_places(stored, fresh, error) && same_cells(stored, fresh, error);
}

/* Every field of each must be in the other; equal numbers of them alone would let two of one name stand for two. */
static bool fields_within(const struct solver_record *these, const struct solver_record *those, const char *where,
                          struct solver_error *error)
{
    for (size_t i = 0; i < these->field_count; i++) {
        const struct solver_record_field *field = &these->field[i], *other = solver_record_find(those, field->name);
        if (other == NULL) {
            return solver_fail(error, SOLVER_BAD_INPUT, "records cannot be compared: the %s record has no field %s",
                               where, field->name);
        }
        if (solver_record_find(these, field->name) != field) {
            return solver_fail(error, SOLVER_BAD_INPUT, "records cannot be compared: field %s stands twice in one",
                               field->name);
        }
        if (strcmp(field->unit, other->unit) != 0) {
            return refuse(error, field->name, field->unit, other->unit);
        }
        if (!same_number(field->name, (size_t)field->width, (size_t)other->width, error)) {
            return false;
        }
    }
    return true;
}

static bool same_columns(const struct solver_record *stored, const struct solver_record *fresh,
                         struct solver_error *error)
{
    if (!same_number("columns of the history", stored->history_columns, fresh->history_columns, error) ||
        !some("columns of history", stored->history_columns, error) ||
        !same_number("rows of the history", stored->history_count, fresh->history_count, error) ||
        !some("rows of history", stored->history_count, error)) {
        return false;
    }
    for (size_t c = 0; c < stored->history_columns; c++) {
        char what[64];
        (void)snprintf(what, sizeof what, "column %zu of the history", c);
        if (strcmp(stored->history_name[c], fresh->history_name[c]) != 0) {
            return refuse(error, what, stored->history_name[c], fresh->history_name[c]);
        }
        if (strcmp(stored->history_unit[c], fresh->history_unit[c]) != 0) {
            return refuse(error, what, stored->history_unit[c], fresh->history_unit[c]);
        }
    }
    return true;
}

/* Values to compare: `rows` rows of `width` neighbouring numbers, `stride` apart. */
struct series {
    const double *stored, *fresh;
    size_t rows, width, stride;
    const char *row_name; /* "particle", "row" */
};

/* The largest difference, and where. A NaN or an infinity counts as infinitely far, on either side and on both. */
static void compare_series(const struct series *series, double bound, struct golden_line *line)
{
    line->bound = bound;
    line->difference = -1.0;
    for (size_t row = 0; row < series->rows; row++) {
        for (size_t i = 0; i < series->width; i++) {
            const double a = series->stored[row * series->stride + i], b = series->fresh[row * series->stride + i];
            const double difference = isfinite(a) && isfinite(b) ? fabs(b - a) : (double)INFINITY;
            if (difference > line->difference) {
                line->difference = difference;
                (void)snprintf(line->place, sizeof line->place, "%s %zu, component %zu: stored %.17g, fresh %.17g",
                               series->row_name, row, i, a, b);
            }
        }
    }
    /* Nothing compared is nothing passed: the difference is then still -1. */
    line->pass = line->difference >= 0.0 && isfinite(bound) && line->difference <= bound;
}

static void compare_time(const struct solver_record *stored, const struct solver_record *fresh,
                         struct golden_line *line)
{
    const double steps = (double)stored->step + 1.0;
    const struct series series = {&stored->time, &fresh->time, 1, 1, 1, "end"};
    (void)snprintf(line->field, sizeof line->field, "end_time");
    /* A sum of as many steps, each of which carries the wave speed's round-off. */
    compare_series(&series, 4.0 * DBL_EPSILON * steps * fabs(stored->time), line);
}

bool golden_compare(const struct solver_record *stored, const struct solver_record *fresh, struct golden_report *report,
                    struct solver_error *error)
{
    *report = (struct golden_report){0};
    if (!same_body(stored, fresh, error) || !some("fields", stored->field_count, error) ||
        !fields_within(stored, fresh, "fresh", error) || !fields_within(fresh, stored, "stored", error) ||
        !same_columns(stored, fresh, error)) {
        return false;
    }
    const size_t count = 1 + stored->field_count + stored->history_columns;
    report->line = calloc(count, sizeof *report->line);
    if (report->line == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "comparison: no memory for %zu lines", count);
    }
    compare_time(stored, fresh, &report->line[report->count++]);
    for (size_t i = 0; i < stored->field_count; i++) {
        const struct solver_record_field *field = &stored->field[i];
        struct golden_line *line = &report->line[report->count++];
        const size_t width = (size_t)field->width;
        const struct series series = {
            field->value, solver_record_find(fresh, field->name)->value, stored->count, width, width, "particle"};
        (void)snprintf(line->field, sizeof line->field, "%s", field->name);
        compare_series(&series, golden_field_bound(stored, field), line);
    }
    for (size_t c = 0; c < stored->history_columns; c++) {
        struct golden_line *line = &report->line[report->count++];
        const struct series series = {
            stored->history + c, fresh->history + c, stored->history_count, 1, stored->history_columns, "row"};
        (void)snprintf(line->field, sizeof line->field, "%s", stored->history_name[c]);
        compare_series(&series, golden_column_bound(stored, c), line);
    }
    report->pass = true;
    for (size_t i = 0; i < report->count; i++) {
        report->pass = report->pass && report->line[i].pass;
    }
    return true;
}

void golden_report_free(struct golden_report *report)
{
    free(report->line);
    *report = (struct golden_report){0};
}
