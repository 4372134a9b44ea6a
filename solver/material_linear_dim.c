/* Hooke's law, split into deviatoric and volumetric parts:
 *     W = mu e' : e' + kappa/2 (J - 1)^2,   e' = dev sym(F - I),   P = 2 mu e' + kappa (J - 1) I. */
#include "solver/dim.h"
#include "solver/dim_flops.h"
#include "solver/material.h"

#include <math.h>

/* F is [DIM] columns or rows of the given stride: Hooke's law is the same for F and its transpose. */
static inline double mean_strain(const double *F, int stride)
{
    double sum = 0.0;
    for (int I = 0; I < DIM; I++) {
        sum += F[I * stride + I] - 1.0;
    }
    return sum / 3.0;
}

/* J NULL: 1 + tr(F - I) */
static inline void hooke(const struct solver_material_constants *material, const double *F, int stride, const double *J,
                         double *P)
{
    double mean = mean_strain(F, stride);
    double pressure = material->kappa * (J != NULL ? *J - 1.0 : 3.0 * mean);
    for (int I = 0; I < DIM; I++) {
        P[I * stride + I] = 2.0 * material->mu * (F[I * stride + I] - 1.0 - mean) + pressure;
        for (int i = 0; i < I; i++) {
            double shear = material->mu * (F[I * stride + i] + F[i * stride + I]);
            P[I * stride + i] = shear;
            P[i * stride + I] = shear;
        }
    }
}

static double energy(const struct solver_material_constants *material, const double *F, const double *H, double J)
{
    (void)H;
    double mean = mean_strain(F, DIM);
    double square = (3 - DIM) * mean * mean;
    for (int i = 0; i < DIM; i++) {
        for (int I = 0; I < DIM; I++) {
            double e = 0.5 * (F[i * DIM + I] + F[I * DIM + i]) - (i == I ? 1.0 + mean : 0.0);
            square += e * e;
        }
    }
    return material->mu * square + 0.5 * material->kappa * (J - 1.0) * (J - 1.0);
}

static void stress(const struct solver_material_constants *material, const double *F, const double *H, double J,
                   double *P)
{
    (void)H;
    hooke(material, F, DIM, &J, P);
}

static double stress_normal(const struct solver_material_constants *material, const double *F, double J)
{
    return -2.0 * material->mu * mean_strain(F, DIM) + material->kappa * (J - 1.0);
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

static void stress_range(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                         const double *F, const double *H, const double *J, double *P)
{
    (void)H;
    for (size_t a = begin; a < end; a++) {
        hooke(material + a * stride, F + a * DIM * LANES, LANES, J != NULL ? J + a : NULL, P + a * DIM * LANES);
    }
}

static void volumetric_range(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                             const double *J, double *pressure)
{
    for (size_t a = begin; a < end; a++) {
        pressure[a] = material[a * stride].kappa * (J[a] - 1.0);
    }
}

static double fastest(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                      const double *F)
{
    (void)F;
    double speed = material[begin * stride].cp;
    for (size_t a = begin; stride != 0 && a < end; a++) {
        speed = fmax(speed, material[a].cp);
    }
    return speed;
}

static int stress_flops(bool H, bool J)
{
    (void)H;
    (void)J; /* as many for either */
    return (2 * DIM + 1) + 2 + 5 * DIM + DIM * (DIM - 1);
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
    .stress_flops = stress_flops,
    .volumetric_flops = 2,
    .energy_flops = (2 * DIM + 1) + 2 + 5 * DIM * DIM + DIM + 7,
    .fastest = fastest,
};
