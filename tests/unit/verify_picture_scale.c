/* The colour scale of a picture where a scene leaves it open. */
#include "tests/unit/unit.h"
#include "verify/picture.h"

#include <math.h>

static void chosen(double seen_lower, double seen_upper, double lower, double upper, int bands)
{
    double range[2] = {0, 0};
    int count = 0;
    verify_picture_scale((double[2]){seen_lower, seen_upper}, range, &count);
    CU_ASSERT_DOUBLE_EQUAL(range[0], lower, 1e-9 * fabs(upper - lower));
    CU_ASSERT_DOUBLE_EQUAL(range[1], upper, 1e-9 * fabs(upper - lower));
    CU_ASSERT_EQUAL(count, bands);
}

static void ranges(void)
{
    chosen(0, 1, 0, 1, 10);
    chosen(-33.7e6, 101.2e6, -40e6, 110e6, 15);
    chosen(-0.0137, 0.0009, -0.014, 0.001, 15);
    chosen(1.9999e-7, 3.7e-7, 1.8e-7, 3.8e-7, 10);
    chosen(-1, 1, -1, 1, 10);
    chosen(-1e306, 3e306, -1e306, 3e306, 16);
}

/* What is constant but for round-off has a scale, too. */
static void constants(void)
{
    chosen(0, 0, -0.5, 0.5, 10);
    chosen(14e6, 14e6 * (1 + 1e-12), 7e6, 21e6, 14);
    chosen(-2e-9, -2e-9, -3e-9, -1e-9, 10);
}

/* Whatever there is lies within, in so many bands as are asked for. */
static void holds_what_is_seen(void)
{
    double lower = -1;
    for (int i = 0; i < 2000; i++) {
        lower = fmod(lower * 1.7 + 0.31, 3);
        double upper = lower + pow(10, -5 + 0.004 * i);
        for (int asked = 0; asked <= 20; asked += 5) {
            double range[2] = {0, 0}, slack = 1e-5 * (upper - lower);
            int bands = asked;
            verify_picture_scale((double[2]){lower, upper}, range, &bands);
            CU_ASSERT_TRUE(range[0] <= lower + slack && upper - slack <= range[1]);
            CU_ASSERT_TRUE(asked == 0 ? bands >= 4 && bands <= 16 : bands == asked);
        }
    }
}

static void bands_of_a_range(void)
{
    static const struct {
        double range[2];
        int asked, bands;
    } table[] = {
        {{0, 2e5}, 0, 10},  {{0, 3e8}, 0, 12}, {{-1e6, 1e6}, 0, 10}, {{0, 7}, 0, 14}, {{-4, 12}, 0, 8},
        {{0, 3.17}, 0, 12}, {{0, 2e5}, 7, 7},  {{0, 1e-300}, 0, 10}, {{1, 9}, 0, 8},  {{-33e6, 33e6}, 0, 12},
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        double range[2] = {table[i].range[0], table[i].range[1]};
        int bands = table[i].asked;
        verify_picture_scale((double[2]){-5, 5}, range, &bands);
        CU_ASSERT_EQUAL(range[0], table[i].range[0]);
        CU_ASSERT_EQUAL(range[1], table[i].range[1]);
        CU_ASSERT_EQUAL(bands, table[i].bands);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"ranges", ranges},
        {"constants", constants},
        {"a range holds what is seen", holds_what_is_seen},
        {"bands of a range", bands_of_a_range},
    };
    return unit_main("picture scale", tests, sizeof tests / sizeof *tests);
}
