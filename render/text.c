#include "render/text.h"

#include "render/glyphs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ARC = 10, LINE = 512 };

static const float bearing = 1.9f, weight = 1.5f; /* space beside a glyph and stroke width, in its grid */
static const float raised = 0.72f, raise = 0.55f, least = 0.6f;

/* Where text is drawn; paint is NULL to measure only. */
struct pen {
    struct render_paint *paint;
    float x, y, size;
    struct render_ink ink;
};

/* The next character of UTF-8; a byte that does not belong there counts as one unknown character. */
static uint32_t next_code(const char **text)
{
    const unsigned char *byte = (const unsigned char *)*text;
    const int more = byte[0] < 0x80                      ? 0
                     : byte[0] >= 0xf0 && byte[0] < 0xf8 ? 3
                     : byte[0] >= 0xe0 && byte[0] < 0xf0 ? 2
                     : byte[0] >= 0xc2 && byte[0] < 0xe0 ? 1
                                                         : -1;
    *text += 1;
    if (more <= 0)
        return more < 0 ? 0xfffd : byte[0];
    uint32_t code = byte[0] & (0x3fu >> more);
    for (int i = 1; i <= more; i++) {
        if ((byte[i] & 0xc0) != 0x80)
            return 0xfffd;
        code = code << 6 | (byte[i] & 0x3fu);
    }
    *text += more;
    return code;
}

static void line_to(const struct pen *pen, float from[2], float x, float y)
{
    const float grid = pen->size / RENDER_CAPITAL;
    const float a[3] = {pen->x + from[0] * grid, pen->y - from[1] * grid, 0};
    const float b[3] = {pen->x + x * grid, pen->y - y * grid, 0};
    render_paint_stroke(pen->paint, a, b, weight * grid, pen->ink);
    from[0] = x;
    from[1] = y;
}

static void draw_glyph(const struct pen *pen, const char *path)
{
    float at[2] = {0};
    while (*path) {
        char *end;
        const char command = *path;
        const float x = strtof(path + 1, &end), y = strtof(end + 1, &end);
        const float from[2] = {at[0], at[1]};
        if (command == 'M') {
            at[0] = x;
            at[1] = y;
        } else if (command == 'L') {
            line_to(pen, at, x, y);
        } else {
            for (int i = 1; i <= ARC; i++) {
                const float angle = (float)M_PI_2 * (float)i / ARC, s = sinf(angle), c = 1 - cosf(angle);
                const bool across = command == 'H';
                line_to(pen, at, from[0] + (x - from[0]) * (across ? s : c),
                        from[1] + (y - from[1]) * (across ? c : s));
            }
        }
        path = *end == ' ' ? end + 1 : end;
    }
}

static void advance(struct pen *pen, uint32_t code)
{
    const struct render_glyph *glyph = render_glyph_find(code);
    const float grid = pen->size / RENDER_CAPITAL;
    pen->x += bearing * grid;
    if (pen->paint)
        draw_glyph(pen, glyph->path);
    pen->x += (glyph->width + bearing) * grid;
}

static bool starts_number(const char *text)
{
    return (*text >= '0' && *text <= '9') || ((*text == '-' || *text == '+') && text[1] >= '0' && text[1] <= '9');
}

static void walk(struct pen *pen, const char *text)
{
    while (*text) {
        if (*text == '^' && starts_number(text + 1)) {
            struct pen above = *pen;
            above.size *= raised;
            above.y -= raise * pen->size;
            text++;
            do
                advance(&above, next_code(&text));
            while (*text >= '0' && *text <= '9');
            pen->x = above.x;
        } else {
            advance(pen, next_code(&text));
        }
    }
}

float render_text_width(const char *text, float size)
{
    struct pen pen = {.size = size};
    walk(&pen, text);
    return pen.x;
}

void render_text(struct render_paint *paint, float x, float y, float size, struct render_ink ink, const char *text)
{
    struct pen pen = {paint, x, y, size, ink};
    walk(&pen, text);
}

void render_text_fit(struct render_paint *paint, float x, float y, float size, float room, struct render_ink ink,
                     const char *text)
{
    char line[LINE + 4];
    strncpy(line, text, LINE);
    line[LINE] = '\0';
    size_t kept = strlen(line);
    float shrink = fminf(1, room / render_text_width(line, size));
    while (shrink < least && kept > 0) {
        do
            line[--kept] = '\0';
        while (kept > 0 && ((unsigned char)text[kept] & 0xc0) == 0x80); /* never half a character */
        memcpy(line + kept, "...", 4);
        shrink = fminf(1, room / render_text_width(line, size));
        if (shrink < least)
            line[kept] = '\0';
    }
    render_text(paint, x, y, size * fmaxf(shrink, least), ink, line);
}
