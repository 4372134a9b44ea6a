/* The loops of upwind.h over rows whose pairs all lie along reference axes, sorted by axis (stencil_align.c): of C_ab,
 * of the distance X_b - X_a and of what is differentiated along it one component each is there. A pair then needs one
 * column of its neighbour's stress and slopes instead of DIM. With linear kinematics its normal is the axis itself. */
#ifndef SOLVER_DIM_ALIGNED_H
#define SOLVER_DIM_ALIGNED_H

#include "solver/dim_lines.h"
#include "solver/dim_plain.h"
#include "solver/dim_sums.h"
#include "solver/dim_terms.h"
#include "solver/dim_turned.h"
#include "solver/upwind_abreast.h"

/* Of particles that are abreast. */
extern const struct solver_abreast_loops DIM_NAME(solver_abreast);

/* --- gradients --- */

/* Of v and, if asked for, of U'(J): what a particle has of them, in every lane, or sums along an axis, the second in
 * turn. */
struct aligned_fields {
    wide v, pressure;
};

static inline __attribute__((always_inline)) void add_slopes(const struct solver_upwind *work, const struct turn *turn,
                                                             int I, const struct aligned_fields *own, bool pressure,
                                                             bool narrow, struct aligned_fields *sums)
{
    wide C[TURNS];
    for (int t = 0; t < TURNS; t++) {
        C[t] = of_record(work, turn, t, I, narrow);
    }
    for (int t = 0; t < turn->count; t++) {
        sums->v += (gather(work->v, LANES, turn->b[t]) - own->v) * C[t];
    }
    if (pressure) {
        sums->pressure += (gather_in_turn(work->pressure, turn->b) - own->pressure) * in_turn(C);
    }
}

/* Slopes along I, times 2 V. */
static inline __attribute__((always_inline)) struct aligned_fields
sum_slopes(const struct solver_upwind *work, const struct group *group, struct line *line, int I, size_t each,
           const struct aligned_fields *own, bool pressure, bool narrow)
{
    struct aligned_fields sums = {.pressure = {0}};
    next_line(work, group, I, each, line);
    FOR_TURNS(work, group, line, add_slopes(work, &turn, I, own, pressure, narrow, &sums));
    return sums;
}

/* 1 / (2 V). */
struct halves {
    real per_V[PLACES];
};

static inline __attribute__((always_inline)) struct halves halves_of(const struct solver_upwind *work,
                                                                     const size_t at[PLACES])
{
    struct halves halves;
    for (int g = 0; g < PLACES; g++) {
        halves.per_V[g] = (real)0.5 * ((real)work->unit / (real)work->V[at[g]]);
    }
    return halves;
}

/* `each`: pairs that all lines have, or 0. */
static inline __attribute__((always_inline)) void group_gradients(const struct solver_upwind *work,
                                                                  const struct group *group, size_t each, bool pressure,
                                                                  bool narrow, const struct halves *halves)
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
    wide half_per_V = join_each(halves->per_V);
    wide of_v[DIM];
    wide of_pressure = {0};
    for (int I = 0; I < DIM; I++) {
        of_v[I] = sums[I].v * half_per_V;
        if (pressure) {
            of_pressure = put_component(of_pressure, over_turns(sums[I].pressure), I);
        }
    }
    scatter_columns(work->F_rate, group->at, of_v);
    if (pressure) {
        scatter(work->pressure_gradient, LANES, group->at, half_per_V * of_pressure);
    }
}

/* What gradients_with of upwind_dim.c does. */
static inline __attribute__((always_inline)) void aligned_gradients_with(const struct solver_upwind *work, size_t begin,
                                                                         size_t end, bool pressure, bool narrow)
{
    struct halves halves;
    struct group group;
    for (size_t a = begin; a < end; a += group.count) {
        group = next_group(work, a, end);
        if (!SAME_SCALES || a == begin) {
            halves = halves_of(work, group.at);
        }
        if (are_inner(work, &group)) {
            group_gradients(work, &group, INNER, pressure, narrow, &halves);
        } else {
            group_gradients(work, &group, 0, pressure, narrow, &halves);
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
    wide v, x, X, half_X, slope, cofactor, pressure, pressure_slope, stiffness;
    struct impedances z;
};

/* Sums over pairs. */
struct aligned_sums {
    wide force;   /* sum_b P_b e_I D_I */
    wide jumps;   /* sum_b A [v] */
    wide normals; /* sum_b A n (n . [v]) */
    wide volume;  /* sum_b A n^2 [U'], in turn */
};

/* Adds what belongs to an axis. */
static inline __attribute__((always_inline)) void turn_side(const struct solver_upwind *work, const struct group *group,
                                                            struct terms terms, int I, struct aligned_side *own)
{
    if (terms.reconstruct) {
        own->half_X = (real)0.5 * spread(own->X, I);
        own->slope = gather_column(work->F_rate, I, group->at);
    }
    if (terms.reconstruct && terms.volume) {
        own->pressure_slope = spread(gather(work->pressure_gradient, LANES, group->at), I);
    }
    if (terms.volume && !terms.frozen) {
        own->cofactor = gather_column(work->cofactor, I, group->at);
    }
}

/* What pairs of a turn have become. */
static inline __attribute__((always_inline)) struct turned turn_area(const struct solver_upwind *work,
                                                                     const struct turn *turn, int I,
                                                                     const struct aligned_side *own,
                                                                     const wide along[TURNS], wide square)
{
    wide area[TURNS]; /* twice */
    for (int t = 0; t < TURNS; t++) {
        area[t] = t < turn->count ? gather_column(work->cofactor, I, turn->b[t]) + own->cofactor : area[0];
        if (IN_SINGLE && t < turn->count) {
            area[t] += along_axis(2, I);
        }
    }
    bool stiffens = work->stiffness != NULL;
    wide of_b = stiffens ? gather_in_turn(work->stiffness, turn->b) : own->stiffness;
    return turned_of(square, (real)0.5 * dots_in_turn(along, area), join_each(own->z.shear), join_each(own->z.bulk),
                     own->stiffness, of_b, stiffens);
}

/* Where normals n turn with the body (add_fluxes of dim_fluxes.h); returns A n^2, times the softening. */
static inline __attribute__((always_inline)) wide add_turned(const struct solver_upwind *work, const struct turn *turn,
                                                             struct terms terms, int I, const struct aligned_side *own,
                                                             const wide jump[TURNS], wide face,
                                                             struct aligned_sums *sums)
{
    wide along[TURNS];
    for (int t = 0; t < TURNS; t++) {
        along[t] = t < turn->count ? gather(work->x, LANES, turn->b[t]) - own->x : along[0];
        if (IN_SINGLE && t < turn->count) { /* what is stored is displacements */
            along[t] += gather(work->X, LANES, turn->b[t]) - own->X;
        }
    }
    wide square = dots_in_turn(along, along);
    struct turned turned = {.inverse = square};
    if (terms.volume) {
        turned = turn_area(work, turn, I, own, along, square);
    }
    wide by_normal = terms.volume ? face * turned.inverse : face / square; /* A / |along|^2 */
    wide normal = dots_in_turn(along, jump) * by_normal;
    for (int t = 0; t < turn->count; t++) {
        sums->normals += of_turn(normal, t) * along[t];
    }
    return terms.volume ? face * turned.soft : face;
}

static inline __attribute__((always_inline)) void add_along(const struct solver_upwind *work, const struct turn *turn,
                                                            struct terms terms, int I, const struct aligned_side *own,
                                                            struct aligned_sums *sums)
{
    wide face[TURNS];
    wide jump[TURNS];
    wide back[TURNS]; /* half the distance */
    for (int t = 0; t < TURNS; t++) {
        face[t] = of_record(work, turn, t, DIM, terms.narrow);
        if (t >= turn->count) {
            jump[t] = jump[0];
            back[t] = back[0];
            continue;
        }
        const size_t *b = turn->b[t];
        jump[t] = gather(work->v, LANES, b) - own->v;
        back[t] = jump[t];
        if (terms.reconstruct) {
            back[t] = own->half_X - (real)0.5 * spread(gather(work->X, LANES, b), I);
            jump[t] += back[t] * (gather_column(work->F_rate, I, b) + own->slope);
        }
        sums->force += gather_column(work->P, I, b) * of_record(work, turn, t, I, terms.narrow);
        sums->jumps += face[t] * jump[t];
    }
    wide by_volume = in_turn(face);
    if (!terms.frozen) {
        by_volume = add_turned(work, turn, terms, I, own, jump, by_volume, sums);
    }
    if (terms.volume) {
        wide difference = gather_in_turn(work->pressure, turn->b) - own->pressure;
        if (terms.reconstruct) {
            wide slope[TURNS];
            for (int t = 0; t < TURNS; t++) {
                slope[t] = gather(work->pressure_gradient, LANES, turn->b[t]);
            }
            difference += in_turn(back) * (components_in_turn(slope, I) + own->pressure_slope);
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
    next_line(work, group, I, each, line);
    turn_side(work, group, terms, I, own);
    FOR_TURNS(work, group, line, add_along(work, &turn, terms, I, own, &here));
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
static inline __attribute__((always_inline)) struct sums sum_lines(const struct solver_upwind *work,
                                                                   const struct group *group, size_t each,
                                                                   struct terms terms, const struct impedances *z)
{
    struct aligned_side own = {.v = gather(work->v, LANES, group->at), .z = *z};
    bool placed = terms.reconstruct || (IN_SINGLE && !terms.frozen);
    own.x = terms.frozen ? own.v : gather(work->x, LANES, group->at);
    own.X = placed ? gather(work->X, LANES, group->at) : own.v;
    own.pressure = terms.volume ? gather_scalars(work->pressure, group->at) : own.v;
    bool stiffens = terms.volume && !terms.frozen && work->stiffness != NULL;
    own.stiffness = stiffens ? gather_scalars(work->stiffness, group->at) : own.v;
    struct aligned_sums sums = {.volume = {0}};
    struct line line;
    add_line(work, group, &line, each, terms, 0, &own, &sums);
    if (DIM > 1) {
        add_line(work, group, &line, each, terms, 1, &own, &sums);
    }
    if (DIM > 2) {
        add_line(work, group, &line, each, terms, 2, &own, &sums);
    }
    many volume = component_of(sums.volume, 0);
    for (int t = 1; terms.volume && t < TURNS; t++) {
        volume += component_of(sums.volume, t);
    }
    return (struct sums){
        .force = sums.force, .dissipation = z->s * sums.jumps + (z->p - z->s) * sums.normals, .volume = volume};
}

/* What rates_with of upwind_dim.c does. Neighbours are read as streams, row beside row, and what is asked for ahead of
 * time (dim_fetch.h) would be there already. */
static inline __attribute__((always_inline)) void aligned_rates_with(const struct solver_upwind *work, size_t begin,
                                                                     size_t end, struct terms terms)
{
    static const size_t first[PLACES]; /* all are of one material */
    struct impedances z = impedances(work, first, terms.volume && !terms.frozen);
    struct scales scales;
    struct group group;
    for (size_t a = begin; a < end; a += group.count) {
        group = next_group(work, a, end);
        if (!SAME_SCALES || a == begin) {
            scales = scales_of(work, group.at);
        }
        if (are_inner(work, &group)) {
            finish(work, group.at, &scales, sum_lines(work, &group, INNER, terms, &z));
        } else {
            finish(work, group.at, &scales, sum_lines(work, &group, 0, terms, &z));
        }
    }
}

static void aligned_rates(const struct solver_upwind *work, size_t begin, size_t end)
{
    plain_rates(work, begin, end, aligned_rates_with);
}

#endif
