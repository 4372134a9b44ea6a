/* The stroke font and the writing of numbers. */
#include "render/colorbar.h"
#include "render/glyphs.h"
#include "render/text.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void every_printable_character_has_a_glyph(void)
{
    const struct render_glyph *missing = render_glyph_find(0x10ffff);
    for (uint32_t code = ' '; code <= '~'; code++) {
        const struct render_glyph *glyph = render_glyph_find(code);
        CU_ASSERT_PTR_NOT_EQUAL(glyph, missing);
        CU_ASSERT_EQUAL(glyph->code, code);
        for (uint32_t other = ' '; other < code; other++)
            CU_ASSERT_TRUE(strcmp(render_glyph_find(other)->path, glyph->path) != 0);
    }
}

/* Every path is made of the four commands, starts by lifting the pen and stays near its box. */
static void every_path_is_well_formed(void)
{
    for (uint32_t code = '!'; code <= 0xff; code++) {
        const struct render_glyph *glyph = render_glyph_find(code);
        const char *path = glyph->path;
        CU_ASSERT_EQUAL_FATAL(path[0], 'M');
        while (*path) {
            char *end;
            CU_ASSERT_PTR_NOT_NULL(strchr("MLHV", *path));
            const float x = strtof(path + 1, &end);
            CU_ASSERT_EQUAL_FATAL(*end, ',');
            const float y = strtof(end + 1, &end);
            CU_ASSERT_TRUE_FATAL(*end == ' ' || *end == '\0');
            CU_ASSERT_TRUE(x >= -1 && x <= glyph->width + 1 && y >= -5 && y <= 17);
            path = *end ? end + 1 : end;
        }
    }
}

static void width_grows_with_text_and_size(void)
{
    const float width = render_text_width("stress", 10);
    CU_ASSERT_TRUE(width > 40 && width < 70);
    CU_ASSERT_DOUBLE_EQUAL((double)render_text_width("stress", 20), 2 * (double)width, 1e-3);
    CU_ASSERT_EQUAL(render_text_width("", 10), 0);
    /* Raised figures are smaller, a caret before a letter is itself. */
    CU_ASSERT_TRUE(render_text_width("10^6", 10) < render_text_width("106", 10));
    CU_ASSERT_TRUE(render_text_width("10^-6", 10) < render_text_width("10-6", 10));
    CU_ASSERT_DOUBLE_EQUAL(
        (double)render_text_width("a^b", 10),
        (double)(render_text_width("a", 10) + render_text_width("^", 10) + render_text_width("b", 10)), 1e-3);
}

/* Two bytes that make one character are one glyph; bytes that are not UTF-8 are boxes, one each. */
static void utf8_and_what_is_not(void)
{
    const float box = render_text_width("\x01", 10);
    CU_ASSERT_TRUE(box > 0);
    CU_ASSERT_TRUE(render_text_width("\xc3\x97", 10) < box);
    CU_ASSERT_DOUBLE_EQUAL((double)render_text_width("\xe2\x82\xac", 10), (double)box, 1e-3); /* euro sign: no glyph */
    CU_ASSERT_DOUBLE_EQUAL((double)render_text_width("\xff\xff", 10), 2 * (double)box, 1e-3);
    CU_ASSERT_DOUBLE_EQUAL((double)render_text_width("\xe2\x82", 10), 2 * (double)box, 1e-3); /* cut short */
    CU_ASSERT_DOUBLE_EQUAL((double)render_text_width("\xf0", 10), (double)box, 1e-3);
}

static struct render_scale choose(double lower, double upper, int bands)
{
    const double range[2] = {lower, upper};
    return render_scale_choose(range, bands);
}

static void numbers_share_a_power_of_ten(void)
{
    static const struct {
        double lower, upper;
        int bands, power, decimals, stride;
    } known[] = {
        {-1.2e6, 1.2e6, 12, 6, 1, 1},   {0, 5e5, 10, 3, 0, 1},    {-300, 300, 12, 0, 0, 1}, {0, 1, 10, 0, 1, 1},
        {-4.5e-4, 4.5e-4, 9, -6, 0, 1}, {0, 1, 3, 0, 2, 1},       {0, 1e-12, 4, -12, 2, 1}, {0, 1, 20, 0, 1, 2},
        {1e6, 1.00001e6, 10, 6, 6, 1},  {0, 2e300, 8, 300, 2, 1}, {0, 0.5, 5, 0, 1, 1},     {0, 999, 9, 0, 0, 1},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        const struct render_scale scale = choose(known[i].lower, known[i].upper, known[i].bands);
        CU_ASSERT_EQUAL(scale.power, known[i].power);
        CU_ASSERT_EQUAL(scale.decimals, known[i].decimals);
        CU_ASSERT_EQUAL(scale.stride, known[i].stride);
    }
    CU_ASSERT_EQUAL(choose(0, 1, 64).stride, 6);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"every printable character has a glyph of its own", every_printable_character_has_a_glyph},
        {"every path is well formed", every_path_is_well_formed},
        {"width grows with text and size", width_grows_with_text_and_size},
        {"UTF-8, and what is not", utf8_and_what_is_not},
        {"numbers share a power of ten", numbers_share_a_power_of_ten},
    };
    return unit_main("render text", tests, sizeof tests / sizeof *tests);
}
