/* The comparison with golden records is itself tested with records that must differ: in every field and column, in both
 * directions, at every size down to none. */
#include "golden/golden.h"
#include "tests/unit/body.h"
#include "tests/unit/scratch.h"
#include "tests/unit/unit.h"

#include <float.h>
#include <unistd.h>

enum { LINES_BEFORE_FIELDS = 1 }; /* the end time */

static struct solver_record *made(void)
{
    struct solver_record *record;
    struct solver_error error;
    struct body *body = body_make(3);
    for (size_t r = 0; r < BODY_ROWS; r++) { /* a net momentum of the size of sum V |p|, as of a body that flies */
        for (size_t i = 0; i < 3; i++) {
            body->totals[r].linear[i] *= 1e4;
            body->totals[r].angular[i] *= 1e4;
        }
    }
    bool ok = body_record(body, &record, &error);
    free(body);
    CU_ASSERT_FATAL(ok);
    return record;
}

/* A stored and a fresh record, equal until a test changes one. */
struct pair {
    struct solver_record *a, *b;
};

static struct pair pair_make(void)
{
    return (struct pair){made(), made()};
}

static void pair_free(struct pair *pair)
{
    solver_record_free(pair->a);
    solver_record_free(pair->b);
}

static bool passes(const struct solver_record *stored, const struct solver_record *fresh)
{
    struct golden_report report;
    struct solver_error error;
    bool pass = golden_compare(stored, fresh, &report, &error) && report.pass;
    golden_report_free(&report);
    return pass;
}

/* Both ways the same answer, or the comparison is blind in one eye. */
static bool passes_both_ways(const struct pair *pair)
{
    bool forth = passes(pair->a, pair->b), back = passes(pair->b, pair->a);
    CU_ASSERT_EQUAL(forth, back);
    return forth && back;
}

/* Fails, and in this line alone. */
static bool only_line_fails(const struct solver_record *stored, const struct solver_record *fresh, size_t line)
{
    struct golden_report report;
    struct solver_error error;
    bool as_meant = golden_compare(stored, fresh, &report, &error) && !report.pass;
    for (size_t i = 0; as_meant && i < report.count; i++) {
        as_meant = report.line[i].pass == (i != line);
    }
    golden_report_free(&report);
    return as_meant;
}

/* Refused with an error that has `word`, both ways. */
static void refused(const struct pair *pair, const char *word)
{
    for (int way = 0; way < 2; way++) {
        struct golden_report report;
        struct solver_error error = {.text = ""};
        CU_ASSERT_FALSE(golden_compare(way ? pair->b : pair->a, way ? pair->a : pair->b, &report, &error));
        CU_ASSERT(error.code == SOLVER_BAD_INPUT && strstr(error.text, word) != NULL);
        CU_ASSERT(report.line == NULL);
    }
}

static double norm(const double *value, size_t count, size_t stride)
{
    double most = 0.0;
    for (size_t i = 0; i < count; i++) {
        most = fmax(most, fabs(value[i * stride]));
    }
    return most;
}

static double field_norm(const struct solver_record *record, const char *name)
{
    const struct solver_record_field *field = solver_record_find(record, name);
    return norm(field->value, record->count * (size_t)field->width, 1);
}

static void equal_records(void)
{
    struct pair pair = pair_make();
    struct golden_report report;
    struct solver_error error;
    CU_ASSERT_FATAL(golden_compare(pair.a, pair.b, &report, &error));
    CU_ASSERT(report.pass);
    CU_ASSERT_EQUAL(report.count, LINES_BEFORE_FIELDS + pair.a->field_count + pair.a->history_columns);
    for (size_t i = 0; i < report.count; i++) {
        CU_ASSERT(report.line[i].pass && report.line[i].difference == 0.0 && report.line[i].field[0] != '\0');
    }
    golden_report_free(&report);
    CU_ASSERT(passes_both_ways(&pair));
    pair_free(&pair);
}

/* Changes *value by a tenth digit (caught), a fifteenth (passes) and to what is no number (caught). */
static void try_value(const struct pair *pair, double *value, double scale, size_t line)
{
    const double was = *value;
    for (int sign = -1; sign <= 1; sign += 2) {
        *value = was + sign * 1e-10 * scale;
        CU_ASSERT(only_line_fails(pair->a, pair->b, line) && only_line_fails(pair->b, pair->a, line));
        *value = was + sign * 1e-15 * scale;
        CU_ASSERT(passes_both_ways(pair));
    }
    static const double none[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        *value = none[i];
        CU_ASSERT(!passes_both_ways(pair));
    }
    *value = was;
}

static void every_field(void)
{
    struct pair pair = pair_make();
    const size_t count = pair.b->count;
    for (size_t i = 0; i < pair.b->field_count; i++) {
        struct solver_record_field *field = &pair.b->field[i];
        const size_t width = (size_t)field->width;
        const double scale = norm(field->value, count * width, 1);
        if (strcmp(field->name, "tags") == 0) { /* whole numbers: exact */
            field->value[7] += 1.0;
            CU_ASSERT(only_line_fails(pair.a, pair.b, LINES_BEFORE_FIELDS + i));
            field->value[7] -= 1.0;
            continue;
        }
        for (size_t k = 0; k < width; k++) {
            try_value(&pair, &field->value[k], scale, LINES_BEFORE_FIELDS + i);
            try_value(&pair, &field->value[count / 2 * width + k], scale, LINES_BEFORE_FIELDS + i);
            try_value(&pair, &field->value[(count - 1) * width + k], scale, LINES_BEFORE_FIELDS + i);
        }
    }
    CU_ASSERT(passes_both_ways(&pair));
    pair_free(&pair);
}

/* F, H and J are near one: what counts there is how far they are from it. */
static void deviation_from_identity(void)
{
    static const char *const near_one[] = {"F", "H", "J"};
    struct pair pair = pair_make();
    const double *F = solver_record_find(pair.a, "F")->value;
    double strain = 0.0;
    for (size_t i = 0; i < 9 * pair.a->count; i++) {
        strain = fmax(strain, fabs(F[i] - (i % 9 % 4 == 0)));
    }
    CU_ASSERT(strain > 1e-3 && strain < 1e-2);
    for (size_t i = 0; i < 3; i++) {
        double *value = solver_record_find(pair.b, near_one[i])->value;
        value[0] += 1e-10 * strain;
        CU_ASSERT(!passes_both_ways(&pair));
        value[0] = solver_record_find(pair.a, near_one[i])->value[0];
    }
    CU_ASSERT(passes_both_ways(&pair));
    pair_free(&pair);
}

static void drop_field(struct solver_record *record, const char *name)
{
    struct solver_record_field *last = &record->field[record->field_count], *field = record->field;
    while (field < last && strcmp(field->name, name) != 0) {
        field++;
    }
    CU_ASSERT_FATAL(field < last);
    free(field->value);
    memmove(field, field + 1, (size_t)(last - field - 1) * sizeof *field);
    record->field_count--;
}

/* Of a scheme without F the distance of J from one is what counts, and the comparison is neither blind nor strict. */
static void without_deformation(void)
{
    struct pair pair = pair_make();
    drop_field(pair.a, "F");
    refused(&pair, "no field F");
    drop_field(pair.b, "F");
    double *J = solver_record_find(pair.b, "J")->value, strain = 0.0;
    const double was = J[4];
    for (size_t a = 0; a < pair.b->count; a++) {
        strain = fmax(strain, fabs(J[a] - 1.0));
    }
    CU_ASSERT(strain > 1e-3 && strain < 3e-2);
    J[4] = was + 1e-10 * strain;
    CU_ASSERT(!passes_both_ways(&pair));
    J[4] = was + 1e-15;
    CU_ASSERT(passes_both_ways(&pair));
    J[4] = was;
    double *sigma = solver_record_find(pair.b, "sigma")->value;
    sigma[13] += 1e-10 * field_norm(pair.a, "sigma");
    CU_ASSERT(!passes_both_ways(&pair));
    pair_free(&pair);
}

static void every_column(void)
{
    struct pair pair = pair_make();
    const size_t columns = pair.b->history_columns, rows = pair.b->history_count;
    for (size_t c = 0; c < columns; c++) {
        const char *name = pair.b->history_name[c];
        double scale = norm(pair.b->history + c, rows, columns);
        if (strncmp(name, "probe_", 6) == 0) { /* a probe is one particle of the field */
            scale = fmax(scale, field_norm(pair.b, strstr(name, "_u_") != NULL ? "displacement" : "velocity"));
        }
        if (strcmp(name, "external_work") == 0) { /* a part of the energy balance */
            scale = norm(pair.b->history + c - 1, rows, columns);
        }
        CU_ASSERT(scale > 0.0);
        for (size_t row = 0; row < rows; row++) {
            try_value(&pair, &pair.b->history[row * columns + c], scale, LINES_BEFORE_FIELDS + pair.b->field_count + c);
        }
    }
    CU_ASSERT(passes_both_ways(&pair));
    pair_free(&pair);
}

/* The same NaN on both sides is no agreement. */
static void not_a_number_on_both_sides(void)
{
    unit_untrapped();
    struct pair pair = pair_make();
    for (size_t i = 0; i < pair.a->field_count; i++) {
        double *a = &pair.a->field[i].value[3], *b = &pair.b->field[i].value[3];
        const double was = *a;
        *a = *b = (double)NAN;
        CU_ASSERT(!passes_both_ways(&pair));
        *a = *b = (double)INFINITY;
        CU_ASSERT(!passes_both_ways(&pair));
        *a = *b = was;
    }
    pair.a->history[2] = pair.b->history[2] = (double)NAN;
    CU_ASSERT(!passes_both_ways(&pair));
    pair.a->history[2] = pair.b->history[2] = 0.0;
    pair.a->X[4] = pair.b->X[4] = (double)NAN;
    refused(&pair, "particle 1");
    pair_free(&pair);
}

/* The bound never passes half of 1e-10 of the scale, however small the strain and however long the run. */
static void never_blind(void)
{
    struct pair pair = pair_make();
    for (size_t i = 0; i < 9 * pair.a->count; i++) {
        const double unit = i % 9 % 4 == 0 ? 1.0 : 0.0;
        double *F = solver_record_find(pair.a, "F")->value;
        F[i] = unit + 1e-9 * (F[i] - unit);
    }
    pair.a->step = pair.b->step = 100000000;
    struct golden_report report;
    struct solver_error error;
    CU_ASSERT_FATAL(golden_compare(pair.a, pair.a, &report, &error));
    for (size_t i = 0; i < pair.a->field_count; i++) {
        const struct golden_line *line = &report.line[LINES_BEFORE_FIELDS + i];
        CU_ASSERT(line->bound < 0.51e-10 * fmax(field_norm(pair.a, line->field), field_norm(pair.a, "P")));
    }
    CU_ASSERT(report.pass);
    golden_report_free(&report);
    double *velocity = solver_record_find(pair.a, "velocity")->value;
    velocity[5] += 1e-10 * field_norm(pair.a, "velocity");
    CU_ASSERT(!passes(pair.a, pair.b));
    pair_free(&pair);
}

/* Nor that of columns whose entries cancel, which are measured by what cancels: sum V |p|, and that at the farthest
 * particle. */
static void never_blind_where_momenta_cancel(void)
{
    struct solver_record *record = made();
    const double *p = solver_record_find(record, "momentum")->value, *V = solver_record_find(record, "volume")->value;
    double *F = solver_record_find(record, "F")->value;
    double momentum = 0.0, reach = norm(record->X, 3 * record->count, 1);
    for (size_t a = 0; a < record->count; a++) {
        momentum += V[a] * sqrt(p[3 * a] * p[3 * a] + p[3 * a + 1] * p[3 * a + 1] + p[3 * a + 2] * p[3 * a + 2]);
    }
    for (size_t i = 0; i < 9 * record->count; i++) {
        const double unit = i % 9 % 4 == 0 ? 1.0 : 0.0;
        F[i] = unit + 1e-9 * (F[i] - unit);
    }
    record->step = 100000000;
    size_t found = 0;
    for (size_t c = 0; c < record->history_columns; c++) {
        bool moments = strstr(record->history_name[c], "_momentum") != NULL;
        for (size_t row = 0; moments && row < record->history_count; row++) {
            record->history[row * record->history_columns + c] = 0.0;
        }
    }
    struct golden_report report;
    struct solver_error error;
    CU_ASSERT_FATAL(golden_compare(record, record, &report, &error));
    for (size_t i = 0; i < report.count; i++) {
        bool angular = strncmp(report.line[i].field, "angular_momentum", 16) == 0;
        if (angular || strncmp(report.line[i].field, "linear_momentum", 15) == 0) {
            CU_ASSERT_DOUBLE_EQUAL(report.line[i].bound / (momentum * (angular ? reach : 1.0)), 5e-11, 1e-20);
            found++;
        }
    }
    CU_ASSERT_EQUAL(found, 6);
    golden_report_free(&report);
    solver_record_free(record);
}

/* Times and places may differ by the last bits of what makes them, and by no more. */
static void last_bits(void)
{
    struct pair pair = pair_make();
    const double steps = (double)pair.a->step + 1.0, reach = norm(pair.a->X, 3 * pair.a->count, 1);
    const double was = pair.b->X[4];
    pair.b->time = pair.a->time * (1.0 + 2.0 * DBL_EPSILON * steps);
    CU_ASSERT(passes_both_ways(&pair));
    pair.b->time = pair.a->time * (1.0 + 8.0 * DBL_EPSILON * steps);
    CU_ASSERT(!passes_both_ways(&pair));
    pair.b->time = pair.a->time;
    pair.b->X[4] = was + 4.0 * DBL_EPSILON * reach;
    CU_ASSERT(passes_both_ways(&pair));
    pair.b->X[4] = was + 16.0 * DBL_EPSILON * reach;
    refused(&pair, "Y of particle 1");
    pair_free(&pair);
}

static void other_bodies(void)
{
    struct pair pair = pair_make();
    pair.b->count--;
    refused(&pair, "particles");
    pair.b->count++;
    pair.b->step++;
    refused(&pair, "steps");
    pair.b->step--;
    pair.b->dim = 2;
    refused(&pair, "dimension");
    pair.b->dim = 3;
    pair.b->cell_count--;
    refused(&pair, "cells");
    pair.b->cell_count++;
    pair.b->cell[9]++;
    refused(&pair, "corner 9");
    pair.b->cell[9]--;
    pair.b->scene_name[0]++;
    refused(&pair, "scene");
    pair.b->scene_name[0]--;
    pair.b->time *= 1.0 + 1e-10;
    CU_ASSERT(!passes_both_ways(&pair));
    pair.b->time = pair.a->time;
    for (size_t i = 0; i < 3; i++) { /* the same particles in another order */
        const double first = pair.b->X[i];
        pair.b->X[i] = pair.b->X[3 + i];
        pair.b->X[3 + i] = first;
    }
    refused(&pair, "particle 0");
    pair_free(&pair);
}

static void other_fields(void)
{
    struct pair pair = pair_make();
    struct solver_record_field *last = &pair.b->field[pair.b->field_count - 1];
    pair.b->field_count--;
    refused(&pair, "von_mises");
    pair.b->field_count++;
    last->name[0] = 'x';
    refused(&pair, "on_mises");
    last->name[0] = 'v';
    last->unit[0] = 'x';
    refused(&pair, "von_mises");
    last->unit[0] = 'P';
    struct solver_record_field *lasts[] = {last, &pair.a->field[pair.a->field_count - 1]};
    for (size_t i = 0; i < 2; i++) { /* one name twice, in both: the second would hide behind the first */
        (void)snprintf(lasts[i]->name, sizeof lasts[i]->name, "volume");
        (void)snprintf(lasts[i]->unit, sizeof lasts[i]->unit, "m^3");
    }
    refused(&pair, "volume stands twice");
    for (size_t i = 0; i < 2; i++) {
        (void)snprintf(lasts[i]->name, sizeof lasts[i]->name, "von_mises");
        (void)snprintf(lasts[i]->unit, sizeof lasts[i]->unit, "Pa");
    }
    CU_ASSERT(passes_both_ways(&pair));
    pair.b->field[0].width = 3;
    refused(&pair, "F");
    pair.b->field[0].width = 9;
    const size_t count = pair.a->field_count;
    pair.a->field_count = pair.b->field_count = 0;
    refused(&pair, "no fields");
    pair.a->field_count = pair.b->field_count = count;
    pair_free(&pair);
}

static void other_histories(void)
{
    struct pair pair = pair_make();
    const size_t rows = pair.a->history_count, columns = pair.a->history_columns;
    for (size_t fewer = 1; fewer <= rows; fewer++) { /* down to none, on one side */
        pair.b->history_count = rows - fewer;
        refused(&pair, "rows");
    }
    pair.a->history_count = 0; /* none on both: nothing compared is nothing passed */
    refused(&pair, "no rows");
    pair.a->history_count = pair.b->history_count = rows;
    pair.b->history_columns--;
    refused(&pair, "columns");
    pair.a->history_columns = pair.b->history_columns = 0;
    refused(&pair, "no columns");
    pair.a->history_columns = pair.b->history_columns = columns;
    pair.b->history_name[3][0] = 'x';
    refused(&pair, "column 3");
    pair.b->history_name[3][0] = pair.a->history_name[3][0];
    pair.b->history_unit[4][0] = 'x';
    refused(&pair, "column 4");
    pair.b->history_unit[4][0] = pair.a->history_unit[4][0];
    const size_t count = pair.a->count;
    pair.a->count = pair.b->count = 0;
    refused(&pair, "no particles");
    pair.a->count = pair.b->count = count;
    CU_ASSERT(passes_both_ways(&pair));
    pair_free(&pair);
}

static bool compare_with_file(const char *path, const struct solver_record *fresh, struct golden_report *report)
{
    struct solver_record *stored = NULL;
    struct solver_error error;
    CU_ASSERT_FATAL(solver_record_read(path, &stored, &error) && golden_compare(stored, fresh, report, &error));
    solver_record_free(stored);
    return report->pass;
}

static void through_a_file(void)
{
    char folder[SCRATCH], path[SCRATCH_BELOW];
    scratch_folder(folder);
    (void)snprintf(path, sizeof path, "%s/body.h5", folder);
    struct pair pair = pair_make();
    struct golden_report report;
    struct solver_error error;
    CU_ASSERT(solver_record_save(path, pair.a, &error));
    CU_ASSERT(compare_with_file(path, pair.b, &report));
    golden_report_free(&report);
    double *pressure = solver_record_find(pair.a, "pressure")->value;
    pressure[11] += 1e-10 * field_norm(pair.a, "P");
    CU_ASSERT(solver_record_save(path, pair.a, &error)); /* a stored value changed in its tenth digit */
    CU_ASSERT_FALSE(compare_with_file(path, pair.b, &report));
    for (size_t i = 0; i < report.count; i++) {
        const bool meant = strcmp(report.line[i].field, "pressure") == 0;
        CU_ASSERT_EQUAL(report.line[i].pass, !meant);
        CU_ASSERT(!meant || strstr(report.line[i].place, "particle 11") != NULL);
    }
    golden_report_free(&report);
    scratch_folder_remove(folder);
    pair_free(&pair);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"equal records", equal_records},
        {"every field in the tenth digit", every_field},
        {"F, H, J by their distance from identity", deviation_from_identity},
        {"without a deformation gradient", without_deformation},
        {"every column in the tenth digit", every_column},
        {"NaN on both sides", not_a_number_on_both_sides},
        {"never blind", never_blind},
        {"never blind where momenta cancel", never_blind_where_momenta_cancel},
        {"the last bits of times and places", last_bits},
        {"other bodies", other_bodies},
        {"other fields", other_fields},
        {"other histories", other_histories},
        {"through a file", through_a_file},
    };
    return unit_main("golden comparison", tests, sizeof tests / sizeof *tests);
}
