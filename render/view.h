/* From the body's place in space to the picture: an orthographic view that is framed once and stays. */
#ifndef RENDER_VIEW_H
#define RENDER_VIEW_H

#include "render/render.h"

struct render_camera {
    double right[3], up[3], eye[3]; /* orthonormal; eye points from the body to the viewer */
    double scale;                   /* [pixels/m] */
    double middle[2], centre[2];    /* the frame's middle along right and up [m] falls on this pixel */
    double nearest, farthest;       /* along eye [m] */
};

/* Refuses a view that cannot be drawn, and says which entry is wrong. */
bool render_view_check(const struct render_view *view, char why[RENDER_WHY]);
/* Points the camera so that the eight corners of the frame fit into the body rectangle. Depth reaches over the frame
 * and over all `count` positions [count][3]. The view must have passed its check. */
bool render_camera_aim(const struct render_view *view, const int body[4], const double *position, size_t count,
                       struct render_camera *camera, char why[RENDER_WHY]);
/* Pixel and depth (0 near .. 1 far) of a place [m]. */
void render_camera_project(const struct render_camera *camera, const double place[3], float out[3]);

#endif
