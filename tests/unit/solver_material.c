/* One conformance suite for every material in 1, 2 and 3 dimensions: energy, stress and tangent. */
#include "tests/unit/materials.h"

#include <fenv.h>

/* Central differences of sixth order over this step: truncation and round-off are both near 1e-13. */
static const double step = 4e-3;
static const double at[] = {-3, -2, -1, 1, 2, 3};
static const double weight[] = {-1.0 / 60, 9.0 / 60, -45.0 / 60, 45.0 / 60, -9.0 / 60, 1.0 / 60};

/* dW/d(argument), the argument being one number of size `size` within F, H or J. */
static double energy_slope(const struct sample *sample, const double *F, const double *H, const double *J,
                           double *argument, double size)
{
    double kept = *argument;
    double slope = 0.0;
    for (int i = 0; i < 6; i++) {
        *argument = kept + at[i] * step * size;
        slope += weight[i] / (step * size) * sample->material->energy(&sample->constants, F, H, *J);
    }
    *argument = kept;
    return slope;
}

/* P = dW/dF + dW/dH : dH/dF + dW/dJ dJ/dF with F, H and J independent, as in {p,F,H,J}. */
static void stress_is_slope_of_energy(const struct sample *sample)
{
    size_t dim = sample->dim;
    size_t size = dim * dim;
    for (int i = 0; i < SAMPLES; i++) {
        double F[9];
        double H[9];
        double J;
        double P[9];
        double slopes[9];
        double by_H[9];
        random_deformation(dim, F);
        measures(sample, F, H, &J);
        for (size_t k = 0; k < size; k++) {
            H[k] += uniform(-0.05, 0.05);
        }
        J *= uniform(0.9, 1.1);
        sample->material->stress(&sample->constants, F, H, J, P);
        double by_J = energy_slope(sample, F, H, &J, &J, J);
        for (size_t k = 0; k < size; k++) {
            by_H[k] = energy_slope(sample, F, H, &J, &H[k], 1.0);
        }
        for (size_t k = 0; k < size; k++) {
            double up[9];
            double down[9];
            double ahead[9];
            double behind[9];
            double unused;
            memcpy(ahead, F, sizeof ahead);
            memcpy(behind, F, sizeof behind);
            ahead[k] += 0.5;
            behind[k] -= 0.5;
            measures(sample, ahead, up, &unused);
            measures(sample, behind, down, &unused); /* quadratic at most: the difference over 1 is the slope */
            slopes[k] = energy_slope(sample, F, H, &J, &F[k], 1.0);
            slopes[k] += by_J * (!sample->material->linear ? H[k] : k / dim == k % dim ? 1.0 : 0.0);
            for (size_t m = 0; m < size; m++) {
                slopes[k] += by_H[m] * (up[m] - down[m]);
            }
        }
        expect(sample, "stress against slope of energy", largest_difference(size, P, slopes),
               1e-10 * (sample->modulus + largest_entry(size, P)));
    }
}

static void tangent_is_slope_of_stress(const struct sample *sample)
{
    size_t size = sample->dim * sample->dim;
    for (int i = 0; i < SAMPLES; i++) {
        double F[9];
        double A[81];
        double slopes[81] = {0};
        double transposed[81];
        random_deformation(sample->dim, F);
        sample->material->tangent(&sample->constants, F, A);
        for (size_t column = 0; column < size; column++) {
            double kept = F[column];
            for (int k = 0; k < 6; k++) {
                double P[9];
                F[column] = kept + at[k] * step;
                stress(sample, F, P);
                for (size_t row = 0; row < size; row++) {
                    slopes[row * size + column] += weight[k] / step * P[row];
                }
            }
            F[column] = kept;
            for (size_t row = 0; row < size; row++) {
                transposed[column * size + row] = A[row * size + column];
            }
        }
        double scale = sample->modulus + largest_entry(size * size, A);
        expect(sample, "tangent against slope of stress", largest_difference(size * size, A, slopes), 1e-10 * scale);
        expect(sample, "major symmetry", largest_difference(size * size, A, transposed), 1e-15 * scale);
    }
}

static void nothing_at_rest(const struct sample *sample)
{
    size_t dim = sample->dim;
    double F[9];
    double P[9];
    double A[81];
    double round_off = 0x1p-52 * sample->modulus;
    unit_tensor(dim, F);
    stress(sample, F, P);
    expect(sample, "energy at rest", fabs(energy(sample, F)), 0.0);
    expect(sample, "stress at rest", largest_entry(dim * dim, P), round_off);
    if (dim < 3) {
        expect(sample, "normal stress at rest", fabs(sample->material->stress_normal(&sample->constants, F, 1.0)),
               round_off);
    }
    sample->material->tangent(&sample->constants, F, A);
    for (size_t m = 0; m < dim * dim * dim * dim; m++) { /* Hooke's law, isotropic */
        size_t i = m / (dim * dim * dim);
        size_t I = m / (dim * dim) % dim;
        size_t j = m / dim % dim;
        size_t J = m % dim;
        A[m] -= sample->constants.lambda * (i == I && j == J) +
                sample->constants.mu * ((i == j && I == J) + (i == J && I == j));
    }
    expect(sample, "tangent at rest against Hooke's law", largest_entry(dim * dim * dim * dim, A),
           4e-15 * sample->modulus);
}

static void energy_is_positive(const struct sample *sample)
{
    for (int i = 0; i < SAMPLES; i++) {
        double F[9];
        random_deformation(sample->dim, F);
        expect(sample, "energy of a deformed body, negated", -energy(sample, F), -1e-12 * sample->modulus);
    }
}

/* W(R F) = W(F) and P(R F) = R P(F); with linear kinematics an added skew tensor changes neither W nor P. */
static void objectivity(const struct sample *sample)
{
    size_t dim = sample->dim;
    for (int i = 0; i < SAMPLES; i++) {
        double F[9];
        double turned[9];
        double R[9];
        double P[9];
        double expected[9];
        double P_turned[9];
        random_deformation(dim, F);
        random_rotation(dim, R);
        stress(sample, F, P);
        if (sample->material->linear) {
            memcpy(expected, P, sizeof expected);
            memcpy(turned, F, sizeof turned);
            for (size_t k = 0; k < dim * dim; k++) {
                turned[k] += R[k] - R[k % dim * dim + k / dim];
            }
        } else {
            multiply(dim, R, P, expected);
            multiply(dim, R, F, turned);
        }
        stress(sample, turned, P_turned);
        double scale = sample->modulus + largest_entry(dim * dim, P);
        double W = energy(sample, F);
        expect(sample, "energy under rotation", fabs(energy(sample, turned) - W), 2e-14 * (sample->modulus + W));
        expect(sample, "stress under rotation", largest_difference(dim * dim, P_turned, expected), 4e-14 * scale);
    }
}

static void embed(size_t dim, const double *in_plane, double out_of_plane, double *out)
{
    for (size_t k = 0; k < 9; k++) {
        size_t i = k / 3;
        size_t j = k % 3;
        out[k] = i < dim && j < dim ? in_plane[i * dim + j] : i == j ? out_of_plane : 0.0;
    }
}

/* Plane and uniaxial strain are the three-dimensional material with F the identity out of the plane. */
static void embedded(const struct sample *sample)
{
    size_t dim = sample->dim;
    const struct solver_material_constants *constants = &sample->constants;
    for (int n = 0; dim < 3 && n < SAMPLES; n++) {
        double F[9];
        double H[9];
        double J;
        double F_3d[9];
        double H_3d[9];
        double P[9];
        double P_3d[9];
        double A[16];
        double A_3d[81];
        random_deformation(dim, F);
        measures(sample, F, H, &J);
        embed(dim, F, 1.0, F_3d);
        embed(dim, H, J, H_3d); /* H_zz = det F: the area normal to the plane lies in it */
        J *= uniform(0.9, 1.1); /* an evolved Jacobian goes its own way, the cofactor does not follow it */
        sample->material->stress(constants, F, H, J, P);
        sample->in_3d->stress(constants, F_3d, H_3d, J, P_3d);
        double W = sample->in_3d->energy(constants, F_3d, H_3d, J);
        double scale = sample->modulus + largest_entry(9, P_3d);
        expect(sample, "energy against 3D", fabs(sample->material->energy(constants, F, H, J) - W),
               1e-14 * (sample->modulus + W));
        sample->material->tangent(constants, F, A);
        sample->in_3d->tangent(constants, F_3d, A_3d);
        double normal = sample->material->stress_normal(constants, F, J);
        for (size_t k = 0; k < 9; k++) {
            size_t i = k / 3;
            size_t I = k % 3;
            double expected = i < dim && I < dim ? P[i * dim + I] : i == I ? normal : 0.0;
            expect(sample, "stress against 3D", fabs(P_3d[k] - expected), 1e-14 * scale);
        }
        double A_scale = sample->modulus + largest_entry(81, A_3d);
        for (size_t m = 0; m < dim * dim * dim * dim; m++) {
            size_t row = m / (dim * dim);
            size_t column = m % (dim * dim);
            size_t row_3d = row / dim * 3 + row % dim;
            size_t column_3d = column / dim * 3 + column % dim;
            expect(sample, "tangent against 3D", fabs(A[m] - A_3d[row_3d * 9 + column_3d]), 1e-14 * A_scale);
        }
    }
}

static void test_stress(void)
{
    each(stress_is_slope_of_energy);
}

static void test_tangent(void)
{
    each(tangent_is_slope_of_stress);
}

static void test_rest(void)
{
    each(nothing_at_rest);
}

static void test_energy(void)
{
    each(energy_is_positive);
}

static void test_objectivity(void)
{
    each(objectivity);
}

static void test_embedded(void)
{
    each(embedded);
}

static void test_constants(void)
{
    for (size_t i = 0; i < sizeof ratios / sizeof *ratios; i++) {
        double E = 17e6;
        double nu = ratios[i];
        double rho = 1100.0;
        struct solver_material_constants c = solver_material_constants(E, nu, rho);
        /* round trips, and the p-wave modulus from E and nu by its own formula */
        CU_ASSERT_DOUBLE_EQUAL(9.0 * c.kappa * c.mu / (3.0 * c.kappa + c.mu) / E, 1.0, 1e-13);
        CU_ASSERT_DOUBLE_EQUAL(c.lambda / (2.0 * (c.lambda + c.mu)), nu, 1e-12);
        CU_ASSERT_DOUBLE_EQUAL((c.lambda + 2.0 / 3.0 * c.mu) / c.kappa, 1.0, 1e-12);
        double p_wave = E * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
        CU_ASSERT_DOUBLE_EQUAL(rho * c.cp * c.cp / p_wave, 1.0, 1e-12);
        CU_ASSERT_DOUBLE_EQUAL(rho * c.cs * c.cs / c.mu, 1.0, 1e-14);
        CU_ASSERT_EQUAL(c.rho, rho);
    }
}

static void test_table(void)
{
    size_t count = 0;
    for (const struct solver_material_model *model = solver_material_models(); model->name != NULL; model++, count++) {
        CU_ASSERT_PTR_EQUAL(solver_material_find(model->name), model);
        CU_ASSERT_PTR_NOT_NULL(model->summary);
        CU_ASSERT_EQUAL(model->in[0]->linear, model->in[2]->linear);
        CU_ASSERT_EQUAL(model->in[1]->linear, model->in[2]->linear);
    }
    CU_ASSERT(count >= 2);
    CU_ASSERT_PTR_NULL(solver_material_find("linear"));
    CU_ASSERT_PTR_NULL(solver_material_find(""));
}

/* At nu = 0.5 nothing is divided by zero on the way to moduli that are infinite. */
static void test_incompressible(void)
{
    (void)feclearexcept(FE_ALL_EXCEPT);
    struct solver_material_constants constants = solver_material_constants(17e6, 0.5, 1100);
    CU_ASSERT_EQUAL(fetestexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW), 0);
    CU_ASSERT(isinf(constants.kappa) && isinf(constants.lambda) && isinf(constants.cp));
    CU_ASSERT_DOUBLE_EQUAL(constants.mu, 17e6 / 3.0, 1e-9);
    CU_ASSERT_DOUBLE_EQUAL(constants.cs, sqrt(17e6 / 3.0 / 1100), 1e-9);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"the table finds its members", test_table},
        {"constants fit each other", test_constants},
        {"incompressible", test_incompressible},
        {"stress is the slope of the energy", test_stress},
        {"tangent is the slope of the stress, and symmetric", test_tangent},
        {"at rest: no energy, no stress, Hooke's tangent", test_rest},
        {"energy is positive", test_energy},
        {"objectivity", test_objectivity},
        {"one and two dimensions are three with F embedded", test_embedded},
    };
    return unit_main("materials", tests, sizeof tests / sizeof *tests);
}
