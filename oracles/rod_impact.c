/* Longitudinal impact of two elastic rods (Saint-Venant's problem; for instance Graff, Wave Motion in Elastic Solids,
 * section 2.4): the left rod, moving with v1, meets the right one, moving with v2 < v1, after the gap between them has
 * closed; all other ends are free. The rods can push but not pull each other, and they may meet again.
 *
 * Let a(t), b(t) be the waves that arrive at the faces, v - P/Z1 and v + P/Z2. Both come back from a free end as they
 * left: a(t) = a'(t - 2 T1), b(t) = b'(t - 2 T2), with a', b' what leaves the faces. While the rods press
 *
 *     v = (Z1 a + Z2 b)/(Z1 + Z2),   P = -Z1 Z2/(Z1 + Z2) (a - b),   a' = 2 v - a,   b' = 2 v - b,
 *
 * which takes a > b; otherwise a' = a, b' = b and the gap grows by b - a. So everything is constant between events, of
 * which there is a list: arrivals of changes at a face and closings of the gap. It ends when the faces, which swing on
 * for ever, can be seen not to meet again. Exact to round-off at any time; a look-up costs the logarithm of its length.
 *
 * Velocities are in units of v1 - v2, measured from v2, times from the first contact on: equal rods give exact zeros.
 */
#include "oracles/rod_impact.h"
#include "oracles/bar.h"
#include "oracles/kind.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double NO_DIGITS = 3e-6; /* relative round-off of the waves from which on there is no telling */
static const double SAME = 1e-13;     /* waves that differ by less than this do not differ */

/* From a time on: what leaves either face, its integral up to then, and whether the rods press. */
struct piece {
    double t, out[2], sum[2];
    bool press;
};

struct oracle {
    struct rod_impact_given given;
    struct bar rod[2];
    double closing, contact; /* v1 - v2 [m/s] and time of the first contact [s] */
    double end;              /* from here on what leaves the faces repeats itself */
    double tie;              /* what lies within this of the end was counted to it */
    double released;         /* when the rods press for the last time */
    size_t contacts, count;
    struct piece piece[ROD_IMPACT_CHANGES];
};

extern const struct oracle_kind oracle_rod_impact;

static const struct oracle_parameter parameters[] = {
    {"E1", "Pa", "Young's modulus of the left rod", 0, INFINITY, true, false, 200e9},
    {"rho1", "kg/m^3", "density of the left rod", 0, INFINITY, true, false, 7850},
    {"L1", "m", "length of the left rod", 0, INFINITY, true, false, 1},
    {"v1", "m/s", "velocity of the left rod, greater than v2", -INFINITY, INFINITY, false, false, 2},
    {"E2", "Pa", "Young's modulus of the right rod", 0, INFINITY, true, false, 70e9},
    {"rho2", "kg/m^3", "density of the right rod", 0, INFINITY, true, false, 2700},
    {"L2", "m", "length of the right rod", 0, INFINITY, true, false, 1.5},
    {"v2", "m/s", "velocity of the right rod", -INFINITY, INFINITY, false, false, -1},
    {"gap", "m", "between the rods at first", 0, INFINITY, false, false, 1e-4},
    {0},
};

/* Events as near as this are one: what is asked of comes with the round-off of times and places counted from zero. */
static double tie_at(const struct oracle *o, double t)
{
    return 64 * DBL_EPSILON * (o->contact + t + 2 * o->rod[0].T + o->rod[1].T + o->rod[1].upper / o->rod[1].c);
}

/* Last piece that has begun at t >= 0. */
static size_t piece_at(const struct oracle *o, double t)
{
    size_t lower = 0, upper = o->count;
    while (upper - lower > 1) {
        size_t middle = (lower + upper) / 2;
        *(o->piece[middle].t <= t ? &lower : &upper) = middle;
    }
    return lower;
}

/* Whole periods of a rod that lie between t and the part of the list that repeats itself. */
static double periods(const struct oracle *o, int rod, double t)
{
    return t > o->end ? ceil((t - o->end) / (2 * o->rod[rod].T)) : 0;
}

static double leaving(const struct oracle *o, int rod, double t)
{
    t -= 2 * o->rod[rod].T * periods(o, rod, t);
    return t < 0 ? 1 - rod : o->piece[piece_at(o, t)].out[rod];
}

/* Integral from 0 to t of what leaves. */
static double left_so_far(const struct oracle *o, int rod, double t)
{
    double n = periods(o, rod, t), period = 2 * o->rod[rod].T;
    if (n > 0) {
        double once = left_so_far(o, rod, o->end) - left_so_far(o, rod, o->end - period);
        return left_so_far(o, rod, t - n * period) + n * once;
    }
    if (t < 0) {
        return rod == 0 ? t : 0;
    }
    const struct piece *piece = &o->piece[piece_at(o, t)];
    return piece->sum[rod] + piece->out[rod] * (t - piece->t);
}

static void state(const struct oracle *o, const double X[3], double t, struct oracle_state *at)
{
    const struct rod_impact_given *g = &o->given;
    int which = X[0] <= o->rod[0].upper ? 0 : 1;
    const struct bar *rod = &o->rod[which];
    if (which == 1 && X[0] < rod->lower) {
        bar_state(rod, NAN, NAN, NAN, at); /* nothing is there */
        return;
    }
    /* The wave from the face, and the one that has been to the other end. */
    double way = which == 0 ? rod->upper - X[0] : X[0] - rod->lower;
    double from = t - o->contact - way / rod->c, back = t - o->contact - (2 * rod->T - way / rod->c);
    double out = leaving(o, which, from), in = leaving(o, which, back);
    double shift = which == 0 ? o->contact + rod->T : 0;
    double u = (left_so_far(o, which, from) + left_so_far(o, which, back)) / 2 + shift;
    u = from < 0 ? (which == 0 ? t : 0) : u; /* free flight, without the round-off */
    double stress = (which == 0 ? 1 : -1) * rod->Z * o->closing * (out - in) / 2;
    bar_state(rod, g->v2 * t + o->closing * u, g->v2 + o->closing * (out + in) / 2, stress, at);
}

static size_t add_change(const struct oracle *o, int which, double age, double step, double t,
                         struct oracle_front front[ORACLE_FRONTS], size_t count)
{
    const struct bar *rod = &o->rod[which];
    bool back = age >= rod->T, to_right = (which == 1) != back;
    double way = rod->c * (back ? age - rod->T : age), near = 16 * DBL_EPSILON * (rod->c * t + rod->upper);
    if (!(age >= 0 && age < 2 * rod->T) || fabs(step) <= SAME) {
        return count;
    }
    struct oracle_front added = {.X = to_right ? rod->lower + way : rod->upper - way,
                                 .speed = to_right ? rod->c : -rod->c,
                                 .jump = o->closing * (to_right ? -step : step) / 2,
                                 .smoothness = ORACLE_JUMPS};
    return bar_add_front(front, count, added, near);
}

/* Changes that meet and run on together may leave nothing of each other. */
static size_t without_cancelled(struct oracle_front front[ORACLE_FRONTS], size_t count, double least)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        front[kept] = front[i];
        kept += fabs(front[i].jump) > least;
    }
    return kept;
}

static size_t fronts(const struct oracle *o, double t, struct oracle_front front[ORACLE_FRONTS])
{
    size_t count = 0;
    t -= o->contact;
    for (size_t k = 0; k < o->count && o->piece[k].t <= t; k++) {
        for (int rod = 0; rod < 2; rod++) {
            double period = 2 * o->rod[rod].T, left = o->piece[k].t;
            double before = k == 0 ? 1 - rod : o->piece[k - 1].out[rod];
            if (t > o->end && left > o->end - period + o->tie) {
                left += period * fmax(0, floor((t - left) / period)); /* the last time it left again */
            }
            count = add_change(o, rod, t - left, o->piece[k].out[rod] - before, fabs(t), front, count);
        }
    }
    return count == ORACLE_TOO_MANY_FRONTS ? count : without_cancelled(front, count, SAME * o->closing);
}

static double outside(const struct oracle *o, const double X[3])
{
    return fmin(bar_outside(&o->rod[0], X), bar_outside(&o->rod[1], X));
}

static void energy(const struct oracle *o, double t, double *kinetic, double *strain)
{
    *kinetic = *strain = 0;
    bar_energy(&oracle_rod_impact, o, &o->rod[0], INFINITY, t, kinetic, strain);
    bar_energy(&oracle_rod_impact, o, &o->rod[1], INFINITY, t, kinetic, strain);
}

/* Mean velocity of a rod when all is over, in units of the closing velocity. */
static double mean(const struct oracle *o, int rod)
{
    double period = 2 * o->rod[rod].T;
    return (left_so_far(o, rod, o->end) - left_so_far(o, rod, o->end - period)) / period;
}

static size_t figures(const struct oracle *o, struct oracle_figure figure[ORACLE_FIGURES])
{
    double Z1 = o->rod[0].Z, Z2 = o->rod[1].Z, v2 = o->given.v2, exit[2] = {mean(o, 0), mean(o, 1)};
    const struct oracle_figure all[] = {
        {"wave speed 1", "m/s", "in the left rod", o->rod[0].c},
        {"wave speed 2", "m/s", "in the right rod", o->rod[1].c},
        {"first contact", "s", "when the gap has closed", o->contact},
        {"contact time", "s", "from the first contact to the last moment at which the rods press", o->released},
        {"contacts", "-", "how often they press, with pauses between", (double)o->contacts},
        {"contact stress", "Pa", "magnitude in the first moment", Z1 / (Z1 + Z2) * Z2 * o->closing},
        {"contact velocity", "m/s", "of both faces in the first moment", v2 + Z1 / (Z1 + Z2) * o->closing},
        {"exit velocity 1", "m/s", "mean over the left rod, after the last contact", v2 + exit[0] * o->closing},
        {"exit velocity 2", "m/s", "mean over the right rod, after the last contact", v2 + exit[1] * o->closing},
        {"restitution", "-", "relative exit velocity over v1 - v2; waves keep the rest", exit[1] - exit[0]},
    };
    memcpy(figure, all, sizeof all);
    return sizeof all / sizeof *all;
}

/* How far what arrives at a face from t on, its mean taken away, moves that face: to either side, over a period. */
static void sway(const struct oracle *o, int rod, double t, double average, double *lowest, double *highest)
{
    double start = t - 2 * o->rod[rod].T, first = left_so_far(o, rod, start);
    *lowest = *highest = 0;
    for (size_t k = o->count; k-- > 0 && o->piece[k].t > start;) {
        double moved = left_so_far(o, rod, o->piece[k].t) - first - average * (o->piece[k].t - start);
        *lowest = fmin(*lowest, moved);
        *highest = fmax(*highest, moved);
    }
    if (start < 0) {
        double moved = left_so_far(o, rod, 0) - first + average * start;
        *lowest = fmin(*lowest, moved);
        *highest = fmax(*highest, moved);
    }
}

/* Where the events have got to. `gap` in seconds of the closing velocity. */
struct now {
    double t, gap, in[2];
    size_t next[2]; /* the piece whose beginning arrives next at a face */
};

/* Whether the faces, left alone from now on, never meet again. */
static bool parted(struct oracle *o, const struct now *now, double tie)
{
    double average[2], low[2], high[2];
    o->end = now->t;
    for (int rod = 0; rod < 2; rod++) {
        average[rod] = mean(o, rod);
        sway(o, rod, now->t, average[rod], &low[rod], &high[rod]);
    }
    bool apart = now->gap > 0 || now->in[1] - now->in[0] > SAME;
    return apart && average[1] - average[0] > SAME && now->gap + low[1] - high[0] >= -tie;
}

/* Starts a new piece, unless it would be as the last one. False if there is no room. */
static bool record(struct oracle *o, const struct now *now)
{
    double Z1 = o->rod[0].Z, Z2 = o->rod[1].Z, a = now->in[0], b = now->in[1];
    struct piece piece = {.t = now->t, .out = {a, b}, .press = now->gap == 0 && a - b > SAME};
    const struct piece *last = o->count > 0 ? &o->piece[o->count - 1] : NULL;
    if (piece.press) {
        piece.out[0] = a + 2 * Z2 / (Z1 + Z2) * (b - a);
        piece.out[1] = b + 2 * Z1 / (Z1 + Z2) * (a - b);
    }
    if (last != NULL && last->press && !piece.press) {
        o->released = now->t;
    }
    o->contacts += piece.press && (last == NULL || !last->press);
    if (last != NULL && last->press == piece.press && fabs(last->out[0] - piece.out[0]) <= SAME &&
        fabs(last->out[1] - piece.out[1]) <= SAME) {
        return true;
    }
    if (o->count == ROD_IMPACT_CHANGES) {
        return false;
    }
    for (int rod = 0; rod < 2; rod++) {
        piece.sum[rod] = last == NULL ? 0 : last->sum[rod] + last->out[rod] * (now->t - last->t);
    }
    o->piece[o->count++] = piece;
    return true;
}

/* To the next event: all arrivals up to it, within a tie, are one. */
static void advance(const struct oracle *o, struct now *now, double tie)
{
    const struct piece *piece = o->piece;
    double arrival[2], next, closing = now->in[0] - now->in[1];
    for (int rod = 0; rod < 2; rod++) {
        arrival[rod] = now->next[rod] < o->count ? piece[now->next[rod]].t + 2 * o->rod[rod].T : INFINITY;
    }
    next = fmin(arrival[0], arrival[1]);
    bool press = piece[o->count - 1].press;
    if (now->gap > 0 && closing > 0) {
        next = fmin(next, now->t + now->gap / closing);
    }
    now->gap = press ? 0 : now->gap - closing * (next - now->t);
    now->gap = now->gap > tie ? now->gap : 0;
    now->t = next;
    for (int rod = 0; rod < 2; rod++) {
        while (now->next[rod] < o->count && piece[now->next[rod]].t + 2 * o->rod[rod].T <= next + tie) {
            now->in[rod] = piece[now->next[rod]++].out[rod];
        }
    }
}

static bool follow(struct oracle *o, char why[ORACLE_WHY])
{
    struct now now = {.in = {1, 0}};
    for (size_t events = 0; events < 4 * (size_t)ROD_IMPACT_CHANGES && record(o, &now); events++) {
        double tie = tie_at(o, now.t);
        if (events > 0 && parted(o, &now, tie)) {
            return true;
        }
        o->tie = tie;
        advance(o, &now, tie);
    }
    const struct rod_impact_given *g = &o->given;
    (void)snprintf(why, ORACLE_WHY,
                   "E1 = %g, rho1 = %g, L1 = %g, E2 = %g, rho2 = %g, L2 = %g (SI units): the rods have not parted for "
                   "good after %d changes at their faces; choose times of travel nearer to each other",
                   g->E1, g->rho1, g->L1, g->E2, g->rho2, g->L2, (int)ROD_IMPACT_CHANGES);
    return false;
}

static bool fits(const struct oracle *o, const double *value, char why[ORACLE_WHY])
{
    const struct rod_impact_given *g = &o->given;
    double v = fmax(fabs(g->v1), fabs(g->v2)), T1 = o->rod[0].T, T2 = o->rod[1].T, Z1 = o->rod[0].Z, Z2 = o->rod[1].Z;
    if (!(g->v1 > g->v2)) {
        (void)snprintf(why, ORACLE_WHY,
                       "v1 = %.15g m/s, but it must be greater than v2 = %.15g m/s, or the rods never meet", g->v1,
                       g->v2);
        return false;
    }
    double size[] = {g->E1,
                     g->E2,
                     o->rod[0].c,
                     o->rod[1].c,
                     Z1,
                     Z2,
                     T1,
                     T2,
                     v,
                     o->closing,
                     Z1 * v * v,
                     Z2 * v * v,
                     Z1 * v * v * T1,
                     Z2 * v * v * T2,
                     Z1 / (Z1 + Z2) * Z2 * o->closing * o->closing,
                     v * (o->contact + T1 + T2),
                     o->closing / o->rod[0].c,
                     o->closing / o->rod[1].c};
    if (!oracle_representable(size, sizeof size / sizeof *size, false)) {
        return oracle_out_of_range(parameters, value, why);
    }
    /* Round-off of a phase, and of a velocity beside which that of the waves is small. */
    double shorter = fmin(T1, T2), far = o->rod[1].upper / o->rod[1].c;
    double phase = (o->contact + 6 * fmax(T1, T2) + far) / shorter, drift = v / (o->closing * fmin(Z1, Z2) / (Z1 + Z2));
    if (DBL_EPSILON * (1 + phase) * (1 + drift) > NO_DIGITS) {
        (void)snprintf(
            why, ORACLE_WHY,
            "v1 = %.15g m/s, v2 = %.15g m/s, gap = %g m: the rods meet after %g s, %g times what a wave takes "
            "through one of them, and with %g of their velocity; too few digits are left of the impact; "
            "choose a smaller gap, rods that are less different, or a frame in which they move less fast",
            g->v1, g->v2, g->gap, o->contact, o->contact / shorter, o->closing / v);
        return false;
    }
    return bar_pair_fits(&o->rod[0], &o->rod[1], why) && bar_is_resolved(&o->rod[1], 1 / fmin(T1, T2), why);
}

static bool create(const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    struct oracle *o = calloc(1, sizeof *o);
    if (o == NULL) {
        return oracle_no_memory(sizeof *o, why);
    }
    o->given = (struct rod_impact_given){.E1 = value[0],
                                         .rho1 = value[1],
                                         .L1 = value[2],
                                         .v1 = value[3],
                                         .E2 = value[4],
                                         .rho2 = value[5],
                                         .L2 = value[6],
                                         .v2 = value[7],
                                         .gap = value[8]};
    o->rod[0] = bar_make(0, value[2], value[0], value[1]);
    o->rod[1] = bar_make(value[2] + value[8], value[6], value[4], value[5]);
    o->closing = value[3] - value[7];
    o->contact = value[8] / o->closing;
    if (!fits(o, value, why) || !follow(o, why)) {
        oracle_release(o);
        return false;
    }
    *oracle = o;
    return true;
}

const struct rod_impact_given *rod_impact_given(const struct oracle *oracle)
{
    return &oracle->given;
}

size_t rod_impact_changes(const struct oracle *oracle, double time[ROD_IMPACT_CHANGES])
{
    for (size_t i = 0; i < oracle->count; i++) {
        time[i] = oracle->contact + oracle->piece[i].t;
    }
    return oracle->count;
}

const struct oracle_kind oracle_rod_impact = {
    .name = "rod-impact",
    .summary = "longitudinal impact of two elastic rods of any length and material, until they part",
    .source =
        "Saint-Venant's solution by characteristics; for instance Graff, Wave Motion in Elastic Solids, section 2.4",
    .dim = 1,
    .smoothness = ORACLE_JUMPS,
    .parameter = parameters,
    .create = create,
    .destroy = oracle_release,
    .state = state,
    .outside = outside,
    .energy = energy,
    .fronts = fronts,
    .figures = figures,
    .check = rod_impact_check,
};
