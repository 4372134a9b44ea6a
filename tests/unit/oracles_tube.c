/* The tube against values from elsewhere and other methods, where it turns, in small oscillations, at the ends of its
 * parameters. */
#include "tests/unit/one_oracle.h"

#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_odeiv2.h>

static const double PI = 3.14159265358979323846;
static const double MU = 1e6, RHO = 1000; /* the typical values, as are A = 1 m, B = 2 m, 20 m/s */
enum { POINTS = 64 };

static const struct oracle_kind *the_kind(void)
{
    return kind_called("tube-oscillation");
}

static double period_with(const struct setting set[SETTINGS])
{
    struct oracle *o = create_with(the_kind(), set);
    double period = figure_of(the_kind(), o, "period");
    the_kind()->destroy(o);
    return period;
}

struct expected {
    struct setting set[SETTINGS];
    double X[3], t;
    double u[2], v[2], F[4], P[4], axial, kinetic, strain, rho;
};

/* The equation of motion by Taylor series, the stress by quadrature through the wall from the inner face, to 18 digits.
 */
static const struct expected expected[] = {
    {.X = {1.2, 0.9},
     .t = 0.02,
     .u = {0.190560731624364672, 0.142920548718273504},
     .v = {7.30356396182315304, 5.47767297136736478},
     .F = {0.969463406985428386, -0.14200290202615663, -0.14200290202615663, 1.05229843316735309},
     .P = {230991.43351591267, -241656.346327139322, -241656.346327139322, 371957.635540077275},
     .axial = 298229.522924631914,
     .kinetic = 391953.885270084006,
     .strain = 479080.550851356846,
     .rho = 1000},
    {.X = {1.2, 0.9},
     .t = 0.11,
     .u = {-0.181474079421180341, -0.136105559565885256},
     .v = {2.61695971813155916, 1.96271978859866937},
     .F = {1.05958865990761322, 0.158112794568947628, 0.158112794568947628, 0.967356196409060436},
     .P = {-487764.038437520922, 411025.072618484797, 411025.072618484797, -727528.664131637053},
     .axial = -599568.704980738934,
     .kinetic = 60129.4123698580622,
     .strain = 810905.02375158279,
     .rho = 1000},
    {.X = {1.2, 0.9},
     .t = 0.3, /* more than two periods */
     .u = {0.259852254770291026, 0.19488919107771827},
     .v = {2.16304049584008037, 1.62228037188006028},
     .F = {0.96403631061200683, -0.189380426272426769, -0.189380426272426769, 1.07450822593758911},
     .P = {298644.915168069264, -306654.638852067803, -306654.638852067803, 477526.787831775482},
     .axial = 380747.974392347151,
     .kinetic = 34145.8343604762639,
     .strain = 836888.601760964588,
     .rho = 1000},
    {.set = {{"A", 0.5}, {"B", 0.6}, {"stretch", 1.6}, {"velocity", -10}, {"mu", 2e5}, {"material.rho", 1100}},
     .X = {0.44, -0.33},
     .t = 0.05,
     .u = {-0.144587024357987867, 0.1084402682684909},
     .v = {7.65464552851952316, -5.74098414638964237},
     .F = {1.19494333688447293, -0.392662657819015831, -0.392662657819015831, 0.965890119823380357},
     .P = {-206683.941901908546, -259711.516300235072, -259711.516300235072, -358182.326410379005},
     .axial = -261411.293202064671,
     .kinetic = 18076.2394083830662,
     .strain = 24707.1704270062205,
     .rho = 1100},
};

static void agrees_with_multiple_precision(void)
{
    const double bound = 1e-13;
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        const struct expected *e = &expected[i];
        struct oracle *o = create_with(the_kind(), e->set);
        struct oracle_state s;
        double energy[2];
        the_kind()->state(o, e->X, e->t, &s);
        the_kind()->energy(o, e->t, &energy[0], &energy[1]);
        for (int k = 0; k < 2; k++) {
            CU_ASSERT_TRUE(near(s.u[k], e->u[k], bound * fabs(e->u[0])));
            CU_ASSERT_TRUE(near(s.v[k], e->v[k], bound * 20));
            CU_ASSERT_TRUE(near(s.p[k], e->rho * e->v[k], bound * 20 * e->rho));
            for (int j = 0; j < 2; j++) {
                CU_ASSERT_TRUE(near(s.F[3 * k + j], e->F[2 * k + j], bound));
                CU_ASSERT_TRUE(near(s.P[3 * k + j], e->P[2 * k + j], bound * MU));
            }
        }
        CU_ASSERT_TRUE(near(s.P[8], e->axial, bound * MU));
        CU_ASSERT_TRUE(near(energy[0], e->kinetic, bound * (e->kinetic + e->strain)));
        CU_ASSERT_TRUE(near(energy[1], e->strain, bound * (e->kinetic + e->strain)));
        the_kind()->destroy(o);
    }
}

/* The wall as it is: inertia and stress summed over it, from the momentum equation as it stands. */
struct wall {
    double A, B, mu, rho;
    gsl_integration_glfixed_table *rule;
};

static int moves(double t, const double y[2], double slope[2], void *context)
{
    const struct wall *of = context;
    double a = y[0], rate = y[1], q = (a - of->A) * (a + of->A), mass = 0, force = 0;
    (void)t;
    for (size_t n = 0; n < POINTS; n++) {
        double R, weight;
        (void)gsl_integration_glfixed_point(of->A, of->B, n, &R, &weight, of->rule);
        double r = sqrt(R * R + q), stretch = r / R, step = weight * R / r; /* dr */
        double hoop = of->mu * (stretch * stretch - 1 / (stretch * stretch));
        /* d2r/dt2 = (a a'' + a'^2) / r - (a a')^2 / r^3 */
        mass += step * of->rho * a / r;
        force -= step * (of->rho * rate * rate * (1 - a * a / (r * r)) + hoop) / r;
    }
    slope[0] = rate;
    slope[1] = force / mass;
    return GSL_SUCCESS;
}

static void agrees_with_the_momentum_of_the_wall(void)
{
    struct oracle *o = create_with(the_kind(), NULL);
    struct wall of = {1, 2, MU, RHO, gsl_integration_glfixed_table_alloc(POINTS)};
    gsl_odeiv2_system system = {moves, NULL, 2, &of};
    gsl_odeiv2_driver *driver = gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-4, 1e-14, 1e-13);
    double t = 0, y[2] = {1, 20};
    for (int i = 1; i <= 20; i++) {
        CU_ASSERT_EQUAL_FATAL(gsl_odeiv2_driver_apply(driver, &t, 0.02 * i, y), GSL_SUCCESS);
        struct oracle_state s = state_of(the_kind(), o, 1, t);
        CU_ASSERT_TRUE(near(1 + s.u[0], y[0], 1e-11));
        CU_ASSERT_TRUE(near(s.v[0], y[1], 1e-9));
    }
    gsl_odeiv2_driver_free(driver);
    gsl_integration_glfixed_table_free(of.rule);
    the_kind()->destroy(o);
}

/* Knowles's first integral, in units of A and sqrt(mu / rho): x^2 x'^2 L = energy less strain energy. */
static double strain_energy(double wall, double x)
{
    return (x - 1) * (x + 1) * (log1p(wall) - log1p(wall / (x * x))) / 2;
}

/* Twice the time from turn to turn. The square root in the denominator vanishes at both, as does the cosine. */
static double quadrature(double wall, double low, double high)
{
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(POINTS);
    double sum = 0, middle = (low + high) / 2, half = (high - low) / 2, energy = strain_energy(wall, high);
    for (size_t n = 0; n < POINTS; n++) {
        double angle, weight;
        (void)gsl_integration_glfixed_point(-PI / 2, PI / 2, n, &angle, &weight, rule);
        double x = middle + half * sin(angle), kinetic = energy - strain_energy(wall, x);
        sum += 2 * weight * half * cos(angle) * x * sqrt(log1p(wall / (x * x)) / 2 / kinetic);
    }
    gsl_integration_glfixed_table_free(rule);
    return sum;
}

static void its_period_is_that_of_the_first_integral(void)
{
    static const struct setting set[][SETTINGS] = {
        {{"velocity", 20}},
        {{"velocity", -3}},
        {{"velocity", 45}},
        {{"velocity", 0}, {"stretch", 1.8}},
        {{"velocity", 10}, {"stretch", 0.5}},
        {{"B", 1.01}, {"velocity", 30}},
        {{"B", 15}, {"velocity", 15}},
    };
    for (size_t i = 0; i < sizeof set / sizeof *set; i++) {
        struct oracle *o = create_with(the_kind(), set[i]);
        double low = figure_of(the_kind(), o, "smallest stretch"), high = figure_of(the_kind(), o, "largest stretch");
        double B = strcmp(set[i][0].name, "B") == 0 ? set[i][0].value : 2, wall = (B - 1) * (B + 1);
        CU_ASSERT_DOUBLE_EQUAL(strain_energy(wall, low) / strain_energy(wall, high), 1, 1e-12);
        double period = quadrature(wall, low, high) / sqrt(MU / RHO);
        CU_ASSERT_DOUBLE_EQUAL(figure_of(the_kind(), o, "period") / period, 1, 1e-11);
        the_kind()->destroy(o);
    }
}

/* Where the inner face stands still it is at one of the two stretches, and never beyond. */
static void it_turns_where_it_says(void)
{
    struct oracle *o = create_with(the_kind(), NULL);
    double period = figure_of(the_kind(), o, "period"), low = INFINITY, high = 0;
    for (int i = 0; i <= 4000; i++) {
        struct oracle_state s = state_of(the_kind(), o, 1, period * i / 4000);
        low = fmin(low, 1 + s.u[0]);
        high = fmax(high, 1 + s.u[0]);
    }
    CU_ASSERT_TRUE(near(low, figure_of(the_kind(), o, "smallest stretch"), 2e-6));
    CU_ASSERT_TRUE(near(high, figure_of(the_kind(), o, "largest stretch"), 2e-6));
    the_kind()->destroy(o);
}

static void repeats_itself(void)
{
    struct oracle *o = create_with(the_kind(), NULL);
    double period = figure_of(the_kind(), o, "period");
    for (int i = 0; i < 10; i++) {
        double t = 0.0137 * i;
        struct oracle_state s = state_of(the_kind(), o, 1.5, t),
                            later = state_of(the_kind(), o, 1.5, t + 1000 * period);
        struct oracle_state earlier = state_of(the_kind(), o, 1.5, t - 7 * period);
        CU_ASSERT_TRUE(near(later.u[0], s.u[0], 1e-11) && near(later.v[0], s.v[0], 1e-9));
        CU_ASSERT_TRUE(near(earlier.u[0], s.u[0], 1e-12) && near(earlier.P[0], s.P[0], 1e-12 * MU));
    }
    the_kind()->destroy(o);
}

/* u = C / R: the squared frequency is 2 mu (1/A^2 - 1/B^2) / (rho ln(B/A)), from which the period departs with the
 * square of the amplitude; and a thin ring has 4 mu / (rho A^2). */
static void small_oscillations_are_linear(void)
{
    double linear = 2 * PI / sqrt(2 * MU / RHO * 0.75 / log(2.0)), departure[2];
    for (int i = 0; i < 2; i++) {
        departure[i] = period_with((const struct setting[SETTINGS]){{"velocity", i == 0 ? 0.4 : 0.2}}) / linear - 1;
    }
    CU_ASSERT_TRUE(fabs(departure[0]) < 1e-5);
    CU_ASSERT_DOUBLE_EQUAL(departure[0] / departure[1], 4, 1e-3);
    CU_ASSERT_DOUBLE_EQUAL(period_with((const struct setting[SETTINGS]){{"velocity", 1e-9}}) / linear, 1, 1e-13);
    CU_ASSERT_DOUBLE_EQUAL(period_with((const struct setting[SETTINGS]){{"velocity", 0}}) / linear, 1, 4 * DBL_EPSILON);
    /* which is a figure of its own, whatever the amplitude; it goes with the size */
    struct oracle *o = create_with(the_kind(), (const struct setting[SETTINGS]){{"A", 0.5}, {"B", 1}});
    CU_ASSERT_DOUBLE_EQUAL(figure_of(the_kind(), o, "period of small oscillations") / (linear / 2), 1, 8 * DBL_EPSILON);
    the_kind()->destroy(o);
    double ring = period_with((const struct setting[SETTINGS]){{"velocity", 1e-9}, {"B", 1.01}});
    CU_ASSERT_DOUBLE_EQUAL(ring / (PI * 1.005 / sqrt(MU / RHO)), 1, 1e-4);
}

static void starts_as_told(void)
{
    const struct setting set[SETTINGS] = {{"A", 3}, {"B", 4}, {"stretch", 1.25}, {"velocity", -7}};
    struct oracle *o = create_with(the_kind(), set);
    struct oracle_state s = state_of(the_kind(), o, 3, 0);
    CU_ASSERT_TRUE(near(s.u[0], 0.75, 4 * DBL_EPSILON) && near(s.v[0], -7, 16 * DBL_EPSILON));
    CU_ASSERT_TRUE(near(s.F[0], 0.8, 2 * DBL_EPSILON) && near(s.F[4], 1.25, 2 * DBL_EPSILON));
    the_kind()->destroy(o);
}

/* Each passes its own check. */
static void holds_at_the_ends_of_its_parameters(void)
{
    static const struct setting set[][SETTINGS] = {
        {{"velocity", 0}},
        {{"velocity", 1e-20}},
        {{"velocity", -1e-3}},
        {{"velocity", 50}}, /* down to 0.15 of the inner radius */
        {{"velocity", 0}, {"stretch", 0.2}},
        {{"velocity", 0}, {"stretch", 1.0000001}},
        {{"velocity", 0}, {"stretch", 2}},
        {{"B", 1.01}},
        {{"B", 20}, {"velocity", 12}},
        {{"A", 1e-20}, {"B", 3e-20}},
        {{"A", 1e20}, {"B", 3e20}, {"mu", 1e-20}, {"material.rho", 1e20}, {"velocity", -3e-21}},
        {{"A", 1e-30}, {"B", 1.5e-30}, {"mu", 1e40}, {"material.rho", 1e-10}, {"velocity", 1e24}},
        {{"stretch", 0.1}, {"velocity", 0}}, /* turns at the end of what it admits */
    };
    holds_with_each(the_kind(), set, sizeof set / sizeof *set);
}

/* An annulus; a point outside is taken for the nearest one of it, which only its middle has none of. */
static void knows_what_lies_outside(void)
{
    struct oracle *o = create_with(the_kind(), NULL);
    CU_ASSERT_EQUAL(the_kind()->outside(o, (const double[3]){1.2, -0.9, 99}), 0);
    CU_ASSERT_EQUAL(the_kind()->outside(o, (const double[3]){0, 2, 0}), 0);
    CU_ASSERT_EQUAL(the_kind()->outside(o, (const double[3]){-1, 0, 0}), 0);
    CU_ASSERT_EQUAL(the_kind()->outside(o, (const double[3]){3, 4, 0}), 3);
    CU_ASSERT_EQUAL(the_kind()->outside(o, (const double[3]){0.3, 0.4, 0}), 0.5);
    CU_ASSERT_EQUAL(the_kind()->outside(o, (const double[3]){0, 0, 0}), 1);
    struct oracle_state face = state_of(the_kind(), o, 2, 0.01), beyond = state_of(the_kind(), o, 2.5, 0.01);
    CU_ASSERT_TRUE(face.u[0] == beyond.u[0] && face.P[4] == beyond.P[4] && face.u[0] > 0);
    CU_ASSERT_TRUE(isfinite(state_of(the_kind(), o, 0, 0.01).P[0]));
    unit_untrapped();
    CU_ASSERT_TRUE(isnan(state_of(the_kind(), o, 1.5, INFINITY).u[0]));
    unit_trapped();
    CU_ASSERT_PTR_NULL(the_kind()->awaits);
    the_kind()->destroy(o);
}

static void refuses_what_it_cannot_answer(void)
{
    unit_untrapped();
    static const struct {
        struct setting set[SETTINGS];
        const char *says;
    } wrong[] = {{{{"B", 1}}, "1.01 to 20 times; B = 2 would do"},
                 {{{"B", 21}}, "is 21 times A"},
                 {{{"A", 1e-300}}, "1.01 to 20 times"},
                 {{{"stretch", 0.09}}, ">= 0.1"},
                 {{{"stretch", 5}, {"velocity", 0}}, "stretch = 5 and the velocity take the inner radius beyond 1/10"},
                 {{{"velocity", 60}}, "choose a velocity nearer to 0"},
                 {{{"velocity", -1e150}}, "choose a velocity nearer to 0"},
                 {{{"velocity", 1e-200}}, "range of double precision"},
                 {{{"mu", 1e307}}, "range of double precision"},
                 {{{"mu", 0}}, "> 0"},
                 {{{"material.rho", 5e-324}}, "range of double precision"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        refuses(the_kind(), wrong[i].set, wrong[i].says);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"agrees with multiple precision", agrees_with_multiple_precision},
        {"agrees with the momentum of the wall", agrees_with_the_momentum_of_the_wall},
        {"its period is that of the first integral", its_period_is_that_of_the_first_integral},
        {"it turns where it says", it_turns_where_it_says},
        {"repeats itself", repeats_itself},
        {"small oscillations are linear", small_oscillations_are_linear},
        {"starts as told", starts_as_told},
        {"holds at the ends of its parameters", holds_at_the_ends_of_its_parameters},
        {"knows what lies outside", knows_what_lies_outside},
        {"refuses what it cannot answer", refuses_what_it_cannot_answer},
    };
    return unit_main("oracles: tube oscillation", tests, sizeof tests / sizeof *tests);
}
