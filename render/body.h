/* The body in a picture: what body.c (surfaces) and lines.c (bodies of one dimension) share. */
#ifndef RENDER_BODY_H
#define RENDER_BODY_H

#include "render/layout.h"
#include "render/mesh.h"
#include "render/view.h"

struct render_body {
    const struct render_surface *surface;
    const struct render_view *view;
    struct render_layout layout;
    struct render_camera camera;
    struct render_mesh mesh;
    double light[3]; /* unit vector towards the light */
    struct render_paint *paint;
};

/* Filled bands on all quads and triangles, and the edges of the body. */
void render_body_area(const struct render_body *body);
/* A ribbon of filled bands along all lines. */
bool render_body_lines(const struct render_body *body, char why[RENDER_WHY]);

/* The point of a vertex, shaded for a surface with this normal; magenta where its scalar is not finite. */
struct render_point render_body_point(const struct render_body *body, uint32_t vertex, const double normal[3]);
/* Four points in order around a patch; one that is magenta makes the whole patch so. */
void render_body_patch(const struct render_body *body, struct render_point corner[4]);
/* A dark stroke along an edge. */
void render_body_stroke(const struct render_body *body, const struct render_point *from, const struct render_point *to);

#endif
