#include "solver/ulsph.h"

#include "solver/dim.h"
#include "solver/dim_flops.h"
#include "solver/dim_spectral.h"
#include "solver/interfaces.h"

#include <math.h>

enum { TENSOR = DIM * LANES, PAIR = DIM + 2, SLOPE = DIM, KERNEL = DIM + 1 };

/* The kernel's height: its integral is 1 (eq. 12 in 2D). */
static double normalisation(double h)
{
    const double pi = 3.14159265358979323846;
    const double of_unit[] = {3.0 / 4.0, 7.0 / (4.0 * pi), 21.0 / (16.0 * pi)};
    return of_unit[DIM - 1] / pow(h, DIM);
}

/* w (eq. 11) and s = -w' / r at q = r/h. */
static inline double kernel(double height, double h, double q, double *slope)
{
    double t = q < 2.0 ? 1.0 - 0.5 * q : 0.0;
    double cube = t * t * t;
    *slope = 5.0 * height * cube / (h * h);
    return height * cube * t * (2.0 * q + 1.0);
}

static inline vec pair_vector(const struct solver_ulsph *work, size_t ab)
{
    vec r = {0};
    for (int I = 0; I < DIM; I++) {
        r[I] = work->pair[ab * PAIR + (size_t)I];
    }
    return r;
}

/* T r */
static inline vec apply(struct tensor T, vec r)
{
    vec product = T.column[0] * r[0];
    for (int I = 1; I < DIM; I++) {
        product += T.column[I] * r[I];
    }
    return product;
}

/* A B */
static inline struct tensor times(struct tensor A, struct tensor B)
{
    struct tensor product;
    for (int I = 0; I < DIM; I++) {
        product.column[I] = apply(A, B.column[I]);
    }
    return product;
}

/* c0 = sqrt(K / rho0) (eq. 5) [m/s]. */
static inline double sound_speed(const struct solver_ulsph *work, size_t a)
{
    const struct solver_material_constants *of_a = work->constants + a * work->stride;
    return sqrt(of_a->kappa / of_a->rho);
}

static void volumes(const struct solver_ulsph *work, size_t begin, size_t end)
{
    for (size_t a = begin; a < end; a++) {
        work->volume[a] = work->mass[a] / work->rho[a];
        work->cell[a] = work->full_mass[a] / work->rho[a];
        if (work->root_rho != NULL) {
            work->root_rho[a] = sqrt(work->rho[a]);
            work->z[a] = sound_speed(work, a) * work->rho[a] * work->root_rho[a];
        }
    }
}

/* sigma = -p I + S (eq. 3). */
static inline struct tensor cauchy_stress(const struct solver_ulsph *work, size_t a)
{
    const struct solver_material_constants *of_a = work->constants + a * work->stride;
    double p = solver_ulsph_pressure(of_a, work->rho[a]);
    struct tensor sigma = load_tensor(work->S + a * TENSOR);
    for (int I = 0; I < DIM; I++) {
        sigma.column[I][I] -= p;
    }
    return sigma;
}

/* The inverse of the symmetric moment matrix sum_j V_j s r (x) r, whose size is that of I. A particle with too few
 * neighbours for one keeps the plain kernel. */
static inline struct tensor corrective_matrix(struct tensor M)
{
    double J = determinant(M);
    if (!(J > 1e-6)) {
        return identity();
    }
    struct tensor L = cofactor(M); /* of a symmetric matrix: the adjugate */
    for (int I = 0; I < DIM; I++) {
        L.column[I] /= J;
    }
    return L;
}

/* Whether a plane where materials meet (interfaces.h) lay between two particles: what is beyond the particles on it
 * belongs to another body, and its strain is another. Those that were far apart meet as two bodies do. */
static inline bool across(const struct solver_ulsph *work, size_t a, size_t b)
{
    const uint8_t *plane = work->interface;
    for (int I = 0; I < DIM; I++) {
        uint32_t of_a = work->site[a * DIM + (size_t)I];
        uint32_t of_b = work->site[b * DIM + (size_t)I];
        uint32_t last = of_a < of_b ? of_b : of_a;
        uint32_t first = of_a < of_b ? of_a : of_b;
        for (uint32_t i = first + 1; last - first < SOLVER_INTERFACES_APART && i < last; i++) {
            if (plane[i] != 0) {
                return true;
            }
        }
        plane += work->points[I];
    }
    return false;
}

/* What a particle gathers from its neighbours by way of the kernel. */
struct gathered {
    struct tensor M; /* sum V s r (x) r */
    vec smoothing;   /* of eq. 14, over epsilon */
    double colour;   /* eq. 52 */
};

/* Makes the pair records of a particle, and its sums. */
static inline struct gathered gather(const struct solver_ulsph *work, size_t a, double height)
{
    double per_h = 1.0 / work->h;
    vec x_a = load(work->x + a * LANES);
    vec v_a = load(work->v + a * LANES);
    struct gathered sums = {.colour = work->volume[a] * height};
    for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
        size_t b = work->neighbour[ab];
        double *pair = work->pair + ab * PAIR;
        vec r = load(work->x + b * LANES) - x_a;
        double slope;
        double w = kernel(height, work->h, sqrt(dot(r, r)) * per_h, &slope);
        if (work->interface != NULL && across(work, a, b)) {
            slope = 0.0;
            w = 0.0;
        }
        for (int I = 0; I < DIM; I++) {
            pair[I] = r[I];
            sums.M.column[I] += (work->cell[b] * slope * r[I]) * r;
        }
        pair[SLOPE] = slope;
        pair[KERNEL] = w;
        sums.colour += work->volume[b] * w;
        sums.smoothing += (2.0 * work->mass[b] * w / (work->rho[a] + work->rho[b])) * (load(work->v + b * LANES) - v_a);
    }
    return sums;
}

static void geometry(const struct solver_ulsph *work, size_t begin, size_t end)
{
    double height = normalisation(work->h);
    for (size_t a = begin; a < end; a++) {
        struct gathered sums = gather(work, a, height);
        struct tensor L = work->L != NULL ? corrective_matrix(sums.M) : identity();
        struct tensor sigma = cauchy_stress(work, a);
        store_tensor(work->sigma_L + a * TENSOR, times(sigma, L));
        if (work->L != NULL) {
            store_tensor(work->L + a * TENSOR, L);
        }
        if (work->tensile_L != NULL) {
            store_tensor(work->tensile_L + a * TENSOR, times(positive_part(sigma), L));
        }
        if (work->transport != work->v) {
            store(work->transport + a * LANES, load(work->v + a * LANES) + work->terms.xsph * sums.smoothing);
        }
        if (work->colour != NULL) {
            work->colour[a] = sums.colour;
        }
    }
}

enum { SURFACE_PERCENT = 90 }; /* of the colour (eq. 52) */

/* Whether the particle is within the body: neither on its surface nor next to a particle that is (section 3.4). */
static bool is_inner(const struct solver_ulsph *work, size_t a)
{
    double reach = 1.2 * work->spacing;
    bool inner = work->colour[a] >= SURFACE_PERCENT / 100.0;
    for (size_t ab = work->row[a]; inner && ab < work->row[a + 1]; ab++) {
        vec r = pair_vector(work, ab);
        inner = dot(r, r) >= reach * reach || work->colour[work->neighbour[ab]] >= SURFACE_PERCENT / 100.0;
    }
    return inner;
}

/* The same material: density diffuses within it only. */
static inline bool same_phase(const struct solver_ulsph *work, size_t a, size_t b)
{
    const struct solver_material_constants *of_a = work->constants + a * work->stride;
    const struct solver_material_constants *of_b = work->constants + b * work->stride;
    return work->stride == 0 || (of_a->rho == of_b->rho && of_a->kappa == of_b->kappa && of_a->mu == of_b->mu);
}

/* Rates of density and deviatoric stress from the gradient of the transport velocity (eq. 27, 6, 7). */
static inline void constitutive_rates(const struct solver_ulsph *work, size_t a, struct tensor G)
{
    double mu = work->constants[a * work->stride].mu;
    double divergence = trace(G);
    struct tensor T = transpose(G);
    struct tensor S = load_tensor(work->S + a * TENSOR);
    struct tensor spin;
    struct tensor rate;
    for (int I = 0; I < DIM; I++) {
        spin.column[I] = 0.5 * (G.column[I] - T.column[I]);
        rate.column[I] = mu * (G.column[I] + T.column[I]);
        rate.column[I][I] -= 2.0 / 3.0 * mu * divergence;
    }
    struct tensor turned = times(spin, S); /* Omega S - S Omega = Omega S + (Omega S)^T */
    struct tensor back = transpose(turned);
    for (int I = 0; I < DIM; I++) {
        rate.column[I] += turned.column[I] + back.column[I];
    }
    store_tensor(work->S_rate + a * TENSOR, rate);
    work->rho_rate[a] = -work->rho[a] * divergence;
}

static void gradients(const struct solver_ulsph *work, size_t begin, size_t end)
{
    for (size_t a = begin; a < end; a++) {
        struct tensor L = work->L != NULL ? load_tensor(work->L + a * TENSOR) : identity();
        vec transport_a = load(work->transport + a * LANES);
        vec v_a = load(work->v + a * LANES);
        struct tensor G = {{{0}}};
        struct tensor G_v = {{{0}}};
        vec G_rho = {0};
        for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
            size_t b = work->neighbour[ab];
            vec weight = (work->cell[b] * work->pair[ab * PAIR + SLOPE]) * pair_vector(work, ab);
            vec difference = load(work->transport + b * LANES) - transport_a;
            for (int I = 0; I < DIM; I++) {
                G.column[I] += difference * weight[I];
            }
            if (work->v_gradient != NULL) {
                vec jump = load(work->v + b * LANES) - v_a;
                for (int I = 0; I < DIM; I++) {
                    G_v.column[I] += jump * weight[I];
                }
            }
            if (work->rho_gradient != NULL && same_phase(work, a, b)) {
                G_rho += (work->rho[b] - work->rho[a]) * weight;
            }
        }
        constitutive_rates(work, a, times(G, L)); /* (du (x) g) L = du (x) L g: L is symmetric */
        store(work->x_rate + a * LANES, transport_a);
        if (work->v_gradient != NULL) {
            store_tensor(work->v_gradient + a * TENSOR, times(G_v, L));
        }
        if (work->rho_gradient != NULL) {
            store(work->rho_gradient + a * LANES, apply(L, G_rho));
        }
        if (work->inner != NULL) {
            work->inner[a] = is_inner(work, a) ? 1.0 : 0.0;
        }
    }
}

/* C_ij (u_j - u_i) |r| where materials meet. Roe's impedance (eq. 41) is that of the heavier side: it moves a light
 * particle at z_j / rho_i, faster than waves run by the ratio of densities. What one wave in either material carries is
 * C = 2 z_i z_j / (z_i + z_j), with z = rho c, by the acoustic Riemann problem; of equal materials it is theirs, as
 * eq. 41 is. Slopes jump there too, and that of a particle on the interface is a mean: both states are reconstructed by
 * the side whose slope leaves the smaller jump, smoothly, as in upwind_dim.c. */
static double pressure_of_meeting(const struct solver_ulsph *work, size_t a, size_t b, double jump, double slope_a,
                                  double slope_b)
{
    double z_a = work->z[a] / work->root_rho[a];
    double z_b = work->z[b] / work->root_rho[b];
    double by_a = jump - slope_a;
    double by_b = jump - slope_b;
    double squares = by_a * by_a + by_b * by_b;
    double approach = squares > 0.0 ? by_a * by_b * (by_a + by_b) / squares : 0.0;
    return 2.0 * z_a * z_b / (z_a + z_b) * approach;
}

/* Pi_ij of the artificial viscosity (eq. 16) or the Riemann term 2 C_ij (u_j - u_i) / (rho_i rho_j) (eq. 41, 43, 44).
 * The impedance z = c rho^(3/2) of eq. 41 is a particle's own. */
static inline double dissipation(const struct solver_ulsph *work, size_t a, size_t b, vec r, struct tensor G_a)
{
    double rho_a = work->rho[a];
    double rho_b = work->rho[b];
    double square = dot(r, r);
    vec jump = load(work->v + b * LANES) - load(work->v + a * LANES);
    if (work->v_gradient == NULL) { /* only the Riemann term has it */
        double approach = fmin(0.0, dot(jump, r));
        double c = 0.5 * (sound_speed(work, a) + sound_speed(work, b));
        return work->terms.viscosity * work->h * c * 2.0 / (rho_a + rho_b) * approach /
               (square + 0.01 * work->h * work->h);
    }
    struct tensor G_b = load_tensor(work->v_gradient + b * TENSOR);
    if (!same_phase(work, a, b)) {
        return 2.0 * pressure_of_meeting(work, a, b, dot(jump, r), dot(apply(G_a, r), r), dot(apply(G_b, r), r)) /
               (sqrt(square) * rho_a * rho_b);
    }
    jump -= 0.5 * (apply(G_a, r) + apply(G_b, r));
    double impedance = work->z[a] + work->z[b];
    double roots = work->root_rho[a] + work->root_rho[b];
    return 2.0 * impedance * dot(jump, r) / (sqrt(square) * rho_a * rho_b * roots);
}

/* x^n; n is 4 or 8 in the papers, and pow() costs more than all else that a pair does. */
static inline double power(double x, double n)
{
    if (n != floor(n)) {
        return pow(x, n);
    }
    double result = 1.0;
    for (unsigned left = (unsigned)n; left != 0; left /= 2) {
        result *= left % 2 != 0 ? x : 1.0;
        x *= x;
    }
    return result;
}

/* f_ij of the artificial stress (eq. 17), or what of it exceeds its value at the initial spacing. */
static inline double repulsion(const struct solver_ulsph *work, double w, double w_at_spacing)
{
    double f = power(w / w_at_spacing, work->terms.stress_exponent);
    return work->terms.stress_factor * (work->terms.repulsion == SOLVER_ULSPH_EXCESS ? fmax(0.0, f - 1.0) : f);
}

/* Force of one pair over s: V_i V_j (sigma_j L_j + sigma_i L_i) r with what tension asks for (eq. 51), sigma+ = -R.
 * Kernel sums are weighted by whole cells c, those of particles on a face included, and the force is the negative
 * adjoint of the gradient they make: V_i c_j takes the place of V_i V_j for sigma_i, V_j c_i for sigma_j. */
static inline vec pair_stress(const struct solver_ulsph *work, size_t a, size_t ab, vec r, double w_at_spacing)
{
    size_t b = work->neighbour[ab];
    double own = work->volume[a] * work->cell[b];
    double other = work->volume[b] * work->cell[a];
    vec force = other * apply(load_tensor(work->sigma_L + b * TENSOR), r) +
                own * apply(load_tensor(work->sigma_L + a * TENSOR), r);
    if (work->tensile_L != NULL) {
        vec tension = own * apply(load_tensor(work->tensile_L + a * TENSOR), r);
        if (work->inner != NULL && work->inner[a] != 0.0) {
            force -= 2.0 * tension;
        } else {
            tension += other * apply(load_tensor(work->tensile_L + b * TENSOR), r);
            force -= repulsion(work, work->pair[ab * PAIR + KERNEL], w_at_spacing) * tension;
        }
    }
    return force;
}

static void rates(const struct solver_ulsph *work, size_t begin, size_t end)
{
    double slope;
    double w_at_spacing = kernel(normalisation(work->h), work->h, work->spacing / work->h, &slope);
    for (size_t a = begin; a < end; a++) {
        vec acceleration = {0};
        double diffusion = 0.0;
        struct tensor G_a = {{{0}}};
        if (work->v_gradient != NULL) {
            G_a = load_tensor(work->v_gradient + a * TENSOR);
        }
        for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
            double s = work->pair[ab * PAIR + SLOPE];
            if (s == 0.0) {
                continue;
            }
            size_t b = work->neighbour[ab];
            vec r = pair_vector(work, ab);
            acceleration += (s / work->mass[a]) * pair_stress(work, a, ab, r, w_at_spacing);
            if (work->terms.dissipation != SOLVER_ULSPH_INVISCID) {
                acceleration += (work->mass[b] * s * dissipation(work, a, b, r, G_a)) * r;
            }
            if (work->rho_gradient != NULL && same_phase(work, a, b)) {
                vec G = load(work->rho_gradient + a * LANES) + load(work->rho_gradient + b * LANES);
                diffusion += (2.0 * (work->rho[b] - work->rho[a]) - dot(G, r)) * s * work->volume[b];
            }
        }
        store(work->v_rate + a * LANES, acceleration);
        if (work->rho_gradient != NULL) {
            work->rho_rate[a] += work->terms.delta * work->h * sound_speed(work, a) * diffusion;
        }
    }
}

static size_t first_broken(const struct solver_ulsph *work, size_t begin, size_t end)
{
    for (size_t a = begin; a < end; a++) {
        vec v = load(work->v + a * LANES);
        struct tensor S = load_tensor(work->S + a * TENSOR);
        if (!isfinite(dot(v, v)) || !isfinite(contract(S, S)) || !(work->rho[a] > 0.0) || !isfinite(work->rho[a])) {
            return a;
        }
    }
    return end;
}

/* --- operations (cost.h) --- */

enum { APPLY = (2 * DIM - 1) * LANES, TIMES = DIM * APPLY, SOUND = 2 };

static void geometry_terms(const struct solver_ulsph *work, double pairs, double particles,
                           struct solver_cost_terms *terms)
{
    double kernel_flops = LANES + FLOPS_DOT + 2.0 + 13.0;
    double moments = DIM * (2.0 + 2.0 * LANES);
    double positive = DIM == 1   ? 0.0
                      : DIM == 2 ? 10.0 + SOLVER_COST_FUNCTION + FLOPS_TENSOR
                                 : FLOPS_SPECTRUM_ALONE + DIM * DIM * (1.0 + 2.0 * LANES);
    solver_cost_term(terms, "pair records", 1, pairs * kernel_flops + particles * 2.0);
    solver_cost_term(terms, "corrective matrix L", 1,
                     pairs * moments +
                         (work->L != NULL ? particles * (FLOPS_DETERMINANT + FLOPS_COFACTOR + FLOPS_TENSOR) : 0.0));
    solver_cost_term(terms, "colour", 1, pairs * 2.0);
    solver_cost_term(terms, "transport velocity", 1,
                     pairs * (4.0 + 3.0 * LANES) + (work->transport != work->v ? particles * 2.0 * LANES : 0.0));
    solver_cost_term(terms, "stress", 0, particles * (3.0 + DIM + TIMES));
    solver_cost_term(terms, "tensile part of the stress", 0,
                     work->tensile_L != NULL ? particles * (positive + TIMES) : 0.0);
}

static void gradient_terms(const struct solver_ulsph *work, double pairs, double particles,
                           struct solver_cost_terms *terms)
{
    double of_vector = pairs * (LANES + FLOPS_ADD_SCALED) + particles * TIMES;
    solver_cost_term(terms, "gradient of the transport velocity", 2, pairs * (1.0 + LANES) + of_vector);
    solver_cost_term(terms, "gradient of v", 2, work->v_gradient != NULL ? of_vector : 0.0);
    solver_cost_term(terms, "gradient of rho", 2,
                     work->rho_gradient != NULL ? pairs * (1.0 + 2.0 * LANES) + particles * APPLY : 0.0);
    solver_cost_term(terms, "rates of rho and S", 0,
                     particles * (FLOPS_TRACE + 6.0 * FLOPS_TENSOR + 3.0 * DIM + TIMES + 1.0));
    solver_cost_term(terms, "whether a particle is within", 2,
                     work->inner != NULL ? pairs * (FLOPS_DOT + 1.0) + particles : 0.0);
}

static void rate_terms(const struct solver_ulsph *work, double pairs, double particles, struct solver_cost_terms *terms)
{
    double riemann = FLOPS_DOT + LANES + 2.0 * APPLY + 3.0 * LANES + 3.0 + FLOPS_DOT + 6.0;
    double viscous = 2.0 * FLOPS_DOT + LANES + 2.0 * SOUND + 2.0 + 11.0;
    bool inviscid = work->terms.dissipation == SOLVER_ULSPH_INVISCID;
    solver_cost_term(terms, "internal force", 3, pairs * (3.0 + 2.0 * APPLY + 5.0 * LANES));
    solver_cost_term(terms, "tension", 3, work->tensile_L != NULL ? pairs * (2.0 * APPLY + 5.0 * LANES + 12.0) : 0.0);
    solver_cost_term(terms, "dissipation", 3,
                     inviscid ? 0.0 : pairs * (2.0 + 2.0 * LANES + (work->v_gradient != NULL ? riemann : viscous)));
    solver_cost_term(terms, "density diffusion", 3,
                     work->rho_gradient != NULL ? pairs * (LANES + 2.0 + FLOPS_DOT + 4.0) + particles * (4.0 + SOUND)
                                                : 0.0);
}

static void terms_of(const struct solver_ulsph *work, size_t count, struct solver_cost_terms *terms)
{
    double pairs = (double)work->row[count];
    double particles = (double)count;
    geometry_terms(work, pairs, particles, terms);
    gradient_terms(work, pairs, particles, terms);
    rate_terms(work, pairs, particles, terms);
    solver_cost_term(terms, "volumes and impedance", 0, particles * (work->root_rho != NULL ? 7.0 : 2.0));
    solver_cost_once(terms, "whether the state is whole", particles * (FLOPS_DOT + FLOPS_CONTRACT));
}

const struct solver_ulsph_loops DIM_NAME(solver_ulsph) = {
    .lanes = LANES,
    .volumes = volumes,
    .geometry = geometry,
    .gradients = gradients,
    .rates = rates,
    .terms = terms_of,
    .first_broken = first_broken,
};
