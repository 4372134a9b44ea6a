/* What the quads of a surface are to each other: normals for shading, and the edges worth drawing. */
#ifndef RENDER_MESH_H
#define RENDER_MESH_H

#include "render/render.h"

/* What a quad of a surface is. */
enum render_kind {
    RENDER_POINT, /* all four vertices in one */
    RENDER_LINE,
    RENDER_TRIANGLE,
    RENDER_QUAD
};

/* The kind of a quad, and its distinct vertices in order, [*count]; repeated neighbours count once. */
enum render_kind render_quad_corners(const uint32_t quad[4], uint32_t corner[4]);

struct render_mesh {
    double (*normal)[4][3]; /* [quad_count] unit normals at the corners, averaged over neighbours across smooth edges */
    size_t edge_count;
    uint32_t (*edge)[2]; /* [edge_count] rims, creases and, seen from `eye`, silhouettes; none that end in the open
                            after one edge or two */
    bool flat;           /* all in one plane: nothing to shade */
};

/* Fails on a surface that cannot be drawn: vertex numbers out of range, positions that are not finite. `eye`: unit
 * vector towards the viewer. */
bool render_mesh_build(const struct render_surface *surface, const double eye[3], struct render_mesh *mesh,
                       char why[RENDER_WHY]);
void render_mesh_free(struct render_mesh *mesh);

#endif
