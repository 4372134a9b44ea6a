#include "oracles/self_check.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { SAMPLES = 64, FACE_SAMPLES = 32, ENERGY_SAMPLES = 8 };
enum { NUMBERS = sizeof(struct oracle_state) / sizeof(double) };
enum { REACH = 4 }; /* of the eighth-order differences, in steps */

/* How far two evaluations are apart, and how large they are. */
struct distance {
    double error, size;
};

/* The larger of two, where NaN is larger than anything. */
static double worse(double a, double b)
{
    return isnan(a) || a > b ? a : b;
}

static void compare(struct distance *d, const double *a, const double *b, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        d->error = worse(d->error, fabs(a[i] - b[i]));
        d->size = worse(d->size, worse(fabs(a[i]), fabs(b[i])));
    }
}

static void largest(double *size, const double *a, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        *size = worse(*size, fabs(a[i]));
    }
}

/* Nothing may be off where everything is zero. */
static double relative(double error, double scale)
{
    return error == 0 && scale == 0 ? 0 : error / scale;
}

static void add(struct self_check *check, const char *law, double residual, double bound)
{
    if (check->count < check->size) {
        check->line[check->count] = (struct oracle_check){.law = law, .residual = residual, .bound = bound};
    }
    check->count++;
}

/* Relative error of two evaluations of the same field at the same point: round-off times the phase, in radians, that
 * the fastest wave has run through. */
static double round_off(const struct self_check *check)
{
    return DBL_EPSILON * (1 + check->frequency * check->t_end);
}

/* The differences divide the round-off by the step; the factor leaves room for the sum of eight terms. */
static double derivative_bound(const struct self_check *check)
{
    return 16 * round_off(check) / SELF_CHECK_STEP;
}

static double step_along(const struct self_check *check, int axis)
{
    return SELF_CHECK_STEP / (axis == 3 ? check->frequency : check->wave_number);
}

/* Halton's sequence: the digits of i + 1 in a prime base of its own per axis, mirrored at the point. */
static double sequence(size_t i, int axis)
{
    static const size_t base[4] = {2, 3, 5, 7};
    double x = 0, digit = 1;
    for (size_t rest = i + 1; rest > 0; rest /= base[axis]) {
        digit /= (double)base[axis];
        x += digit * (double)(rest % base[axis]);
    }
    return x;
}

/* Point i of the sequence, at least `steps` steps of the differences from the ends of body and time. */
static void sample(const struct self_check *check, size_t i, int steps, double X[3], double *t)
{
    for (int axis = 0; axis < 3; axis++) {
        double margin = steps * step_along(check, axis);
        double room = check->upper[axis] - check->lower[axis] - 2 * margin;
        X[axis] = axis < check->kind->dim ? check->lower[axis] + margin + sequence(i, axis) * room : 0;
    }
    double margin = steps * step_along(check, 3);
    *t = margin + sequence(i, 3) * (check->t_end - 2 * margin);
}

static void evaluate(const struct self_check *check, const double X[3], double t, struct oracle_state *state)
{
    check->kind->state(check->oracle, X, t, state);
}

/* Of every field, along axis 0, 1, 2 (X, Y, Z) or 3 (t); reaches REACH steps to either side. */
static void derivative(const struct self_check *check, const double X[3], double t, int axis,
                       struct oracle_state *along)
{
    static const double weight[REACH] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    double step = step_along(check, axis), sum[NUMBERS] = {0};
    for (int k = 0; k < REACH; k++) {
        double value[2][NUMBERS];
        for (int side = 0; side < 2; side++) {
            struct oracle_state state;
            double shift = (side == 0 ? -1 : 1) * (k + 1) * step;
            double Y[3] = {X[0], X[1], X[2]};
            if (axis < 3) {
                Y[axis] += shift;
            }
            evaluate(check, Y, axis == 3 ? t + shift : t, &state);
            memcpy(value[side], &state, sizeof state);
        }
        for (size_t n = 0; n < NUMBERS; n++) {
            sum[n] += weight[k] * (value[1][n] - value[0][n]) / step;
        }
    }
    memcpy(along, sum, sizeof *along);
}

/* P = K tr(e) I + 2 mu dev(e), e = (G + G^T)/2. */
static void hooke(const struct self_check *check, const double G[9], double P[9])
{
    double trace = G[0] + G[4] + G[8];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            P[3 * i + j] =
                check->mu * (G[3 * i + j] + G[3 * j + i]) + (i == j ? (check->bulk - 2 * check->mu / 3) * trace : 0);
        }
    }
}

static void displacement_gradient(const double F[9], double G[9])
{
    for (int i = 0; i < 9; i++) {
        G[i] = F[i] - (i % 4 == 0 ? 1 : 0);
    }
}

/* F is stored with its unit matrix, whose round-off hides that much of a small gradient, in each of two evaluations. */
static double gradient_scale(const struct self_check *check, double bound)
{
    return check->of.gradient + 2 * DBL_EPSILON / bound;
}

/* The five laws at one point, added to their distances. */
static void differentiate(struct self_check *check, size_t i, struct distance law[5])
{
    struct oracle_state state, along[4];
    double X[3], t, momentum[3], divergence[3] = {0}, G[9] = {0}, own[9], P[9];
    sample(check, i, REACH, X, &t);
    evaluate(check, X, t, &state);
    derivative(check, X, t, 3, &along[3]);
    for (int j = 0; j < check->kind->dim; j++) {
        derivative(check, X, t, j, &along[j]);
        for (int k = 0; k < 3; k++) {
            G[3 * k + j] = along[j].u[k];
            divergence[k] += along[j].P[3 * k + j];
        }
    }
    for (int k = 0; k < 3; k++) {
        momentum[k] = check->rho * state.v[k];
    }
    displacement_gradient(state.F, own);
    hooke(check, G, P);
    compare(&law[0], state.v, along[3].u, 3);
    compare(&law[1], state.p, momentum, 3);
    compare(&law[2], own, G, 9);
    compare(&law[3], state.P, P, 9);
    compare(&law[4], along[3].p, divergence, 3);
    largest(&check->of.u, state.u, 3);
    largest(&check->of.v, along[3].u, 3);
    largest(&check->of.gradient, G, 9);
}

void self_check_differentials(struct self_check *check)
{
    struct distance law[5] = {0};
    check->of = (struct self_check_scale){0};
    for (size_t i = 0; i < SAMPLES; i++) {
        differentiate(check, i, law);
    }
    check->of.stress = (check->bulk + 4 * check->mu / 3) * check->of.gradient;
    double bound = derivative_bound(check);
    add(check, "v = du/dt", relative(law[0].error, law[0].size), bound);
    add(check, "p = rho v", relative(law[1].error, law[1].size), 4 * DBL_EPSILON);
    add(check, "F = I + du/dX", law[2].error / gradient_scale(check, bound), bound);
    add(check, "P = Hooke(du/dX)", relative(law[3].error, check->of.stress), bound);
    add(check, "dp/dt = Div P", relative(law[4].error, law[4].size), bound);
}

void self_check_starts(struct self_check *check, self_check_initial *initial)
{
    struct distance displacement = {0}, velocity = {0};
    for (size_t i = 0; i < SAMPLES; i++) {
        struct oracle_state state;
        double X[3], t, u[3], v[3];
        sample(check, i, 0, X, &t);
        evaluate(check, X, 0, &state);
        initial(check->oracle, X, u, v);
        compare(&displacement, state.u, u, 3);
        compare(&velocity, state.v, v, 3);
    }
    add(check, "initial displacement", relative(displacement.error, check->of.u), 16 * DBL_EPSILON);
    add(check, "initial velocity", relative(velocity.error, check->of.v), 16 * DBL_EPSILON);
}

void self_check_face(struct self_check *check, int axis, bool upper, const bool held[3])
{
    static const char *const displacement[3][2] = {{"displacement on X0", "displacement on X1"},
                                                   {"displacement on Y0", "displacement on Y1"},
                                                   {"displacement on Z0", "displacement on Z1"}};
    static const char *const traction[3][2] = {{"traction on X0", "traction on X1"},
                                               {"traction on Y0", "traction on Y1"},
                                               {"traction on Z0", "traction on Z1"}};
    double moved = 0, loaded = 0;
    for (size_t i = 0; i < FACE_SAMPLES; i++) {
        struct oracle_state state;
        double X[3], t;
        sample(check, i, 0, X, &t);
        X[axis] = upper ? check->upper[axis] : check->lower[axis];
        evaluate(check, X, t, &state);
        for (int k = 0; k < 3; k++) {
            largest(held[k] ? &moved : &loaded, held[k] ? &state.u[k] : &state.P[3 * k + axis], 1);
        }
    }
    if (held[0] || held[1] || held[2]) {
        add(check, displacement[axis][upper], relative(moved, check->of.u), 16 * DBL_EPSILON);
    }
    if (!held[0] || !held[1] || !held[2]) {
        add(check, traction[axis][upper], relative(loaded, check->of.stress), 16 * DBL_EPSILON);
    }
}

void self_check_compare(struct self_check *check, self_check_second *second)
{
    struct distance u = {0}, v = {0}, p = {0}, F = {0}, P = {0};
    for (size_t i = 0; i < SAMPLES; i++) {
        struct oracle_state state, other;
        double X[3], t;
        sample(check, i, 0, X, &t);
        evaluate(check, X, t, &state);
        second(check->oracle, X, t, &other);
        compare(&u, state.u, other.u, 3);
        compare(&v, state.v, other.v, 3);
        compare(&p, state.p, other.p, 3);
        compare(&F, state.F, other.F, 9);
        compare(&P, state.P, other.P, 9);
    }
    double bound = 16 * round_off(check);
    add(check, "second evaluation: u", relative(u.error, check->of.u), bound);
    add(check, "second evaluation: v", relative(v.error, check->of.v), bound);
    add(check, "second evaluation: p", relative(p.error, check->rho * check->of.v), bound);
    add(check, "second evaluation: F", F.error / gradient_scale(check, bound), bound);
    add(check, "second evaluation: P", relative(P.error, check->of.stress), bound);
}

struct energies {
    double kinetic, strain;
};

/* Energy densities [J/m^3]: p.v/2, and dev(P):dev(P)/(4 mu) + tr(P)^2/(18 K). */
static struct energies density(const struct self_check *check, const double X[3], double t)
{
    struct oracle_state state;
    struct energies e = {0};
    evaluate(check, X, t, &state);
    double trace = state.P[0] + state.P[4] + state.P[8];
    for (int i = 0; i < 9; i++) {
        double dev = state.P[i] - (i % 4 == 0 ? trace / 3 : 0);
        e.strain += dev / (4 * check->mu) * dev;
    }
    e.strain += trace / (18 * check->bulk) * trace;
    for (int i = 0; i < 3; i++) {
        e.kinetic += state.p[i] * state.v[i] / 2;
    }
    return e;
}

/* Product of ten-point Gauss-Legendre rules over the axes from `axis` on. */
static struct energies quadrature(const struct self_check *check, double X[3], double t, int axis)
{
    static const double node[5] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845,
                                   0.9739065285171717};
    static const double weight[5] = {0.2955242247147529, 0.2692667193099963, 0.2190863625159820, 0.1494513491505806,
                                     0.0666713443086881};
    if (axis == 3 || axis == check->kind->dim) {
        return density(check, X, t);
    }
    struct energies sum = {0};
    double middle = (check->lower[axis] + check->upper[axis]) / 2, half = (check->upper[axis] - check->lower[axis]) / 2;
    for (int n = 0; n < 10; n++) {
        X[axis] = middle + (n % 2 == 0 ? -half : half) * node[n / 2];
        struct energies inner = quadrature(check, X, t, axis + 1);
        sum.kinetic += half * weight[n / 2] * inner.kinetic;
        sum.strain += half * weight[n / 2] * inner.strain;
    }
    return sum;
}

void self_check_energies(struct self_check *check)
{
    struct distance kinetic = {0}, strain = {0}, total = {0};
    double first = 0;
    for (size_t i = 0; i < ENERGY_SAMPLES; i++) {
        struct energies given;
        double X[3], t;
        sample(check, i, 0, X, &t);
        t = i == 0 ? 0 : t;
        check->kind->energy(check->oracle, t, &given.kinetic, &given.strain);
        memset(X, 0, sizeof X);
        struct energies summed = quadrature(check, X, t, 0);
        double sum = given.kinetic + given.strain;
        first = i == 0 ? sum : first;
        compare(&kinetic, &given.kinetic, &summed.kinetic, 1);
        compare(&strain, &given.strain, &summed.strain, 1);
        compare(&total, &sum, &first, 1);
    }
    double bound = 64 * DBL_EPSILON;
    add(check, "total energy constant", relative(total.error, total.size), bound);
    add(check, "kinetic energy = quadrature", relative(kinetic.error, total.size), bound);
    add(check, "strain energy = quadrature", relative(strain.error, total.size), bound);
}
