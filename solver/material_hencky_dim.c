/* Hencky's model (dim_hencky.h). */
#include "solver/dim_hencky.h"

extern const struct solver_flow DIM_NAME(solver_hencky_flow);

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

const struct solver_material DIM_NAME(solver_hencky) = {
    .flow = &DIM_NAME(solver_hencky_flow),
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
