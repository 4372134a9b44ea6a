/* The neo-Hookean model of 003_253cac78b077eaad.txt eq. 51, 52,
 *     W = mu/2 (J^(-2/3) F:F - 3) + kappa/2 (J - 1)^2,
 * in two readings for a J that is evolved beside F and drifts from det F by what its dissipation takes:
 *
 *   neo-hookean             J is det F in the first, isochoric term. P then depends on the drift through kappa alone,
 *                           and at small strain the model is Hooke's law for every evolved set.
 *   neo-hookean-polyconvex  J is the evolved one in both terms: convex in (F, J), but the drift enters P through
 *                           kappa + mu (swinging cube, sbp2, n = 16: error of P 2.9e-3 instead of 2.3e-3).
 *
 * F:F counts the directions out of the plane. */
#define WIDE_LOTS
#include "solver/dim.h"
#include "solver/dim_flops.h"
#include "solver/dim_ranges.h"
#include "solver/dim_roots.h"
#include "solver/material.h"

#include <math.h>

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
static inline lot largest(lot shear, lot mixed, lot by_JJ, lot J, lot ff, lot hh, lot *smallest)
{
    lot half_trace = 0.5 * (2.0 * mixed * J + by_JJ * hh);
    lot minus_determinant = mixed * mixed * larger_lot((lot){0}, ff * hh - J * J);
    lot root = sqrt_lot(half_trace * half_trace + minus_determinant);
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
    double by_JJ = material->kappa + 5.0 / 9.0 * shear * FF / (J * J);
    lot lows;
    double high = largest(lot_of(shear), lot_of(-2.0 / 3.0 * shear / J), lot_of(by_JJ), lot_of(J), lot_of(dot(f, f)),
                          lot_of(dot(h, h)), &lows)[0];
    double low = lows[0];
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

/* --- loops over particles: the same, a lot at a time --- */

/* 1 / J of J and its J^(-2/3): a division takes longer than all else here. */
static inline lot inverse_of(lot J, lot root)
{
    return (root * root) * (root * J);
}

/* What a loop is compiled for. */
struct reading {
    bool polyconvex, H, J; /* H and J of their own beside F */
};

static inline __attribute__((always_inline)) struct tensors
stress_of_lot(struct constants of, const double *F, const double *H, const double *J, struct reading reading)
{
    struct tensors at = load_tensors(F);
    struct tensors cof = reading.H ? load_tensors(H) : cofactors(&at);
    lot jacobian = reading.J ? load_lot(J) : determinants(&at);
    lot isochoric = reading.J && !reading.polyconvex ? determinants(&at) : jacobian;
    lot root = inverse_square_of_cube_root(isochoric);
    lot shear = of.mu * root;
    lot by_isochoric = -1.0 / 3.0 * (shear * (squares(&at) + (3.0 - DIM))) * inverse_of(isochoric, root);
    lot pressure = of.kappa * (jacobian - 1.0);
    struct tensors P;
    if (reading.polyconvex || !reading.H) { /* one cofactor goes with both terms */
        by_isochoric += pressure;
    }
    struct tensors own = reading.polyconvex || !reading.H ? cof : cofactors(&at);
    for (int I = 0; I < DIM; I++) {
        for (int i = 0; i < DIM; i++) {
            P.column[I][i] = shear * at.column[I][i] + by_isochoric * own.column[I][i];
            if (!reading.polyconvex && reading.H) {
                P.column[I][i] += pressure * cof.column[I][i];
            }
        }
    }
    return P;
}

static inline __attribute__((always_inline)) void stresses_as(const struct solver_material_constants *material,
                                                              size_t stride, size_t count, const double *F,
                                                              const double *H, const double *J, double *P,
                                                              struct reading reading)
{
    struct constants here = {.mu = {0}};
    for (size_t a = 0; a < count; a += LOT) {
        size_t at = a * TENSOR_WIDTH;
        if (a == 0 || stride != 0) {
            here = constants_of(material + a * stride, stride);
        }
        struct tensors stresses =
            stress_of_lot(here, F + at, reading.H ? H + at : NULL, reading.J ? J + a : NULL, reading);
        store_tensors(P + at, &stresses);
    }
}

static inline __attribute__((always_inline)) void stresses(const struct solver_material_constants *material,
                                                           size_t stride, size_t count, const double *F,
                                                           const double *H, const double *J, double *P, bool polyconvex)
{
    struct reading reading = {.polyconvex = polyconvex};
    if (H != NULL && J != NULL) {
        reading.H = reading.J = true;
        stresses_as(material, stride, count, F, H, J, P, reading);
    } else if (H != NULL) {
        reading.H = true;
        stresses_as(material, stride, count, F, H, J, P, reading);
    } else if (J != NULL) {
        reading.J = true;
        stresses_as(material, stride, count, F, H, J, P, reading);
    } else {
        stresses_as(material, stride, count, F, H, J, P, reading);
    }
}

static __attribute__((noinline)) void stress_of_whole(const struct solver_material_constants *material, size_t stride,
                                                      size_t count, const double *F, const double *H, const double *J,
                                                      double *P)
{
    stresses(material, stride, count, F, H, J, P, false);
}

static __attribute__((noinline)) void polyconvex_of_whole(const struct solver_material_constants *material,
                                                          size_t stride, size_t count, const double *F, const double *H,
                                                          const double *J, double *P)
{
    stresses(material, stride, count, F, H, J, P, true);
}

static void stress_range(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                         const double *F, const double *H, const double *J, double *P)
{
    stress_by_lots(stress_of_whole, material, stride, begin, end, F, H, J, P);
}

static void stress_range_polyconvex(const struct solver_material_constants *material, size_t stride, size_t begin,
                                    size_t end, const double *F, const double *H, const double *J, double *P)
{
    stress_by_lots(polyconvex_of_whole, material, stride, begin, end, F, H, J, P);
}

static void volumetric_range(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                             const double *J, double *pressure)
{
    for (size_t a = begin; a < end; a++) {
        pressure[a] = material[a * stride].kappa * (J[a] - 1.0);
    }
}

/* Largest row sum of |A^T A|: at least its largest eigenvalue, and equal to it at rest. */
static inline lot square_bound(const struct tensors *A)
{
    lot sum[DIM];
    for (int I = 0; I < DIM; I++) {
        sum[I] = dot_lot(A->column[I], A->column[I]);
    }
    for (int I = 0; I < DIM; I++) {
        for (int J = 0; J < I; J++) {
            lot entry = magnitude(dot_lot(A->column[I], A->column[J]));
            sum[I] += entry;
            sum[J] += entry;
        }
    }
    lot bound = sum[0];
    for (int I = 1; I < DIM; I++) {
        bound = larger_lot(bound, sum[I]);
    }
    return bound;
}

/* Squares of speeds, times the density where there is one for all particles: what is the largest of them is not
 * changed by that, and divided once. */
static inline __attribute__((always_inline)) double fastest_as(const struct solver_material_constants *material,
                                                               size_t stride, size_t count, const double *F,
                                                               bool composite)
{
    struct constants here = {.mu = {0}};
    lot square = {0};
    for (size_t a = 0; a < count; a += LOT) {
        if (a == 0 || composite) {
            here = constants_of(material + a * stride, stride);
        }
        struct tensors at = load_tensors(F + a * TENSOR_WIDTH);
        struct tensors cof = cofactors(&at);
        lot J = determinants(&at);
        lot root = inverse_square_of_cube_root(J);
        lot per_J = inverse_of(J, root);
        lot shear = here.mu * root;
        lot by_JJ = here.kappa + 5.0 / 9.0 * shear * (squares(&at) + (3.0 - DIM)) * (per_J * per_J);
        lot low;
        lot modulus = largest(shear, -2.0 / 3.0 * shear * per_J, by_JJ, J, square_bound(&at), square_bound(&cof), &low);
        square = larger_lot(square, composite ? modulus / here.rho : modulus);
    }
    double most = 0.0;
    for (int k = 0; k < LOT; k++) {
        most = square[k] > most ? square[k] : most;
    }
    return sqrt(composite ? most : most / material->rho);
}

static __attribute__((noinline)) double fastest_of_whole(const struct solver_material_constants *material,
                                                         size_t stride, size_t count, const double *F)
{
    return stride != 0 ? fastest_as(material, stride, count, F, true) : fastest_as(material, 0, count, F, false);
}

static double fastest(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                      const double *F)
{
    return fastest_by_lots(fastest_of_whole, material, stride, begin, end, F);
}

/* --- operations (cost.h) --- */

enum {
    INVARIANT = LOT_SQUARES + 1,
    ROOT = 1 + LOT_ROOT,
    INVERSE = 3,
    BOUND = DIM * (DIM + 1) / 2 * LOT_DOT + DIM * (DIM - 1), /* square_bound */
    FASTEST = LOT_COFACTOR + LOT_DETERMINANT + INVERSE + ROOT + INVARIANT + 5 + 2 + 2 * BOUND + 17,
    ENERGY = FLOPS_CONTRACT + 1 + 2 + SOLVER_COST_FUNCTION + 9 /* of J */
};

static int stress_flops(bool H, bool J)
{
    (void)J; /* det F is needed with an evolved one, too */
    return LOT_COFACTOR + LOT_DETERMINANT + INVARIANT + ROOT + INVERSE + 3 + 2 +
           (H ? 5 * DIM * DIM : 1 + 3 * DIM * DIM);
}

static int stress_flops_polyconvex(bool H, bool J)
{
    return (H ? 0 : LOT_COFACTOR) + (J ? 0 : LOT_DETERMINANT) + INVARIANT + ROOT + INVERSE + 3 + 2 + 1 + 3 * DIM * DIM;
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
    .composite_flops = 1,
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
    .composite_flops = 1,
    .energy_flops = ENERGY,
    .fastest = fastest,
};
