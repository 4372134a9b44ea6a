/* What the impacts of plates must satisfy beside the equations of motion: the equation of state, everywhere, and the
 * jump of energy across each shock. The second evaluation sees the impact from the right plate and knows no Hugoniot
 * curve: for a pressure it finds the compression at which equation of state and jump of energy agree, and of the
 * pressures the one with which both plates get the same velocity. */
#include "oracles/plate_impact.h"
#include "oracles/root.h"
#include "oracles/self_check_parts.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { PLACES = 64, TIMES = 12 };
enum { DENSITY, ENERGY, SOUND };     /* the extra scalars */
static const double BOUND = 1e-12;   /* of the second evaluation: roots within roots */
static const double STATION = 0.371; /* of the first plate's thickness: where arrivals are timed */

/* The laws come first: a pointer to them is one to the whole. */
struct impact {
    struct self_check laws;
    const struct plate_impact_given *given;
    const struct plate_impact_eos *eos;
    double p, eta, U; /* by roots: pressure [Pa] and compression behind the shocks, and their speed [m/s] */
};

static const struct impact *whole(const struct self_check *check)
{
    return (const struct impact *)(const void *)check;
}

static void extras_at(const struct self_check *check, double X, double t, double value[ORACLE_EXTRAS])
{
    double place[3] = {X, 0, 0};
    check->kind->extras(check->oracle, place, t, value);
}

static void fluid_stress(const struct self_check *check, const double X[3], double t, const double G[9], double P[9])
{
    const struct impact *of = whole(check);
    double value[ORACLE_EXTRAS];
    extras_at(check, X[0], t, value);
    double p = creal(of->eos->pressure(of->given, -G[0], value[ENERGY]));
    memset(P, 0, 9 * sizeof *P);
    P[0] = -p;
    P[4] = P[8] = -p * (1 + G[0]);
}

static double internal_energy(const struct self_check *check, const double X[3], double t,
                              const struct oracle_state *state)
{
    double value[ORACLE_EXTRAS];
    (void)state;
    extras_at(check, X[0], t, value);
    return check->rho * value[ENERGY];
}

static const struct self_check_material FLUID = {
    .law = "P = equation of state(du/dX, e)", .stress = fluid_stress, .energy = internal_energy};

/* Square of the speed of sound: dp/d(rho) along d(e) = p/rho^2 d(rho), by a complex step, which subtracts nothing. */
static double sound_squared(const struct impact *of, double eta, double e, double p)
{
    double h = 1e-30, rho0 = of->given->rho, volume = 1 - eta; /* over that at rest */
    double complex stepped = of->eos->pressure(of->given, eta + h * I, e + p / rho0 * h * I);
    return cimag(stepped) / h * volume * volume / rho0;
}

static void check_extras(struct self_check *check)
{
    const struct impact *of = whole(check);
    double density = 0, uneven = 0, sound = 0, fastest = 0;
    for (size_t i = 0; i < PLACES; i++) {
        struct self_check_spot spot = self_check_sample(check, i, 0);
        struct oracle_state state;
        double value[ORACLE_EXTRAS], sigma[9];
        check->kind->state(check->oracle, spot.X, spot.t, &state);
        extras_at(check, spot.X[0], spot.t, value);
        oracle_cauchy(check->kind, &state, sigma);
        density = self_check_worse(density, fabs(value[DENSITY] * oracle_jacobian(&state) / check->rho - 1));
        for (int k = 0; k < 3; k++) {
            uneven = self_check_worse(uneven, fabs(sigma[4 * k] - sigma[0]));
        }
        double squared = sound_squared(of, 1 - state.F[0], value[ENERGY], -sigma[0]);
        sound = self_check_worse(sound, fabs(value[SOUND] * value[SOUND] - squared));
        fastest = self_check_worse(fastest, squared);
    }
    self_check_line(check, "density det F = density at rest", density, 16 * DBL_EPSILON);
    self_check_line(check, "Cauchy stress is a pressure", self_check_relative(uneven, check->of.stress),
                    16 * DBL_EPSILON);
    self_check_line(check, "sound speed = equation of state along an isentrope", self_check_relative(sound, fastest),
                    BOUND);
}

/* Pressure, density and internal energy at a place. */
struct side {
    double p, density, e;
};

static struct side side_at(const struct self_check *check, double X, double t)
{
    struct oracle_state state;
    double place[3] = {X, 0, 0}, value[ORACLE_EXTRAS];
    check->kind->state(check->oracle, place, t, &state);
    extras_at(check, X, t, value);
    return (struct side){.p = -state.P[0], .density = value[DENSITY], .e = value[ENERGY]};
}

/* [e] = (p + p')/2 [1/rho] from side to side of each front; what is on its sides is constant. */
static void check_jump_of_energy(struct self_check *check)
{
    double worst = 0, size = 0;
    for (size_t i = 0; i < TIMES; i++) {
        struct oracle_front front[ORACLE_FRONTS];
        double t = self_check_time(check, i), near = 1e-6 * check->upper[0];
        size_t count = check->kind->fronts(check->oracle, t, front);
        for (size_t n = 0; count != ORACLE_TOO_MANY_FRONTS && n < count; n++) {
            struct side left = side_at(check, front[n].X - near, t), right = side_at(check, front[n].X + near, t);
            double jump = right.e - left.e, mean = (right.p + left.p) / 2;
            worst = self_check_worse(worst,
                                     fabs(jump - mean * (right.density - left.density) / left.density / right.density));
            size = self_check_worse(size, fabs(jump));
        }
    }
    /* The density hides a small compression behind its own size. */
    double bound = 64 * DBL_EPSILON / fmin(1, whole(check)->eta);
    self_check_line(check, "fronts: [e] = mean p [1/rho]", self_check_relative(worst, size), bound);
}

static void check_contact(struct self_check *check)
{
    const struct impact *of = whole(check);
    double L = of->given->L, v0 = of->given->v0, moved = 0;
    for (size_t i = 0; i < TIMES; i++) {
        struct oracle_state state;
        const double X[3] = {L, 0, 0};
        double t = self_check_time(check, i);
        check->kind->state(check->oracle, X, t, &state);
        moved = self_check_worse(moved, fabs(state.v[0]) / v0);
        moved = self_check_worse(moved, fabs(state.u[0]) / (v0 * t));
    }
    self_check_line(check, "plane of contact at rest", moved, 16 * DBL_EPSILON);
    self_check_arrival(check, "arrival of the left shock", STATION * L, v0 / 2, (1 - STATION) * L / of->U);
    self_check_arrival(check, "arrival of the right shock", (2 - STATION) * L, -v0 / 2, (1 - STATION) * L / of->U);
    self_check_reach(check, "says nothing once the back faces are reached", L / of->U, BOUND);
}

/* Where equation of state and jump of energy differ, for a pressure. */
static double disagreement(double eta, void *with)
{
    const struct impact *of = with;
    return creal(of->eos->pressure(of->given, eta, of->p * eta / (2 * of->given->rho))) - of->p;
}

/* What the shock of a pressure adds to the velocity; beyond the compressions there are, that of the largest. */
static double velocity_gained(struct impact *of, double p)
{
    double most = (1 - 1e-9) * of->eos->limit(of->given);
    of->p = p;
    of->eta = most;
    if (p == 0) {
        return 0;
    }
    if (disagreement(most, of) > 0 && !root_between(disagreement, of, 0, most, &of->eta)) {
        return NAN;
    }
    return sqrt(p * of->eta / of->given->rho);
}

/* The right plate, at rest, is pushed to the right; the left one comes with 2 v0 and is braked. */
static double mismatch(double p, void *with)
{
    struct impact *of = with;
    double right = velocity_gained(of, p), left = 2 * of->given->v0 - velocity_gained(of, p);
    return (right - left) / of->given->v0;
}

static void solve_impact(struct impact *of)
{
    double v0 = of->given->v0, upper = of->given->rho * v0 * v0, p;
    while (upper < DBL_MAX / 4 && mismatch(upper, of) < 0) {
        upper *= 2;
    }
    bool found = root_between(mismatch, of, 0, upper, &p);
    double gained = velocity_gained(of, found ? p : NAN);
    of->U = of->p / (of->given->rho * gained);
}

/* Moves with the right plate at first: -v0. */
static void by_roots(const struct self_check *check, const double X[3], double t, struct oracle_state *state)
{
    const struct impact *of = whole(check);
    const struct plate_impact_given *g = of->given;
    double way = X[0] - g->L, v_right = of->p / (g->rho * of->U), hit = fabs(way) / of->U;
    bool behind = t > hit;
    double before = way < 0 ? 2 * g->v0 : 0, v = behind ? v_right : before;
    memset(state, 0, sizeof *state);
    state->u[0] = before * fmin(t, hit) + v_right * fmax(0, t - hit) - g->v0 * t;
    state->v[0] = v - g->v0;
    state->p[0] = g->rho * state->v[0];
    state->F[0] = 1 - (behind ? of->eta : 0);
    state->F[4] = state->F[8] = 1;
    state->P[0] = behind ? -of->p : 0;
    state->P[4] = state->P[8] = state->P[0] * state->F[0];
}

static void free_flight(const struct oracle *oracle, const double X[3], double u[3], double v[3])
{
    const struct plate_impact_given *g = plate_impact_given(oracle);
    memset(u, 0, 3 * sizeof *u);
    memset(v, 0, 3 * sizeof *v);
    v[0] = X[0] < g->L ? g->v0 : -g->v0;
}

size_t plate_impact_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                          size_t size)
{
    const struct plate_impact_given *g = plate_impact_given(oracle);
    struct impact of = {.given = g, .eos = kind->about};
    solve_impact(&of);
    /* The fastest wave, in X: sound behind the shocks, by which errors of the compression turn into those of p. */
    double squared = sound_squared(&of, of.eta, of.p * of.eta / (2 * g->rho), of.p), a = sqrt(squared) / (1 - of.eta);
    of.laws = (struct self_check){.kind = kind,
                                  .oracle = oracle,
                                  .upper = {2 * g->L},
                                  .bulk = g->rho * a * a,
                                  .rho = g->rho,
                                  .material = &FLUID,
                                  .wave_number = 1 / g->L,
                                  .frequency = a / g->L,
                                  .t_first = 0.0371 * g->L / of.U,
                                  .t_end = 0.99871 * g->L / of.U,
                                  .line = line,
                                  .size = size};
    self_check_differentials(&of.laws);
    self_check_starts(&of.laws, free_flight);
    self_check_fronts(&of.laws);
    check_jump_of_energy(&of.laws);
    check_extras(&of.laws);
    check_contact(&of.laws);
    self_check_energies(&of.laws);
    self_check_compare(&of.laws, by_roots, BOUND);
    return of.laws.count;
}
