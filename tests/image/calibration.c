/* One mutation of a picture, drawn, compared with the true one, and expected to be seen or to be forgiven.
 * Usage: image_calibration MUTATION same|different [FOLDER] */
#include "tests/image/body.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct mutation {
    const char *name;
    void (*change)(struct body *body, struct render_view *view);
    void (*touch)(struct render_image *image); /* after drawing; NULL for none */
};

static void keep(struct body *body, struct render_view *view)
{
    (void)body;
    (void)view;
}

static void scale_range(struct render_view *view, double factor)
{
    view->range[0] *= factor;
    view->range[1] *= factor;
}

static void range_up(struct body *body, struct render_view *view)
{
    (void)body;
    scale_range(view, 1.01);
}

static void range_down(struct body *body, struct render_view *view)
{
    (void)body;
    scale_range(view, 0.99);
}

static void range_shift(struct body *body, struct render_view *view)
{
    (void)body;
    const double shift = 0.01 * (view->range[1] - view->range[0]);
    view->range[0] += shift;
    view->range[1] += shift;
}

static void mirror_field(struct body *body, struct render_view *view)
{
    (void)view;
    for (int i = 0; i < BODY_VERTICES; i++)
        body->position[i][0] = 1.1 - body->position[i][0];
}

/* The worst place for a particle to be missing is one where its quads are seen slantwise. */
static void drop_quad(struct body *body, struct render_view *view)
{
    (void)view;
    const int quad = 5 * BODY_N * BODY_N + BODY_N * (BODY_N / 2) + BODY_N / 2;
    memset(body->quad[quad], 0, sizeof body->quad[quad]);
}

static void one_nan(struct body *body, struct render_view *view)
{
    (void)view;
    body->scalar[5 * (BODY_N + 1) * (BODY_N + 1) + (BODY_N + 1) * (BODY_N / 3) + BODY_N / 2] = NAN;
}

/* As a scheme of too low an order errs: smooth, largest where the field bends most. */
static void smooth_error(struct body *body, struct render_view *view)
{
    for (int i = 0; i < BODY_VERTICES; i++) {
        const double *x = body->position[i];
        body->scalar[i] += 0.02 * (view->range[1] - view->range[0]) * cos(M_PI * x[0]) * cos(M_PI * x[1]);
    }
}

/* A whole picture moved by one pixel, white coming in from outside. */
static void shift_pixels(struct render_image *image, int right, int down)
{
    const size_t size = (size_t)image->width * (size_t)image->height * 3;
    uint8_t *old = malloc(size);
    if (!old)
        exit(2);
    memcpy(old, image->rgb, size);
    memset(image->rgb, 255, size);
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x < image->width; x++) {
            const int u = x - right, v = y - down;
            if (u >= 0 && u < image->width && v >= 0 && v < image->height)
                memcpy(image->rgb + ((size_t)y * (size_t)image->width + (size_t)x) * 3,
                       old + ((size_t)v * (size_t)image->width + (size_t)u) * 3, 3);
        }
    free(old);
}

static void shift_right(struct render_image *image)
{
    shift_pixels(image, 1, 0);
}

static void shift_both(struct render_image *image)
{
    shift_pixels(image, -1, 1);
}

static void shift_three(struct render_image *image)
{
    shift_pixels(image, 3, 0);
}

static void round_off(struct body *body, struct render_view *view)
{
    for (int i = 0; i < BODY_VERTICES; i++) {
        body->scalar[i] += 1e-7 * (view->range[1] - view->range[0]) * cos(1e3 * i);
        for (int c = 0; c < 3; c++)
            body->position[i][c] += 1e-8 * sin(1e3 * i + c);
    }
}

static const struct mutation mutations[] = {
    {"identical", keep, NULL},
    {"round-off", round_off, NULL},
    {"shift-right", keep, shift_right},
    {"shift-down-left", keep, shift_both},
    {"shift-three", keep, shift_three},
    {"range-up", range_up, NULL},
    {"range-down", range_down, NULL},
    {"range-shift", range_shift, NULL},
    {"mirrored", mirror_field, NULL},
    {"missing-quad", drop_quad, NULL},
    {"nan", one_nan, NULL},
    {"field-error", smooth_error, NULL},
};

static struct render_image *draw(const struct mutation *mutation)
{
    static struct body body;
    body_fill(&body);
    struct render_view view = body_view();
    mutation->change(&body, &view);
    struct render_image *image;
    char why[RENDER_WHY];
    if (!render_draw(&body.surface, &view, &image, why)) {
        fprintf(stderr, "%s: %s\n", mutation->name, why);
        exit(2);
    }
    if (mutation->touch)
        mutation->touch(image);
    return image;
}

static void store(const char *folder, const char *name, const char *part, const struct render_image *image)
{
    char path[1024], why[RENDER_WHY];
    snprintf(path, sizeof path, "%s/image-%s%s.png", folder, name, part);
    if (!render_png_write(path, image, why)) {
        fprintf(stderr, "%s\n", why);
        exit(2);
    }
}

int main(int argc, char **argv)
{
    const struct mutation *mutation = NULL;
    for (size_t i = 0; argc >= 3 && i < sizeof mutations / sizeof *mutations; i++)
        if (strcmp(argv[1], mutations[i].name) == 0)
            mutation = &mutations[i];
    const bool expected = argc >= 3 && strcmp(argv[2], "same") == 0;
    if (!mutation || (!expected && strcmp(argv[2], "different") != 0)) {
        fprintf(stderr, "usage: image_calibration MUTATION same|different [FOLDER]\n");
        return 2;
    }
    struct render_image *truth = draw(&mutations[0]), *changed = draw(mutation);
    struct render_difference difference;
    char why[RENDER_WHY];
    if (!render_compare(truth, changed, true, &difference, why)) {
        fprintf(stderr, "%s\n", why);
        return 2;
    }
    printf("%-16s fraction %.6f  worst tile %.4f at (%d, %d)  mean difference %.4f: %s\n", mutation->name,
           difference.fraction, difference.worst_tile, difference.tile[0], difference.tile[1], difference.mean_delta_e,
           difference.same ? "same" : "different");
    if (argc > 3) {
        store(argv[3], mutation->name, "", changed);
        store(argv[3], mutation->name, "-difference", difference.picture);
    }
    render_image_free(difference.picture);
    render_image_free(truth);
    render_image_free(changed);
    return difference.same == expected ? 0 : 1;
}
