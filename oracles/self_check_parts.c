#include "oracles/self_check_parts.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { NUMBERS = sizeof(struct oracle_state) / sizeof(double) };
enum { CANDIDATES = 8 }; /* sample points to choose from where there are fronts */
enum { RADII = 4 };      /* to integrate along in a round body */

double self_check_worse(double a, double b)
{
    return isnan(a) || a > b ? a : b;
}

void self_check_measure(struct self_check_distance *d, const double *a, const double *b, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        d->error = self_check_worse(d->error, fabs(a[i] - b[i]));
        d->size = self_check_worse(d->size, self_check_worse(fabs(a[i]), fabs(b[i])));
    }
}

void self_check_largest(double *size, const double *a, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        *size = self_check_worse(*size, fabs(a[i]));
    }
}

double self_check_relative(double error, double scale)
{
    return error == 0 && scale == 0 ? 0 : error / scale;
}

void self_check_line(struct self_check *check, const char *law, double residual, double bound)
{
    if (check->count < check->size) {
        check->line[check->count] = (struct oracle_check){.law = law, .residual = residual, .bound = bound};
    }
    check->count++;
}

/* A body that begins far from the origin has its places with the round-off of that distance. */
double self_check_round_off(const struct self_check *check)
{
    double far = check->behind == NULL ? 0 : check->behind->upper[0] / self_check_speed(check->behind);
    double along_radius = check->shell == NULL ? 0 : check->shell->outer * check->wave_number;
    return DBL_EPSILON * (1 + check->frequency * (check->t_end + far) + along_radius) * (1 + check->drift);
}

double self_check_gradient_scale(const struct self_check *check, double bound)
{
    return check->of.gradient + 2 * DBL_EPSILON / bound;
}

int self_check_bodies(const struct self_check *check)
{
    return check->behind == NULL ? 1 : 2;
}

struct self_check_body self_check_body(const struct self_check *check, int which)
{
    struct self_check_body body = {.bulk = check->bulk, .mu = check->mu, .rho = check->rho};
    memcpy(body.lower, check->lower, sizeof body.lower);
    memcpy(body.upper, check->upper, sizeof body.upper);
    return which == 0 ? body : *check->behind;
}

void self_check_hooke(double bulk, double mu, const double G[9], double P[9])
{
    double trace = G[0] + G[4] + G[8];
    for (int i = 0; i < 9; i++) {
        P[i] = mu * (G[i] + G[i % 3 * 3 + i / 3]) + (i % 4 == 0 ? (bulk - 2 * mu / 3) * trace : 0);
    }
}

double self_check_complementary(double bulk, double mu, const double P[9])
{
    double trace = P[0] + P[4] + P[8], energy = trace / (18 * bulk) * trace;
    for (int i = 0; i < 9; i++) {
        double dev = P[i] - (i % 4 == 0 ? trace / 3 : 0);
        energy += dev / (4 * mu) * dev;
    }
    return energy;
}

double self_check_modulus(const struct self_check_body *body)
{
    return body->bulk + 4 * body->mu / 3;
}

double self_check_speed(const struct self_check_body *body)
{
    return sqrt(self_check_modulus(body) / body->rho);
}

double self_check_radian(const struct self_check *check, const struct self_check_body *body)
{
    if (check->shell != NULL) {
        return 2 / check->wave_number;
    }
    return check->kind->fronts == NULL ? INFINITY : self_check_speed(body) / check->frequency;
}

double self_check_sequence(size_t i, int axis)
{
    static const size_t base[4] = {2, 3, 5, 7};
    double x = 0, digit = 1;
    for (size_t rest = i + 1; rest > 0; rest /= base[axis]) {
        digit /= (double)base[axis];
        x += digit * (double)(rest % base[axis]);
    }
    return x;
}

/* Along an axis, or in time, of the differences. With fronts each material has its own wave number: one frequency runs
 * through all of them. */
static double step_along(const struct self_check *check, const struct self_check_body *body, int axis)
{
    double frequency = SELF_CHECK_STEP / check->frequency;
    if (axis == 3) {
        return frequency;
    }
    return check->kind->fronts == NULL ? SELF_CHECK_STEP / check->wave_number : frequency * self_check_speed(body);
}

/* How far from X the nearest front or end of the body is. */
static double clearance(const struct self_check *check, const struct self_check_spot *spot)
{
    struct oracle_front front[ORACLE_FRONTS];
    size_t count = check->kind->fronts(check->oracle, spot->t, front);
    double X = spot->X[0], room = fmin(X - spot->body.lower[0], spot->body.upper[0] - X);
    if (count == ORACLE_TOO_MANY_FRONTS) {
        return 0;
    }
    for (size_t i = 0; i < count; i++) {
        room = fmin(room, fabs(X - front[i].X));
    }
    return room;
}

static double within(double lower, double upper, double margin, double part)
{
    return lower + margin + part * (upper - lower - 2 * margin);
}

double self_check_time(const struct self_check *check, size_t i)
{
    return check->t_first + (check->t_end - check->t_first) * self_check_sequence(i, 3);
}

/* Among fronts the best of some candidates, with steps that fit in; at t, or at any time if it is NaN. */
static struct self_check_spot sample_between_fronts(const struct self_check *check, size_t i, double t)
{
    struct self_check_spot best = {.step = -1};
    for (size_t n = i * CANDIDATES; n < (i + 1) * CANDIDATES; n++) {
        struct self_check_spot spot = {.body = self_check_body(check, (int)(i % (size_t)self_check_bodies(check)))};
        spot.X[0] = within(spot.body.lower[0], spot.body.upper[0], 0, self_check_sequence(n, 0));
        spot.t = isnan(t) ? self_check_time(check, n) : t;
        double room = clearance(check, &spot);
        if (isnan(t)) {
            double reach = check->kind->reach != NULL ? check->kind->reach(check->oracle) : INFINITY;
            room = fmin(room, self_check_speed(&spot.body) * fmin(spot.t, reach - spot.t));
        }
        spot.step = fmin(1, room / ((SELF_CHECK_REACH + 1) * step_along(check, &spot.body, 0)));
        best = spot.step > best.step ? spot : best;
    }
    return best;
}

struct self_check_spot self_check_sample(const struct self_check *check, size_t i, int steps)
{
    if (check->kind->fronts != NULL) {
        return sample_between_fronts(check, i, NAN);
    }
    struct self_check_spot spot = {.body = self_check_body(check, 0), .step = 1};
    if (check->shell != NULL) {
        double part[3] = {self_check_sequence(i, 0), self_check_sequence(i, 1), self_check_sequence(i, 2)};
        (void)shell_place(check->shell, part, steps * step_along(check, &spot.body, 0), spot.X);
    }
    for (int axis = 0; check->shell == NULL && axis < check->kind->dim; axis++) {
        spot.X[axis] = within(spot.body.lower[axis], spot.body.upper[axis], steps * step_along(check, &spot.body, axis),
                              self_check_sequence(i, axis));
    }
    double pieces = (double)(check->pieces > 0 ? check->pieces : 1), part = pieces * self_check_sequence(i, 3);
    double piece = floor(part), length = check->t_end / pieces;
    spot.t = within(piece * length, (piece + 1) * length, steps * step_along(check, &spot.body, 3), part - piece);
    return spot;
}

struct self_check_spot self_check_sample_at(const struct self_check *check, size_t i, double t)
{
    if (check->kind->fronts != NULL) {
        return sample_between_fronts(check, i, t);
    }
    struct self_check_spot spot = self_check_sample(check, i, 0);
    spot.t = t;
    return spot;
}

void self_check_derivative(const struct self_check *check, const struct self_check_spot *spot, int axis,
                           struct oracle_state *along)
{
    static const double weight[SELF_CHECK_REACH] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    double step = spot->step * step_along(check, &spot->body, axis), sum[NUMBERS] = {0};
    for (int k = 0; k < SELF_CHECK_REACH; k++) {
        double value[2][NUMBERS];
        for (int side = 0; side < 2; side++) {
            struct oracle_state state;
            double shift = (side == 0 ? -1 : 1) * (k + 1) * step;
            double Y[3] = {spot->X[0], spot->X[1], spot->X[2]};
            if (axis < 3) {
                Y[axis] += shift;
            }
            check->kind->state(check->oracle, Y, axis == 3 ? spot->t + shift : spot->t, &state);
            memcpy(value[side], &state, sizeof state);
        }
        for (size_t n = 0; n < NUMBERS; n++) {
            sum[n] += weight[k] * (value[1][n] - value[0][n]) / step;
        }
    }
    memcpy(along, sum, sizeof *along);
}

size_t self_check_places(const struct self_check *check, const struct self_check_body *body, double t,
                         double place[SELF_CHECK_PLACES])
{
    struct oracle_front front[ORACLE_FRONTS];
    size_t count = 0, fronts = check->kind->fronts == NULL ? 0 : check->kind->fronts(check->oracle, t, front);
    if (fronts == ORACLE_TOO_MANY_FRONTS) {
        return 0;
    }
    place[count++] = body->lower[0];
    for (size_t i = 0; i < fronts; i++) {
        if (front[i].X > place[count - 1] && front[i].X < body->upper[0]) {
            place[count++] = front[i].X;
        }
    }
    place[count++] = body->upper[0];
    return count;
}

double self_check_node(int n, double *weight)
{
    static const double node[5] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845,
                                   0.9739065285171717};
    static const double weights[5] = {0.2955242247147529, 0.2692667193099963, 0.2190863625159820, 0.1494513491505806,
                                      0.0666713443086881};
    *weight = weights[n / 2];
    return n % 2 == 0 ? -node[n / 2] : node[n / 2];
}

struct integral {
    const struct self_check *check;
    const struct self_check_body *body;
    double t;
    self_check_integrand *integrand;
    const void *with;
};

/* From `lower` to `upper` along `axis`, and over the whole body along those behind it, each line for itself: a thousand
 * terms that are much alike, added to one sum, would all be rounded the same way. */
static void integrate_along(const struct integral *of, int axis, double lower, double upper, double X[3], double weight,
                            double sum[SELF_CHECK_SUMS])
{
    double half = (upper - lower) / 2;
    for (int n = 0; n < SELF_CHECK_NODES; n++) {
        double share, of_line[SELF_CHECK_SUMS] = {0};
        X[axis] = (lower + upper) / 2 + half * self_check_node(n, &share);
        if (axis < 2 && axis + 1 < of->check->kind->dim) {
            integrate_along(of, axis + 1, of->body->lower[axis + 1], of->body->upper[axis + 1], X,
                            weight * half * share, of_line);
        } else {
            struct oracle_state state;
            of->check->kind->state(of->check->oracle, X, of->t, &state);
            of->integrand(of->body, &state, X, of->with, weight * half * share, of_line);
        }
        for (int i = 0; i < SELF_CHECK_SUMS; i++) {
            sum[i] += of_line[i];
        }
    }
}

static void integrate_along_radii(const struct integral *of, double longest, double sum[SELF_CHECK_SUMS])
{
    const struct shell *shell = of->check->shell;
    int cuts = (int)fmax(1, ceil((shell->outer - shell->inner) / longest));
    for (int i = 0; i < RADII * cuts * SELF_CHECK_NODES; i++) {
        size_t radius = (size_t)(i / (cuts * SELF_CHECK_NODES));
        double share, X[3], node = self_check_node(i % SELF_CHECK_NODES, &share);
        double part[3] = {(i / SELF_CHECK_NODES % cuts + (1 + node) / 2) / cuts, self_check_sequence(radius, 1),
                          self_check_sequence(radius, 2)};
        double weight = shell_place(shell, part, 0, X) * share / 2 / cuts / RADII;
        struct oracle_state state;
        of->check->kind->state(of->check->oracle, X, of->t, &state);
        of->integrand(of->body, &state, X, of->with, weight, sum);
    }
}

void self_check_integrate(const struct self_check *check, const struct self_check_body *body, double t, double longest,
                          self_check_integrand *integrand, const void *with, double sum[SELF_CHECK_SUMS])
{
    double place[SELF_CHECK_PLACES], X[3] = {0, 0, 0};
    struct integral of = {check, body, t, integrand, with};
    size_t count = self_check_places(check, body, t, place);
    for (int i = 0; i < SELF_CHECK_SUMS; i++) {
        sum[i] = count == 0 ? NAN : 0;
    }
    if (check->shell != NULL) {
        integrate_along_radii(&of, longest, sum);
        return;
    }
    for (size_t i = 0; i + 1 < count; i++) {
        double from = place[i], length = place[i + 1] - from;
        int cuts = (int)fmax(1, ceil(length / longest));
        for (int cut = 0; cut < cuts; cut++) {
            integrate_along(&of, 0, from + length * cut / cuts, from + length * (cut + 1) / cuts, X, 1, sum);
        }
    }
}
