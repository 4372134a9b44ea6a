/* Arrays -> off-screen contour picture; picture -> picture difference. Knows no other room. */
#ifndef RENDER_RENDER_H
#define RENDER_RENDER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { RENDER_WHY = 512 };

struct render_image {
    int width, height;
    uint8_t *rgb; /* [height][width][3], top row first */
    int body[4];  /* x0, y0, x1, y1: the rectangle of the body's picture, without text and colour bar; this is what
                     is compared. Kept in the PNG as a text chunk. */
};

/* What is drawn: polygons of a surface with one scalar per vertex, in filled contour bands. */
struct render_surface {
    size_t vertex_count;
    const double *position; /* [vertex_count][3], deformed [m] */
    const double *scalar;   /* [vertex_count] */
    size_t quad_count;
    const uint32_t *quad; /* [quad_count][4]; a line (1D) or triangle repeats its last vertex */
};

struct render_view {
    double direction[3]; /* from the body towards the eye; need not be of unit length */
    double up[3];
    double range[2]; /* colour range */
    int bands;
    int width, height; /* pixels */
    double frame[6]; /* x0 x1 y0 y1 z0 z1 [m]: what must stay in sight, so that the view does not move with the body */
    const char *title; /* "Swinging cube, t = 0.002 s, displacement × 300" */
    const char *label; /* "mean stress" */
    const char *unit;  /* "Pa" */
};

/* Draws by OSMesa, one picture at a time in a process. Values beyond the range take its outermost bands and the colour
 * bar then ends in points; values that are not finite are magenta, with a key under the bar. A flat body is not shaded;
 * a body of lines is a ribbon. Texts are UTF-8; "^" before figures raises them; the unit "-" is not written. Refuses
 * vertex numbers out of range, positions that are not finite, a picture side outside 160..4096, bands outside 1..64, an
 * empty colour range, a direction or up of no use, a frame without size. The same input gives the same bytes, for any
 * number of rasteriser threads. */
bool render_draw(const struct render_surface *surface, const struct render_view *view, struct render_image **image,
                 char why[RENDER_WHY]);
void render_image_free(struct render_image *image);
/* Whole or absent: written beside, flushed, renamed. */
bool render_png_write(const char *path, const struct render_image *image, char why[RENDER_WHY]);
/* A picture of this program. */
bool render_png_read(const char *path, struct render_image **image, char why[RENDER_WHY]);
/* Any PNG of at most 4096 pixels a side, as 8 bits each of red, green and blue, on white where it is transparent; of a
 * picture that is not of this program all is the body's rectangle. */
bool render_png_read_any(const char *path, struct render_image **image, char why[RENDER_WHY]);

/* Difference of two pictures within the body rectangle, in CIELAB. */
struct render_difference {
    double fraction;   /* share of pixels that differ visibly (colour difference above the threshold) */
    double worst_tile; /* the same share within the worst tile */
    int tile[2];       /* pixel position of the worst tile */
    double mean_delta_e;
    bool same;                    /* within render_tolerance_default */
    struct render_image *picture; /* the difference as a picture, same size; NULL if not asked for */
};
/* Pictures of different size or body rectangle cannot be compared: false. */
bool render_compare(const struct render_image *stored, const struct render_image *fresh, bool want_picture,
                    struct render_difference *difference, char why[RENDER_WHY]);

/* The shares of pixels, in all and within the worst tile, that may differ visibly in pictures that show the same. */
struct render_tolerance {
    double fraction, worst_tile;
};
extern const struct render_tolerance render_tolerance_default;
bool render_within(const struct render_difference *difference, struct render_tolerance tolerance);

#endif
