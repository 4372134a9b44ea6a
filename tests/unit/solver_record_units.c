/* Records: the unit of every field and column, by dimension. What is summed over the body is per unit thickness in 2D,
 * per unit area in 1D. */
#include "tests/unit/body.h"
#include "tests/unit/unit.h"

static const char *unit_of_column(const struct solver_record *record, const char *name)
{
    for (size_t c = 0; c < record->history_columns; c++) {
        if (strcmp(record->history_name[c], name) == 0) {
            return record->history_unit[c];
        }
    }
    return "no such column";
}

/* What there is of `name` has this unit; `found` counts it. */
static void expect_unit(const char *name, const char *unit, const char *expected, size_t *found)
{
    if (strcmp(unit, expected) != 0) {
        printf("\n    %s: %s, expected %s", name, unit, expected);
    }
    CU_ASSERT_STRING_EQUAL(unit, expected);
    *found += 1;
}

static void fields(void)
{
    static const char *const volumes[] = {"", "m", "m^2", "m^3"};
    for (int dim = 1; dim <= 3; dim++) {
        const char *const units[][2] = {{"F", "-"},
                                        {"H", "-"},
                                        {"J", "-"},
                                        {"P", "Pa"},
                                        {"displacement", "m"},
                                        {"momentum", "kg/(m^2 s)"},
                                        {"pressure", "Pa"},
                                        {"sigma", "Pa"},
                                        {"tags", "-"},
                                        {"velocity", "m/s"},
                                        {"volume", volumes[dim]},
                                        {"von_mises", "Pa"}};
        struct body *body = body_make(dim);
        struct solver_record *record = NULL;
        struct solver_error error;
        CU_ASSERT_FATAL(body_record(body, &record, &error));
        size_t found = 0;
        for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
            const struct solver_record_field *field = solver_record_find(record, units[i][0]);
            CU_ASSERT_PTR_NOT_NULL_FATAL(field);
            expect_unit(units[i][0], field->unit, units[i][1], &found);
        }
        CU_ASSERT_EQUAL(found, record->field_count); /* there is no field whose unit was not looked at */
        solver_record_free(record);
        free(body);
    }
}

static void columns(void)
{
    static const char *const momentum[] = {"", "kg/(m s)", "kg/s", "kg m/s"};
    static const char *const angular[] = {"", "", "kg m/s", "kg m^2/s"};
    static const char *const energy[] = {"", "J/m^2", "J/m", "J"};
    static const char *const energies[] = {"kinetic_energy", "strain_energy", "total_energy", "external_work"};
    for (int dim = 1; dim <= 3; dim++) {
        struct body *body = body_make(dim);
        struct solver_record *record = NULL;
        struct solver_error error;
        CU_ASSERT_FATAL(body_record(body, &record, &error));
        size_t found = 0;
        expect_unit("time", unit_of_column(record, "time"), "s", &found);
        for (size_t i = 0; i < 4; i++) {
            expect_unit(energies[i], unit_of_column(record, energies[i]), energy[dim], &found);
        }
        for (int i = 0; i < 3; i++) {
            char linear[] = "linear_momentum_x", turning[] = "angular_momentum_x", u[] = "probe_corner_u_x",
                 v[] = "probe_middle_v_x";
            linear[sizeof linear - 2] = turning[sizeof turning - 2] = u[sizeof u - 2] = v[sizeof v - 2] = "xyz"[i];
            if (i < dim) {
                expect_unit(linear, unit_of_column(record, linear), momentum[dim], &found);
                expect_unit(u, unit_of_column(record, u), "m", &found);
                expect_unit(v, unit_of_column(record, v), "m/s", &found);
            }
            if (dim == 3 || (dim == 2 && i == 2)) { /* a plane body turns about z alone, a line not at all */
                expect_unit(turning, unit_of_column(record, turning), angular[dim], &found);
            }
        }
        /* of each of the two probes, one of the two vectors was looked at */
        CU_ASSERT_EQUAL(found + 2 * (size_t)dim, record->history_columns);
        solver_record_free(record);
        free(body);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"units of fields", fields},
        {"units of the time history", columns},
    };
    return unit_main("units of records", tests, sizeof tests / sizeof *tests);
}
