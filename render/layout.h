/* Where things stand in a picture: title above, colour bar on the right, axes at the lower left, and the body in a
 * rectangle of its own that none of them touches. */
#ifndef RENDER_LAYOUT_H
#define RENDER_LAYOUT_H

#include "render/paint.h"

struct render_layout {
    float unit;     /* pixels per pixel of a picture 800 wide and at least 400 high */
    int body[4];    /* x0, y0, x1, y1 */
    float title[3]; /* x and baseline of the title, and its width at most */
    float bar[4];   /* x0, y0, x1, y1 of the colour bar */
    float bar_room; /* width for what is written at the bar */
    float axes[2];  /* middle of the axes */
};

struct render_layout render_layout(int width, int height);

static const struct render_ink render_dark = {0.11f, 0.11f, 0.13f};
static const struct render_ink render_loud = {1.0f, 0.0f, 1.0f}; /* magenta: not a number */

#endif
