/* Whether the fields of the bimaterial wave are what they should be. Beside the laws of every bar: the ends, the weld,
 * the scattering of one pulse, the work done at the left end, and two evaluations of other kinds.
 *
 * The first is Laplace's transform. The history of the left end, transformed by quadrature, must give the transforms of
 * all fields at other places through the transfer functions of a transmission line, in which there are no reflections
 * to be counted, only tanh(s T2). exp(-s t) forgets what is late, so this one sees the early reflections.
 *
 * The second is Fourier's. Nothing acts on the bars once the left end is free: the amplitude of each of their modes,
 * found by projection, must swing from its values then on, at all later times alike. */
#include "oracles/bimaterial_wave_check.h"

#include <math.h>
#include <string.h>

enum { END_SAMPLES = 32 };

void bimaterial_state(const struct bimaterial_problem *of, double X, double t, struct oracle_state *state)
{
    double place[3] = {X, 0, 0};
    of->check->kind->state(of->check->oracle, place, t, state);
}

double bimaterial_bound(const struct bimaterial_problem *of)
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
static void check_left_end(const struct bimaterial_problem *of)
{
    const struct bimaterial_wave_given *g = of->given;
    double moved = 0, swung = 0, pulled = 0;
    for (size_t i = 0; i < END_SAMPLES; i++) {
        double part = i == 0 ? 1 - 1e-10 : self_check_sequence(i, 3), later = i == 0 ? 1e-10 * g->t1 : part;
        double driven = part * g->t1, free = g->t1 + (i == 0 ? later : part * (of->check->t_end - g->t1));
        struct oracle_state state;
        bimaterial_state(of, 0, driven, &state);
        double u = g->A1 * (1 - cos(g->omega * driven)), v = g->A1 * g->omega * sin(g->omega * driven);
        moved = self_check_worse(moved, fabs(state.u[0] - u));
        swung = self_check_worse(swung, fabs(state.v[0] - v));
        bimaterial_state(of, 0, free, &state);
        pulled = self_check_worse(pulled, fabs(state.P[0]));
    }
    const struct self_check_scale *size = &of->check->of;
    self_check_line(of->check, "u on X0 while driven", self_check_relative(moved, size->u + fabs(g->A1)),
                    bimaterial_bound(of));
    self_check_line(of->check, "v on X0 while driven", self_check_relative(swung, size->v), bimaterial_bound(of));
    self_check_line(of->check, "P on X0 once free", self_check_relative(pulled, size->stress), bimaterial_bound(of));
}

static void check_weld(const struct bimaterial_problem *of)
{
    double u = 0, v = 0, P = 0, X = of->given->L1;
    for (size_t i = 0; i < END_SAMPLES; i++) {
        double t = of->check->t_end * self_check_sequence(i, 3);
        struct oracle_state left, right;
        bimaterial_state(of, X, t, &left);
        bimaterial_state(of, nextafter(X, INFINITY), t, &right);
        u = self_check_worse(u, fabs(left.u[0] - right.u[0]));
        v = self_check_worse(v, fabs(left.v[0] - right.v[0]));
        P = self_check_worse(P, fabs(left.P[0] - right.P[0]));
    }
    const struct self_check_scale *size = &of->check->of;
    self_check_line(of->check, "weld: [u] = 0", self_check_relative(u, size->u), bimaterial_bound(of));
    self_check_line(of->check, "weld: [v] = 0", self_check_relative(v, size->v), bimaterial_bound(of));
    self_check_line(of->check, "weld: [P] = 0", self_check_relative(P, size->stress), bimaterial_bound(of));
}

/* The first pulse at the weld, before anything comes back to it: its stress half way to the weld, what leaves it to the
 * left, and what is found beyond it. */
static void check_scattering(const struct bimaterial_problem *of)
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
        bimaterial_state(of, g->L1 / 2, of->T1 / 2 + age, &incident);
        bimaterial_state(of, g->L1, of->T1 + age, &left);
        bimaterial_state(of, nextafter(g->L1, INFINITY), of->T1 + age, &right);
        R = (left.P[0] + of->Z1 * left.v[0]) / 2 / incident.P[0];
        T = right.P[0] / incident.P[0];
        double expected = (of->Z2 - of->Z1) / (of->Z2 + of->Z1);
        flux = fabs(R * R + T * T * of->Z1 / of->Z2 - 1);
        R = fabs(R - expected);
        T = fabs(T / (2 * of->Z2 / (of->Z2 + of->Z1)) - 1);
    }
    /* The phase at the sample is off by the round-off of T1. */
    double bound = bimaterial_bound(of) / fmin(1, of->check->frequency * age);
    self_check_line(of->check, "R = (Z2 - Z1)/(Z2 + Z1)", R, bound);
    self_check_line(of->check, "T = 2 Z2/(Z2 + Z1)", T, bound);
    self_check_line(of->check, "R^2 + T^2 Z1/Z2 = 1", flux, bound);
}

/* Long enough for some reflections at the interface and both ends, in whichever bar they are quicker; the factor keeps
 * samples out of step with jumps, which may arrive at round parts of any sum of the times of travel. */
static double horizon(const struct bimaterial_problem *of)
{
    double both = of->T1 + of->T2;
    return 1.0372 * fmax(of->given->t1 + both / 2, both + 2 * fmin(both, 16 * fmin(of->T1, of->T2)));
}

/* The first pulse, which samples may miss, times the square root of the number of echoes that come back while the end
 * is moved: as much does their round-off add up to, even where they cancel. u is half the sum of two waves, which
 * differ by the impulse over Z. */
static struct self_check_scale least(const struct bimaterial_problem *of)
{
    const struct bimaterial_wave_given *g = of->given;
    double phase = g->omega * g->t1, half = sin(fmin(phase, 2 * asin(1.0)) / 2);
    double echoes = sqrt(1 + g->t1 / (2 * of->T1));
    double v = echoes * fabs(g->A1 * g->omega) * sin(fmin(asin(1.0), phase));
    double u = echoes * 2 * fabs(g->A1) * half * half;
    return (struct self_check_scale){.u = self_check_worse(of->drive.most_impulse / of->Z1, u),
                                     .v = v,
                                     .gradient = v / of->c1,
                                     .stress = of->Z1 * v};
}

size_t bimaterial_wave_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                             size_t size)
{
    static const bool loose[3] = {false, false, false};
    const struct bimaterial_wave_given *g = bimaterial_wave_given(oracle);
    struct bimaterial_problem of = {.given = g, .c1 = sqrt(g->E1 / g->rho1), .c2 = sqrt(g->E2 / g->rho2)};
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
    laws.t_end = horizon(&of);
    laws.frequency = fmax(g->omega, 1 / fmin(g->t1, fmin(of.T1, of.T2)));
    laws.wave_number = laws.frequency / of.c1;
    bimaterial_drive(&of);
    laws.least = least(&of);
    self_check_differentials(&laws);
    self_check_starts(&laws, at_rest);
    check_left_end(&of);
    self_check_face(&laws, 0, true, loose);
    check_weld(&of);
    check_scattering(&of);
    self_check_fronts(&laws);
    bimaterial_check_laplace(&of);
    bimaterial_check_modes(&of);
    bimaterial_check_work(&of);
    self_check_energies(&laws);
    return laws.count;
}
