/* Hooke's law, split into deviatoric and volumetric parts:
 *     W = mu e' : e' + kappa/2 (J - 1)^2,   e' = dev sym(F - I),   P = 2 mu e' + kappa (J - 1) I. */
#define WIDE_LOTS
#include "solver/dim.h"
#include "solver/dim_flops.h"
#include "solver/dim_ranges.h"
#include "solver/material.h"

#include <math.h>

/* A lot at a time. J NULL: 1 + tr(F - I) */
static inline __attribute__((always_inline)) struct tensors hooke(const struct constants *of, const struct tensors *F,
                                                                  const lot *J)
{
    lot sum = F->column[0][0] - 1.0;
    for (int I = 1; I < DIM; I++) {
        sum += F->column[I][I] - 1.0;
    }
    lot mean = sum / 3.0;
    lot pressure = of->kappa * (J != NULL ? *J - 1.0 : 3.0 * mean);
    lot twice = 2.0 * of->mu;
    struct tensors P;
    for (int I = 0; I < DIM; I++) {
        P.column[I][I] = twice * (F->column[I][I] - 1.0 - mean) + pressure;
        for (int i = 0; i < I; i++) {
            P.column[I][i] = P.column[i][I] = of->mu * (F->column[I][i] + F->column[i][I]);
        }
    }
    return P;
}

/* Of rows. */
static inline double mean_strain(const double *F)
{
    double sum = 0.0;
    for (int I = 0; I < DIM; I++) {
        sum += F[I * DIM + I] - 1.0;
    }
    return sum / 3.0;
}

static double energy(const struct solver_material_constants *material, const double *F, const double *H, double J)
{
    (void)H;
    double mean = mean_strain(F);
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
    struct constants of = constants_of(material, 0);
    struct tensors at = tensors_of(from_rows(F));
    lot jacobian = lot_of(J);
    struct tensors stresses = hooke(&of, &at, &jacobian);
    for (int i = 0; i < DIM; i++) {
        for (int I = 0; I < DIM; I++) {
            P[i * DIM + I] = stresses.column[I][i][0];
        }
    }
}

static double stress_normal(const struct solver_material_constants *material, const double *F, double J)
{
    return -2.0 * material->mu * mean_strain(F) + material->kappa * (J - 1.0);
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

static inline __attribute__((always_inline)) void stresses_as(const struct solver_material_constants *material,
                                                              size_t stride, size_t count, const double *F,
                                                              const double *J, double *P, bool evolved)
{
    struct constants here = {.mu = {0}};
    for (size_t a = 0; a < count; a += LOT) {
        if (a == 0 || stride != 0) {
            here = constants_of(material + a * stride, stride);
        }
        struct tensors at = load_tensors(F + a * TENSOR_WIDTH);
        lot jacobian = evolved ? load_lot(J + a) : lot_of(1.0);
        struct tensors stresses = hooke(&here, &at, evolved ? &jacobian : NULL);
        store_tensors(P + a * TENSOR_WIDTH, &stresses);
    }
}

static __attribute__((noinline)) void stress_of_whole(const struct solver_material_constants *material, size_t stride,
                                                      size_t count, const double *F, const double *H, const double *J,
                                                      double *P)
{
    (void)H;
    if (J != NULL) {
        stresses_as(material, stride, count, F, J, P, true);
    } else {
        stresses_as(material, stride, count, F, J, P, false);
    }
}

static void stress_range(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                         const double *F, const double *H, const double *J, double *P)
{
    (void)H; /* none is filled */
    stress_by_lots(stress_of_whole, material, stride, begin, end, F, NULL, J, P);
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
    return 2 * DIM + 2 + 1 + 4 * DIM + DIM * (DIM - 1);
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
