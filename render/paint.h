/* Coloured triangles on an off-screen sheet. Coordinates are pixels of the finished picture, (0, 0) its upper left
 * corner; depth runs from 0 (near) to 1 (far). The sheet is drawn at a multiple of the picture's size and averaged
 * down: smooth edges that are the same in every run. */
#ifndef RENDER_PAINT_H
#define RENDER_PAINT_H

#include "render/image.h"

struct render_paint;

struct render_point {
    float x, y, depth;
    float red, green, blue; /* plain colour, 0..1 */
    float band;             /* place in the colour range: 0 its lower, 1 its upper end */
    float shade;            /* factor on the band's colour */
    float plain;            /* 1: plain colour, 0: band colour */
};

struct render_ink {
    float red, green, blue;
};

/* `band_colour`: [bands][3] in 0..1. */
bool render_paint_open(int width, int height, const float *band_colour, int bands, struct render_paint **paint,
                       char why[RENDER_WHY]);
void render_paint_close(struct render_paint *paint);

/* From here on only the rectangle (x0, y0, x1, y1) is touched, and nearer points hide those behind. */
void render_paint_within(struct render_paint *paint, const int rectangle[4]);
/* From here on everything lies on top of what was drawn before, anywhere on the sheet. */
void render_paint_on_top(struct render_paint *paint);

/* A point of plain colour. */
struct render_point render_inked(float x, float y, float depth, struct render_ink ink);
void render_paint_triangle(struct render_paint *paint, const struct render_point corner[3]);
/* A round-ended stroke of the given width from (x, y, depth) `from` to `to`. */
void render_paint_stroke(struct render_paint *paint, const float from[3], const float to[3], float width,
                         struct render_ink ink);
void render_paint_rectangle(struct render_paint *paint, float x0, float y0, float x1, float y1, struct render_ink ink);

/* Averages the sheet into a picture of its size. */
bool render_paint_finish(struct render_paint *paint, struct render_image *image, char why[RENDER_WHY]);

#endif
