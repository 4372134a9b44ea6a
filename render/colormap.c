#include "render/colormap.h"

#include "render/lab.h"

#include <math.h>

enum { PIECES = 512 };

/* Lightness at the ends of the map, and the Bezier curve that it follows in the plane of a* and b*: as colourful as
 * sRGB allows at each lightness, with some room left, and hues that the common forms of colour blindness tell apart. */
static const double dark = 20, light = 91;
static const double control[5][2] = {{34, -36}, {-4, -52}, {-46, -4}, {-60, 62}, {-10, 77}};

static void curve(double t, double ab[2])
{
    const double s = 1 - t;
    const double weight[5] = {s * s * s * s, 4 * s * s * s * t, 6 * s * s * t * t, 4 * s * t * t * t, t * t * t * t};
    ab[0] = ab[1] = 0;
    for (int i = 0; i < 5; i++)
        for (int c = 0; c < 2; c++)
            ab[c] += weight[i] * control[i][c];
}

/* The point of the curve at a fraction of its length. */
static void walk(double fraction, double ab[2])
{
    double length[PIECES + 1] = {0}, last[2], next[2];
    curve(0, last);
    for (int i = 1; i <= PIECES; i++) {
        curve((double)i / PIECES, next);
        length[i] = length[i - 1] + hypot(next[0] - last[0], next[1] - last[1]);
        last[0] = next[0];
        last[1] = next[1];
    }
    const double wanted = fraction * length[PIECES];
    int piece = 1;
    while (piece < PIECES && length[piece] < wanted)
        piece++;
    const double rest = (wanted - length[piece - 1]) / (length[piece] - length[piece - 1]);
    curve((piece - 1 + rest) / PIECES, ab);
}

void render_colormap(double place, double rgb[3])
{
    const double at = fmin(fmax(place, 0), 1);
    double lab[3] = {dark + (light - dark) * at};
    walk(at, lab + 1);
    render_lab_to_rgb(lab, rgb);
}

void render_colormap_bands(int bands, float *colour)
{
    for (int i = 0; i < bands; i++) {
        double rgb[3];
        render_colormap(bands > 1 ? (double)i / (bands - 1) : 0.5, rgb);
        for (int c = 0; c < 3; c++)
            colour[3 * i + c] = (float)rgb[c];
    }
}
