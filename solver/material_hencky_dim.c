/* Hencky's model, quadratic in logarithmic strains, and von Mises plasticity with isotropic hardening upon it
 * (000_e9ec29e1bde7947d.txt, Algorithm 2):
 *     W = mu e' : e' + kappa/2 (ln J)^2,   e' = dev ln V_e,   V_e^2 = b_e = F Cp^-1 F^T,
 *     tau = 2 mu e' + kappa ln J 1,   P = dev(tau) F^-T + kappa ln(J)/J H.
 * An evolved J and H enter the volumetric part alone, as in the neo-Hookean model. In the algorithm ln J is subtracted
 * from the strains; here it is their own mean, so that e' is a deviator whatever round-off has done to det Cp.
 * Principal strains come from b_e - 1, which small strains leave exact: (F - 1) + (F - 1)^T + (F - 1) (F - 1)^T, and
 * what is remembered of Cp^-1 is its difference from the identity, for the same reason. */
#include "solver/dim.h"
#include "solver/dim_flops.h"
#include "solver/dim_ranges.h"
#include "solver/dim_spectral.h"
#include "solver/material.h"

#include <math.h>

enum {
    WIDTH = DIM == 3   ? 7
            : DIM == 2 ? 5
                       : 3, /* of what a particle remembers */
    NORMAL = WIDTH - 1      /* where the component out of the plane is, below 3D */
};

/* Where the in-plane components are. */
#if DIM == 3
static const int place[3][3] = {{1, 4, 6}, {4, 2, 5}, {6, 5, 3}};
#elif DIM == 2
static const int place[2][2] = {{1, 3}, {3, 2}};
#else
static const int place[1][1] = {{1}};
#endif

/* Principal logarithmic elastic strains of a lot, those of the plane first, their mean, and the directions in the
 * plane. */
struct strains_of_lot {
    lot log[3], mean;
    lot axis[DIM][DIM];
};

/* Of one particle. */
struct strains {
    double log[3], mean;
    vec axis[DIM];
};

static inline struct strains strains_of_one(const struct strains_of_lot *all, int k)
{
    struct strains strains = {.mean = all->mean[k]};
    for (int i = 0; i < 3; i++) {
        strains.log[i] = all->log[i][k];
    }
    for (int i = 0; i < DIM; i++) {
        strains.axis[i] = (vec){0};
        for (int I = 0; I < DIM; I++) {
            strains.axis[i][I] = all->axis[i][I][k];
        }
    }
    return strains;
}

static inline lot log1p_lot(lot a)
{
    return (lot){log1p(a[0]), log1p(a[1]), log1p(a[2]), log1p(a[3])};
}

/* What the particles of a lot remember. */
static inline void load_memory(const double *from, lot memory[WIDTH])
{
    for (int i = 0; i < WIDTH; i++) {
        memory[i] = (lot){from[i], from[WIDTH + i], from[2 * WIDTH + i], from[3 * WIDTH + i]};
    }
}

/* b_e - 1. `memory` NULL: nothing has flown. */
static inline struct tensors excess_of(const struct tensors *F, const lot *memory)
{
    struct tensors G = *F;
    lot plastic[DIM][DIM]; /* F (Cp^-1 - 1) */
    struct tensors excess;
    for (int I = 0; I < DIM; I++) {
        G.column[I][I] -= 1.0;
    }
    for (int i = 0; memory != NULL && i < DIM; i++) {
        for (int I = 0; I < DIM; I++) {
            plastic[i][I] = F->column[0][i] * memory[place[0][I]];
            for (int K = 1; K < DIM; K++) {
                plastic[i][I] += F->column[K][i] * memory[place[K][I]];
            }
        }
    }
    for (int j = 0; j < DIM; j++) {
        for (int i = 0; i <= j; i++) {
            lot sum = G.column[j][i] + G.column[i][j];
            for (int K = 0; K < DIM; K++) {
                sum += G.column[K][i] * G.column[K][j];
            }
            for (int K = 0; memory != NULL && K < DIM; K++) {
                sum += plastic[i][K] * F->column[K][j];
            }
            excess.column[j][i] = excess.column[i][j] = sum;
        }
    }
    return excess;
}

static inline struct strains_of_lot strains_of_all(const struct tensors *F, const lot *memory)
{
    struct tensors excess = excess_of(F, memory);
    struct spectra of = spectra(&excess);
    lot normal = DIM < 3 && memory != NULL ? 0.5 * log1p_lot(memory[NORMAL]) : (lot){0};
    struct strains_of_lot strains = {.log = {normal, normal, normal}};
    for (int i = 0; i < DIM; i++) {
        strains.log[i] = 0.5 * log1p_lot(of.value[i]);
        for (int I = 0; I < DIM; I++) {
            strains.axis[i][I] = of.direction[i][I];
        }
    }
    strains.mean = (strains.log[0] + strains.log[1] + strains.log[2]) / 3.0;
    return strains;
}

static inline struct strains strains_of(struct tensor F, const double *memory)
{
    struct tensors same = tensors_of(F);
    lot all[WIDTH];
    for (int i = 0; memory != NULL && i < WIDTH; i++) {
        all[i] = lot_of(memory[i]);
    }
    struct strains_of_lot strains = strains_of_all(&same, memory != NULL ? all : NULL);
    return strains_of_one(&strains, 0);
}

/* sqrt(3/2 tau' : tau') [Pa] */
static inline double equivalent(const struct solver_material_constants *material, const struct strains *strains)
{
    double square = 0.0;
    for (int i = 0; i < 3; i++) {
        square += (strains->log[i] - strains->mean) * (strains->log[i] - strains->mean);
    }
    return 2.0 * material->mu * sqrt(1.5 * square);
}

static inline lot log_lot(lot a)
{
    return (lot){log(a[0]), log(a[1]), log(a[2]), log(a[3])};
}

static inline struct tensors stress_of(struct constants material, const struct tensors *F, const struct tensors *H,
                                       lot J, const struct strains_of_lot *strains)
{
    struct tensors own = cofactors(F);
    lot per_volume = 1.0 / determinants(F);
    lot pressure = material.kappa * log_lot(J) / J;
    struct tensors P;
    for (int I = 0; I < DIM; I++) {
        for (int i = 0; i < DIM; i++) {
            P.column[I][i] = pressure * H->column[I][i];
        }
    }
    for (int k = 0; k < DIM; k++) { /* F^-T n = cof(F) n / J */
        lot tau = 2.0 * material.mu * (strains->log[k] - strains->mean) * per_volume;
        for (int I = 0; I < DIM; I++) {
            lot along = tau * dot_lot(own.column[I], strains->axis[k]);
            for (int i = 0; i < DIM; i++) {
                P.column[I][i] += along * strains->axis[k][i];
            }
        }
    }
    return P;
}

/* F = 1 out of the plane, where the cofactor is det F. */
static inline double normal_of(const struct solver_material_constants *material, const double *F, double J,
                               const double *memory)
{
    struct tensor at = from_rows(F);
    struct strains strains = strains_of(at, memory);
    return 2.0 * material->mu * (strains.log[2] - strains.mean) + material->kappa * log(J) / J * determinant(at);
}

static inline double energy_of(const struct solver_material_constants *material, const double *F, double J,
                               const double *memory)
{
    struct strains strains = strains_of(from_rows(F), memory);
    double q = equivalent(material, &strains);
    double volumetric = log(J);
    return q * q / (6.0 * material->mu) + 0.5 * material->kappa * volumetric * volumetric;
}

static double energy(const struct solver_material_constants *material, const double *F, const double *H, double J)
{
    (void)H;
    return energy_of(material, F, J, NULL);
}

static void stress(const struct solver_material_constants *material, const double *F, const double *H, double J,
                   double *P)
{
    struct tensors at = tensors_of(from_rows(F));
    struct tensors cof = tensors_of(from_rows(H));
    struct strains_of_lot strains = strains_of_all(&at, NULL);
    struct tensors stresses = stress_of(constants_of(material, 0), &at, &cof, lot_of(J), &strains);
    for (int i = 0; i < DIM; i++) {
        for (int I = 0; I < DIM; I++) {
            P[i * DIM + I] = stresses.column[I][i][0];
        }
    }
}

static double stress_normal(const struct solver_material_constants *material, const double *F, double J)
{
    return normal_of(material, F, J, NULL);
}

/* d coth d, where d is the difference of two logarithmic strains. */
static inline double d_coth(double d)
{
    return d == 0.0 ? 1.0 : d / tanh(d);
}

/* The tangent in principal axes, F = sum l_i n_i (x) N_i, e_i = ln l_i, tau_i principal stresses, d = e_i - e_j:
 *     A_iijj = (dtau_i/de_j - tau_i delta_ij)/(l_i l_j),
 *     A_ijij = (tau_i - tau_j)/(l_i^2 - l_j^2) = mu d/sinh(d)/(l_i l_j),
 *     A_ijji = (l_j/l_i tau_i - l_i/l_j tau_j)/(l_i^2 - l_j^2) = (mu d coth(d) - (tau_i + tau_j)/2)/(l_i l_j);
 * in the last forms nothing cancels where stretches are nearly the same. */
struct moduli {
    double along[DIM][DIM], across[DIM][DIM], mixed[DIM][DIM]; /* A_iijj, A_ijij, A_ijji */
    vec n[DIM], N[DIM];
};

static struct moduli moduli_of(const struct solver_material_constants *material, struct tensor F)
{
    struct strains strains = strains_of(F, NULL);
    struct moduli moduli;
    double tau[DIM];
    for (int i = 0; i < DIM; i++) {
        tau[i] = 2.0 * material->mu * (strains.log[i] - strains.mean) + 3.0 * material->kappa * strains.mean;
        moduli.n[i] = strains.axis[i];
        moduli.N[i] = (vec){0};
        for (int I = 0; I < DIM; I++) {
            moduli.N[i][I] = dot(F.column[I], strains.axis[i]) * exp(-strains.log[i]);
        }
    }
    for (int i = 0; i < DIM; i++) {
        for (int j = 0; j < DIM; j++) {
            double per_stretches = exp(-strains.log[i] - strains.log[j]);
            double d = strains.log[i] - strains.log[j];
            double along = material->kappa - 2.0 / 3.0 * material->mu + (i == j ? 2.0 * material->mu - tau[i] : 0.0);
            moduli.along[i][j] = along * per_stretches;
            moduli.across[i][j] = i == j ? 0.0 : material->mu * (d == 0.0 ? 1.0 : d / sinh(d)) * per_stretches;
            moduli.mixed[i][j] = i == j ? 0.0 : (material->mu * d_coth(d) - 0.5 * (tau[i] + tau[j])) * per_stretches;
        }
    }
    return moduli;
}

static double tangent_entry(const struct moduli *of, int i, int I, int j, int J)
{
    double sum = 0.0;
    for (int a = 0; a < DIM; a++) {
        for (int b = 0; b < DIM; b++) {
            sum += of->along[a][b] * (of->n[a][i] * of->N[a][I]) * (of->n[b][j] * of->N[b][J]) +
                   of->across[a][b] * (of->n[a][i] * of->N[b][I]) * (of->n[a][j] * of->N[b][J]) +
                   of->mixed[a][b] * (of->n[a][i] * of->N[b][I]) * (of->n[b][j] * of->N[a][J]);
        }
    }
    return sum;
}

static void tangent(const struct solver_material_constants *material, const double *F, double *A)
{
    struct moduli moduli = moduli_of(material, from_rows(F));
    for (int row = 0; row < DIM * DIM; row++) {
        for (int column = 0; column <= row; column++) {
            double entry = tangent_entry(&moduli, row / DIM, row % DIM, column / DIM, column % DIM);
            A[row * DIM * DIM + column] = entry;
            A[column * DIM * DIM + row] = entry;
        }
    }
}

static void wave_speeds(const struct solver_material_constants *material, const double *F, const double *N,
                        double *speeds)
{
    double A[DIM * DIM * DIM * DIM];
    struct tensor acoustic = {{{0}}};
    tangent(material, F, A);
    for (int i = 0; i < DIM; i++) {
        for (int j = 0; j < DIM; j++) {
            for (int I = 0; I < DIM; I++) {
                for (int J = 0; J < DIM; J++) {
                    acoustic.column[j][i] += A[((i * DIM + I) * DIM + j) * DIM + J] * N[I] * N[J];
                }
            }
        }
    }
    struct spectrum of = spectrum(acoustic);
    for (int k = 0; k < DIM; k++) {
        double speed = sqrt(fmax(of.value[k], 0.0) / material->rho);
        int at = k;
        for (; at > 0 && speeds[at - 1] > speed; at--) {
            speeds[at] = speeds[at - 1];
        }
        speeds[at] = speed;
    }
}

/* Along N with w = F^-T N, for a unit vector m, rho c^2 of the elastic response to a change of F is
 *     lambda (m.w)^2 + 2 sum_i (mu - tau_i) m_i^2 w_i^2 + sum_{i<j} g_ij (m_i w_j + m_j w_i)^2 + sum_i tau_i w_i^2,
 * g_ij = mu d coth(d) - (tau_i + tau_j)/2 (see moduli_of). With M the largest of mu - tau_i and g_ij, the second and
 * third term are at most M (|w|^2 + (m.w)^2). */
static inline double modulus_bound(const struct solver_material_constants *material, const struct strains *strains)
{
    double tau[DIM];
    double most = -INFINITY;
    double shear = -INFINITY;
    for (int i = 0; i < DIM; i++) {
        tau[i] = 2.0 * material->mu * (strains->log[i] - strains->mean) + 3.0 * material->kappa * strains->mean;
        most = fmax(most, tau[i]);
        shear = fmax(shear, material->mu - tau[i]);
        for (int j = 0; j < i; j++) {
            double coth = d_coth(strains->log[i] - strains->log[j]);
            shear = fmax(shear, material->mu * coth - 0.5 * (tau[i] + tau[j]));
        }
    }
    double bound = shear + most + fmax(material->kappa - 2.0 / 3.0 * material->mu + shear, 0.0);
    return fmax(bound, material->mu); /* a step remains where ellipticity is lost */
}

/* The largest |F^-T N|^2, from strains of F itself. */
static inline double slowness(const struct strains *strains)
{
    double least = strains->log[0];
    for (int i = 1; i < DIM; i++) {
        least = fmin(least, strains->log[i]);
    }
    return exp(-2.0 * least);
}

/* --- loops over particles (dim_ranges.h) --- */

static __attribute__((noinline)) double fastest_of_whole(const struct solver_material_constants *material,
                                                         size_t stride, size_t count, const double *F)
{
    double square = 0.0;
    for (size_t a = 0; a < count; a += LOT) {
        struct tensors at = load_tensors(F + a * TENSOR_WIDTH);
        struct strains_of_lot all = strains_of_all(&at, NULL);
        for (int k = 0; k < LOT; k++) {
            const struct solver_material_constants *here = material + (a + (size_t)k) * stride;
            struct strains strains = strains_of_one(&all, k);
            square = fmax(square, modulus_bound(here, &strains) * slowness(&strains) / here->rho);
        }
    }
    return sqrt(square);
}

static double fastest(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                      const double *F)
{
    return fastest_by_lots(fastest_of_whole, material, stride, begin, end, F);
}

static __attribute__((noinline)) void stress_of_whole(const struct solver_material_constants *material, size_t stride,
                                                      size_t count, const double *F, const double *H, const double *J,
                                                      double *P)
{
    for (size_t a = 0; a < count; a += LOT) {
        struct tensors at = load_tensors(F + a * TENSOR_WIDTH);
        struct tensors cof = H != NULL ? load_tensors(H + a * TENSOR_WIDTH) : cofactors(&at);
        lot jacobian = J != NULL ? load_lot(J + a) : determinants(&at);
        struct strains_of_lot strains = strains_of_all(&at, NULL);
        struct tensors stresses = stress_of(constants_of(material + a * stride, stride), &at, &cof, jacobian, &strains);
        store_tensors(P + a * TENSOR_WIDTH, &stresses);
    }
}

static void stress_range(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                         const double *F, const double *H, const double *J, double *P)
{
    stress_by_lots(stress_of_whole, material, stride, begin, end, F, H, J, P);
}

static void volumetric_range(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                             const double *J, double *pressure)
{
    for (size_t a = begin; a < end; a++) {
        pressure[a] = material[a * stride].kappa * log(J[a]) / J[a];
    }
}

static void stiffness_range(size_t begin, size_t end, const double *J, double *stiffness)
{
    for (size_t a = begin; a < end; a++) {
        stiffness[a] = fmax(0.0, 1.0 - log(J[a])) / (J[a] * J[a]);
    }
}

/* --- plastic flow --- */

/* From trial strains to those on the yield surface, which are 1 - `part` of them, and what is remembered with them:
 * Cp^-1 grows by F^-1 (b_e - b_trial) F^-T = sum l_i^2 (exp(-2 part e'_i) - 1) (F^-1 n_i) (x) (F^-1 n_i). */
static inline void return_to_surface(struct tensor F, double part, struct strains *strains, double *memory)
{
    struct tensor own = cofactor(F);
    double per_volume = 1.0 / determinant(F);
    for (int i = 0; i < 3; i++) {
        double change = -part * (strains->log[i] - strains->mean);
        double grown = exp(2.0 * strains->log[i]) * expm1(2.0 * change);
        strains->log[i] += change;
        if (i >= DIM) {
            memory[NORMAL] += i == 2 ? grown : 0.0; /* in 1D both lateral directions are one */
            continue;
        }
        for (int I = 0; I < DIM; I++) {
            double along = grown * per_volume * per_volume * dot(own.column[I], strains->axis[i]);
            for (int K = 0; K <= I; K++) {
                memory[place[I][K]] += along * dot(own.column[K], strains->axis[i]);
            }
        }
    }
}

/* The return map of particle k of a lot. */
static inline void flow_one(const struct solver_material_constants *material, const struct solver_hardening *hardening,
                            const double *F, struct strains_of_lot *all, int k, double *memory)
{
    struct strains strains = strains_of_one(all, k);
    double q = equivalent(material, &strains);
    double flow = solver_hardening_flow(hardening, material->mu, q, memory[0]);
    if (flow > 0.0) {
        memory[0] += flow;
        return_to_surface(load_tensor(F), 3.0 * material->mu * flow / q, &strains, memory);
        for (int i = 0; i < 3; i++) {
            all->log[i][k] = strains.log[i];
        }
    }
}

static __attribute__((noinline)) void flow_of_whole(const struct solver_material_constants *material, size_t stride,
                                                    const struct solver_hardening *hardening, size_t count,
                                                    const double *F, const double *H, const double *J,
                                                    const double *before, double *now, double *P)
{
    for (size_t a = 0; a < count; a += LOT) {
        struct tensors at = load_tensors(F + a * TENSOR_WIDTH);
        struct tensors cof = H != NULL ? load_tensors(H + a * TENSOR_WIDTH) : cofactors(&at);
        lot jacobian = J != NULL ? load_lot(J + a) : determinants(&at);
        lot memory[WIDTH];
        load_memory(before + a * WIDTH, memory);
        struct strains_of_lot strains = strains_of_all(&at, memory);
        memcpy(now + a * WIDTH, before + a * WIDTH, LOT * WIDTH * sizeof *now);
        for (int k = 0; k < LOT; k++) {
            size_t b = a + (size_t)k;
            flow_one(material + b * stride, hardening, F + b * TENSOR_WIDTH, &strains, k, now + b * WIDTH);
        }
        struct tensors stresses = stress_of(constants_of(material + a * stride, stride), &at, &cof, jacobian, &strains);
        store_tensors(P + a * TENSOR_WIDTH, &stresses);
    }
}

static void flow_stress_range(const struct solver_material_constants *material, size_t stride,
                              const struct solver_hardening *hardening, size_t begin, size_t end, const double *F,
                              const double *H, const double *J, const double *before, double *now, double *P)
{
    size_t last = end - (end - begin) % LOT;
    size_t first = begin * TENSOR_WIDTH;
    flow_of_whole(material + begin * stride, stride, hardening, last - begin, F + first, H != NULL ? H + first : NULL,
                  J != NULL ? J + begin : NULL, before + begin * WIDTH, now + begin * WIDTH, P + first);
    if (last < end) {
        struct filled filled;
        double memory[2][LOT * WIDTH];
        fill(&filled, material, stride, last, end, F, H, J);
        fill_lot(before + last * WIDTH, end - last, WIDTH, memory[0]);
        flow_of_whole(filled.material, 1, hardening, LOT, filled.F, H != NULL ? filled.H : NULL,
                      J != NULL ? filled.J : NULL, memory[0], memory[1], filled.P);
        memcpy(now + last * WIDTH, memory[1], (end - last) * WIDTH * sizeof *now);
        memcpy(P + last * TENSOR_WIDTH, filled.P, (end - last) * TENSOR_WIDTH * sizeof *P);
    }
}

static __attribute__((noinline)) double flow_fastest_of_whole(const struct solver_material_constants *material,
                                                              size_t stride, size_t count, const double *F,
                                                              const double *now)
{
    double square = 0.0;
    for (size_t a = 0; a < count; a += LOT) {
        struct tensors at = load_tensors(F + a * TENSOR_WIDTH);
        lot memory[WIDTH];
        load_memory(now + a * WIDTH, memory);
        struct strains_of_lot whole = strains_of_all(&at, NULL);
        struct strains_of_lot elastic = strains_of_all(&at, memory);
        for (int k = 0; k < LOT; k++) {
            const struct solver_material_constants *here = material + (a + (size_t)k) * stride;
            struct strains of_F = strains_of_one(&whole, k);
            struct strains strains = strains_of_one(&elastic, k);
            square = fmax(square, modulus_bound(here, &strains) * slowness(&of_F) / here->rho);
        }
    }
    return sqrt(square);
}

static double flow_fastest(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                           const double *F, const double *now)
{
    size_t last = end - (end - begin) % LOT;
    double speed = flow_fastest_of_whole(material + begin * stride, stride, last - begin, F + begin * TENSOR_WIDTH,
                                         now + begin * WIDTH);
    if (last < end) {
        struct filled filled;
        double memory[LOT * WIDTH];
        fill(&filled, material, stride, last, end, F, NULL, NULL);
        fill_lot(now + last * WIDTH, end - last, WIDTH, memory);
        speed = fmax(speed, flow_fastest_of_whole(filled.material, 1, LOT, filled.F, memory));
    }
    return speed;
}

/* --- operations (cost.h) --- */

enum {
    LOGARITHM = SOLVER_COST_FUNCTION + 1, /* a function and a factor */
    HALF = DIM * (DIM + 1) / 2,           /* entries of a symmetric tensor */
    STRAINS = DIM + HALF * (1 + 2 * DIM) + FLOPS_SPECTRUM + DIM * LOGARITHM + 3,
    PLASTIC_STRAINS = STRAINS + DIM * DIM * (2 * DIM - 1) + HALF * 2 * DIM + (DIM < 3 ? LOGARITHM : 0),
    STRESS =
        LOT_COFACTOR + LOT_DETERMINANT + 1 + LOGARITHM + 1 + DIM * DIM + DIM * 4 + DIM * DIM * (LOT_DOT + 1 + 2 * DIM),
    MODULUS = 7 * DIM + DIM * (DIM - 1) / 2 * (LOGARITHM + 5) + 5,
    FASTEST = MODULUS + LOGARITHM + 2,
    YIELD = 12 + 4 + 3,          /* equivalent stress and its excess */
    ENERGY = 16 + LOGARITHM + 6, /* of strains and J */
    RETURN = FLOPS_COFACTOR + FLOPS_DETERMINANT + 1 + 3 * (2 * LOGARITHM + 4) +
             DIM * (DIM * (3 + FLOPS_DOT) + DIM * (DIM + 1) / 2 * (FLOPS_DOT + 2)) + 7
};

static int stress_flops(bool H, bool J)
{
    return (H ? 0 : LOT_COFACTOR) + (J ? 0 : LOT_DETERMINANT) + STRAINS + STRESS;
}

/* Where it flows, with linear hardening. */
static int flow_stress_flops(bool H, bool J)
{
    return stress_flops(H, J) + PLASTIC_STRAINS - STRAINS + YIELD + RETURN;
}

static const struct solver_flow plastic_flow = {
    .width = WIDTH,
    .stress_range = flow_stress_range,
    .stress_flops = flow_stress_flops,
    .fastest_flops = STRAINS + PLASTIC_STRAINS + FASTEST,
    .energy_flops = LOT * PLASTIC_STRAINS + ENERGY, /* in every lane of a lot */
    .energy = energy_of,
    .stress_normal = normal_of,
    .fastest = flow_fastest,
};

const struct solver_material DIM_NAME(solver_hencky) = {
    .flow = &plastic_flow,
    .energy = energy,
    .stress = stress,
    .stress_normal = stress_normal,
    .tangent = tangent,
    .wave_speeds = wave_speeds,
    .stress_range = stress_range,
    .volumetric_range = volumetric_range,
    .stiffness_range = stiffness_range,
    .stress_flops = stress_flops,
    .volumetric_flops = LOGARITHM + 1,
    .stiffness_flops = SOLVER_COST_FUNCTION + 3,
    .fastest_flops = STRAINS + FASTEST,
    .energy_flops = LOT * STRAINS + ENERGY,
    .fastest = fastest,
};
