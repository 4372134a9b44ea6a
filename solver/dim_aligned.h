/* The loops of upwind.h over rows whose pairs all lie along reference axes, sorted by axis (stencil_align.c): of C_ab,
 * of the distance X_b - X_a and of what is differentiated along it one component each is there. A pair then needs one
 * column of its neighbour's stress and slopes instead of DIM. With linear kinematics its normal is the axis itself. */
#ifndef SOLVER_DIM_ALIGNED_H
#define SOLVER_DIM_ALIGNED_H

#include "solver/dim_fluxes.h"

#include <string.h>

/* Pairs of the particles of a group along one axis. */
struct line {
    size_t first[GROUP], end[GROUP];
    size_t shortest, longest;
};

/* Those along I, which follow those along I - 1; `each` as below. */
static inline __attribute__((always_inline)) void next_line(const struct solver_upwind *work, const struct group *group,
                                                            int I, size_t each, struct line *line)
{
    line->shortest = each > 0 ? each : SIZE_MAX;
    line->longest = each;
    for (int g = 0; g < GROUP; g++) {
        size_t count = each > 0 ? each : work->along[group->at[g] * LANES + (size_t)I];
        line->first[g] = I == 0 ? group->row[g] : line->end[g];
        line->end[g] = line->first[g] + count;
        line->shortest = count < line->shortest ? count : line->shortest;
        line->longest = count > line->longest ? count : line->longest;
    }
}

/* Away from the ends of lines, rows of sbp2 have two pairs along each axis: a loop that knows is shorter. */
enum { INNER = 2 };

/* Whether those of a group have. */
static inline __attribute__((always_inline)) bool are_inner(const struct solver_upwind *work, const struct group *group)
{
    static const uint8_t inner[4] = {INNER, DIM > 1 ? INNER : 0, DIM > 2 ? INNER : 0};
    bool all = true;
    for (int g = 0; g < GROUP; g++) {
        all = all && memcmp(work->along + group->at[g] * LANES, inner, LANES) == 0;
    }
    return all;
}

/* The k-th pair of each, or beyond a line's end the last of the row, idle. */
static inline __attribute__((always_inline)) struct pairs
line_pairs(const struct solver_upwind *work, const struct group *group, const struct line *line, size_t k, bool idle)
{
    struct pairs pairs;
    for (int g = 0; g < GROUP; g++) {
        size_t ab = line->first[g] + k;
        pairs.idle[g] = idle && ab >= line->end[g];
        pairs.ab[g] = pairs.idle[g] ? group->last[g] : ab;
        pairs.record[g] = pairs.ab[g] + group->shift[g];
        pairs.b[g] = work->neighbour[pairs.ab[g]];
    }
    return pairs;
}

/* A number of the pairs' records: I of C_ab along I, DIM the face measure. */
static inline __attribute__((always_inline)) wide of_record(const struct solver_upwind *work, const struct pairs *pairs,
                                                            int I, bool narrow)
{
    real each[GROUP];
    for (int g = 0; g < GROUP; g++) {
        size_t at = pairs->record[g] * PAIR + (size_t)I;
        real number = narrow ? (real)work->narrow[at] : (real)work->pair[at];
        each[g] = pairs->idle[g] ? (real)0.0 : number;
    }
    return join_each(each);
}

/* Component I of vectors, in every lane. */
static inline __attribute__((always_inline)) wide gather_component(const real *field, int I, const size_t at[GROUP])
{
    real each[GROUP];
    for (int g = 0; g < GROUP; g++) {
        each[g] = field[at[g] * LANES + (size_t)I];
    }
    return join_each(each);
}

/* --- gradients --- */

/* Of v and, if asked for, of U'(J), in every lane: what a particle has of them, or sums along an axis. */
struct aligned_fields {
    wide v, pressure;
};

static inline __attribute__((always_inline)) void add_slope(const struct solver_upwind *work, const struct pairs *pairs,
                                                            int I, const struct aligned_fields *own, bool pressure,
                                                            bool narrow, struct aligned_fields *sums)
{
    wide C = of_record(work, pairs, I, narrow);
    sums->v += (gather(work->v, LANES, pairs->b) - own->v) * C;
    if (pressure) {
        sums->pressure += (gather_scalars(work->pressure, pairs->b) - own->pressure) * C;
    }
}

/* Slopes along I, times 2 V. */
static inline __attribute__((always_inline)) struct aligned_fields
sum_slopes(const struct solver_upwind *work, const struct group *group, struct line *line, int I, size_t each,
           const struct aligned_fields *own, bool pressure, bool narrow)
{
    struct aligned_fields sums = {.pressure = {0}};
    size_t k = 0;
    next_line(work, group, I, each, line);
    for (; k < line->shortest; k++) {
        struct pairs pairs = line_pairs(work, group, line, k, false);
        add_slope(work, &pairs, I, own, pressure, narrow, &sums);
    }
    for (; GROUP > 1 && k < line->longest; k++) {
        struct pairs pairs = line_pairs(work, group, line, k, true);
        add_slope(work, &pairs, I, own, pressure, narrow, &sums);
    }
    return sums;
}

/* `each`: pairs that all lines have, or 0. */
static inline __attribute__((always_inline)) void
group_gradients(const struct solver_upwind *work, const struct group *group, size_t each, bool pressure, bool narrow)
{
    struct aligned_fields own = {.v = gather(work->v, LANES, group->at)};
    own.pressure = pressure ? gather_scalars(work->pressure, group->at) : own.v;
    struct aligned_fields sums[3];
    struct line line;
    sums[0] = sum_slopes(work, group, &line, 0, each, &own, pressure, narrow);
    if (DIM > 1) {
        sums[1] = sum_slopes(work, group, &line, 1, each, &own, pressure, narrow);
    }
    if (DIM > 2) {
        sums[2] = sum_slopes(work, group, &line, 2, each, &own, pressure, narrow);
    }
    wide half_per_V = 0.5 * ((real)work->unit / gather_each(work->V, 1, group->at));
    wide of_pressure = {0};
    for (int I = 0; I < DIM; I++) {
        scatter(work->F_rate + I * LANES, TENSOR, group->at, sums[I].v * half_per_V);
        of_pressure = put_component(of_pressure, sums[I].pressure, I);
    }
    if (pressure) {
        scatter(work->pressure_gradient, LANES, group->at, half_per_V * of_pressure);
    }
}

/* What gradients_with of upwind_dim.c does. */
static inline __attribute__((always_inline)) void aligned_gradients_with(const struct solver_upwind *work, size_t begin,
                                                                         size_t end, bool pressure, bool narrow)
{
    struct group group;
    for (size_t a = begin; a < end; a += group.count) {
        group = next_group(work, a, end);
        if (are_inner(work, &group)) {
            group_gradients(work, &group, INNER, pressure, narrow);
        } else {
            group_gradients(work, &group, 0, pressure, narrow);
        }
    }
}

static void aligned_gradients(const struct solver_upwind *work, size_t begin, size_t end)
{
    bool pressure = work->pressure_gradient != NULL;
    bool narrow = work->narrow != NULL;
    if (narrow && pressure) {
        aligned_gradients_with(work, begin, end, true, true);
    } else if (narrow) {
        aligned_gradients_with(work, begin, end, false, true);
    } else if (pressure) {
        aligned_gradients_with(work, begin, end, true, false);
    } else {
        aligned_gradients_with(work, begin, end, false, false);
    }
}

/* --- rates --- */

/* What the pairs of a group along an axis have in common. */
struct aligned_side {
    wide v, x, half_X, slope, cofactor, pressure, pressure_slope;
    struct impedances z;
};

/* Sums over pairs; of scalars in every lane. */
struct aligned_sums {
    wide force;   /* sum_b P_b e_I D_I */
    wide jumps;   /* sum_b A [v] */
    wide normals; /* sum_b A n (n . [v]) */
    wide volume;  /* sum_b A n^2 [U'] */
};

/* Adds what belongs to an axis. */
static inline __attribute__((always_inline)) void turn_side(const struct solver_upwind *work, const struct group *group,
                                                            struct terms terms, int I, struct aligned_side *own)
{
    if (terms.reconstruct) {
        own->half_X = (real)0.5 * gather_component(work->X, I, group->at);
        own->slope = gather(work->F_rate + I * LANES, TENSOR, group->at);
    }
    if (terms.reconstruct && terms.volume) {
        own->pressure_slope = gather_component(work->pressure_gradient, I, group->at);
    }
    if (terms.volume && !terms.frozen) {
        own->cofactor = gather(work->cofactor + I * LANES, TENSOR, group->at);
    }
}

/* Where normals n turn with the body (add_fluxes of dim_fluxes.h); returns A n^2, times the softening. */
static inline __attribute__((always_inline)) wide add_turned(const struct solver_upwind *work,
                                                             const struct group *group, const struct pairs *pairs,
                                                             struct terms terms, int I, const struct aligned_side *own,
                                                             wide jump, wide face, struct aligned_sums *sums)
{
    wide along = gather(work->x, LANES, pairs->b) - own->x;
    if (IN_SINGLE) { /* what is stored is displacements */
        along += gather(work->X, LANES, pairs->b) - gather(work->X, LANES, group->at);
    }
    wide normal;
    wide square;
    spread_dots(along, jump, along, along, &normal, &square);
    wide by_normal = face / square; /* A / |along|^2 */
    sums->normals += normal * by_normal * along;
    if (!terms.volume) {
        return face;
    }
    wide area = (real)0.5 * (gather(work->cofactor + I * LANES, TENSOR, pairs->b) + own->cofactor);
    if (IN_SINGLE) {
        area += unit_along(I);
    }
    wide turned = spread_dot(along, area);
    return by_normal * turned * turned * softening(work, group, pairs, &own->z, turned, square);
}

static inline __attribute__((always_inline)) void add_along(const struct solver_upwind *work, const struct group *group,
                                                            const struct pairs *pairs, struct terms terms, int I,
                                                            const struct aligned_side *own, struct aligned_sums *sums)
{
    wide face = of_record(work, pairs, DIM, terms.narrow);
    wide jump = gather(work->v, LANES, pairs->b) - own->v;
    wide back = jump; /* half the distance */
    if (terms.reconstruct) {
        back = own->half_X - (real)0.5 * gather_component(work->X, I, pairs->b);
        jump += back * (gather(work->F_rate + I * LANES, TENSOR, pairs->b) + own->slope);
    }
    sums->force += gather(work->P + I * LANES, TENSOR, pairs->b) * of_record(work, pairs, I, terms.narrow);
    sums->jumps += face * jump;
    wide by_volume = terms.frozen ? face : add_turned(work, group, pairs, terms, I, own, jump, face, sums);
    if (terms.volume) {
        wide difference = gather_scalars(work->pressure, pairs->b) - own->pressure;
        if (terms.reconstruct) {
            difference += back * (gather_component(work->pressure_gradient, I, pairs->b) + own->pressure_slope);
        }
        sums->volume += by_volume * difference;
    }
}

/* Adds all pairs along I. */
static inline __attribute__((always_inline)) void add_line(const struct solver_upwind *work, const struct group *group,
                                                           struct line *line, size_t each, struct terms terms, int I,
                                                           struct aligned_side *own, struct aligned_sums *sums)
{
    struct aligned_sums here = {.volume = {0}};
    size_t k = 0;
    next_line(work, group, I, each, line);
    turn_side(work, group, terms, I, own);
    for (; k < line->shortest; k++) {
        struct pairs pairs = line_pairs(work, group, line, k, false);
        add_along(work, group, &pairs, terms, I, own, &here);
    }
    for (; GROUP > 1 && k < line->longest; k++) {
        struct pairs pairs = line_pairs(work, group, line, k, true);
        add_along(work, group, &pairs, terms, I, own, &here);
    }
    sums->force += here.force;
    sums->jumps += here.jumps;
    if (terms.volume) {
        sums->volume += here.volume;
    }
    if (terms.frozen) { /* n is the axis */
        sums->normals = put_component(sums->normals, here.jumps, I);
    } else {
        sums->normals += here.normals;
    }
}

/* Sums of the pairs of each particle of a group. */
static inline __attribute__((always_inline)) void sum_lines(const struct solver_upwind *work, const struct group *group,
                                                            size_t each, struct terms terms, struct sums of[GROUP])
{
    struct aligned_side own = {.v = gather(work->v, LANES, group->at),
                               .z = impedances(work, group->at, terms.volume && !terms.frozen)};
    own.x = terms.frozen ? own.v : gather(work->x, LANES, group->at);
    own.pressure = terms.volume ? gather_scalars(work->pressure, group->at) : own.v;
    struct aligned_sums sums = {.volume = {0}};
    struct line line;
    add_line(work, group, &line, each, terms, 0, &own, &sums);
    if (DIM > 1) {
        add_line(work, group, &line, each, terms, 1, &own, &sums);
    }
    if (DIM > 2) {
        add_line(work, group, &line, each, terms, 2, &own, &sums);
    }
    vec forces[GROUP];
    vec dissipations[GROUP];
    take_apart(sums.force, forces);
    take_apart(own.z.s * sums.jumps + (own.z.p - own.z.s) * sums.normals, dissipations);
    for (int g = 0; g < GROUP; g++) {
        of[g] = (struct sums){.force = forces[g], .dissipation = dissipations[g], .volume = sums.volume[g * LANES]};
    }
}

/* What rates_with of upwind_dim.c does. Neighbours are read as streams, row beside row, and what is asked for ahead of
 * time (dim_fetch.h) would be there already. */
static inline __attribute__((always_inline)) void aligned_rates_with(const struct solver_upwind *work, size_t begin,
                                                                     size_t end, struct terms terms)
{
    struct group group;
    for (size_t a = begin; a < end; a += group.count) {
        group = next_group(work, a, end);
        struct sums sums[GROUP];
        if (are_inner(work, &group)) {
            sum_lines(work, &group, INNER, terms, sums);
        } else {
            sum_lines(work, &group, 0, terms, sums);
        }
        for (int g = 0; g < GROUP; g++) {
            finish(work, group.at[g], sums[g]);
        }
    }
}

#endif
