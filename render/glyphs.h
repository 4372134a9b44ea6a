/* A stroke font of our own: single-line letters on a grid in which capitals are 14 high. */
#ifndef RENDER_GLYPHS_H
#define RENDER_GLYPHS_H

#include <stdint.h>

struct render_glyph {
    uint32_t code; /* Unicode */
    float width;   /* of the strokes' centre lines, starting at x = 0 */
    /* Strokes: `Mx,y` lifts the pen to a point, `Lx,y` draws a straight line there; `Hx,y` and `Vx,y` draw a quarter
     * of an ellipse that starts along the horizontal or the vertical. Baseline y = 0, y upwards. */
    const char *path;
};

enum { RENDER_CAPITAL = 14 };

/* The glyph of a character; a hollow box for one that the font does not have. */
const struct render_glyph *render_glyph_find(uint32_t code);

#endif
