/* The freely vibrating cantilever of 001_363f711843f01da4.txt, section 4.1, as the body it is (plate.h), in plane
 * strain or in plane stress: one bending mode U(X) with U_y(L, 0) = 1,
 *
 *     u = (v_tip / omega) U sin(omega t),   v = v_tip U cos(omega t),   P = lambda tr(e) I + 2 mu e in the plane.
 *
 * Plane stress is the same problem with lambda = E nu / (1 - nu^2): P_zz = 0, and e_zz = -nu / (1 - nu) (e_xx + e_yy)
 * is the strain across the plate, whose middle plane this is.
 *
 * Mode and frequency are computed by the method of Ritz (ritz.h): omega to the digits that "uncertainty" says, U to
 * about seven of its largest value, fewer of its derivatives within half a height of the clamp, where the stress is
 * singular at (0, +-H/2). Energies are those of the mode: 1/2 m v_tip^2 shared out by cos^2 and sin^2. Amplitudes may
 * have any size, but the theory is that of small strains and rotations. */
#include "oracles/cantilever.h"
#include "oracles/kind.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;

static const double WANTED = 1e-7; /* seven digits */

/* A point outside is taken for the nearest one of the body. */
static void state(const struct oracle *o, const double X[3], double t, struct oracle_state *at)
{
    const struct plate *g = &o->given;
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
    if (o->plane_stress) {
        at->F[8] -= g->nu / (1 - g->nu) * (G[0] + G[3]);
    } else {
        at->P[8] = pressure;
    }
}

static double outside(const struct oracle *o, const double X[3])
{
    return plate_outside(&o->given, X);
}

/* Per metre of width. */
static void energy(const struct oracle *o, double t, double *kinetic, double *strain)
{
    const struct plate *g = &o->given;
    double area = g->height / 2 * g->height / 2, c = cos(o->frequency * t), s = sin(o->frequency * t);
    double total = g->rho * area * o->solution.mode.mass / 2 * g->tip_velocity * g->tip_velocity;
    *kinetic = total * c * c;
    *strain = total * s * s;
}

static bool fits(const struct oracle *o)
{
    const struct plate *g = &o->given;
    double kinetic, strain, v = g->tip_velocity, u = v / o->frequency;
    energy(o, 0, &kinetic, &strain);
    const double always[] = {o->mu, fabs(o->lambda) + 2 * o->mu, o->frequency, g->height * g->height};
    const double moving[] = {v,      u, u / g->length, g->rho * v, g->rho * v * o->frequency, o->mu * (u / g->length),
                             kinetic};
    return oracle_representable(always, sizeof always / sizeof *always, false) &&
           oracle_representable(moving, sizeof moving / sizeof *moving, v == 0);
}

/* Frequency and fields from the first mesh; from the second, which has other gradings and degrees and, but for the
 * middle and a square at each end, other lines, fields to compare with. */
static bool solve(struct oracle *o, char why[ORACLE_WHY])
{
    static const struct ritz_mesh second = {
        .layers = 4, .tip_layers = 1, .grading = 0.1, .growth = 1.7, .corner = 6, .middle = 12};
    const struct plate *g = &o->given;
    struct ritz_problem problem = plate_problem(g, o->plane_stress);
    if (!plate_solve(g, o->plane_stress, &o->solution, why) || !ritz_solve(&problem, &second, &o->second, why)) {
        return false;
    }
    if (!(o->solution.uncertainty <= WANTED)) {
        (void)snprintf(why, ORACLE_WHY,
                       "L = %g m, H = %g m, material.nu = %.15g, mode = %d: only %.1f digits of the frequency are "
                       "certain, but %g are wanted; choose a shorter beam or a smaller material.nu",
                       g->length, g->height, g->nu, g->mode, -log10(o->solution.uncertainty), -log10(WANTED));
        return false;
    }
    o->frequency = plate_frequency(g) * o->solution.frequency;
    o->second_frequency = plate_frequency(g) * o->second.frequency;
    return true;
}

static void destroy(struct oracle *oracle)
{
    ritz_free(&oracle->solution.mode);
    ritz_free(&oracle->second);
    free(oracle);
}

static bool create(bool plane_stress, const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    struct oracle o = {.plane_stress = plane_stress};
    const struct plate *g = &o.given;
    if (!plate_read(value, &o.given, why)) {
        return false;
    }
    o.mu = g->E / (2 * (1 + g->nu));
    o.lambda = g->E * g->nu / ((1 + g->nu) * (plane_stress ? 1 - g->nu : 1 - 2 * g->nu));
    if (solve(&o, why) && (fits(&o) || oracle_out_of_range(plate_parameters, value, why)) &&
        oracle_keep(&o, sizeof o, oracle, why)) {
        return true;
    }
    ritz_free(&o.solution.mode);
    ritz_free(&o.second);
    return false;
}

static bool create_plane_strain(const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    return create(false, value, oracle, why);
}

static bool create_plane_stress(const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    return create(true, value, oracle, why);
}

/* How far the theories of beams are from the body: an error of modelling, which no refinement removes. */
static size_t figures(const struct oracle *o, struct oracle_figure figure[ORACLE_FIGURES])
{
    const struct plate *g = &o->given;
    const struct oracle_beam beam = plate_beam(g, o->plane_stress);
    struct oracle_beam_mode mode;
    char why[ORACLE_WHY];
    double period = 2 * PI / o->frequency;
    size_t count = 0;
    figure[count++] = (struct oracle_figure){"period", "s", "of the body", period};
    figure[count++] = (struct oracle_figure){"uncertainty of the period", "-", "relative", o->solution.uncertainty};
    if (oracle_beam_thin_plate(&beam, g->mode, &mode, why)) {
        figure[count++] =
            (struct oracle_figure){"thin-plate period", "s", "without shear and rotary inertia", mode.period};
        figure[count++] = (struct oracle_figure){"error of thin-plate theory", "-", "of the period, relative",
                                                 mode.period / period - 1};
    }
    if (oracle_beam_timoshenko(&beam, g->mode, &mode, why)) {
        figure[count++] =
            (struct oracle_figure){"Timoshenko period", "s", "with shear and rotary inertia", mode.period};
        figure[count++] = (struct oracle_figure){"error of Timoshenko theory", "-", "of the period, relative",
                                                 mode.period / period - 1};
    }
    return count;
}

/* The two differ in what creates them. */
#define CANTILEVER(KIND, NAME, PLANE, CREATE)                                                                          \
    const struct oracle_kind KIND = {                                                                                  \
        .name = NAME,                                                                                                  \
        .summary = "a bending mode of a clamped plate, as a body in " PLANE,                                           \
        .source = "001_363f711843f01da4.txt, section 4.1, for the body in " PLANE " in place of the thin plate",       \
        .dim = 2,                                                                                                      \
        .smoothness = ORACLE_SMOOTH,                                                                                   \
        .parameter = plate_parameters,                                                                                 \
        .create = CREATE,                                                                                              \
        .destroy = destroy,                                                                                            \
        .state = state,                                                                                                \
        .outside = outside,                                                                                            \
        .energy = energy,                                                                                              \
        .figures = figures,                                                                                            \
        .check = cantilever_check,                                                                                     \
    }
CANTILEVER(oracle_cantilever, "cantilever", "plane strain", create_plane_strain);
CANTILEVER(oracle_cantilever_plane_stress, "cantilever-plane-stress", "plane stress", create_plane_stress);
