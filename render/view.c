#include "render/view.h"

#include "render/colormap.h"
#include "render/fail.h"
#include "render/image.h"
#include "render/vector.h"

#include <math.h>

static const double margin = 0.04; /* of the body rectangle, on each side */

static bool finite3(const double v[3])
{
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

bool render_view_check(const struct render_view *view, char why[RENDER_WHY])
{
    if (!view->title || !view->label || !view->unit)
        return render_fail(why, "view: title, label or unit is missing; an empty text is allowed");
    if (view->width < RENDER_LEAST || view->width > RENDER_MOST || view->height < RENDER_LEAST ||
        view->height > RENDER_MOST)
        return render_fail(why, "view: a size of %d x %d pixels; each must be within %d and %d", view->width,
                           view->height, RENDER_LEAST, RENDER_MOST);
    if (view->bands < 1 || view->bands > RENDER_BANDS)
        return render_fail(why, "view: %d colour bands; expected 1 to %d", view->bands, RENDER_BANDS);
    const double lower = view->range[0], upper = view->range[1];
    if (!isfinite(lower) || !isfinite(upper) || !isfinite(upper - lower) ||
        !(upper - lower > 1e-9 * fmax(fabs(lower), fabs(upper))))
        return render_fail(why,
                           "view: the colour range %g to %g; expected two finite numbers, the second larger by "
                           "more than their ninth digit",
                           lower, upper);
    const double *d = view->direction, *u = view->up;
    if (!finite3(d) || !(render_norm(d) > 0))
        return render_fail(why, "view: direction {%g, %g, %g}; expected a finite vector, not zero", d[0], d[1], d[2]);
    double side[3];
    render_cross(u, d, side);
    if (!finite3(u) || !(render_norm(side) > 1e-6 * render_norm(u) * render_norm(d)))
        return render_fail(why, "view: up {%g, %g, %g}; expected a finite vector, not zero and not along the direction",
                           u[0], u[1], u[2]);
    for (int i = 0; i < 3; i++)
        if (!isfinite(view->frame[2 * i]) || !isfinite(view->frame[2 * i + 1]) ||
            view->frame[2 * i] > view->frame[2 * i + 1])
            return render_fail(why,
                               "view: the frame along %c from %g to %g; expected finite numbers, the first not "
                               "above the second",
                               'x' + i, view->frame[2 * i], view->frame[2 * i + 1]);
    return true;
}

static void widen(double interval[2], double value)
{
    interval[0] = fmin(interval[0], value);
    interval[1] = fmax(interval[1], value);
}

bool render_camera_aim(const struct render_view *view, const int body[4], const double *position, size_t count,
                       struct render_camera *camera, char why[RENDER_WHY])
{
    render_unit(view->direction, camera->eye);
    render_cross(view->up, camera->eye, camera->right);
    render_unit(camera->right, camera->right);
    render_cross(camera->eye, camera->right, camera->up);

    double across[2] = {INFINITY, -INFINITY}, along[2] = {INFINITY, -INFINITY}, depth[2] = {INFINITY, -INFINITY};
    for (int i = 0; i < 8; i++) {
        const double corner[3] = {view->frame[i & 1], view->frame[2 + (i >> 1 & 1)], view->frame[4 + (i >> 2)]};
        widen(across, render_dot(camera->right, corner));
        widen(along, render_dot(camera->up, corner));
        widen(depth, render_dot(camera->eye, corner));
    }
    const double width = across[1] - across[0], height = along[1] - along[0];
    const double size = fmax(fmax(width, height), depth[1] - depth[0]);
    if (!isfinite(size) || !(fmax(width, height) > 1e-6 * size))
        return render_fail(why, "view: the frame has no size seen along {%g, %g, %g}", view->direction[0],
                           view->direction[1], view->direction[2]);
    const double room = 1 - 2 * margin;
    /* what has no extent one way is as large as it is the other way */
    const double to_width = width > 0 ? room * (body[2] - body[0]) / width : INFINITY;
    const double to_height = height > 0 ? room * (body[3] - body[1]) / height : INFINITY;
    camera->scale = fmin(to_width, to_height);
    camera->middle[0] = (across[0] + across[1]) / 2;
    camera->middle[1] = (along[0] + along[1]) / 2;
    camera->centre[0] = 0.5 * (body[0] + body[2]);
    camera->centre[1] = 0.5 * (body[1] + body[3]);

    for (size_t i = 0; i < count; i++)
        widen(depth, render_dot(camera->eye, position + 3 * i));
    camera->nearest = depth[1] + 0.05 * size;
    camera->farthest = depth[0] - 0.05 * size;
    if (!isfinite(camera->nearest - camera->farthest) || !isfinite(camera->scale))
        return render_fail(why, "the body or the frame is too large, or too small, to be drawn");
    return true;
}

void render_camera_project(const struct render_camera *camera, const double place[3], float out[3])
{
    const double x = render_dot(camera->right, place) - camera->middle[0];
    const double y = render_dot(camera->up, place) - camera->middle[1];
    const double z = camera->nearest - render_dot(camera->eye, place);
    /* Far outside the picture it does not matter where, but single precision must hold it. */
    out[0] = (float)fmin(fmax(camera->centre[0] + camera->scale * x, -1e6), 1e6);
    out[1] = (float)fmin(fmax(camera->centre[1] - camera->scale * y, -1e6), 1e6);
    out[2] = (float)(z / (camera->nearest - camera->farthest));
}
