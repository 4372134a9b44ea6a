/* The heterogeneous cable of 001_363f711843f01da4.txt section 4.5 and Appendix A: two bars welded at X = L1 start at
 * rest. The left end is moved by A1 (1 - cos(omega t)) until t1 and is free from then on; the right end is free.
 *
 * Each bar carries a wave to either side, v = (w+ + w-)/2 and P = Z (w- - w+)/2. Let A(t) be w+ as it leaves the left
 * end, D(t) and C(t) the waves that leave the interface to the left and to the right, T1 and T2 the times of travel.
 * Then
 *
 *     A(t) = -D(t - T1) + 2 v0(t)  while driven,   A(t) = D(t - T1)  once free,
 *     D(t) = R A(t - T1) + 2 Z2/(Z1 + Z2) C(t - 2 T2),     R = (Z1 - Z2)/(Z1 + Z2),
 *     C(t) = 2 Z1/(Z1 + Z2) A(t - T1) - R C(t - 2 T2),
 *
 * and all that is ever asked for lies on the lattice t - 2 i T1 - 2 j T2, however many paths lead there: a wave at time
 * t costs at most (1 + t/2T1)(1 + t/2T2) steps, and is exact to the round-off of the phase. The integrals of A, C, D
 * obey the same with the prescribed displacement for the velocity, and a constant once the end is free; they give u. */
#include "oracles/bimaterial_wave.h"
#include "oracles/bar.h"
#include "oracles/kind.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Round trips in either bar that the oracle follows; later it says NaN. */
enum { ROUND_TRIPS = 4096 };
/* How far times of travel, the driven time and the phase may lie apart, so that a self-check ends. */
static const double MOST_PATHS = 400, MOST_PHASE = 2000;
/* Fronts that are this part of the first one are not listed; jumps that are, cannot be told from kinks. */
static const double NEGLIGIBLE = 1e-15, NO_JUMP = 1e-12;

struct oracle {
    struct bimaterial_wave_given given;
    struct bar left, right;
    double R, to_right,
        to_left;     /* of the velocity: reflection of a wave from the left, and what either way lets through */
    double released; /* twice the difference that remains between u and the integral of D at the left end [m] */
    double first_bend, jump, bend; /* of A at 0, and at t1: steps of value [m/s] and slope [m/s^2] */
};

extern const struct oracle_kind oracle_bimaterial_wave;

static const struct oracle_parameter parameters[] = {
    {"E1", "Pa", "Young's modulus of the left material", 0, INFINITY, true, false, 79.1e9},
    {"rho1", "kg/m^3", "density of the left material", 0, INFINITY, true, false, 2.785e3},
    {"L1", "m", "length of the left material", 0, INFINITY, true, false, 1},
    {"E2", "Pa", "Young's modulus of the right material", 0, INFINITY, true, false, 138.1e9},
    {"rho2", "kg/m^3", "density of the right material", 0, INFINITY, true, false, 8.93e3},
    {"L2", "m", "length of the right material", 0, INFINITY, true, false, 1},
    {"A1", "m", "amplitude of the prescribed motion", -INFINITY, INFINITY, false, false, 5e-5},
    {"omega", "rad/s", "its angular frequency", 0, INFINITY, true, false, 31415.926535897932},
    {"t1", "s", "end of the prescribed motion", 0, INFINITY, true, false, 1e-4},
    {0},
};

/* Displacements and velocities, and for the fronts their slopes, obey one recursion. */
enum channel { DISPLACEMENT, VELOCITY, SLOPE };

/* Twice the prescribed motion; nothing before 0, and what stays of it after t1. 1 - cos would lose digits. */
static double source(const struct oracle *o, enum channel channel, double t)
{
    double A = o->given.A1, w = o->given.omega, half = sin(w * t / 2);
    if (t < 0) {
        return 0;
    }
    if (t >= o->given.t1) {
        return channel == DISPLACEMENT ? o->released : 0;
    }
    return channel == DISPLACEMENT ? 4 * A * half * half
           : channel == VELOCITY   ? 2 * A * w * sin(w * t)
                                   : 2 * A * w * w * cos(w * t);
}

/* D and C as they leave the interface at time t. */
static void leave_interface(const struct oracle *o, enum channel channel, double t, double *D, double *C)
{
    double row[ROUND_TRIPS + 1], T1 = o->left.T, T2 = o->right.T, R = o->R;
    *D = *C = 0;
    if (t < T1) {
        return;
    }
    if (!(t < 2 * ROUND_TRIPS * fmin(T1, T2))) {
        *D = *C = NAN;
        return;
    }
    int most = (int)((t - T1) / (2 * T1));
    memset(row, 0, (size_t)(most + 1) * sizeof *row);
    for (int j = (int)((t - T1) / (2 * T2)); j >= 0; j--) {
        double d = 0;
        for (int i = most; i >= 0; i--) {
            double emitted = t - (2 * i + 1) * T1 - 2 * j * T2;
            double A = source(o, channel, emitted) + (emitted < o->given.t1 ? -d : d), C_before = row[i];
            d = R * A + o->to_left * C_before;
            row[i] = o->to_right * A - R * C_before;
        }
        *D = d;
    }
    *C = row[0];
}

static double leave_left_end(const struct oracle *o, enum channel channel, double t)
{
    double D, C;
    leave_interface(o, channel, t - o->left.T, &D, &C);
    return source(o, channel, t) + (t < o->given.t1 ? -D : D);
}

/* Right- and left-going wave at X. */
static void waves(const struct oracle *o, enum channel channel, double X, double t, double *right, double *left)
{
    double other;
    if (X <= o->left.upper) {
        *right = leave_left_end(o, channel, t - X / o->left.c);
        leave_interface(o, channel, t - (o->left.upper - X) / o->left.c, left, &other);
    } else {
        leave_interface(o, channel, t - (X - o->right.lower) / o->right.c, &other, right);
        leave_interface(o, channel, t - o->right.T - (o->right.upper - X) / o->right.c, &other, left);
    }
}

static void state(const struct oracle *o, const double X[3], double t, struct oracle_state *at)
{
    const struct bar *bar = X[0] <= o->left.upper ? &o->left : &o->right;
    double u[2], v[2];
    waves(o, DISPLACEMENT, X[0], t, &u[0], &u[1]);
    waves(o, VELOCITY, X[0], t, &v[0], &v[1]);
    bar_state(bar, (u[0] + u[1]) / 2, (v[0] + v[1]) / 2, bar->Z * (v[1] - v[0]) / 2, at);
}

static double outside(const struct oracle *o, const double X[3])
{
    return fmin(bar_outside(&o->left, X), bar_outside(&o->right, X));
}

static void energy(const struct oracle *o, double t, double *kinetic, double *strain)
{
    *kinetic = *strain = 0;
    bar_energy(&oracle_bimaterial_wave, o, &o->left, o->left.c / (2 * o->given.omega), t, kinetic, strain);
    bar_energy(&oracle_bimaterial_wave, o, &o->right, o->right.c / (2 * o->given.omega), t, kinetic, strain);
}

/* Of the prescribed motion [m/s]. */
static double peak_velocity(const struct bimaterial_wave_given *g)
{
    double phase = g->omega * g->t1;
    return fabs(g->A1 * g->omega) * (phase < asin(1.0) ? sin(phase) : 1);
}

/* A wave that left the start of its path, at X along its direction, `age` ago, and brought a step of w with it. */
static size_t travelling(const struct oracle *o, const struct bar *bar, bool to_right, double age, double step,
                         double t, struct oracle_front front[ORACLE_FRONTS], size_t count)
{
    if (!(age >= 0 && age < bar->T)) {
        return count;
    }
    double way = bar->c * age, near = 16 * DBL_EPSILON * (bar->c * t + o->right.upper);
    struct oracle_front added = {.X = to_right ? bar->lower + way : bar->upper - way,
                                 .speed = to_right ? bar->c : -bar->c,
                                 .jump = (to_right ? -step : step) / 2};
    return bar_add_front(front, count, added, near);
}

/* Adds all that has come of a step and a bend of A at time `from`. */
static size_t follow(const struct oracle *o, double from, double step, double bend, double t,
                     struct oracle_front front[ORACLE_FRONTS], size_t count)
{
    double row[ROUND_TRIPS + 2], T1 = o->left.T, T2 = o->right.T, R = o->R, v = peak_velocity(&o->given);
    double least = fmax(fabs(step), fabs(bend) * fmin(1 / o->given.omega, o->given.t1)) / v;
    if (!(from <= t)) {
        return count;
    }
    memset(row, 0, (size_t)((t - from) / (2 * T1) + 2) * sizeof *row);
    for (int j = 0; from + 2 * j * T2 <= t; j++) {
        double D = 0;
        for (int i = 0; from + 2 * i * T1 + 2 * j * T2 <= t; i++) {
            double at = from + 2 * i * T1 + 2 * j * T2, before = row[i];
            double A = i == 0 ? (double)(j == 0) : at < o->given.t1 * (1 - 1e-12) ? -D : D;
            D = R * A + o->to_left * before;
            row[i] = o->to_right * A - R * before;
            if (least * fabs(A) > NEGLIGIBLE) {
                count = travelling(o, &o->left, true, t - at, A * step, t, front, count);
            }
            if (least * fabs(D) > NEGLIGIBLE) {
                count = travelling(o, &o->left, false, t - at - T1, D * step, t, front, count);
            }
            if (least * fabs(row[i]) > NEGLIGIBLE) {
                count = travelling(o, &o->right, true, t - at - T1, row[i] * step, t, front, count);
                count = travelling(o, &o->right, false, t - at - T1 - T2, row[i] * step, t, front, count);
            }
        }
    }
    return count;
}

static size_t fronts(const struct oracle *o, double t, struct oracle_front front[ORACLE_FRONTS])
{
    const struct bimaterial_wave_given *g = &o->given;
    size_t count = 0;
    if (!(t < 2 * ROUND_TRIPS * fmin(o->left.T, o->right.T))) {
        return ORACLE_TOO_MANY_FRONTS;
    }
    if (g->A1 != 0) {
        count = follow(o, 0, 0, o->first_bend, t, front, count);
        count = follow(o, g->t1, o->jump, o->bend, t, front, count);
    }
    for (size_t i = 0; count != ORACLE_TOO_MANY_FRONTS && i < count; i++) {
        bool jumps = fabs(front[i].jump) > NO_JUMP * peak_velocity(g);
        front[i].jump = jumps ? front[i].jump : 0;
        front[i].smoothness = jumps ? ORACLE_JUMPS : ORACLE_KINKS;
    }
    if (g->E1 != g->E2 || g->rho1 != g->rho2) {
        struct oracle_front interface = {.X = o->left.upper, .smoothness = ORACLE_JUMPS};
        count = bar_add_front(front, count, interface, 0);
    }
    return count;
}

static size_t figures(const struct oracle *o, struct oracle_figure figure[ORACLE_FIGURES])
{
    const struct oracle_figure all[] = {
        {"wave speed 1", "m/s", "in the left material", o->left.c},
        {"wave speed 2", "m/s", "in the right material", o->right.c},
        {"reflection", "-", "of stress, for a wave from the left: reflected over incident", -o->R},
        {"transmission", "-", "of stress, for a wave from the left: transmitted over incident", o->to_left},
        {"peak incident stress", "Pa", "magnitude before the first reflection", o->left.Z * peak_velocity(&o->given)},
        {"interface reached", "s", "by the front of the wave", o->left.T},
        {"first echo", "s", "at the left end", 2 * o->left.T},
    };
    memcpy(figure, all, sizeof all);
    return sizeof all / sizeof *all;
}

/* What the end of the prescribed motion leaves behind. Values just before t1 are extrapolated from a little earlier, so
 * that a front arriving at t1 itself does not count twice. */
static void release(struct oracle *o)
{
    const struct bimaterial_wave_given *g = &o->given;
    double early = 1e-9 * fmin(g->t1, fmin(o->left.T, o->right.T)), at = g->t1 - o->left.T, half, u, v, slope, C;
    leave_interface(o, DISPLACEMENT, at, &u, &C);
    leave_interface(o, VELOCITY, at - early, &v, &C);
    leave_interface(o, SLOPE, at - early, &slope, &C);
    half = sin(g->omega * g->t1 / 2);
    o->released = 4 * g->A1 * half * half - 2 * u;
    o->first_bend = 2 * g->A1 * g->omega * g->omega;
    o->jump = 2 * (v + early * slope - g->A1 * g->omega * sin(g->omega * g->t1));
    o->bend = 2 * (slope - g->A1 * g->omega * g->omega * cos(g->omega * g->t1));
}

static bool fits(const struct oracle *o, const double *value, char why[ORACLE_WHY])
{
    const struct bimaterial_wave_given *g = &o->given;
    double v = peak_velocity(g), T1 = o->left.T, T2 = o->right.T, Z = fmax(o->left.Z, o->right.Z);
    const double always[] = {g->E1, g->E2,    o->left.c, o->left.Z,          T1, o->right.c, o->right.Z,
                             T2,    g->omega, g->t1,     g->omega * g->omega};
    const double moving[] = {g->A1,
                             v,
                             v * v,
                             Z * v,
                             g->E1 / Z * v,
                             g->E2 / Z * v,
                             Z * v * v,
                             Z * v * v * (T1 + T2),
                             v * g->omega * g->omega,
                             Z * v * g->omega,
                             fmin(o->left.Z, o->right.Z) * v * v};
    if (!oracle_representable(always, sizeof always / sizeof *always, false) ||
        !oracle_representable(moving, sizeof moving / sizeof *moving, g->A1 == 0)) {
        return oracle_out_of_range(parameters, value, why);
    }
    if (!bar_pair_fits(&o->left, &o->right, why)) {
        return false;
    }
    double longest = 2 * sqrt(MOST_PATHS * T1 * T2);
    if (g->t1 > longest || g->t1 < (T1 + T2) / MOST_PHASE || g->omega * (g->t1 + T1 + T2) > MOST_PHASE) {
        (void)snprintf(why, ORACLE_WHY,
                       "t1 = %g s, omega = %g rad/s: with the %g s that a wave takes through both bars, t1 must be at "
                       "least %g s and at most %g s, and omega with this t1 at most %g rad/s",
                       g->t1, g->omega, T1 + T2, (T1 + T2) / MOST_PHASE, longest, MOST_PHASE / (g->t1 + T1 + T2));
        return false;
    }
    return bar_is_resolved(&o->right, fmax(g->omega, 1 / fmin(g->t1, fmin(T1, T2))), why);
}

static bool create(const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    struct oracle o = {.given = {.E1 = value[0],
                                 .rho1 = value[1],
                                 .L1 = value[2],
                                 .E2 = value[3],
                                 .rho2 = value[4],
                                 .L2 = value[5],
                                 .A1 = value[6],
                                 .omega = value[7],
                                 .t1 = value[8]}};
    const struct bimaterial_wave_given *g = &o.given;
    o.left = bar_make(0, g->L1, g->E1, g->rho1);
    o.right = bar_make(g->L1, g->L2, g->E2, g->rho2);
    o.R = (o.left.Z - o.right.Z) / (o.left.Z + o.right.Z);
    o.to_right = 2 * o.left.Z / (o.left.Z + o.right.Z);
    o.to_left = 2 * o.right.Z / (o.left.Z + o.right.Z);
    if (!fits(&o, value, why)) {
        return false;
    }
    release(&o);
    return oracle_keep(&o, sizeof o, oracle, why);
}

const struct bimaterial_wave_given *bimaterial_wave_given(const struct oracle *oracle)
{
    return &oracle->given;
}

const struct oracle_kind oracle_bimaterial_wave = {
    .name = "bimaterial-wave",
    .summary = "wave through two welded bars, from an end that is moved for a time and then set free",
    .source = "001_363f711843f01da4.txt, section 4.5 and Appendix A; by characteristics, for any number of reflections",
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
    .check = bimaterial_wave_check,
};
