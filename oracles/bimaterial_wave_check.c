/* Whether the fields of the bimaterial wave are what they should be. Beside the laws of every bar: the ends, the weld,
 * the scattering of one pulse, the work done at the left end, and two evaluations of other kinds.
 *
 * The first is Laplace's transform. The history of the left end, transformed by quadrature, must give the transforms of
 * all fields at other places through the transfer functions of a transmission line, in which there are no reflections
 * to be counted, only tanh(s T2). exp(-s t) forgets what is late, so this one sees the early reflections.
 *
 * The second is Fourier's. Nothing acts on the bars once the left end is free: the amplitude of each of their modes,
 * found by projection, must swing from its values then on, at all later times alike. */
#include "oracles/bimaterial_wave.h"
#include "oracles/self_check_parts.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { END_SAMPLES = 32, BREAKS = 16384, MODES = 8 };

/* The problem, from what the scene gives alone. */
struct problem {
    struct self_check *check;
    const struct bimaterial_wave_given *given;
    double c1, Z1, T1, c2, Z2, T2;
};

static void state_at(const struct problem *of, double X, double t, struct oracle_state *state)
{
    double place[3] = {X, 0, 0};
    of->check->kind->state(of->check->oracle, place, t, state);
}

static double bound_of(const struct problem *of)
{
    return 64 * self_check_round_off(of->check);
}

static void at_rest(const struct oracle *oracle, const double X[3], double u[3], double v[3])
{
    (void)oracle, (void)X;
    memset(u, 0, 3 * sizeof *u);
    memset(v, 0, 3 * sizeof *v);
}

/* Also just before and just after t1, where the end is set free. */
static void check_left_end(const struct problem *of)
{
    const struct bimaterial_wave_given *g = of->given;
    double moved = 0, swung = 0, pulled = 0;
    for (size_t i = 0; i < END_SAMPLES; i++) {
        double part = i == 0 ? 1 - 1e-10 : self_check_sequence(i, 3), later = i == 0 ? 1e-10 * g->t1 : part;
        double driven = part * g->t1, free = g->t1 + (i == 0 ? later : part * (of->check->t_end - g->t1));
        struct oracle_state state;
        state_at(of, 0, driven, &state);
        double u = g->A1 * (1 - cos(g->omega * driven)), v = g->A1 * g->omega * sin(g->omega * driven);
        moved = self_check_worse(moved, fabs(state.u[0] - u));
        swung = self_check_worse(swung, fabs(state.v[0] - v));
        state_at(of, 0, free, &state);
        pulled = self_check_worse(pulled, fabs(state.P[0]));
    }
    const struct self_check_scale *size = &of->check->of;
    self_check_line(of->check, "u on X0 while driven", self_check_relative(moved, size->u + fabs(g->A1)), bound_of(of));
    self_check_line(of->check, "v on X0 while driven", self_check_relative(swung, size->v), bound_of(of));
    self_check_line(of->check, "P on X0 once free", self_check_relative(pulled, size->stress), bound_of(of));
}

static void check_weld(const struct problem *of)
{
    double u = 0, v = 0, P = 0, X = of->given->L1;
    for (size_t i = 0; i < END_SAMPLES; i++) {
        double t = of->check->t_end * self_check_sequence(i, 3);
        struct oracle_state left, right;
        state_at(of, X, t, &left);
        state_at(of, nextafter(X, INFINITY), t, &right);
        u = self_check_worse(u, fabs(left.u[0] - right.u[0]));
        v = self_check_worse(v, fabs(left.v[0] - right.v[0]));
        P = self_check_worse(P, fabs(left.P[0] - right.P[0]));
    }
    const struct self_check_scale *size = &of->check->of;
    self_check_line(of->check, "weld: [u] = 0", self_check_relative(u, size->u), bound_of(of));
    self_check_line(of->check, "weld: [v] = 0", self_check_relative(v, size->v), bound_of(of));
    self_check_line(of->check, "weld: [P] = 0", self_check_relative(P, size->stress), bound_of(of));
}

/* The first pulse at the weld, before anything comes back to it: its stress half way to the weld, what leaves it to the
 * left, and what is found beyond it. */
static void check_scattering(const struct problem *of)
{
    const struct bimaterial_wave_given *g = of->given;
    double window = fmin(g->t1, 2 * fmin(of->T1, of->T2)), age = 0, R = 0, T = 0, flux = 0;
    for (int i = 1; i <= 16; i++) {
        double sample = 0.45 * window * i / 16;
        bool higher = fabs(sin(g->omega * sample)) > fabs(sin(g->omega * age));
        age = higher ? sample : age;
    }
    if (g->A1 != 0) {
        struct oracle_state incident, left, right;
        state_at(of, g->L1 / 2, of->T1 / 2 + age, &incident);
        state_at(of, g->L1, of->T1 + age, &left);
        state_at(of, nextafter(g->L1, INFINITY), of->T1 + age, &right);
        R = (left.P[0] + of->Z1 * left.v[0]) / 2 / incident.P[0];
        T = right.P[0] / incident.P[0];
        double expected = (of->Z2 - of->Z1) / (of->Z2 + of->Z1);
        flux = fabs(R * R + T * T * of->Z1 / of->Z2 - 1);
        R = fabs(R - expected);
        T = fabs(T / (2 * of->Z2 / (of->Z2 + of->Z1)) - 1);
    }
    /* The phase at the sample is off by the round-off of T1. */
    double bound = bound_of(of) / fmin(1, g->omega * age);
    self_check_line(of->check, "R = (Z2 - Z1)/(Z2 + Z1)", R, bound);
    self_check_line(of->check, "T = 2 Z2/(Z2 + Z1)", T, bound);
    self_check_line(of->check, "R^2 + T^2 Z1/Z2 = 1", flux, bound);
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Integrals over time at one place. */
struct history {
    const struct problem *of;
    double X;
    size_t count;
    double at[BREAKS]; /* times between which no front comes by, in order */
};

/* Times at which a front may come by up to `end`: every path's, so some at which none does. */
static void find_breaks(struct history *history, double end)
{
    const struct problem *of = history->of;
    const struct bimaterial_wave_given *g = of->given;
    double X = history->X, there, back;
    there = X <= g->L1 ? X / of->c1 : of->T1 + (X - g->L1) / of->c2;
    back = X <= g->L1 ? 2 * of->T1 - there : 2 * (of->T1 + of->T2) - there;
    history->count = 0;
    history->at[history->count++] = 0;
    history->at[history->count++] = end;
    for (int path = 0; path < 4; path++) {
        double first = (path % 2 == 0 ? 0 : g->t1) + (path / 2 == 0 ? there : back);
        for (int j = 0; first + 2 * j * of->T2 < end; j++) {
            for (int i = 0; first + 2 * i * of->T1 + 2 * j * of->T2 < end && history->count < BREAKS - 1; i++) {
                history->at[history->count++] = first + 2 * i * of->T1 + 2 * j * of->T2;
            }
        }
    }
    if (g->t1 < end) {
        history->at[history->count++] = g->t1;
    }
    qsort(history->at, history->count, sizeof *history->at, ascending);
}

/* Integrals of u, v, P times exp(-s (t - origin)), and of the power -P v. */
static void integrate_history(const struct history *history, double s, double origin, double sum[4])
{
    memset(sum, 0, 4 * sizeof *sum);
    double longest = 1 / (self_check_worse(history->of->check->frequency, s));
    for (size_t i = 0; i + 1 < history->count; i++) {
        double from = history->at[i], length = history->at[i + 1] - from;
        int cuts = (int)ceil(length / longest);
        for (int cut = 0; cut < cuts; cut++) {
            for (int n = 0; n < SELF_CHECK_NODES; n++) {
                double weight, t = from + length / cuts * (cut + 0.5 + self_check_node(n, &weight) / 2);
                struct oracle_state state;
                state_at(history->of, history->X, t, &state);
                weight *= length / cuts / 2;
                double decay = exp(-s * (t - origin));
                sum[0] += weight * decay * state.u[0];
                sum[1] += weight * decay * state.v[0];
                sum[2] += weight * decay * state.P[0];
                sum[3] -= weight * state.P[0] * state.v[0];
            }
        }
    }
}

/* V and P at X for V = exp(-s there) at the left end: waves in a line whose load is the right bar's Z2 tanh(s T2). */
static void transfer(const struct problem *of, double X, double s, double *V, double *P)
{
    double load = of->Z2 * tanh(s * of->T2), echo = (of->Z1 - load) / (of->Z1 + load);
    double first = 1 / (1 + echo * exp(-2 * s * of->T1));
    double left = X <= of->given->L1 ? X / of->c1 : of->T1;
    /* relative to exp(-s left) */
    double mirrored = echo * exp(-2 * s * (of->T1 - left));
    *V = first * (X < of->given->L1 ? 1 + mirrored : 2 * of->Z1 / (of->Z1 + load)); /* no difference of near numbers */
    *P = -of->Z1 * first * (1 - mirrored);
    if (X > of->given->L1) {
        double depth = (X - of->given->L1) / of->c2, end = exp(-2 * s * of->T2), here = exp(-2 * s * (of->T2 - depth));
        *P = -of->Z2 * *V * (1 - here) / (1 + end);
        *V *= (1 + here) / (1 + end);
    }
}

/* A large array, one at a time. */
static void check_laplace(const struct problem *of, struct history *history)
{
    const struct bimaterial_wave_given *g = of->given;
    const double X[4] = {0.35 * g->L1, nextafter(g->L1, INFINITY), g->L1 + 0.35 * g->L2, g->L1 + g->L2};
    double worst[3] = {0}, end = of->check->t_end;
    for (int i = 0; i < 4; i++) {
        double there = X[i] <= g->L1 ? X[i] / of->c1 : of->T1 + (X[i] - g->L1) / of->c2;
        double s = 38 / (end - there), first[4], here[4], V, P; /* exp(-38) is below the round-off */
        history->X = 0;
        find_breaks(history, end);
        integrate_history(history, s, 0, first);
        history->X = X[i];
        find_breaks(history, end);
        integrate_history(history, s, there, here);
        transfer(of, X[i], s, &V, &P);
        /* P is nothing at the free end, and v little where the right material is hard: what they are made of counts. */
        double size = X[i] <= g->L1 ? fabs(first[1]) : fabs(here[1]);
        double stress = fabs(first[1]) * (X[i] <= g->L1 ? of->Z1 : of->Z2);
        worst[0] = self_check_worse(worst[0], self_check_relative(fabs(s * here[0] - first[1] * V), size));
        worst[1] = self_check_worse(worst[1], self_check_relative(fabs(here[1] - first[1] * V), size));
        worst[2] = self_check_worse(worst[2], self_check_relative(fabs(here[2] - first[1] * P), stress));
    }
    self_check_line(of->check, "Laplace transform: u", worst[0], bound_of(of));
    self_check_line(of->check, "Laplace transform: v", worst[1], bound_of(of));
    self_check_line(of->check, "Laplace transform: P", worst[2], bound_of(of));
}

static void check_work(const struct problem *of, struct history *history)
{
    struct self_check_distance work = {0};
    history->X = 0;
    for (int i = 1; i <= 4; i++) {
        double end = i * of->given->t1 / 4, sum[4], kinetic, strain;
        find_breaks(history, end);
        integrate_history(history, 0, 0, sum);
        of->check->kind->energy(of->check->oracle, end, &kinetic, &strain);
        double total = kinetic + strain;
        self_check_measure(&work, &total, &sum[3], 1);
    }
    self_check_line(of->check, "energy = work of the left end", self_check_relative(work.error, work.size),
                    bound_of(of));
}

/* Zero at the frequencies of the free bars: both bars' modes, cos, meet at the weld with one stress. */
static double frequency_condition(const struct problem *of, double w)
{
    double a = w * of->T1, b = w * of->T2;
    return (of->Z1 * sin(a) * cos(b) + of->Z2 * cos(a) * sin(b)) / (of->Z1 + of->Z2);
}

/* To the last digit. */
static double bisect(const struct problem *of, double lower, double upper)
{
    bool rises = frequency_condition(of, lower) < 0;
    for (;;) {
        double middle = lower + (upper - lower) / 2;
        if (!(middle > lower && middle < upper)) {
            return middle;
        }
        *((frequency_condition(of, middle) < 0) == rises ? &lower : &upper) = middle;
    }
}

/* One mode: cos(w X / c1) on the left, `right` cos(w (X - end) / c2) on the right. */
struct mode {
    double w, left, right;
};

struct mode_piece {
    double amplitude, k, X0;
};

/* Of rho times the mode squared, and of rho u, rho v and P on it and on its slope. */
static void project(const struct self_check_body *body, const struct oracle_state *state, const double X[3],
                    const void *with, double weight, double sum[SELF_CHECK_SUMS])
{
    const struct mode_piece *piece = with;
    double phase = piece->k * (X[0] - piece->X0);
    double shape = piece->amplitude * cos(phase), slope = -piece->amplitude * piece->k * sin(phase);
    sum[0] += weight * body->rho * shape * state->u[0];
    sum[1] += weight * body->rho * shape * state->v[0];
    sum[2] += weight * slope * state->P[0];
}

static void amplitudes(const struct problem *of, const struct mode *mode, double t, double q[3])
{
    const struct bimaterial_wave_given *g = of->given;
    const struct mode_piece piece[2] = {{mode->left, mode->w / of->c1, 0},
                                        {mode->right, mode->w / of->c2, g->L1 + g->L2}};
    memset(q, 0, 3 * sizeof *q);
    for (int i = 0; i < 2; i++) {
        struct self_check_body body = self_check_body(of->check, i);
        double sum[SELF_CHECK_SUMS], longest = fmin(self_check_radian(of->check, &body), 1 / piece[i].k);
        self_check_integrate(of->check, &body, t, longest, project, &piece[i], sum);
        q[0] += sum[0];
        q[1] += sum[1];
        q[2] += sum[2] / (mode->w * mode->w); /* of P = E u', as the mode's own stress integrates to w^2 */
    }
}

static void swing(const struct problem *of, const struct mode *mode, struct self_check_distance distance[3])
{
    double start = of->given->t1, first[3];
    amplitudes(of, mode, start, first);
    for (size_t i = 0; i < 6; i++) {
        double t = start + (of->check->t_end - start) * self_check_sequence(i, 3), phase = mode->w * (t - start), q[3];
        amplitudes(of, mode, t, q);
        double u = first[0] * cos(phase) + first[1] / mode->w * sin(phase);
        double expected[3] = {u, first[1] * cos(phase) - first[0] * mode->w * sin(phase), u};
        for (int n = 0; n < 3; n++) {
            self_check_measure(&distance[n], &q[n], &expected[n], 1);
        }
    }
}

/* The lowest modes, by sign changes of the condition; two that lie within one step are both passed over. */
static void check_modes(const struct problem *of)
{
    struct self_check_distance distance[3] = {0};
    double step = asin(1.0) / (16 * (of->T1 + of->T2));
    double fastest = 0;
    int found = 0;
    for (int i = 0; i < 4096 && found < MODES; i++) {
        double w = (i + 0.5) * step, lower = frequency_condition(of, w);
        double upper = frequency_condition(of, w + step);
        if (lower * upper < 0) {
            struct mode mode = {.w = bisect(of, w, w + step), .left = 1};
            double a = mode.w * of->T1, b = mode.w * of->T2;
            /* one displacement at the weld, or, where both have a node there, one stress */
            bool node = fabs(cos(b)) < 0.5;
            mode.right = node ? -of->Z1 * sin(a) / (of->Z2 * sin(b)) : cos(a) / cos(b);
            double size = fmax(1, fabs(mode.right));
            mode.left /= size;
            mode.right /= size;
            swing(of, &mode, distance);
            fastest = mode.w;
            found++;
        }
    }
    self_check_mode_lines(of->check, distance, fastest);
}

/* Long enough for some reflections at the interface and both ends, in whichever bar they are quicker. */
static double horizon(const struct problem *of)
{
    double both = of->T1 + of->T2;
    return fmax(of->given->t1 + both / 2, both + 2 * fmin(both, 16 * fmin(of->T1, of->T2)));
}

size_t bimaterial_wave_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                             size_t size)
{
    static const bool loose[3] = {false, false, false};
    const struct bimaterial_wave_given *g = bimaterial_wave_given(oracle);
    struct problem of = {.given = g, .c1 = sqrt(g->E1 / g->rho1), .c2 = sqrt(g->E2 / g->rho2)};
    struct self_check_body right = {
        .lower = {g->L1}, .upper = {g->L1 + g->L2}, .bulk = g->E2 / 3, .mu = g->E2 / 2, .rho = g->rho2};
    struct self_check laws = {.kind = kind,
                              .oracle = oracle,
                              .upper = {g->L1},
                              .bulk = g->E1 / 3,
                              .mu = g->E1 / 2,
                              .rho = g->rho1,
                              .behind = &right,
                              .t_free = g->t1,
                              .line = line,
                              .size = size};
    of.check = &laws;
    of.Z1 = g->rho1 * of.c1;
    of.Z2 = g->rho2 * of.c2;
    of.T1 = g->L1 / of.c1;
    of.T2 = g->L2 / of.c2;
    double v = fabs(g->A1 * g->omega) * sin(fmin(asin(1.0), g->omega * g->t1));
    laws.least = (struct self_check_scale){.v = v, .gradient = v / of.c1, .stress = of.Z1 * v};
    laws.t_end = horizon(&of);
    laws.frequency = fmax(g->omega, 1 / fmin(g->t1, fmin(of.T1, of.T2)));
    laws.wave_number = laws.frequency / of.c1;
    self_check_differentials(&laws);
    self_check_starts(&laws, at_rest);
    check_left_end(&of);
    self_check_face(&laws, 0, true, loose);
    check_weld(&of);
    check_scattering(&of);
    self_check_fronts(&laws);
    static _Thread_local struct history history; /* too large for the stack */
    history = (struct history){.of = &of};
    check_laplace(&of, &history);
    check_modes(&of);
    check_work(&of, &history);
    self_check_energies(&laws);
    return laws.count;
}
