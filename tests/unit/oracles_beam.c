/* Cantilevers of beam theory against tabulated roots, against integration of their equations by Runge and Kutta, and
 * in the limits where the theories meet. */
#include "oracles/beam.h"
#include "tests/unit/unit.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

/* The plate of 001_363f711843f01da4.txt, section 4.1. */
static struct oracle_beam plate(void)
{
    double K = 3.25e6, G = 7.15e5;
    return (struct oracle_beam){.length = 0.2,
                                .height = 0.02,
                                .E = 9 * K * G / (3 * K + G),
                                .nu = (3 * K - 2 * G) / (2 * (3 * K + G)),
                                .rho = 1000};
}

static struct oracle_beam_mode thin_plate(const struct oracle_beam *beam, int mode)
{
    struct oracle_beam_mode result = {0};
    char why[ORACLE_WHY] = "";
    CU_ASSERT_TRUE_FATAL(oracle_beam_thin_plate(beam, mode, &result, why));
    return result;
}

static struct oracle_beam_mode timoshenko(const struct oracle_beam *beam, int mode)
{
    struct oracle_beam_mode result = {0};
    char why[ORACLE_WHY] = "";
    CU_ASSERT_TRUE_FATAL(oracle_beam_timoshenko(beam, mode, &result, why));
    return result;
}

/* Roots of 1 + cos z cosh z = 0 to 15 digits, as tables have them; from the sixth on they are odd multiples of pi/2 to
 * more digits than that. */
static void thin_plate_has_the_tabulated_roots(void)
{
    static const double root[] = {1.87510406871196, 4.69409113297417, 7.85475743823761, 10.9955407348755,
                                  14.1371683910465};
    struct oracle_beam beam = plate();
    for (int mode = 1; mode <= 5; mode++) {
        CU_ASSERT_DOUBLE_EQUAL(thin_plate(&beam, mode).wave, root[mode - 1], 1e-13 * root[mode - 1]);
    }
    for (int mode = 12; mode <= 1000000; mode = mode * 7 + 1) {
        struct oracle_beam_mode m = thin_plate(&beam, mode);
        double expected = (2 * mode - 1) * (PI / 2);
        CU_ASSERT_DOUBLE_EQUAL(m.wave, expected, 1e-15 * expected);
        CU_ASSERT_DOUBLE_EQUAL(oracle_beam_deflection(&m, 0.2), 1, 1e-12);
    }
    CU_ASSERT_DOUBLE_EQUAL(thin_plate(&beam, 1).period, 0.254129, 5e-7);
}

/* The source's f(x), evaluated as it is written: it cancels for higher modes, but not for the first two. */
static void thin_plate_has_the_shape_of_the_source(void)
{
    struct oracle_beam beam = plate();
    for (int mode = 1; mode <= 2; mode++) {
        struct oracle_beam_mode m = thin_plate(&beam, mode);
        double z = m.wave, tip = 0;
        for (int i = 20; i >= 1; i--) {
            double kx = z * i / 20;
            double f = (cos(z) + cosh(z)) * (cosh(kx) - cos(kx)) + (sin(z) - sinh(z)) * (sinh(kx) - sin(kx));
            tip = i == 20 ? f : tip;
            CU_ASSERT_DOUBLE_EQUAL(oracle_beam_deflection(&m, 0.2 * i / 20), f / tip, 1e-12);
        }
    }
}

/* w, psi, moment and shear force along the beam, in SI units. */
struct section {
    double EI, kGA, rhoA, rhoI, square; /* square: omega^2 */
};

static int derivative(double x, const double y[], double dydx[], void *context)
{
    const struct section *s = context;
    (void)x;
    dydx[0] = y[1] + y[3] / s->kGA;
    dydx[1] = y[2] / s->EI;
    dydx[2] = -y[3] - s->rhoI * s->square * y[1];
    dydx[3] = -s->rhoA * s->square * y[0];
    return GSL_SUCCESS;
}

/* From the clamp to the end with unit moment or unit shear force at the clamp. */
static void shoot(const struct section *section, double length, double moment, double shear, double y[4])
{
    gsl_odeiv2_system system = {derivative, NULL, 4, (void *)section};
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, length / 50, 1e-14, 1e-13);
    double x = 0;
    y[0] = y[1] = 0;
    y[2] = moment;
    y[3] = shear;
    CU_ASSERT_PTR_NOT_NULL_FATAL(driver);
    CU_ASSERT_EQUAL(gsl_odeiv2_driver_apply(driver, &x, length, y), GSL_SUCCESS);
    gsl_odeiv2_driver_free(driver);
}

static struct section section_of(const struct oracle_beam *beam, bool shear)
{
    double modulus = beam->plane_stress ? beam->E : beam->E / (1 - beam->nu * beam->nu), nu = beam->nu;
    double factor = beam->plane_stress ? 5 * (1 + nu) / (6 + 5 * nu) : 5 / (6 - nu);
    double I = pow(beam->height, 3) / 12;
    return (struct section){.EI = modulus * I,
                            .kGA = shear ? factor * beam->E / (2 * (1 + nu)) * beam->height : INFINITY,
                            .rhoA = beam->rho * beam->height,
                            .rhoI = shear ? beam->rho * I : 0};
}

/* Moment and shear force at the free end as a determinant, whose sign must change within 1e-10 of the frequency. */
static double end_determinant(const struct section *section, double length)
{
    double bent[4], sheared[4];
    shoot(section, length, section->EI / length, 0, bent);
    shoot(section, length, 0, section->EI / (length * length), sheared);
    return bent[2] * sheared[3] - bent[3] * sheared[2];
}

static void check_by_shooting(const struct oracle_beam *beam, const struct oracle_beam_mode *mode, bool shear)
{
    struct section section = section_of(beam, shear);
    double y[2][4], determinant[2];
    for (int side = 0; side < 2; side++) {
        section.square = pow(mode->frequency * (side == 0 ? 1 - 1e-10 : 1 + 1e-10), 2);
        determinant[side] = end_determinant(&section, beam->length);
    }
    CU_ASSERT_TRUE(determinant[0] * determinant[1] < 0);
    section.square = mode->frequency * mode->frequency;
    shoot(&section, beam->length, section.EI / beam->length, 0, y[0]);
    shoot(&section, beam->length, 0, section.EI / (beam->length * beam->length), y[1]);
    double b = -y[0][2] / y[1][2], scale = y[0][0] + b * y[1][0];
    for (int i = 1; i <= 4; i++) {
        double x = beam->length * i / 4;
        shoot(&section, x, section.EI / beam->length, b * section.EI / (beam->length * beam->length), y[0]);
        CU_ASSERT_DOUBLE_EQUAL(oracle_beam_deflection(mode, x), y[0][0] / scale, 1e-8);
        CU_ASSERT_DOUBLE_EQUAL(oracle_beam_rotation(mode, x) * beam->length, y[0][1] / scale * beam->length, 1e-7);
    }
    CU_ASSERT_DOUBLE_EQUAL(oracle_beam_deflection(mode, 0), 0, 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(oracle_beam_rotation(mode, 0) * beam->length, 0, 1e-13);
}

static void both_agree_with_integration_of_their_equations(void)
{
    for (int stress = 0; stress < 2; stress++) {
        struct oracle_beam beam = plate();
        beam.plane_stress = stress == 1;
        for (int mode = 1; mode <= 4; mode++) {
            struct oracle_beam_mode thin = thin_plate(&beam, mode), thick = timoshenko(&beam, mode);
            check_by_shooting(&beam, &thin, false);
            check_by_shooting(&beam, &thick, true);
            CU_ASSERT_TRUE(thick.frequency < thin.frequency);
        }
    }
}

/* No mode is passed over: as many sign changes of the determinant as modes, up to above the fifth. */
static void no_mode_is_passed_over(void)
{
    struct oracle_beam beam = plate();
    struct section section = section_of(&beam, true);
    double top = 1.05 * timoshenko(&beam, 5).frequency, last = 0;
    int found = 0;
    for (int i = 1; i <= 300; i++) {
        section.square = pow(top * i / 300, 2);
        double now = end_determinant(&section, beam.length);
        found += now * last < 0;
        last = now;
    }
    CU_ASSERT_EQUAL(found, 5);
}

static void timoshenko_tends_to_the_thin_plate(void)
{
    double before = 0;
    for (int i = 0; i < 4; i++) {
        struct oracle_beam beam = plate();
        beam.height /= pow(2, i);
        double distance = timoshenko(&beam, 1).period / thin_plate(&beam, 1).period - 1;
        CU_ASSERT_TRUE(distance > 0);
        CU_ASSERT_TRUE(i == 0 || fabs(before / distance - 4) < 0.05);
        before = distance;
    }
}

static void refused(struct oracle_beam beam, int mode, const char *says)
{
    struct oracle_beam_mode result;
    char why[ORACLE_WHY] = "";
    CU_ASSERT_FALSE(oracle_beam_timoshenko(&beam, mode, &result, why));
    CU_ASSERT_PTR_NOT_NULL(strstr(why, says));
}

static void refuses_what_is_no_beam(void)
{
    struct oracle_beam_mode result;
    char why[ORACLE_WHY] = "";
    struct oracle_beam beam = plate();
    refused(beam, 0, "mode 0");
    refused(beam, 100, "cut-off frequency");
    CU_ASSERT_FALSE(oracle_beam_thin_plate(&beam, -1, &result, why));
    unit_untrapped();
    double *const value[] = {&beam.length, &beam.height, &beam.E, &beam.rho};
    for (size_t i = 0; i < sizeof value / sizeof *value; i++) {
        static const double wrong[] = {0, -1, NAN, INFINITY};
        for (size_t j = 0; j < sizeof wrong / sizeof *wrong; j++) {
            double right = *value[i];
            *value[i] = wrong[j];
            refused(beam, 1, "must be > 0");
            *value[i] = right;
        }
    }
    beam.nu = 0.5;
    refused(beam, 1, "nu < 0.5");
    beam.nu = NAN;
    refused(beam, 1, "nu < 0.5");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"thin plate has the tabulated roots", thin_plate_has_the_tabulated_roots},
        {"thin plate has the shape of the source", thin_plate_has_the_shape_of_the_source},
        {"both agree with integration of their equations", both_agree_with_integration_of_their_equations},
        {"no mode is passed over", no_mode_is_passed_over},
        {"Timoshenko tends to the thin plate", timoshenko_tends_to_the_thin_plate},
        {"refuses what is no beam", refuses_what_is_no_beam},
    };
    return unit_main("oracles: beam", tests, sizeof tests / sizeof *tests);
}
