/* The self-check of manufactured solutions. Nothing of it knows a derivative by formula: fields are differentiated by
 * central differences of eighth order, the stress is held against the strain energy, and the balance of power over the
 * whole body is the second evaluation, by quadrature of energies, body force and tractions. */
#include "verify/manufactured.h"

#include <float.h>
#include <gsl/gsl_integration.h>
#include <math.h>

enum { SAMPLES = 24, REACH = 4, POINTS = 14, COMPONENTS = 9 };

/* Of the differences, as a part of L / pi and period / 2 pi. Motions hold waves up to some six times as short, so the
 * truncation error is (6 STEP)^8 / 630. */
static const double STEP = 0.02;
static const double TRUNCATION = 1e-10;

struct check {
    const struct oracle_kind *kind;
    const struct oracle *oracle;
    const struct verify_manufactured_body *body;
    struct oracle_check *line;
    size_t size, count;
    double noise;        /* relative error of the fields' own digits, F being stored with its unit matrix */
    double energy_noise; /* likewise of a strain energy that is a small difference of invariants of F */
};

/* How far two things are apart, and how large they are. */
struct distance {
    double error, size;
};

static double worse(double a, double b)
{
    return isnan(a) || isgreater(a, b) ? a : b;
}

static void compare(struct distance *d, const double *a, const double *b, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        d->error = worse(fabs(a[i] - b[i]), d->error);
        d->size = worse(fabs(b[i]), d->size);
    }
}

static void add_line(struct check *check, const char *law, double residual, double bound)
{
    if (check->count < check->size) {
        check->line[check->count] = (struct oracle_check){law, residual, bound};
    }
    check->count++;
}

static void add_distance(struct check *check, const char *law, struct distance d, double bound)
{
    add_line(check, law, d.error == 0 ? 0 : d.error / d.size, bound);
}

/* Place and time of a sample: Halton's sequence. */
static double sequence(size_t i, unsigned base)
{
    double value = 0, part = 1;
    for (size_t rest = i + 1; rest > 0; rest /= base) {
        part /= base;
        value += part * (double)(rest % base);
    }
    return value;
}

static void sample(const struct check *check, size_t i, double at[4])
{
    static const unsigned base[4] = {2, 3, 5, 7};
    for (int axis = 0; axis < 3; axis++) {
        at[axis] = axis < check->kind->dim ? check->body->shape.L * sequence(i, base[axis]) : 0;
    }
    at[3] = check->body->shape.period * sequence(i, base[3]);
}

/* A state as numbers, for differences. */
struct numbers {
    double u[COMPONENTS], v[COMPONENTS], P[COMPONENTS];
};

static struct numbers numbers_at(const struct check *check, const double at[4])
{
    struct oracle_state state;
    struct numbers out = {{0}, {0}, {0}};
    check->kind->state(check->oracle, at, at[3], &state);
    for (int i = 0; i < 3; i++) {
        out.u[i] = state.u[i];
        out.v[i] = state.v[i];
    }
    for (int i = 0; i < 9; i++) {
        out.P[i] = state.P[i];
    }
    return out;
}

static const double weight[REACH] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};

/* Derivative by X, Y, Z or t (axis 3). */
static struct numbers derivative(const struct check *check, const double at[4], int axis)
{
    const struct oracle_motion_shape *shape = &check->body->shape;
    double step = axis < 3 ? STEP * shape->L / M_PI : STEP * shape->period / (2 * M_PI);
    struct numbers sum = {{0}, {0}, {0}};
    for (int k = 1; k <= REACH; k++) {
        for (int side = -1; side <= 1; side += 2) {
            double there[4] = {at[0], at[1], at[2], at[3]};
            there[axis] += side * k * step;
            struct numbers n = numbers_at(check, there);
            double w = side * weight[k - 1] / step;
            for (int i = 0; i < COMPONENTS; i++) {
                sum.u[i] += w * n.u[i];
                sum.v[i] += w * n.v[i];
                sum.P[i] += w * n.P[i];
            }
        }
    }
    return sum;
}

/* Laws of motion at one point. */
static void check_motion(struct check *check, const double at[4], struct distance law[5])
{
    int dim = check->kind->dim;
    double rho = check->body->constants.rho;
    double value[ORACLE_EXTRAS] = {0}, F[9], p[3], divergence[3] = {0}, force[3], unit[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    struct oracle_state state;
    check->kind->state(check->oracle, at, at[3], &state);
    check->kind->extras(check->oracle, at, at[3], value);
    struct numbers by_t = derivative(check, at, 3);
    for (int i = 0; i < 9; i++) {
        F[i] = unit[i];
        state.F[i] -= unit[i];
    }
    for (int I = 0; I < dim; I++) {
        struct numbers along = derivative(check, at, I);
        for (int i = 0; i < 3; i++) {
            F[3 * i + I] += along.u[i];
            divergence[i] += along.P[3 * i + I];
        }
    }
    for (int i = 0; i < 3; i++) {
        p[i] = rho * state.v[i];
        force[i] = rho * by_t.v[i] - divergence[i];
        law[4].size = worse(fabs(divergence[i]), worse(fabs(rho * by_t.v[i]), law[4].size));
    }
    for (int i = 0; i < 9; i++) {
        F[i] -= unit[i];
    }
    compare(&law[0], by_t.u, state.v, 3);
    compare(&law[1], state.p, p, 3);
    compare(&law[2], F, state.F, 9);
    compare(&law[4], value, force, (size_t)dim);
}

/* P against differences of W by every component of F. */
static void check_stress(const struct check *check, const double at[4], struct distance *law)
{
    const struct verify_manufactured_body *body = check->body;
    int dim = body->of.dim;
    struct oracle_state state;
    check->kind->state(check->oracle, at, at[3], &state);
    for (int i = 0; i < dim; i++) {
        for (int I = 0; I < dim; I++) {
            double largest = 0, slope = 0, step = 1e-2;
            if (verify_manufactured_flows(body)) { /* W has a kink where flow begins: not to reach so far */
                struct verify_measures here;
                verify_manufactured_measures(body, state.F, &here);
                step = fmin(step, 0.05 * verify_manufactured_strain(body, &here));
            }
            for (int k = -REACH; k <= REACH; k++) {
                double F[9], plastic;
                struct verify_measures measures;
                for (int j = 0; j < 9; j++) {
                    F[j] = state.F[j] + (j == 3 * i + I ? k * step : 0);
                }
                verify_manufactured_measures(body, F, &measures);
                double W = verify_manufactured_energy(body, &measures, &plastic);
                W += plastic;
                slope += k == 0 ? 0 : (k > 0 ? 1 : -1) * weight[(k > 0 ? k : -k) - 1] / step * W;
                largest = worse(fabs(W), largest);
            }
            compare(law, &state.P[3 * i + I], &slope, 1);
            law->size = worse(law->size, largest); /* W's own digits are what the differences have */
        }
    }
}

/* The stress out of the plane or line, by the material in three dimensions. */
static void check_normal(const struct check *check, const double at[4], struct distance *law)
{
    struct verify_manufactured_body whole = *check->body;
    struct verify_measures measures;
    struct oracle_state state;
    double P[9], none;
    whole.of.dim = 3;
    whole.material = whole.of.model->in[2];
    check->kind->state(check->oracle, at, at[3], &state);
    verify_manufactured_measures(&whole, state.F, &measures);
    verify_manufactured_stress(&whole, &measures, P, &none);
    compare(law, state.P, P, 9);
}

/* Whether volumes are as they must be: positive, or kept. */
static void check_volume(struct check *check)
{
    double smallest = INFINITY;
    struct distance kept = {0, 1};
    for (size_t i = 0; i < (size_t)SAMPLES * SAMPLES; i++) {
        double at[4];
        struct oracle_state state;
        sample(check, i, at);
        check->kind->state(check->oracle, at, at[3], &state);
        double J = oracle_jacobian(&state);
        smallest = isnan(J) || isless(J, smallest) ? J : smallest;
        kept.error = worse(fabs(J - 1), kept.error);
    }
    add_line(check, "det F > 0", smallest > 0 ? 0 : 1, 0.5);
    if (check->body->of.motion->isochoric) {
        add_distance(check, "det F = 1", kept, 64 * DBL_EPSILON);
    }
}

/* Powers [W], by Gauss-Legendre quadrature. */
struct powers {
    double force, inertia, stress, traction;
    double size; /* the integral of their magnitudes */
};

/* Place and weight of a point of the quadrature over the volume (face -1) or a face; false past the last. */
static bool quadrature(const struct check *check, const gsl_integration_glfixed_table *rule, int face, size_t point,
                       double X[4], double *w)
{
    double L = check->body->shape.L;
    *w = 1;
    for (int i = 0; i < check->kind->dim; i++) {
        double part = 1;
        if (face >= 0 && i == face / 2) {
            X[i] = face % 2 == 1 ? L : 0;
            continue;
        }
        gsl_integration_glfixed_point(0, L, point % POINTS, &X[i], &part, rule);
        point /= POINTS;
        *w *= part;
    }
    return point == 0;
}

/* The powers in the volume; gradients of the velocity and accelerations are differences. */
static void add_volume(const struct check *check, const gsl_integration_glfixed_table *rule, double t,
                       struct powers *sum)
{
    int dim = check->kind->dim;
    double X[4] = {0, 0, 0, t}, w;
    for (size_t point = 0; quadrature(check, rule, -1, point, X, &w); point++) {
        struct oracle_state state;
        double value[ORACLE_EXTRAS] = {0};
        check->kind->state(check->oracle, X, t, &state);
        check->kind->extras(check->oracle, X, t, value);
        struct numbers by_t = derivative(check, X, 3);
        double force = 0, inertia = 0, stress = 0;
        for (int I = 0; I < dim; I++) {
            struct numbers along = derivative(check, X, I);
            for (int i = 0; i < dim; i++) {
                stress += w * state.P[3 * i + I] * along.v[i];
            }
            force += w * value[I] * state.v[I];
            inertia += w * check->body->constants.rho * by_t.v[I] * state.v[I];
        }
        sum->force += force;
        sum->inertia += inertia;
        sum->stress += stress;
        sum->size += fabs(force) + fabs(inertia) + fabs(stress);
    }
}

static void add_face(const struct check *check, const gsl_integration_glfixed_table *rule, int face, double t,
                     struct powers *sum)
{
    double X[4] = {0, 0, 0, t}, w;
    for (size_t point = 0; quadrature(check, rule, face, point, X, &w); point++) {
        struct oracle_state state;
        check->kind->state(check->oracle, X, t, &state);
        for (int i = 0; i < check->kind->dim; i++) {
            double part = (face % 2 == 1 ? w : -w) * state.P[3 * i + face / 2] * state.v[i];
            sum->traction += part;
            sum->size += fabs(part);
        }
    }
}

/* The body as a whole: what forces and tractions do is what inertia and stress take, and the energies are theirs. */
static void check_power(struct check *check)
{
    const struct oracle_motion_shape *shape = &check->body->shape;
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(POINTS);
    double t = 0.37 * shape->period, step = STEP * shape->period / (2 * M_PI);
    double gain[2] = {0, 0};
    struct powers sum = {.size = rule != NULL ? 0 : NAN};
    for (int k = 1; k <= REACH; k++) {
        for (int side = -1; side <= 1; side += 2) {
            double kinetic, strain, plastic;
            verify_manufactured_energies(check->oracle, t + side * k * step, &kinetic, &strain, &plastic);
            check->kind->energy(check->oracle, t + side * k * step, &kinetic, &strain);
            gain[0] += side * weight[k - 1] / step * kinetic;
            gain[1] += side * weight[k - 1] / step * (strain + plastic);
        }
    }
    if (rule != NULL) {
        add_volume(check, rule, t, &sum);
    }
    for (int face = 0; rule != NULL && face < 2 * check->kind->dim; face++) {
        add_face(check, rule, face, t, &sum);
    }
    gsl_integration_glfixed_table_free(rule);
    double bound = 10 * TRUNCATION + 16 * check->noise / STEP;
    add_line(check, "second evaluation: balance of power",
             fabs(sum.force + sum.traction - sum.inertia - sum.stress) / sum.size, bound);
    add_line(check, "gain of kinetic energy = power of inertia", fabs(gain[0] - sum.inertia) / sum.size, bound);
    add_line(check, "gain of strain energy = power of stress", fabs(gain[1] - sum.stress) / sum.size,
             bound + check->energy_noise / STEP);
}

size_t verify_manufactured_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                                 size_t size)
{
    struct check check = {.kind = kind,
                          .oracle = oracle,
                          .body = (const struct verify_manufactured_body *)oracle,
                          .line = line,
                          .size = size};
    struct distance law[6] = {{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}};
    for (size_t i = 0; i < SAMPLES; i++) {
        double at[4];
        sample(&check, i, at);
        check_motion(&check, at, law);
        check_stress(&check, at, &law[3]);
        check_normal(&check, at, &law[5]);
    }
    double strain = fmin(law[2].size, 1);
    check.noise = DBL_EPSILON * (1 + 1 / strain);
    check.energy_noise = kind->finite_strain ? 16 * DBL_EPSILON / (strain * strain) : 0;
    double bound = TRUNCATION + 16 * check.noise / STEP;
    add_distance(&check, "v = du/dt", law[0], bound);
    add_distance(&check, "p = rho v", law[1], 4 * DBL_EPSILON);
    add_distance(&check, "F = I + du/dX", law[2], bound);
    add_distance(&check, "P = dW/dF", law[3], 1e-9);
    add_distance(&check, "P as in three dimensions", law[5], 64 * check.noise);
    add_distance(&check, "rho dv/dt = Div P + f0", law[4], bound);
    check_volume(&check);
    check_power(&check);
    return check.count;
}
