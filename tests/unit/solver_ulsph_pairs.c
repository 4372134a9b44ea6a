/* Updated-Lagrangian SPH: what two particles far from all others see of one another, against formulas written out here
 * (001_363f711843f01da4.txt eq. 11, 12, 14, 16, 17, 41, 43), and the positive part of stress (eq. 18, 19). */
#include "tests/unit/ulsph_states.h"

#include <gsl/gsl_deriv.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_integration.h>

static const double pi = 3.14159265358979323846;

/* The corners of a unit block, as many as 2^dim; all but the first two are far away from everything. */
struct pair {
    struct sample sample;
    size_t dim, lanes;
    double n[3]; /* direction from the first to the second */
};

static struct pair pair_of(size_t dim, const char *terms)
{
    struct pair pair = {.sample = start(ulsph_material, "dim=%zu n=1 ulsph.gradient=plain %s", dim, terms), .dim = dim};
    pair.lanes = pair.sample.run->state.lanes;
    random_direction(dim, pair.n);
    return pair;
}

/* The second particle r along n from the first. */
static void set_apart(const struct pair *pair, double r)
{
    for (size_t a = 0; a < pair->sample.run->cloud->count; a++) {
        for (size_t i = 0; i < pair->dim; i++) {
            pair->sample.run->state.x[a * pair->lanes + i] = a < 2 ? (double)a * r * pair->n[i] : 100.0 * (double)a;
        }
    }
}

/* The second particle's velocity along n and across it; all others rest. */
static void set_velocity(const struct pair *pair, double along, double across)
{
    double *v = pair->sample.run->state.v;
    memset(v, 0, pair->sample.run->cloud->count * pair->lanes * sizeof *v);
    for (size_t i = 0; i < pair->dim; i++) {
        v[pair->lanes + i] = along * pair->n[i];
    }
    if (pair->dim > 1) {
        v[pair->lanes] -= across * pair->n[1];
        v[pair->lanes + 1] += across * pair->n[0];
    }
}

/* Of a padded vector field at particle a, the component along n. */
static double along(const struct pair *pair, const double *vectors, size_t a)
{
    double sum = 0.0;
    for (size_t i = 0; i < pair->dim; i++) {
        sum += vectors[a * pair->lanes + i] * pair->n[i];
    }
    return sum;
}

/* w as the scheme has it: from the transport velocity of the first particle, the second moving at 1 m/s. */
static double kernel_seen(double r, void *of)
{
    struct pair *pair = of;
    double *rho = ulsph_field(&pair->sample, "rho").value;
    set_apart(pair, r);
    set_velocity(pair, 1.0, 0.0);
    ulsph_evaluate(&pair->sample);
    double smoothed = along(pair, ulsph_field(&pair->sample, "transport v").value, 0);
    return smoothed * (rho[0] + rho[1]) / (2.0 * ulsph_mass(&pair->sample, 1));
}

/* -w' as the scheme has it: from the rate of density of the first particle. */
static double slope_seen(struct pair *pair, double r)
{
    (void)kernel_seen(r, pair);
    struct ulsph_field rho = ulsph_field(&pair->sample, "rho");
    double *transport = ulsph_field(&pair->sample, "transport v").value;
    double cell = ldexp(ulsph_mass(&pair->sample, 1), (int)pair->dim) / rho.value[1]; /* corners have 2^-dim of it */
    double jump = along(pair, transport, 1) - along(pair, transport, 0);
    return -rho.rate[0] / (rho.value[0] * cell * jump);
}

static double shell(double r, void *of)
{
    const struct pair *pair = of;
    const double area[] = {2.0, 2.0 * pi * r, 4.0 * pi * r * r};
    return kernel_seen(r, of) * area[pair->dim - 1];
}

/* The kernel integrates to 1 over the line, the plane, space; it ends at the support; its slope is its derivative. */
static void test_kernel(void)
{
    for (size_t dim = 1; dim <= 3; dim++) {
        struct pair pair = pair_of(dim, "ulsph.xsph=1 ulsph.dissipation=none ulsph.tension=none ulsph.delta=0");
        double support = 2.4 * pair.sample.run->cloud->spacing;
        double integral;
        double error;
        size_t calls;
        gsl_function density = {.function = shell, .params = &pair};
        CU_ASSERT_EQUAL_FATAL(gsl_integration_qng(&density, 0.0, support, 0.0, 1e-12, &integral, &error, &calls), 0);
        CU_ASSERT_DOUBLE_EQUAL(integral, 1.0, 1e-12);
        CU_ASSERT_EQUAL(kernel_seen(support, &pair), 0.0);
        CU_ASSERT_EQUAL(kernel_seen(1.1 * support, &pair), 0.0);
        CU_ASSERT(kernel_seen(0.99 * support, &pair) > 0.0);
        gsl_function kernel = {.function = kernel_seen, .params = &pair};
        double height = kernel_seen(0.0, &pair);
        for (double r = 0.05 * support; r < support; r += 0.05 * support) {
            double derivative;
            CU_ASSERT_EQUAL_FATAL(gsl_deriv_central(&kernel, r, 1e-2 * support, &derivative, &error), 0);
            CU_ASSERT_DOUBLE_EQUAL(slope_seen(&pair, r) * support / height, -derivative * support / height, 1e-7);
        }
        finish(&pair.sample);
    }
}

/* Eq. 11 without its height, at r over the support. */
static double wendland(double part)
{
    return pow(1.0 - part, 4.0) * (4.0 * part + 1.0);
}

/* What is left of a tensile force with the artificial stress, as a part of the bare one. */
static double part_left(size_t dim, const char *terms, double r)
{
    double acceleration[2];
    for (size_t i = 0; i < 2; i++) {
        struct pair pair = pair_of(dim, i == 0 ? "ulsph.dissipation=none ulsph.tension=none" : terms);
        struct ulsph_field rho = ulsph_field(&pair.sample, "rho");
        memcpy(pair.n, (const double[]){1.0, 0.0, 0.0}, sizeof pair.n);
        for (size_t a = 0; a < pair.sample.run->cloud->count; a++) {
            rho.value[a] *= a == 0 ? 0.9 : 0.8; /* both in tension, S none */
        }
        set_apart(&pair, r);
        ulsph_evaluate(&pair.sample);
        acceleration[i] = along(&pair, ulsph_field(&pair.sample, "v").rate, 0);
        finish(&pair.sample);
    }
    return acceleration[1] / acceleration[0];
}

/* Eq. 17: f = epsilon (w / w(d0))^n of the force in tension is taken back; or what of f exceeds epsilon. */
static void test_artificial_stress(void)
{
    static const double distances[] = {0.6, 0.9, 1.0, 1.3, 2.0}; /* the spacing is 1 */
    for (size_t dim = 1; dim <= 3; dim++) {
        for (size_t i = 0; i < sizeof distances / sizeof *distances; i++) {
            double f = 0.3 * pow(wendland(distances[i] / 2.4) / wendland(1.0 / 2.4), 4.0);
            static const char terms[] = "ulsph.dissipation=none ulsph.tension=stress ulsph.stress_factor=0.3 "
                                        "ulsph.stress_exponent=4 ulsph.repulsion=";
            char words[256];
            (void)snprintf(words, sizeof words, "%sprinted", terms);
            CU_ASSERT_DOUBLE_EQUAL(part_left(dim, words, distances[i]), 1.0 - f, 1e-12 * (1.0 + f));
            (void)snprintf(words, sizeof words, "%sexcess", terms);
            CU_ASSERT_DOUBLE_EQUAL(part_left(dim, words, distances[i]), 1.0 - fmax(0.0, f - 0.3), 1e-12 * (1.0 + f));
        }
    }
}

/* What an approach adds to the first particle's acceleration along n. */
static double added_by_approach(struct pair *pair, double r, double approach)
{
    double *rate = ulsph_field(&pair->sample, "v").rate;
    set_apart(pair, r);
    set_velocity(pair, 0.0, 0.4);
    ulsph_evaluate(&pair->sample);
    double before = along(pair, rate, 0);
    set_velocity(pair, -approach, 0.4);
    ulsph_evaluate(&pair->sample);
    return along(pair, rate, 0) - before;
}

/* Eq. 16 with alpha = 0.7; r is over the spacing, which is 1 m. */
static void test_viscosity(void)
{
    static const double h = 1.2;
    for (size_t dim = 1; dim <= 3; dim++) {
        struct pair pair =
            pair_of(dim, "ulsph.dissipation=viscosity ulsph.viscosity=0.7 ulsph.tension=none ulsph.delta=0");
        const struct solver_material_constants *constants = pair.sample.run->constants;
        double c = sqrt(constants->kappa / constants->rho);
        double m = ulsph_mass(&pair.sample, 1);
        double *rho = ulsph_field(&pair.sample, "rho").value;
        rho[0] *= 1.1;
        rho[1] *= 0.8;
        for (double r = 0.3; r < 2.4; r += 0.3) {
            double slope = slope_seen(&pair, r);
            double Pi = -0.7 * h * c / (0.5 * (rho[0] + rho[1])) * 0.2 * r / (r * r + 0.01 * h * h);
            CU_ASSERT_DOUBLE_EQUAL(added_by_approach(&pair, r, 0.2), m * Pi * slope, 1e-13);
            CU_ASSERT_EQUAL(added_by_approach(&pair, r, -0.2), 0.0);
        }
        finish(&pair.sample);
    }
}

/* Eq. 41, 43 and 44: of the jump, what the gradients at both ends do not explain. Here a gradient is made by the other
 * particle alone: V_j w' of the jump over r. */
static void test_riemann(void)
{
    for (size_t dim = 1; dim <= 3; dim++) {
        struct pair pair = pair_of(dim, "ulsph.dissipation=riemann ulsph.tension=none ulsph.delta=0");
        const struct solver_material_constants *constants = pair.sample.run->constants;
        double c = sqrt(constants->kappa / constants->rho);
        double m = ulsph_mass(&pair.sample, 1);
        double *rho = ulsph_field(&pair.sample, "rho").value;
        rho[0] *= 1.1;
        rho[1] *= 0.8;
        double impedance = c * (pow(rho[0], 1.5) + pow(rho[1], 1.5)) / (sqrt(rho[0]) + sqrt(rho[1])); /* C_ij, eq. 41 */
        for (double r = 0.3; r < 2.4; r += 0.3) {
            double slope = slope_seen(&pair, r);
            double explained = 0.5 * ldexp(m, (int)dim) * (1.0 / rho[0] + 1.0 / rho[1]) * slope * r;
            for (double approach = -0.2; approach < 0.3; approach += 0.4) {
                double Pi = -2.0 * impedance * approach * (1.0 - explained) / (rho[0] * rho[1]);
                CU_ASSERT_DOUBLE_EQUAL(added_by_approach(&pair, r, approach), m * Pi * slope, 1e-13);
            }
        }
        finish(&pair.sample);
    }
}

/* Eq. 33 to 35, both ends again: what the gradients leave of the difference, which flows from the denser. */
static void test_diffusion(void)
{
    for (size_t dim = 1; dim <= 3; dim++) {
        struct pair pair = pair_of(dim, "ulsph.delta=0.1");
        struct pair still = pair_of(dim, "ulsph.delta=0");
        const struct solver_material_constants *constants = pair.sample.run->constants;
        double c = sqrt(constants->kappa / constants->rho);
        double m = ulsph_mass(&pair.sample, 1);
        struct ulsph_field rho = ulsph_field(&pair.sample, "rho");
        memcpy(still.n, pair.n, sizeof pair.n);
        rho.value[0] *= 1.1;
        rho.value[1] *= 0.8;
        for (double r = 0.3; r < 2.4; r += 0.3) {
            ulsph_copy(&pair.sample, &still.sample);
            double slope = slope_seen(&still, r);
            set_apart(&pair, r);
            set_velocity(&pair, 0.0, 0.0);
            ulsph_evaluate(&pair.sample);
            double explained = 0.5 * ldexp(m, (int)dim) * (1.0 / rho.value[0] + 1.0 / rho.value[1]) * slope * r;
            double psi = 2.0 * (rho.value[1] - rho.value[0]) * (1.0 - explained);
            double expected = 0.1 * 1.2 * c * psi * slope / r * m / rho.value[1];
            CU_ASSERT_DOUBLE_EQUAL(rho.rate[0], expected, 1e-13);
        }
        finish(&pair.sample);
        finish(&still.sample);
    }
}

/* sigma+ of GSL's eigensystem. */
static void positive_part(size_t dim, const double *sigma, double *positive)
{
    double copy[9];
    memcpy(copy, sigma, dim * dim * sizeof *copy);
    gsl_matrix_view matrix = gsl_matrix_view_array(copy, dim, dim);
    gsl_vector *value = gsl_vector_alloc(dim);
    gsl_matrix *vector = gsl_matrix_alloc(dim, dim);
    gsl_eigen_symmv_workspace *room = gsl_eigen_symmv_alloc(dim);
    CU_ASSERT_EQUAL_FATAL(gsl_eigen_symmv(&matrix.matrix, value, vector, room), 0);
    memset(positive, 0, dim * dim * sizeof *positive);
    for (size_t k = 0; k < dim; k++) {
        double lambda = fmax(gsl_vector_get(value, k), 0.0);
        for (size_t i = 0; i < dim * dim; i++) {
            positive[i] += lambda * gsl_matrix_get(vector, i / dim, k) * gsl_matrix_get(vector, i % dim, k);
        }
    }
    gsl_eigen_symmv_free(room);
    gsl_matrix_free(vector);
    gsl_vector_free(value);
}

/* R diag(principal) R^T in a random frame; the frame of the axes every third time. */
static void stress_of(size_t dim, const double *principal, size_t trial, double *sigma)
{
    double R[9];
    random_rotation(dim, R);
    if (trial % 3 == 0) {
        unit_tensor(dim, R);
    }
    memset(sigma, 0, dim * dim * sizeof *sigma);
    for (size_t i = 0; i < dim; i++) {
        for (size_t j = 0; j <= i; j++) {
            for (size_t k = 0; k < dim; k++) {
                sigma[i * dim + j] += R[i * dim + k] * principal[k] * R[j * dim + k];
            }
            sigma[j * dim + i] = sigma[i * dim + j];
        }
    }
}

/* Principal stresses that are random, repeated, nearly so, zero, and far apart in size. */
static void test_positive_part(void)
{
    static const double principal[][3] = {
        {0, 0, 0},         {1, 1, 1},         {-1, -1, -1},         {2, 2, -3},    {-2, 5, -2},
        {1, 1 + 1e-9, -1}, {1, 1 + 1e-15, 1}, {1e-15, -1e-15, 1},   {1, 0, 0},     {0, -1, 0},
        {1e8, -1e-8, 1},   {1e8, 1e8, -1e8},  {1e-300, -1e-300, 0}, {0, 0, 1e-200}};
    for (size_t dim = 1; dim <= 3; dim++) {
        struct sample sample = start(ulsph_material, "dim=%zu n=1 ulsph.gradient=plain ulsph.tension=stress", dim);
        double *S = ulsph_field(&sample, "S").value;
        double *tensile = ulsph_field(&sample, "sigma+ L").value;
        for (size_t trial = 0; trial < 300; trial++) {
            double random[] = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
            size_t row = trial % (sizeof principal / sizeof *principal * 2);
            double sigma[9];
            double expected[9];
            double found[9];
            stress_of(dim, row % 2 == 0 ? random : principal[row / 2], trial, sigma);
            for (size_t k = 0; k < dim * dim; k++) {
                *ulsph_entry(&sample, S, 0, k / dim, k % dim) = sigma[k];
            }
            ulsph_evaluate(&sample);
            for (size_t k = 0; k < dim * dim; k++) {
                found[k] = *ulsph_entry(&sample, tensile, 0, k / dim, k % dim);
            }
            positive_part(dim, sigma, expected);
            double size = largest_entry(dim * dim, sigma);
            expect_below("positive part", largest_difference(dim * dim, expected, found), 1e-14 * size);
        }
        finish(&sample);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"kernel", test_kernel},
        {"artificial stress", test_artificial_stress},
        {"artificial viscosity", test_viscosity},
        {"Riemann term", test_riemann},
        {"density diffusion", test_diffusion},
        {"positive part of stress", test_positive_part},
    };
    return unit_main("ulsph pairs", tests, sizeof tests / sizeof *tests);
}
