#include "render/colorbar.h"

#include "render/colormap.h"
#include "render/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MARKS = 13, DECIMALS = 9, LINE = 512 };

static const float letter = 11, number = 10.5f; /* height of capitals and figures at 800 x 640 */

/* Whether `value` is written exactly, for the eye, with so many decimals: off by less than a hundredth of a step. */
static bool exact(double value, double step, int decimals)
{
    const double shifted = value * pow(10, decimals);
    return fabs(shifted - nearbyint(shifted)) < 0.01 * step * pow(10, decimals);
}

struct render_scale render_scale_choose(const double range[2], int bands)
{
    struct render_scale scale = {0};
    const double largest = fmax(fabs(range[0]), fabs(range[1]));
    const int order = (int)floor(log10(largest) + 1e-9);
    if (order < -1 || order > 2)
        scale.power = 3 * (int)floor(order / 3.0);
    scale.stride = (bands + MARKS - 2) / (MARKS - 1);
    const double ten = pow(10, scale.power), lower = range[0] / ten;
    const double step = (range[1] - range[0]) / ten / bands * scale.stride;
    const int two_figures = (int)ceil(1 - log10(step) - 1e-9); /* of the step */
    scale.decimals = two_figures < 0 ? 0 : two_figures > DECIMALS ? DECIMALS : two_figures;
    for (int d = 0; d < scale.decimals; d++)
        if (exact(lower, step, d) && exact(step, step, d))
            scale.decimals = d;
    return scale;
}

static void outline(struct render_paint *paint, float x0, float y0, float x1, float y1, float width)
{
    const float a[3] = {x0, y0, 0}, b[3] = {x1, y1, 0};
    render_paint_stroke(paint, a, b, width, render_dark);
}

/* A point on the end of the bar at height y, towards `tip`: values beyond the range take the end's colour. */
static void point_end(struct render_paint *paint, const struct render_layout *layout, float y, float tip,
                      struct render_ink ink)
{
    const float x0 = layout->bar[0], x1 = layout->bar[2], middle = (x0 + x1) / 2;
    render_paint_triangle(paint, (struct render_point[]){render_inked(x0, y, 0, ink), render_inked(x1, y, 0, ink),
                                                         render_inked(middle, tip, 0, ink)});
    outline(paint, x0, y, middle, tip, layout->unit);
    outline(paint, middle, tip, x1, y, layout->unit);
}

static void write_marks(struct render_paint *paint, const struct render_layout *layout, const struct render_view *view)
{
    const struct render_scale scale = render_scale_choose(view->range, view->bands);
    const float unit = layout->unit, y0 = layout->bar[1], y1 = layout->bar[3], x1 = layout->bar[2];
    for (int i = 0; i <= view->bands; i += scale.stride) {
        const double share = (double)i / view->bands;
        double value = (view->range[0] + share * (view->range[1] - view->range[0])) / pow(10, scale.power);
        const double half_digit = 0.5 * pow(10, -scale.decimals);
        if (fabs(value) < half_digit)
            value = 0; /* never "-0.0" */
        char text[64];
        snprintf(text, sizeof text, "%.*f", scale.decimals, value);
        const float y = y1 - (float)share * (y1 - y0);
        outline(paint, x1, y, x1 + 5 * unit, y, unit);
        const float room = layout->bar_room - (x1 - layout->bar[0]) - 8 * unit;
        render_text_fit(paint, x1 + 8 * unit, y + number * unit / 2, number * unit, room, render_dark, text);
    }
    char unit_line[LINE] = "";
    const char *name = strcmp(view->unit, "-") == 0 ? "" : view->unit;
    if (scale.power != 0)
        snprintf(unit_line, sizeof unit_line, "\u00d7 10^%d %s", scale.power, name);
    else
        snprintf(unit_line, sizeof unit_line, "%s", name);
    const float x0 = layout->bar[0] - 2 * unit, head = layout->bar[1];
    render_text_fit(paint, x0, head - 48 * unit, letter * unit, layout->bar_room, render_dark, view->label);
    render_text_fit(paint, x0, head - 27 * unit, letter * unit, layout->bar_room, render_dark, unit_line);
}

void render_colorbar(struct render_paint *paint, const struct render_layout *layout, const struct render_view *view,
                     struct render_outside outside)
{
    const float unit = layout->unit, tip = 14 * unit;
    const float x0 = layout->bar[0], y0 = layout->bar[1], x1 = layout->bar[2], y1 = layout->bar[3];
    float colour[RENDER_BANDS][3];
    render_colormap_bands(view->bands, colour[0]);
    const float step = (y1 - y0) / (float)view->bands;
    for (int i = 0; i < view->bands; i++) {
        const struct render_ink ink = {colour[i][0], colour[i][1], colour[i][2]};
        render_paint_rectangle(paint, x0, y1 - step * (float)(i + 1), x1, y1 - step * (float)i, ink);
        if (i == 0 && outside.below)
            point_end(paint, layout, y1, y1 + tip, ink);
        if (i == view->bands - 1 && outside.above)
            point_end(paint, layout, y0, y0 - tip, ink);
    }
    for (int i = 0; i <= view->bands; i++) {
        const float y = y1 - step * (float)i;
        outline(paint, x0, y, x1, y, i == 0 || i == view->bands ? unit : 0.5f * unit);
    }
    outline(paint, x0, y0, x0, y1, unit);
    outline(paint, x1, y0, x1, y1, unit);
    write_marks(paint, layout, view);
    if (outside.nan) {
        const float y = y1 + 26 * unit, side = 20 * unit;
        render_paint_rectangle(paint, x0, y, x0 + side, y + 0.7f * side, render_loud);
        render_text_fit(paint, x0 + side + 6 * unit, y + 12 * unit, number * unit, layout->bar_room - side - 6 * unit,
                        render_dark, "not finite");
    }
}
