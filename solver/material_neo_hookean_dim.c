/* The neo-Hookean model of 003_253cac78b077eaad.txt eq. 51, 52,
 *     W = mu/2 (J^(-2/3) F:F - 3) + kappa/2 (J - 1)^2,
 * in two readings for a J that is evolved beside F and drifts from det F by what its dissipation takes:
 *   neo-hookean             J is det F in the first, isochoric term. P then depends on the drift through kappa alone,
 * and at small strain the model is Hooke's law for every evolved set. neo-hookean-polyconvex  J is the evolved one in
 * both terms: convex in (F, J), but the drift enters P through kappa + mu (swinging cube, sbp2, n = 16: error of
 * P 2.9e-3 instead of 2.3e-3). F:F counts the directions out of the plane. */
#include "solver/dim.h"
#include "solver/dim_flops.h"
#include "solver/material.h"

#include <math.h>

/* As fmax, but no call; what is no number counts for nothing if it comes second. */
static inline double larger(double known, double other)
{
    return other > known ? other : known;
}

static inline double invariant(struct tensor F)
{
    return contract(F, F) + (3 - DIM);
}

/* mu J^(-2/3) and dW/dJ */
static inline double coefficients(const struct solver_material_constants *material, double FF, double J, double *by_J)
{
    double shear = material->mu / cbrt(J * J);
    *by_J = material->kappa * (J - 1.0) - shear * FF / (3.0 * J);
    return shear;
}

/* One reading of the model: the isochoric term takes the first J, the volumetric one the second. */
static inline double energy_of(const struct solver_material_constants *material, struct tensor F, double isochoric,
                               double J)
{
    double per_shape = invariant(F) / cbrt(isochoric * isochoric);
    return 0.5 * material->mu * (per_shape - 3.0) + 0.5 * material->kappa * (J - 1.0) * (J - 1.0);
}

static inline struct tensor stress_of(const struct solver_material_constants *material, struct tensor F,
                                      struct tensor H, double J, bool polyconvex)
{
    struct tensor own = polyconvex ? H : cofactor(F); /* the cofactor that goes with the isochoric term's J */
    double isochoric = polyconvex ? J : determinant(F);
    double shear = material->mu / cbrt(isochoric * isochoric);
    double by_isochoric = -shear * invariant(F) / (3.0 * isochoric);
    double pressure = material->kappa * (J - 1.0);
    struct tensor P;
    for (int I = 0; I < DIM; I++) {
        P.column[I] = shear * F.column[I] + by_isochoric * own.column[I] + pressure * H.column[I];
    }
    return P;
}

static double energy(const struct solver_material_constants *material, const double *F, const double *H, double J)
{
    (void)H;
    return energy_of(material, from_rows(F), determinant(from_rows(F)), J);
}

static double energy_polyconvex(const struct solver_material_constants *material, const double *F, const double *H,
                                double J)
{
    (void)H;
    return energy_of(material, from_rows(F), J, J);
}

static void stress(const struct solver_material_constants *material, const double *F, const double *H, double J,
                   double *P)
{
    to_rows(stress_of(material, from_rows(F), from_rows(H), J, false), P);
}

static void stress_polyconvex(const struct solver_material_constants *material, const double *F, const double *H,
                              double J, double *P)
{
    to_rows(stress_of(material, from_rows(F), from_rows(H), J, true), P);
}

/* F = 1 out of the plane, where the cofactor is det F, whatever an evolved J has become. */
static inline double normal_of(const struct solver_material_constants *material, const double *F, double isochoric,
                               double J)
{
    struct tensor at = from_rows(F);
    double H = determinant(at);
    double shear = material->mu / cbrt(isochoric * isochoric);
    return shear * (1.0 - invariant(at) * H / (3.0 * isochoric)) + material->kappa * (J - 1.0) * H;
}

static double stress_normal(const struct solver_material_constants *material, const double *F, double J)
{
    return normal_of(material, F, determinant(from_rows(F)), J);
}

static double stress_normal_polyconvex(const struct solver_material_constants *material, const double *F, double J)
{
    return normal_of(material, F, J, J);
}

static void tangent(const struct solver_material_constants *material, const double *rows, double *A)
{
    struct tensor F = from_rows(rows);
    struct tensor H = cofactor(F);
    double J = determinant(F);
    double FF = invariant(F);
    double by_J;
    double shear = coefficients(material, FF, J, &by_J);
    double mixed = -2.0 / 3.0 * shear / J;
    double by_JJ = material->kappa + 5.0 / 9.0 * shear * FF / (J * J);
    for (int j = 0; j < DIM; j++) {
        for (int K = 0; K < DIM; K++) {
            struct tensor unit = {{{0}}};
            unit.column[K][j] = 1.0;
            struct tensor dH = tensor_cross(F, unit);
            for (int i = 0; i < DIM; i++) {
                for (int I = 0; I < DIM; I++) {
                    A[((i * DIM + I) * DIM + j) * DIM + K] =
                        shear * (i == j && I == K) + by_J * dH.column[I][i] +
                        mixed * (F.column[I][i] * H.column[K][j] + H.column[I][i] * F.column[K][j]) +
                        by_JJ * H.column[I][i] * H.column[K][j];
                }
            }
        }
    }
}

/* Acoustic tensor, with f = F N, h = H N (f . h = J, and cof(F + u (x) N) N = H N for any u):
 *     Q = shear I + mixed (f (x) h + h (x) f) + by_JJ h (x) h
 * Eigenvalues: shear across f and h, and shear + those of the rank-2 part, from its trace and determinant. Where only
 * norms of f and h are known this bounds the largest from above. */
static double largest(double shear, double mixed, double by_JJ, double J, double ff, double hh, double *smallest)
{
    double half_trace = 0.5 * (2.0 * mixed * J + by_JJ * hh);
    double minus_determinant = mixed * mixed * larger(0.0, ff * hh - J * J);
    double root = sqrt(half_trace * half_trace + minus_determinant);
    *smallest = shear + half_trace - root;
    return shear + half_trace + root;
}

static void wave_speeds(const struct solver_material_constants *material, const double *rows, const double *N,
                        double *speeds)
{
    struct tensor F = from_rows(rows);
    struct tensor H = cofactor(F);
    double J = determinant(F);
    double FF = invariant(F);
    double by_J;
    double shear = coefficients(material, FF, J, &by_J);
    vec f = {0};
    vec h = {0};
    for (int I = 0; I < DIM; I++) {
        f += F.column[I] * N[I];
        h += H.column[I] * N[I];
    }
    double low;
    double high = largest(shear, -2.0 / 3.0 * shear / J, material->kappa + 5.0 / 9.0 * shear * FF / (J * J), J,
                          dot(f, f), dot(h, h), &low);
    if (DIM == 1) { /* one of the two roots is not the line's: it is shear, across f and h */
        high += low - shear;
    }
    speeds[DIM - 1] = sqrt(high / material->rho);
    if (DIM > 1) {
        speeds[0] = sqrt(low / material->rho);
    }
    if (DIM > 2) {
        speeds[1] = sqrt(shear / material->rho);
        if (speeds[1] < speeds[0]) {
            double kept = speeds[0];
            speeds[0] = speeds[1];
            speeds[1] = kept;
        }
    }
}

static inline void range_of(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                            const double *F, const double *H, const double *J, double *P, bool polyconvex)
{
    for (size_t a = begin; a < end; a++) {
        struct tensor at = load_tensor(F + a * DIM * LANES);
        struct tensor cof = H != NULL ? load_tensor(H + a * DIM * LANES) : cofactor(at);
        double jacobian = J != NULL ? J[a] : determinant(at);
        store_tensor(P + a * DIM * LANES, stress_of(material + a * stride, at, cof, jacobian, polyconvex));
    }
}

static void stress_range(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                         const double *F, const double *H, const double *J, double *P)
{
    range_of(material, stride, begin, end, F, H, J, P, false);
}

static void stress_range_polyconvex(const struct solver_material_constants *material, size_t stride, size_t begin,
                                    size_t end, const double *F, const double *H, const double *J, double *P)
{
    range_of(material, stride, begin, end, F, H, J, P, true);
}

static void volumetric_range(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                             const double *J, double *pressure)
{
    for (size_t a = begin; a < end; a++) {
        pressure[a] = material[a * stride].kappa * (J[a] - 1.0);
    }
}

/* Largest row sum of |A^T A|: at least its largest eigenvalue, and equal to it at rest. */
static double square_bound(struct tensor A)
{
    double bound = 0.0;
    for (int I = 0; I < DIM; I++) {
        double sum = 0.0;
        for (int J = 0; J < DIM; J++) {
            sum += fabs(dot(A.column[I], A.column[J]));
        }
        bound = larger(bound, sum);
    }
    return bound;
}

static double fastest(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                      const double *F)
{
    double square = 0.0;
    for (size_t a = begin; a < end; a++) {
        struct tensor at = load_tensor(F + a * DIM * LANES);
        double J = determinant(at);
        double FF = invariant(at);
        double by_J;
        const struct solver_material_constants *here = material + a * stride;
        double shear = coefficients(here, FF, J, &by_J);
        double low;
        double modulus = largest(shear, -2.0 / 3.0 * shear / J, here->kappa + 5.0 / 9.0 * shear * FF / (J * J), J,
                                 square_bound(at), square_bound(cofactor(at)), &low);
        square = larger(square, modulus / here->rho);
    }
    return sqrt(square);
}

enum {
    INVARIANT = FLOPS_CONTRACT + 1,
    ROOT = 2 + SOLVER_COST_FUNCTION, /* mu / cbrt(J J) */
    MEASURES = FLOPS_COFACTOR + FLOPS_DETERMINANT,
    BOUND = DIM * DIM * (FLOPS_DOT + 1), /* square_bound */
    ENERGY = INVARIANT + ROOT + 9,       /* of J */
    FASTEST = MEASURES + INVARIANT + ROOT + 6 + 2 + 5 + 2 * BOUND + 17 + 1
};

static int stress_flops(bool H, bool J)
{
    return (H ? 0 : FLOPS_COFACTOR) + (J ? 0 : FLOPS_DETERMINANT) + MEASURES + ROOT + INVARIANT + 3 + 2 +
           5 * FLOPS_TENSOR;
}

static int stress_flops_polyconvex(bool H, bool J)
{
    return stress_flops(H, J) - MEASURES;
}

const struct solver_material DIM_NAME(solver_neo_hookean) = {
    .energy = energy,
    .stress = stress,
    .stress_normal = stress_normal,
    .tangent = tangent,
    .wave_speeds = wave_speeds,
    .stress_range = stress_range,
    .volumetric_range = volumetric_range,
    .stress_flops = stress_flops,
    .volumetric_flops = 2,
    .fastest_flops = FASTEST,
    .energy_flops = FLOPS_DETERMINANT + ENERGY,
    .fastest = fastest,
};

const struct solver_material DIM_NAME(solver_neo_hookean_polyconvex) = {
    .energy = energy_polyconvex,
    .stress = stress_polyconvex,
    .stress_normal = stress_normal_polyconvex,
    .tangent = tangent,
    .wave_speeds = wave_speeds,
    .stress_range = stress_range_polyconvex,
    .volumetric_range = volumetric_range,
    .stress_flops = stress_flops_polyconvex,
    .volumetric_flops = 2,
    .fastest_flops = FASTEST,
    .energy_flops = ENERGY,
    .fastest = fastest,
};
