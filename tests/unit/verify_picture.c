/* Which number of a record a picture shows. */
#include "tests/unit/body.h"
#include "tests/unit/unit.h"
#include "verify/picture.h"

#include <math.h>

static struct solver_record *made(int dim)
{
    struct solver_record *record = NULL;
    struct solver_error error;
    struct body *body = body_make(dim);
    CU_ASSERT_TRUE_FATAL(body_record(body, &record, &error));
    free(body);
    return record;
}

/* The largest value that a picture of `name` has on its scale, where the field's column is -8 and all others are 0. */
static bool shows(struct solver_record *record, const char *field, size_t column, const char *name)
{
    const struct solver_record_field *of = solver_record_find(record, field);
    struct solver_view view = {.magnify = 1}, whole;
    struct solver_error error;
    CU_ASSERT_PTR_NOT_NULL_FATAL(of);
    for (size_t i = 0; i < record->count * (size_t)of->width; i++) {
        of->value[i] = i % (size_t)of->width == column ? -8.0 : 0.0;
    }
    (void)snprintf(view.field, sizeof view.field, "%s", name);
    CU_ASSERT_TRUE_FATAL(verify_picture_view(record, &view, &whole, &error));
    return whole.range[0] == -12 && whole.range[1] == -4;
}

/* P_xy is the traction along x on the face along Y: row x, column Y. F and P are not symmetric. */
static void components(void)
{
    static const char *const tensors[] = {"P", "F", "sigma"};
    struct solver_record *record = made(3);
    for (size_t t = 0; t < sizeof tensors / sizeof *tensors; t++) {
        for (size_t i = 0; i < 9; i++) {
            for (size_t c = 0; c < 9; c++) {
                char name[16];
                (void)snprintf(name, sizeof name, "%s_%c%c", tensors[t], "xyz"[i / 3], "xyz"[i % 3]);
                CU_ASSERT_EQUAL(shows(record, tensors[t], c, name), c == i);
            }
        }
    }
    for (size_t i = 0; i < 3; i++) {
        for (size_t c = 0; c < 3; c++) {
            char name[16];
            (void)snprintf(name, sizeof name, "velocity_%c", "xyz"[i]);
            CU_ASSERT_EQUAL(shows(record, "velocity", c, name), c == i);
        }
    }
    solver_record_free(record);
}

/* What a view leaves open: a plane is seen face on, a body in space from a corner; what it says stays. */
static void what_is_left_open(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct solver_record *record = made(dim);
        struct solver_view whole;
        const struct solver_view view = {.field = "pressure", .range = {1, 9}, .direction = {1, 2, 3}, .bands = 7};
        struct solver_error error;
        CU_ASSERT_TRUE_FATAL(verify_picture_view(record, NULL, &whole, &error));
        CU_ASSERT_STRING_EQUAL(whole.field, "pressure");
        CU_ASSERT_EQUAL(whole.direction[0] == 0 && whole.direction[1] == 0 && whole.direction[2] == 1, dim < 3);
        CU_ASSERT(whole.range[0] < whole.range[1] && whole.bands > 0);
        CU_ASSERT_TRUE_FATAL(verify_picture_view(record, &view, &whole, &error));
        CU_ASSERT(whole.range[0] == 1 && whole.range[1] == 9 && whole.bands == 7 && whole.direction[1] == 2);
        solver_record_free(record);
    }
}

static void no_such_field(void)
{
    struct solver_record *record = made(2);
    static const char *const names[] = {"vonmises", "P_xw", "P_x", "velocity_xy", "P_", "", "P"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        struct solver_view view = {.magnify = 1}, whole;
        struct solver_error error = {.text = ""};
        (void)snprintf(view.field, sizeof view.field, "%s", names[i]);
        CU_ASSERT_FALSE(verify_picture_view(record, &view, &whole, &error));
        CU_ASSERT(error.code == SOLVER_BAD_INPUT && strstr(error.text, "its fields are") != NULL);
    }
    solver_record_free(record);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"components", components},
        {"what is left open", what_is_left_open},
        {"no such field", no_such_field},
    };
    return unit_main("picture", tests, sizeof tests / sizeof *tests);
}
