/* Both theories are one here: with b^2 = rho A L^4 omega^2 / (E' I), r^2 = I / (A L^2), s^2 = E' I / (kappa G A L^2),
 *
 *     (w'' - psi') / s^2 + b^2 w = 0,   psi'' + (w' - psi) / s^2 + b^2 r^2 psi = 0      along xi = x / L,
 *
 * and r = s = 0 is the thin plate. Solutions cosh(a xi), sinh(a xi), cos(c xi), sin(c xi) with a^2 c^2 =
 * b^2 (1 - b^2 r^2 s^2), c^2 - a^2 = b^2 (r^2 + s^2); the rotation psi has the factors ga = a + b^2 s^2 / a and
 * gc = c - b^2 s^2 / c. Clamp and free end leave, after division by ga cosh a,
 *
 *     2 / cosh a + cos c (q + 1 / q) - (c / a - a / c) tanh a sin c = 0,   q = c gc / (a ga) > 0,
 *
 * in which nothing overflows or cancels. At c = m pi the middle term decides the sign, (-1)^m, so mode n lies between
 * c = (n - 1) pi and n pi. */
#include "oracles/beam.h"
#include "oracles/root.h"

#include <math.h>
#include <stdio.h>

static const double PI = 3.14159265358979323846;

struct theory {
    double r2, s2; /* r^2, s^2 */
};

/* All that c determines. */
struct waves {
    double a, c, ga, gc;
    double b2;      /* b^2 */
    bool evanesces; /* below the cut-off, b^2 r^2 s^2 < 1 */
};

/* b^2 is the smaller root of r^2 s^2 b^4 - (1 + c^2 (r^2 + s^2)) b^2 + c^4 = 0. */
static struct waves waves(const struct theory *theory, double c)
{
    double middle = 1 + c * c * (theory->r2 + theory->s2), rs = theory->r2 * theory->s2, c4 = c * c * c * c;
    struct waves w = {.c = c, .b2 = 2 * c4 / (middle + sqrt(middle * middle - 4 * rs * c4))};
    w.evanesces = w.b2 * rs < 1;
    w.a = w.evanesces ? sqrt(w.b2 * (1 - w.b2 * rs)) / c : 0;
    w.ga = w.evanesces ? w.a + w.b2 * theory->s2 / w.a : 0;
    w.gc = c - w.b2 * theory->s2 / c;
    return w;
}

static double characteristic(double c, void *context)
{
    const struct waves w = waves(context, c);
    double q = w.c * w.gc / (w.a * w.ga);
    double fall = exp(-w.a); /* 2 / cosh(a), which overflows for slender beams */
    return 4 * fall / (1 + fall * fall) + cos(c) * (q + 1 / q) - (c / w.a - w.a / c) * tanh(w.a) * sin(c);
}

/* The shape with clamp and free shear force: C = -A, D = -(ga / gc) B, and B / A = -R, where 1 - R = G exp(-a) is
 * found without subtracting R from 1. */
static void shape(const struct waves *w, struct oracle_beam_mode *mode)
{
    double fall = exp(-w->a), sech = 2 * fall / (1 + fall * fall), p = w->a * w->ga / (w->c * w->gc);
    double below = 1 + p * cos(w->c) * sech;
    double ratio = (tanh(w->a) - w->a / w->c * sin(w->c) * sech) / below;
    double G = 2 * (fall + p * cos(w->c) + w->a / w->c * sin(w->c)) / ((1 + fall * fall) * below);
    *mode = (struct oracle_beam_mode){.growth = w->a,
                                      .wave = w->c,
                                      .grow = G / 2,
                                      .decay = (1 + ratio) / 2,
                                      .cosine = -1,
                                      .sine = w->ga / w->gc * ratio,
                                      .growth_slope = w->ga,
                                      .wave_slope = w->gc,
                                      .length = 1};
    double tip = oracle_beam_deflection(mode, 1);
    mode->grow /= tip;
    mode->decay /= tip;
    mode->cosine /= tip;
    mode->sine /= tip;
}

static bool positive(double value)
{
    return isfinite(value) && value > 0;
}

static bool is_beam(const struct oracle_beam *beam, int mode, char why[ORACLE_WHY])
{
    bool is = positive(beam->length) && positive(beam->height) && positive(beam->E) && positive(beam->rho) &&
              beam->nu > -1 && beam->nu < 0.5 && mode >= 1;
    if (!is) {
        (void)snprintf(why, ORACLE_WHY,
                       "a beam of length %g m, height %g m, E = %g Pa, nu = %g, rho = %g kg/m^3 in mode %d: all but nu "
                       "must be > 0, and -1 < nu < 0.5",
                       beam->length, beam->height, beam->E, beam->nu, beam->rho, mode);
    }
    return is;
}

static double modulus(const struct oracle_beam *beam)
{
    return beam->plane_stress ? beam->E : beam->E / ((1 - beam->nu) * (1 + beam->nu));
}

static bool solve(const struct oracle_beam *beam, const struct theory *theory, int mode,
                  struct oracle_beam_mode *result, char why[ORACLE_WHY])
{
    double lower = mode == 1 ? 0.5 : (mode - 1) * PI, upper = mode * PI, c;
    if (!waves(theory, upper).evanesces) {
        (void)snprintf(why, ORACLE_WHY,
                       "mode %d of a beam of length %g m and height %g m is not below the cut-off frequency of "
                       "Timoshenko's theory; ask for a lower mode or a longer beam",
                       mode, beam->length, beam->height);
        return false;
    }
    struct theory copy = *theory;
    if (!root_between(characteristic, &copy, lower, upper, &c)) {
        (void)snprintf(why, ORACLE_WHY, "mode %d: no root of the characteristic equation between %g and %g", mode,
                       lower, upper);
        return false;
    }
    struct waves w = waves(theory, c);
    shape(&w, result);
    result->length = beam->length;
    result->frequency = sqrt(w.b2 * modulus(beam) / (12 * beam->rho)) * beam->height / (beam->length * beam->length);
    result->period = 2 * PI / result->frequency;
    return true;
}

bool oracle_beam_thin_plate(const struct oracle_beam *beam, int mode, struct oracle_beam_mode *result,
                            char why[ORACLE_WHY])
{
    struct theory none = {0};
    return is_beam(beam, mode, why) && solve(beam, &none, mode, result, why);
}

bool oracle_beam_timoshenko(const struct oracle_beam *beam, int mode, struct oracle_beam_mode *result,
                            char why[ORACLE_WHY])
{
    if (!is_beam(beam, mode, why)) {
        return false;
    }
    double slenderness = beam->height / beam->length, nu = beam->nu;
    double factor = beam->plane_stress ? 5 * (1 + nu) / (6 + 5 * nu) : 5 / (6 - nu);
    double G = beam->E / (2 * (1 + nu));
    struct theory theory = {.r2 = slenderness * slenderness / 12};
    theory.s2 = theory.r2 * modulus(beam) / (factor * G);
    return solve(beam, &theory, mode, result, why);
}

double oracle_beam_deflection(const struct oracle_beam_mode *mode, double x)
{
    double xi = x / mode->length, phase = mode->wave * xi;
    return mode->grow * exp(mode->growth * (xi - 1)) + mode->decay * exp(-mode->growth * xi) +
           mode->cosine * cos(phase) + mode->sine * sin(phase);
}

/* Derivative of the rotation, `order` times along x. */
static double rotation(const struct oracle_beam_mode *mode, double x, int order)
{
    double xi = x / mode->length, phase = mode->wave * xi;
    double rising = mode->grow * exp(mode->growth * (xi - 1)), falling = mode->decay * exp(-mode->growth * xi);
    double s = sin(phase), c = cos(phase), waving = mode->sine * c - mode->cosine * s;
    double even = order % 2 == 0 ? rising - falling : rising + falling;
    double odd = order == 0 ? waving : order == 1 ? -mode->sine * s - mode->cosine * c : -waving;
    return (mode->growth_slope * pow(mode->growth / mode->length, order) * even +
            mode->wave_slope * pow(mode->wave / mode->length, order) * odd) /
           mode->length;
}

double oracle_beam_rotation(const struct oracle_beam_mode *mode, double x)
{
    return rotation(mode, x, 0);
}

double oracle_beam_curvature(const struct oracle_beam_mode *mode, double x)
{
    return rotation(mode, x, 1);
}

double oracle_beam_curvature_slope(const struct oracle_beam_mode *mode, double x)
{
    return rotation(mode, x, 2);
}
