/* The comparison of pictures on drawings made by hand; tests/image calibrates it on real ones. */
#include "render/image.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 64 };

/* A white picture whose body rectangle leaves a rim of 8 pixels. */
static struct render_image *blank(void)
{
    struct render_image *image = render_image_create(SIDE, SIDE);
    if (!image)
        abort();
    const int body[4] = {8, 8, SIDE - 8, SIDE - 8};
    memcpy(image->body, body, sizeof body);
    memset(image->rgb, 255, SIDE * SIDE * 3);
    return image;
}

static void fill(struct render_image *image, int x0, int y0, int x1, int y1, uint8_t level)
{
    for (int y = y0; y < y1; y++)
        memset(image->rgb + 3 * (y * SIDE + x0), level, 3 * (size_t)(x1 - x0));
}

static struct render_difference compare(const struct render_image *stored, const struct render_image *fresh)
{
    struct render_difference difference;
    char why[RENDER_WHY] = "";
    CU_ASSERT_TRUE_FATAL(render_compare(stored, fresh, false, &difference, why));
    CU_ASSERT_PTR_NULL(difference.picture);
    return difference;
}

/* A blot of 6 x 6 pixels in the third tile of the second row; both ways round. */
static void a_blot_is_counted_and_placed(void)
{
    struct render_image *stored = blank(), *fresh = blank();
    fill(fresh, 42, 26, 48, 32, 0);
    for (int turn = 0; turn < 2; turn++) {
        const struct render_difference d = turn ? compare(fresh, stored) : compare(stored, fresh);
        CU_ASSERT_FALSE(d.same);
        CU_ASSERT_DOUBLE_EQUAL(d.fraction, 36.0 / (48 * 48), 1e-12);
        CU_ASSERT_DOUBLE_EQUAL(d.worst_tile, 36.0 / 256, 1e-12);
        CU_ASSERT_EQUAL(d.tile[0], 40);
        CU_ASSERT_EQUAL(d.tile[1], 24);
        CU_ASSERT_DOUBLE_EQUAL(d.mean_delta_e, 36 * 100.0 / (48 * 48), 1e-3);
    }
    render_image_free(stored);
    render_image_free(fresh);
}

static void outside_the_rectangle_nothing_counts(void)
{
    struct render_image *stored = blank(), *fresh = blank();
    fill(fresh, 0, 0, SIDE, 8, 0);
    fill(fresh, SIDE - 8, 0, SIDE, SIDE, 90);
    const struct render_difference d = compare(stored, fresh);
    CU_ASSERT_TRUE(d.same);
    CU_ASSERT_EQUAL(d.fraction, 0);
    CU_ASSERT_EQUAL(d.mean_delta_e, 0);
    render_image_free(stored);
    render_image_free(fresh);
}

/* A pixel's shift is forgiven, two are not; and a line that vanishes is seen although white is everywhere near it. */
static void shifts_and_thin_lines(void)
{
    struct render_image *stored = blank(), *one = blank(), *two = blank(), *none = blank();
    fill(stored, 30, 10, 31, 50, 0);
    fill(one, 31, 10, 32, 50, 0);
    fill(two, 32, 10, 33, 50, 0);
    CU_ASSERT_TRUE(compare(stored, one).same);
    CU_ASSERT_EQUAL(compare(stored, one).fraction, 0);
    CU_ASSERT_FALSE(compare(stored, two).same);
    CU_ASSERT_FALSE(compare(stored, none).same);
    CU_ASSERT_FALSE(compare(none, stored).same);
    /* likewise up and down, forth and back */
    for (int way = 0; way < 4; way++) {
        for (int by = 1; by <= 2; by++) {
            struct render_image *line = blank(), *moved = blank();
            int shift = way % 2 == 0 ? by : -by, x = way < 2 ? shift : 0, y = way < 2 ? 0 : shift;
            fill(line, 20, 30, way < 2 ? 21 : 50, way < 2 ? 50 : 31, 0);
            fill(moved, 20 + x, 30 + y, way < 2 ? 21 + x : 50, way < 2 ? 50 : 31 + y, 0);
            CU_ASSERT_EQUAL(compare(line, moved).same, by == 1);
            render_image_free(line);
            render_image_free(moved);
        }
    }
    render_image_free(stored);
    render_image_free(one);
    render_image_free(two);
    render_image_free(none);
}

/* Just below and just above what counts as visible: grey levels 128 and 128 + k differ by 0.4 k in L*. */
static void small_differences_of_colour(void)
{
    struct render_image *stored = blank(), *near = blank(), *far = blank();
    fill(stored, 8, 8, 56, 56, 128);
    fill(near, 8, 8, 56, 56, 137);
    fill(far, 8, 8, 56, 56, 140);
    CU_ASSERT_TRUE(compare(stored, near).same);
    CU_ASSERT_TRUE(compare(stored, near).mean_delta_e > 3);
    CU_ASSERT_FALSE(compare(stored, far).same);
    CU_ASSERT_EQUAL(compare(stored, far).fraction, 1);
    render_image_free(stored);
    render_image_free(near);
    render_image_free(far);
}

/* Each share has a bound of its own; at the bound they still show the same, and a NaN shows nothing. */
static void within_a_tolerance(void)
{
    const struct render_tolerance limit = {.fraction = 0.25, .worst_tile = 0.5};
    CU_ASSERT_TRUE(render_within(&(struct render_difference){.fraction = 0.25, .worst_tile = 0.5}, limit));
    CU_ASSERT_FALSE(render_within(&(struct render_difference){.fraction = 0.26, .worst_tile = 0.5}, limit));
    CU_ASSERT_FALSE(render_within(&(struct render_difference){.fraction = 0.25, .worst_tile = 0.51}, limit));
    CU_ASSERT_FALSE(render_within(&(struct render_difference){.fraction = NAN, .worst_tile = 0}, limit));
    /* What assay compare --help says. */
    CU_ASSERT_EQUAL(render_tolerance_default.fraction, 0.0005);
    CU_ASSERT_EQUAL(render_tolerance_default.worst_tile, 0.02);
}

static void the_difference_is_shown(void)
{
    struct render_image *stored = blank(), *fresh = blank();
    fill(fresh, 42, 26, 48, 32, 0);
    struct render_difference d;
    char why[RENDER_WHY];
    CU_ASSERT_TRUE_FATAL(render_compare(stored, fresh, true, &d, why));
    CU_ASSERT_PTR_NOT_NULL_FATAL(d.picture);
    CU_ASSERT_TRUE(d.picture->width == SIDE && d.picture->height == SIDE);
    const uint8_t *blot = d.picture->rgb + 3 * (28 * SIDE + 44), *rest = d.picture->rgb + 3 * (50 * SIDE + 20);
    CU_ASSERT_TRUE(blot[0] > 100 && blot[1] == 0 && blot[2] == 0);
    CU_ASSERT_TRUE(rest[0] == rest[1] && rest[1] == rest[2] && rest[0] > 240);
    render_image_free(d.picture);
    render_image_free(stored);
    render_image_free(fresh);
}

static void refuses(const struct render_image *stored, const struct render_image *fresh, const char *expected)
{
    struct render_difference d;
    char why[RENDER_WHY] = "";
    CU_ASSERT_FALSE(render_compare(stored, fresh, true, &d, why));
    CU_ASSERT_PTR_NULL(d.picture);
    CU_ASSERT_FALSE(d.same);
    CU_ASSERT_PTR_NOT_NULL(strstr(why, expected));
}

static void what_cannot_be_compared_is_refused(void)
{
    struct render_image *stored = blank(), *fresh = blank(), *narrow = render_image_create(SIDE - 1, SIDE);
    CU_ASSERT_PTR_NOT_NULL_FATAL(narrow);
    refuses(stored, narrow, "64 x 64");
    fresh->body[0]++;
    refuses(stored, fresh, "rectangle");
    stored->body[0] = fresh->body[0] = -1;
    refuses(stored, fresh, "rectangle");
    stored->body[0] = fresh->body[0] = 8;
    stored->body[3] = fresh->body[3] = SIDE + 1;
    refuses(stored, fresh, "rectangle");
    render_image_free(stored);
    render_image_free(fresh);
    render_image_free(narrow);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"a blot is counted and placed", a_blot_is_counted_and_placed},
        {"outside the rectangle nothing counts", outside_the_rectangle_nothing_counts},
        {"shifts and thin lines", shifts_and_thin_lines},
        {"small differences of colour", small_differences_of_colour},
        {"within a tolerance", within_a_tolerance},
        {"the difference is shown", the_difference_is_shown},
        {"what cannot be compared is refused", what_cannot_be_compared_is_refused},
    };
    return unit_main("render compare", tests, sizeof tests / sizeof *tests);
}
