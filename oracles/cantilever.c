/* The freely vibrating cantilever of 001_363f711843f01da4.txt, section 4.1, as the plane-strain body it is: 0 <= X <=
 * L, -H/2 <= Y <= H/2, clamped (u = 0) at X = 0, without traction elsewhere, one bending mode U(X) with U_y(L, 0) = 1:
 *
 *     u = (v_tip / omega) U sin(omega t),   v = v_tip U cos(omega t),   P = lambda tr(e) I + 2 mu e.
 *
 * Mode and frequency are computed by the method of Ritz (ritz.h): omega to the digits that "uncertainty" says, U to
 * about seven of its largest value, fewer of its derivatives within half a height of the clamp, where the stress is
 * singular at (0, +-H/2). Energies are those of the mode: 1/2 m v_tip^2 shared out by cos^2 and sin^2. Amplitudes may
 * have any size, but the theory is that of small strains and rotations. */
#include "oracles/cantilever.h"
#include "oracles/beam.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;

enum { HIGHEST_MODE = 4 };
static const double SHORTEST = 4, LONGEST = 50; /* length / height */
static const double WANTED = 1e-7;              /* seven digits */

static const struct oracle_parameter parameters[] = {
    {"L", "m", "length, 4 to 50 heights", 0, INFINITY, true, false, 0.2},
    {"H", "m", "height", 0, INFINITY, true, false, 0.02},
    {"mode", "-", "number of the bending mode, a whole number", 1, HIGHEST_MODE, false, false, 1},
    {"v_tip", "m/s", "velocity of the free end at t = 0; the source has 0.01 sqrt(K/rho)", -INFINITY, INFINITY, false,
     false, 0.57008771254957},
    {"material.E", "Pa", "Young's modulus", 0, INFINITY, true, false, 1998447.2049689441},
    {"material.nu", "-", "Poisson's ratio", -0.9, 0.49, false, false, 0.39751552795031056},
    {"material.rho", "kg/m^3", "density", 0, INFINITY, true, false, 1000},
    {0},
};

/* A point outside is taken for the nearest one of the body. */
static void state(const struct oracle *o, const double X[3], double t, struct oracle_state *at)
{
    const struct cantilever_given *g = &o->given;
    double half = g->height / 2, u[2], G[4];
    double x = fmin(fmax(X[0] / half, 0), o->solution.mode.x.node[o->solution.mode.x.elements]);
    double y = fmin(fmax(X[1] / half, -1), 1);
    ritz_evaluate(&o->solution.mode, x, y, u, G);
    double amplitude = g->tip_velocity / o->frequency * sin(o->frequency * t);
    double rate = g->tip_velocity * cos(o->frequency * t);
    *at = (struct oracle_state){.F = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    for (int i = 0; i < 2; i++) {
        at->u[i] = amplitude * u[i];
        at->v[i] = rate * u[i];
        at->p[i] = g->rho * at->v[i];
        for (int j = 0; j < 2; j++) {
            G[2 * i + j] *= amplitude / half;
            at->F[3 * i + j] += G[2 * i + j];
        }
    }
    double pressure = o->lambda * (G[0] + G[3]);
    at->P[0] = pressure + 2 * o->mu * G[0];
    at->P[4] = pressure + 2 * o->mu * G[3];
    at->P[1] = at->P[3] = o->mu * (G[1] + G[2]);
    at->P[8] = pressure;
}

/* Per metre of width. */
static void energy(const struct oracle *o, double t, double *kinetic, double *strain)
{
    const struct cantilever_given *g = &o->given;
    double area = g->height / 2 * g->height / 2, c = cos(o->frequency * t), s = sin(o->frequency * t);
    double total = g->rho * area * o->solution.mode.mass / 2 * g->tip_velocity * g->tip_velocity;
    *kinetic = total * c * c;
    *strain = total * s * s;
}

static bool representable(double x)
{
    return fabs(x) >= DBL_MIN / DBL_EPSILON && fabs(x) <= DBL_MAX * DBL_EPSILON;
}

/* A state or an energy that overflows, or loses digits to underflow, would be a wrong answer without a warning. */
static bool fits(const struct oracle *o, char why[ORACLE_WHY])
{
    const struct cantilever_given *g = &o->given;
    double kinetic, strain, v = g->tip_velocity, u = v / o->frequency;
    energy(o, 0, &kinetic, &strain);
    double size[] = {o->mu,
                     fabs(o->lambda) + 2 * o->mu,
                     o->frequency,
                     g->height * g->height,
                     v,
                     u,
                     u / g->length,
                     g->rho * v,
                     g->rho * v * o->frequency,
                     o->mu * (u / g->length),
                     kinetic};
    for (size_t i = 0; i < sizeof size / sizeof *size; i++) {
        if (!representable(size[i]) && !(v == 0 && i >= 4 && size[i] == 0)) {
            (void)snprintf(
                why, ORACLE_WHY,
                "L = %g m, H = %g m, v_tip = %g m/s, material.E = %g Pa, material.rho = %g kg/m^3 give moduli, "
                "a frequency, fields or energies outside the range of double precision; choose values nearer "
                "to 1",
                g->length, g->height, v, g->E, g->rho);
            return false;
        }
    }
    return true;
}

static bool admissible(const double *value, char why[ORACLE_WHY])
{
    double slenderness = value[0] / value[1];
    if (!(slenderness >= SHORTEST && slenderness <= LONGEST)) {
        (void)snprintf(why, ORACLE_WHY,
                       "L = %.15g m is %g times H = %.15g m, but it must be %g to %g times; L = %g would do", value[0],
                       slenderness, value[1], SHORTEST, LONGEST, 10 * value[1]);
        return false;
    }
    if (value[2] != floor(value[2])) {
        (void)snprintf(why, ORACLE_WHY, "mode = %.15g, but it must be a whole number, 1 to %d; mode = 1 would do",
                       value[2], HIGHEST_MODE);
        return false;
    }
    return true;
}

/* Frequency and fields from the first mesh; from the second, which has other gradings and degrees and, but for the
 * middle and a square at each end, other lines, fields to compare with. */
static bool solve(struct oracle *o, char why[ORACLE_WHY])
{
    static const struct ritz_mesh first = {
        .layers = 4, .tip_layers = 2, .grading = 0.12, .growth = 2, .corner = 6, .middle = 13};
    static const struct ritz_mesh second = {
        .layers = 4, .tip_layers = 1, .grading = 0.1, .growth = 1.7, .corner = 6, .middle = 12};
    const struct cantilever_given *g = &o->given;
    struct ritz_problem problem = {
        .length = 2 * (g->length / g->height), .lambda = 2 * g->nu / (1 - 2 * g->nu), .mode = g->mode};
    if (!ritz_converge(&problem, &first, &o->solution, why) || !ritz_solve(&problem, &second, &o->second, why)) {
        return false;
    }
    if (!(o->solution.uncertainty <= WANTED)) {
        (void)snprintf(why, ORACLE_WHY,
                       "L = %g m, H = %g m, material.nu = %.15g, mode = %d: only %.1f digits of the frequency are "
                       "certain, but %g are wanted; choose a shorter beam or a smaller material.nu",
                       g->length, g->height, g->nu, g->mode, -log10(o->solution.uncertainty), -log10(WANTED));
        return false;
    }
    double unit = sqrt(o->mu / g->rho) / (g->height / 2);
    o->frequency = unit * o->solution.frequency;
    o->second_frequency = unit * o->second.frequency;
    return fits(o, why);
}

static void destroy(struct oracle *oracle)
{
    ritz_free(&oracle->solution.mode);
    ritz_free(&oracle->second);
    free(oracle);
}

static bool create(const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    if (!admissible(value, why)) {
        return false;
    }
    struct oracle *o = calloc(1, sizeof *o);
    if (o == NULL) {
        (void)snprintf(why, ORACLE_WHY, "no memory for %zu bytes", sizeof *o);
        return false;
    }
    o->given = (struct cantilever_given){.length = value[0],
                                         .height = value[1],
                                         .mode = (int)value[2],
                                         .tip_velocity = value[3],
                                         .E = value[4],
                                         .nu = value[5],
                                         .rho = value[6]};
    const struct cantilever_given *g = &o->given;
    o->mu = g->E / (2 * (1 + g->nu));
    o->lambda = g->E * g->nu / ((1 + g->nu) * (1 - 2 * g->nu));
    if (!solve(o, why)) {
        destroy(o);
        return false;
    }
    *oracle = o;
    return true;
}

/* How far the theories of beams are from the body: an error of modelling, which no refinement removes. */
static size_t figures(const struct oracle *o, struct oracle_figure figure[ORACLE_FIGURES])
{
    const struct cantilever_given *g = &o->given;
    const struct oracle_beam beam = {.length = g->length, .height = g->height, .E = g->E, .nu = g->nu, .rho = g->rho};
    struct oracle_beam_mode mode;
    char why[ORACLE_WHY];
    double period = 2 * PI / o->frequency;
    size_t count = 0;
    figure[count++] = (struct oracle_figure){"period", "s", "of the plane-strain body", period};
    figure[count++] = (struct oracle_figure){"uncertainty of the period", "-", "relative", o->solution.uncertainty};
    if (oracle_beam_thin_plate(&beam, g->mode, &mode, why)) {
        figure[count++] =
            (struct oracle_figure){"thin-plate period", "s", "without shear and rotary inertia", mode.period};
        figure[count++] = (struct oracle_figure){"error of thin-plate theory", "-", "of the period, relative",
                                                 mode.period / period - 1};
    }
    if (oracle_beam_timoshenko(&beam, g->mode, &mode, why)) {
        figure[count++] =
            (struct oracle_figure){"Timoshenko period", "s", "with shear factor 5 / (6 - nu)", mode.period};
        figure[count++] = (struct oracle_figure){"error of Timoshenko theory", "-", "of the period, relative",
                                                 mode.period / period - 1};
    }
    return count;
}

const struct oracle_kind oracle_cantilever = {
    .name = "cantilever",
    .summary = "a bending mode of a clamped plate, as a body in plane strain",
    .source = "001_363f711843f01da4.txt, section 4.1, for the plane-strain body in place of the thin plate",
    .dim = 2,
    .smoothness = ORACLE_SMOOTH,
    .parameter = parameters,
    .create = create,
    .destroy = destroy,
    .state = state,
    .energy = energy,
    .figures = figures,
    .check = cantilever_check,
};
