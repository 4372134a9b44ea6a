/* Free radial vibration of a solid elastic ball, and of a long solid cylinder in plane strain: small strains, a surface
 * without traction. In d dimensions (3: ball, 2: cross-section of the cylinder) the displacement is the gradient of
 * -w0(k r) s / k^2 cos(omega t), a pure p-wave:
 *
 *     u = s w1(k r) X cos(omega t),   du_i/dX_j = s (w1 delta_ij - w2 k^2 X_i X_j) cos(omega t),
 *     div u = s w0 cos(omega t)
 *
 * with omega = k cp and wm(x) = j_m(x) / x^m for the ball, J_m(x) / x^m for the cylinder (up to a factor the function
 * 0F1(d/2 + m; -x^2/4), smooth at the centre), which satisfy w1 = -w0' / x, w2 = -w1' / x, x^2 w2 = d w1 - w0. The
 * stress is the bulk modulus times div u and 2 mu times the deviator s w2 k^2 (r^2/d delta_ij - X_i X_j): nothing
 * cancels, whatever Poisson's ratio. The surface is free if x = k R solves
 *
 *     x^2 w2(x) = e w1(x),   e = (1 + nu) / (1 - nu) for the ball, 1 / (1 - nu) for the cylinder,
 *
 * which for the ball is tan(x) / x = 1 / (1 - (x cp / (2 cs))^2): H. Lamb, Proc. London Math. Soc. 13 (1882) 189; for
 * the cylinder A. E. H. Love, A Treatise on the Mathematical Theory of Elasticity, on radial vibrations.
 *
 * With z_n the zeros of x w1, x^2 w2 / w1 is the sum over n of 2 x^2 / (z_n^2 - x^2): it rises from 0 to infinity
 * before z_1, and from minus to plus infinity between any two. So there is one root in each of these intervals. In the
 * first it lies beyond sqrt(e), where the sum is less than e, since the sum of 2 / z_n^2 is 1 / (d + 2) and e < d; and
 * all lie before x = (n + (d - 2) / 4) pi, which is between the zeros of w0 and of w1 and where the function is above
 * d. */
#include "oracles/breathing.h"
#include "oracles/kind.h"
#include "oracles/root.h"

#include <gsl/gsl_sf_bessel.h>
#include <math.h>
#include <stdio.h>

static const double PI = 3.14159265358979323846;
enum { HIGHEST_MODE = 1000, TERMS = 14 };
static const double SERIES_BELOW =
    2; /* of x: shorter than any zero of w0; from here on GSL's functions do not cancel */

static const struct oracle_parameter parameters[] = {
    {"R", "m", "radius", 0, INFINITY, true, false, 1},
    {"mode", "-", "number of the radial mode, a whole number", 1, HIGHEST_MODE, false, false, 1},
    {"U0", "m", "displacement of the surface at t = 0, outwards", -INFINITY, INFINITY, false, false, 5e-4},
    {"material.E", "Pa", "Young's modulus", 0, INFINITY, true, false, 17e6},
    {"material.nu", "-", "Poisson's ratio; the p-wave is infinitely fast at 0.5", -1, 0.5, true, true, 0.25},
    {"material.rho", "kg/m^3", "density", 0, INFINITY, true, false, 1100},
    {0},
};

/* w0, w1, w2. Near the centre by their series, the terms of which have ratios -(x^2/2) / (n (d + 2 m + 2 n - 2)). */
static void waves(int dim, double x, double w[3])
{
    if (x >= SERIES_BELOW) {
        w[0] = dim == 3 ? gsl_sf_bessel_j0(x) : gsl_sf_bessel_J0(x);
        w[1] = (dim == 3 ? gsl_sf_bessel_j1(x) : gsl_sf_bessel_J1(x)) / x;
        w[2] = (dim * w[1] - w[0]) / x / x;
        return;
    }
    double first = 1;
    for (int m = 0; m < 3; m++) {
        double term = first;
        w[m] = 0;
        for (int n = 1; n <= TERMS; n++) {
            w[m] += term;
            term *= -x * x / (2 * n * (dim + 2 * m + 2 * n - 2));
        }
        first /= dim + 2 * m;
    }
}

struct surface {
    int dim;
    double e; /* see above */
};

/* Has the sign of e less x^2 w2 / w1, times that of w1. */
static double traction(double x, void *context)
{
    const struct surface *surface = context;
    double w[3];
    waves(surface->dim, x, w);
    return surface->e * w[1] - x * x * w[2];
}

static bool find_root(struct surface *surface, int mode, double *root)
{
    double shift = (surface->dim - 2) / 4.0, upper = (mode + shift) * PI;
    double lower = mode == 1 ? sqrt(surface->e) : (mode - 1 + shift) * PI;
    return root_between(traction, surface, lower, upper, root);
}

/* The formulas hold beyond the surface as well. */
static void state(const struct oracle *o, const double X[3], double t, struct oracle_state *at)
{
    int dim = o->given.body.dim;
    double w[3], kX[3] = {0}, square = 0;
    double swing = o->strain * cos(o->frequency * t), rate = -o->strain * o->frequency * sin(o->frequency * t);
    waves(dim, o->k * shell_radius(&o->given.body, X), w);
    *at = (struct oracle_state){.F = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    for (int i = 0; i < dim; i++) {
        kX[i] = o->k * X[i];
        square += kX[i] * kX[i];
        at->u[i] = swing * w[1] * X[i];
        at->v[i] = rate * w[1] * X[i];
        at->p[i] = o->given.rho * at->v[i];
    }
    for (int i = 0; i < dim; i++) {
        for (int j = 0; j < dim; j++) {
            double same = i == j ? 1 : 0, pair = w[2] * kX[i] * kX[j];
            at->F[3 * i + j] += swing * (same * w[1] - pair);
            at->P[3 * i + j] = swing * (same * o->bulk * w[0] + 2 * o->mu * (same * w[2] * square / dim - pair));
        }
    }
    if (dim == 2) {
        at->P[8] = swing * o->lambda * w[0];
    }
}

/* rho omega^2 / 2 times the integral of u^2, shared out by the square of the sine and the cosine. With f = x w1 that of
 * f^2 r^(d - 1) is R^d / 2 (f^2 - w0 x^2 w2), here with what the root says of w0 and w2. Per metre of the cylinder. */
static void energy(const struct oracle *o, double t, double *kinetic, double *strain)
{
    const struct breathing *g = &o->given;
    double nu = g->nu, x = o->root, R = g->body.outer;
    bool ball = g->body.dim == 3;
    double bent = ball ? 2 * (1 - 2 * nu) * (1 + nu) / ((1 - nu) * (1 - nu)) : (1 - 2 * nu) / ((1 - nu) * (1 - nu));
    double half = ball ? 2 * PI * R * R * R : PI * R * R; /* of the surface times R */
    double v = g->amplitude * o->frequency, total = g->rho / 2 * half * (1 - bent / x / x) * v * v;
    double c = cos(o->frequency * t), s = sin(o->frequency * t);
    *kinetic = total * s * s;
    *strain = total * c * c;
}

static bool fits(const struct oracle *o)
{
    const struct breathing *g = &o->given;
    double kinetic, strain, U = g->amplitude, omega = o->frequency, R = g->body.outer;
    energy(o, 0, &kinetic, &strain);
    const double always[] = {o->mu, o->bulk, o->bulk + o->mu, o->k, omega, omega * omega, R * R * R};
    const double moving[] = {U,
                             o->strain,
                             U * omega,
                             g->rho * U * omega,
                             g->rho * U * omega * omega,
                             o->bulk * o->strain,
                             o->mu * o->strain,
                             strain};
    return oracle_representable(always, sizeof always / sizeof *always, false) &&
           oracle_representable(moving, sizeof moving / sizeof *moving, U == 0);
}

static bool create(int dim, const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    double nu = value[4], w[3];
    if (value[1] != floor(value[1])) {
        (void)snprintf(why, ORACLE_WHY, "mode = %.15g, but it must be a whole number, 1 to %d; mode = 1 would do",
                       value[1], HIGHEST_MODE);
        return false;
    }
    struct oracle o = {.given = {.body = {.dim = dim, .outer = value[0]},
                                 .mode = (int)value[1],
                                 .amplitude = value[2],
                                 .E = value[3],
                                 .nu = nu,
                                 .rho = value[5]}};
    const struct breathing *g = &o.given;
    struct surface surface = {.dim = dim, .e = (dim == 3 ? 1 + nu : 1) / (1 - nu)};
    if (!find_root(&surface, g->mode, &o.root)) {
        (void)snprintf(why, ORACLE_WHY, "mode %d: no root of the frequency equation", g->mode);
        return false;
    }
    waves(dim, o.root, w);
    o.mu = g->E / (2 * (1 + nu));
    o.lambda = g->E / (1 + nu) * (nu / (1 - 2 * nu));
    o.bulk = dim == 3 ? g->E / (3 * (1 - 2 * nu)) : o.mu / (1 - 2 * nu);
    o.k = o.root / g->body.outer;
    o.frequency = o.k * sqrt(2 * o.mu * (1 - nu) / (1 - 2 * nu) / g->rho);
    o.strain = g->amplitude / g->body.outer / w[1];
    return fits(&o) ? oracle_keep(&o, sizeof o, oracle, why) : oracle_out_of_range(parameters, value, why);
}

static bool create_sphere(const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    return create(3, value, oracle, why);
}

static bool create_cylinder(const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    return create(2, value, oracle, why);
}

static double outside(const struct oracle *o, const double X[3])
{
    return shell_outside(&o->given.body, X);
}

static size_t figures(const struct oracle *o, struct oracle_figure figure[ORACLE_FIGURES])
{
    figure[0] = (struct oracle_figure){"period", "s", "of the vibration", 2 * PI / o->frequency};
    figure[1] = (struct oracle_figure){"frequency", "rad/s", "of the vibration", o->frequency};
    figure[2] = (struct oracle_figure){"root", "-", "frequency times radius over the speed of p-waves", o->root};
    return 3;
}

#define BREATHING(KIND, NAME, DIM, SUMMARY, SOURCE, CREATE)                                                            \
    const struct oracle_kind KIND = {                                                                                  \
        .name = NAME,                                                                                                  \
        .summary = SUMMARY,                                                                                            \
        .source = SOURCE,                                                                                              \
        .dim = DIM,                                                                                                    \
        .smoothness = ORACLE_SMOOTH,                                                                                   \
        .parameter = parameters,                                                                                       \
        .create = CREATE,                                                                                              \
        .destroy = oracle_release,                                                                                     \
        .state = state,                                                                                                \
        .outside = outside,                                                                                            \
        .energy = energy,                                                                                              \
        .figures = figures,                                                                                            \
        .check = breathing_check,                                                                                      \
    }
BREATHING(oracle_breathing_sphere, "breathing-sphere", 3, "free radial vibration of a solid elastic ball",
          "H. Lamb, Proc. London Math. Soc. 13 (1882) 189: modes without rotation that are alike in all directions",
          create_sphere);
BREATHING(oracle_breathing_cylinder, "breathing-cylinder", 2,
          "free radial vibration of a long solid elastic cylinder, plane strain",
          "A. E. H. Love, A Treatise on the Mathematical Theory of Elasticity, vibrations of a circular cylinder",
          create_cylinder);
