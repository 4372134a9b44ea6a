/* The laws of a rigid body, by differences and integrals of the fields as they are given: it turns without strain, and
 * its momenta stay. No more is needed for Euler's equations to hold. The second evaluation integrates these and the
 * attitude step by step. */
#include "oracles/free_top.h"
#include "oracles/self_check_parts.h"

#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <string.h>

enum { SAMPLES = 64, INSTANTS = 16, MOMENTA = 4, NUMBERS = 12 };

/* At each instant, of which t = 0 is the first: angular velocity as the body sees it, and R, row by row. NaN if the
 * integration fails. */
struct flight {
    double inertia[3]; /* [kg m^2] */
    double at[INSTANTS], y[INSTANTS][NUMBERS];
};

/* Moments of inertia about the three axes. */
static void inertia(const struct self_check_body *body, const struct oracle_state *state, const double X[3],
                    const void *with, double weight, double sum[SELF_CHECK_SUMS])
{
    (void)state, (void)with;
    for (int i = 0; i < 3; i++) {
        sum[i] += weight * body->rho * (X[0] * X[0] + X[1] * X[1] + X[2] * X[2] - X[i] * X[i]);
    }
}

static int moves(double t, const double y[], double slope[], void *context)
{
    const double *I = context, *w = y, *R = y + 3;
    (void)t;
    for (int i = 0; i < 3; i++) {
        int next = (i + 1) % 3, last = (i + 2) % 3;
        slope[i] = (I[next] - I[last]) / I[i] * w[next] * w[last];
        for (int row = 0; row < 3; row++) {
            slope[3 + 3 * row + i] = R[3 * row + next] * w[last] - R[3 * row + last] * w[next];
        }
    }
    return GSL_SUCCESS;
}

static void fly(const struct self_check *check, struct flight *flight)
{
    double y[NUMBERS] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, t = 0;
    gsl_odeiv2_system system = {.function = moves, .dimension = NUMBERS, .params = flight->inertia};
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, SELF_CHECK_STEP / check->frequency, 0, 1e-13);
    memcpy(y, free_top_given(check->oracle)->spin, 3 * sizeof *y);
    for (int i = 0; i < INSTANTS; i++) {
        flight->at[i] = check->t_end * i / (INSTANTS - 1);
        bool flown = driver != NULL && (i == 0 || gsl_odeiv2_driver_apply(driver, &t, flight->at[i], y) == GSL_SUCCESS);
        for (int n = 0; n < NUMBERS; n++) {
            flight->y[i][n] = flown ? y[n] : NAN;
        }
    }
    if (driver != NULL) {
        gsl_odeiv2_driver_free(driver);
    }
}

static void second(const struct self_check *check, const double X[3], double t, struct oracle_state *state)
{
    const struct flight *flight = check->with;
    int i = 0;
    while (i < INSTANTS - 1 && flight->at[i] != t) {
        i++;
    }
    const double *w = flight->y[i], *R = w + 3;
    *state = (struct oracle_state){.u = {-X[0], -X[1], -X[2]}};
    for (int row = 0; row < 3; row++) {
        for (int n = 0; n < 3; n++) {
            int next = (n + 1) % 3, last = (n + 2) % 3;
            state->F[3 * row + n] = R[3 * row + n];
            state->u[row] += R[3 * row + n] * X[n];
            state->v[row] += R[3 * row + n] * (w[next] * X[last] - w[last] * X[next]);
        }
        state->p[row] = check->rho * state->v[row];
    }
}

enum law { VELOCITY, MOMENTUM, GRADIENT, RIGID, LAWS };

static void differentiate(struct self_check *check, size_t i, struct self_check_distance law[LAWS])
{
    struct oracle_state state, along[4];
    struct self_check_spot spot = self_check_sample(check, i, SELF_CHECK_REACH);
    double momentum[3], G[9], own[9], square[9];
    check->kind->state(check->oracle, spot.X, spot.t, &state);
    for (int axis = 0; axis < 4; axis++) {
        self_check_derivative(check, &spot, axis, &along[axis]);
    }
    for (int n = 0; n < 9; n++) {
        const double *F = state.F;
        double unit = n % 4 == 0 ? 1 : 0;
        int a = n / 3, b = n % 3;
        own[n] = F[n] - unit;
        G[n] = along[b].u[a];
        square[n] = F[a] * F[b] + F[3 + a] * F[3 + b] + F[6 + a] * F[6 + b] - unit;
    }
    for (int k = 0; k < 3; k++) {
        momentum[k] = check->rho * state.v[k];
    }
    static const double none[9] = {0};
    self_check_measure(&law[VELOCITY], state.v, along[3].u, 3);
    self_check_measure(&law[MOMENTUM], state.p, momentum, 3);
    self_check_measure(&law[GRADIENT], own, G, 9);
    self_check_measure(&law[RIGID], square, none, 9);
    self_check_largest(&check->of.u, state.u, 3);
    self_check_largest(&check->of.v, along[3].u, 3);
    self_check_largest(&check->of.gradient, G, 9);
}

/* Sets the scales. `blur` is what the motion makes of round-off, relative. */
static void differentials(struct self_check *check, double blur)
{
    struct self_check_distance law[LAWS] = {0};
    for (size_t i = 0; i < SAMPLES; i++) {
        differentiate(check, i, law);
    }
    double bound = 16 * self_check_round_off(check) / SELF_CHECK_STEP + blur;
    check->of.stress = check->rho * check->of.v * check->of.v;
    double differenced = check->of.v + check->frequency * check->of.u; /* no motion of a slender body need be so fast */
    self_check_line(check, "v = du/dt", law[VELOCITY].error / differenced, bound);
    self_check_line(check, "p = rho v", self_check_relative(law[MOMENTUM].error, law[MOMENTUM].size), 4 * DBL_EPSILON);
    self_check_line(check, "F = I + du/dX", law[GRADIENT].error / self_check_gradient_scale(check, bound), bound);
    self_check_line(check, "F^T F = I", law[RIGID].error, 64 * DBL_EPSILON);
}

static void linear(const struct self_check_body *body, const struct oracle_state *state, const double X[3],
                   const void *with, double weight, double sum[SELF_CHECK_SUMS])
{
    (void)body, (void)X, (void)with;
    for (int i = 0; i < 3; i++) {
        sum[i] += weight * state->p[i];
    }
}

static void angular(const struct self_check_body *body, const struct oracle_state *state, const double X[3],
                    const void *with, double weight, double sum[SELF_CHECK_SUMS])
{
    (void)body, (void)with;
    for (int i = 0; i < 3; i++) {
        int next = (i + 1) % 3, last = (i + 2) % 3;
        sum[i] += weight * ((X[next] + state->u[next]) * state->p[last] - (X[last] + state->u[last]) * state->p[next]);
    }
}

/* Both stay what they were at t = 0. */
static void momenta(struct self_check *check, const double moment[3], double bound)
{
    const struct free_top_given *g = free_top_given(check->oracle);
    struct self_check_body body = self_check_body(check, 0);
    struct self_check_distance of[2] = {0};
    double mass = g->rho * g->side[0] * g->side[1] * g->side[2];
    for (size_t i = 0; i < MOMENTA; i++) {
        double sum[2][SELF_CHECK_SUMS], due[3], t = check->t_end * (double)i / MOMENTA;
        static const double none[3] = {0};
        self_check_integrate(check, &body, t, INFINITY, linear, NULL, sum[0]);
        self_check_integrate(check, &body, t, INFINITY, angular, NULL, sum[1]);
        for (int k = 0; k < 3; k++) {
            due[k] = moment[k] * g->spin[k];
        }
        self_check_measure(&of[0], sum[0], none, 3);
        self_check_measure(&of[1], sum[1], due, 3);
    }
    self_check_line(check, "linear momentum is 0", of[0].error / (mass * check->of.v), bound);
    self_check_line(check, "angular momentum is that at t = 0", self_check_relative(of[1].error, of[1].size), bound);
}

size_t free_top_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                      size_t size)
{
    const struct free_top_given *g = free_top_given(oracle);
    double fastest = 0;
    struct self_check check = {.kind = kind,
                               .oracle = oracle,
                               .t_end = free_top_period(oracle),
                               .wave_number = 8 * SELF_CHECK_STEP / g->side[2],
                               .bulk = 1,
                               .mu = 1,
                               .rho = g->rho,
                               .line = line,
                               .size = size};
    struct flight flight = {.at = {0}};
    for (int i = 0; i < 3; i++) {
        check.upper[i] = g->side[i] / 2;
        check.lower[i] = -check.upper[i];
    }
    struct self_check_body body = self_check_body(&check, 0);
    self_check_integrate(&check, &body, 0, INFINITY, inertia, NULL, flight.inertia);
    for (int i = 0; i < 3; i++) { /* the fastest there may be with this angular momentum */
        fastest = hypot(fastest, flight.inertia[i] * g->spin[i]);
    }
    check.frequency = 2 * fastest / fmin(flight.inertia[0], fmin(flight.inertia[1], flight.inertia[2]));
    double blur = 16 * self_check_round_off(&check) / free_top_distance(oracle);
    fly(&check, &flight);
    check.with = &flight;
    check.instant = flight.at;
    check.instants = INSTANTS;
    differentials(&check, blur);
    momenta(&check, flight.inertia, 64 * DBL_EPSILON);
    self_check_compare(&check, second, 16 * blur);
    self_check_energies(&check);
    return check.count;
}
