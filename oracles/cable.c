/* The elastic cable of 001_363f711843f01da4.txt section 4.3: a bar of length L, fixed at X = 0 and free at X = L,
 * starts undeformed; the part within `moving` of the free end has the velocity U0, the rest is at rest.
 *
 * D'Alembert's solution with images: continued as an odd function about the fixed end and an even one about the free
 * end, the initial velocity V has the period 4 L, and with W the integral of V from 0
 *
 *     u = (W(X + ct) - W(X - ct)) / 2c,   v = (V(X + ct) + V(X - ct)) / 2,   F - 1 = (V(X + ct) - V(X - ct)) / 2c.
 *
 * Exact to the round-off of ct at any time, at a cost that does not depend on it. */
#include "oracles/bar.h"
#include "oracles/kind.h"
#include "oracles/self_check_parts.h"

#include <math.h>
#include <stdio.h>

static const double PI = 3.14159265358979323846;

/* So much longer than the moving part may the bar be, or its check would take too long. */
static const double SHORTEST = 1000;

/* What the scene gives; the self-check reads nothing else. */
struct given {
    double L, moving, U0, E, rho;
};

struct oracle {
    struct given given;
    struct bar bar;
    double rest; /* length of the part that is at rest [m] */
};

extern const struct oracle_kind oracle_cable;

static const struct oracle_parameter parameters[] = {
    {"L", "m", "length", 0, INFINITY, true, false, 10},
    {"moving", "m", "length of the part with an initial velocity, at the free end; at most L", 0, INFINITY, true, false,
     2.5},
    {"U0", "m/s", "its velocity", -INFINITY, INFINITY, false, false, 5},
    {"material.E", "Pa", "Young's modulus", 0, INFINITY, true, false, 2e11},
    {"material.rho", "kg/m^3", "density", 0, INFINITY, true, false, 8e3},
    {0},
};

/* The place within [0, L] that y is an image of; *sign is that of the velocity there. */
static double fold(const struct oracle *o, double y, double *sign)
{
    double L = o->given.L, x = fmod(fabs(y), 4 * L);
    *sign = y < 0 ? -1 : 1;
    if (x > 2 * L) {
        x = 4 * L - x;
        *sign = -*sign;
    }
    return x > L ? 2 * L - x : x;
}

static double velocity(const struct oracle *o, double y)
{
    double sign, x = fold(o, y, &sign);
    return x > o->rest ? sign * o->given.U0 : 0;
}

/* Even about 0 and odd about (L, W(L)). */
static double velocity_integral(const struct oracle *o, double y)
{
    double L = o->given.L, sign, x = fmod(fabs(y), 4 * L), within = fmax(0, fold(o, x, &sign) - o->rest);
    x = x > 2 * L ? 4 * L - x : x;
    return o->given.U0 * (x > L ? 2 * o->given.moving - within : within);
}

static void state(const struct oracle *o, const double X[3], double t, struct oracle_state *at)
{
    double ahead = X[0] + o->bar.c * t, behind = X[0] - o->bar.c * t;
    double u = (velocity_integral(o, ahead) - velocity_integral(o, behind)) / (2 * o->bar.c);
    double right = velocity(o, behind), left = velocity(o, ahead);
    bar_state(&o->bar, u, (left + right) / 2, o->bar.Z * (left - right) / 2, at);
}

/* V steps by +U0, -U0, -U0, +U0 within a period; half of each step runs to the right and half to the left. */
static size_t fronts(const struct oracle *o, double t, struct oracle_front front[ORACLE_FRONTS])
{
    double L = o->given.L, step[4][2] = {{o->rest, 1}, {2 * L - o->rest, -1}, {2 * L + o->rest, -1}, {-o->rest, 1}};
    size_t count = 0;
    for (int i = 0; i < 8 && o->given.U0 != 0; i++) {
        double speed = i % 2 == 0 ? o->bar.c : -o->bar.c, X = fmod(step[i / 2][0] + speed * t, 4 * L);
        X = X < 0 ? X + 4 * L : X;
        if (X > 0 && X < L) {
            struct oracle_front added = {X, speed, step[i / 2][1] * o->given.U0 / 2, ORACLE_JUMPS};
            count = bar_add_front(front, count, added, 1e-13 * L);
        }
    }
    return count;
}

static double outside(const struct oracle *o, const double X[3])
{
    return bar_outside(&o->bar, X);
}

static void energy(const struct oracle *o, double t, double *kinetic, double *strain)
{
    *kinetic = *strain = 0;
    bar_energy(&oracle_cable, o, &o->bar, INFINITY, t, kinetic, strain);
}

static size_t figures(const struct oracle *o, struct oracle_figure figure[ORACLE_FIGURES])
{
    size_t count = 0;
    figure[count++] = (struct oracle_figure){"wave speed", "m/s", "sqrt(E / rho)", o->bar.c};
    figure[count++] = (struct oracle_figure){"period", "s", "after which everything is as at first", 4 * o->bar.T};
    figure[count++] = (struct oracle_figure){"pulse stress", "Pa", "behind the front that leaves the moving part",
                                             o->bar.Z * fabs(o->given.U0) / 2};
    return count;
}

static bool create(const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    struct oracle o = {.given = {value[0], value[1], value[2], value[3], value[4]}};
    const struct given *g = &o.given;
    o.bar = bar_make(0, g->L, g->E, g->rho);
    o.rest = g->L - g->moving;
    if (!(g->moving <= g->L && g->moving >= g->L / SHORTEST)) {
        (void)snprintf(why, ORACLE_WHY,
                       "moving = %.15g [m], but it must be at most L = %.15g and at least a thousandth of it; moving = "
                       "%g would do",
                       g->moving, g->L, g->L / 4);
        return false;
    }
    const double always[] = {g->E, o.bar.c, o.bar.Z, o.bar.T};
    const double moving[] = {g->U0, o.bar.Z * g->U0, o.bar.Z * g->U0 / g->E * g->moving,
                             g->moving * g->rho * g->U0 * g->U0};
    if (!oracle_representable(always, sizeof always / sizeof *always, false) ||
        !oracle_representable(moving, sizeof moving / sizeof *moving, g->U0 == 0)) {
        return oracle_out_of_range(parameters, value, why);
    }
    return oracle_keep(&o, sizeof o, oracle, why);
}

static void initial(const struct oracle *oracle, const double X[3], double u[3], double v[3])
{
    const struct given *g = &oracle->given;
    u[0] = u[1] = u[2] = v[1] = v[2] = 0;
    v[0] = X[0] > g->L - g->moving ? g->U0 : 0;
}

/* The second evaluation, the modal series: u = sum of b sin(k X) sin(w t) / w, k = (n - 1/2) pi / L, w = k c, with b
 * the coefficient of the initial velocity, 2 U0 cos(k (L - moving)) / (k L). It converges too slowly to be compared at
 * a point, so the fields are projected on the modes instead, which is exact. */
static void compare_modes(struct self_check *check, const struct given *g)
{
    enum { MODES = 12, TIMES = 8 };
    struct self_check_distance of[3] = {0};
    struct self_check_body body = self_check_body(check, 0);
    for (int n = 1; n <= MODES; n++) {
        double k = (n - 0.5) * PI / g->L, w = k * sqrt(g->E / g->rho);
        double b = 2 * g->U0 * cos(k * (g->L - g->moving)) / (k * g->L);
        for (size_t i = 0; i < TIMES; i++) {
            double t = check->t_end * self_check_sequence(i, 3), found[3];
            double expected[3] = {b / w * sin(w * t), b * cos(w * t), b / w * sin(w * t)};
            self_check_mode(check, &body, t, k, PI / (2 * k), found);
            for (int field = 0; field < 3; field++) {
                self_check_measure(&of[field], &found[field], &expected[field], 1);
            }
        }
    }
    self_check_mode_lines(check, of, MODES * PI / g->L * sqrt(g->E / g->rho));
}

static size_t check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line, size_t size)
{
    static const bool held[3] = {true, true, true}, loose[3] = {false, false, false};
    const struct given *g = &oracle->given;
    double c = sqrt(g->E / g->rho);
    struct self_check laws = {.kind = kind,
                              .oracle = oracle,
                              .upper = {g->L},
                              .wave_number = 1 / g->moving,
                              .frequency = c / g->moving,
                              .t_end = 8 * g->L / c, /* two periods */
                              .bulk = g->E / 3,
                              .mu = g->E / 2,
                              .rho = g->rho,
                              .least = {.u = fabs(g->U0) * g->moving / c,
                                        .v = fabs(g->U0) / 2,
                                        .gradient = fabs(g->U0) / (2 * c),
                                        .stress = fabs(g->U0) / (2 * c) * g->E},
                              .line = line,
                              .size = size};
    self_check_differentials(&laws);
    self_check_starts(&laws, initial);
    self_check_face(&laws, 0, false, held);
    self_check_face(&laws, 0, true, loose);
    self_check_fronts(&laws);
    compare_modes(&laws, g);
    self_check_energies(&laws);
    return laws.count;
}

const struct oracle_kind oracle_cable = {
    .name = "cable",
    .summary = "bar, fixed at one end and free at the other, of which a part has an initial velocity",
    .source = "001_363f711843f01da4.txt, section 4.3; d'Alembert's solution with images",
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
    .check = check,
};
