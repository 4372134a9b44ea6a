/* Where holding ends, closed in on, and what a row of the map is worth. */
#include "tests/unit/unit.h"
#include "verify/extremes.h"

#include <math.h>
#include <stdio.h>

/* Holds from `from` to `to`. */
struct region {
    double from, to;
    int asked;
};

static bool within(void *with, double value, char *note, size_t size)
{
    struct region *region = with;
    region->asked++;
    if (value >= region->from && value <= region->to) {
        return true;
    }
    (void)snprintf(note, size, "%g is too %s", value, value > region->to ? "large" : "small");
    return false;
}

static const double width = 0.01;

static void closes_in(struct region region, double near, double far, double end)
{
    char note[64] = "";
    double holds, fails;
    verify_extreme_bisect(within, &region, near, far, width, &holds, &fails, note, sizeof note);
    bool up = far > near;
    CU_ASSERT(holds >= region.from && holds <= region.to);
    CU_ASSERT(up ? fails > region.to : fails < region.from);
    CU_ASSERT((up ? fails / holds : holds / fails) <= 1 + width);
    CU_ASSERT(up ? holds <= end && fails > end : holds >= end && fails < end);
    CU_ASSERT(region.asked <= 2 + (int)ceil(log2(fabs(log(far / near)) / log1p(width)))); /* ratios are halved */
    CU_ASSERT(note[0] != '\0');
}

static void ends_above_and_below(void)
{
    closes_in((struct region){.from = 0, .to = 0.8}, 0.1, 10, 0.8);
    closes_in((struct region){.from = 0, .to = 3e7}, 1e-6, 1e9, 3e7);
    closes_in((struct region){.from = 0.05, .to = 9}, 1, 1e-3, 0.05);
    closes_in((struct region){.from = 2e-9, .to = 9}, 1, 1e-12, 2e-9);
}

static void nothing_to_close_in_on(void)
{
    struct region nowhere = {.from = 5, .to = 6}, all = {.from = 0, .to = 100};
    char note[64] = "";
    double holds, fails;
    verify_extreme_bisect(within, &nowhere, 1, 10, width, &holds, &fails, note, sizeof note);
    CU_ASSERT(isnan(holds) && fails == 1);
    CU_ASSERT_STRING_EQUAL(note, "1 is too small");
    CU_ASSERT_EQUAL(nowhere.asked, 1);
    note[0] = '\0';
    verify_extreme_bisect(within, &all, 1, 10, width, &holds, &fails, note, sizeof note);
    CU_ASSERT(holds == 10 && isnan(fails));
    CU_ASSERT_STRING_EQUAL(note, "");
    CU_ASSERT_EQUAL(all.asked, 2);
}

static bool row_holds(double value, double least, double most)
{
    return verify_extreme_holds(&(struct verify_extreme_row){.value = value, .least = least, .most = most});
}

static void rows(void)
{
    CU_ASSERT_TRUE(row_holds(1, 1, 1));
    CU_ASSERT_TRUE(row_holds(-7, -INFINITY, INFINITY));
    CU_ASSERT_FALSE(row_holds(0.999, 1, INFINITY));
    CU_ASSERT_FALSE(row_holds(1.001, -INFINITY, 1));
    CU_ASSERT_FALSE(row_holds(NAN, -INFINITY, INFINITY));
    CU_ASSERT_FALSE(row_holds(NAN, 0, 1));
    CU_ASSERT_FALSE(row_holds(INFINITY, 1, INFINITY));
    CU_ASSERT_FALSE(row_holds(INFINITY, -INFINITY, INFINITY));
    CU_ASSERT_FALSE(row_holds(-INFINITY, -INFINITY, 1));
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"ends above and below", ends_above_and_below},
        {"nothing to close in on", nothing_to_close_in_on},
        {"rows", rows},
    };
    return unit_main("extremes", tests, sizeof tests / sizeof *tests);
}
