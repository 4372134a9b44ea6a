/* Vectors of three numbers. */
#ifndef RENDER_VECTOR_H
#define RENDER_VECTOR_H

#include <math.h>

static inline double render_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double render_norm(const double a[3])
{
    return hypot(hypot(a[0], a[1]), a[2]);
}

/* out may be none of a and b */
static inline void render_cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Unit vector along a; zero stays zero. out may be a. */
static inline void render_unit(const double a[3], double out[3])
{
    const double length = render_norm(a);
    for (int i = 0; i < 3; i++)
        out[i] = length > 0 ? a[i] / length : 0;
}

#endif
