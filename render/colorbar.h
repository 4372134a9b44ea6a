/* The colour bar, and the numbers beside it. */
#ifndef RENDER_COLORBAR_H
#define RENDER_COLORBAR_H

#include "render/layout.h"

/* How a colour range is written: values over a common power of ten. */
struct render_scale {
    int power;    /* a multiple of three; values are value / 10^power */
    int decimals; /* as many as tell two neighbouring marks apart and write them exactly where that is possible */
    int stride;   /* every stride-th boundary between bands is marked */
};

struct render_scale render_scale_choose(const double range[2], int bands);

/* What the data do that the bar must say. */
struct render_outside {
    bool below, above; /* values beyond the range: the bar ends in a point */
    bool nan;          /* values that are not finite: drawn in magenta, with a key under the bar */
};

void render_colorbar(struct render_paint *paint, const struct render_layout *layout, const struct render_view *view,
                     struct render_outside outside);

#endif
