/* Simplices cut by the zero of a linear function: segments, triangles and tetrahedra of a lattice, cut by a surface. */
#ifndef SOLVER_SIMPLEX_H
#define SOLVER_SIMPLEX_H

#include <stddef.h>

/* Simplices of `size` corners each: 2 a segment, 3 a triangle, 4 a tetrahedron. */
struct simplices {
    size_t count, size;
    double corner[3][4][3];
};

/* Splits one simplex of size 2 to 4, with corners in 3D and the function's values there, into the part where it is
 * negative and the cut, where it is 0, which has one corner less. Neighbours that share corners and values cut their
 * common side alike. */
void simplex_cut(size_t size, const double (*corner)[3], const double *value, struct simplices *inside,
                 struct simplices *cut);

/* Measure [m^(size - 1)] of a simplex of size 2 to 4 anywhere in space, and its centroid. */
double simplex_measure(size_t size, const double (*corner)[3], double centroid[3]);

/* Area vector of a triangle or, of size 2, of a segment in the plane z = 0; along `outward`, not against it. */
void simplex_area(size_t size, const double (*corner)[3], const double outward[3], double area[3]);

#endif
