/* Drawing: the right colours in the right places, no holes, the same bytes each time, and refusals that say why. */
#include "render/colormap.h"
#include "render/mesh.h"
#include "render/render.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A unit square of 2 x 2 quads in the plane of x and y, its scalar x. */
static double square_position[9][3], square_scalar[9];
static uint32_t square_quad[4][4];

static struct render_surface square(void)
{
    for (int i = 0; i < 9; i++) {
        square_position[i][0] = square_scalar[i] = 0.5 * (i % 3);
        square_position[i][1] = 0.5 * (i / 3); /* NOLINT(bugprone-integer-division): rows */
        square_position[i][2] = 0;
    }
    for (uint32_t q = 0; q < 4; q++) {
        const uint32_t v = q % 2 + 3 * (q / 2), corner[4] = {v, v + 1, v + 4, v + 3};
        memcpy(square_quad[q], corner, sizeof corner);
    }
    return (struct render_surface){9, square_position[0], square_scalar, 4, square_quad[0]};
}

static struct render_view front(void)
{
    return (struct render_view){{0, 0, 2}, {0, 3, 0}, {0, 1}, 4, 400, 320, {0, 1, 0, 1, 0, 0}, "title", "x", "m"};
}

static struct render_image *draw(const struct render_surface *surface, const struct render_view *view)
{
    struct render_image *image = NULL;
    char why[RENDER_WHY] = "";
    CU_ASSERT_TRUE_FATAL(render_draw(surface, view, &image, why));
    return image;
}

/* The pixel at a place of the body rectangle's largest square, (0, 0) its lower left and (1, 1) its upper right,
 * where the unit square of the view above lies within a margin of 4 %. */
static const uint8_t *pixel(const struct render_image *image, double x, double y)
{
    const int *b = image->body;
    const double width = b[2] - b[0], height = b[3] - b[1], side = 0.92 * fmin(width, height);
    const int u = (int)floor(b[0] + width / 2 + (x - 0.5) * side), v = (int)floor(b[1] + height / 2 - (y - 0.5) * side);
    return image->rgb + 3 * ((size_t)v * (size_t)image->width + (size_t)u);
}

static void expect_band(const uint8_t *pixel_here, int bands, int band)
{
    float colour[RENDER_BANDS][3];
    render_colormap_bands(bands, colour[0]);
    for (int c = 0; c < 3; c++)
        CU_ASSERT_TRUE(abs((int)lround(255 * (double)colour[band][c]) - pixel_here[c]) <= 1);
}

static void expect_colour(const uint8_t *pixel_here, int red, int green, int blue)
{
    CU_ASSERT_EQUAL(pixel_here[0], red);
    CU_ASSERT_EQUAL(pixel_here[1], green);
    CU_ASSERT_EQUAL(pixel_here[2], blue);
}

/* A flat body shows the bar's colours unshaded, each band where the field puts it, seen from either side. */
static void bands_lie_where_the_field_puts_them(void)
{
    const struct render_surface surface = square();
    struct render_view view = front();
    for (int side = 0; side < 2; side++) {
        view.direction[2] = side ? -1 : 1;
        struct render_image *image = draw(&surface, &view);
        for (int i = 1; i < 20; i++) {
            const double x = i / 20.0 + 0.01; /* away from the boundaries between bands */
            for (double y = 0.05; y < 1; y += 0.1)
                expect_band(pixel(image, side ? 1 - x : x, y), 4, (int)floor(4 * x));
        }
        expect_colour(pixel(image, -0.03, 0.5), 255, 255, 255);
        render_image_free(image);
    }
}

static void values_beyond_the_range_take_its_ends(void)
{
    const struct render_surface surface = square();
    struct render_view view = front();
    view.range[0] = 0.4;
    view.range[1] = 0.6;
    struct render_image *image = draw(&surface, &view);
    expect_band(pixel(image, 0.2, 0.3), 4, 0);
    expect_band(pixel(image, 0.8, 0.3), 4, 3);
    render_image_free(image);
}

/* Round-off around a boundary between bands must not speckle. */
static void round_off_does_not_flicker(void)
{
    const struct render_surface surface = square();
    const struct render_view view = front();
    for (int i = 0; i < 9; i++)
        square_scalar[i] = 0.5 + (i % 2 ? 1e-15 : -1e-13);
    struct render_image *image = draw(&surface, &view);
    for (double x = 0.03; x < 1; x += 0.01)
        for (double y = 0.03; y < 1; y += 0.02)
            expect_band(pixel(image, x, y), 4, 2);
    render_image_free(image);
}

static void what_is_not_finite_is_loud(void)
{
    const double wrong[3] = {NAN, INFINITY, -INFINITY};
    const struct render_view view = front();
    for (int i = 0; i < 3; i++) {
        const struct render_surface surface = square();
        square_scalar[0] = wrong[i];
        struct render_image *image = draw(&surface, &view);
        expect_colour(pixel(image, 0.25, 0.2), 255, 0, 255);
        expect_colour(pixel(image, 0.45, 0.45), 255, 0, 255); /* the whole quad */
        expect_band(pixel(image, 0.6, 0.2), 4, 2);
        render_image_free(image);
    }
}

static void triangles_and_lines_are_drawn(void)
{
    struct render_surface surface = square();
    struct render_view view = front();
    const uint32_t triangle[4] = {0, 8, 6, 6};
    surface.quad = triangle;
    surface.quad_count = 1;
    struct render_image *image = draw(&surface, &view);
    expect_band(pixel(image, 0.1, 0.8), 4, 0);
    expect_band(pixel(image, 0.6, 0.8), 4, 2);
    expect_colour(pixel(image, 0.8, 0.2), 255, 255, 255);
    render_image_free(image);

    const uint32_t lines[2][4] = {{3, 4, 4, 4}, {5, 4, 4, 4}}; /* against each other */
    surface.quad = lines[0];
    surface.quad_count = 2;
    image = draw(&surface, &view);
    for (int i = 1; i < 20; i++)
        expect_band(pixel(image, i / 20.0 + 0.01, 0.51), 4, (int)floor(4 * (i / 20.0 + 0.01)));
    expect_colour(pixel(image, 0.5, 0.6), 255, 255, 255);
    render_image_free(image);
}

/* Nearer points hide those behind, whatever the order of drawing. */
static void the_nearer_hides_the_farther(void)
{
    static const double position[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                          {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    static const double scalar[8] = {0.1, 0.1, 0.1, 0.1, 0.9, 0.9, 0.9, 0.9};
    static const uint32_t quad[2][2][4] = {{{0, 1, 2, 3}, {4, 5, 6, 7}}, {{4, 5, 6, 7}, {0, 1, 2, 3}}};
    for (int order = 0; order < 2; order++)
        for (int side = 0; side < 2; side++) {
            const struct render_surface surface = {8, position[0], scalar, 2, quad[order][0]};
            struct render_view view = front();
            view.frame[5] = 1;
            view.direction[2] = side ? 1 : -1;
            struct render_image *image = draw(&surface, &view);
            expect_band(pixel(image, 0.3, 0.3), 4, side ? 3 : 0);
            render_image_free(image);
        }
}

/* The eight corners of the frame fit from any side, and a body that leaves it stays out of text and colour bar. */
static void the_frame_fits_and_nothing_leaves_it(void)
{
    struct render_surface surface = square();
    struct render_view view = front();
    struct render_image *true_one = draw(&surface, &view);
    for (int i = 0; i < 9; i++)
        for (int c = 0; c < 2; c++)
            square_position[i][c] = 30 * square_position[i][c] - 10;
    struct render_image *large = draw(&surface, &view);
    int outside = 0, white = 0;
    for (int y = 0; y < large->height; y++)
        for (int x = 0; x < large->width; x++) {
            const int *b = large->body;
            const bool inside = x >= b[0] && x < b[2] && y >= b[1] && y < b[3];
            const uint8_t *one = large->rgb + 3 * (y * large->width + x);
            outside += !inside && memcmp(one, true_one->rgb + 3 * (y * large->width + x), 3) != 0;
            white += inside && one[0] == 255 && one[1] == 255 && one[2] == 255;
        }
    /* The field runs beyond the picture: nothing outside changes, and inside there is no hole. */
    CU_ASSERT_EQUAL(outside, 0);
    CU_ASSERT_EQUAL(white, 0);
    render_image_free(true_one);
    render_image_free(large);
}

static void refuses(const struct render_surface *surface, const struct render_view *view, const char *expected)
{
    struct render_image *image = NULL;
    char why[RENDER_WHY] = "";
    CU_ASSERT_FALSE(render_draw(surface, view, &image, why));
    CU_ASSERT_PTR_NULL(image);
    CU_ASSERT_PTR_NOT_NULL(strstr(why, expected));
}

#define REFUSES_VIEW(change, expected)                                                                                 \
    do {                                                                                                               \
        const struct render_surface surface = square();                                                                \
        struct render_view view = front();                                                                             \
        change;                                                                                                        \
        refuses(&surface, &view, expected);                                                                            \
    } while (0)

static void wrong_views_are_refused(void)
{
    unit_untrapped();
    REFUSES_VIEW(view.direction[2] = 0, "direction");
    REFUSES_VIEW(view.direction[0] = NAN, "direction");
    REFUSES_VIEW(view.up[1] = 0, "up");
    REFUSES_VIEW((view.up[1] = 0, view.up[2] = 1), "up");
    REFUSES_VIEW(view.up[0] = INFINITY, "up");
    REFUSES_VIEW(view.range[1] = 0, "range");
    REFUSES_VIEW(view.range[1] = -1, "range");
    REFUSES_VIEW(view.range[0] = NAN, "range");
    REFUSES_VIEW((view.range[0] = -1e308, view.range[1] = 1e308), "range");
    REFUSES_VIEW((view.range[0] = 1, view.range[1] = 1 + 1e-12), "range");
    REFUSES_VIEW(view.bands = 0, "bands");
    REFUSES_VIEW(view.bands = RENDER_BANDS + 1, "bands");
    REFUSES_VIEW(view.width = 0, "pixels");
    REFUSES_VIEW(view.height = 1 << 30, "pixels");
    REFUSES_VIEW(view.frame[1] = -1, "frame along x");
    REFUSES_VIEW(view.frame[4] = NAN, "frame along z");
    REFUSES_VIEW(view.frame[1] = view.frame[3] = 0, "no size");
    REFUSES_VIEW(view.title = NULL, "title");
}

static void wrong_surfaces_are_refused(void)
{
    unit_untrapped();
    const struct render_view view = front();
    struct render_surface surface = square();
    square_quad[3][2] = 9;
    refuses(&surface, &view, "quad 3 names vertex 9");
    surface = square();
    square_position[5][1] = NAN;
    refuses(&surface, &view, "vertex 5");
    surface = square();
    surface.quad_count = 0;
    refuses(&surface, &view, "nothing to draw");
    surface = square();
    surface.scalar = NULL;
    refuses(&surface, &view, "missing");
    surface = square();
    square_position[4][2] = 1e308;
    square_position[5][2] = -1e308;
    refuses(&surface, &view, "too large");
}

/* Texts of any length and content, the smallest picture, one band and many: drawn, and the same bytes twice. */
static void odd_views_are_drawn_the_same_twice(void)
{
    const struct render_surface surface = square();
    static char text[5000];
    for (size_t i = 0; i < sizeof text - 1; i++)
        text[i] = (char)(1 + i % 255);
    for (int k = 0; k < 3; k++) {
        struct render_view view = front();
        view.title = view.label = view.unit = k == 0 ? "" : text;
        view.bands = k == 1 ? 1 : RENDER_BANDS;
        view.width = view.height = k == 2 ? 160 : 300;
        struct render_image *one = draw(&surface, &view), *two = draw(&surface, &view);
        const size_t size = (size_t)one->width * (size_t)one->height * 3;
        CU_ASSERT_EQUAL(memcmp(one->rgb, two->rgb, size), 0);
        render_image_free(one);
        render_image_free(two);
    }
}

/* A square, and a triangle that is folded back from one of its sides onto it: of a flat body the fold is no rim. */
static void folds(void)
{
    static const double position[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.6, 0.5, 0}}, scalar[5];
    static const double eye[3] = {0, 0, 1};
    static const uint32_t quad[2][4] = {{0, 1, 2, 3}, {1, 2, 4, 4}};
    const struct render_surface surface = {5, position[0], scalar, 2, quad[0]};
    struct render_mesh mesh;
    char why[RENDER_WHY];
    CU_ASSERT_TRUE_FATAL(render_mesh_build(&surface, eye, &mesh, why));
    CU_ASSERT_TRUE(mesh.flat);
    CU_ASSERT_EQUAL(mesh.edge_count, 5);
    for (size_t i = 0; i < mesh.edge_count; i++) {
        CU_ASSERT_FALSE(mesh.edge[i][0] == 1 && mesh.edge[i][1] == 2);
    }
    render_mesh_free(&mesh);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"bands lie where the field puts them", bands_lie_where_the_field_puts_them},
        {"values beyond the range take its ends", values_beyond_the_range_take_its_ends},
        {"round-off does not flicker", round_off_does_not_flicker},
        {"what is not finite is loud", what_is_not_finite_is_loud},
        {"triangles and lines are drawn", triangles_and_lines_are_drawn},
        {"the nearer hides the farther", the_nearer_hides_the_farther},
        {"the frame fits and nothing leaves it", the_frame_fits_and_nothing_leaves_it},
        {"wrong views are refused", wrong_views_are_refused},
        {"wrong surfaces are refused", wrong_surfaces_are_refused},
        {"odd views are drawn the same twice", odd_views_are_drawn_the_same_twice},
        {"quads over one another in a flat body", folds},
    };
    return unit_main("render draw", tests, sizeof tests / sizeof *tests);
}
