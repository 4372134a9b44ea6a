/* Draws one picture of each kind of body, for people to look at, and checks that another rasteriser or number of
 * threads draws the same.
 * Usage: image_gallery FOLDER [OTHER bytes|look]: OTHER holds the pictures of an earlier call, to be matched to the
 * byte or by their look. */
#include "tests/image/body.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static void check(bool fine, const char *why)
{
    if (fine)
        return;
    fprintf(stderr, "image_gallery: %s\n", why);
    exit(1);
}

/* Against the picture of the same name in `other`. */
static void match(const struct render_image *image, const char *other, const char *name, bool bytes)
{
    char path[1024], why[RENDER_WHY];
    snprintf(path, sizeof path, "%s/%s.png", other, name);
    struct render_image *earlier;
    struct render_difference difference;
    check(render_png_read(path, &earlier, why), why);
    check(render_compare(earlier, image, false, &difference, why), why);
    const size_t size = (size_t)image->width * (size_t)image->height * 3;
    const bool equal = memcmp(image->rgb, earlier->rgb, size) == 0;
    printf("%s: %s, fraction %g, worst tile %g, mean difference %g\n", name, equal ? "same bytes" : "other bytes",
           difference.fraction, difference.worst_tile, difference.mean_delta_e);
    check(difference.same, "the pictures look different");
    check(equal || !bytes, "the pictures differ in bytes");
    render_image_free(earlier);
}

static void draw(const struct render_surface *surface, const struct render_view *view, const char *name, char **argv)
{
    char path[1024], why[RENDER_WHY];
    struct render_image *image;
    check(render_draw(surface, view, &image, why), why);
    snprintf(path, sizeof path, "%s/%s.png", argv[1], name);
    check(render_png_write(path, image, why), why);
    if (argv[2])
        match(image, argv[2], name, strcmp(argv[3], "bytes") == 0);
    render_image_free(image);
}

static void draw_cubes(char **argv)
{
    static struct body body;
    body_fill(&body);
    struct render_view view = body_view();
    draw(&body.surface, &view, "cube", argv);
    view.range[0] = -6e5;
    view.range[1] = 6e5;
    view.bands = 8;
    view.title = "Values beyond the range, a NaN and a missing quad";
    body.scalar[5 * (BODY_N + 1) * (BODY_N + 1) + 8 * (BODY_N + 1) + 12] = NAN;
    memset(body.quad[2 * BODY_N * BODY_N + 300], 0, sizeof *body.quad);
    draw(&body.surface, &view, "cube-faults", argv);
}

static void draw_plate(char **argv)
{
    enum { NX = 48, NY = 16, COUNT = (NX + 1) * (NY + 1) };
    static double position[COUNT][3], scalar[COUNT];
    static uint32_t quad[NX * NY][4];
    for (uint32_t j = 0, v = 0, q = 0; j <= NY; j++)
        for (uint32_t i = 0; i <= NX; i++, v++) {
            const double x = 3.0 * i / NX, y = 1.0 * j / NY - 0.5;
            position[v][0] = x - 0.08 * x * y;
            position[v][1] = y - 0.07 * x * x;
            scalar[v] = 4.2e-4 * (3 - x) * y * 2 / 3 + 2e-5 * sin(3 * x);
            if (i == NX || j == NY)
                continue;
            const uint32_t corner[4] = {v, v + 1, v + NX + 2, v + NX + 1};
            memcpy(quad[q++], corner, sizeof corner);
        }
    const struct render_surface surface = {COUNT, position[0], scalar, NX * NY, quad[0]};
    const struct render_view view = {{0, 0, 1}, {0, 1, 0}, {-4.5e-4, 4.5e-4},         9,
                                     800,       480,       {0, 3.1, -1.2, 0.5, 0, 0}, "Bending column, t = 0.35 s",
                                     "J - 1",   "-"};
    draw(&surface, &view, "plate", argv);
}

static void draw_bar(char **argv)
{
    enum { N = 40 };
    static double position[N + 1][3], scalar[N + 1];
    static uint32_t quad[N][4];
    for (uint32_t i = 0; i <= N; i++) {
        position[i][0] = 10.0 * i / N;
        scalar[i] = 250 * tanh(2 * (position[i][0] - 6)) + 40 * sin(position[i][0]);
        if (i < N)
            memcpy(quad[i], (uint32_t[]){i, i + 1, i + 1, i + 1}, sizeof quad[i]);
    }
    const struct render_surface surface = {N + 1, position[0], scalar, N, quad[0]};
    const struct render_view view = {{0, 0, 1},    {0, 1, 0}, {-300, 300},         12,
                                     800,          320,       {0, 10, 0, 0, 0, 0}, "Wave in a bar, t = 1.25 \u00b5s",
                                     "velocity_x", "m/s"};
    draw(&surface, &view, "bar", argv);
}

int main(int argc, char **argv)
{
    if ((argc != 2 && argc != 4) || (argc == 4 && strcmp(argv[3], "bytes") != 0 && strcmp(argv[3], "look") != 0)) {
        fprintf(stderr, "usage: image_gallery FOLDER [OTHER bytes|look]\n");
        return 2;
    }
    mkdir(argv[1], 0777); /* may be there already; if it cannot be made, writing into it says why */
    draw_cubes(argv);
    draw_plate(argv);
    draw_bar(argv);
    return 0;
}
