/* The swinging cube against values from elsewhere, at the ends of its parameters, and after thousands of periods. */
#include "oracles/oracle.h"
#include "tests/unit/unit.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

enum { PARAMETERS = 7 };

static const struct oracle_kind *the_kind(void)
{
    const struct oracle_kind *kind = oracle_find("swinging-cube");
    CU_ASSERT_PTR_NOT_NULL_FATAL(kind);
    return kind;
}

static struct oracle *create(const double value[PARAMETERS])
{
    struct oracle *oracle = NULL;
    char why[ORACLE_WHY] = "";
    bool created = oracle_create(the_kind(), value, &oracle, why);
    if (!created) {
        printf("%s\n", why);
    }
    CU_ASSERT_TRUE_FATAL(created);
    return oracle;
}

static void close_to(const double *value, const double *expected, size_t count, double tolerance)
{
    double scale = 0;
    for (size_t i = 0; i < count; i++) {
        scale = fmax(scale, fabs(expected[i]));
    }
    for (size_t i = 0; i < count; i++) {
        CU_ASSERT_TRUE(fabs(value[i] - expected[i]) <= tolerance * scale);
    }
}

struct expected {
    double value[PARAMETERS];
    double u[3], v[3], G[9], P[9], kinetic, strain;
};

/* At X = (1/4, 1/2, 3/4), t = 0.002 s: u differentiated by a computer algebra system, to 30 digits; the energies are
 * exact integrals of p.v/2 and P:G/2 over the cube. */
static const struct expected expected[] = {
    {.value = {1, -0.5, 0.25, 5e-4, 17e6, 0.3, 1100},
     .u = {4.4623093896921118e-05, -6.3511230092137735e-05, 5.3376388903737026e-05},
     .v = {-0.0069076877390223355, -0.0006567062689052613, -0.020923191884140491},
     .G = {0.00016922138324474225, -7.0093791983507456e-05, -0.00016922138324474225, 4.132327333994902e-05,
           -9.9763206938955474e-05, 0.00024084968721785994, -3.4729088152893391e-05, -8.3843435627565992e-05,
           3.4729088152893391e-05},
     .P = {3234.7316438529156, -188.1149295924975, -1333.5223129845406, -188.1149295924975, -282.75915085697756,
           1026.5793373211527, -1333.5223129845406, 1026.5793373211527, 1475.986246497969},
     .kinetic = 0.38901778488905542,
     .strain = 0.95802529625797195},
    {.value = {1, 1, 1, 5e-4, 17e6, 0.3, 1100},
     .u = {3.6631762059518864e-05, 8.843689677771462e-05, 0.0002135055556149481},
     .v = {-0.014359408764196656, -0.034666679386182647, -0.083692767536561963},
     .G = {0.00013891635261157356, -5.7541037287116886e-05, -0.00013891635261157356, -5.7541037287116886e-05,
           0.00013891635261157356, -0.00033537374251026397, -0.00013891635261157356, -0.00033537374251026397,
           0.00013891635261157356},
     .P = {5903.9449859918759, -752.45971836999001, -1816.5984572282696, -752.45971836999001, 5903.9449859918759,
           -4385.6566328265289, -1816.5984572282696, -4385.6566328265289, 5903.9449859918759},
     .kinetic = 3.9658695768924574,
     .strain = 3.9745949014479143},
};

static void agrees_with_computer_algebra(void)
{
    static const double X[3] = {0.25, 0.5, 0.75};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        const struct expected *e = &expected[i];
        struct oracle *oracle = create(e->value);
        struct oracle_state s;
        double energy[2], p[3], F[9];
        the_kind()->state(oracle, X, 0.002, &s);
        the_kind()->energy(oracle, 0.002, &energy[0], &energy[1]);
        for (int k = 0; k < 3; k++) {
            p[k] = 1100 * e->v[k];
        }
        for (int k = 0; k < 9; k++) {
            F[k] = e->G[k] + (k % 4 == 0 ? 1 : 0);
        }
        close_to(s.u, e->u, 3, 8 * DBL_EPSILON);
        close_to(s.v, e->v, 3, 8 * DBL_EPSILON);
        close_to(s.p, p, 3, 8 * DBL_EPSILON);
        close_to(s.F, F, 9, DBL_EPSILON);
        close_to(s.P, e->P, 9, 8 * DBL_EPSILON);
        close_to(&energy[0], &e->kinetic, 1, 8 * DBL_EPSILON);
        close_to(&energy[1], &e->strain, 1, 8 * DBL_EPSILON);
        the_kind()->destroy(oracle);
    }
}

/* Each passes its own check, whose bounds grow with nothing but the phase that the faster wave runs through. */
static void holds_at_the_ends_of_its_parameters(void)
{
    static const double value[][PARAMETERS] = {
        {1, 1, 1, 5e-4, 17e6, 0.3, 1100},
        {1, -0.5, -0.5, 5e-4, 17e6, 0.3, 1100},            /* s-wave alone */
        {1, 0, 0, 5e-7, 17e6, 0, 1100},                    /* lambda = 0 */
        {0.1, 0.2, -0.3, 5e-4, 17e6, 0.4999, 1100},        /* the sum is round-off, not zero */
        {1, 1, 1, 5e-4, 17e6, 0.4999, 1100},               /* cp / cs = 71 */
        {1, 2, 3, 5e-4, 17e6, 0.499999999999, 1100},       /* cp / cs = 7e5 */
        {1, 2, 3, 5e-4, 17e6, 0.49999999999999994, 1100},  /* the last number below 1/2 */
        {1, 2, 3, 5e-4, 17e6, -0.99999999999999989, 1100}, /* the first above -1 */
        {1, 0.5, -0.3, -1e-70, 1e-50, 0.3, 1e-80},         /* tiny */
        {1, 0.5, -0.3, 1e70, 1e50, 0.3, 1e80},             /* huge */
        {1, 1e-13, -1, 5e-4, 17e6, 0.4999, 1100},          /* hardly any p-wave */
        {1e16, 1, -1e16, 1e-20, 17e6, 0.4999, 1100},
        {1, 1, 1, 1.7845759660682243e-4, 17e6, 0.07682073516354182, 300}, /* terms of energy that are rounded alike */
        {0, 0, 0, 5e-4, 17e6, 0.3, 1100},
        {1, 1, 1, 0, 17e6, 0.3, 1100},
    };
    for (size_t i = 0; i < sizeof value / sizeof *value; i++) {
        struct oracle *oracle = create(value[i]);
        struct oracle_check line[ORACLE_LAWS];
        size_t count = 0;
        CU_ASSERT_TRUE(oracle_self_check(the_kind(), oracle, line, &count));
        for (size_t j = 0; j < count; j++) {
            if (!oracle_law_holds(&line[j])) {
                printf("set %zu, %s: %.3g > %.3g\n", i, line[j].law, line[j].residual, line[j].bound);
            }
        }
        the_kind()->destroy(oracle);
    }
}

/* After a thousand to a million periods, against the same formula in sixty digits: the error is the round-off of the
 * frequency times the time, and nothing more. */
static void keeps_its_phase(void)
{
    static const double value[PARAMETERS] = {1, -0.5, 0.25, 5e-4, 17e6, 0.3, 1100};
    static const double X[3] = {0.25, 0.5, 0.75}, p_frequency = 392.43;
    static const struct {
        double t, u[3], v[3];
    } at[] = {
        {20,
         {-6.1448785903039248e-6, 5.8871143376880444e-5, 5.3156267859438126e-5},
         {0.0038851218105242058, -0.026784197840877967, -0.021009312170664725}},
        {2000,
         {-4.7250325863480748e-5, 5.551427849922819e-5, -7.0685878428806917e-5},
         {0.0052499085139789209, -0.0041019347442950417, 0.010347881346832101}},
        {20000,
         {-2.3454593148685111e-5, -2.1263111263770759e-7, -6.8608361911797444e-5},
         {0.0098809028430015077, -0.013653068470592698, 0.012314349538709175}},
    };
    struct oracle *oracle = create(value);
    for (size_t n = 0; n < sizeof at / sizeof *at; n++) {
        struct oracle_state s;
        the_kind()->state(oracle, X, at[n].t, &s);
        double bound = 2 * DBL_EPSILON * (1 + p_frequency * at[n].t) * 5e-4;
        for (int i = 0; i < 3; i++) {
            CU_ASSERT_TRUE(fabs(s.u[i] - at[n].u[i]) <= bound);
            CU_ASSERT_TRUE(fabs(s.v[i] - at[n].v[i]) <= bound * p_frequency);
        }
    }
    the_kind()->destroy(oracle);
}

/* A = B = C swings with the p-wave: after half its period everything is mirrored. The s-wave is then elsewhere. */
static void each_part_has_its_own_period(void)
{
    static const double p_wave[PARAMETERS] = {1, 1, 1, 5e-4, 17e6, 0.3, 1100};
    static const double s_wave[PARAMETERS] = {1, 1, -2, 5e-4, 17e6, 0.3, 1100};
    static const double X[3] = {0.6, 0.3, 0.2};
    double half_p = 1 / sqrt(3 * (17e6 * 0.7 / (1.3 * 0.4)) / 1100) * 2, half_s = 1 / sqrt(3 * (17e6 / 2.6) / 1100) * 2;
    struct oracle *p = create(p_wave), *s = create(s_wave);
    struct oracle_state start, later;
    the_kind()->state(p, X, 0, &start);
    the_kind()->state(p, X, half_p, &later);
    for (int i = 0; i < 3; i++) {
        CU_ASSERT_TRUE(fabs(later.u[i] + start.u[i]) <= 8 * DBL_EPSILON * fabs(start.u[0]));
    }
    the_kind()->state(s, X, 0, &start);
    the_kind()->state(s, X, half_s, &later);
    for (int i = 0; i < 3; i++) {
        CU_ASSERT_TRUE(fabs(later.u[i] + start.u[i]) <= 8 * DBL_EPSILON * fabs(start.u[2]));
    }
    CU_ASSERT_TRUE(fabs(start.P[0] + start.P[4] + start.P[8]) <= 8 * DBL_EPSILON * fabs(start.P[0]));
    the_kind()->state(s, X, half_p, &later);
    CU_ASSERT_TRUE(fabs(later.u[2] + start.u[2]) > 0.1 * fabs(start.u[2]));
    the_kind()->destroy(p);
    the_kind()->destroy(s);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"agrees with computer algebra", agrees_with_computer_algebra},
        {"holds at the ends of its parameters", holds_at_the_ends_of_its_parameters},
        {"keeps its phase", keeps_its_phase},
        {"each part has its own period", each_part_has_its_own_period},
    };
    return unit_main("oracles: swinging cube", tests, sizeof tests / sizeof *tests);
}
