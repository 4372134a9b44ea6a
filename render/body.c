#include "render/body.h"

#include "render/vector.h"

#include <math.h>

static const float edge_width = 1.3f; /* pixels at 800 x 640 */
static const double shadow = 0.16;    /* largest loss of brightness by shading */

/* Place of a value in the colour range. Rounded to 2^-16 of the range, so that a field that is constant but for
 * round-off does not flicker between two bands, and moved by less than that so that a value on a boundary falls into
 * the band above it wherever it is interpolated. */
static float band_place(const struct render_view *view, double scalar)
{
    const double place = (scalar - view->range[0]) / (view->range[1] - view->range[0]);
    return (float)((nearbyint(fmin(fmax(place, -8), 9) * 65536) + 0.25) / 65536);
}

static double shade(const struct render_body *body, const double normal[3])
{
    if (body->mesh.flat || render_norm(normal) <= 0)
        return 1;
    const double towards = render_dot(normal, body->camera.eye) < 0 ? -1 : 1; /* the side that is seen */
    return 1 - shadow * fmin(1, 1 - towards * render_dot(normal, body->light));
}

/* The point of a vertex; magenta where its scalar is not finite. */
struct render_point render_body_point(const struct render_body *body, uint32_t vertex, const double normal[3])
{
    float place[3];
    render_camera_project(&body->camera, body->surface->position + 3 * (size_t)vertex, place);
    const double scalar = body->surface->scalar[vertex];
    struct render_point point = {place[0],
                                 place[1],
                                 place[2],
                                 render_loud.red,
                                 render_loud.green,
                                 render_loud.blue,
                                 .shade = (float)shade(body, normal)};
    if (isfinite(scalar))
        point.band = band_place(body->view, scalar);
    else
        point.plain = 1;
    return point;
}

/* One loud corner makes the whole patch loud. */
static void agree(struct render_point *corner, int count)
{
    float plain = 0;
    for (int i = 0; i < count; i++)
        plain = fmaxf(plain, corner[i].plain);
    for (int i = 0; i < count; i++)
        corner[i].plain = plain;
}

/* Four triangles around the middle, so that no diagonal is preferred. */
void render_body_patch(const struct render_body *body, struct render_point corner[4])
{
    agree(corner, 4);
    struct render_point middle = corner[0];
    middle.x = middle.y = middle.depth = middle.band = middle.shade = 0;
    for (int i = 0; i < 4; i++) {
        middle.x += corner[i].x / 4;
        middle.y += corner[i].y / 4;
        middle.depth += corner[i].depth / 4;
        middle.band += corner[i].band / 4;
        middle.shade += corner[i].shade / 4;
    }
    for (int i = 0; i < 4; i++)
        render_paint_triangle(body->paint, (struct render_point[]){corner[i], corner[(i + 1) % 4], middle});
}

/* Moved towards the eye by a few widths, so that it does not sink into the surface beside it. */
void render_body_stroke(const struct render_body *body, const struct render_point *from, const struct render_point *to)
{
    const struct render_camera *camera = &body->camera;
    const float width = edge_width * body->layout.unit;
    const float lift = (float)(3 * width / camera->scale / (camera->nearest - camera->farthest));
    const float a[3] = {from->x, from->y, fmaxf(0, from->depth - lift)};
    const float b[3] = {to->x, to->y, fmaxf(0, to->depth - lift)};
    render_paint_stroke(body->paint, a, b, width, render_dark);
}

static void draw_quad(const struct render_body *body, size_t q)
{
    const uint32_t *quad = body->surface->quad + 4 * q;
    uint32_t vertex[4];
    const enum render_kind kind = render_quad_corners(quad, vertex);
    if (kind < RENDER_TRIANGLE)
        return;
    struct render_point corner[4];
    for (int c = 0, slot = 0; c <= (int)kind; c++) {
        while (quad[slot] != vertex[c])
            slot++;
        corner[c] = render_body_point(body, vertex[c], body->mesh.normal[q][slot]);
    }
    if (kind == RENDER_QUAD) {
        render_body_patch(body, corner);
    } else {
        agree(corner, 3);
        render_paint_triangle(body->paint, corner);
    }
}

void render_body_area(const struct render_body *body)
{
    for (size_t q = 0; q < body->surface->quad_count; q++)
        draw_quad(body, q);
    const double no_normal[3] = {0};
    for (size_t e = 0; e < body->mesh.edge_count; e++) {
        const struct render_point from = render_body_point(body, body->mesh.edge[e][0], no_normal);
        const struct render_point to = render_body_point(body, body->mesh.edge[e][1], no_normal);
        render_body_stroke(body, &from, &to);
    }
}
