/* What the plastic wave must satisfy beside the equations of motion: the return map, the yield surface, the Hugoniot
 * elastic limit, times of arrival, and energies with plastic work. The second evaluation knows no bilinear curve: it
 * integrates the rate equations through a simple wave, d(strain)/dv = -1/c with c by the current tangent modulus. */
#include "oracles/j2_check.h"
#include "oracles/kind.h"
#include "oracles/plastic_wave.h"
#include "oracles/self_check_parts.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { PLACES = 64 };
static const double BOUND = 1e-12;   /* of the second evaluation: j2_follow's, with a digit to spare */
static const double STATION = 0.371; /* of the thickness: where arrivals are timed */

/* The laws come first: a pointer to them is one to the whole. */
struct plastic {
    struct self_check laws;
    struct j2 material;
    double limit;              /* Hugoniot elastic limit [Pa] */
    double yielding;           /* velocity of the face from which on there are two waves [m/s] */
    size_t waves;              /* by the rate equations */
    struct j2_state behind[2]; /* each wave, by the rate equations */
    double v[2], speed[2];     /* [m/s] */
    bool followed;             /* to the end */
};

static const struct plastic *whole(const struct self_check *check)
{
    return (const struct plastic *)(const void *)check;
}

static double plastic_strain(const struct self_check *check, const double X[3], double t)
{
    double value[ORACLE_EXTRAS];
    check->kind->extras(check->oracle, X, t, value);
    return value[J2_PLASTIC_STRAIN];
}

static bool at_once(const struct self_check *check, double t, const double G[9], struct j2_state *state)
{
    (void)t;
    *state = (struct j2_state){.plastic = 0};
    return j2_return(&whole(check)->material, G, state) > 0;
}

static void return_map(const struct self_check *check, const double X[3], double t, const double G[9], double P[9])
{
    struct j2_state state;
    (void)X;
    (void)at_once(check, t, G, &state);
    j2_stress(&state, P);
}

static const struct self_check_material LAW = {.law = "P = J2 return map(du/dX)", .stress = return_map};

static void check_faces(struct self_check *check)
{
    const struct plastic_wave_given *g = plastic_wave_given(check->oracle);
    double driven = 0, still = 0;
    for (size_t i = 0; i < PLACES; i++) {
        struct oracle_state near, far;
        const double X0[3] = {0, 0, 0}, X1[3] = {g->L, 0, 0};
        double t = self_check_time(check, i);
        check->kind->state(check->oracle, X0, t, &near);
        check->kind->state(check->oracle, X1, t, &far);
        driven = self_check_worse(driven, fabs(near.v[0] - g->v0) / g->v0);
        driven = self_check_worse(driven, fabs(near.u[0] - g->v0 * t) / (g->v0 * t));
        still = self_check_worse(still, fabs(far.u[0]) / (g->v0 * t));
    }
    self_check_line(check, "X0 moves with v0", driven, 16 * DBL_EPSILON);
    self_check_line(check, "X1 has not moved", still, 16 * DBL_EPSILON);
}

/* Both waves pass a place when they should, and what is between them is at the elastic limit. */
static void check_waves(struct self_check *check)
{
    const struct plastic *of = whole(check);
    const struct plastic_wave_given *g = plastic_wave_given(check->oracle);
    double c = self_check_speed(&(struct self_check_body){.bulk = check->bulk, .mu = check->mu, .rho = check->rho});
    double X[3] = {STATION * g->L, 0, 0}, first = X[0] / c, v = fmin(g->v0, of->yielding);
    self_check_arrival(check, "arrival of the elastic wave", X[0], v / 2, first);
    double plastic = g->hardening * check->mu / (3 * check->mu + g->hardening); /* 0 without hardening */
    double modulus = check->bulk + 4.0 / 3 * plastic, second = X[0] / sqrt(modulus / g->rho);
    struct oracle_state state;
    bool two = g->v0 > of->yielding;
    if (two && second < check->t_end) {
        self_check_arrival(check, "arrival of the plastic wave", X[0], (v + g->v0) / 2, second);
    }
    check->kind->state(check->oracle, X, first + (two ? fmin(second, check->t_end) - first : first) / 2, &state);
    double due = two ? of->limit : g->rho * c * g->v0;
    self_check_line(check, "stress behind the elastic wave", fabs(state.P[0] + due) / due, 64 * DBL_EPSILON);
}

struct moment {
    const struct plastic *of;
    double t;
};

static void plastic_work(const struct self_check_body *body, const struct oracle_state *state, const double X[3],
                         const void *with, double weight, double sum[SELF_CHECK_SUMS])
{
    const struct moment *at = with;
    (void)body, (void)state;
    sum[0] += weight * j2_plastic_work(&at->of->material, plastic_strain(&at->of->laws, X, at->t));
}

/* What the face has done, and the plastic work in all of the plate. */
static void supplied(const struct self_check *check, double t, double *fed, double *lost, double *passed)
{
    struct self_check_body body = self_check_body(check, 0);
    const struct moment at = {whole(check), t};
    double done = 0, sum[SELF_CHECK_SUMS];
    const double X[3] = {0, 0, 0};
    for (int n = 0; n < SELF_CHECK_NODES; n++) {
        struct oracle_state state;
        double weight, node = self_check_node(n, &weight);
        check->kind->state(check->oracle, X, t * (1 + node) / 2, &state);
        done -= t > 0 ? weight * t / 2 * state.P[0] * state.v[0] : 0;
    }
    self_check_integrate(check, &body, t, INFINITY, plastic_work, &at, sum);
    *fed = *passed = done;
    *lost = sum[0];
}

static double tangent_speed(const struct j2 *material, const struct j2_state *at, bool plastic, double rho)
{
    static const double stretch[9] = {1};
    struct j2_state derivative;
    j2_rates(material, at, plastic, stretch, &derivative);
    return sqrt((derivative.deviator[0] + derivative.mean) / rho);
}

/* Along the simple wave, by the velocity. */
static void simple_wave(const struct j2 *material, const void *rho, double v, const struct j2_state *at, bool plastic,
                        double rate[9])
{
    (void)v;
    memset(rate, 0, 9 * sizeof *rate);
    rate[0] = -1 / tangent_speed(material, at, plastic, *(const double *)rho);
}

/* Where the tangent changes the simple wave falls apart into two fronts. */
static bool follow_waves(struct plastic *of)
{
    const struct plastic_wave_given *g = plastic_wave_given(of->laws.oracle);
    struct j2_state *first = &of->behind[0], *second = &of->behind[1];
    double yielded, again;
    *first = *second = (struct j2_state){.plastic = 0};
    if (!j2_follow(&of->material, simple_wave, &g->rho, 0, g->v0, second, &yielded)) {
        return false;
    }
    of->waves = yielded < g->v0 ? 2 : 1;
    of->v[0] = yielded;
    of->v[1] = g->v0;
    bool done = j2_follow(&of->material, simple_wave, &g->rho, 0, yielded, first, &again);
    of->speed[0] = tangent_speed(&of->material, first, false, g->rho);
    of->speed[1] = tangent_speed(&of->material, first, true, g->rho);
    return done;
}

/* Self-similar in X/t; u is the integral of the strain from the rest ahead. */
static void by_rates(const struct self_check *check, const double X[3], double t, struct oracle_state *state)
{
    const struct plastic *of = whole(check);
    double ahead = 0, v_ahead = 0;
    if (!of->followed) {
        oracle_silence(state);
        return;
    }
    memset(state, 0, sizeof *state);
    for (size_t i = 0; i < of->waves; i++) {
        double inside = fmax(0, of->speed[i] * t - X[0]);
        if (inside > 0) {
            j2_stress(&of->behind[i], state->P);
            memcpy(state->F, of->behind[i].strain, sizeof state->F);
            v_ahead = of->v[i];
        }
        state->u[0] += (ahead - of->behind[i].strain[0]) * inside;
        ahead = of->behind[i].strain[0];
    }
    state->v[0] = v_ahead;
    state->p[0] = check->rho * v_ahead;
    for (int i = 0; i < 3; i++) {
        state->F[4 * i] += 1;
    }
}

static void at_rest(const struct oracle *oracle, const double X[3], double u[3], double v[3])
{
    (void)oracle, (void)X;
    memset(u, 0, 3 * sizeof *u);
    memset(v, 0, 3 * sizeof *v);
}

size_t plastic_wave_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                          size_t size)
{
    const struct plastic_wave_given *g = plastic_wave_given(oracle);
    /* By way of Lame's constants; the elastic limit by the equivalent stress 2 mu |strain| of uniaxial strain. */
    double lambda = g->E / (1 + g->nu) * (g->nu / (1 - 2 * g->nu)), mu = g->E / (2 * (1 + g->nu));
    double modulus = lambda + 2 * mu, c = sqrt(modulus / g->rho), T = g->L / c;
    struct plastic of = {.laws = {.kind = kind,
                                  .oracle = oracle,
                                  .upper = {g->L},
                                  .bulk = g->E / (3 * (1 - 2 * g->nu)),
                                  .mu = mu,
                                  .rho = g->rho,
                                  .material = &LAW,
                                  .supplied = supplied,
                                  .wave_number = 1 / g->L,
                                  .frequency = 1 / T,
                                  .t_first = 0.0371 * T,
                                  .t_end = 0.99871 * T,
                                  .line = line,
                                  .size = size},
                         .limit = modulus * (g->yield_stress / (2 * mu))};
    of.material = (struct j2){of.laws.bulk, mu, g->yield_stress, g->hardening};
    of.yielding = of.limit / (g->rho * c);
    self_check_differentials(&of.laws);
    self_check_starts(&of.laws, at_rest);
    check_faces(&of.laws);
    self_check_fronts(&of.laws);
    check_waves(&of.laws);
    j2_check(&of.laws, &of.material, at_once);
    self_check_energies(&of.laws);
    self_check_reach(&of.laws, "says nothing once X1 is reached", T, 16 * DBL_EPSILON);
    of.followed = follow_waves(&of);
    self_check_compare(&of.laws, by_rates, BOUND);
    return of.laws.count;
}
