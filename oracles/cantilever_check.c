/* The laws that the cantilever's fields must satisfy, by differences and integrals of the fields as they are given.
 *
 * A Ritz solution satisfies clamp and symmetry exactly. The equation of motion and the free faces it satisfies the
 * better the higher the degree of its polynomials; at the corners of the clamp the stress is singular and the degree
 * low. So what is differentiated lies two heights from the clamp and one from the free end, or further. What remains
 * there, and between two meshes of other grading and degrees, is RITZ at most: for the source's plate 4e-8. */
#include "oracles/cantilever.h"
#include "oracles/plate_check.h"

#include <float.h>
#include <math.h>

static const double PI = 3.14159265358979323846;

enum { SAMPLES = 64, FACE_SAMPLES = 32 };
static const double RITZ = 5e-7;
static const double REACH = 0.8; /* of the height: what is looked at on the free end, away from its corners */

static double amplitude(const struct oracle *o)
{
    return fabs(o->given.tip_velocity) / o->frequency;
}

/* Strain across the plate: none in plane strain; in plane stress what leaves P_zz = 0. */
static double across(const struct self_check *check, const double G[9])
{
    double lambda = check->bulk - 2 * check->mu / 3;
    return check->oracle->plane_stress ? -lambda / (lambda + 2 * check->mu) * (G[0] + G[4]) : 0;
}

enum law { VELOCITY, MOMENTUM, GRADIENT, STRESS, MOTION, MIRROR_U, MIRROR_V, MIRROR_P, LAWS };

/* What u, v and P look like from the other side of y = 0: some components change sign. */
static void mirror(struct oracle_state *s)
{
    s->u[0] = -s->u[0];
    s->v[0] = -s->v[0];
    for (int i = 0; i < 9; i += 4) {
        s->P[i] = -s->P[i];
    }
}

static void differentiate(struct self_check *check, size_t i, struct self_check_distance law[LAWS])
{
    struct oracle_state state, other, along[4];
    struct self_check_spot spot = self_check_sample(check, i, SELF_CHECK_REACH);
    double momentum[3], divergence[3] = {0}, G[9] = {0}, own[9], P[9];
    check->kind->state(check->oracle, spot.X, spot.t, &state);
    self_check_derivative(check, &spot, 3, &along[3]);
    for (int j = 0; j < 2; j++) {
        self_check_derivative(check, &spot, j, &along[j]);
        for (int k = 0; k < 3; k++) {
            G[3 * k + j] = along[j].u[k];
            divergence[k] += along[j].P[3 * k + j];
            self_check_largest(&law[MOTION].size, &along[j].P[3 * k + j], 1);
        }
    }
    for (int k = 0; k < 9; k++) {
        own[k] = state.F[k] - (k % 4 == 0 ? 1 : 0);
    }
    G[8] = across(check, G);
    for (int k = 0; k < 3; k++) {
        momentum[k] = check->rho * state.v[k];
    }
    self_check_hooke(check->bulk, check->mu, own, P);
    self_check_measure(&law[VELOCITY], state.v, along[3].u, 3);
    self_check_measure(&law[MOMENTUM], state.p, momentum, 3);
    self_check_measure(&law[GRADIENT], own, G, 9);
    self_check_measure(&law[STRESS], state.P, P, 9);
    self_check_measure(&law[MOTION], along[3].p, divergence, 3);
    spot.X[1] = -spot.X[1];
    check->kind->state(check->oracle, spot.X, spot.t, &other);
    mirror(&other);
    self_check_measure(&law[MIRROR_U], state.u, other.u, 3);
    self_check_measure(&law[MIRROR_V], state.v, other.v, 3);
    self_check_measure(&law[MIRROR_P], state.P, other.P, 9);
}

/* Sets the scales, which those that follow use. */
static void differentials(struct self_check *check)
{
    struct self_check_distance law[LAWS] = {0};
    check->of = (struct self_check_scale){.u = amplitude(check->oracle), .v = fabs(check->oracle->given.tip_velocity)};
    for (size_t i = 0; i < SAMPLES; i++) {
        differentiate(check, i, law);
    }
    double in_time = 16 * self_check_round_off(check) / SELF_CHECK_STEP, local = 64 * DBL_EPSILON;
    check->of.gradient = law[GRADIENT].size;
    check->of.stress = law[STRESS].size;
    self_check_line(check, "v = du/dt", self_check_relative(law[VELOCITY].error, check->of.v), in_time);
    self_check_line(check, "p = rho v", self_check_relative(law[MOMENTUM].error, law[MOMENTUM].size), 4 * DBL_EPSILON);
    self_check_line(check, "F = I + du/dX", law[GRADIENT].error / self_check_gradient_scale(check, RITZ), RITZ);
    self_check_line(check, "P = Hooke(F)",
                    law[STRESS].error / ((check->bulk + 4 * check->mu / 3) * self_check_gradient_scale(check, local)),
                    local);
    self_check_line(check, "dp/dt = Div P", self_check_relative(law[MOTION].error, law[MOTION].size), RITZ);
    double mirrored = self_check_relative(law[MIRROR_U].error, check->of.u);
    mirrored = self_check_worse(mirrored, self_check_relative(law[MIRROR_V].error, check->of.v));
    mirrored = self_check_worse(mirrored, self_check_relative(law[MIRROR_P].error, check->of.stress));
    self_check_line(check, "mirror image", mirrored, local);
}

/* Point i of a face of the body; of the faces along X where it is differentiated. */
static void face_point(const struct self_check *check, size_t i, int axis, double at, double X[3], double *t)
{
    const struct plate *g = &check->oracle->given;
    X[0] = check->lower[0] + self_check_sequence(i, 0) * (check->upper[0] - check->lower[0]);
    X[1] = (self_check_sequence(i, 1) - 0.5) * (at > 0 ? REACH : 1) * g->height;
    X[2] = 0;
    X[axis] = at;
    *t = self_check_sequence(i, 3) * check->t_end;
}

static void faces(struct self_check *check)
{
    const struct plate *g = &check->oracle->given;
    static const char *const law[] = {"displacement on X0", "traction on X1", "traction on Y0", "traction on Y1"};
    const double at[] = {0, g->length, -g->height / 2, g->height / 2};
    for (int face = 0; face < 4; face++) {
        double largest = 0, X[3], t;
        int axis = face / 2;
        for (size_t i = 0; i < FACE_SAMPLES; i++) {
            struct oracle_state state;
            face_point(check, i, axis, at[face], X, &t);
            check->kind->state(check->oracle, X, t, &state);
            for (int k = 0; k < 3; k++) {
                self_check_largest(&largest, face == 0 ? &state.u[k] : &state.P[3 * k + axis], 1);
            }
        }
        self_check_line(check, law[face], self_check_relative(largest, face == 0 ? check->of.u : check->of.stress),
                        face == 0 ? 16 * DBL_EPSILON : RITZ);
    }
}

/* The same mode by other elements, with the frequency that these give. */
static void second(const struct self_check *check, const double X[3], double t, struct oracle_state *state)
{
    const struct oracle *o = check->oracle;
    const struct plate *g = &o->given;
    double half = g->height / 2, u[2], gradient[4], G[9] = {0}, phase = o->second_frequency * t;
    ritz_evaluate(&o->second, X[0] / half, X[1] / half, u, gradient);
    *state = (struct oracle_state){.F = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    for (int i = 0; i < 2; i++) {
        state->u[i] = g->tip_velocity / o->second_frequency * sin(phase) * u[i];
        state->v[i] = g->tip_velocity * cos(phase) * u[i];
        state->p[i] = check->rho * state->v[i];
        for (int j = 0; j < 2; j++) {
            G[3 * i + j] = g->tip_velocity / o->second_frequency * sin(phase) * gradient[2 * i + j] / half;
            state->F[3 * i + j] += G[3 * i + j];
        }
    }
    G[8] = across(check, G);
    state->F[8] += G[8];
    self_check_hooke(check->bulk, check->mu, G, state->P);
}

/* Per volume [J/m^3]. */
static struct plate_energies density(const struct self_check *check, const double X[3], double t)
{
    struct oracle_state s;
    check->kind->state(check->oracle, X, t, &s);
    return (struct plate_energies){.kinetic = (s.p[0] * s.v[0] + s.p[1] * s.v[1] + s.p[2] * s.v[2]) / 2,
                                   .strain = self_check_complementary(check->bulk, check->mu, s.P)};
}

/* Over the upper half, which a line of its own shows to be the mirror image of the lower, element by element. */
static struct plate_energies quadrature(const struct self_check *check, double t)
{
    const struct axis *x = &check->oracle->solution.mode.x, *y = &check->oracle->solution.mode.y;
    double half = check->oracle->given.height / 2;
    struct plate_energies sum = {0};
    for (int cell = 0; cell < x->elements * y->elements; cell++) {
        const double *a = &x->node[cell / y->elements], *b = &y->node[cell % y->elements];
        for (int n = 0; n < SELF_CHECK_NODES * SELF_CHECK_NODES; n++) {
            double along, across;
            double X[3] = {half * (a[0] + (a[1] - a[0]) * (1 + self_check_node(n / SELF_CHECK_NODES, &along)) / 2),
                           half * (b[0] + (b[1] - b[0]) * (1 + self_check_node(n % SELF_CHECK_NODES, &across)) / 2), 0};
            struct plate_energies e = density(check, X, t);
            double weight = 2 * half * half * (a[1] - a[0]) / 2 * along * (b[1] - b[0]) / 2 * across;
            sum.kinetic += weight * e.kinetic;
            sum.strain += weight * e.strain;
        }
    }
    return sum;
}

size_t cantilever_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                        size_t size)
{
    const struct plate *g = &oracle->given;
    double half = g->height / 2;
    /* Two radians per half height: end effects decay with 3.7 of them, bending waves are longer. */
    struct self_check check = {.kind = kind,
                               .oracle = oracle,
                               .lower = {2 * g->height, -half},
                               .upper = {g->length - g->height, half},
                               .t_end = 2 * PI / oracle->frequency,
                               .wave_number = 2 / half,
                               .frequency = oracle->frequency,
                               .bulk = g->E / (3 * (1 - 2 * g->nu)),
                               .mu = g->E / (2 * (1 + g->nu)),
                               .rho = g->rho,
                               .line = line,
                               .size = size};
    differentials(&check);
    plate_check_starts(&check, g);
    faces(&check);
    self_check_compare(&check, second, RITZ);
    plate_check_energies(&check, quadrature, RITZ / 4);
    return check.count;
}
