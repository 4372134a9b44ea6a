/* What the cycles must satisfy: the return map from turning point to turning point, the yield surface, and the work of
 * the faces. The second evaluation integrates the rate equations along the path; the deformation gradient it reports
 * is the integral of the strain's rate. */
#include "oracles/j2_check.h"
#include "oracles/j2_cycle.h"
#include "oracles/kind.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { MOST_LEGS = 2 * J2_CYCLES + 1, CUTS = 8 };
static const double PI = 3.14159265358979323846;
static const double FOLLOWED = 2e-13; /* of the second evaluation, a leg: twice that of j2_follow */

/* The laws come first: a pointer to them is one to the whole. */
struct cycle {
    struct self_check laws;
    const struct j2_cycle_given *given;
    const struct j2_cycle_path *path;
    struct j2 material;
    struct j2_state turn[MOST_LEGS + 1]; /* at the beginning of each leg, by the rate equations */
    double yielded[MOST_LEGS];           /* when each of them yields [s] */
    bool followed;                       /* to the end */
};

static const struct cycle *whole(const struct self_check *check)
{
    return (const struct cycle *)(const void *)check;
}

/* Legs end at odd quarters of a period; the last one with the last period. */
static double leg_begins(const struct cycle *of, int leg)
{
    return leg == 0 ? 0 : fmin((2 * leg - 1) * of->given->period / 4, of->given->cycles * of->given->period);
}

static int leg_of(const struct cycle *of, double t)
{
    int leg = 0;
    while (leg < 2 * of->given->cycles && t >= leg_begins(of, leg + 1)) {
        leg++;
    }
    return leg;
}

static double turning_point(const struct cycle *of, int leg)
{
    return leg % 2 == 1 ? of->given->amplitude : -of->given->amplitude;
}

/* Small strain, or the logarithm of a stretch along the axes. */
static void strain_of(const struct cycle *of, const double G[9], double strain[9])
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            strain[3 * i + j] = of->path->logarithmic ? 0 : (G[3 * i + j] + G[3 * j + i]) / 2;
        }
        strain[4 * i] = of->path->logarithmic ? log1p(G[4 * i]) : G[4 * i];
    }
}

static bool from_turn_to_turn(const struct self_check *check, double t, const double G[9], struct j2_state *state)
{
    const struct cycle *of = whole(check);
    double strain[9];
    *state = (struct j2_state){.plastic = 0};
    for (int leg = 1; leg <= leg_of(of, t); leg++) {
        double turned[9] = {0};
        turned[of->path->component] = turning_point(of, leg);
        strain_of(of, turned, strain);
        (void)j2_return(&of->material, strain, state);
    }
    strain_of(of, G, strain);
    return j2_return(&of->material, strain, state) > 0;
}

/* Kirchhoff's stress to the first of Piola and Kirchhoff, for a stretch along the axes. */
static void pull_back(const struct cycle *of, const struct j2_state *state, const double G[9], double P[9])
{
    j2_stress(state, P);
    for (int i = 0; of->path->logarithmic && i < 3; i++) {
        P[4 * i] /= 1 + G[4 * i];
    }
}

static void return_map(const struct self_check *check, const double X[3], double t, const double G[9], double P[9])
{
    struct j2_state state;
    (void)X;
    (void)from_turn_to_turn(check, t, G, &state);
    pull_back(whole(check), &state, G, P);
}

/* Of the elastic part of the strain, by Kirchhoff's stress where strains are finite. */
static double elastic_energy(const struct self_check *check, const double X[3], double t,
                             const struct oracle_state *state)
{
    double tau[9], J = check->kind->finite_strain ? oracle_jacobian(state) : 1;
    (void)X, (void)t;
    oracle_cauchy(check->kind, state, tau);
    double mean = (tau[0] + tau[4] + tau[8]) / 3 * J, q = j2_equivalent(tau) * J;
    return mean / (2 * check->bulk) * mean + q / (6 * check->mu) * q;
}

static const struct self_check_material LAW = {
    .law = "P = J2 return map(du/dX)", .stress = return_map, .energy = elastic_energy};

/* P : dF/dt: the velocity is that of the corners, linear in X. */
static double power(const struct self_check *check, double t)
{
    double sum = 0;
    for (int j = 0; j < 3; j++) {
        struct oracle_state state;
        double corner[3] = {j == 0, j == 1, j == 2};
        check->kind->state(check->oracle, corner, t, &state);
        for (int i = 0; i < 3; i++) {
            sum += state.P[3 * i + j] * state.v[i];
        }
    }
    return sum;
}

static double work_between(const struct self_check *check, double from, double to)
{
    int cuts = whole(check)->path->logarithmic ? CUTS : 1; /* linear otherwise */
    double sum = 0, half = (to - from) / (2 * cuts);
    for (int n = 0; n < cuts * SELF_CHECK_NODES; n++) {
        double weight, node = self_check_node(n % SELF_CHECK_NODES, &weight);
        int cut = n / SELF_CHECK_NODES;
        sum += weight * half * power(check, from + half * (2 * cut + 1 + node));
    }
    return sum;
}

/* What the faces have done, and the plastic work. What the impulses at the turning points do is nothing. */
static void supplied(const struct self_check *check, double t, double *fed, double *lost, double *passed)
{
    const struct cycle *of = whole(check);
    const double X[3] = {0.5, 0.5, 0.5};
    double value[ORACLE_EXTRAS];
    *fed = *passed = 0;
    for (int leg = 0; leg <= leg_of(of, t); leg++) {
        double from = leg_begins(of, leg), to = fmin(t, leg_begins(of, leg + 1)), yields = fmin(to, of->yielded[leg]);
        double elastic = work_between(check, from, yields), yielding = work_between(check, yields, to);
        *fed += elastic + yielding;
        *passed += fabs(elastic) + fabs(yielding);
    }
    check->kind->extras(check->oracle, X, t, value);
    *lost = j2_plastic_work(&of->material, value[J2_PLASTIC_STRAIN]);
}

struct rate {
    const struct cycle *of;
    int leg;
};

static void along_leg(const struct j2 *material, const void *with, double t, const struct j2_state *at, bool plastic,
                      double strain_rate[9])
{
    const struct rate *rate = with;
    const struct cycle *of = rate->of;
    double speed = (rate->leg % 2 == 0 ? 4 : -4) * of->given->amplitude / of->given->period;
    (void)material, (void)t, (void)plastic;
    memset(strain_rate, 0, 9 * sizeof *strain_rate);
    if (of->path->component == 1) {
        strain_rate[1] = strain_rate[3] = speed / 2;
    } else {
        strain_rate[0] = of->path->logarithmic ? speed / exp(at->strain[0]) : speed;
    }
}

static void follow_cycles(struct cycle *of)
{
    of->followed = true;
    of->turn[0] = (struct j2_state){.plastic = 0};
    for (int leg = 0; leg <= 2 * of->given->cycles; leg++) {
        const struct rate rate = {of, leg};
        of->turn[leg + 1] = of->turn[leg];
        of->yielded[leg] = INFINITY;
        of->followed = of->followed && j2_follow(&of->material, along_leg, &rate, leg_begins(of, leg),
                                                 leg_begins(of, leg + 1), &of->turn[leg + 1], &of->yielded[leg]);
    }
}

static void by_rates(const struct self_check *check, const double X[3], double t, struct oracle_state *state)
{
    const struct cycle *of = whole(check);
    int leg = leg_of(of, t), component = of->path->component;
    const struct rate rate = {of, leg};
    struct j2_state at = of->turn[leg];
    double yielded, G[9] = {0};
    if (!of->followed || !j2_follow(&of->material, along_leg, &rate, leg_begins(of, leg), t, &at, &yielded)) {
        oracle_silence(state);
        return;
    }
    G[component] =
        component == 1 ? at.strain[1] + at.strain[3] : (of->path->logarithmic ? expm1(at.strain[0]) : at.strain[0]);
    double speed = (leg % 2 == 0 ? 1 : -1) * of->given->amplitude / (of->given->period / 4);
    memset(state, 0, sizeof *state);
    state->u[0] = G[component] * X[component];
    state->v[0] = speed * X[component];
    state->p[0] = check->rho * speed * X[component];
    memcpy(state->F, G, sizeof G);
    state->F[0] += 1;
    state->F[4] = state->F[8] = 1;
    pull_back(of, &at, G, state->P);
}

static void sets_off(const struct oracle *oracle, const double X[3], double u[3], double v[3])
{
    const struct j2_cycle_given *g = j2_cycle_given(oracle);
    memset(u, 0, 3 * sizeof *u);
    memset(v, 0, 3 * sizeof *v);
    v[0] = g->amplitude / (g->period / 4) * X[j2_cycle_path(oracle)->component];
}

size_t j2_cycle_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                      size_t size)
{
    const struct j2_cycle_given *g = j2_cycle_given(oracle);
    double lambda = g->E / (1 + g->nu) * (g->nu / (1 - 2 * g->nu)), mu = g->E / (2 * (1 + g->nu));
    struct cycle of = {.given = g, .path = j2_cycle_path(oracle)};
    /* What an error of the stretch does to P11 grows as the stretch gets small. */
    double steeper = of.path->logarithmic ? 1 / ((1 - g->amplitude) * (1 - g->amplitude)) : 1;
    of.material = (struct j2){lambda + 2 * mu / 3, mu, g->yield_stress, g->hardening};
    of.laws = (struct self_check){.kind = kind,
                                  .oracle = oracle,
                                  .upper = {1, 1, 1},
                                  .bulk = of.material.bulk,
                                  .mu = mu,
                                  .rho = g->rho,
                                  .material = &LAW,
                                  .pieces = 4 * (size_t)g->cycles,
                                  .supplied = supplied,
                                  .wave_number = 1,
                                  .frequency = 2 * PI / g->period,
                                  .t_end = g->cycles * g->period,
                                  .line = line,
                                  .size = size};
    of.laws.least.gradient = g->amplitude;
    of.laws.least.stress = (lambda + 2 * mu) * g->amplitude * steeper;
    follow_cycles(&of);
    self_check_differentials(&of.laws);
    self_check_starts(&of.laws, sets_off);
    j2_check(&of.laws, &of.material, from_turn_to_turn);
    self_check_energies(&of.laws);
    self_check_reach(&of.laws, "says nothing after the last cycle", of.laws.t_end, 16 * DBL_EPSILON);
    self_check_compare(&of.laws, by_rates, FOLLOWED * (2 * g->cycles + 1));
    return of.laws.count;
}
