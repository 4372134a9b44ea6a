/* The breathing ball and cylinder against values from elsewhere and against other methods, at the ends of their
 * parameters, in high modes, at the centre. */
#include "tests/unit/one_oracle.h"

#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_odeiv2.h>

static const double PI = 3.14159265358979323846;
static const double E = 17e6, NU = 0.25, RHO = 1100; /* the typical values */

enum { SPHERE, CYLINDER, KINDS };
static const struct oracle_kind *kind_of(int which)
{
    return kind_called(which == SPHERE ? "breathing-sphere" : "breathing-cylinder");
}

static double root_with(int which, double nu, int mode)
{
    const struct setting set[SETTINGS] = {{"material.nu", nu}, {"mode", mode}};
    struct oracle *o = create_with(kind_of(which), set);
    double root = figure_of(kind_of(which), o, "root");
    kind_of(which)->destroy(o);
    return root;
}

/* Of tan(x) / x = 1 / (1 - (x cp / (2 cs))^2) and of x J0(x) = (1 - 2 nu) / (1 - nu) J1(x), by multiple precision. */
static void roots_agree_with_multiple_precision(void)
{
    static const struct {
        double nu;
        int mode;
        double root[KINDS];
    } known[] = {
        {0.25, 1, {2.5634341631055000401, 2.0693984992577019001}},
        {0.25, 2, {6.0586700836699872981, 5.3957431376223499748}},
        {0.25, 5, {15.622356402059148529, 14.886095793344933915}},
        {0.25, 1000, {3141.5922291765224706, 3140.807082965407286}},
        {0.3, 1, {2.670214733237052381, 2.1257489278107465885}},
        {0.3, 2, {6.0919890671742853299, 5.4138948636764702206}},
        {0, 1, {2.0815759778181006105, 1.8411837813406593026}},
        {0, 1000, {3141.5920169698488626, 3140.8069768355614537}},
        {-0.5, 1, {1.2605588254848631738, 1.5450222787535726851}},
        {-0.5, 5, {15.536114584504851691, 14.841047047787159287}},
        {0.4999, 1, {3.1413380153285832776, 2.4046592414729511923}},
        {0.4999, 2, {6.2830580035269518152, 5.5200056606070275107}},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        for (int which = 0; which < KINDS; which++) {
            double root = known[i].root[which];
            CU_ASSERT_TRUE(near(root_with(which, known[i].nu, known[i].mode), root, 2 * DBL_EPSILON * root));
        }
    }
}

struct expected {
    int which, mode;
    double u[3], v[3], G[9], P[9], kinetic, strain, frequency;
};

/* At X = (0.3, -0.4, 0.5) and t = 0.002 s, to 18 digits; X_3 means nothing to the cylinder. */
static const struct expected expected[] = {
    {.which = SPHERE,
     .mode = 1,
     .u = {0.000169534811688808183, -0.000226046415585077577, 0.000282558019481346971},
     .v = {-0.0496661950916719577, 0.0662215934555626103, -0.0827769918194532629},
     .G = {0.000490909659917260855, 0.0000989418387272441173, -0.000123677298409055147, 0.0000989418387272441173,
           0.000433193587326368453, 0.000164903064545406862, -0.000123677298409055147, 0.000164903064545406862,
           0.000358987208280935365},
     .P = {15401.3864724417874, 1345.60900669052, -1682.01125836314999, 1345.60900669052, 14616.4478852056507,
           2242.68167781753333, -1682.01125836314999, 2242.68167781753333, 13607.2411301877607},
     .kinetic = 28.793703070198342,
     .strain = 40.8860670001531374,
     .frequency = 349.09281398681779356},
    {.which = SPHERE,
     .mode = 3,
     .u = {0.000224311610123036081, -0.000299082146830714774, 0.000373852683538393468},
     .v = {0.199858942346836764, -0.266478589795782353, 0.333098237244727941},
     .G = {0.0000797478792712582082, 0.00089060998374070497, -0.00111326247967588121, 0.00089060998374070497,
           -0.000439774611244153024, 0.00148434997290117495, -0.00111326247967588121, 0.00148434997290117495,
           -0.00110773209904968175},
     .P = {-8896.18889286440902, 12112.2957788735876, -15140.3697235919845, 12112.2957788735876, -15961.6947638740018,
           20187.1596314559793, -15140.3697235919845, 20187.1596314559793, -25045.9165980291925},
     .kinetic = 446.301264020510239,
     .strain = 897.852276240781187,
     .frequency = 1263.7472327061787574},
    {.which = CYLINDER,
     .mode = 1,
     .u = {0.000200259269650636611, -0.000267012359534182148},
     .v = {-0.0356683772263785529, 0.0475578363018380705},
     .G = {0.000600135526048320404, 0.0000898604970495132871, 0, 0.0000898604970495132871, 0.000547716902769437653},
     .P = {15967.2396702179123, 1222.1027598733807, 0, 1222.1027598733807, 15254.3463936251069, 0, 0, 0,
           7805.39651596075478},
     .kinetic = 7.75962732603087442,
     .strain = 19.4260793962492737,
     .frequency = 281.81419900045134101},
    {.which = CYLINDER,
     .mode = 3,
     .u = {0.000127797556650373684, -0.000170396742200498246},
     .v = {0.155486858157644347, -0.207315810876859129},
     .G = {0.0015404368957805823, -0.00148592672037244892, 0, -0.00148592672037244892, 0.00240722748266451084},
     .P = {47794.0595560425527, -20208.6033970653053, 0, -20208.6033970653053, 59582.4115376639808, 0, 0, 0,
           26844.1177734266334},
     .kinetic = 302.929792086053342,
     .strain = 279.116765595529638,
     .frequency = 1167.8662445081270271},
};

static void close_to(const double *value, const double *right, int count, double tolerance)
{
    double scale = 0;
    for (int i = 0; i < count; i++) {
        scale = fmax(scale, fabs(right[i]));
    }
    for (int i = 0; i < count; i++) {
        CU_ASSERT_TRUE(near(value[i], right[i], tolerance * scale));
    }
}

static void fields_agree_with_multiple_precision(void)
{
    static const double X[3] = {0.3, -0.4, 0.5};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        const struct expected *e = &expected[i];
        const struct oracle_kind *kind = kind_of(e->which);
        const struct setting set[SETTINGS] = {{"mode", e->mode}};
        struct oracle *o = create_with(kind, set);
        struct oracle_state s;
        double energy[2], F[9], p[3], bound = 16 * DBL_EPSILON;
        kind->state(o, X, 0.002, &s);
        kind->energy(o, 0.002, &energy[0], &energy[1]);
        for (int k = 0; k < 9; k++) {
            F[k] = e->G[k] + (k % 4 == 0 ? 1 : 0);
        }
        for (int k = 0; k < 3; k++) {
            p[k] = RHO * e->v[k];
        }
        close_to(s.u, e->u, 3, bound);
        close_to(s.v, e->v, 3, bound);
        close_to(s.p, p, 3, bound);
        close_to(s.F, F, 9, DBL_EPSILON);
        close_to(s.P, e->P, 9, bound);
        close_to(&energy[0], &e->kinetic, 1, bound);
        close_to(&energy[1], &e->strain, 1, bound);
        double frequency = figure_of(kind, o, "frequency");
        close_to(&frequency, &e->frequency, 1, 4 * DBL_EPSILON);
        CU_ASSERT_DOUBLE_EQUAL(figure_of(kind, o, "period") * frequency / (2 * PI), 1, 4 * DBL_EPSILON);
        kind->destroy(o);
    }
}

/* The body as layers around its centre: u and the radial stress, which obey Hooke and Newton in polar coordinates. */
struct layers {
    int dim;
    double lambda, mu, inertia; /* inertia: rho omega^2 */
};

static int along_radius(double r, const double y[2], double slope[2], void *context)
{
    const struct layers *of = context;
    double around = y[0] / r, spread = of->dim - 1;
    slope[0] = (y[1] - spread * of->lambda * around) / (of->lambda + 2 * of->mu);
    double hoop = of->lambda * (slope[0] + spread * around) + 2 * of->mu * around;
    slope[1] = -of->inertia * y[0] - spread * (y[1] - hoop) / r;
    return GSL_SUCCESS;
}

/* Shot from near the centre with the oracle's frequency, a solution arrives at the surface without stress, and is what
 * the oracle says it is on the way. */
static void agrees_with_shooting(void)
{
    for (int i = 0; i < 3 * KINDS; i++) {
        const struct oracle_kind *kind = kind_of(i % KINDS);
        int mode = 1 + i / KINDS;
        const struct setting set[SETTINGS] = {{"mode", mode}};
        struct oracle *o = create_with(kind, set);
        double w = figure_of(kind, o, "frequency"), r = 1e-3;
        struct layers of = {kind->dim, E * NU / ((1 + NU) * (1 - 2 * NU)), E / (2 * (1 + NU)), RHO * w * w};
        gsl_odeiv2_system system = {along_radius, NULL, 2, &of};
        gsl_odeiv2_driver *driver = gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-4, 0, 1e-13);
        struct oracle_state s = state_of(kind, o, r, 0), centre = state_of(kind, o, 0, 0);
        double y[2] = {s.u[0], s.P[0]};
        for (int step = 1; step <= 8; step++) {
            CU_ASSERT_EQUAL_FATAL(gsl_odeiv2_driver_apply(driver, &r, step / 8.0, y), GSL_SUCCESS);
            s = state_of(kind, o, r, 0);
            CU_ASSERT_DOUBLE_EQUAL(y[0] / s.u[0], 1, 1e-10);
            CU_ASSERT_DOUBLE_EQUAL(y[1] / centre.P[0], s.P[0] / centre.P[0], 1e-11);
        }
        CU_ASSERT_DOUBLE_EQUAL(s.u[0], 5e-4, 1e-18);
        CU_ASSERT_DOUBLE_EQUAL(s.P[0] / centre.P[0], 0, 1e-14);
        gsl_odeiv2_driver_free(driver);
        kind->destroy(o);
    }
}

/* Integral of p of one mode times v of another along the radius. */
static double overlap(const struct oracle_kind *kind, const struct oracle *a, const struct oracle *b)
{
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(64);
    double sum = 0;
    for (size_t n = 0; n < 64; n++) {
        double r, weight;
        (void)gsl_integration_glfixed_point(0, 1, n, &r, &weight, rule);
        struct oracle_state s = state_of(kind, a, r, 1e-3), t = state_of(kind, b, r, 1e-3);
        sum += weight * s.p[0] * t.v[0] * pow(r, kind->dim - 1);
    }
    gsl_integration_glfixed_table_free(rule);
    return sum;
}

/* Mode n has n - 1 spheres or circles at rest, and is orthogonal to the others. */
static void modes_are_what_their_numbers_say(void)
{
    enum { MODES = 6 };
    for (int which = 0; which < KINDS; which++) {
        const struct oracle_kind *kind = kind_of(which);
        struct oracle *mode[MODES];
        for (int n = 0; n < MODES; n++) {
            int at_rest = 0;
            mode[n] = create_with(kind, (const struct setting[SETTINGS]){{"mode", n + 1}});
            for (int i = 1; i < 200; i++) {
                at_rest +=
                    state_of(kind, mode[n], i / 200.0, 0).u[0] * state_of(kind, mode[n], (i + 1) / 200.0, 0).u[0] < 0;
            }
            CU_ASSERT_EQUAL(at_rest, n);
            for (int m = 0; m < n; m++) {
                double whole = sqrt(overlap(kind, mode[n], mode[n]) * overlap(kind, mode[m], mode[m]));
                CU_ASSERT_DOUBLE_EQUAL(overlap(kind, mode[n], mode[m]) / whole, 0, 1e-13);
            }
        }
        for (int n = 0; n < MODES; n++) {
            kind->destroy(mode[n]);
        }
    }
}

/* A ball without bulk modulus swells as a whole: 3 K V strain^2 / 2 against rho 4 pi R^5 / 10 rate^2. */
static void without_bulk_modulus_the_ball_swells_as_a_whole(void)
{
    static const double nu[] = {-1 + 1e-12, -0.99999999999999989};
    for (size_t i = 0; i < sizeof nu / sizeof *nu; i++) {
        const struct setting set[SETTINGS] = {{"material.nu", nu[i]}};
        struct oracle *o = create_with(kind_of(SPHERE), set);
        double bulk = E / (3 * (1 - 2 * nu[i])), w = sqrt(15 * bulk / RHO);
        CU_ASSERT_DOUBLE_EQUAL(figure_of(kind_of(SPHERE), o, "frequency") / w, 1, 1e-12);
        struct oracle_state s = state_of(kind_of(SPHERE), o, 0.5, 0);
        CU_ASSERT_DOUBLE_EQUAL(s.u[0], 2.5e-4, 1e-15);
        CU_ASSERT_DOUBLE_EQUAL(s.P[0] / (3 * bulk * 5e-4), 0.75, 1e-11); /* 1 - r^2 */
        kind_of(SPHERE)->destroy(o);
    }
}

/* Where only volume resists, the pressure vanishes on the surface: zeros of sin(x) / x and J0. */
static void without_shear_the_surface_is_a_node_of_pressure(void)
{
    for (int mode = 1; mode < 4; mode++) {
        static const double J0[] = {2.4048255576957728, 5.5200781102863106, 8.6537279129110122};
        CU_ASSERT_DOUBLE_EQUAL(root_with(SPHERE, 0.49999999999999994, mode), mode * PI, 4 * mode * DBL_EPSILON);
        CU_ASSERT_DOUBLE_EQUAL(root_with(CYLINDER, 0.49999999999999994, mode), J0[mode - 1], 4 * mode * DBL_EPSILON);
    }
}

/* Each passes its own check, whose bounds grow with nothing but the phase of the wave. */
static void holds_at_the_ends_of_its_parameters(void)
{
    const struct setting set[][SETTINGS] = {
        {{"material.nu", 0.4999}},
        {{"material.nu", 0.49999999999999994}}, /* the last number below 1/2 */
        {{"material.nu", 0.49999999999999994}, {"mode", 7}},
        {{"material.nu", 0}},
        {{"material.nu", -0.9}},
        {{"material.nu", -0.999999}},
        {{"material.nu", -0.99999999999999989}}, /* the first above -1 */
        {{"material.nu", -0.99999999999999989}, {"mode", 2}},
        {{"mode", 2}},
        {{"mode", 30}},
        {{"mode", 1000}},
        {{"U0", 0}},
        {{"U0", -3}},
        {{"R", 1e-30}, {"U0", 1e-50}, {"material.E", 1e-40}, {"material.rho", 1e-60}, {"material.nu", 0.3}},
        {{"R", 1e30}, {"U0", 1e40}, {"material.E", 1e40}, {"material.rho", 1e60}, {"material.nu", -0.3}},
    };
    for (int which = 0; which < KINDS; which++) {
        holds_with_each(kind_of(which), set, sizeof set / sizeof *set);
    }
}

/* Where the series takes over from the Bessel functions, and at the centre, fields go on as they are. */
static void is_smooth_at_the_centre(void)
{
    for (int which = 0; which < KINDS; which++) {
        const struct oracle_kind *kind = kind_of(which);
        struct oracle *o = create_with(kind, NULL);
        double there = 2 / figure_of(kind, o, "root");
        struct oracle_state s[2] = {state_of(kind, o, there * (1 - 2 * DBL_EPSILON), 0),
                                    state_of(kind, o, there * (1 + 2 * DBL_EPSILON), 0)};
        CU_ASSERT_DOUBLE_EQUAL(s[1].u[0] / s[0].u[0], 1, 16 * DBL_EPSILON);
        struct oracle_state centre = state_of(kind, o, 0, 0);
        CU_ASSERT_DOUBLE_EQUAL((s[1].P[0] - s[0].P[0]) / centre.P[0], 0, 16 * DBL_EPSILON);
        CU_ASSERT_TRUE(centre.u[0] == 0 && centre.v[0] == 0 && centre.P[1] == 0 && centre.F[0] == centre.F[4]);
        CU_ASSERT_TRUE(centre.P[0] == centre.P[4] && (which == CYLINDER || centre.P[0] == centre.P[8]));
        for (double r = 1e-2; r > 1e-300; r *= 1e-3) {
            s[0] = state_of(kind, o, r, 0);
            CU_ASSERT_DOUBLE_EQUAL(s[0].u[0] / r / (centre.F[0] - 1), 1, 10 * r * r + 1e-12);
            CU_ASSERT_DOUBLE_EQUAL(s[0].P[0] / centre.P[0], 1, 10 * r * r + DBL_EPSILON);
        }
        kind->destroy(o);
    }
}

static void knows_what_lies_outside(void)
{
    for (int which = 0; which < KINDS; which++) {
        const struct oracle_kind *kind = kind_of(which);
        const struct setting set[SETTINGS] = {{"R", 5}};
        struct oracle *o = create_with(kind, set);
        CU_ASSERT_EQUAL(kind->outside(o, (const double[3]){0, 0, 0}), 0);
        CU_ASSERT_EQUAL(kind->outside(o, (const double[3]){3, -4, 0}), 0);
        CU_ASSERT_EQUAL(kind->outside(o, (const double[3]){-6, 8, 0}), 5);
        CU_ASSERT_EQUAL(kind->outside(o, (const double[3]){0, 0, 7}), which == SPHERE ? 2 : 0);
        kind->destroy(o);
    }
}

/* Fields of another mode, under the check of the true one. */
static const struct oracle *other;

static int other_which;
static void other_state(const struct oracle *oracle, const double X[3], double t, struct oracle_state *state)
{
    (void)oracle;
    kind_of(other_which)->state(other, X, t, state);
}

static void another_mode_is_caught(void)
{
    for (int which = 0; which < KINDS; which++) {
        const struct oracle_kind *kind = kind_of(which);
        other_which = which;
        struct oracle_kind spoiled = *kind;
        struct oracle *o = create_with(kind, NULL),
                      *second = create_with(kind, (const struct setting[SETTINGS]){{"mode", 2}});
        struct oracle_check line[ORACLE_LAWS];
        size_t count = 0;
        spoiled.state = other_state;
        other = o;
        CU_ASSERT_TRUE(oracle_self_check(&spoiled, o, line, &count)); /* going through the copy is no fault */
        other = second;
        CU_ASSERT_FALSE(oracle_self_check(&spoiled, o, line, &count));
        kind->destroy(second);
        kind->destroy(o);
    }
}

static void refuses_what_it_cannot_answer(void)
{
    unit_untrapped();
    static const struct {
        struct setting set[SETTINGS];
        const char *says;
    } wrong[] = {{{{"mode", 1.5}}, "a whole number"},
                 {{{"mode", 0}}, ">= 1"},
                 {{{"mode", 1001}}, "<= 1000"},
                 {{{"R", 0}}, "> 0"},
                 {{{"material.nu", 0.5}}, "infinitely fast"},
                 {{{"material.nu", -1}}, "> -1"},
                 {{{"R", 1e-150}}, "range of double precision"},
                 {{{"U0", 1e160}}, "range of double precision"},
                 {{{"material.E", 1e307}}, "range of double precision"}};
    for (int which = 0; which < KINDS; which++) {
        for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
            refuses(kind_of(which), wrong[i].set, wrong[i].says);
        }
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"roots agree with multiple precision", roots_agree_with_multiple_precision},
        {"fields agree with multiple precision", fields_agree_with_multiple_precision},
        {"agrees with shooting", agrees_with_shooting},
        {"modes are what their numbers say", modes_are_what_their_numbers_say},
        {"without bulk modulus the ball swells as a whole", without_bulk_modulus_the_ball_swells_as_a_whole},
        {"without shear the surface is a node of pressure", without_shear_the_surface_is_a_node_of_pressure},
        {"holds at the ends of its parameters", holds_at_the_ends_of_its_parameters},
        {"is smooth at the centre", is_smooth_at_the_centre},
        {"knows what lies outside", knows_what_lies_outside},
        {"another mode is caught", another_mode_is_caught},
        {"refuses what it cannot answer", refuses_what_it_cannot_answer},
    };
    return unit_main("oracles: breathing sphere and cylinder", tests, sizeof tests / sizeof *tests);
}
