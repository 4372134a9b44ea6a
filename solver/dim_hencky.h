/* Hencky's model, quadratic in logarithmic strains, and von Mises plasticity with isotropic hardening upon it
 * (000_e9ec29e1bde7947d.txt, Algorithm 2):
 *     W = mu e' : e' + kappa/2 (ln J)^2,   e' = dev ln V_e,   V_e^2 = b_e = F Cp^-1 F^T,
 *     tau = 2 mu e' + kappa ln J 1,   P = dev(tau) F^-T + kappa ln(J)/J H.
 * An evolved J and H enter the volumetric part alone, as in the neo-Hookean model. In the algorithm ln J is subtracted
 * from the strains; here it is their own mean, so that e' is a deviator whatever round-off has done to det Cp.
 * Principal strains come from b_e - 1, which small strains leave exact: (F - 1) + (F - 1)^T + (F - 1) (F - 1)^T, and
 * what is remembered of Cp^-1 is its difference from the identity, for the same reason. */
#ifndef SOLVER_DIM_HENCKY_H
#define SOLVER_DIM_HENCKY_H

#include "solver/dim_flops.h"
#include "solver/dim_ranges.h"
#include "solver/dim_spectral.h"

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

/* d coth d, where d is the difference of two logarithmic strains. */
static inline double d_coth(double d)
{
    return d == 0.0 ? 1.0 : d / tanh(d);
}

/* Along N with w = F^-T N, for a unit vector m, rho c^2 of the elastic response to a change of F is
 *     lambda (m.w)^2 + 2 sum_i (mu - tau_i) m_i^2 w_i^2 + sum_{i<j} g_ij (m_i w_j + m_j w_i)^2 + sum_i tau_i w_i^2,
 * g_ij = mu d coth(d) - (tau_i + tau_j)/2 (material_hencky_dim.c). With M the largest of mu - tau_i and g_ij, the
 * second and third term are at most M (|w|^2 + (m.w)^2). */
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
    ENERGY = 16 + LOGARITHM + 6 /* of strains and J */
};

static inline int stress_flops(bool H, bool J)
{
    return (H ? 0 : LOT_COFACTOR) + (J ? 0 : LOT_DETERMINANT) + STRAINS + STRESS;
}

#endif
