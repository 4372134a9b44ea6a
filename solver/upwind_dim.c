#define WIDE_LOTS
#include "solver/upwind.h"
#include "solver/upwind_abreast.h"
#include "solver/upwind_ranks.h"

#include "solver/dim_aligned.h"
#include "solver/dim_fetch.h"
#include "solver/dim_fluxes.h"
#include "solver/dim_pairs.h"
#include "solver/dim_sums.h"
#include "solver/dim_upwind_terms.h"
#include "solver/dim_weights.h"
#ifndef SINGLE
#include "solver/dim_cofactors.h"
#include "solver/dim_whole.h"
#endif

#include <math.h>

/* How many particles from a on are abreast, if that is enough for loops of their own; else 0. */
static inline size_t run_from(const struct solver_upwind *work, size_t a, size_t end)
{
    size_t run = work->abreast != NULL ? work->abreast[a] : 0;
    run = run < end - a ? run : end - a;
    return run >= DIM_NAME(solver_abreast).least ? run : 0;
}

typedef void range_loop(const struct solver_upwind *work, size_t begin, size_t end);

/* Loops over particles that are abreast, and over the others. */
static inline void in_runs(const struct solver_upwind *work, size_t begin, size_t end, range_loop *abreast,
                           range_loop *apart)
{
    size_t next;
    for (size_t a = begin; a < end; a = next) {
        size_t run = run_from(work, a, end);
        next = a + (run > 0 ? run : 1);
        while (run == 0 && next < end && run_from(work, next, end) == 0) {
            next++;
        }
        (run > 0 ? abreast : apart)(work, a, next);
    }
}

/* Gradients of v and, if asked for, of U'(J), at the particles of a group. */
struct gradients {
    wide of_v[DIM], of_pressure;
};

/* With the stencil's own weights, and with those of least squares. */
struct both_gradients {
    struct gradients own, slopes;
};

/* What is summed, constants where the sums are called. Of U'(J) there is one gradient, that which the reconstruction
 * takes. */
struct wanted {
    bool pressure, narrow, composite, least_squares;
};

static inline __attribute__((always_inline)) void add_difference(wide difference, wide jump, const struct weights *w,
                                                                 bool pressure, struct gradients *G)
{
    for (int I = 0; I < DIM; I++) {
        G->of_v[I] += difference * w->each[I];
    }
    if (pressure) {
        G->of_pressure += jump * w->together;
    }
}

static inline __attribute__((always_inline)) void add_differences(const struct solver_upwind *work,
                                                                  const struct group *group, size_t k, bool idle,
                                                                  struct wanted wanted, wide v_a, wide pressure_a,
                                                                  struct both_gradients *G)
{
    struct pairs pairs = pairs_of(work, group, k, idle);
    wide difference = gather(work->v, LANES, pairs.b) - v_a;
    wide jump = v_a;
    if (wanted.pressure) {
        jump = gather_scalars(work->pressure, pairs.b) - pressure_a;
        jump = wanted.composite ? where_alike(work, group, &pairs, jump) : jump;
    }
    struct weights C = load_pair(work, &pairs, wanted.narrow).C;
    add_difference(difference, jump, &C, wanted.pressure && !wanted.least_squares, &G->own);
    if (wanted.least_squares) {
        const double *from[GROUP];
        weights_at(work->least_squares, DIM, &pairs, pairs.ab, from);
        struct weights g = load_weights(from, DIM);
        add_difference(difference, jump, &g, wanted.pressure, &G->slopes);
    }
}

static inline __attribute__((always_inline)) void join_gradients(struct gradients *G, const struct gradients *other,
                                                                 bool pressure)
{
    for (int I = 0; I < DIM; I++) {
        G->of_v[I] += other->of_v[I];
    }
    if (pressure) {
        G->of_pressure += other->of_pressure;
    }
}

/* sum_b (f_b - f_a) w_ab. U'(J) jumps where materials meet, and no slope is taken across: that of a soft particle
 * beside a stiff one would be the stiff one's, and feed energy into the soft side. Sums over every other neighbour are
 * kept apart, so that one does not wait for the last; on a line there are too few for that. */
static inline __attribute__((always_inline)) struct both_gradients
sum_gradients(const struct solver_upwind *work, const struct group *group, struct wanted wanted)
{
    struct both_gradients even = {.own = {.of_pressure = {0}}};
    struct both_gradients odd = even;
    wide v_a = gather(work->v, LANES, group->at);
    wide pressure_a = wanted.pressure ? gather_scalars(work->pressure, group->at) : v_a;
    size_t k = 0;
    for (; DIM > 1 && k + 1 < group->shortest; k += 2) {
        add_differences(work, group, k, false, wanted, v_a, pressure_a, &even);
        add_differences(work, group, k + 1, false, wanted, v_a, pressure_a, &odd);
    }
    for (; k < group->longest; k += 2) {
        add_differences(work, group, k, true, wanted, v_a, pressure_a, &even);
        if (k + 1 < group->longest) {
            add_differences(work, group, k + 1, true, wanted, v_a, pressure_a, DIM > 1 ? &odd : &even);
        }
    }
    join_gradients(&even.own, &odd.own, wanted.pressure && !wanted.least_squares);
    if (wanted.least_squares) {
        join_gradients(&even.slopes, &odd.slopes, wanted.pressure);
    }
    return even;
}

/* The same of the stress, which jumps as well: DIM tensors, derivative along each reference axis, scaled. */
static inline void stress_gradient(const struct solver_upwind *work, size_t a, const double *weights, size_t stride,
                                   real scale)
{
    struct tensor G[DIM] = {{{{0}}}};
    struct tensor P_a = load_tensor(work->P + a * TENSOR);
    size_t shift = weights == work->pair ? pair_shift(work, a) : 0;
    for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
        const double *w = weights + (ab + shift) * stride;
        size_t b = work->neighbour[ab];
        bool alike = work->stride == 0 || solver_material_same(work->constants + a, work->constants + b);
        for (int column = 0; column < DIM; column++) {
            vec difference = load(work->P + b * TENSOR + column * LANES) - P_a.column[column];
            difference = alike ? difference : (vec){0};
            for (int I = 0; I < DIM; I++) {
                G[I].column[column] += difference * (real)w[I];
            }
        }
    }
    for (int I = 0; I < DIM; I++) {
        for (int column = 0; column < DIM; column++) {
            store(work->P_gradient + (a * DIM + (size_t)I) * TENSOR + column * LANES, scale * G[I].column[column]);
        }
    }
}

/* A gradient of U'(J), whose lanes beyond DIM mean nothing. */
static inline __attribute__((always_inline)) void store_slope(const struct solver_upwind *work,
                                                              const struct group *group, wide slope)
{
    for (int i = 0; i < WIDTH; i++) {
        slope[i] = i % LANES < DIM ? slope[i] : (real)0.0;
    }
    scatter(work->pressure_gradient, LANES, group->at, slope);
}

/* The stencil's own gradients, which are the rate of F, and those that the reconstruction takes. */
static inline __attribute__((always_inline)) void gradients_with(const struct solver_upwind *work, size_t begin,
                                                                 size_t end, struct wanted wanted)
{
    struct group group;
    for (size_t a = begin; a < end; a += group.count) {
        group = next_group(work, a, end);
        wide half_per_V = 0.5 * ((real)work->unit / gather_each(work->V, 1, group.at));
        struct both_gradients G = sum_gradients(work, &group, wanted);
        for (int I = 0; I < DIM; I++) {
            G.own.of_v[I] *= half_per_V;
        }
        scatter_columns(work->F_rate, group.at, G.own.of_v);
        if (wanted.least_squares) {
            scatter_columns(work->v_gradient, group.at, G.slopes.of_v);
        }
        if (wanted.pressure) {
            store_slope(work, &group, wanted.least_squares ? G.slopes.of_pressure : half_per_V * G.own.of_pressure);
        }
    }
}

/* A loop each for what is common. */
static inline __attribute__((always_inline)) void gradients_of(const struct solver_upwind *work, size_t begin,
                                                               size_t end, bool pressure, bool least_squares)
{
    if (work->narrow != NULL) {
        gradients_with(work, begin, end,
                       (struct wanted){.pressure = pressure, .narrow = true, .least_squares = least_squares});
    } else {
        gradients_with(work, begin, end, (struct wanted){.pressure = pressure, .least_squares = least_squares});
    }
}

static void gradients_of_pairs(const struct solver_upwind *work, size_t begin, size_t end)
{
    bool pressure = work->pressure_gradient != NULL;
    bool least_squares = work->v_gradient != NULL;
    if (pressure && work->stride != 0) { /* rare: not worth a loop each */
        gradients_with(
            work, begin, end,
            (struct wanted){
                .pressure = true, .narrow = work->narrow != NULL, .composite = true, .least_squares = least_squares});
    } else if (pressure && least_squares) {
        gradients_of(work, begin, end, true, true);
    } else if (least_squares) {
        gradients_of(work, begin, end, false, true);
    } else if (pressure) {
        gradients_of(work, begin, end, true, false);
    } else {
        gradients_of(work, begin, end, false, false);
    }
}

extern const struct solver_rank_loops DIM_NAME(solver_ranks);

/* Of particles on lines that are in no rank: those abreast and others. */
static void gradients_on_lines(const struct solver_upwind *work, size_t begin, size_t end)
{
    in_runs(work, begin, end, DIM_NAME(solver_abreast).gradients, aligned_gradients);
}

static void gradients(const struct solver_upwind *work, size_t begin, size_t end)
{
    bool own = work->least_squares == NULL; /* the reconstruction takes the stencil's gradients */
    if (aligns_gradients(work)) {
        DIM_NAME(solver_ranks).gradients(work, begin, end, gradients_on_lines);
    } else {
        gradients_of_pairs(work, begin, end);
    }
    for (size_t a = begin; work->P_gradient != NULL && a < end; a++) {
        stress_gradient(work, a, own ? work->pair : work->least_squares, own ? PAIR : DIM,
                        (real)(own ? 0.5 / work->V[a] : 1.0));
    }
}

/* What the pairs of a group have in common. */
struct side {
    wide X, x, v, slope[DIM];
    struct impedances z;
};

static inline __attribute__((always_inline)) struct side own_side(const struct solver_upwind *work,
                                                                  const struct group *group, struct terms terms,
                                                                  const real *x, const real *slope)
{
    struct side side = {.x = gather(x, LANES, group->at), .v = gather(work->v, LANES, group->at)};
    side.X = work->X != NULL ? gather(work->X, LANES, group->at) : side.x;
    for (int I = 0; I < DIM; I++) {
        side.slope[I] = gather(slope + I * LANES, TENSOR, group->at);
    }
    side.z = impedances(work, group->at, terms.volume && !terms.frozen);
    return side;
}

/* Jumps of velocity, and where materials meet others: slopes jump there, and that of a particle on the interface is a
 * mean of both sides', of the softer one's size. The side whose slope leaves the smaller jump reconstructs both states:
 * a mean of both jumps, each weighted by the square of the other, so that nothing hangs on which is smaller by a bit.
 */
static inline wide one_sided_jumps(const struct solver_upwind *work, const struct group *group,
                                   const struct pairs *pairs, const real *slope, wide jump, wide difference,
                                   wide distance)
{
    vec jumps[GROUP];
    vec by_a[GROUP];
    vec distances[GROUP];
    take_apart(jump, jumps);
    take_apart(difference, by_a);
    take_apart(distance, distances);
    for (int g = 0; g < GROUP; g++) {
        size_t a = group->at[g];
        size_t b = pairs->b[g];
        if (solver_material_same(work->constants + a, work->constants + b)) {
            continue;
        }
        vec by_b = by_a[g];
        for (int I = 0; I < DIM; I++) {
            by_a[g] -= load(slope + a * TENSOR + I * LANES) * splat(distances[g][I]);
            by_b -= load(slope + b * TENSOR + I * LANES) * splat(distances[g][I]);
        }
        real of_a = dot(by_a[g], by_a[g]);
        real of_b = dot(by_b, by_b);
        real sum = of_a + of_b;
        real by = sum > 0 ? sum : 1;
        real share = sum > 0 ? of_b / by : (real)0.5;
        real rest = sum > 0 ? of_a / by : (real)0.5;
        jumps[g] = by_a[g] * splat(share) + by_b * splat(rest);
    }
    return join(jumps);
}

static inline __attribute__((always_inline)) void add_pairs(const struct solver_upwind *work, const struct group *group,
                                                            const struct pairs *pairs, struct terms terms,
                                                            const struct side *own, const real *x, const real *slope,
                                                            struct pair_sums *sums)
{
    struct pair pair = load_pair(work, pairs, terms.narrow);
    const double *transposed[GROUP] = {NULL};
    if (terms.transposed) {
        weights_at(work->transposed, DIM, pairs, pairs->ab, transposed);
    }
    bool placed = IN_SINGLE || terms.frozen || terms.reconstruct || terms.volume; /* else X need not be there */
    wide distance = placed ? gather(work->X, LANES, pairs->b) - own->X : (wide){0};
    wide along = terms.frozen ? distance : gather(x, LANES, pairs->b) - own->x;
    if (IN_SINGLE && !terms.frozen) {
        along += distance; /* what is stored is displacements */
    }
    wide jump = gather(work->v, LANES, pairs->b) - own->v;
    struct impedances z = terms.composite ? meet(own->z, impedances(work, pairs->b, false)) : own->z;
    wide difference = jump;
    wide back = (real)-0.5 * distance;
    for (int I = 0; I < DIM; I++) {
        wide D = terms.transposed ? weight(transposed, I) : pair.C.each[I];
        sums->force[I] += gather(work->P + I * LANES, TENSOR, pairs->b) * D;
        if (terms.reconstruct) {
            jump += (gather(slope + I * LANES, TENSOR, pairs->b) + own->slope[I]) * spread(back, I);
        }
    }
    if (terms.composite && terms.reconstruct) {
        jump = one_sided_jumps(work, group, pairs, slope, jump, difference, distance);
    }
    add_fluxes(work, group, pairs, terms, jump, distance, along, pair.A, z, sums);
}

/* Sums of the pairs of each particle of a group. */
static inline __attribute__((always_inline)) struct sums
sum_pairs(const struct solver_upwind *work, const struct group *group, size_t last, struct terms terms)
{
    struct pair_sums sums = {.volume = {0}};
    const real *slope = work->v_gradient != NULL ? work->v_gradient : work->F_rate;
    const real *x = terms.frozen ? work->X : work->x;
    struct side own = own_side(work, group, terms, x, slope);
    size_t k = 0;
    for (; k < group->shortest; k++) {
        struct pairs pairs = pairs_of(work, group, k, false);
        if (work->far) {
            fetch_pairs(work, slope, &pairs, last);
        }
        add_pairs(work, group, &pairs, terms, &own, x, slope, &sums);
    }
    for (; GROUP > 1 && k < group->longest; k++) {
        struct pairs pairs = pairs_of(work, group, k, true);
        if (work->far) {
            fetch_pairs(work, slope, &pairs, last);
        }
        add_pairs(work, group, &pairs, terms, &own, x, slope, &sums);
    }
    return combine(&sums, terms, own.z);
}

static inline __attribute__((always_inline)) void rates_with(const struct solver_upwind *work, size_t begin, size_t end,
                                                             struct terms terms)
{
    size_t last = work->row[end] > 0 ? work->row[end] - 1 : 0;
    struct group group;
    for (size_t a = begin; a < end; a += group.count) {
        group = next_group(work, a, end);
        struct scales scales = scales_of(work, group.at);
        finish(work, group.at, &scales, sum_pairs(work, &group, last, terms));
    }
}

static void rates_on_lines(const struct solver_upwind *work, size_t begin, size_t end)
{
    in_runs(work, begin, end, DIM_NAME(solver_abreast).rates, aligned_rates);
}

static void rates(const struct solver_upwind *work, size_t begin, size_t end)
{
    struct terms terms = {.frozen = work->frozen,
                          .reconstruct = work->reconstruct,
                          .transposed = work->transposed != NULL,
                          .volume = work->evolves_J,
                          .whole = work->whole_jump,
                          .composite = work->stride != 0,
                          .narrow = work->narrow != NULL};
    if (aligns_rates(work)) {
        DIM_NAME(solver_ranks).rates(work, begin, end, rates_on_lines);
    } else if (!is_plain(work)) { /* rare: not worth a loop each */
        rates_with(work, begin, end, terms);
    } else {
        plain_rates(work, begin, end, rates_with);
    }
}

#ifndef SINGLE
static void stresses(const struct solver_upwind *work, size_t begin, size_t end)
{
    if (work->cofactor != NULL && !work->evolves_H) {
        cofactor_range(work->F + begin * TENSOR, end - begin, work->cofactor + begin * TENSOR);
    }
    if (work->pressure != NULL) {
        work->material->volumetric_range(work->constants, work->stride, begin, end, work->J, work->pressure);
    }
    if (work->stiffness != NULL) {
        work->material->stiffness_range(begin, end, work->J, work->stiffness);
    }
    if (work->flown != NULL) {
        work->material->flow->stress_range(work->constants, work->stride, work->hardening, begin, end, work->F,
                                           work->cofactor, work->J, work->flown_before, work->flown, work->P);
    } else {
        work->material->stress_range(work->constants, work->stride, begin, end, work->F, work->cofactor, work->J,
                                     work->P);
    }
}

static void measures(bool linear, size_t begin, size_t end, const double *F, double *H, double *J)
{
    for (size_t a = begin; a < end; a++) {
        struct tensor at = load_tensor(F + a * TENSOR);
        struct tensor one = identity();
        struct tensor cof = cofactor(at);
        double jacobian = determinant(at);
        if (linear) {
            for (int I = 0; I < DIM; I++) {
                at.column[I] -= one.column[I];
            }
            struct tensor change = tensor_cross(one, at);
            /* below 3D tensor_cross is the whole in-plane cofactor of its argument's change as well */
            for (int I = 0; I < DIM; I++) {
                cof.column[I] = one.column[I] + change.column[I];
            }
            jacobian = 1.0 + trace(at);
        }
        if (H != NULL) {
            store_tensor(H + a * TENSOR, cof);
        }
        if (J != NULL) {
            J[a] = jacobian;
        }
    }
}

const struct solver_upwind_loops DIM_NAME(solver_upwind) = {
    .lanes = LANES,
    .gradients = gradients,
    .rates = rates,
    .stresses = stresses,
    .first_broken = first_broken,
    .gradient_terms = gradient_terms,
    .rate_terms = rate_terms,
    .particle_terms = particle_terms,
    .measures = measures,
};
#else
const struct solver_upwind_single_loops DIM_NAME(solver_upwind) = {
    .gradients = gradients,
    .rates = rates,
    .gradient_terms = gradient_terms,
    .rate_terms = rate_terms,
    .particle_terms = particle_terms,
};
#endif
