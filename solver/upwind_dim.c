#include "solver/upwind.h"

#include "solver/dim_pairs.h"
#include "solver/dim_sums.h"
#include "solver/dim_upwind_terms.h"

#include <math.h>

/* Gradients of a vector field and, if asked for, of a scalar one. */
struct gradients {
    struct tensor of_vector;
    vec of_scalar;
};

/* Which weights gradients are summed with. */
enum weighting { WIDE, NARROW, LEAST_SQUARES };

static inline __attribute__((always_inline)) void add_difference(const struct solver_upwind *work,
                                                                 enum weighting weighting, size_t ab, vec difference,
                                                                 const double *scalar, double scalar_a,
                                                                 struct gradients *G)
{
    struct weights w = weighting == LEAST_SQUARES ? load_weights(work->least_squares + ab * DIM, DIM)
                                                  : load_pair(work, ab, weighting == NARROW).C;
    for (int I = 0; I < DIM; I++) {
        G->of_vector.column[I] += difference * w.each[I];
    }
    if (scalar != NULL) {
        G->of_scalar += (*scalar - scalar_a) * w.together;
    }
}

/* sum_b (f_b - f_a) w_ab; `scalar` may be NULL. Sums over every other neighbour are kept apart, so that one does not
 * wait for the last; on a line there are too few for that. */
static inline __attribute__((always_inline)) struct gradients sum_gradients(const struct solver_upwind *work, size_t a,
                                                                            const double *field, const double *scalar,
                                                                            enum weighting weighting)
{
    struct gradients even = {.of_scalar = {0}};
    struct gradients odd = {.of_scalar = {0}};
    const uint32_t *neighbour = work->neighbour;
    vec f_a = load(field + a * LANES);
    double s_a = scalar != NULL ? scalar[a] : 0.0;
    size_t ab = work->row[a];
    size_t end = work->row[a + 1];
    for (; DIM > 1 && ab + 1 < end; ab += 2) {
        size_t b = neighbour[ab];
        size_t c = neighbour[ab + 1];
        add_difference(work, weighting, ab, load(field + b * LANES) - f_a, scalar != NULL ? scalar + b : NULL, s_a,
                       &even);
        add_difference(work, weighting, ab + 1, load(field + c * LANES) - f_a, scalar != NULL ? scalar + c : NULL, s_a,
                       &odd);
    }
    for (; ab < end; ab++) {
        size_t b = neighbour[ab];
        add_difference(work, weighting, ab, load(field + b * LANES) - f_a, scalar != NULL ? scalar + b : NULL, s_a,
                       &even);
    }
    for (int I = 0; I < DIM; I++) {
        even.of_vector.column[I] += odd.of_vector.column[I];
    }
    even.of_scalar += odd.of_scalar;
    return even;
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

static inline void store_slope(double *to, vec slope)
{
    for (int I = DIM; I < LANES; I++) {
        slope[I] = 0.0;
    }
    store(to, slope);
}

/* The stencil's own gradients, which are the rate of F; of U'(J) if `pressure`. */
static inline __attribute__((always_inline)) void gradients_with(const struct solver_upwind *work, size_t begin,
                                                                 size_t end, bool pressure, bool narrow)
{
    for (size_t a = begin; a < end; a++) {
        double half_per_V = 0.5 * work->unit / work->V[a];
        struct gradients G = sum_gradients(work, a, work->v, pressure ? work->pressure : NULL, narrow ? NARROW : WIDE);
        for (int I = 0; I < DIM; I++) {
            store(work->F_rate + a * TENSOR + I * LANES, G.of_vector.column[I] * half_per_V);
        }
        store(work->x_rate + a * LANES, load(work->v + a * LANES));
        if (pressure) {
            store_slope(work->pressure_gradient + a * LANES, half_per_V * G.of_scalar);
        }
    }
}

static void gradients(const struct solver_upwind *work, size_t begin, size_t end)
{
    bool own = work->least_squares == NULL; /* the reconstruction takes the stencil's gradients */
    bool pressure = own && work->pressure_gradient != NULL;
    if (work->narrow != NULL && pressure) {
        gradients_with(work, begin, end, true, true);
    } else if (work->narrow != NULL) {
        gradients_with(work, begin, end, false, true);
    } else if (pressure) {
        gradients_with(work, begin, end, true, false);
    } else {
        gradients_with(work, begin, end, false, false);
    }
    for (size_t a = begin; !own && work->v_gradient != NULL && a < end; a++) {
        const double *field = work->pressure_gradient != NULL ? work->pressure : NULL;
        struct gradients G = sum_gradients(work, a, work->v, field, LEAST_SQUARES);
        store_tensor(work->v_gradient + a * TENSOR, G.of_vector);
        if (field != NULL) {
            store_slope(work->pressure_gradient + a * LANES, G.of_scalar);
        }
    }
    for (size_t a = begin; work->P_gradient != NULL && a < end; a++) {
        stress_gradient(work, a, own ? work->pair : work->least_squares, own ? PAIR : DIM,
                        own ? 0.5 / work->V[a] : 1.0);
    }
}

/* Impedances of a pair: z v jumps in the acoustic Riemann problem of eq. 27, 28, with 2 z_a z_b / (z_a + z_b) where
 * materials meet. */
struct impedances {
    double p, s;
    double shear, bulk; /* shares of mu and kappa in the square of z_p, at rest */
};

static inline void set_pair(const struct solver_material_constants *of_a, const struct solver_material_constants *of_b,
                            struct impedances *z)
{
    z->p = 2.0 * of_a->zp * of_b->zp / (of_a->zp + of_b->zp);
    z->s = 2.0 * of_a->zs * of_b->zs / (of_a->zs + of_b->zs);
}

static inline void set_shares(const struct solver_material_constants *material, struct impedances *z)
{
    double modulus = material->zp * material->cp;
    z->shear = 4.0 / 3.0 * material->mu / modulus;
    z->bulk = material->kappa / modulus;
}

/* z_p at rest over that of the present state, in which the volume has U''(J) t^2 of rho c_p^2, t = n . H^Ave N;
 * `square` is t^2. The flux of J grows with U'' t^2 too: over the impedance at rest it would outrun the waves of a body
 * that is stretched or compressed, and with them the step of eq. 41. Of two particles the stiffer one counts. Where U'
 * falls with J, as beyond J = e with Hencky's model, no wave carries its jump. */
static inline double softening(const struct solver_upwind *work, size_t a, size_t b, struct impedances z, double square)
{
    if (work->stiffness != NULL) {
        double of_a = work->stiffness[a];
        double of_b = work->stiffness[b];
        if (fmin(of_a, of_b) == 0.0) {
            return 0.0;
        }
        square *= fmax(of_a, of_b);
    }
    double stiffened = sqrt(z.shear + z.bulk * square);
    return 1.0 / stiffened;
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

/* What the scene asks for, as constants where the sums are called, so that each combination is a loop of its own. */
struct terms {
    bool frozen, reconstruct, transposed, volume, whole, composite, narrow;
};

/* n (n . H^Ave N): what becomes of the unit vector N, not normalised, as the pair's area. */
static inline __attribute__((always_inline)) vec pair_area(const struct solver_upwind *work, size_t a, size_t b,
                                                           vec distance)
{
    vec area = {0};
    for (int I = 0; I < DIM; I++) {
        area += (load(work->cofactor + a * TENSOR + I * LANES) + load(work->cofactor + b * TENSOR + I * LANES)) *
                spread(0.5 * distance, I);
    }
    return area;
}

/* Sums over the neighbours of one particle, before what is the same for all of them is multiplied in. Components are
 * summed apart as long as they may be: that is fewer shuffles, and no sum waits long for its last term. */
struct pair_sums {
    vec force[DIM]; /* sum_b P_b e_I D_I */
    vec jumps;      /* sum_b A [v] */
    vec normals;    /* sum_b A n (n . [v]) */
    vec slopes;     /* sum_b A n^2 (slope of U' times N d), by components; n = n . H^Ave N here and below */
    double volume;  /* sum_b A n^2 [U'], not reconstructed, or A n (n . [P N]) */
};

/* Upwind fluxes across a pair, twice: of momentum, A S (p+ - p-) (eq. 27, 28), from the jump of velocity with the
 * states reconstructed at mid-distance; n is the unit of `along`, x_b - x_a, which is not normalised: n (n . jump) =
 * along (along . jump) / |along|^2. And of J (eq. 27, 28, 30, 33), times 2 z_p: A (n . (P+ - P-) N) (n . H^Ave N).
 * Eq. 33 as printed has the sign that would feed energy in; this is that of eq. 30. A N stands for C_ab, as in the flux
 * of p. By default only the volumetric part U'(J) H of the stress jumps: J is conjugate to it alone, so that without
 * reconstruction the flux cannot feed energy in, and its gradient is a vector instead of a third-order tensor. */
static inline __attribute__((always_inline)) void add_fluxes(const struct solver_upwind *work, size_t a, size_t b,
                                                             struct terms terms, vec jump, vec distance, vec along,
                                                             vec face, struct impedances z, struct pair_sums *sums)
{
    bool alike = !terms.composite || /* where materials meet the volumetric stress has a jump of its own */
                 solver_material_same(work->constants + a, work->constants + b);
    vec normal;
    vec square;
    vec by_normal; /* A / |along|^2 */
    vec by_volume; /* A n^2, times the softening; frozen: n = N, H = 1 */
    spread_dots(along, jump, along, along, &normal, &square);
    if (terms.volume && (!terms.frozen || terms.whole)) {
        vec area = terms.frozen ? distance : pair_area(work, a, b, distance);
        vec turned;
        vec reference;
        spread_dots(along, area, distance, distance, &turned, &reference);
        vec per_lengths = splat(1.0) / (square * reference);
        vec share = face * per_lengths;
        by_normal = share * reference;
        by_volume = share * turned;
        if (!terms.frozen) {
            by_volume *= splat(softening(work, a, b, z, turned[0] * turned[0] * per_lengths[0]));
        }
        if (terms.whole) {
            double flux = by_volume[0] * dot(along, traction_jump(work, a, b, distance, terms.reconstruct));
            sums->volume += alike ? flux : 0.0;
        }
        by_volume *= turned;
    } else {
        by_normal = face / square;
        by_volume = face;
    }
    sums->jumps += (terms.composite ? z.s * face : face) * jump;
    sums->normals += (terms.composite ? (z.p - z.s) * normal * by_normal : normal * by_normal) * along;
    if (terms.volume && !terms.whole && alike) {
        sums->volume += by_volume[0] * (work->pressure[b] - work->pressure[a]);
        if (terms.reconstruct) {
            vec slope = load(work->pressure_gradient + a * LANES) + load(work->pressure_gradient + b * LANES);
            sums->slopes += by_volume * (slope * distance);
        }
    }
}

static inline __attribute__((always_inline)) struct sums combine(const struct pair_sums *sums, struct terms terms,
                                                                 struct impedances z)
{
    struct sums all = {.force = sums->force[0], .volume = sums->volume};
    for (int I = 1; I < DIM; I++) {
        all.force += sums->force[I];
    }
    all.dissipation = terms.composite ? sums->jumps + sums->normals : z.s * sums->jumps + (z.p - z.s) * sums->normals;
    for (int I = 0; I < DIM; I++) {
        all.volume -= 0.5 * sums->slopes[I];
    }
    return all;
}

/* Neighbours lie all over memory, and the work on a pair is shorter than the way there: what a neighbour brings is
 * asked for so many pairs ahead. */
enum { AHEAD = 16, LINE = 64 / sizeof(double) };

static inline void fetch(const struct solver_upwind *work, const double *slope, size_t b)
{
    for (int i = 0; i < TENSOR; i += LINE) {
        __builtin_prefetch(work->P + b * TENSOR + i);
        __builtin_prefetch(slope + b * TENSOR + i);
    }
    __builtin_prefetch(work->v + b * LANES);
    __builtin_prefetch(work->X + b * LANES);
}

/* Jump of velocity where materials meet: slopes jump there, and that of a particle on the interface is a mean of both
 * sides', of the softer one's size. The side whose slope leaves the smaller jump reconstructs both states. */
static inline vec one_sided_jump(vec difference, const double *slope_b, struct tensor slope_a, vec distance)
{
    vec by_a = difference;
    vec by_b = difference;
    for (int I = 0; I < DIM; I++) {
        by_a -= slope_a.column[I] * spread(distance, I);
        by_b -= load(slope_b + I * LANES) * spread(distance, I);
    }
    return dot(by_a, by_a) < dot(by_b, by_b) ? by_a : by_b;
}

/* `last`: pair up to which neighbours may be asked for. */
static inline __attribute__((always_inline)) struct sums sum_pairs(const struct solver_upwind *work, size_t a,
                                                                   size_t last, struct terms terms)
{
    struct pair_sums sums = {.volume = 0.0};
    const double *slope = work->v_gradient != NULL ? work->v_gradient : work->F_rate;
    const double *x = terms.frozen ? work->X : work->x;
    const struct solver_material_constants *of_a = work->constants + a * work->stride;
    struct impedances z = {of_a->zp, of_a->zs, 0.0, 0.0};
    bool placed = terms.frozen || terms.reconstruct || terms.volume; /* else X need not be there */
    if (terms.volume && !terms.frozen) {
        set_shares(of_a, &z);
    }
    vec X_a = placed ? load(work->X + a * LANES) : (vec){0};
    vec x_a = load(x + a * LANES);
    vec v_a = load(work->v + a * LANES);
    struct tensor slope_a = load_tensor(slope + a * TENSOR);
    for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
        size_t b = work->neighbour[ab];
        fetch(work, slope, work->neighbour[ab + AHEAD < last ? ab + AHEAD : last]);
        struct pair pair = load_pair(work, ab, terms.narrow);
        const double *P_b = work->P + b * TENSOR;
        vec distance = placed ? load(work->X + b * LANES) - X_a : (vec){0};
        vec along = terms.frozen ? distance : load(x + b * LANES) - x_a;
        vec jump = load(work->v + b * LANES) - v_a;
        if (terms.composite) {
            set_pair(of_a, work->constants + b, &z);
        }
        vec difference = jump;
        vec back = -0.5 * distance;
        for (int I = 0; I < DIM; I++) {
            vec D = terms.transposed ? splat(work->transposed[ab * DIM + (size_t)I]) : pair.C.each[I];
            sums.force[I] += load(P_b + I * LANES) * D;
            if (terms.reconstruct) {
                jump += (load(slope + b * TENSOR + I * LANES) + slope_a.column[I]) * spread(back, I);
            }
        }
        if (terms.composite && terms.reconstruct && !solver_material_same(of_a, work->constants + b)) {
            jump = one_sided_jump(difference, slope + b * TENSOR, slope_a, distance);
        }
        add_fluxes(work, a, b, terms, jump, distance, along, pair.A, z, &sums);
    }
    return combine(&sums, terms, z);
}

static inline __attribute__((always_inline)) void rates_with(const struct solver_upwind *work, size_t begin, size_t end,
                                                             struct terms terms)
{
    size_t last = work->row[end] > 0 ? work->row[end] - 1 : 0;
    for (size_t a = begin; a < end; a++) {
        finish(work, a, sum_pairs(work, a, last, terms));
    }
}

/* With linear reconstruction, on a stencil that is antisymmetric, of one material. */
static inline __attribute__((always_inline)) void plain_rates(const struct solver_upwind *work, size_t begin,
                                                              size_t end, bool narrow)
{
    if (work->frozen && !work->evolves_J) {
        rates_with(work, begin, end, (struct terms){.frozen = true, .reconstruct = true, .narrow = narrow});
    } else if (work->frozen) {
        rates_with(work, begin, end,
                   (struct terms){.frozen = true, .reconstruct = true, .volume = true, .narrow = narrow});
    } else if (!work->evolves_J) {
        rates_with(work, begin, end, (struct terms){.reconstruct = true, .narrow = narrow});
    } else {
        rates_with(work, begin, end, (struct terms){.reconstruct = true, .volume = true, .narrow = narrow});
    }
}

static void rates(const struct solver_upwind *work, size_t begin, size_t end)
{
    bool volume = work->evolves_J;
    bool plain = work->reconstruct && work->transposed == NULL && work->stride == 0 && !(volume && work->whole_jump);
    struct terms terms = {.frozen = work->frozen,
                          .reconstruct = work->reconstruct,
                          .transposed = work->transposed != NULL,
                          .volume = volume,
                          .whole = work->whole_jump,
                          .composite = work->stride != 0,
                          .narrow = work->narrow != NULL};
    if (!plain) { /* rare: not worth a loop each */
        rates_with(work, begin, end, terms);
    } else if (terms.narrow) {
        plain_rates(work, begin, end, true);
    } else {
        plain_rates(work, begin, end, false);
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
    if (work->stiffness != NULL) {
        work->material->stiffness_range(begin, end, work->J, work->stiffness);
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
