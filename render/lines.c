#include "render/body.h"

#include "render/fail.h"

#include <math.h>
#include <stdlib.h>

static const float ribbon = 26; /* width in pixels at 800 x 640 */

/* At each vertex of a line. */
struct joint {
    float side[2]; /* half the ribbon's width, across the mean direction of the lines that meet here */
    int lines;
};

static bool line_ends(const struct render_surface *surface, size_t quad, uint32_t end[2])
{
    uint32_t corner[4];
    if (render_quad_corners(surface->quad + 4 * quad, corner) != RENDER_LINE)
        return false;
    end[0] = corner[0];
    end[1] = corner[1];
    return true;
}

static void find_sides(const struct render_body *body, struct joint *joint)
{
    const struct render_surface *surface = body->surface;
    const double no_normal[3] = {0};
    uint32_t end[2];
    for (size_t q = 0; q < surface->quad_count; q++) {
        if (!line_ends(surface, q, end))
            continue;
        const struct render_point a = render_body_point(body, end[0], no_normal);
        const struct render_point b = render_body_point(body, end[1], no_normal);
        const float nx = a.y - b.y, ny = b.x - a.x, length = hypotf(nx, ny);
        for (int i = 0; i < 2 && length > 0; i++) {
            float *sum = joint[end[i]].side;
            const float turn = sum[0] * nx + sum[1] * ny < 0 ? -1 : 1; /* lines may run either way */
            sum[0] += turn * nx / length;
            sum[1] += turn * ny / length;
            joint[end[i]].lines++;
        }
    }
    for (size_t v = 0; v < surface->vertex_count; v++) {
        const float length = hypotf(joint[v].side[0], joint[v].side[1]);
        for (int i = 0; i < 2 && length > 0; i++)
            joint[v].side[i] *= ribbon * body->layout.unit / 2 / length;
    }
}

static void draw_line(const struct render_body *body, const struct joint *joint, const uint32_t end[2])
{
    const struct joint *a = &joint[end[0]], *b = &joint[end[1]];
    const double no_normal[3] = {0};
    /* The two ends may count opposite sides as theirs. */
    const float turn = a->side[0] * b->side[0] + a->side[1] * b->side[1] < 0 ? -1 : 1;
    const float sign[4] = {1, turn, -turn, -1};
    struct render_point corner[4];
    for (int i = 0; i < 4; i++) {
        const int which = i == 1 || i == 2;
        corner[i] = render_body_point(body, end[which], no_normal);
        corner[i].x += sign[i] * joint[end[which]].side[0];
        corner[i].y += sign[i] * joint[end[which]].side[1];
    }
    render_body_patch(body, corner);
    render_body_stroke(body, &corner[0], &corner[1]);
    render_body_stroke(body, &corner[2], &corner[3]);
    if (a->lines == 1)
        render_body_stroke(body, &corner[3], &corner[0]);
    if (b->lines == 1)
        render_body_stroke(body, &corner[1], &corner[2]);
}

bool render_body_lines(const struct render_body *body, char why[RENDER_WHY])
{
    struct joint *joint = calloc(body->surface->vertex_count, sizeof *joint);
    if (!joint)
        return render_fail(why, "no memory for drawing lines of %zu vertices", body->surface->vertex_count);
    find_sides(body, joint);
    uint32_t end[2];
    for (size_t q = 0; q < body->surface->quad_count; q++)
        if (line_ends(body->surface, q, end))
            draw_line(body, joint, end);
    free(joint);
    return true;
}
