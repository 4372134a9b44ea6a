/* The cantilever (plate.h) by thin-plate theory in plane strain, which is the curve that 001_363f711843f01da4.txt,
 * section 4.1, measures its errors against. An exact solution of the theory's equation,
 *
 *     rho H d2w/dt2 + E' H^3/12 d4w/dX4 = 0,   E' = E / (1 - nu^2),
 *
 * with w = w' = 0 at X = 0 and w'' = w''' = 0 at X = L; not one of the body's, whose own is the kind `cantilever`. The
 * plate starts straight with w = f(X)/f(L) times v_tip for its velocity: w = (v_tip / omega) f(X)/f(L) sin(omega t).
 *
 * Cross sections stay plane and normal: u = (-Y w', w). Their rotation is taken to cost no inertia, and shear to bend
 * nothing. Stress is P_xx = -E' Y w'' and P_zz = nu P_xx; P_xy = -E'/2 (H^2/4 - Y^2) w''', which no strain goes with,
 * is what balances them, and carries the shear force. Momentum is rho v in every direction, but the kinetic energy is
 * that of the deflection alone. */
#include "oracles/thin_plate.h"
#include "oracles/kind.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

static void state(const struct oracle *o, const double X[3], double t, struct oracle_state *at)
{
    const struct plate *g = &o->given;
    double omega = o->mode.frequency, a = g->tip_velocity / omega * sin(omega * t);
    double rate = g->tip_velocity * cos(omega * t), half = g->height / 2, Y = X[1];
    double deflection = oracle_beam_deflection(&o->mode, X[0]), slope = oracle_beam_rotation(&o->mode, X[0]);
    double bending = -Y * oracle_beam_curvature(&o->mode, X[0]) * a;
    double shear = -(half - Y) * (half + Y) / 2 * oracle_beam_curvature_slope(&o->mode, X[0]) * a;
    *at = (struct oracle_state){.u = {-Y * slope * a, deflection * a, 0},
                                .v = {-Y * slope * rate, deflection * rate, 0},
                                .F = {1 + bending, -slope * a, 0, slope * a, 1, 0, 0, 0, 1}};
    at->p[0] = g->rho * at->v[0];
    at->p[1] = g->rho * at->v[1];
    at->P[0] = o->modulus * bending;
    at->P[1] = at->P[3] = o->modulus * shear;
    at->P[8] = g->nu * at->P[0];
}

static double outside(const struct oracle *o, const double X[3])
{
    return plate_outside(&o->given, X);
}

/* Per metre of width. The square of any mode, 1 at the free end, has the mean 1/4. */
static void energy(const struct oracle *o, double t, double *kinetic, double *strain)
{
    const struct plate *g = &o->given;
    double total = g->rho * g->height * g->length / 8 * g->tip_velocity * g->tip_velocity;
    double c = cos(o->mode.frequency * t), s = sin(o->mode.frequency * t);
    *kinetic = total * c * c;
    *strain = total * s * s;
}

static bool fits(const struct oracle *o)
{
    const struct plate *g = &o->given;
    double kinetic, strain, omega = o->mode.frequency, v = g->tip_velocity, u = v / omega;
    double strained = u * g->height / (g->length * g->length);
    energy(o, 0, &kinetic, &strain);
    const double always[] = {o->modulus, omega, g->height * g->height, g->height / (g->length * g->length)};
    const double moving[] = {v,
                             u,
                             strained,
                             g->rho * v,
                             g->rho * v * omega,
                             o->modulus * strained,
                             o->modulus * strained * (g->height / g->length),
                             g->nu == 0 ? v : g->nu * o->modulus * strained,
                             kinetic};
    return oracle_representable(always, sizeof always / sizeof *always, false) &&
           oracle_representable(moving, sizeof moving / sizeof *moving, v == 0);
}

static bool create(const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    struct oracle o;
    if (!plate_read(value, &o.given, why)) {
        return false;
    }
    const struct oracle_beam beam = plate_beam(&o.given, false);
    if (!oracle_beam_thin_plate(&beam, o.given.mode, &o.mode, why)) {
        return false;
    }
    o.modulus = o.given.E / ((1 - o.given.nu) * (1 + o.given.nu));
    return fits(&o) ? oracle_keep(&o, sizeof o, oracle, why) : oracle_out_of_range(plate_parameters, value, why);
}

/* What the theory leaves out: an error of modelling, which no refinement removes. */
static size_t figures(const struct oracle *o, struct oracle_figure figure[ORACLE_FIGURES])
{
    const struct oracle_beam beam = plate_beam(&o->given, false);
    struct oracle_beam_mode thick;
    struct ritz_limit body;
    char why[ORACLE_WHY];
    size_t count = 0;
    figure[count++] = (struct oracle_figure){"period", "s", "by thin-plate theory", o->mode.period};
    if (oracle_beam_timoshenko(&beam, o->given.mode, &thick, why)) {
        figure[count++] =
            (struct oracle_figure){"Timoshenko period", "s", "with shear and rotary inertia", thick.period};
    }
    if (plate_solve(&o->given, false, &body, why)) {
        double period = 2 * PI / (plate_frequency(&o->given) * body.frequency), ratio = o->mode.period / period;
        figure[count++] =
            (struct oracle_figure){"body period", "s", "of the plane-strain body, see cantilever", period};
        figure[count++] =
            (struct oracle_figure){"error of thin-plate theory", "-", "of the period, relative", ratio - 1};
        figure[count++] =
            (struct oracle_figure){"phase ahead of the body", "rad/s", "by which the two curves drift apart",
                                   (1 / ratio - 1) * 2 * PI / period};
        ritz_free(&body.mode);
    }
    return count;
}

const struct oracle_kind oracle_thin_plate = {
    .name = "thin-plate",
    .summary = "a bending mode of a clamped plate by thin-plate theory: a theory, not the body's own solution",
    .source = "001_363f711843f01da4.txt, section 4.1: the curve it calls analytical",
    .dim = 2,
    .smoothness = ORACLE_SMOOTH,
    .parameter = plate_parameters,
    .create = create,
    .destroy = oracle_release,
    .state = state,
    .outside = outside,
    .energy = energy,
    .figures = figures,
    .check = thin_plate_check,
};
