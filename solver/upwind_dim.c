#include "solver/upwind.h"

#include "solver/dim_flops.h"
#include "solver/dim_sums.h"

#include <math.h>

/* sum_b (f_b - f_a) w_ab of a vector field, weights [pairs] with the given stride. */
static inline struct tensor vector_gradient(const struct solver_upwind *work, size_t a, const double *field,
                                            const double *weights, size_t stride)
{
    struct tensor G = {{{0}}};
    vec f_a = load(field + a * LANES);
    for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
        const double *w = weights + ab * stride;
        vec difference = load(field + (size_t)work->neighbour[ab] * LANES) - f_a;
        for (int I = 0; I < DIM; I++) {
            G.column[I] += difference * w[I];
        }
    }
    return G;
}

/* The same of the stress: DIM tensors, derivative along each reference axis, scaled. */
static inline void stress_gradient(const struct solver_upwind *work, size_t a, const double *weights, size_t stride,
                                   double scale)
{
    struct tensor G[DIM] = {{{{0}}}};
    struct tensor P_a = load_tensor(work->P + a * TENSOR);
    for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
        const double *w = weights + ab * stride;
        const double *P_b = work->P + (size_t)work->neighbour[ab] * TENSOR;
        for (int column = 0; column < DIM; column++) {
            vec difference = load(P_b + column * LANES) - P_a.column[column];
            for (int I = 0; I < DIM; I++) {
                G[I].column[column] += difference * w[I];
            }
        }
    }
    for (int I = 0; I < DIM; I++) {
        for (int column = 0; column < DIM; column++) {
            store(work->P_gradient + (a * DIM + (size_t)I) * TENSOR + column * LANES, scale * G[I].column[column]);
        }
    }
}

static inline vec scalar_gradient(const struct solver_upwind *work, size_t a, const double *field,
                                  const double *weights, size_t stride)
{
    vec G = {0};
    for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
        double difference = field[work->neighbour[ab]] - field[a];
        for (int I = 0; I < DIM; I++) {
            G[I] += difference * weights[ab * stride + (size_t)I];
        }
    }
    return G;
}

static void gradients(const struct solver_upwind *work, size_t begin, size_t end)
{
    for (size_t a = begin; a < end; a++) {
        double half_per_V = 0.5 / work->V[a];
        struct tensor G = vector_gradient(work, a, work->v, work->pair, PAIR);
        for (int I = 0; I < DIM; I++) {
            store(work->F_rate + a * TENSOR + I * LANES, G.column[I] * half_per_V);
        }
        store(work->x_rate + a * LANES, load(work->v + a * LANES));
        if (work->v_gradient != NULL) {
            store_tensor(work->v_gradient + a * TENSOR, vector_gradient(work, a, work->v, work->least_squares, DIM));
        }
        const double *weights = work->least_squares != NULL ? work->least_squares : work->pair;
        size_t stride = work->least_squares != NULL ? DIM : PAIR;
        double scale = work->least_squares != NULL ? 1.0 : half_per_V;
        if (work->pressure_gradient != NULL) {
            store(work->pressure_gradient + a * LANES,
                  scale * scalar_gradient(work, a, work->pressure, weights, stride));
        }
        if (work->P_gradient != NULL) {
            stress_gradient(work, a, weights, stride, scale);
        }
    }
}

/* Impedances of a pair: z v jumps in the acoustic Riemann problem of eq. 27, 28, with 2 z_a z_b / (z_a + z_b) where
 * materials meet. */
struct impedances {
    double p, s;
};

static inline struct impedances pair_impedances(const struct solver_material_constants *of_a,
                                                const struct solver_material_constants *of_b)
{
    return (struct impedances){.p = 2.0 * of_a->zp * of_b->zp / (of_a->zp + of_b->zp),
                               .s = 2.0 * of_a->zs * of_b->zs / (of_a->zs + of_b->zs)};
}

/* Upwind flux of momentum across the pair: A S (p+ - p-), twice (eq. 27, 28), from the jump of velocity, with the
 * states reconstructed at mid-distance. n is the unit of `along`, x_b - x_a, which is not normalised: n (n . jump) =
 * along (along . jump) / |along|^2. */
static inline vec momentum_flux(struct impedances z, vec jump, vec along, double face)
{
    double normal;
    double square;
    dot_and_square(along, jump, &normal, &square);
    return face * (z.s * jump + ((z.p - z.s) * normal / square) * along);
}

/* Reconstructed jump of the stress times the pair's distance, (P+ - P-) d (eq. 27, 34). */
static inline vec traction_jump(const struct solver_upwind *work, size_t a, size_t b, vec distance, bool reconstruct)
{
    vec traction = {0};
    for (int I = 0; I < DIM; I++) {
        vec jump = load(work->P + b * TENSOR + I * LANES) - load(work->P + a * TENSOR + I * LANES);
        if (reconstruct) {
            for (int K = 0; K < DIM; K++) {
                vec slope = load(work->P_gradient + (a * DIM + (size_t)K) * TENSOR + I * LANES) +
                            load(work->P_gradient + (b * DIM + (size_t)K) * TENSOR + I * LANES);
                jump -= (0.5 * distance[K]) * slope;
            }
        }
        traction += jump * distance[I];
    }
    return traction;
}

/* Reconstructed jump of the volumetric stress U'(J). */
static inline double pressure_jump(const struct solver_upwind *work, size_t a, size_t b, vec distance, bool reconstruct)
{
    double jump = work->pressure[b] - work->pressure[a];
    if (reconstruct) {
        vec slope = load(work->pressure_gradient + a * LANES) + load(work->pressure_gradient + b * LANES);
        jump -= 0.5 * dot(slope, distance);
    }
    return jump;
}

/* Upwind flux of J (eq. 27, 28, 30, 33), times 2 z_p: A (n . (P+ - P-) N) (n . H^Ave N). Eq. 33 as printed has the
 * sign that would feed energy in; this is that of eq. 30. A N stands for C_ab, as in the flux of p. By default only the
 * volumetric part U'(J) H of the stress jumps: J is conjugate to it alone, so that without reconstruction the flux
 * cannot feed energy in, and its gradient is a vector instead of a third-order tensor. */
static inline double volume_flux(const struct solver_upwind *work, size_t a, size_t b, vec distance, vec along,
                                 double face, bool reconstruct)
{
    vec area = distance;
    if (!work->frozen) {
        area = (vec){0};
        for (int I = 0; I < DIM; I++) {
            area += (load(work->cofactor + a * TENSOR + I * LANES) + load(work->cofactor + b * TENSOR + I * LANES)) *
                    (0.5 * distance[I]);
        }
    }
    double normal = dot(along, area);
    double traction = work->whole_jump ? dot(along, traction_jump(work, a, b, distance, reconstruct))
                                       : normal * pressure_jump(work, a, b, distance, reconstruct);
    return face * traction * normal / (dot(along, along) * dot(distance, distance));
}

/* What the scene asks for, as constants where the sums are called, so that each combination is a loop of its own. */
struct terms {
    bool frozen, reconstruct, transposed, volume, composite;
};

static inline __attribute__((always_inline)) struct sums sum_pairs(const struct solver_upwind *work, size_t a,
                                                                   struct terms terms)
{
    struct sums sums = {.volume = 0.0};
    const double *slope = work->v_gradient != NULL ? work->v_gradient : work->F_rate;
    const struct solver_material_constants *of_a = work->constants + a * work->stride;
    struct impedances z = {of_a->zp, of_a->zs};
    bool placed = terms.frozen || terms.reconstruct || terms.volume; /* else X need not be there */
    vec X_a = placed ? load(work->X + a * LANES) : (vec){0};
    vec x_a = load((terms.frozen ? work->X : work->x) + a * LANES);
    vec v_a = load(work->v + a * LANES);
    struct tensor slope_a = load_tensor(slope + a * TENSOR);
    for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
        size_t b = work->neighbour[ab];
        const double *C = work->pair + ab * PAIR;
        const double *D = terms.transposed ? work->transposed + ab * DIM : C;
        const double *P_b = work->P + b * TENSOR;
        vec distance = placed ? load(work->X + b * LANES) - X_a : (vec){0};
        vec along = terms.frozen ? distance : load(work->x + b * LANES) - x_a;
        vec jump = load(work->v + b * LANES) - v_a;
        bool alike = true;
        if (terms.composite) {
            const struct solver_material_constants *of_b = work->constants + b;
            z = pair_impedances(of_a, of_b);
            alike = of_a->kappa == of_b->kappa; /* where materials meet the volumetric stress has a jump of its own */
        }
        for (int I = 0; I < DIM; I++) {
            sums.force += load(P_b + I * LANES) * D[I];
            if (terms.reconstruct) {
                jump += (load(slope + b * TENSOR + I * LANES) + slope_a.column[I]) * (-0.5 * distance[I]);
            }
        }
        sums.dissipation += momentum_flux(z, jump, along, C[DIM]);
        if (terms.volume && alike) {
            sums.volume += volume_flux(work, a, b, distance, along, C[DIM], terms.reconstruct);
        }
    }
    return sums;
}

static inline __attribute__((always_inline)) void rates_with(const struct solver_upwind *work, size_t begin, size_t end,
                                                             struct terms terms)
{
    for (size_t a = begin; a < end; a++) {
        finish(work, a, sum_pairs(work, a, terms));
    }
}

static void rates(const struct solver_upwind *work, size_t begin, size_t end)
{
    bool plain = work->reconstruct && work->transposed == NULL && work->stride == 0;
    bool volume = work->evolves_J;
    if (plain && work->frozen && !volume) {
        rates_with(work, begin, end, (struct terms){.frozen = true, .reconstruct = true});
    } else if (plain && work->frozen) {
        rates_with(work, begin, end, (struct terms){.frozen = true, .reconstruct = true, .volume = true});
    } else if (plain && !volume) {
        rates_with(work, begin, end, (struct terms){.reconstruct = true});
    } else if (plain) {
        rates_with(work, begin, end, (struct terms){.reconstruct = true, .volume = true});
    } else { /* rare: not worth a loop each */
        rates_with(work, begin, end,
                   (struct terms){.frozen = work->frozen,
                                  .reconstruct = work->reconstruct,
                                  .transposed = work->transposed != NULL,
                                  .volume = volume,
                                  .composite = work->stride != 0});
    }
}

static void stresses(const struct solver_upwind *work, size_t begin, size_t end)
{
    if (work->cofactor != NULL && !work->evolves_H) {
        for (size_t a = begin; a < end; a++) {
            store_tensor(work->cofactor + a * TENSOR, cofactor(load_tensor(work->F + a * TENSOR)));
        }
    }
    if (work->pressure != NULL) {
        work->material->volumetric_range(work->constants, work->stride, begin, end, work->J, work->pressure);
    }
    if (work->flown != NULL) {
        work->material->flow->stress_range(work->constants, work->stride, work->hardening, begin, end, work->F,
                                           work->cofactor, work->J, work->flown_before, work->flown, work->P);
    } else {
        work->material->stress_range(work->constants, work->stride, begin, end, work->F, work->cofactor, work->J,
                                     work->P);
    }
}

static size_t first_broken(const struct solver_upwind *work, size_t begin, size_t end)
{
    for (size_t a = begin; a < end; a++) {
        vec v = load(work->v + a * LANES);
        struct tensor F = load_tensor(work->F + a * TENSOR);
        double J = work->J != NULL ? work->J[a] : determinant(F);
        bool inverted = !work->frozen && !(J > 0.0);
        if (inverted || !isfinite(J) || !isfinite(dot(v, v)) || !isfinite(contract(F, F))) {
            return a;
        }
    }
    return end;
}

static void measures(bool linear, size_t begin, size_t end, const double *F, double *H, double *J)
{
    for (size_t a = begin; a < end; a++) {
        struct tensor at = load_tensor(F + a * TENSOR);
        struct tensor one = identity();
        struct tensor cof = cofactor(at);
        double jacobian = determinant(at);
        if (linear) {
            for (int I = 0; I < DIM; I++) {
                at.column[I] -= one.column[I];
            }
            struct tensor change = tensor_cross(one, at);
            /* below 3D tensor_cross is the whole in-plane cofactor of its argument's change as well */
            for (int I = 0; I < DIM; I++) {
                cof.column[I] = one.column[I] + change.column[I];
            }
            jacobian = 1.0 + trace(at);
        }
        if (H != NULL) {
            store_tensor(H + a * TENSOR, cof);
        }
        if (J != NULL) {
            J[a] = jacobian;
        }
    }
}

/* --- operations (cost.h) --- */

static void gradient_terms(const struct solver_upwind *work, size_t count, struct solver_cost_terms *terms)
{
    double pairs = (double)work->row[count];
    double particles = (double)count;
    double of_vector = pairs * (LANES + FLOPS_ADD_SCALED);
    bool own = work->least_squares != NULL;
    solver_cost_term(terms, "gradient of v, rate of F", 1, of_vector + particles * (1.0 + FLOPS_TENSOR));
    if (work->v_gradient != NULL) {
        solver_cost_term(terms, "gradient of v by least squares", 1, of_vector);
    }
    if (work->pressure_gradient != NULL) {
        solver_cost_term(terms, own ? "gradient of U'(J) by least squares" : "gradient of U'(J)", 1,
                         pairs * (1.0 + 2.0 * DIM) + particles * LANES);
    }
    if (work->P_gradient != NULL) {
        solver_cost_term(terms, own ? "gradient of P by least squares" : "gradient of P", 1,
                         pairs * DIM * (LANES + FLOPS_ADD_SCALED) + particles * DIM * FLOPS_TENSOR);
    }
}

/* Of one pair: what reconstruction takes from the jump of a vector along each axis. */
enum { RECONSTRUCTION = DIM * (3 * LANES + 1) };

static void volume_terms(const struct solver_upwind *work, double pairs, struct solver_cost_terms *terms)
{
    double area = work->frozen ? 0.0 : RECONSTRUCTION; /* of the same form */
    double jump = work->whole_jump ? 3.0 * FLOPS_TENSOR + FLOPS_DOT : 2.0;
    double slope = work->whole_jump ? DIM * RECONSTRUCTION : LANES + FLOPS_DOT + 2.0;
    solver_cost_term(terms, "dissipation of J", 2, pairs * (area + FLOPS_DOT + jump + 5.0 + 2.0 * FLOPS_DOT));
    solver_cost_term(terms, "reconstruction for J", 2, work->reconstruct ? pairs * slope : 0.0);
}

static void rate_terms(const struct solver_upwind *work, size_t count, struct solver_cost_terms *terms)
{
    double pairs = (double)work->row[count];
    double vectors = 1.0 + (work->X != NULL ? 1.0 : 0.0) + (work->frozen ? 0.0 : 1.0); /* jump, distance, along */
    double flux = FLOPS_DOT_AND_SQUARE + 5.0 * LANES + 3.0;
    solver_cost_term(terms, "internal force", 2, pairs * FLOPS_ADD_SCALED);
    solver_cost_term(terms, "dissipation of p", 2, pairs * (vectors * LANES + flux));
    solver_cost_term(terms, "reconstruction for p", 2, work->reconstruct ? pairs * RECONSTRUCTION : 0.0);
    solver_cost_term(terms, "impedances where materials meet", 2, work->stride != 0 ? pairs * 8.0 : 0.0);
    if (work->evolves_J) {
        volume_terms(work, pairs, terms);
    }
}

/* What a particle's dissipation takes, and dW/dJ, a difference of two energies, for that of J. */
static double flops_of_lost(const struct solver_upwind *work)
{
    const struct solver_material *material = work->material;
    double energy = work->flown != NULL ? material->flow->energy_flops : material->energy_flops;
    double linear = work->frozen ? 2.0 * FLOPS_TENSOR + FLOPS_TENSOR_CROSS + FLOPS_TRACE + 1.0 : 0.0;
    double by_J = FLOPS_COFACTOR + FLOPS_DETERMINANT + linear + 2.0 * energy + 6.0;
    return FLOPS_DOT + 3.0 + (work->evolves_J ? by_J + 2.0 : 0.0);
}

static void particle_terms(const struct solver_upwind *work, size_t count, struct solver_cost_terms *terms)
{
    double particles = (double)count;
    const struct solver_material *material = work->material;
    bool cofactor = work->cofactor != NULL;
    bool flows = work->flown != NULL;
    int stress = flows ? material->flow->stress_flops(cofactor, work->J != NULL)
                       : material->stress_flops(cofactor, work->J != NULL);
    int fastest = flows ? material->flow->fastest_flops : material->fastest_flops;
    solver_cost_term(terms, "rate of v", 0, particles * (3.0 + FLOPS_ADD_SCALED + 2.0 * LANES));
    if (work->evolves_J) {
        solver_cost_term(terms, "rate of J", 0, particles * (4.0 + (work->frozen ? FLOPS_TRACE : FLOPS_CONTRACT)));
    }
    if (work->evolves_H) {
        solver_cost_term(terms, "rate of H", 0, particles * FLOPS_TENSOR_CROSS);
    } else if (cofactor) {
        solver_cost_term(terms, "cofactor of F", 0, particles * FLOPS_COFACTOR);
    }
    if (work->pressure != NULL) {
        solver_cost_term(terms, "U'(J)", 0, particles * material->volumetric_flops);
    }
    if (work->lost != NULL) {
        solver_cost_term(terms, "power lost", 0, particles * flops_of_lost(work));
    }
    solver_cost_term(terms, flows ? "stress and plastic flow" : "stress", 0, particles * stress);
    solver_cost_once(terms, "length of the step", particles * fastest);
    solver_cost_once(terms, "whether the state is whole",
                     particles * (FLOPS_DOT + FLOPS_CONTRACT + (work->J != NULL ? 0.0 : FLOPS_DETERMINANT)));
}

const struct solver_upwind_loops DIM_NAME(solver_upwind) = {
    .lanes = LANES,
    .gradients = gradients,
    .rates = rates,
    .stresses = stresses,
    .first_broken = first_broken,
    .gradient_terms = gradient_terms,
    .rate_terms = rate_terms,
    .particle_terms = particle_terms,
    .measures = measures,
};
