/* The picture of a body: filled contour bands on its deformed shape, its edges, and what explains them. */
#include "render/body.h"
#include "render/colorbar.h"
#include "render/colormap.h"
#include "render/fail.h"
#include "render/image.h"
#include "render/text.h"
#include "render/vector.h"

#include <math.h>
#include <string.h>

/* The light comes from over the viewer's left shoulder, so that the faces of a cube differ. */
static void place_light(struct render_body *body)
{
    for (int i = 0; i < 3; i++)
        body->light[i] = body->camera.eye[i] + 0.75 * body->camera.up[i] - 0.45 * body->camera.right[i];
    render_unit(body->light, body->light);
}

static struct render_outside look_outside(const struct render_surface *surface, const double range[2])
{
    struct render_outside outside = {0};
    const double slack = 1e-6 * (range[1] - range[0]); /* round-off at the ends is not outside */
    for (size_t i = 0; i < surface->vertex_count; i++) {
        const double scalar = surface->scalar[i];
        outside.nan = outside.nan || !isfinite(scalar);
        outside.below = outside.below || (isfinite(scalar) && scalar < range[0] - slack);
        outside.above = outside.above || (isfinite(scalar) && scalar > range[1] + slack);
    }
    return outside;
}

/* An arrow of the axes, with its letter beyond its tip. */
static void draw_axis(const struct render_body *body, const float origin[2], float length, int axis)
{
    const struct render_camera *camera = &body->camera;
    const float unit = body->layout.unit, head = 7 * unit, size = 9 * unit;
    const float dx = (float)camera->right[axis], dy = -(float)camera->up[axis], seen = hypotf(dx, dy);
    if (seen < 0.15f)
        return; /* points at the viewer */
    const float from[3] = {origin[0], origin[1], 0};
    const float to[3] = {from[0] + length * dx, from[1] + length * dy, 0};
    render_paint_stroke(body->paint, from, to, 1.4f * unit, render_dark);
    const float ux = dx / seen, uy = dy / seen, side = 0.42f * head;
    const float back[2] = {to[0] - head * ux, to[1] - head * uy};
    render_paint_triangle(
        body->paint,
        (struct render_point[]){render_inked(to[0] + 0.5f * head * ux, to[1] + 0.5f * head * uy, 0, render_dark),
                                render_inked(back[0] - side * uy, back[1] + side * ux, 0, render_dark),
                                render_inked(back[0] + side * uy, back[1] - side * ux, 0, render_dark)});
    const char letter[2] = {(char)('X' + axis), 0};
    render_text(body->paint, to[0] + 11 * unit * ux - render_text_width(letter, size) / 2,
                to[1] + 11 * unit * uy + size / 2, size, render_dark, letter);
}

/* The three axes, their origin placed so that they stand in the middle of their corner whichever way they point. */
static void draw_axes(const struct render_body *body)
{
    const double *direction[2] = {body->camera.right, body->camera.up};
    const float length = 26 * body->layout.unit;
    float origin[2];
    for (int i = 0; i < 2; i++) {
        const double *d = direction[i];
        const double low = fmin(0, fmin(d[0], fmin(d[1], d[2]))), high = fmax(0, fmax(d[0], fmax(d[1], d[2])));
        origin[i] = body->layout.axes[i] + (i == 0 ? -1 : 1) * length * (float)(low + high) / 2;
    }
    for (int axis = 0; axis < 3; axis++)
        draw_axis(body, origin, length, axis);
}

static void draw_around(const struct render_body *body, struct render_outside outside)
{
    const struct render_layout *layout = &body->layout;
    render_paint_on_top(body->paint);
    render_text_fit(body->paint, layout->title[0], layout->title[1], 13 * layout->unit, layout->title[2], render_dark,
                    body->view->title);
    render_colorbar(body->paint, layout, body->view, outside);
    draw_axes(body);
}

static bool draw_all(struct render_body *body, struct render_image *image, char why[RENDER_WHY])
{
    float colour[RENDER_BANDS][3];
    render_colormap_bands(body->view->bands, colour[0]);
    if (!render_paint_open(image->width, image->height, colour[0], body->view->bands, &body->paint, why))
        return false;
    render_paint_within(body->paint, body->layout.body);
    render_body_area(body);
    bool fine = render_body_lines(body, why);
    if (fine) {
        draw_around(body, look_outside(body->surface, body->view->range));
        fine = render_paint_finish(body->paint, image, why);
    }
    render_paint_close(body->paint);
    return fine;
}

bool render_draw(const struct render_surface *surface, const struct render_view *view, struct render_image **image,
                 char why[RENDER_WHY])
{
    *image = NULL;
    if (!render_view_check(view, why))
        return false;
    struct render_body body = {.surface = surface, .view = view, .layout = render_layout(view->width, view->height)};
    double eye[3];
    render_unit(view->direction, eye);
    if (!render_mesh_build(surface, eye, &body.mesh, why))
        return false;
    struct render_image *made = render_image_create(view->width, view->height);
    bool fine = made != NULL;
    if (!fine)
        render_fail(why, "no memory for a picture of %d x %d pixels", view->width, view->height);
    fine =
        fine && render_camera_aim(view, body.layout.body, surface->position, surface->vertex_count, &body.camera, why);
    if (fine) {
        memcpy(made->body, body.layout.body, sizeof made->body);
        place_light(&body);
        fine = draw_all(&body, made, why);
    }
    render_mesh_free(&body.mesh);
    if (fine)
        *image = made;
    else
        render_image_free(made);
    return fine;
}
