/* Plastic flow of every material that has it, in 1, 2 and 3 dimensions: return maps along paths of F. */
#include "tests/unit/materials.h"

#include <float.h>
#include <stdlib.h>

enum { MOST = 7, PATHS = 12 };

static const struct solver_hardening laws[] = {
    {.law = SOLVER_HARDENING_LINEAR, .yield = 2e5, .modulus = 3e6},
    {.law = SOLVER_HARDENING_SATURATION, .yield = 2e5, .modulus = 1e5, .saturation = 1e6, .rate = 20},
    {.law = SOLVER_HARDENING_POWER, .yield = 2e5, .strain = 0.01, .exponent = 0.3},
};
enum { LAWS = sizeof laws / sizeof *laws };

/* One particle that remembers. */
struct particle {
    const struct sample *sample;
    const struct solver_hardening *law;
    double memory[MOST], P[9];
};

static void pad(size_t dim, const double *rows, double *columns)
{
    size_t lanes = dim == 3 ? 4 : dim;
    memset(columns, 0, 12 * sizeof *columns);
    for (size_t k = 0; k < dim * dim; k++) {
        columns[k % dim * lanes + k / dim] = rows[k];
    }
}

/* One return map; `now` may be where it came from. */
static void respond(struct particle *at, const double *F, const double *before, double *now)
{
    size_t dim = at->sample->dim, lanes = dim == 3 ? 4 : dim;
    double from[MOST], columns[12] __attribute__((aligned(64))), stress[12] __attribute__((aligned(64)));
    memcpy(from, before, sizeof from);
    pad(dim, F, columns);
    at->sample->material->flow->stress_range(&at->sample->constants, 0, at->law, 0, 1, columns, NULL, NULL, from, now,
                                             stress);
    for (size_t k = 0; k < dim * dim; k++) {
        at->P[k] = stress[k % dim * lanes + k / dim];
    }
}

/* von Mises equivalent of the Kirchhoff stress, with the component out of the plane. */
static double kirchhoff(const struct particle *at, const double *F)
{
    size_t dim = at->sample->dim;
    double tau[9] = {0}, J = determinant_of(dim, F), square = 0;
    double normal = dim < 3 ? at->sample->material->flow->stress_normal(&at->sample->constants, F, J, at->memory) : 0.0;
    for (size_t k = 0; k < 9; k++) {
        size_t i = k / 3, j = k % 3;
        bool in_plane = i < dim && j < dim;
        tau[k] = i == j && !in_plane ? normal : 0.0; /* F = 1 there */
        for (size_t I = 0; in_plane && I < dim; I++) {
            tau[k] += at->P[i * dim + I] * F[j * dim + I];
        }
    }
    double mean = (tau[0] + tau[4] + tau[8]) / 3;
    for (size_t k = 0; k < 9; k++) {
        double deviator = tau[k] - (k % 4 == 0 ? mean : 0);
        square += deviator * deviator;
    }
    return sqrt(1.5 * square);
}

static void each_flow(void (*check)(struct particle *at))
{
    for (const struct solver_material_model *model = solver_material_models(); model->name != NULL; model++) {
        for (size_t dim = 1; model->in[0]->flow != NULL && dim <= 3; dim++) {
            for (size_t law = 0; law < LAWS; law++) {
                struct sample sample = {.name = model->name,
                                        .material = model->in[dim - 1],
                                        .in_3d = model->in[2],
                                        .constants = solver_material_constants(17e6, 0.3, 1100.0),
                                        .dim = dim};
                sample.modulus = sample.constants.mu + sample.constants.kappa;
                CU_ASSERT_FATAL(sample.material->flow->width <= MOST);
                for (int path = 0; path < PATHS; path++) {
                    struct particle at = {.sample = &sample, .law = &laws[law]};
                    check(&at);
                }
            }
        }
    }
}

/* Stress on or within the yield surface, the same if nothing changes, plastic strain that grows, elastic energy >= 0.
 */
static void on_the_surface(struct particle *at)
{
    size_t dim = at->sample->dim;
    bool flown = false;
    for (int i = 0; i < 6; i++) {
        double F[9], before = at->memory[0], P[9], memory[MOST];
        random_deformation(dim, F);
        respond(at, F, at->memory, at->memory);
        memcpy(P, at->P, sizeof P);
        memcpy(memory, at->memory, sizeof memory);
        double J = determinant_of(dim, F), yield = solver_hardening_stress(at->law, at->memory[0], NULL);
        double scale = at->sample->modulus + largest_entry(dim * dim, P);
        flown = flown || at->memory[0] > 0;
        expect(at->sample, "equivalent stress over the yield stress", kirchhoff(at, F) - yield, 1e-13 * scale);
        if (at->memory[0] > before) {
            expect(at->sample, "distance from the yield surface", fabs(kirchhoff(at, F) - yield), 1e-13 * scale);
        }
        expect(at->sample, "plastic strain that shrinks", before - at->memory[0], 0);
        expect(at->sample, "elastic energy, negated",
               -at->sample->material->flow->energy(&at->sample->constants, F, J, at->memory), 0);
        respond(at, F, at->memory, at->memory);
        expect(at->sample, "stress of the state it is in", largest_difference(dim * dim, at->P, P), 1e-13 * scale);
        expect(at->sample, "memory of the state it is in", largest_difference(MOST, at->memory, memory), 1e-13);
    }
    CU_ASSERT(flown);
}

/* det Cp^-1 = 1: what flows keeps its volume. */
static void keeps_volume(struct particle *at)
{
    size_t dim = at->sample->dim;
    for (int i = 0; i < 20; i++) {
        double F[9];
        const double *m = at->memory;
        random_deformation(dim, F);
        respond(at, F, at->memory, at->memory);
        double xx = 1 + m[1], yy = 1 + m[2];
        double determinant = dim == 1 ? xx * yy * yy
                             : dim == 2
                                 ? (xx * yy - m[3] * m[3]) * (1 + m[4])
                                 : xx * (yy * (1 + m[3]) - m[5] * m[5]) - m[4] * (m[4] * (1 + m[3]) - m[5] * m[6]) +
                                       m[6] * (m[4] * m[5] - yy * m[6]);
        double size = (1 + largest_entry(MOST, m)) * (1 + largest_entry(MOST, m)) * (1 + largest_entry(MOST, m));
        expect(at->sample, "det Cp^-1 - 1", fabs(determinant - 1), 1e-14 * (i + 1) * size);
    }
}

/* Where the yield surface is never met, the elastic material. */
static void elastic_within(struct particle *at)
{
    const struct solver_hardening never = {.yield = 1e30};
    size_t dim = at->sample->dim;
    double F[9], H[9], J, P[9];
    at->law = &never;
    random_deformation(dim, F);
    respond(at, F, at->memory, at->memory);
    stress(at->sample, F, P);
    measures(at->sample, F, H, &J);
    double scale = at->sample->modulus + largest_entry(dim * dim, P), W = energy(at->sample, F);
    expect(at->sample, "elastic stress", largest_difference(dim * dim, at->P, P), 1e-14 * scale);
    expect(at->sample, "memory of the virgin material", largest_entry(MOST, at->memory), 0);
    expect(at->sample, "elastic energy",
           fabs(at->sample->material->flow->energy(&at->sample->constants, F, J, at->memory) - W),
           1e-14 * (at->sample->modulus + W));
}

/* A body that turns as it deforms has the stress turned, and remembers the same. */
static void objective(struct particle *at)
{
    size_t dim = at->sample->dim;
    struct particle other = *at;
    for (int i = 0; i < 5; i++) {
        double F[9], R[9], turned[9], P[9];
        random_deformation(dim, F);
        random_rotation(dim, R);
        multiply(dim, R, F, turned);
        respond(at, F, at->memory, at->memory);
        respond(&other, turned, other.memory, other.memory);
        multiply(dim, R, at->P, P);
        double scale = at->sample->modulus + largest_entry(dim * dim, P);
        expect(at->sample, "turned stress", largest_difference(dim * dim, other.P, P), 1e-13 * (i + 1) * scale);
        expect(at->sample, "memory of the turned body", largest_difference(MOST, other.memory, at->memory),
               1e-13 * (i + 1) * (1 + largest_entry(MOST, at->memory)));
    }
}

/* Plane and uniaxial strain are the three-dimensional material with F the identity out of the plane. */
static void embedded(struct particle *at)
{
    static const size_t same[2][5] = {{0, 1, 3}, {0, 1, 2, 4, 3}}; /* where 3D has what is remembered in 1D and 2D */
    size_t dim = at->sample->dim;
    struct sample in_3d = *at->sample;
    if (dim == 3) {
        return;
    }
    in_3d.dim = 3;
    in_3d.material = in_3d.in_3d;
    struct particle other = {.sample = &in_3d, .law = at->law};
    for (int i = 0; i < 5; i++) {
        double F[9], whole[9], difference = 0;
        random_deformation(dim, F);
        for (size_t k = 0; k < 9; k++) {
            whole[k] = k / 3 < dim && k % 3 < dim ? F[k / 3 * dim + k % 3] : k % 4 == 0;
        }
        respond(at, F, at->memory, at->memory);
        respond(&other, whole, other.memory, other.memory);
        double normal =
            at->sample->material->flow->stress_normal(&at->sample->constants, F, determinant_of(dim, F), at->memory);
        for (size_t k = 0; k < 9; k++) {
            double expected = k / 3 < dim && k % 3 < dim ? at->P[k / 3 * dim + k % 3] : k % 4 == 0 ? normal : 0;
            difference = fmax(difference, fabs(other.P[k] - expected));
        }
        double scale = at->sample->modulus + largest_entry(9, other.P);
        expect(at->sample, "stress against 3D", difference, 1e-13 * (i + 1) * scale);
        for (size_t k = 0; k < at->sample->material->flow->width; k++) {
            size_t there = same[dim - 1][k];
            expect(at->sample, "memory against 3D", fabs(at->memory[k] - other.memory[there]),
                   1e-13 * (i + 1) * (1 + largest_entry(MOST, other.memory)));
        }
    }
}

/* F(s) of a path that turns as it goes: no return map is exact on it. */
static void path(size_t dim, double s, double *F)
{
    double A[9], turn[9];
    for (size_t k = 0; k < dim * dim; k++) {
        A[k] = (k % (dim + 1) == 0) + 0.15 * sin((1 + (double)k) * s + (double)(k * k)) - 0.15 * sin((double)(k * k));
    }
    unit_tensor(dim, turn);
    if (dim > 1) {
        turn[0] = turn[dim + 1] = cos(s);
        turn[1] = -(turn[dim] = sin(s));
    }
    multiply(dim, turn, A, F);
}

/* The state at the end of the path, and what the stress has done: by `steps` return maps. */
static double follow(struct particle *at, int steps, double *F)
{
    size_t dim = at->sample->dim;
    double work = 0, last[9], stress_before[9] = {0};
    memset(at->memory, 0, sizeof at->memory);
    unit_tensor(dim, last);
    for (int i = 1; i <= steps; i++) {
        path(dim, 1.0 * i / steps, F);
        respond(at, F, at->memory, at->memory);
        for (size_t k = 0; k < dim * dim; k++) {
            work += 0.5 * (at->P[k] + stress_before[k]) * (F[k] - last[k]);
        }
        memcpy(last, F, sizeof last);
        memcpy(stress_before, at->P, sizeof stress_before);
    }
    return work;
}

/* Work = elastic energy + plastic work, to first order in the step, and so is the stress: the return map is Euler's
 * implicit method, exact where the strain keeps its direction, as in 1D. */
static void balance(struct particle *at)
{
    size_t dim = at->sample->dim;
    double lost[3], P[3][9];
    for (int level = 0; level < 3; level++) {
        double F[9], work = follow(at, 400 << level, F);
        double W = at->sample->material->flow->energy(&at->sample->constants, F, determinant_of(dim, F), at->memory);
        lost[level] = fabs(work - W - solver_hardening_work(at->law, at->memory[0])) / work;
        memcpy(P[level], at->P, sizeof P[level]);
        CU_ASSERT(at->memory[0] > 0.02);
    }
    expect(at->sample, "energy balance", lost[2], 2e-3);
    expect(at->sample, "energy balance as steps are halved", lost[2] / lost[1], 0.55);
    double coarse = largest_difference(dim * dim, P[0], P[1]), fine = largest_difference(dim * dim, P[1], P[2]);
    if (dim > 1) {
        expect(at->sample, "stress as steps are halved", fabs(fine / coarse - 0.5), 0.05);
    } else {
        expect(at->sample, "stress where directions stay", fine, 1e-11 * at->sample->modulus);
    }
}

static void bound(struct particle *at)
{
    size_t dim = at->sample->dim;
    double columns[12] __attribute__((aligned(64))), F[9];
    const struct solver_flow *flow = at->sample->material->flow;
    unit_tensor(dim, F);
    pad(dim, F, columns);
    double rest = flow->fastest(&at->sample->constants, 0, 0, 1, columns, at->memory);
    expect(at->sample, "bound of the speeds at rest", fabs(rest / at->sample->constants.cp - 1), 1e-14);
    random_deformation(dim, F);
    respond(at, F, at->memory, at->memory);
    pad(dim, F, columns);
    double speed = flow->fastest(&at->sample->constants, 0, 0, 1, columns, at->memory);
    for (int i = 0; i < 30; i++) { /* the elastic response to a small change of F, by differences: rho c^2 = m.Q m */
        double N[3], m[3], ahead[9], behind[9], unused[MOST], Q = 0, size = 1e-6;
        const struct solver_hardening never = {.yield = 1e30};
        struct particle up = *at, down = *at;
        up.law = down.law = &never;
        random_direction(dim, N);
        random_direction(dim, m);
        for (size_t k = 0; k < dim * dim; k++) {
            ahead[k] = F[k] + size * m[k / dim] * N[k % dim];
            behind[k] = F[k] - size * m[k / dim] * N[k % dim];
        }
        respond(&up, ahead, at->memory, unused);
        respond(&down, behind, at->memory, unused);
        for (size_t k = 0; k < dim * dim; k++) {
            Q += m[k / dim] * N[k % dim] * (up.P[k] - down.P[k]) / (2 * size);
        }
        expect(at->sample, "elastic modulus over the bound", Q, at->sample->constants.rho * speed * speed * (1 + 1e-6));
    }
}

#define FOR_EACH(name, check)                                                                                          \
    static void name(void)                                                                                             \
    {                                                                                                                  \
        each_flow(check);                                                                                              \
    }
FOR_EACH(test_surface, on_the_surface)
FOR_EACH(test_volume, keeps_volume)
FOR_EACH(test_elastic, elastic_within)
FOR_EACH(test_objective, objective)
FOR_EACH(test_embedded, embedded)
FOR_EACH(test_balance, balance)
FOR_EACH(test_bound, bound)

int main(void)
{
    static const struct unit_test tests[] = {
        {"stress ends on the yield surface, and stays", test_surface},
        {"what flows keeps its volume", test_volume},
        {"within the yield surface the elastic material", test_elastic},
        {"objectivity", test_objective},
        {"one and two dimensions are three with F embedded", test_embedded},
        {"work is stored or dissipated; order of the return map", test_balance},
        {"the speed of elastic waves is bounded, exactly at rest", test_bound},
    };
    return unit_main("plastic flow", tests, sizeof tests / sizeof *tests);
}
