/* Closed surfaces of triangles, as STL files hold them, and the signed distance from one. */
#ifndef SOLVER_STL_H
#define SOLVER_STL_H

#include "solver/error.h"

#include <stdint.h>
#include <stdlib.h>

struct solver_stl {
    size_t vertex_count, count;
    double (*vertex)[3];     /* [vertex_count] [m], each once */
    uint32_t (*triangle)[3]; /* [count] counterclockwise seen from outside */
    double (*normal)[3];     /* [count] unit normals, outward */
    double (*at_edge)[3][3]; /* [count] sums of the normals on both sides of edges 01, 12 and 20 */
    double (*at_vertex)[3];  /* [vertex_count] sums of normals, weighted by the angles of triangles there */
    struct stl_box *box;     /* [box_count] a tree of boxes around triangles */
    size_t box_count;
    uint32_t *order; /* [count] triangles in the order of the tree's leaves */
};

/* Reads a binary or ASCII STL file; lengths are `scale` [m] of its own. SOLVER_BAD_INPUT where it is none, where a
 * number is not finite, or where the triangles are no closed surface that has its outside out: every edge must belong
 * to two, once in each direction. Normals in the file are not looked at. */
bool solver_stl_read(const char *path, double scale, struct solver_stl **surface, struct solver_error *error);
void solver_stl_free(struct solver_stl *surface);
/* Signed distance [m] of X [m], negative inside: to the nearest triangle, its sign by the normal of the nearest face,
 * or the sum at the nearest edge or vertex (Baerentzen, Aanaes 2005, IEEE Trans. Vis. Comput. Graph. 11, 243). */
double solver_stl_distance(const struct solver_stl *surface, const double X[3]);

/* Inside of stl*.c: normals, sums and tree of a surface that has its vertices and triangles. */
struct stl_box {
    double lower[3], upper[3];
    uint32_t first, count; /* triangles within `order` */
    uint32_t right;        /* second half; the first comes next after this box. 0: a leaf */
};
bool stl_close(struct solver_stl *surface, const char *path, struct solver_error *error);
bool stl_plant(struct solver_stl *surface, struct solver_error *error);

#endif
