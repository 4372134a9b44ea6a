/* The cantilever by thin-plate theory against its printed formulas, the deflection of a beam under its own inertia by
 * quadrature, the resultants of its stress, and the body that it stands for. */
#include "tests/unit/one_oracle.h"

#include <gsl/gsl_integration.h>

static const double L = 0.2, H = 0.02, RHO = 1000, K = 3.25e6, G = 7.15e5, PI = 3.14159265358979323846;

static const struct oracle_kind *the_kind(void)
{
    return kind_called("thin-plate");
}

static struct oracle_state at(const struct oracle *oracle, double X, double Y, double t)
{
    struct oracle_state state;
    const double place[3] = {X, Y, 0};
    the_kind()->state(oracle, place, t, &state);
    return state;
}

/* E / (1 - nu^2) from the moduli of the source: 4 G (3 K + G) / (3 K + 4 G). */
static double modulus(void)
{
    return 4 * G * (3 * K + G) / (3 * K + 4 * G);
}

/* 001_363f711843f01da4.txt, section 4.1, with k L = 1.875104: omega^2 = E H^2 k^4 / (12 rho (1 - nu^2)), v = 0.01 c0
 * f(X)/f(L), and an amplitude of 23 mm. */
static void is_the_curve_of_the_source(void)
{
    struct oracle *o = create_with(the_kind(), NULL);
    double z = 1.8751040687119611, k = z / L, omega = k * k * H * sqrt(modulus() / (12 * RHO)),
           v = 0.01 * sqrt(K / RHO);
    CU_ASSERT_TRUE(near(2 * PI / omega, 0.254129, 5e-7));
    CU_ASSERT_TRUE(near(v / omega, 0.023058, 5e-7));
    for (int i = 0; i <= 40; i++) {
        double x = z * i / 40, t = i / 40.0;
        double f = (cos(z) + cosh(z)) * (cosh(x) - cos(x)) + (sin(z) - sinh(z)) * (sinh(x) - sin(x));
        double end = (cos(z) + cosh(z)) * (cosh(z) - cos(z)) + (sin(z) - sinh(z)) * (sinh(z) - sin(z));
        struct oracle_state s = at(o, x / k, 0, 0), tip = at(o, L, 0, t);
        CU_ASSERT_TRUE(near(s.v[1], v * f / end, 1e-14) && s.v[0] == 0);
        CU_ASSERT_TRUE(near(tip.u[1], v / omega * sin(omega * t), 1e-14) && tip.u[0] == 0);
    }
    the_kind()->destroy(o);
}

/* Integral over the height of P_xx (-Y) and of P_xy, which are polynomials in Y. */
static void resultants(const struct oracle *o, double X, double t, double *moment, double *shear)
{
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(4);
    *moment = *shear = 0;
    for (size_t n = 0; n < 4; n++) {
        double Y, weight;
        (void)gsl_integration_glfixed_point(-H / 2, H / 2, n, &Y, &weight, rule);
        struct oracle_state s = at(o, X, Y, t);
        *moment -= weight * s.P[0] * Y;
        *shear += weight * s.P[1];
    }
    gsl_integration_glfixed_table_free(rule);
}

/* What the inertia of the rest does at X: deflection, moment and shear force of a beam under the load rho H omega^2 w,
 * by quadrature with Green's functions of the clamped beam, which know nothing of modes. */
static void inertia(const struct oracle *o, double X, double t, double omega, double out[3])
{
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(24);
    double EI = modulus() * H * H * H / 12;
    out[0] = out[1] = out[2] = 0;
    for (int half = 0; half < 2; half++) {
        for (size_t n = 0; n < 24; n++) {
            double s, weight;
            (void)gsl_integration_glfixed_point(half == 0 ? 0 : X, half == 0 ? X : L, n, &s, &weight, rule);
            double load = weight * RHO * H * omega * omega * at(o, s, 0, t).u[1];
            out[0] += load * (half == 0 ? s * s * (3 * X - s) : X * X * (3 * s - X)) / (6 * EI);
            out[1] += half == 0 ? 0 : load * (s - X);
            out[2] += half == 0 ? 0 : load;
        }
    }
    gsl_integration_glfixed_table_free(rule);
}

static void bends_under_its_own_inertia(void)
{
    static const double root[] = {1.87510406871196, 4.69409113297417, 7.85475743823761, 10.9955407348755}; /* tables */
    for (int mode = 1; mode <= 4; mode++) {
        struct oracle *o = create_with(the_kind(), (const struct setting[SETTINGS]){{"mode", mode}});
        double EI = modulus() * H * H * H / 12, omega = pow(root[mode - 1] / L, 2) * sqrt(EI / (RHO * H)),
               t = 0.2 / omega;
        double w = at(o, L, 0, t).u[1];
        double stiffness = RHO * H * omega * omega * L; /* times w: the size of forces */
        for (int i = 1; i < 8; i++) {
            double X = L * i / 8, found[2], expected[3];
            resultants(o, X, t, &found[0], &found[1]);
            inertia(o, X, t, omega, expected);
            CU_ASSERT_TRUE(near(at(o, X, 0, t).u[1], expected[0], 1e-12 * fabs(w)));
            CU_ASSERT_TRUE(near(found[0], expected[1], 1e-12 * stiffness * L * fabs(w)));
            CU_ASSERT_TRUE(near(found[1], expected[2], 1e-12 * stiffness * fabs(w)));
            CU_ASSERT_TRUE(near(found[0], -EI * (at(o, X, -H / 2, t).F[0] - 1) / (-H / 2), 1e-12 * EI));
        }
        the_kind()->destroy(o);
    }
}

/* Periods of theory and body as the cantilever has them; how the two drift apart in a second, and the root mean square
 * of it: what is left of an error against thin-plate theory when the body is computed without any. */
static void says_how_far_from_the_body_it_is(void)
{
    struct oracle *o = create_with(the_kind(), NULL), *body = create_with(kind_called("cantilever"), NULL);
    double period = figure_of(the_kind(), o, "period"), own = figure_of(kind_called("cantilever"), body, "period");
    double sum = 0, X[3] = {L, 0, 0};
    CU_ASSERT_TRUE(near(period, 2 * PI * L * L / (pow(1.87510406871196, 2) * H * sqrt(modulus() / (12 * RHO))), 1e-13));
    CU_ASSERT_TRUE(near(figure_of(the_kind(), o, "body period"), own, 1e-14));
    CU_ASSERT_TRUE(near(figure_of(kind_called("cantilever"), body, "thin-plate period"), period, 1e-14));
    CU_ASSERT_TRUE(near(figure_of(the_kind(), o, "error of thin-plate theory"), 0.254129 / 0.2553288 - 1, 5e-6));
    CU_ASSERT_TRUE(near(figure_of(the_kind(), o, "phase ahead of the body"), 0.11618, 5e-5));
    for (int i = 0; i <= 2000; i++) {
        struct oracle_state theirs;
        kind_called("cantilever")->state(body, X, i / 2000.0, &theirs);
        sum += pow(theirs.u[1] - at(o, L, 0, i / 2000.0).u[1], 2);
    }
    CU_ASSERT_TRUE(near(sqrt(sum / 2001), 1.074e-3, 1e-6));
    the_kind()->destroy(o);
    kind_called("cantilever")->destroy(body);
}

static void holds_at_the_ends_of_its_parameters(void)
{
    const struct setting set[][SETTINGS] = {
        {{"L", 0.08}, {"material.nu", 0.49}},
        {{"L", 0.08}, {"material.nu", 0.49}, {"mode", 4}},
        {{"L", 1}, {"material.nu", 0.49}, {"mode", 4}},
        {{"L", 1}, {"mode", 3}},
        {{"v_tip", 0}, {"material.nu", -0.9}, {"mode", 2}},
        {{"L", 2e5}, {"H", 5e4}, {"v_tip", 1e-30}, {"material.E", 1e40}, {"material.rho", 1e-10}},
        {{"L", 2e-7}, {"H", 5e-8}, {"v_tip", -1e10}, {"material.E", 1e-9}, {"material.nu", 0}, {"material.rho", 1e9}},
    };
    holds_with_each(the_kind(), set, sizeof set / sizeof *set);
}

static void refuses_what_it_cannot_answer(void)
{
    unit_untrapped();
    refuses(the_kind(), (const struct setting[SETTINGS]){{"L", 0.07}}, "4 to 50 times; L = 0.2 would do");
    refuses(the_kind(), (const struct setting[SETTINGS]){{"mode", 2.5}}, "a whole number");
    refuses(the_kind(), (const struct setting[SETTINGS]){{"v_tip", 1e200}}, "range of double precision");
    refuses(the_kind(), (const struct setting[SETTINGS]){{"material.rho", 1e-320}}, "range of double precision");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"is the curve of the source", is_the_curve_of_the_source},
        {"bends under its own inertia", bends_under_its_own_inertia},
        {"says how far from the body it is", says_how_far_from_the_body_it_is},
        {"holds at the ends of its parameters", holds_at_the_ends_of_its_parameters},
        {"refuses what it cannot answer", refuses_what_it_cannot_answer},
    };
    return unit_main("oracles: thin plate", tests, sizeof tests / sizeof *tests);
}
