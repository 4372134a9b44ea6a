/* Whether two pictures show the same. A mean over the picture would drown a local fault, so the worst tile is judged
 * beside the whole; and each pixel is held against its neighbourhood in the other picture, so that a contour or an
 * edge that moves by no more than a pixel does not count. */
#include "render/fail.h"
#include "render/image.h"
#include "render/lab.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TILE = 16 }; /* pixels along a side */

/* Calibrated by tests/image/calibration.c and gallery.c on a cube of 24 x 24 quads a face, 800 x 640 pixels, 12 bands.
 * What must pass: identical pictures, round-off and a shift by a pixel give 0, another rasteriser a fraction of 2e-5
 * and one pixel in a tile (0.004). What must fail: a colour range wrong by 1 % gives the least worst tile, 0.17, and a
 * missing quad the least fraction, 3.3e-4, with 0.24 in its tile. Each limit is far from both. */
static const float visible = 4; /* a colour difference that counts; just noticeable is 2.3, neighbouring bands 16 */
const struct render_tolerance render_tolerance_default = {.fraction = 5e-4, .worst_tile = 0.02};

bool render_within(const struct render_difference *difference, struct render_tolerance tolerance)
{
    return islessequal(difference->fraction, tolerance.fraction) &&
           islessequal(difference->worst_tile, tolerance.worst_tile);
}

/* The body's part of a picture in CIELAB. */
struct patch {
    int width, height;
    float (*lab)[3]; /* [height][width] */
};

static bool make_patch(const struct render_image *image, struct patch *patch)
{
    const int *body = image->body;
    patch->width = body[2] - body[0];
    patch->height = body[3] - body[1];
    patch->lab = malloc((size_t)patch->width * (size_t)patch->height * sizeof *patch->lab);
    if (!patch->lab)
        return false;
    for (int y = 0; y < patch->height; y++)
        for (int x = 0; x < patch->width; x++) {
            const size_t pixel = (size_t)(body[1] + y) * (size_t)image->width + (size_t)(body[0] + x);
            render_lab_from_rgb(image->rgb + 3 * pixel, patch->lab[(size_t)y * (size_t)patch->width + (size_t)x]);
        }
    return true;
}

/* The least difference of pixel (x, y) of `from` to those at and around the same place in `to`. */
static float best_match(const struct patch *from, const struct patch *to, int x, int y)
{
    const float *colour = from->lab[(size_t)y * (size_t)from->width + (size_t)x];
    float best = INFINITY;
    for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < to->height; v++)
        for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < to->width; u++)
            best = fminf(best, render_delta_e(colour, to->lab[(size_t)v * (size_t)to->width + (size_t)u]));
    return best;
}

/* difference[height][width]: what of either picture is not found in the other. */
static void subtract(const struct patch *stored, const struct patch *fresh, float *difference)
{
    for (int y = 0; y < stored->height; y++)
        for (int x = 0; x < stored->width; x++)
            difference[(size_t)y * (size_t)stored->width + (size_t)x] =
                fmaxf(best_match(stored, fresh, x, y), best_match(fresh, stored, x, y));
}

/* Number of pixels that differ visibly from (x0, y0) on, within one tile. */
static int count_tile(const struct patch *patch, const float *difference, int x0, int y0)
{
    int count = 0;
    for (int y = y0; y < y0 + TILE && y < patch->height; y++)
        for (int x = x0; x < x0 + TILE && x < patch->width; x++)
            count += difference[(size_t)y * (size_t)patch->width + (size_t)x] > visible;
    return count;
}

static void judge(const struct patch *patch, const float *difference, const int body[4],
                  struct render_difference *result)
{
    const size_t pixels = (size_t)patch->width * (size_t)patch->height;
    long all = 0;
    int worst = -1;
    for (int y = 0; y < patch->height; y += TILE)
        for (int x = 0; x < patch->width; x += TILE) {
            const int count = count_tile(patch, difference, x, y);
            all += count;
            if (count > worst) {
                worst = count;
                result->tile[0] = body[0] + x;
                result->tile[1] = body[1] + y;
            }
        }
    double sum = 0;
    for (size_t i = 0; i < pixels; i++)
        sum += (double)difference[i];
    result->mean_delta_e = sum / (double)pixels;
    result->fraction = (double)all / (double)pixels;
    result->worst_tile = (double)worst / (TILE * TILE); /* of a whole tile, also where the rim cuts one off */
    result->same = render_within(result, render_tolerance_default);
}

/* The fresh picture in faint grey, visible differences in red on it, and a frame around the worst tile. */
static struct render_image *paint_difference(const struct render_image *fresh, const float *difference,
                                             const struct render_difference *result)
{
    struct render_image *picture = render_image_create(fresh->width, fresh->height);
    if (!picture)
        return NULL;
    const int *body = fresh->body;
    memcpy(picture->body, body, sizeof picture->body);
    for (int y = 0; y < fresh->height; y++)
        for (int x = 0; x < fresh->width; x++) {
            const size_t pixel = (size_t)y * (size_t)fresh->width + (size_t)x;
            const uint8_t *in = fresh->rgb + 3 * pixel;
            uint8_t *out = picture->rgb + 3 * pixel;
            const int grey = 170 + (2 * in[0] + 5 * in[1] + in[2]) / 8 / 3;
            const bool inside = x >= body[0] && x < body[2] && y >= body[1] && y < body[3];
            const float delta =
                inside ? difference[(size_t)(y - body[1]) * (size_t)(body[2] - body[0]) + (size_t)(x - body[0])] : 0;
            /* From light red at the threshold to dark red at ten times it. */
            const float heat = fminf(fmaxf((delta - visible) / (9 * visible), 0), 1);
            out[0] = delta > visible ? (uint8_t)(255 - 105 * heat) : (uint8_t)grey;
            out[1] = out[2] = delta > visible ? (uint8_t)(120 * (1 - heat)) : (uint8_t)grey;
        }
    if (result->worst_tile <= 0)
        return picture;
    for (int i = -2; i < TILE + 2; i++) {
        const int at[4][2] = {{i, -2}, {i, TILE + 1}, {-2, i}, {TILE + 1, i}};
        for (int k = 0; k < 4; k++) {
            const int x = result->tile[0] + at[k][0], y = result->tile[1] + at[k][1];
            if (x >= 0 && x < picture->width && y >= 0 && y < picture->height)
                memset(picture->rgb + 3 * ((size_t)y * (size_t)picture->width + (size_t)x), 0, 3);
        }
    }
    return picture;
}

static bool has_body(const struct render_image *image)
{
    const int *b = image->body;
    return b[0] >= 0 && b[1] >= 0 && b[0] < b[2] && b[1] < b[3] && b[2] <= image->width && b[3] <= image->height;
}

static bool comparable(const struct render_image *stored, const struct render_image *fresh, char why[RENDER_WHY])
{
    if (stored->width != fresh->width || stored->height != fresh->height)
        return render_fail(why, "the stored picture has %d x %d pixels, the fresh one %d x %d; expected the same",
                           stored->width, stored->height, fresh->width, fresh->height);
    const int *s = stored->body, *f = fresh->body;
    if (!has_body(stored) || !has_body(fresh) || memcmp(s, f, sizeof stored->body) != 0)
        return render_fail(why,
                           "the body rectangle of the stored picture is {%d, %d, %d, %d}, of the fresh one "
                           "{%d, %d, %d, %d}; expected the same, within %d x %d pixels",
                           s[0], s[1], s[2], s[3], f[0], f[1], f[2], f[3], fresh->width, fresh->height);
    return true;
}

bool render_compare(const struct render_image *stored, const struct render_image *fresh, bool want_picture,
                    struct render_difference *difference, char why[RENDER_WHY])
{
    *difference = (struct render_difference){0};
    if (!comparable(stored, fresh, why))
        return false;
    struct patch a = {0}, b = {0};
    float *pixels = NULL;
    bool fine = make_patch(stored, &a) && make_patch(fresh, &b);
    if (fine)
        pixels = calloc((size_t)a.width * (size_t)a.height, sizeof *pixels);
    if (pixels) {
        subtract(&a, &b, pixels);
        judge(&a, pixels, fresh->body, difference);
        if (want_picture)
            difference->picture = paint_difference(fresh, pixels, difference);
    }
    fine = pixels && (!want_picture || difference->picture);
    free(a.lab);
    free(b.lab);
    free(pixels);
    return fine ||
           render_fail(why, "no memory for comparing two pictures of %d x %d pixels", fresh->width, fresh->height);
}
