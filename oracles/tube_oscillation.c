/* Free radial oscillation of a thick tube of any amplitude (tube.h), plane strain, incompressible neo-Hookean: J. K.
 * Knowles, Quart. Appl. Math. 18 (1960) 71, and J. Appl. Mech. 29 (1962) 283. Of the motion, one ordinary differential
 * equation, everything else follows in closed form:
 *
 *     F = R/r n n + r/R (I - n n - e e) + e e,   P = s_r r/R n n + s_t R/r (I - n n - e e) + s_z e e
 *
 * with n radial, e along the tube; s_t = s_r + mu (r^2/R^2 - R^2/r^2), s_z = s_r + mu (1 - R^2/r^2), both differences
 * by way of r^2 - R^2, so that nothing cancels in a small oscillation. */
#include "oracles/kind.h"
#include "oracles/tube.h"

#include <math.h>
#include <stdio.h>

static const double PI = 3.14159265358979323846;
static const double THINNEST = 1.01, THICKEST = 20; /* outer radius over inner */

static const struct oracle_parameter parameters[] = {
    {"A", "m", "inner radius in the reference", 0, INFINITY, true, false, 1},
    {"B", "m", "outer radius in the reference, 1.01 to 20 times A", 0, INFINITY, true, false, 2},
    {"stretch", "-", "inner radius at t = 0 over that in the reference", 1.0 / TUBE_STRETCH, TUBE_STRETCH, false, false,
     1},
    {"velocity", "m/s", "of the inner face at t = 0, outwards", -INFINITY, INFINITY, false, false, 20},
    {"mu", "Pa", "shear modulus", 0, INFINITY, true, false, 1e6},
    {"material.rho", "kg/m^3", "density", 0, INFINITY, true, false, 1000},
    {0},
};

/* A point outside is taken for the nearest one of the body. */
static void state(const struct oracle *o, const double X[3], double t, struct oracle_state *at)
{
    const struct tube *g = &o->given;
    double A = g->body.inner, radius = shell_radius(&g->body, X), R = fmin(fmax(radius, A), g->body.outer);
    double n[2] = {radius > 0 ? X[0] / radius : 1, radius > 0 ? X[1] / radius : 0};
    struct tube_instant now = tube_at(&o->motion, t * (o->speed / A));
    double f = (R - A) / A * ((R + A) / A), r = A * sqrt(exp(now.z) + f), q = A * A * now.y;
    double u = q / (r + R), v = now.w * A / r * o->speed;
    double radial = tube_radial_stress(&now, f), axial = radial + q / r / r, hoop = axial + q / R / R;
    *at = (struct oracle_state){.F = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    for (int i = 0; i < 2; i++) {
        at->u[i] = u * n[i];
        at->v[i] = v * n[i];
        at->p[i] = g->rho * at->v[i];
        for (int j = 0; j < 2; j++) {
            double along = n[i] * n[j], around = (i == j ? 1 : -1) * n[1 - i] * n[1 - j];
            at->F[3 * i + j] += u / R * around - u / r * along;
            at->P[3 * i + j] = g->mu * (radial * (r / R) * along + hoop * (R / r) * around);
        }
    }
    at->P[8] = g->mu * axial;
}

/* Per metre of the tube. */
static void energy(const struct oracle *o, double t, double *kinetic, double *strain)
{
    const struct tube *g = &o->given;
    double unit = PI * g->mu * g->body.inner * g->body.inner;
    struct tube_instant now = tube_at(&o->motion, t * (o->speed / g->body.inner));
    tube_energies(o->motion.wall, &now, kinetic, strain);
    *kinetic *= unit;
    *strain *= unit;
}

static bool fits(const struct oracle *o)
{
    const struct tube *g = &o->given;
    double A = g->body.inner, most = fmax(o->motion.highest, -o->motion.lowest);
    double v = sqrt(o->motion.energy) * o->speed, rate = o->speed / A;
    const double always[] = {A, A * A, g->body.outer, g->mu, g->rho, o->speed, rate, g->mu * A * A};
    const double moving[] = {most,
                             A * most,
                             A * A * most,
                             v,
                             g->rho * v,
                             g->rho * v * rate,
                             g->mu * most,
                             g->mu * most / A,
                             g->mu * A * A * o->motion.energy};
    return oracle_representable(always, sizeof always / sizeof *always, false) &&
           oracle_representable(moving, sizeof moving / sizeof *moving, g->velocity == 0 && g->stretch == 1);
}

static bool create(const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    double A = value[0], B = value[1], stretch = value[2], ratio = B / A;
    if (!(ratio >= THINNEST && ratio <= THICKEST)) {
        (void)snprintf(why, ORACLE_WHY,
                       "B = %.15g m is %g times A = %.15g m, but it must be %g to %g times; B = %g would do", B, ratio,
                       A, THINNEST, THICKEST, 2 * A);
        return false;
    }
    struct oracle o = {.given = {.body = {.dim = 2, .inner = A, .outer = B},
                                 .stretch = stretch,
                                 .velocity = value[3],
                                 .mu = value[4],
                                 .rho = value[5]}};
    o.speed = sqrt(value[4] / value[5]);
    const double sizes[] = {A, o.speed};
    double w = stretch * (value[3] / o.speed), z = 2 * log(stretch);
    if (!oracle_representable(sizes, 2, false) || !oracle_representable(&w, 1, value[3] == 0)) {
        return oracle_out_of_range(parameters, value, why);
    }
    if (!tube_move((B - A) / A * ((B + A) / A), z, w, &o.motion, why)) {
        return false;
    }
    bool kept = fits(&o) ? oracle_keep(&o, sizeof o, oracle, why) : oracle_out_of_range(parameters, value, why);
    if (!kept) {
        tube_free(&o.motion);
    }
    return kept;
}

static void destroy(struct oracle *oracle)
{
    if (oracle != NULL) {
        tube_free(&oracle->motion);
    }
    oracle_release(oracle);
}

static double outside(const struct oracle *o, const double X[3])
{
    return shell_outside(&o->given.body, X);
}

static size_t figures(const struct oracle *o, struct oracle_figure figure[ORACLE_FIGURES])
{
    double unit = o->given.body.inner / o->speed;
    figure[0] = (struct oracle_figure){"period", "s", "of the oscillation", o->motion.period * unit};
    figure[1] = (struct oracle_figure){"period of small oscillations", "s", "to which it tends",
                                       2 * PI / sqrt(tube_linear(o->motion.wall)) * unit};
    figure[2] = (struct oracle_figure){"smallest stretch", "-", "inner radius over that in the reference",
                                       exp(o->motion.lowest / 2)};
    figure[3] = (struct oracle_figure){"largest stretch", "-", "inner radius over that in the reference",
                                       exp(o->motion.highest / 2)};
    return 4;
}

const struct oracle_kind oracle_tube_oscillation = {
    .name = "tube-oscillation",
    .summary = "finite radial oscillation of a thick incompressible neo-Hookean tube, plane strain",
    .source = "J. K. Knowles, Quart. Appl. Math. 18 (1960) 71",
    .dim = 2,
    .smoothness = ORACLE_SMOOTH,
    .finite_strain = true,
    .parameter = parameters,
    .create = create,
    .destroy = destroy,
    .state = state,
    .outside = outside,
    .energy = energy,
    .figures = figures,
    .check = tube_check,
};
