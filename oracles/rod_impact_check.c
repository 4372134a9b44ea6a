/* Whether the fields of the rod impact are what they should be. Beside the laws of every bar: the law of unilateral
 * contact, and a second evaluation of another kind. The stress at the faces, as the fields have it, is given to the
 * modes of either rod, free at both ends, as the force that drives them (Duhamel's integral); what they answer must be
 * what projection finds in the fields. */
#include "oracles/rod_impact.h"
#include "oracles/self_check_parts.h"

#include <math.h>
#include <string.h>

enum { CONTACT_SAMPLES = 256, MODES = 6, TIMES = 6 };

static const double PI = 3.14159265358979323846;

static void free_flight(const struct oracle *oracle, const double X[3], double u[3], double v[3])
{
    const struct rod_impact_given *g = rod_impact_given(oracle);
    memset(u, 0, 3 * sizeof *u);
    memset(v, 0, 3 * sizeof *v);
    v[0] = X[0] <= g->L1 ? g->v1 : g->v2;
}

/* States of the two faces. */
static void faces(const struct self_check *check, double t, struct oracle_state face[2])
{
    double left[3] = {check->upper[0], 0, 0}, right[3] = {check->behind->lower[0], 0, 0};
    check->kind->state(check->oracle, left, t, &face[0]);
    check->kind->state(check->oracle, right, t, &face[1]);
}

/* Faces that press move together; faces that do not press bear nothing; they never overlap, and never pull. */
static void check_contact(struct self_check *check, double gap_at_first)
{
    double overlap = 0, pull = 0, unequal = 0, apart = 0, slip = 0, press = 0;
    double bound = 64 * self_check_round_off(check), length = check->of.u + gap_at_first;
    for (size_t i = 0; i < CONTACT_SAMPLES; i++) {
        struct oracle_state face[2];
        faces(check, self_check_time(check, i), face);
        double gap = gap_at_first + (face[1].u[0] - face[0].u[0]), P = (face[0].P[0] + face[1].P[0]) / 2;
        bool pressing = P < -bound * check->of.stress;
        press = pressing ? 1 : press;
        overlap = self_check_worse(overlap, isnan(gap) ? NAN : fmax(0, -gap));
        pull = self_check_worse(pull, isnan(P) ? NAN : fmax(0, P));
        unequal = self_check_worse(unequal, fabs(face[0].P[0] - face[1].P[0]));
        apart = self_check_worse(apart, pressing ? fabs(gap) : 0);
        slip = self_check_worse(slip, pressing ? fabs(face[0].v[0] - face[1].v[0]) : 0);
    }
    self_check_line(check, "contact: the gap is not negative", overlap / length, bound);
    self_check_line(check, "contact: the faces do not pull", self_check_relative(pull, check->of.stress), bound);
    self_check_line(check, "contact: action and reaction", self_check_relative(unequal, check->of.stress), bound);
    self_check_line(check, "contact: no stress across a gap", press > 0 ? apart / length : NAN, bound);
    self_check_line(check, "contact: faces that press move together", self_check_relative(slip, check->of.v), bound);
}

/* The history of the stress between the faces: constant from one change to the next. */
struct history {
    size_t count;
    double time[ROD_IMPACT_CHANGES], P[ROD_IMPACT_CHANGES][2]; /* P from time[i] on, of either face */
};

static double read_history(const struct self_check *check, struct history *history)
{
    double uneven = 0;
    history->count = rod_impact_changes(check->oracle, history->time);
    for (size_t i = 0; i < history->count && history->time[i] < check->t_end; i++) {
        double from = history->time[i], to = i + 1 < history->count ? history->time[i + 1] : check->t_end;
        for (int sample = 0; sample < 3; sample++) {
            struct oracle_state face[2];
            faces(check, from + (to - from) * (0.5 + 0.4 * (sample - 1)), face);
            for (int rod = 0; rod < 2; rod++) {
                history->P[i][rod] = sample == 0 ? face[rod].P[0] : history->P[i][rod];
                uneven = self_check_worse(uneven, fabs(face[rod].P[0] - history->P[i][rod]));
            }
        }
    }
    return uneven;
}

/* q and dq/dt of a mode with frequency w that starts at rest and is driven by push P(t); for w = 0 the motion of the
 * whole. */
static void drive(const struct history *history, int rod, double push, double w, double t, double q[2])
{
    q[0] = q[1] = 0;
    for (size_t i = 0; i < history->count && history->time[i] < t; i++) {
        double to = i + 1 < history->count ? fmin(t, history->time[i + 1]) : t;
        double a = t - history->time[i], b = t - to, force = push * history->P[i][rod];
        q[0] += force * (w > 0 ? (cos(w * b) - cos(w * a)) / (w * w) : (a * a - b * b) / 2);
        q[1] += force * (w > 0 ? (sin(w * a) - sin(w * b)) / w : a - b);
    }
}

static void add_momentum(const struct self_check_body *body, const struct oracle_state *state, const double X[3],
                         const void *with, double weight, double sum[SELF_CHECK_SUMS])
{
    (void)X, (void)with;
    sum[0] += weight * state->p[0];
    sum[1] += weight * body->rho * state->u[0];
}

/* The body as a whole: momentum, and mass times mean displacement. */
static double compare_bodily(const struct self_check *check, const struct history *history, int rod, double t)
{
    const struct rod_impact_given *g = rod_impact_given(check->oracle);
    struct self_check_body body = self_check_body(check, rod);
    double length = body.upper[0] - body.lower[0], mass = body.rho * length, v = rod == 0 ? g->v1 : g->v2;
    double sum[SELF_CHECK_SUMS], driven[2];
    self_check_integrate(check, &body, t, self_check_radian(check, &body), add_momentum, NULL, sum);
    drive(history, rod, rod == 0 ? 1 : -1, 0, t, driven);
    double momentum = fabs(sum[0] - (mass * v + driven[1])) / (mass * check->of.v);
    double place = fabs(sum[1] - (mass * v * t + driven[0])) / (mass * check->of.u);
    return self_check_worse(momentum, place);
}

/* One mode, cos(k (X - X0)) from the free end: all that is found over what the first moment of the impact would give.
 */
static void compare_mode(const struct self_check *check, const struct history *history, int rod, int n, double t,
                         struct self_check_distance of[3])
{
    struct self_check_body body = self_check_body(check, rod);
    double length = body.upper[0] - body.lower[0], k = n * PI / length, w = k * self_check_speed(&body);
    double push = (rod == 0 ? 1 : -1) * (n % 2 == 0 ? 1 : -1) * 2 / (body.rho * length), found[3], driven[2];
    double q = fabs(push) * check->of.stress / (w * w);
    self_check_mode(check, &body, t, k, rod == 0 ? body.lower[0] : body.upper[0], found);
    drive(history, rod, push, w, t, driven);
    double expected[3] = {driven[0], driven[1], driven[0]}, size[3] = {fmax(q, check->of.u), q * w, q};
    for (int field = 0; field < 3; field++) {
        double error = self_check_relative(fabs(found[field] - expected[field]), size[field]);
        of[field].error = self_check_worse(of[field].error, error);
        of[field].size = 1;
    }
}

static void check_modes(struct self_check *check)
{
    static _Thread_local struct history history; /* too large for the stack */
    struct self_check_distance of[3] = {0};
    double bodily = 0, uneven = read_history(check, &history), bound = 64 * self_check_round_off(check);
    for (size_t i = 0; i < TIMES; i++) {
        double t = self_check_time(check, i);
        for (int rod = 0; rod < 2; rod++) {
            bodily = self_check_worse(bodily, compare_bodily(check, &history, rod, t));
            for (int n = 1; n <= MODES; n++) {
                compare_mode(check, &history, rod, n, t, of);
            }
        }
    }
    self_check_line(check, "contact: stress constant between changes", self_check_relative(uneven, check->of.stress),
                    bound);
    self_check_line(check, "momentum of each rod = impulse", bodily, bound);
    self_check_mode_lines(check, of, MODES * PI * check->frequency); /* of the quicker rod */
}

size_t rod_impact_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                        size_t size)
{
    static const bool loose[3] = {false, false, false};
    const struct rod_impact_given *g = rod_impact_given(oracle);
    double c1 = sqrt(g->E1 / g->rho1), c2 = sqrt(g->E2 / g->rho2), T1 = g->L1 / c1, T2 = g->L2 / c2;
    double Z1 = g->rho1 * c1, Z2 = g->rho2 * c2, closing = g->v1 - g->v2, contact = g->gap / closing;
    double v = fmax(fabs(g->v1), fabs(g->v2)), stress = Z1 / (Z1 + Z2) * Z2 * closing;
    /* Without a gap the faces lie at one place; the left rod has it. */
    struct self_check_body right = {.lower = {fmax(g->L1 + g->gap, nextafter(g->L1, INFINITY))},
                                    .upper = {g->L1 + g->gap + g->L2},
                                    .bulk = g->E2 / 3,
                                    .mu = g->E2 / 2,
                                    .rho = g->rho2};
    struct self_check laws = {.kind = kind,
                              .oracle = oracle,
                              .upper = {g->L1},
                              .bulk = g->E1 / 3,
                              .mu = g->E1 / 2,
                              .rho = g->rho1,
                              .behind = &right,
                              .frequency = 1 / fmin(T1, T2),
                              /* nowhere in step with the waves, so that samples do not fall on arrivals */
                              .t_first = fmax(0, contact - 0.371 * fmin(T1, T2)),
                              .t_end = contact + 6.283 * fmax(T1, T2),
                              .drift = v * fmax(Z1, Z2) / stress,
                              .line = line,
                              .size = size};
    laws.wave_number = laws.frequency / c1;
    laws.least = (struct self_check_scale){
        .u = v * laws.t_end, .v = v, .gradient = fmax(stress / g->E1, stress / g->E2), .stress = stress};
    self_check_differentials(&laws);
    self_check_starts(&laws, free_flight);
    self_check_face(&laws, 0, false, loose);
    self_check_face(&laws, 0, true, loose);
    self_check_fronts(&laws);
    check_contact(&laws, g->gap);
    check_modes(&laws);
    self_check_energies(&laws);
    return laws.count;
}
