/* The second evaluation of a breathing body shares no formula with the first: its displacement is the mean over all
 * directions n of plane p-waves that run along n,
 *
 *     u = A < n sin(k n.X) > cos(omega t),   du_i/dX_j = A k < n_i n_j cos(k n.X) > cos(omega t),
 *
 * by Gauss rules over the angle between n and X. Its k is the root, by bisection, of the traction that these means give
 * on the surface. */
#include "oracles/breathing.h"
#include "oracles/self_check_parts.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;
enum { CENTRE_TIMES = 8 };

/* By way of the bulk modulus, so that a slip in the oracle's own constants is seen. */
struct moduli {
    double bulk, mu; /* [Pa] */
};

static struct moduli moduli(const struct breathing *g)
{
    return (struct moduli){.bulk = g->E / (3 * (1 - 2 * g->nu)), .mu = g->E / (2 * (1 + g->nu))};
}

/* Means over all directions, c the cosine of the angle with X and s^2 the square of its sine over d - 1. */
struct means {
    double moved;         /* < c sin(x c) > */
    double along, across; /* < c^2 cos(x c) >, < s^2 cos(x c) > */
    double apart;         /* along - across; small ones to the last digit, since < c^2 > = < s^2 > */
};

static struct means means(int dim, double x)
{
    int pieces = 2 + (int)ceil(x / 2);
    struct means sum = {0};
    for (int i = 0; i < pieces * SELF_CHECK_NODES; i++) {
        double share, node = self_check_node(i % SELF_CHECK_NODES, &share), width = PI / 2 / pieces;
        int piece = i / SELF_CHECK_NODES;
        double angle = width * (piece + (1 + node) / 2), c = cos(angle), s = sin(angle);
        double across = s * s / (dim - 1), half = sin(x * c / 2);
        double weight = share * width / 2 * (dim == 3 ? s : 2 / PI);
        sum.moved += weight * c * sin(x * c);
        sum.along += weight * c * c * cos(x * c);
        sum.across += weight * across * cos(x * c);
        sum.apart += weight * (across - c * c) * 2 * half * half;
    }
    return sum;
}

/* Of a displacement with the radial derivative `along` and u / r = `across`. */
static double radial_stress(const struct breathing *g, const struct means *m)
{
    const struct moduli of = moduli(g);
    int dim = g->body.dim;
    double trace = m->along + (dim - 1) * m->across, bulk = of.bulk + of.mu * (2.0 / dim - 2.0 / 3);
    return bulk * trace + 2 * of.mu * (dim - 1) / dim * m->apart;
}

/* Between the same places as the first (see there): the sign of the stress on the surface changes once. */
static double second_root(const struct breathing *g)
{
    double shift = (g->body.dim - 2) / 4.0, upper = (g->mode + shift) * PI;
    double lower = g->mode == 1 ? 0 : (g->mode - 1 + shift) * PI, middle = (lower + upper) / 2;
    double sign = g->mode % 2 == 1 ? 1 : -1;
    while (middle > lower && middle < upper) {
        struct means surface = means(g->body.dim, middle);
        *(sign * radial_stress(g, &surface) > 0 ? &lower : &upper) = middle;
        middle = (lower + upper) / 2;
    }
    return middle;
}

/* What the second evaluation needs, found once. */
struct waves {
    double k, amplitude, frequency; /* [rad/m], A [m], [rad/s] */
};

static struct waves waves(const struct breathing *g)
{
    const struct moduli of = moduli(g);
    double root = second_root(g);
    struct waves w = {.k = root / g->body.outer, .amplitude = g->amplitude / means(g->body.dim, root).moved};
    w.frequency = w.k * sqrt((of.bulk + 4 * of.mu / 3) / g->rho);
    return w;
}

static void second(const struct self_check *check, const double X[3], double t, struct oracle_state *state)
{
    const struct breathing *g = &check->oracle->given;
    const struct waves *w = check->with;
    const struct moduli of = moduli(g);
    double r = shell_radius(&g->body, X), swing = w->amplitude * cos(w->frequency * t), G[9] = {0};
    double rate = -w->amplitude * w->frequency * sin(w->frequency * t);
    struct means m = means(g->body.dim, w->k * r);
    memset(state, 0, sizeof *state);
    for (int i = 0; i < g->body.dim; i++) {
        state->u[i] = swing * m.moved * X[i] / r;
        state->v[i] = rate * m.moved * X[i] / r;
        state->p[i] = g->rho * state->v[i];
        for (int j = 0; j < g->body.dim; j++) {
            G[3 * i + j] = swing * w->k * ((i == j ? m.across : 0) + m.apart * (X[i] / r) * (X[j] / r));
        }
    }
    for (int i = 0; i < 9; i++) {
        state->F[i] = (i % 4 == 0 ? 1 : 0) + G[i];
    }
    self_check_hooke(of.bulk, of.mu, G, state->P);
}

/* The surface goes out by U0, all at once, and is let go at rest. */
static void starts(struct self_check *check)
{
    const struct breathing *g = &check->oracle->given;
    struct self_check_distance moved = {0};
    double moving = 0;
    for (size_t i = 0; i < CENTRE_TIMES; i++) {
        struct oracle_state state;
        double part[3] = {1, self_check_sequence(i, 1), self_check_sequence(i, 2)}, X[3], u[3];
        (void)shell_place(check->shell, part, 0, X);
        check->kind->state(check->oracle, X, 0, &state);
        for (int k = 0; k < 3; k++) {
            u[k] = g->amplitude * (X[k] / g->body.outer);
        }
        self_check_measure(&moved, state.u, u, 3);
        struct self_check_spot spot = self_check_sample_at(check, i, 0);
        check->kind->state(check->oracle, spot.X, 0, &state);
        self_check_largest(&moving, state.v, 3);
    }
    self_check_line(check, "initial displacement of the surface", self_check_relative(moved.error, check->of.u),
                    16 * DBL_EPSILON);
    self_check_line(check, "initial velocity", self_check_relative(moving, check->of.v), 16 * DBL_EPSILON);
}

/* The centre stays where it is, and nothing has a direction there. */
static void centre(struct self_check *check)
{
    static const double X[3] = {0, 0, 0};
    double moved = 0, sheared = 0, loaded = 0;
    for (size_t i = 0; i < CENTRE_TIMES; i++) {
        struct oracle_state s;
        check->kind->state(check->oracle, X, self_check_time(check, i), &s);
        self_check_largest(&moved, s.u, 3);
        for (int k = 0; k < 9; k++) {
            int same = k % 4 == 0 ? k % (4 * check->kind->dim) : -1; /* what F and P must not differ from */
            double F = same < 0 ? s.F[k] : s.F[k] - (k == same ? s.F[0] : 1);
            double P = same < 0 ? s.P[k] : k == same ? s.P[k] - s.P[0] : 0;
            self_check_largest(&sheared, &F, 1);
            self_check_largest(&loaded, &P, 1);
        }
    }
    self_check_line(check, "displacement of the centre", self_check_relative(moved, check->of.u), 16 * DBL_EPSILON);
    self_check_line(check, "F in all directions at the centre",
                    sheared / self_check_gradient_scale(check, 16 * DBL_EPSILON), 16 * DBL_EPSILON);
    self_check_line(check, "P in all directions at the centre", self_check_relative(loaded, check->of.stress),
                    16 * DBL_EPSILON);
}

size_t breathing_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                       size_t size)
{
    const struct breathing *g = &oracle->given;
    const struct moduli of = moduli(g);
    const struct waves with = waves(g);
    /* Where the wave is much longer than the body, differences are taken over parts of the body. */
    struct self_check laws = {.kind = kind,
                              .oracle = oracle,
                              .shell = &g->body,
                              .with = &with,
                              .wave_number = fmax(with.k, 1 / g->body.outer),
                              .frequency = with.frequency,
                              .t_end = 4 * PI / with.frequency,
                              .bulk = of.bulk,
                              .mu = of.mu,
                              .rho = g->rho,
                              .line = line,
                              .size = size};
    self_check_differentials(&laws);
    starts(&laws);
    centre(&laws);
    self_check_free_surfaces(&laws, 16 * self_check_round_off(&laws));
    self_check_compare(&laws, second, 16 * self_check_round_off(&laws));
    self_check_energies(&laws);
    return laws.count;
}
