#include "oracles/self_check_parts.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { TIMES = 12, NODES = 8 };
enum { V, F, P, FIELDS }; /* the fields that a front may break, in the first direction; F less one */

/* Step of the extrapolation to a front, in radians: its error, LIMIT_STEP^8, stays below the round-off, which the
 * alternating weights magnify by 2^8. */
static const double LIMIT_STEP = 0.02;

/* Front to front, in units of the round-off of their places. */
static const double NEAR = 4096;

/* Magnitudes of the weights of a slope, summed: how much of the round-off of the unit matrix in F it may show. */
static const double WEIGHTS = 618;

static double limit_bound(const struct self_check *check)
{
    return 1024 * self_check_round_off(check);
}

/* Values, and slopes times the step, as X comes to `from` in steps of `step`, by the polynomial through eight nodes. */
static void one_sided(const struct self_check *check, double from, double t, double step, double value[FIELDS],
                      double slope[FIELDS])
{
    static const double to_value[NODES] = {8, -28, 56, -70, 56, -28, 8, -1};
    /* its derivative at node 0 */
    static const double to_slope[NODES] = {-481.0 / 35, 621.0 / 10,  -2003.0 / 15, 691.0 / 4,
                                           -141.0,      2143.0 / 30, -103.0 / 5,   363.0 / 140};
    memset(value, 0, FIELDS * sizeof *value);
    memset(slope, 0, FIELDS * sizeof *slope);
    for (int k = 0; k < NODES; k++) {
        struct oracle_state state;
        double X[3] = {from + (k + 1) * step, 0, 0};
        check->kind->state(check->oracle, X, t, &state);
        double field[FIELDS] = {state.v[0], state.F[0] - 1, state.P[0]};
        for (int i = 0; i < FIELDS; i++) {
            value[i] += to_value[k] * field[i];
            slope[i] += to_slope[k] * field[i];
        }
    }
}

struct breaks {
    double momentum, kinematics, listed, moved; /* relative errors */
    size_t moving, tested;
};

static struct self_check_body body_around(const struct self_check *check, double X)
{
    struct self_check_body body = self_check_body(check, 0);
    return X <= body.upper[0] || self_check_bodies(check) == 1 ? body : self_check_body(check, 1);
}

/* How far front i is from the other fronts and the ends of its body [m]. */
static double room(const struct self_check_body *body, const struct oracle_front *front, size_t count, size_t i)
{
    double X = front[i].X, free = fmin(X - body->lower[0], body->upper[0] - X);
    for (size_t j = 0; j < count; j++) {
        free = j == i ? free : fmin(free, fabs(front[j].X - X));
    }
    return free;
}

/* How far the nearest front of the same speed and kind is from where this one should be after `delay` [m]. */
static double strayed(const struct self_check *check, const struct oracle_front *of, double t, double delay)
{
    struct oracle_front front[ORACLE_FRONTS];
    size_t count = check->kind->fronts(check->oracle, t + delay, front);
    double nearest = INFINITY;
    for (size_t i = 0; count != ORACLE_TOO_MANY_FRONTS && i < count; i++) {
        if (front[i].speed * of->speed > 0 && front[i].smoothness == of->smoothness) {
            nearest = fmin(nearest, fabs(front[i].X - (of->X + delay * of->speed)));
        }
    }
    return nearest;
}

static void break_at(const struct self_check *check, const struct self_check_body *body,
                     const struct oracle_front *front, double t, double free, struct breaks *worst)
{
    double left[FIELDS], right[FIELDS], left_slope[FIELDS], right_slope[FIELDS], jump[FIELDS], bend[FIELDS];
    double c = self_check_speed(body), step = fmin(LIMIT_STEP * self_check_radian(check, body), free / (NODES + 1));
    double s = front->speed, bound = limit_bound(check), v_size = check->of.v + c * WEIGHTS * DBL_EPSILON / bound;
    one_sided(check, front->X, t, -step, left, left_slope);
    one_sided(check, front->X, t, step, right, right_slope);
    for (int i = 0; i < FIELDS; i++) {
        jump[i] = right[i] - left[i];
        bend[i] = right_slope[i] + left_slope[i]; /* the step to the left is negative */
    }
    double momentum =
        self_check_worse(fabs(jump[P] + body->rho * s * jump[V]), fabs(bend[P] + body->rho * s * bend[V]));
    double kinematics = self_check_worse(fabs(jump[V] + s * jump[F]), fabs(bend[V] + s * bend[F]));
    bool named = front->smoothness == (front->jump == 0 ? ORACLE_KINKS : ORACLE_JUMPS);
    worst->momentum = self_check_worse(worst->momentum, self_check_relative(momentum, check->of.stress));
    worst->kinematics = self_check_worse(worst->kinematics, self_check_relative(kinematics, v_size));
    worst->listed = self_check_worse(worst->listed,
                                     named ? self_check_relative(fabs(jump[V] - front->jump), check->of.v) : INFINITY);
    worst->moved =
        self_check_worse(worst->moved, strayed(check, front, t, free / (4 * c)) / (body->upper[0] - body->lower[0]));
    worst->tested++;
}

static void breaks_at_time(const struct self_check *check, double t, struct breaks *worst)
{
    struct oracle_front front[ORACLE_FRONTS];
    size_t count = check->kind->fronts(check->oracle, t, front);
    if (count == ORACLE_TOO_MANY_FRONTS) {
        worst->listed = NAN;
        return;
    }
    for (size_t i = 0; i < count; i++) {
        struct self_check_body body = body_around(check, front[i].X);
        double free = room(&body, front, count, i);
        bool ordered = i == 0 || front[i].X >= front[i - 1].X;
        worst->listed = ordered ? worst->listed : NAN;
        worst->moving += front[i].speed != 0;
        /* Fronts that cross have no sides of their own; two as near as this are judged at another time. */
        if (front[i].speed != 0 && free > NEAR * self_check_round_off(check) * (body.upper[0] - body.lower[0])) {
            break_at(check, &body, &front[i], t, free, worst);
        }
    }
}

static void gradient(const struct self_check_body *body, const struct oracle_state *state, const double X[3],
                     const void *with, double weight, double sum[SELF_CHECK_SUMS])
{
    (void)body, (void)X, (void)with;
    sum[0] += weight * (state->F[0] - 1);
}

/* u less its value at the lower end against the integral of F - I between the places listed. */
static void integrate_gradient(const struct self_check *check, const struct self_check_body *body, double t,
                               struct self_check_distance *of)
{
    double place[SELF_CHECK_PLACES], risen = 0;
    size_t count = self_check_places(check, body, t, place);
    struct oracle_state first, next;
    of->error = count == 0 ? NAN : of->error;
    for (size_t i = 0; i + 1 < count; i++) {
        double X[2][3] = {{body->lower[0], 0, 0}, {place[i + 1], 0, 0}}, sum[SELF_CHECK_SUMS];
        struct self_check_body piece = *body;
        piece.lower[0] = place[i];
        piece.upper[0] = place[i + 1];
        self_check_integrate(check, &piece, t, self_check_radian(check, body), gradient, NULL, sum);
        risen += sum[0];
        check->kind->state(check->oracle, X[0], t, &first);
        check->kind->state(check->oracle, X[1], t, &next);
        double u = next.u[0] - first.u[0];
        self_check_measure(of, &u, &risen, 1);
    }
}

void self_check_fronts(struct self_check *check)
{
    struct breaks worst = {0};
    struct self_check_distance integral = {0};
    double length = 0, bound = limit_bound(check);
    for (int which = 0; which < self_check_bodies(check); which++) {
        struct self_check_body body = self_check_body(check, which);
        length += body.upper[0] - body.lower[0];
    }
    for (size_t i = 0; i < TIMES; i++) {
        double t = self_check_time(check, i);
        breaks_at_time(check, t, &worst);
        for (int which = 0; which < self_check_bodies(check); which++) {
            struct self_check_body body = self_check_body(check, which);
            integrate_gradient(check, &body, t, &integral);
        }
    }
    if (worst.tested == 0 && worst.moving > 0) {
        worst.listed = NAN; /* none could be looked at, so nothing can be said */
    }
    self_check_line(check, "fronts: [P] = -rho s [v], slopes too", worst.momentum, bound);
    self_check_line(check, "fronts: [v] = -s [F], slopes too", worst.kinematics, bound);
    self_check_line(check, "fronts: [v] is the listed jump", worst.listed, bound);
    self_check_line(check, "fronts: go where their speed says", worst.moved, 64 * self_check_round_off(check));
    self_check_line(check, "between fronts: u is the integral of F - I",
                    integral.error / (check->of.u + 2 * DBL_EPSILON / bound * length), bound);
}
