/* Hooke's law, split into deviatoric and volumetric parts:
 *     W = mu e' : e' + kappa/2 (J - 1)^2,   e' = dev sym(F - I),   P = 2 mu e' + kappa (J - 1) I. */
#include "solver/dim.h"
#include "solver/material.h"

#include <math.h>

static struct tensor deviator(struct tensor F, double *mean)
{
    struct tensor D = F;
    for (int I = 0; I < DIM; I++) {
        D.column[I][I] -= 1.0;
    }
    *mean = trace(D) / 3.0;
    struct tensor T = transpose(D);
    for (int I = 0; I < DIM; I++) {
        D.column[I] = 0.5 * (D.column[I] + T.column[I]);
        D.column[I][I] -= *mean;
    }
    return D;
}

static double energy(const struct solver_material_constants *material, const double *F, const double *H, double J)
{
    (void)H;
    double mean;
    struct tensor e = deviator(from_rows(F), &mean);
    double out_of_plane = (3 - DIM) * mean * mean;
    return material->mu * (contract(e, e) + out_of_plane) + 0.5 * material->kappa * (J - 1.0) * (J - 1.0);
}

static inline struct tensor stress_of(const struct solver_material_constants *material, struct tensor F,
                                      const double *J)
{
    double mean;
    struct tensor P = deviator(F, &mean);
    double pressure = material->kappa * (J != NULL ? *J - 1.0 : 3.0 * mean);
    for (int I = 0; I < DIM; I++) {
        P.column[I] *= 2.0 * material->mu;
        P.column[I][I] += pressure;
    }
    return P;
}

static void stress(const struct solver_material_constants *material, const double *F, const double *H, double J,
                   double *P)
{
    (void)H;
    to_rows(stress_of(material, from_rows(F), &J), P);
}

static double stress_normal(const struct solver_material_constants *material, const double *F, double J)
{
    double mean;
    (void)deviator(from_rows(F), &mean);
    return -2.0 * material->mu * mean + material->kappa * (J - 1.0);
}

static void tangent(const struct solver_material_constants *material, const double *F, double *A)
{
    (void)F;
    for (int row = 0; row < DIM * DIM; row++) {
        for (int column = 0; column < DIM * DIM; column++) {
            int i = row / DIM;
            int I = row % DIM;
            int j = column / DIM;
            int J = column % DIM;
            A[row * DIM * DIM + column] =
                material->lambda * (i == I && j == J) + material->mu * ((i == j && I == J) + (i == J && I == j));
        }
    }
}

static void wave_speeds(const struct solver_material_constants *material, const double *F, const double *N,
                        double *speeds)
{
    (void)F;
    (void)N;
    for (int i = 0; i < DIM; i++) {
        speeds[i] = i == DIM - 1 ? material->cp : material->cs;
    }
}

static void stress_range(const struct solver_material_constants *material, size_t begin, size_t end, const double *F,
                         const double *H, const double *J, double *P)
{
    (void)H;
    for (size_t a = begin; a < end; a++) {
        struct tensor at = load_tensor(F + a * DIM * LANES);
        store_tensor(P + a * DIM * LANES, stress_of(material, at, J != NULL ? J + a : NULL));
    }
}

static void volumetric_range(const struct solver_material_constants *material, size_t begin, size_t end,
                             const double *J, double *pressure)
{
    for (size_t a = begin; a < end; a++) {
        pressure[a] = material->kappa * (J[a] - 1.0);
    }
}

static double fastest(const struct solver_material_constants *material, size_t begin, size_t end, const double *F)
{
    (void)begin;
    (void)end;
    (void)F;
    return material->cp;
}

const struct solver_material DIM_NAME(solver_linear_elastic) = {
    .linear = true,
    .energy = energy,
    .stress = stress,
    .stress_normal = stress_normal,
    .tangent = tangent,
    .wave_speeds = wave_speeds,
    .stress_range = stress_range,
    .volumetric_range = volumetric_range,
    .fastest = fastest,
};
