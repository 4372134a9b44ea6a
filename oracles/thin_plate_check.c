/* The laws of thin-plate theory, by differences and integrals of the fields as they are given. The second evaluation is
 * the source's own formula for the mode, f(X)/f(L), with a root of its own: it cancels the more the higher the mode,
 * and its bound says by how much. */
#include "oracles/plate_check.h"
#include "oracles/thin_plate.h"

#include <float.h>
#include <math.h>

static const double PI = 3.14159265358979323846;

enum { SAMPLES = 64, FACE_SAMPLES = 32, PIECES = 4 };
static const double REACH = 0.8; /* of the half height: room for differences along it */

/* E' by way of Lame's parameters [Pa]. */
static double stiffness(const struct self_check *check)
{
    double lambda = check->bulk - 2 * check->mu / 3;
    return 4 * check->mu * (lambda + check->mu) / (lambda + 2 * check->mu);
}

enum law { VELOCITY, MOMENTUM, GRADIENT, STRESS, ROTATION, DEFLECTION, LAWS };

/* Means over the section: of dp_y/dt, and of dP_yx/dX. */
static void mean_of_motion(const struct self_check *check, struct self_check_spot spot, double *inertia, double *force)
{
    double half = check->oracle->given.height / 2;
    *inertia = *force = 0;
    for (int n = 0; n < SELF_CHECK_NODES; n++) {
        struct oracle_state in_time, along;
        double weight;
        spot.X[1] = half * self_check_node(n, &weight);
        self_check_derivative(check, &spot, 3, &in_time);
        self_check_derivative(check, &spot, 0, &along);
        *inertia += weight / 2 * in_time.p[1];
        *force += weight / 2 * along.P[3];
    }
}

/* All that goes without differences: p = rho v, and the stress that goes with a strain. */
static void measure_state(const struct self_check *check, const struct oracle_state *state,
                          struct self_check_distance law[LAWS])
{
    double momentum[3], P[9] = {0}, nu = check->oracle->given.nu;
    for (int k = 0; k < 3; k++) {
        momentum[k] = check->rho * state->v[k];
    }
    P[0] = stiffness(check) * (state->F[0] - 1);
    P[1] = P[3] = (state->P[1] + state->P[3]) / 2;
    P[8] = nu * P[0];
    self_check_measure(&law[MOMENTUM], state->p, momentum, 3);
    self_check_measure(&law[STRESS], state->P, P, 9);
}

static void differentiate(struct self_check *check, size_t i, struct self_check_distance law[LAWS])
{
    struct oracle_state state, along[4];
    struct self_check_spot spot = self_check_sample(check, i, SELF_CHECK_REACH), across;
    double half = check->oracle->given.height / 2, own[9], G[9] = {0}, inertia, force;
    spot.X[1] = REACH * half * (2 * self_check_sequence(i, 1) - 1);
    across = spot;
    across.step = (half - fabs(spot.X[1])) * check->wave_number / (SELF_CHECK_REACH * SELF_CHECK_STEP);
    across.step = fmin(1, across.step);
    check->kind->state(check->oracle, spot.X, spot.t, &state);
    self_check_derivative(check, &spot, 3, &along[3]);
    self_check_derivative(check, &spot, 0, &along[0]);
    self_check_derivative(check, &across, 1, &along[1]);
    for (int k = 0; k < 3; k++) {
        G[3 * k] = along[0].u[k];
        G[3 * k + 1] = along[1].u[k];
    }
    for (int k = 0; k < 9; k++) {
        own[k] = state.F[k] - (k % 4 == 0 ? 1 : 0);
    }
    mean_of_motion(check, spot, &inertia, &force);
    double shear = -along[1].P[1];
    measure_state(check, &state, law);
    self_check_measure(&law[VELOCITY], state.v, along[3].u, 3);
    self_check_measure(&law[GRADIENT], own, G, 9);
    self_check_measure(&law[ROTATION], &along[0].P[0], &shear, 1);
    self_check_measure(&law[DEFLECTION], &inertia, &force, 1);
    self_check_largest(&check->of.stress, state.P, 9);
}

/* Sets the scales, which those that follow use. */
static void differentials(struct self_check *check)
{
    struct self_check_distance law[LAWS] = {0};
    const struct plate *g = &check->oracle->given;
    check->of = (struct self_check_scale){.u = fabs(g->tip_velocity) / check->frequency, .v = fabs(g->tip_velocity)};
    for (size_t i = 0; i < SAMPLES; i++) {
        differentiate(check, i, law);
    }
    /* Along the height the step is as much shorter as the plate is thin. */
    double bound = 16 * self_check_round_off(check) / SELF_CHECK_STEP;
    double fine = bound * fmax(1, 1 / ((1 - REACH) * g->height / 2 * check->wave_number));
    check->of.gradient = law[GRADIENT].size;
    self_check_line(check, "v = du/dt", self_check_relative(law[VELOCITY].error, check->of.v), bound);
    self_check_line(check, "p = rho v", self_check_relative(law[MOMENTUM].error, law[MOMENTUM].size), 4 * DBL_EPSILON);
    self_check_line(check, "F = I + du/dX", law[GRADIENT].error / self_check_gradient_scale(check, fine), fine);
    self_check_line(check, "P_xx = E' (F_xx - 1), P_zz = nu P_xx",
                    law[STRESS].error / (stiffness(check) * self_check_gradient_scale(check, 64 * DBL_EPSILON)),
                    64 * DBL_EPSILON);
    self_check_line(check, "dP_xx/dX + dP_xy/dY = 0", self_check_relative(law[ROTATION].error, law[ROTATION].size),
                    fine);
    self_check_line(check, "dp_y/dt = dP_yx/dX, mean over the height",
                    self_check_relative(law[DEFLECTION].error, law[DEFLECTION].size), bound);
}

/* Clamped: neither moved nor turned. Free: neither bent nor sheared. Nothing pulls at the faces along it. */
static void faces(struct self_check *check)
{
    const struct plate *g = &check->oracle->given;
    static const char *const law[] = {"displacement on X0", "traction on X1: no moment, no shear force",
                                      "traction on Y0", "traction on Y1"};
    const double at[] = {0, g->length, -g->height / 2, g->height / 2};
    for (int face = 0; face < 4; face++) {
        double largest = 0;
        for (size_t i = 0; i < FACE_SAMPLES; i++) {
            struct oracle_state state;
            struct self_check_spot spot = self_check_sample(check, i, 0);
            spot.X[face / 2] = at[face];
            check->kind->state(check->oracle, spot.X, spot.t, &state);
            for (int k = 0; k < 3; k++) {
                self_check_largest(&largest, face == 0 ? &state.u[k] : &state.P[3 * k + face / 2], 1);
            }
        }
        /* The root has its round-off, and the slopes of the shape have it as often as they are taken. */
        self_check_line(check, law[face], self_check_relative(largest, face == 0 ? check->of.u : check->of.stress),
                        64 * DBL_EPSILON);
    }
}

/* cos z = -1 / cosh z near (mode - 1/2) pi: an iteration that shrinks the error by sech z at least. */
static double root(int mode)
{
    double middle = (mode - 0.5) * PI, z = middle;
    for (int i = 0; i < 64; i++) {
        z = middle + (mode % 2 == 1 ? 1 : -1) * asin(1 / cosh(z));
    }
    return z;
}

/* f and its derivatives along k X. */
static double shape(double z, double kx, int order)
{
    double s = order % 2 == 0 ? sinh(kx) : cosh(kx), c = order % 2 == 0 ? cosh(kx) : sinh(kx);
    double phase = kx + order * PI / 2;
    return (cos(z) + cosh(z)) * (c - cos(phase)) + (sin(z) - sinh(z)) * (s - sin(phase));
}

static void second(const struct self_check *check, const double X[3], double t, struct oracle_state *state)
{
    const struct plate *g = &check->oracle->given;
    double z = root(g->mode), k = z / g->length, f[4], H = g->height, Y = X[1];
    double omega = k * k * H * sqrt(stiffness(check) / (12 * check->rho)), tip = shape(z, z, 0);
    for (int order = 0; order < 4; order++) {
        f[order] = pow(k, order) * shape(z, k * X[0], order) / tip;
    }
    double rate = g->tip_velocity * cos(omega * t), a = g->tip_velocity * sin(omega * t) / omega;
    double bent = -stiffness(check) * Y * f[2] * a, sheared = -stiffness(check) * (H * H / 8 - Y * Y / 2) * f[3] * a;
    *state = (struct oracle_state){.u = {-Y * f[1] * a, f[0] * a, 0},
                                   .v = {-Y * f[1] * rate, f[0] * rate, 0},
                                   .p = {-check->rho * Y * f[1] * rate, check->rho * f[0] * rate, 0},
                                   .F = {1 - Y * f[2] * a, -f[1] * a, 0, f[1] * a, 1, 0, 0, 0, 1},
                                   .P = {bent, sheared, 0, sheared, 0, 0, 0, 0, g->nu * bent}};
}

/* Of the deflection alone, and of the bending stress: P_xx^2 / (2 E'). */
static struct plate_energies quadrature(const struct self_check *check, double t)
{
    const struct plate *g = &check->oracle->given;
    double half = g->height / 2, piece = g->length / PIECES;
    struct plate_energies sum = {0};
    for (int n = 0; n < PIECES * SELF_CHECK_NODES * SELF_CHECK_NODES; n++) {
        int cut = n / (SELF_CHECK_NODES * SELF_CHECK_NODES);
        double along, across, x = self_check_node(n / SELF_CHECK_NODES % SELF_CHECK_NODES, &along);
        double X[3] = {piece * (cut + (1 + x) / 2), half * self_check_node(n % SELF_CHECK_NODES, &across), 0};
        double weight = piece / 2 * along * half * across;
        struct oracle_state s;
        check->kind->state(check->oracle, X, t, &s);
        sum.kinetic += weight * s.p[1] * s.v[1] / 2;
        sum.strain += weight * s.P[0] / (2 * stiffness(check)) * s.P[0];
    }
    return sum;
}

size_t thin_plate_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                        size_t size)
{
    const struct plate *g = &oracle->given;
    struct self_check check = {.kind = kind,
                               .oracle = oracle,
                               .lower = {0, -g->height / 2},
                               .upper = {g->length, g->height / 2},
                               .t_end = 2 * PI / oracle->mode.frequency,
                               .wave_number = root(g->mode) / g->length,
                               .frequency = oracle->mode.frequency,
                               .bulk = g->E / (3 * (1 - 2 * g->nu)),
                               .mu = g->E / (2 * (1 + g->nu)),
                               .rho = g->rho,
                               .line = line,
                               .size = size};
    differentials(&check);
    plate_check_starts(&check, g);
    faces(&check);
    self_check_compare(&check, second, 16 * self_check_round_off(&check) * cosh(root(g->mode)));
    plate_check_energies(&check, quadrature, 16 * self_check_round_off(&check));
    return check.count;
}
