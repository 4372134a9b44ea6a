/* One conformance suite for every material in 1, 2 and 3 dimensions: wave speeds, and the loops over particles. */
#include "tests/unit/padded.h"

#include <float.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_sort_double.h>

/* Eigenvalues of A_iIjJ N_I N_J, increasing. */
static void acoustic_eigenvalues(const struct sample *sample, const double *F, const double *N, double *values)
{
    size_t dim = sample->dim;
    double A[81];
    double Q[9] = {0};
    sample->material->tangent(&sample->constants, F, A);
    for (size_t m = 0; m < dim * dim * dim * dim; m++) {
        size_t i = m / (dim * dim * dim);
        size_t j = m / dim % dim;
        Q[i * dim + j] += A[m] * N[m / (dim * dim) % dim] * N[m % dim];
    }
    gsl_matrix_view matrix = gsl_matrix_view_array(Q, dim, dim);
    gsl_vector_view vector = gsl_vector_view_array(values, dim);
    gsl_eigen_symm_workspace *work = gsl_eigen_symm_alloc(dim);
    CU_ASSERT_PTR_NOT_NULL_FATAL(work);
    CU_ASSERT_EQUAL(gsl_eigen_symm(&matrix.matrix, &vector.vector, work), 0);
    gsl_eigen_symm_free(work);
    gsl_sort(values, 1, dim);
}

static void wave_speeds(const struct sample *sample)
{
    size_t dim = sample->dim;
    for (int i = 0; i < SAMPLES; i++) {
        double F[9];
        double N[3];
        double speeds[3];
        double values[3];
        if (i > 0) {
            random_deformation(dim, F);
        } else {
            unit_tensor(dim, F);
        }
        random_direction(dim, N);
        acoustic_eigenvalues(sample, F, N, values);
        sample->material->wave_speeds(&sample->constants, F, N, speeds);
        for (size_t k = 0; k < dim; k++) {
            double square = sample->constants.rho * speeds[k] * speeds[k];
            /* below zero: the material has lost its ellipticity, and the wave stands */
            expect(sample, "wave speeds against the acoustic tensor", fabs(square - fmax(values[k], 0.0)),
                   1e-13 * (sample->modulus + values[dim - 1]));
            double at_rest = k + 1 == dim ? sample->constants.cp : sample->constants.cs;
            if (i == 0) {
                expect(sample, "wave speeds at rest", fabs(speeds[k] - at_rest), 1e-12 * sample->constants.cp);
            }
        }
    }
}

static void fastest_bounds_speeds(const struct sample *sample)
{
    size_t dim = sample->dim;
    double *field = padded_field(dim, SAMPLES);
    double F[9];
    unit_tensor(dim, F);
    for (size_t a = 0; a < SAMPLES; a++) {
        pad(dim, F, a, field);
    }
    double rest = sample->material->fastest(&sample->constants, 0, 0, SAMPLES, field);
    expect(sample, "bound of the speeds at rest", fabs(rest / sample->constants.cp - 1.0), 1e-14);
    double overall = 0.0;
    for (size_t a = 0; a < SAMPLES; a++) {
        random_deformation(dim, F);
        pad(dim, F, a, field);
        double bound = sample->material->fastest(&sample->constants, 0, a, a + 1, field);
        overall = fmax(overall, bound);
        for (int i = 0; i < 50; i++) {
            double N[3];
            double speeds[3];
            random_direction(dim, N);
            sample->material->wave_speeds(&sample->constants, F, N, speeds);
            expect(sample, "fastest wave over its bound", speeds[dim - 1] / bound, 1.0 + 1e-14);
        }
        expect(sample, "bound over ten times the p-wave of an eightfold stretch", bound,
               80.0 * (sample->constants.cp + sample->constants.cs));
    }
    double together = sample->material->fastest(&sample->constants, 0, 0, SAMPLES, field);
    expect(sample, "bound over a range against that of its particles", fabs(together - overall), 0.0);
    free(field);
}

/* What two evaluations of a stress may differ by, if each rounds every factor of its terms 14 times at most: those of
 * the neo-Hookean models, which the others' do not exceed. */
static double round_off(const struct sample *sample, const double *F, const double *H, double J)
{
    size_t entries = sample->dim * sample->dim;
    double own[9];
    double of_F = fabs(determinant_of(sample->dim, F));
    double isochoric = fmin(of_F, fabs(J));
    double FF = 3.0 - (double)sample->dim;
    cofactor_of(sample->dim, F, own);
    for (size_t k = 0; k < entries; k++) {
        FF += F[k] * F[k];
    }
    double cof = fmax(largest_entry(entries, own), largest_entry(entries, H));
    double shear = sample->constants.mu / cbrt(isochoric * isochoric);
    double terms = shear * (largest_entry(entries, F) + FF / (3.0 * isochoric) * cof) +
                   sample->constants.kappa * (fmax(of_F, fabs(J)) + 1.0) * cof;
    return 14.0 * DBL_EPSILON * terms;
}

/* The hot loop against the pointwise stress, inside its range and nowhere else. */
static void stress_range(const struct sample *sample)
{
    enum { COUNT = 21, BEGIN = 3, END = 18 };
    size_t dim = sample->dim;
    double *field[4];
    double J[COUNT];
    double rows[COUNT][9];
    double own[COUNT][9];
    double other[COUNT][9];
    double differs[COUNT];
    for (int i = 0; i < 4; i++) {
        field[i] = padded_field(dim, COUNT);
    }
    for (size_t a = 0; a < COUNT; a++) {
        double H[9];
        random_deformation(dim, rows[a]);
        stress(sample, rows[a], own[a]);
        measures(sample, rows[a], H, &J[a]);
        for (size_t k = 0; k < dim * dim; k++) {
            H[k] *= uniform(0.9, 1.1);
        }
        J[a] *= uniform(0.9, 1.1);
        sample->material->stress(&sample->constants, rows[a], H, J[a], other[a]);
        differs[a] = round_off(sample, rows[a], H, J[a]);
        pad(dim, rows[a], a, field[0]);
        pad(dim, H, a, field[1]);
    }
    sample->material->stress_range(&sample->constants, 0, BEGIN, END, field[0], field[1], J, field[2]);
    sample->material->stress_range(&sample->constants, 0, BEGIN, END, field[0], NULL, NULL, field[3]);
    for (size_t a = 0; a < COUNT; a++) {
        bool inside = a >= BEGIN && a < END;
        for (size_t I = 0; I < dim; I++) {
            for (size_t i = 0; i < lanes_of(dim); i++) {
                bool lane = inside && i < dim;
                expect(sample, "stress of a range, H and J given",
                       fabs(*entry(dim, field[2], a, i, I) - (lane ? other[a][i * dim + I] : 0.0)),
                       lane ? differs[a] : 0.0);
                expect(sample, "stress of a range, H and J of F",
                       fabs(*entry(dim, field[3], a, i, I) - (lane ? own[a][i * dim + I] : 0.0)),
                       lane ? differs[a] : 0.0);
            }
        }
    }
    for (int i = 0; i < 4; i++) {
        free(field[i]);
    }
}

/* U'(J) against the mean stress of a spherical deformation, where nothing else acts: P = U'(J) H, H = J^(2/3) 1. */
static void volumetric_range(const struct sample *sample)
{
    enum { COUNT = 9, BEGIN = 2, END = 7 };
    double J[COUNT];
    double pressure[COUNT] = {0};
    for (size_t a = 0; a < COUNT; a++) {
        J[a] = uniform(0.3, 3.0);
    }
    sample->material->volumetric_range(&sample->constants, 0, BEGIN, END, J, pressure);
    for (size_t a = 0; a < COUNT; a++) {
        double stretch = cbrt(J[a]);
        double area = sample->material->linear ? 1.0 : stretch * stretch;
        double F[9];
        double H[9];
        double P[9];
        unit_tensor(3, F);
        unit_tensor(3, H);
        for (size_t i = 0; i < 3; i++) {
            F[4 * i] = stretch;
            H[4 * i] = area;
        }
        sample->in_3d->stress(&sample->constants, F, H, J[a], P);
        bool inside = a >= BEGIN && a < END;
        expect(sample, "volumetric stress", fabs(pressure[a] - (inside ? P[4] / area : 0.0)),
               inside ? 1e-14 * sample->modulus : 0.0);
    }
}

/* U''(J) / kappa against a difference of U'(J), where it is not 1. */
static void stiffness_range(const struct sample *sample)
{
    enum { COUNT = 9, BEGIN = 2, END = 7, SIDES = 2 };
    double J[COUNT];
    double stiffness[COUNT] = {0};
    double pressure[SIDES][COUNT];
    const double step = 1e-5;
    for (size_t a = 0; a < COUNT; a++) {
        J[a] = uniform(0.3, 4.0);
    }
    J[COUNT / 2] = 3.5; /* where Hencky's U' falls */
    for (size_t a = 0; a < COUNT; a++) {
        stiffness[a] = 1.0;
    }
    if (sample->material->stiffness_range != NULL) {
        sample->material->stiffness_range(BEGIN, END, J, stiffness);
    }
    for (int side = 0; side < SIDES; side++) {
        double moved[COUNT];
        for (size_t a = 0; a < COUNT; a++) {
            moved[a] = J[a] * (1.0 + (side == 0 ? -step : step));
        }
        sample->material->volumetric_range(&sample->constants, 0, 0, COUNT, moved, pressure[side]);
    }
    for (size_t a = 0; a < COUNT; a++) {
        bool inside = a >= BEGIN && a < END;
        double slope = (pressure[1][a] - pressure[0][a]) / (2.0 * step * J[a] * sample->constants.kappa);
        expect(sample, "volumetric stiffness", fabs(stiffness[a] - (inside ? fmax(0.0, slope) : 1.0)),
               inside ? 1e-8 * fmax(1.0, slope) : 0.0);
    }
}

static void test_speeds(void)
{
    each(wave_speeds);
}

static void test_fastest(void)
{
    each(fastest_bounds_speeds);
}

static void test_range(void)
{
    each(stress_range);
}

static void test_volumetric(void)
{
    each(volumetric_range);
}

static void test_stiffness(void)
{
    each(stiffness_range);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"wave speeds are those of the acoustic tensor", test_speeds},
        {"the fastest speed is bounded, exactly at rest", test_fastest},
        {"the hot loop is the pointwise stress", test_range},
        {"the volumetric stress is that of a spherical deformation", test_volumetric},
        {"volumetric stiffness is the slope of the stress", test_stiffness},
    };
    return unit_main("material loops", tests, sizeof tests / sizeof *tests);
}
