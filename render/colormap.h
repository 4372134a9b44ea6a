/* The colour map: from dark violet over blue and green to yellow, in equal steps for the eye. */
#ifndef RENDER_COLORMAP_H
#define RENDER_COLORMAP_H

enum { RENDER_BANDS = 64 }; /* most bands that a picture may have */

/* Colour at `place` in 0..1, as sRGB in 0..1. Lightness L* grows in proportion to place, and the distance between two
 * colours in CIELAB along the map too, so that equal differences of the field look equally different, also in print
 * without colour. */
void render_colormap(double place, double rgb[3]);
/* The colours of all bands, first to last: [bands][3] in 0..1. The outermost bands take the map's ends. */
void render_colormap_bands(int bands, float *colour);

#endif
