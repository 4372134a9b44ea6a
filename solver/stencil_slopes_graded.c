/* Slopes along the lines of a graded lattice whose dissipation takes energy from any field.
 *
 * Along a line of one material let D_i = v_i+1 - v_i, g_i the gap of two points and A_i their face. The dissipation
 * takes sum_i A_i D_i [v]_i, [v]_i = D_i - (s_i + s_i+1) / 2 with slopes s per step of the lattice. Slopes are such
 * that
 *     A_i [v]_i = (B D)_i,   B = sum_k (c_k / q_k) e_k e_k^T,   q_k = sum_i |e_ki| / A_i,
 * e_k the second differences of D / g. With c_k > 0 what is taken is never negative, whatever the faces are, and
 * nothing is left of a linear field, as D / g is the same everywhere. So neither the dissipation of p nor that of J
 * gives energy to any motion, as long as normals and impedances are the same along the line: with linear kinematics,
 * and else where the body is strained alike.
 *
 * Given the jumps, slopes follow from one end of the line to the other. Those of a particle are of its neighbours and
 * the ones beyond them if what alternates along the line has the jump D_i, sum_j (B A^-1)_ij (-1)^j = (-1)^i, which is
 *     c_i + 2 c_i-1 + c_i-2 = g_i.
 * That holds at all but the ends, where rows of slopes are longer on one side. On even lines c = g / 4: slopes are
 * (3/4, -1/8) of differences across one and two steps on either side, and jumps, a sixteenth of fifth differences, are
 * of fifth order, at ends of third.
 *
 * Lines that are short, or have no pairs across two steps, have first differences in place of second ones, and
 * c_i + c_i-1 = g_i: slopes between nearest neighbours, jumps of third order, at ends of second. Where spacings change
 * so fast that no such c are all positive (24 points, 1e4 times as fine at both ends as in the middle; 10 points, 20
 * times), those c are taken as they are. */
#include "solver/memory.h"
#include "solver/stencil.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Shorter ones have no order to lose, and sbp4's closure with four rows. */
enum { FEWEST = 12 };

/* Points of a line that are of one material, and what slopes are made of; j-th of the steps between them. */
struct run {
    size_t points, steps;
    const size_t *particle;                        /* [points] */
    double *gap, *face, *first, *second, *band[3]; /* [points] each; c of first and of second differences; B_j,j+t */
    double (*slope)[4];                            /* [points] of D_i-2 to D_i+1 */
};

static const size_t NONE = SIZE_MAX;

static size_t find_pair(const struct solver_stencil *stencil, size_t a, size_t b)
{
    for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
        if (stencil->graph.neighbour[ab] == b) {
            return ab;
        }
    }
    return NONE;
}

/* part_j + part_j-1 = sum_j, part_j as near to a fourth of sum_j + sum_j+1 as may be: one number is free, what
 * alternates. One part fewer than sums; whether all are positive. */
static bool halve(const double *sum, size_t count, double *part)
{
    double off = 0.0;
    double squares = 0.0;
    bool positive = true;
    for (size_t j = 0; j + 1 < count; j++) {
        double near = 0.25 * (sum[j] + sum[j + 1]);
        part[j] = j == 0 ? near : sum[j] - part[j - 1];
        off += (j % 2 == 0 ? 1.0 : -1.0) * (part[j] - near) / (near * near);
        squares += 1.0 / (near * near);
    }
    for (size_t j = 0; j + 1 < count; j++) {
        part[j] -= (j % 2 == 0 ? off : -off) / squares;
        positive = positive && part[j] > 0.0;
    }
    return positive;
}

/* Whether second differences may be taken. */
static bool is_wide(const struct solver_stencil *stencil, const struct run *run)
{
    bool wide = run->points >= FEWEST;
    for (size_t i = 0; wide && i + 2 < run->points; i++) {
        wide = find_pair(stencil, run->particle[i], run->particle[i + 2]) != NONE &&
               find_pair(stencil, run->particle[i + 2], run->particle[i]) != NONE;
    }
    return wide;
}

/* B of differences of an order. */
static void add_up(struct run *run, size_t order)
{
    static const double weights[2][3] = {{1.0, -1.0}, {1.0, -2.0, 1.0}};
    const double *weight = weights[order - 1];
    const double *c = order == 2 ? run->second : run->first;
    for (size_t t = 0; t < 3; t++) {
        memset(run->band[t], 0, run->points * sizeof *run->band[t]);
    }
    for (size_t k = 0; k + order < run->steps; k++) {
        double q = 0.0;
        for (size_t t = 0; t <= order; t++) {
            q += fabs(weight[t]) / (run->face[k + t] * run->gap[k + t]);
        }
        for (size_t t = 0; t <= order; t++) {
            for (size_t u = t; u <= order; u++) {
                run->band[u - t][k + t] += c[k] / q * (weight[t] / run->gap[k + t]) * (weight[u] / run->gap[k + u]);
            }
        }
    }
}

/* (A^-1 B)_ij, 0 beyond the line: what D_j has in the jump [v]_i. */
static double jump(const struct run *run, size_t i, size_t j)
{
    size_t apart = i > j ? i - j : j - i;
    return i < run->steps && j < run->steps && apart < 3 ? run->band[apart][i < j ? i : j] / run->face[i] : 0.0;
}

/* Slopes of point i from those of the other point of a step. */
static void follow(struct run *run, size_t i, size_t step, size_t other)
{
    for (size_t t = 0; t < 4; t++) {
        size_t j = i + t - 2;     /* wraps below 0, which is beyond the line */
        size_t u = j + 2 - other; /* where the other's row has it */
        double known = u < 4 ? run->slope[other][u] : 0.0;
        run->slope[i][t] = j < run->steps ? 2.0 * ((j == step ? 1.0 : 0.0) - jump(run, step, j)) - known : 0.0;
    }
}

/* Slopes from B. Rows of inner points follow from those of the jumps on either side that reach no farther. */
static void find_slopes(struct run *run, size_t order)
{
    size_t first = order;
    size_t last = run->steps - order;
    if (run->steps < 2 * order) { /* a single step */
        first = last = 0;
        memcpy(run->slope[0], (double[4]){0.0, 0.0, 1.0, 0.0}, sizeof run->slope[0]);
    }
    for (size_t i = first; i <= last && run->steps >= 2 * order; i++) {
        run->slope[i][0] = -2.0 * jump(run, i, i - 2);
        run->slope[i][1] = -2.0 * jump(run, i, i - 1) + 2.0 * jump(run, i + 1, i - 1);
        run->slope[i][2] = -2.0 * jump(run, i - 1, i) + 2.0 * jump(run, i - 2, i);
        run->slope[i][3] = -2.0 * jump(run, i - 1, i + 1);
    }
    for (size_t i = first; i-- > 0;) {
        follow(run, i, i, i + 1);
    }
    for (size_t i = last + 1; i < run->points; i++) {
        follow(run, i, i - 1, i - 1);
    }
}

/* Weights of the pairs of a run. */
static void put(struct solver_stencil *stencil, const struct run *run, size_t axis, double spacing)
{
    for (size_t i = 0; i < run->points; i++) {
        const double *of = run->slope[i];
        const double weight[5] = {-of[0], of[0] - of[1], 0.0, of[2] - of[3], of[3]}; /* of v_i-2 - v_i to v_i+2 - v_i */
        for (size_t t = 0; t < 5; t++) {
            size_t j = i + t - 2;
            size_t ab = j < run->points && j != i ? find_pair(stencil, run->particle[i], run->particle[j]) : NONE;
            if (ab != NONE) {
                stencil->least_squares[ab * (size_t)stencil->dim + axis] = weight[t] / spacing;
            }
        }
    }
}

static void take_run(struct solver_stencil *stencil, const struct solver_cloud *cloud, struct run *run, size_t axis)
{
    size_t dim = (size_t)cloud->dim;
    run->steps = run->points - 1;
    if (run->steps == 0) {
        return; /* alone in its material: no slope */
    }
    for (size_t j = 0; j < run->steps; j++) {
        size_t a = run->particle[j];
        size_t b = run->particle[j + 1];
        run->gap[j] = cloud->X[b * dim + axis] - cloud->X[a * dim + axis];
        run->face[j] = solver_stencil_C(stencil, find_pair(stencil, a, b))[dim];
    }
    bool wide = is_wide(stencil, run);
    bool even = halve(run->gap, run->steps, run->first);
    size_t order = wide && even && halve(run->first, run->steps - 1, run->second) ? 2 : 1;
    add_up(run, order);
    find_slopes(run, order);
    put(stencil, run, axis, cloud->spacing);
}

/* The line along an axis that begins with a particle, material by material. */
static void take_line(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                      const struct solver_material_constants *constants, const uint32_t *particle_at, size_t first,
                      size_t axis, size_t *line, struct run *run)
{
    const size_t stride[3] = {1, cloud->points[0], (size_t)cloud->points[0] * cloud->points[1]};
    const uint32_t *site = cloud->site + first * (size_t)cloud->dim;
    size_t points = cloud->points[axis];
    size_t home = 0;
    for (size_t k = 0; k < (size_t)cloud->dim; k++) {
        home += site[k] * stride[k];
    }
    for (size_t i = 0; i < points; i++) {
        line[i] = particle_at[home + i * stride[axis]];
    }
    for (size_t begin = 0, end; begin < points; begin = end) {
        end = begin + 1;
        while (end < points &&
               (constants == NULL || solver_material_same(&constants[line[begin]], &constants[line[end]]))) {
            end++;
        }
        run->particle = line + begin;
        run->points = end - begin;
        take_run(stencil, cloud, run, axis);
    }
}

/* `room` is [11][longest], all of a run's numbers. */
static struct run lay_out(double *room, size_t longest)
{
    return (struct run){.gap = room,
                        .face = room + longest,
                        .first = room + 2 * longest,
                        .second = room + 3 * longest,
                        .band = {room + 4 * longest, room + 5 * longest, room + 6 * longest},
                        .slope = (double(*)[4])(void *)(room + 7 * longest)};
}

bool solver_stencil_add_graded_slopes(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                                      const struct solver_material_constants *constants, struct solver_error *error)
{
    size_t dim = (size_t)cloud->dim;
    size_t longest = 0;
    for (size_t axis = 0; axis < dim; axis++) {
        longest = cloud->points[axis] > longest ? cloud->points[axis] : longest;
    }
    uint32_t *particle_at = NULL;
    size_t *line = NULL;
    double *room = NULL;
    bool ok = solver_alloc((void **)&stencil->least_squares, stencil->pairs * dim, sizeof(double), "slopes of lattices",
                           error) &&
              solver_alloc((void **)&particle_at, cloud->count, sizeof *particle_at, "lattice map", error) &&
              solver_alloc((void **)&line, longest, sizeof *line, "line of a lattice", error) &&
              solver_alloc((void **)&room, 11 * longest, sizeof *room, "slopes of a line", error);
    for (size_t a = 0; ok && a < cloud->count; a++) {
        size_t at = 0;
        for (size_t axis = dim; axis-- > 0;) {
            at = at * cloud->points[axis] + cloud->site[a * dim + axis];
        }
        particle_at[at] = (uint32_t)a;
    }
    struct run run = lay_out(room, longest);
    for (size_t a = 0; ok && a < cloud->count; a++) {
        for (size_t axis = 0; axis < dim; axis++) {
            if (cloud->site[a * dim + axis] == 0) {
                take_line(stencil, cloud, constants, particle_at, a, axis, line, &run);
            }
        }
    }
    free(particle_at);
    free(line);
    free(room);
    return ok;
}
