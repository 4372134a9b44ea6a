/* Bounds of the comparison with golden records, by the formula they are derived from. */
#include "golden/golden.h"
#include "tests/unit/body.h"
#include "tests/unit/unit.h"

#include <float.h>

static double field_norm(const struct solver_record *record, const char *name)
{
    const struct solver_record_field *field = solver_record_find(record, name);
    double most = 0.0;
    for (size_t i = 0; i < record->count * (size_t)field->width; i++) {
        most = fmax(most, fabs(field->value[i]));
    }
    return most;
}

static struct solver_record *made(void)
{
    struct solver_record *record = NULL;
    struct solver_error error;
    struct body *body = body_make(3);
    CU_ASSERT_TRUE_FATAL(body_record(body, &record, &error));
    free(body);
    return record;
}

/* Bounds are what tolerance.c derives, to their digits: 8 u sqrt(4 (N + 1)) (1/dev + 16) of a field's scale, of F by
 * its distance from the identity and its last bit. */
static void bounds_as_derived(void)
{
    const double u = DBL_EPSILON / 2.0;
    for (size_t step = 0; step < 5000; step += 1111) {
        struct solver_record *record = made();
        double *F = solver_record_find(record, "F")->value, dev = 0.0;
        for (size_t i = 0; i < 9 * record->count; i++) {
            const double unit = i % 9 % 4 == 0 ? 1.0 : 0.0;
            F[i] = unit + 30.0 * (F[i] - unit);
            dev = fmax(dev, fabs(F[i] - unit));
        }
        record->step = step;
        const double r = 8.0 * u * sqrt(4.0 * (double)(step + 1)) * (1.0 / dev + 16.0);
        struct golden_report report;
        struct solver_error error;
        CU_ASSERT_FATAL(golden_compare(record, record, &report, &error));
        size_t found = 0;
        for (size_t i = 0; i < report.count; i++) {
            const struct golden_line *line = &report.line[i];
            const bool is_F = strcmp(line->field, "F") == 0;
            if (is_F || strcmp(line->field, "P") == 0 || strcmp(line->field, "velocity") == 0) {
                const double bound = is_F ? r * dev + 2.0 * u : r * field_norm(record, line->field);
                CU_ASSERT_DOUBLE_EQUAL(line->bound / bound, 1.0, 1e-12);
                found++;
            }
        }
        CU_ASSERT_EQUAL(found, 3);
        golden_report_free(&report);
        solver_record_free(record);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {{"bounds as derived", bounds_as_derived}};
    return unit_main("golden bounds", tests, sizeof tests / sizeof *tests);
}
