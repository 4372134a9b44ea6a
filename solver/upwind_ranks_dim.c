/* Rates of particles in ranks. Fields are taken apart into planes, a component each, so that a register holds one
 * number of as many particles as it has lanes; the whole flux of a pair, stress and dissipation, is found once and
 * serves both its particles with opposite signs. Those across two rows are kept from one row for the next. */
#define ABREAST
#include "solver/upwind_ranks.h"

#include "solver/dim_rank_gradients.h"
#include "solver/dim_rank_linear.h"
#include "solver/dim_terms.h"
#include "solver/dim_turned.h"

#include <string.h>

#if DIM == 2
enum { SPAN = SOLVER_RANK_MOST + 2 * PAD };

/* --- planes --- */

/* Numbers of particles: those without an axis, and for each axis those of its column or along it. */
enum { OF_V, OF_x = 2, OF_PRESSURE = 4, OF_STIFFNESS, OF_AXES };
enum { OF_P, OF_SLOPE = 2, OF_COFACTOR = 4, OF_X = 6, OF_PRESSURE_SLOPE, AXIS_PLANES };

/* Of the particles of a part of a row. */
struct planes {
    real of[OF_AXES + 2 * AXIS_PLANES][SPAN] __attribute__((aligned(64)));
};

#define FIRST_OF_TWO(i)  (2 * (i))
#define SECOND_OF_TWO(i) (2 * (i) + 1)

/* Numbers that take turns, apart. */
static inline void apart(wide low, wide high, wide *first, wide *second)
{
    *first = __builtin_shufflevector(low, high, EACH_LANE(FIRST_OF_TWO));
    *second = __builtin_shufflevector(low, high, EACH_LANE(SECOND_OF_TWO));
}

static void scalars_to(const real *from, size_t count, real *to)
{
    for (size_t k = 0; k < count; k = next_block(k, count)) {
        store_wide(to + k, load_wide(from + k));
    }
}

/* Planes of the two components are `apart_by` numbers apart. */
static void vectors_to(const real *from, size_t count, real *to, size_t apart_by)
{
    for (size_t k = 0; k < count; k = next_block(k, count)) {
        wide of[2];
        apart(load_wide(from + 2 * k), load_wide(from + 2 * k + WIDTH), &of[0], &of[1]);
        store_wide(to + k, of[0]);
        store_wide(to + apart_by + k, of[1]);
    }
}

/* Two planes for the column of each axis. */
static void tensors_to(const real *from, size_t count, real *to)
{
    for (size_t k = 0; k < count; k = next_block(k, count)) {
        const real *here = from + 4 * k;
        wide half[2][2]; /* components, of columns that take turns */
        apart(load_wide(here), load_wide(here + WIDTH), &half[0][0], &half[0][1]);
        apart(load_wide(here + 2 * WIDTH), load_wide(here + 3 * WIDTH), &half[1][0], &half[1][1]);
        for (int i = 0; i < 2; i++) {
            wide of[2];
            apart(half[0][i], half[1][i], &of[0], &of[1]);
            store_wide(to + k + i * SPAN, of[0]);
            store_wide(to + k + (AXIS_PLANES + i) * SPAN, of[1]);
        }
    }
}

/* `count` particles from a on, to place i and on. */
static void to_planes(const struct solver_upwind *work, size_t a, size_t count, size_t i, struct planes *to)
{
    real *at = to->of[0] + i;
    vectors_to(work->v + a * LANES, count, at + OF_V * SPAN, SPAN);
    vectors_to(work->x + a * LANES, count, at + OF_x * SPAN, SPAN);
    real *of_axes = at + OF_AXES * SPAN;
    tensors_to(work->P + a * TENSOR, count, of_axes + OF_P * SPAN);
    tensors_to(work->F_rate + a * TENSOR, count, of_axes + OF_SLOPE * SPAN);
    vectors_to(work->X + a * LANES, count, of_axes + OF_X * SPAN, AXIS_PLANES * SPAN);
    if (!work->evolves_J) {
        return;
    }
    scalars_to(work->pressure + a, count, at + OF_PRESSURE * SPAN);
    if (work->stiffness != NULL) {
        scalars_to(work->stiffness + a, count, at + OF_STIFFNESS * SPAN);
    }
    tensors_to(work->cofactor + a * TENSOR, count, of_axes + OF_COFACTOR * SPAN);
    vectors_to(work->pressure_gradient + a * LANES, count, of_axes + OF_PRESSURE_SLOPE * SPAN, AXIS_PLANES * SPAN);
}

/* --- fluxes --- */

/* From particle to particle, of which the second has the larger number, over the weight of the pair: of momentum, and
 * 2 z_p times that of J. */
enum { OF_J = 2, FLUXES };
struct fluxes {
    real of[FLUXES][SPAN] __attribute__((aligned(64)));
};

/* Pairs along axis I of particles from place a on and, of the same row or another, from place b on. */
struct side_by_side {
    const struct planes *of_a, *of_b;
    size_t a, b, count;
    int I;
    struct fluxes *to;
};

/* Planes of both particles of pairs, from one pair on: those without an axis, and those of the pairs' own. */
struct ends {
    const real *a, *b, *a_I, *b_I;
};

static inline wide difference(const real *a, const real *b, int which)
{
    return load_wide(b + which * SPAN) - load_wide(a + which * SPAN);
}

static inline wide sum(const real *a, const real *b, int which)
{
    return load_wide(b + which * SPAN) + load_wide(a + which * SPAN);
}

/* As many as a register takes: what add_along of dim_aligned.h does. */
static inline __attribute__((always_inline)) void add_flux(const struct ends *at, const real axis[2], bool volume,
                                                           bool stiffens, const struct impedances *z, real *to)
{
    wide distance = difference(at->a_I, at->b_I, OF_X);
    wide back = (real)-0.5 * distance;
    wide jump[2];
    wide along[2];
    for (int i = 0; i < 2; i++) {
        jump[i] = difference(at->a, at->b, OF_V + i) + back * sum(at->a_I, at->b_I, OF_SLOPE + i);
        along[i] = difference(at->a, at->b, OF_x + i);
        if (IN_SINGLE) { /* what is stored is displacements */
            along[i] += wide_of(axis[i]) * distance;
        }
    }
    wide square = along[0] * along[0] + along[1] * along[1];
    struct turned turned = {.soft = square};
    if (volume) {
        wide face[2]; /* twice */
        for (int i = 0; i < 2; i++) {
            face[i] = sum(at->a_I, at->b_I, OF_COFACTOR + i);
            if (IN_SINGLE) {
                face[i] += wide_of(2 * axis[i]);
            }
        }
        wide area = along[0] * face[0] + along[1] * face[1];
        turned = turned_of(square, (real)0.5 * area, join_each(z->shear), join_each(z->bulk),
                           stiffens ? load_wide(at->a + OF_STIFFNESS * SPAN) : square,
                           stiffens ? load_wide(at->b + OF_STIFFNESS * SPAN) : square, stiffens);
    }
    wide more = z->p - z->s;
    wide normal = (along[0] * jump[0] + along[1] * jump[1]) * (volume ? more * turned.inverse : more / square);
    for (int i = 0; i < 2; i++) {
        store_wide(to + i * SPAN, sum(at->a_I, at->b_I, OF_P + i) + (z->s * jump[i] + normal * along[i]));
    }
    if (volume) {
        wide of_J = difference(at->a, at->b, OF_PRESSURE) + back * sum(at->a_I, at->b_I, OF_PRESSURE_SLOPE);
        store_wide(to + OF_J * SPAN, turned.soft * of_J);
    }
}

static inline __attribute__((always_inline)) void add_fluxes_as(const struct side_by_side *pairs,
                                                                const struct impedances *of, bool volume, bool stiffens)
{
    struct impedances z = *of;
    int of_axis = OF_AXES + pairs->I * AXIS_PLANES;
    const real axis[2] = {pairs->I == 0, pairs->I == 1};
    struct ends from = {.a = pairs->of_a->of[0] + pairs->a,
                        .b = pairs->of_b->of[0] + pairs->b,
                        .a_I = pairs->of_a->of[of_axis] + pairs->a,
                        .b_I = pairs->of_b->of[of_axis] + pairs->b};
    real *to = pairs->to->of[0] + pairs->a;
    for (size_t k = 0; k < pairs->count; k = next_block(k, pairs->count)) {
        struct ends at = {from.a + k, from.b + k, from.a_I + k, from.b_I + k};
        add_flux(&at, axis, volume, stiffens, &z, to + k);
    }
}

static __attribute__((noinline)) void add_fluxes(const struct side_by_side *pairs, const struct impedances *z)
{
    add_fluxes_as(pairs, z, true, false);
}

static __attribute__((noinline)) void add_stiff_fluxes(const struct side_by_side *pairs, const struct impedances *z)
{
    add_fluxes_as(pairs, z, true, true);
}

static __attribute__((noinline)) void add_fluxes_of_momentum(const struct side_by_side *pairs,
                                                             const struct impedances *z)
{
    add_fluxes_as(pairs, z, false, false);
}

/* --- rates --- */

/* What is at hand of two rows. Planes of particles [begin, end), and the fluxes across from below, are those of the
 * row above the last, whose place 0 is that of particle `zero`. */
struct hand {
    const struct solver_upwind *work;
    void (*add_fluxes)(const struct side_by_side *pairs, const struct impedances *z);
    struct impedances z;
    struct planes planes[2];
    struct fluxes along, across[2];
    real weight[2][SPAN]; /* of the pairs of particles along the row and across, over 2 V */
    int own;              /* which planes, and fluxes across from below, are the row's */
    size_t begin, end, zero;
};

static void set_weights(const struct part *part, struct hand *hand)
{
    size_t count = part->end - part->begin;
    for (int across = 0; across < 2; across++) {
        real *to = hand->weight[across] + part->at;
        int axis = part->rank->axis;
        const double *weight = part->rank->weight[across ? 1 - axis : axis];
        for (size_t k = 0; k < count; k = next_block(k, count)) {
            store_wide(to + k, wide_of((real)weight[SOLVER_RANK_INSIDE]));
        }
        to[0] = part->left > 0 ? to[0] : (real)weight[SOLVER_RANK_FIRST];
        to[count - 1] = part->right > 0 ? to[count - 1] : (real)weight[SOLVER_RANK_LAST];
    }
}

static void no_fluxes(struct fluxes *fluxes, size_t at, size_t count)
{
    for (int i = 0; i < FLUXES; i++) {
        memset(fluxes->of[i] + at, 0, count * sizeof(real));
    }
}

/* How many particles of a part nothing is known of, from its first on. */
static size_t unknown(const struct part *part, const struct hand *hand)
{
    size_t count = part->end - part->begin;
    if (part->begin - part->at != hand->zero || part->left > 0 || part->end + part->right > hand->end ||
        hand->begin > part->end) {
        return count;
    }
    size_t before = hand->begin > part->begin ? hand->begin - part->begin : 0;
    return before > 0 && before < WIDTH ? WIDTH : before;
}

/* Its row, and what it exchanges with the row below. */
static void set_out(const struct part *part, struct hand *hand)
{
    struct planes *own = &hand->planes[hand->own];
    struct planes *other = &hand->planes[1 - hand->own];
    struct fluxes *from_below = &hand->across[hand->own];
    size_t below = part->rank->back[1 - part->rank->axis];
    size_t at = part->at;
    size_t count = unknown(part, hand);
    if (count == 0) {
        return;
    }
    size_t more = count == part->end - part->begin ? part->right : 0;
    to_planes(hand->work, part->begin - part->left, part->left + count + more, at - part->left, own);
    if (below > 0) {
        to_planes(hand->work, part->begin - below, count, at, other);
        struct side_by_side pairs = {other, own, at, at, count, 1 - part->rank->axis, from_below};
        hand->add_fluxes(&pairs, &hand->z);
    } else {
        no_fluxes(from_below, at, count);
    }
}

/* Fluxes of the pairs within the row. */
static void go_along(const struct part *part, struct hand *hand)
{
    const struct planes *own = &hand->planes[hand->own];
    struct fluxes *to = &hand->along;
    size_t count = part->end - part->begin;
    size_t first = part->at - part->left;
    struct side_by_side pairs = {own, own, first, first + 1, part->left + count + part->right - 1, part->rank->axis,
                                 to};
    hand->add_fluxes(&pairs, &hand->z);
    for (int i = 0; i < FLUXES; i++) {
        real *of = to->of[i] + part->at;
        of[-1] = part->left > 0 ? of[-1] : 0;
        of[count - 1] = part->right > 0 ? of[count - 1] : 0;
    }
}

/* The row above, which is the next, and what is exchanged with it. */
static void go_across(const struct part *part, struct hand *hand)
{
    struct planes *other = &hand->planes[1 - hand->own];
    struct fluxes *to = &hand->across[1 - hand->own];
    size_t above = part->rank->ahead[1 - part->rank->axis];
    size_t at = part->at;
    size_t count = part->end - part->begin;
    if (above > 0) {
        to_planes(hand->work, part->begin + above, count, at, other);
        struct side_by_side pairs = {&hand->planes[hand->own], other, at, at, count, 1 - part->rank->axis, to};
        hand->add_fluxes(&pairs, &hand->z);
    } else {
        no_fluxes(to, at, count);
    }
}

/* What flows into particles, by their places. */
static inline __attribute__((always_inline)) wide net(const struct hand *hand, int which, size_t i)
{
    const real *along = hand->along.of[which] + i;
    const real *below = hand->across[hand->own].of[which] + i;
    const real *above = hand->across[1 - hand->own].of[which] + i;
    return load_wide(hand->weight[0] + i) * (load_wide(along) - load_wide(along - 1)) +
           load_wide(hand->weight[1] + i) * (load_wide(above) - load_wide(below));
}

/* The rate of J that is motion alone, H : grad v. */
static inline __attribute__((always_inline)) wide compression_at(const struct planes *own, size_t i)
{
    wide sum = {0};
    for (int column = 0; column < 4; column++) {
        int I = OF_AXES + column / 2 * AXIS_PLANES + column % 2;
        wide cofactor = load_wide(own->of[I + OF_COFACTOR] + i);
        if (IN_SINGLE && column / 2 == column % 2) {
            cofactor += wide_of(1);
        }
        sum += cofactor * load_wide(own->of[I + OF_SLOPE] + i);
    }
    return sum;
}

static void put_rates(const struct part *part, const struct hand *hand)
{
    const struct solver_upwind *work = hand->work;
    wide per_rho = wide_of((real)(1.0 / work->constants->rho));
    wide per_z = wide_of((real)(1.0 / work->constants->zp));
    size_t count = part->end - part->begin;
    for (size_t k = 0; k < count; k = next_block(k, count)) {
        size_t i = part->at + k;
        real *to = work->v_rate + (part->begin + k) * LANES;
        wide of[2] = {per_rho * net(hand, 0, i), per_rho * net(hand, 1, i)};
        store_in_turn(to, of[0], of[1]);
        if (work->evolves_J) {
            wide of_J = compression_at(&hand->planes[hand->own], i) + per_z * net(hand, OF_J, i);
            store_wide(work->J_rate + part->begin + k, of_J);
        }
    }
}

/* H x grad v, the rate of the cofactor (tensor_cross of dim.h): numbers of a tensor in reverse, two with other signs.
 */
static void rates_of_H(const struct solver_upwind *work, size_t begin, size_t end)
{
#define IN_REVERSE(i) ((i) / 4 * 4 + 3 - (i) % 4)
#define SIGN(i)       ((i) % 4 == 0 || (i) % 4 == 3 ? (real)1.0 : (real)-1.0)
    size_t count = (end - begin) * TENSOR;
    wide sign = {EACH_LANE(SIGN)};
    for (size_t k = 0; k < count; k = next_block(k, count)) {
        wide G = load_wide(work->F_rate + begin * TENSOR + k);
        store_wide(work->H_rate + begin * TENSOR + k, sign * __builtin_shufflevector(G, G, EACH_LANE(IN_REVERSE)));
    }
}

static void rates_of(const struct part *part, struct hand *hand)
{
    set_weights(part, hand);
    set_out(part, hand);
    go_along(part, hand);
    go_across(part, hand);
    put_rates(part, hand);
    if (hand->work->evolves_H) {
        rates_of_H(hand->work, part->begin, part->end);
    }
    size_t above = part->rank->ahead[1 - part->rank->axis];
    hand->own = 1 - hand->own;
    hand->begin = part->begin + above;
    hand->end = above > 0 ? part->end + above : 0;
    hand->zero = part->begin - part->at + above;
}

static void rates_of_part(const struct solver_upwind *work, const struct part *part, void *hand)
{
    (void)work;
    rates_of(part, hand);
}

static void turned_rates(const struct solver_upwind *work, size_t begin, size_t end, solver_rank_others *others)
{
    static const size_t constants[PLACES]; /* all are of one material */
    struct hand hand;
    hand.work = work;
    hand.add_fluxes = !work->evolves_J          ? add_fluxes_of_momentum
                      : work->stiffness != NULL ? add_stiff_fluxes
                                                : add_fluxes;
    hand.own = 0;
    hand.begin = hand.end = hand.zero = 0;
    hand.z = impedances(work, constants, work->evolves_J);
    for_ranks(work, begin, end, rates_of_part, &hand, others);
}
#endif

#if DIM > 1
static void rates(const struct solver_upwind *work, size_t begin, size_t end, solver_rank_others *others)
{
    bool ranks = has_ranks(work) && work->reconstruct && !work->whole_jump && (DIM == 2 || work->frozen);
    if (!ranks || work->lost != NULL) { /* the others note that; rates do not depend on who asks */
        others(work, begin, end);
    }
    if (ranks && work->frozen) {
        for_ranks(work, begin, end, linear_rates_of_part, NULL, others);
    }
#if DIM == 2
    if (ranks && !work->frozen) {
        turned_rates(work, begin, end, others);
    }
#endif
}
#else
static void rates(const struct solver_upwind *work, size_t begin, size_t end, solver_rank_others *others)
{
    others(work, begin, end);
}
#endif

const struct solver_rank_loops DIM_NAME(solver_ranks) = {.gradients = gradients, .rates = rates};
