#include "oracles/self_check_parts.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { SAMPLES = 64, FACE_SAMPLES = 32, ENERGY_SAMPLES = 8 };

/* The differences divide the round-off by the step; the factor leaves room for the sum of eight terms. */
static double derivative_bound(const struct self_check *check)
{
    return 16 * self_check_round_off(check) / SELF_CHECK_STEP;
}

static void evaluate(const struct self_check *check, const struct self_check_spot *spot, struct oracle_state *state)
{
    check->kind->state(check->oracle, spot->X, spot->t, state);
}

static void displacement_gradient(const double F[9], double G[9])
{
    for (int i = 0; i < 9; i++) {
        G[i] = F[i] - (i % 4 == 0 ? 1 : 0);
    }
}

/* A shorter step divides the round-off by less: the error counts as much less. */
static void measure_derivative(struct self_check_distance *d, double step, const double *a, const double *b,
                               size_t count)
{
    struct self_check_distance here = {0};
    self_check_measure(&here, a, b, count);
    d->error = self_check_worse(d->error, step * here.error);
    d->size = self_check_worse(d->size, here.size);
}

/* v and P / (rho c) are half the sum and half the difference of two waves, so either has the round-off of the larger:
 * raises the scales of all that follow from them. A drift of the whole body is no wave. */
static void raise_to_wave(struct self_check *check, const struct self_check_spot *spot,
                          const struct oracle_state *state, struct self_check_distance law[5])
{
    double c = self_check_speed(&spot->body), Z = spot->body.rho * c, stress = fabs(state->P[0]);
    if (check->drift == 0) {
        stress = self_check_worse(stress, Z * fabs(state->v[0]));
    }
    law[0].size = self_check_worse(law[0].size, stress / Z);
    law[4].size = self_check_worse(law[4].size, check->frequency / c * stress);
    check->of.v = self_check_worse(check->of.v, stress / Z);
    check->of.gradient = self_check_worse(check->of.gradient, stress / (Z * c));
    check->of.stress = self_check_worse(check->of.stress, stress);
}

/* The five laws at one point, added to their distances. */
static void differentiate(struct self_check *check, size_t i, struct self_check_distance law[5])
{
    struct oracle_state state, along[4];
    struct self_check_spot spot = self_check_sample(check, i, SELF_CHECK_REACH);
    double momentum[3], divergence[3] = {0}, G[9] = {0}, own[9], P[9], gradient = 0;
    evaluate(check, &spot, &state);
    self_check_derivative(check, &spot, 3, &along[3]);
    for (int j = 0; j < check->kind->dim; j++) {
        self_check_derivative(check, &spot, j, &along[j]);
        for (int k = 0; k < 3; k++) {
            G[3 * k + j] = along[j].u[k];
            divergence[k] += along[j].P[3 * k + j];
        }
    }
    for (int k = 0; k < 3; k++) {
        momentum[k] = spot.body.rho * state.v[k];
    }
    displacement_gradient(state.F, own);
    if (check->material != NULL) {
        check->material->stress(check, spot.X, spot.t, G, P);
    } else {
        self_check_hooke(spot.body.bulk, spot.body.mu, G, P);
    }
    measure_derivative(&law[0], spot.step, state.v, along[3].u, 3);
    self_check_measure(&law[1], state.p, momentum, 3);
    measure_derivative(&law[2], spot.step, own, G, 9);
    measure_derivative(&law[3], spot.step, state.P, P, 9);
    measure_derivative(&law[4], spot.step, along[3].p, divergence, 3);
    self_check_largest(&gradient, G, 9);
    self_check_largest(&check->of.u, state.u, 3);
    self_check_largest(&check->of.v, along[3].u, 3);
    check->of.gradient = self_check_worse(gradient, check->of.gradient);
    check->of.stress = self_check_worse(self_check_modulus(&spot.body) * gradient, check->of.stress);
    if (check->kind->finite_strain && check->kind->fronts == NULL) { /* its stress may be that of inertia */
        self_check_largest(&check->of.stress, state.P, 9);
    }
    if (check->kind->fronts != NULL) {
        raise_to_wave(check, &spot, &state, law);
    }
}

void self_check_differentials(struct self_check *check)
{
    struct self_check_distance law[5] = {0};
    check->of = check->least;
    law[0].size = check->least.v;
    law[4].size = check->least.stress * check->wave_number;
    for (size_t i = 0; i < SAMPLES; i++) {
        differentiate(check, i, law);
    }
    double bound = derivative_bound(check);
    self_check_line(check, "v = du/dt", self_check_relative(law[0].error, law[0].size), bound);
    self_check_line(check, "p = rho v", self_check_relative(law[1].error, law[1].size), 4 * DBL_EPSILON);
    self_check_line(check, "F = I + du/dX", law[2].error / self_check_gradient_scale(check, bound), bound);
    self_check_line(check, check->material != NULL ? check->material->law : "P = Hooke(du/dX)",
                    self_check_relative(law[3].error, check->of.stress), bound);
    self_check_line(check, "dp/dt = Div P", self_check_relative(law[4].error, law[4].size), bound);
}

void self_check_starts(struct self_check *check, self_check_initial *initial)
{
    struct self_check_distance displacement = {0}, velocity = {0};
    for (size_t i = 0; i < SAMPLES; i++) {
        struct oracle_state state;
        struct self_check_spot spot = self_check_sample_at(check, i, 0);
        double u[3], v[3];
        evaluate(check, &spot, &state);
        initial(check->oracle, spot.X, u, v);
        self_check_measure(&displacement, state.u, u, 3);
        self_check_measure(&velocity, state.v, v, 3);
    }
    self_check_line(check, "initial displacement", self_check_relative(displacement.error, check->of.u),
                    16 * DBL_EPSILON);
    self_check_line(check, "initial velocity", self_check_relative(velocity.error, check->of.v), 16 * DBL_EPSILON);
}

void self_check_face(struct self_check *check, int axis, bool upper, const bool held[3])
{
    static const char *const displacement[3][2] = {{"displacement on X0", "displacement on X1"},
                                                   {"displacement on Y0", "displacement on Y1"},
                                                   {"displacement on Z0", "displacement on Z1"}};
    static const char *const traction[3][2] = {{"traction on X0", "traction on X1"},
                                               {"traction on Y0", "traction on Y1"},
                                               {"traction on Z0", "traction on Z1"}};
    struct self_check_body body = self_check_body(check, upper ? self_check_bodies(check) - 1 : 0);
    double moved = 0, loaded = 0;
    for (size_t i = 0; i < FACE_SAMPLES; i++) {
        struct oracle_state state;
        struct self_check_spot spot = self_check_sample(check, i, 0);
        spot.X[axis] = upper ? body.upper[axis] : body.lower[axis];
        evaluate(check, &spot, &state);
        for (int k = 0; k < 3; k++) {
            self_check_largest(held[k] ? &moved : &loaded, held[k] ? &state.u[k] : &state.P[3 * k + axis], 1);
        }
    }
    if (held[0] || held[1] || held[2]) {
        self_check_line(check, displacement[axis][upper], self_check_relative(moved, check->of.u), 16 * DBL_EPSILON);
    }
    if (!held[0] || !held[1] || !held[2]) {
        self_check_line(check, traction[axis][upper], self_check_relative(loaded, check->of.stress), 16 * DBL_EPSILON);
    }
}

void self_check_free_surfaces(struct self_check *check, double bound)
{
    static const char *const law[2] = {"traction on the surface", "traction on the surface of the hole"};
    for (int hole = 0; hole < (check->shell->inner > 0 ? 2 : 1); hole++) {
        double loaded = 0, r = hole ? check->shell->inner : check->shell->outer;
        for (size_t i = 0; i < FACE_SAMPLES; i++) {
            struct oracle_state state;
            struct self_check_spot spot = self_check_sample(check, i, 0);
            double part[3] = {hole ? 0 : 1, self_check_sequence(i, 1), self_check_sequence(i, 2)};
            (void)shell_place(check->shell, part, 0, spot.X);
            evaluate(check, &spot, &state);
            for (int k = 0; k < 3; k++) {
                const double *P = state.P + (ptrdiff_t)3 * k;
                double traction = (P[0] * spot.X[0] + P[1] * spot.X[1] + P[2] * spot.X[2]) / r;
                self_check_largest(&loaded, &traction, 1);
            }
        }
        self_check_line(check, law[hole], self_check_relative(loaded, check->of.stress), bound);
    }
}

void self_check_compare(struct self_check *check, self_check_second *second, double bound)
{
    struct self_check_distance u = {0}, v = {0}, p = {0}, F = {0}, P = {0};
    for (size_t i = 0; i < SAMPLES; i++) {
        struct oracle_state state, other;
        struct self_check_spot spot = self_check_sample(check, i, 0);
        spot.t = check->instant != NULL ? check->instant[i % check->instants] : spot.t;
        evaluate(check, &spot, &state);
        second(check, spot.X, spot.t, &other);
        self_check_measure(&u, state.u, other.u, 3);
        self_check_measure(&v, state.v, other.v, 3);
        self_check_measure(&p, state.p, other.p, 3);
        self_check_measure(&F, state.F, other.F, 9);
        self_check_measure(&P, state.P, other.P, 9);
    }
    self_check_line(check, "second evaluation: u", self_check_relative(u.error, check->of.u), bound);
    self_check_line(check, "second evaluation: v", self_check_relative(v.error, check->of.v), bound);
    self_check_line(check, "second evaluation: p", self_check_relative(p.error, check->rho * check->of.v), bound);
    self_check_line(check, "second evaluation: F", F.error / self_check_gradient_scale(check, bound), bound);
    self_check_line(check, "second evaluation: P", self_check_relative(P.error, check->of.stress), bound);
}

struct moment {
    const struct self_check *check;
    double t;
};

/* Kinetic, p.v/2, and strain energy density. */
static void energy_density(const struct self_check_body *body, const struct oracle_state *state, const double X[3],
                           const void *with, double weight, double sum[SELF_CHECK_SUMS])
{
    const struct moment *at = with;
    const struct self_check_material *material = at->check->material;
    bool own = material != NULL && material->energy != NULL;
    for (int i = 0; i < 3; i++) {
        sum[0] += weight * state->p[i] * state->v[i] / 2;
    }
    sum[1] += weight * (own ? material->energy(at->check, X, at->t, state)
                            : self_check_complementary(body->bulk, body->mu, state->P));
}

void self_check_energies(struct self_check *check)
{
    struct self_check_distance kinetic = {0}, strain = {0}, total = {0};
    double first = 0, most = 0;
    for (size_t i = 0; i < ENERGY_SAMPLES; i++) {
        double given[2], summed[2] = {0, 0}, part = i == 0 ? 0 : self_check_sequence(i, 3);
        double t = check->t_free + part * (check->t_end - check->t_free);
        check->kind->energy(check->oracle, t, &given[0], &given[1]);
        for (int which = 0; which < self_check_bodies(check); which++) {
            struct self_check_body body = self_check_body(check, which);
            double sum[SELF_CHECK_SUMS];
            const struct moment at = {check, t};
            self_check_integrate(check, &body, t, self_check_radian(check, &body), energy_density, &at, sum);
            summed[0] += sum[0];
            summed[1] += sum[1];
        }
        double all = given[0] + given[1], fed = 0, lost = 0, passed = 0;
        if (check->supplied != NULL) {
            check->supplied(check, t, &fed, &lost, &passed);
        }
        first = i == 0 ? all - (fed - lost) : first;
        double due = first + (fed - lost);
        most = self_check_worse(most, passed);
        self_check_measure(&kinetic, &given[0], &summed[0], 1);
        self_check_measure(&strain, &given[1], &summed[1], 1);
        self_check_measure(&total, &all, &due, 1);
    }
    /* Fronts are placed with the round-off of the phase; a radius has as many terms as the phase along it is long. Work
     * is done along the whole path, which is known with that round-off. */
    double bound = check->shell != NULL          ? 4 * self_check_round_off(check)
                   : check->kind->fronts == NULL ? 64 * DBL_EPSILON
                                                 : 16 * self_check_round_off(check);
    double of_work = check->supplied != NULL ? fmax(bound, 4 * self_check_round_off(check)) : bound;
    self_check_line(check, check->supplied != NULL ? "total energy = work - dissipation" : "total energy constant",
                    self_check_relative(total.error, self_check_worse(total.size, most)), of_work);
    self_check_line(check, "kinetic energy = quadrature", self_check_relative(kinetic.error, total.size), bound);
    self_check_line(check, "strain energy = quadrature", self_check_relative(strain.error, total.size), bound);
}
