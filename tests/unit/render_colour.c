/* CIELAB against published values, and the colour map's promise of equal steps. */
#include "render/colormap.h"
#include "render/lab.h"
#include "tests/unit/unit.h"

#include <math.h>

/* Reference values of sRGB's primaries, white and mid grey under D65 (Lindbloom's calculator, two decimals). */
static void lab_agrees_with_published_values(void)
{
    static const struct {
        uint8_t rgb[3];
        double lab[3];
    } known[] = {
        {{255, 0, 0}, {53.24, 80.09, 67.20}},
        {{0, 255, 0}, {87.73, -86.18, 83.18}},
        {{0, 0, 255}, {32.30, 79.19, -107.86}},
        {{255, 255, 255}, {100, 0, 0}},
        {{0, 0, 0}, {0, 0, 0}},
        {{128, 128, 128}, {53.59, 0, 0}},
        {{255, 255, 0}, {97.14, -21.55, 94.48}},
        {{3, 3, 3}, {0.82, 0, 0}},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        float lab[3];
        render_lab_from_rgb(known[i].rgb, lab);
        for (int c = 0; c < 3; c++)
            CU_ASSERT_DOUBLE_EQUAL((double)lab[c], known[i].lab[c], 0.02);
    }
}

static void lab_returns_to_the_same_bytes(void)
{
    for (int r = 0; r < 256; r += 15)
        for (int g = 0; g < 256; g += 17)
            for (int b = 0; b < 256; b += 5) {
                const uint8_t rgb[3] = {(uint8_t)r, (uint8_t)g, (uint8_t)b};
                float lab[3];
                double back[3];
                render_lab_from_rgb(rgb, lab);
                CU_ASSERT_TRUE(
                    render_lab_to_rgb((const double[]){(double)lab[0], (double)lab[1], (double)lab[2]}, back));
                for (int c = 0; c < 3; c++)
                    CU_ASSERT_EQUAL(lround(255 * back[c]), rgb[c]);
            }
    double out[3];
    CU_ASSERT_FALSE(render_lab_to_rgb((const double[]){50, 120, 0}, out));
    CU_ASSERT_TRUE(out[0] <= 1 && out[1] >= 0);
}

static void map_lab(double place, float lab[3])
{
    double rgb[3];
    uint8_t bytes[3];
    render_colormap(place, rgb);
    for (int c = 0; c < 3; c++)
        bytes[c] = (uint8_t)lround(255 * rgb[c]);
    render_lab_from_rgb(bytes, lab);
}

/* Through bytes and back, as it reaches the eye. Rounding to bytes moves a colour by up to 0.6, of steps of 23. */
static void map_steps_are_equal(void)
{
    enum { STEPS = 8 };
    float last[3], next[3];
    map_lab(0, last);
    double least = INFINITY, most = 0;
    for (int i = 1; i <= STEPS; i++) {
        map_lab((double)i / STEPS, next);
        CU_ASSERT_DOUBLE_EQUAL((double)(next[0] - last[0]), 71.0 / STEPS, 0.6);
        const double step = (double)render_delta_e(last, next);
        least = fmin(least, step);
        most = fmax(most, step);
        for (int c = 0; c < 3; c++)
            last[c] = next[c];
    }
    CU_ASSERT_TRUE(most / least < 1.1);
    CU_ASSERT_TRUE(least > 20);
}

/* A map that leaves sRGB would be clamped and lose its equal steps. */
static void map_stays_within_the_gamut(void)
{
    for (int i = 0; i <= 256; i++) {
        double rgb[3];
        render_colormap(i / 256.0, rgb);
        for (int c = 0; c < 3; c++)
            CU_ASSERT_TRUE(rgb[c] > 0 && rgb[c] < 1);
    }
}

static void bands_take_the_ends(void)
{
    float band[RENDER_BANDS][3];
    double dark[3], light[3];
    render_colormap_bands(RENDER_BANDS, band[0]);
    render_colormap(0, dark);
    render_colormap(1, light);
    for (int c = 0; c < 3; c++) {
        CU_ASSERT_DOUBLE_EQUAL((double)band[0][c], dark[c], 1e-6);
        CU_ASSERT_DOUBLE_EQUAL((double)band[RENDER_BANDS - 1][c], light[c], 1e-6);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"CIELAB agrees with published values", lab_agrees_with_published_values},
        {"CIELAB returns to the same bytes", lab_returns_to_the_same_bytes},
        {"the map's steps are equal", map_steps_are_equal},
        {"the map stays within the gamut", map_stays_within_the_gamut},
        {"the outer bands take the map's ends", bands_take_the_ends},
    };
    return unit_main("render colour", tests, sizeof tests / sizeof *tests);
}
