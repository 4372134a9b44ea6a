#include "solver/simplex.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Where the function is 0 between an inner and an outer corner. */
static void crossing(const double inner[3], double inner_value, const double outer[3], double outer_value,
                     double out[3])
{
    double along = inner_value / (inner_value - outer_value);
    for (int i = 0; i < 3; i++) {
        out[i] = inner[i] * (1.0 - along) + outer[i] * along;
    }
}

static void add(struct simplices *list, const double *const *corner)
{
    for (size_t i = 0; i < list->size; i++) {
        memcpy(list->corner[list->count][i], corner[i], sizeof list->corner[0][0]);
    }
    list->count++;
}

/* Adds a chain of `size + steps` points, each `size` in a row being a simplex: how prisms fall into simplices. */
static void add_chain(struct simplices *list, const double *const *point, size_t steps)
{
    for (size_t i = 0; i <= steps; i++) {
        add(list, point + i);
    }
}

void simplex_cut(size_t size, const double (*corner)[3], const double *value, struct simplices *inside,
                 struct simplices *cut)
{
    const double *in[4] = {corner[0], corner[0], corner[0], corner[0]};
    const double *out[4] = {corner[0], corner[0], corner[0], corner[0]};
    double in_value[4];
    double out_value[4];
    double at[2][4][3] = {{{0}}}; /* crossings of the edges from each of at most two inner, or outer, corners */
    size_t ins = 0;
    size_t outs = 0;
    *inside = (struct simplices){.size = size};
    *cut = (struct simplices){.size = size - 1};
    for (size_t i = 0; i < size; i++) {
        if (value[i] < 0.0) {
            in[ins] = corner[i];
            in_value[ins++] = value[i];
        } else {
            out[outs] = corner[i];
            out_value[outs++] = value[i];
        }
    }
    if (outs == 0) {
        add(inside, in);
    }
    if (ins == 0 || outs == 0) {
        return;
    }
    if (ins == 1) {
        for (size_t j = 0; j < outs; j++) {
            crossing(in[0], in_value[0], out[j], out_value[j], at[0][j]);
        }
        const double *tip[4] = {in[0], at[0][0], at[0][1], at[0][2]};
        add(inside, tip);
        add(cut, tip + 1);
    } else if (outs == 1) {
        for (size_t i = 0; i < ins; i++) {
            crossing(in[i], in_value[i], out[0], out_value[0], at[0][i]);
        }
        const double *stump[6] = {in[0],    in[1],   ins == 3 ? in[2] : at[0][0], ins == 3 ? at[0][0] : at[0][1],
                                  at[0][1], at[0][2]};
        const double *const section[3] = {at[0][0], at[0][1], at[0][2]};
        add_chain(inside, stump, size - 2);
        add(cut, section);
    } else { /* two and two of a tetrahedron: a prism with an inner corner and its crossings at either end */
        for (size_t i = 0; i < 2; i++) {
            for (size_t j = 0; j < 2; j++) {
                crossing(in[i], in_value[i], out[j], out_value[j], at[i][j]);
            }
        }
        const double *const prism[6] = {in[0], at[0][0], at[0][1], in[1], at[1][0], at[1][1]};
        const double *const section[4] = {at[0][0], at[0][1], at[1][0], at[1][1]};
        add_chain(inside, prism, 2);
        add_chain(cut, section, 1);
    }
}

double simplex_measure(size_t size, const double (*corner)[3], double centroid[3])
{
    double edge[3][3] = {{0}};
    double normal[3];
    for (int i = 0; i < 3; i++) {
        centroid[i] = 0.0;
        for (size_t c = 0; c < size; c++) {
            centroid[i] += corner[c][i] / (double)size;
            if (c > 0) {
                edge[c - 1][i] = corner[c][i] - corner[0][i];
            }
        }
    }
    if (size == 2) {
        return sqrt(dot(edge[0], edge[0]));
    }
    cross(edge[0], edge[1], normal);
    return size == 3 ? 0.5 * sqrt(dot(normal, normal)) : fabs(dot(normal, edge[2])) / 6.0;
}

void simplex_area(size_t size, const double (*corner)[3], const double outward[3], double area[3])
{
    static const double thickness[3] = {0.0, 0.0, 1.0};
    double edge[2][3] = {{0}};
    for (int i = 0; i < 3; i++) {
        edge[0][i] = corner[1][i] - corner[0][i];
        edge[1][i] = size == 3 ? 0.5 * (corner[2][i] - corner[0][i]) : thickness[i];
    }
    cross(edge[0], edge[1], area);
    if (dot(area, outward) < 0.0) {
        for (int i = 0; i < 3; i++) {
            area[i] = -area[i];
        }
    }
}
