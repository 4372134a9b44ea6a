/* Cycles of J2 plasticity against calculations by hand, the printed return map taken in many steps, each other in the
 * limit of small strains, and at the ends of their parameters. */
#include "tests/unit/one_oracle.h"

static const char *const names[] = {"j2-uniaxial", "j2-simple-shear", "j2-hencky-uniaxial"};
enum { KINDS = sizeof names / sizeof *names };

static struct oracle_state at_corner(const struct oracle_kind *kind, const struct oracle *oracle, double t)
{
    struct oracle_state state;
    const double X[3] = {1, 1, 1};
    kind->state(oracle, X, t, &state);
    return state;
}

static double plastic_strain(const struct oracle_kind *kind, const struct oracle *oracle, double t)
{
    double value[ORACLE_EXTRAS];
    const double X[3] = {1, 1, 1};
    kind->extras(oracle, X, t, value);
    return value[0];
}

/* mu = 60 GPa, K = 100 GPa, perfectly plastic; yields at a strain of 0.002, of which a turn takes twice as much back.
 */
static void agrees_with_a_stretch_by_hand(void)
{
    const struct oracle_kind *kind = kind_called(names[0]);
    struct oracle *oracle = create_with(kind, (const struct setting[SETTINGS]){{"material.E", 150e9},
                                                                               {"material.nu", 0.25},
                                                                               {"material.yield_stress", 0.24e9},
                                                                               {"material.hardening", 0},
                                                                               {"amplitude", 0.01},
                                                                               {"period", 4},
                                                                               {"material.rho", 1000}});
    struct oracle_state s = at_corner(kind, oracle, 0.1); /* strain 0.001: elastic */
    CU_ASSERT_TRUE(near(s.P[0], 180e9 * 0.001, 1e-6) && near(s.P[4], 60e9 * 0.001, 1e-6));
    CU_ASSERT_TRUE(near(s.u[0], 0.001, 1e-17) && near(s.v[0], 0.01, 1e-16) && near(s.p[0], 10, 1e-13));
    CU_ASSERT_EQUAL(plastic_strain(kind, oracle, 0.1), 0);
    s = at_corner(kind, oracle, 1); /* the first peak */
    CU_ASSERT_TRUE(near(s.P[0], 1e9 + 0.16e9, 1e-5) && near(s.P[8], 1e9 - 0.08e9, 1e-5));
    CU_ASSERT_TRUE(near(plastic_strain(kind, oracle, 1), 2.0 / 3 * 0.008, 1e-16));
    s = at_corner(kind, oracle, 1.2); /* 0.008 on the way down: elastic, half way to the other side */
    CU_ASSERT_TRUE(near(s.P[0], 0.8e9, 1e-5) && near(s.P[4], 0.8e9, 1e-5) && near(s.v[0], -0.01, 1e-16));
    CU_ASSERT_TRUE(near(plastic_strain(kind, oracle, 1.2), 2.0 / 3 * 0.008, 1e-16));
    s = at_corner(kind, oracle, 3);
    CU_ASSERT_TRUE(near(s.P[0], -1.16e9, 1e-5) && near(s.F[0], 0.99, 1e-15));
    CU_ASSERT_TRUE(near(plastic_strain(kind, oracle, 3), 2.0 / 3 * 0.024, 1e-15));
    kind->destroy(oracle);
}

/* Hardening of 3 mu takes half of every strain beyond yield: then the stress is easy to say. */
static void agrees_with_a_shear_by_hand(void)
{
    const struct oracle_kind *kind = kind_called(names[1]);
    double mu = 40e9, Y = sqrt(3) * mu * 0.001; /* yields at a shear of 0.001 */
    struct oracle *oracle = create_with(kind, (const struct setting[SETTINGS]){{"material.E", 100e9},
                                                                               {"material.nu", 0.25},
                                                                               {"material.yield_stress", Y},
                                                                               {"material.hardening", 3 * mu},
                                                                               {"amplitude", 0.005},
                                                                               {"period", 4}});
    struct oracle_state s = at_corner(kind, oracle, 1);
    CU_ASSERT_TRUE(near(s.P[1], mu * 0.003, 1e-6) && s.P[3] == s.P[1] && s.P[0] == 0);
    CU_ASSERT_TRUE(near(s.F[1], 0.005, 1e-17) && s.F[3] == 0 && near(s.u[0], 0.005, 1e-17));
    CU_ASSERT_TRUE(near(plastic_strain(kind, oracle, 1), 0.002 / sqrt(3), 1e-17));
    s = at_corner(kind, oracle, 2.2); /* 0.006 back: just yields on the other side */
    CU_ASSERT_TRUE(near(s.P[1], -mu * 0.003, 1e-6));
    CU_ASSERT_TRUE(near(plastic_strain(kind, oracle, 2.2), 0.002 / sqrt(3), 1e-16));
    s = at_corner(kind, oracle, 3); /* and 0.004 more */
    CU_ASSERT_TRUE(near(s.P[1], -mu * 0.005, 1e-6));
    kind->destroy(oracle);
}

/* Algorithm 2 as it is printed, for a stretch along X: from F, the inverse of the plastic Cauchy-Green tensor and the
 * plastic strain, all diagonal. */
struct printed {
    double inverse[3], plastic, P[3];
};

static void printed_update(struct printed *p, double stretch)
{
    double mu = 117e9 / 2.7, kappa = 117e9 / 0.9, F[3] = {stretch, 1, 1}, J = stretch;
    double pressure = kappa * log(J) / J, elastic[3], trial[3], square = 0;
    for (int i = 0; i < 3; i++) {
        elastic[i] = sqrt(F[i] * p->inverse[i] * F[i]);
        trial[i] = 2 * mu * log(elastic[i]) - 2 * mu / 3 * log(J);
        square += trial[i] * trial[i];
    }
    double f = sqrt(1.5 * square) - (0.4e9 + 0.1e9 * p->plastic), size = sqrt(2 * square / 3);
    double flow = f > 0 ? f / (3 * mu + 0.1e9) : 0;
    for (int i = 0; i < 3; i++) {
        double direction = f > 0 ? trial[i] / size : 0, kept = f > 0 ? 1 - 2 * mu * flow / size : 1;
        elastic[i] = exp(log(elastic[i]) - flow * direction);
        p->P[i] = (kept * trial[i] + J * pressure) / F[i];
        p->inverse[i] = elastic[i] * elastic[i] / (F[i] * F[i]);
    }
    p->plastic += flow;
}

static void agrees_with_the_printed_return_map(void)
{
    const struct oracle_kind *kind = kind_called(names[2]);
    struct oracle *oracle = create_with(kind, (const struct setting[SETTINGS]){{"amplitude", 0.3}, {"period", 1}});
    struct printed printed = {.inverse = {1, 1, 1}};
    double worst = 0, plastic = 0;
    enum { STEPS = 800 };
    for (int step = 1; step <= STEPS; step++) {
        double t = 2.0 * step / STEPS, x = 0.3 * 2 / 3.14159265358979323846 * asin(sin(2 * 3.14159265358979323846 * t));
        struct oracle_state s = at_corner(kind, oracle, t);
        printed_update(&printed, 1 + x);
        for (int i = 0; i < 3; i++) {
            worst = fmax(worst, fabs(s.P[4 * i] - printed.P[i]) / 1e11);
        }
        plastic = fmax(plastic, fabs(plastic_strain(kind, oracle, t) - printed.plastic));
    }
    CU_ASSERT_TRUE(near(worst, 0, 1e-12) && near(plastic, 0, 1e-12));
    CU_ASSERT_TRUE(printed.plastic > 1);
    kind->destroy(oracle);
}

/* All strains and the yield stress ten times smaller, stresses part ten times less. */
static void finite_and_small_strains_agree_in_the_limit(void)
{
    const struct oracle_kind *small = kind_called(names[0]), *finite = kind_called(names[2]);
    double off[2];
    for (int i = 0; i < 2; i++) {
        double size = i == 0 ? 1 : 0.1;
        const struct setting set[SETTINGS] = {{"amplitude", 0.02 * size}, {"material.yield_stress", 0.4e9 * size}};
        struct oracle *a = create_with(small, set), *b = create_with(finite, set);
        double P = at_corner(small, a, 1.9e-3).P[0];
        off[i] = at_corner(finite, b, 1.9e-3).P[0] / P - 1;
        small->destroy(a);
        finite->destroy(b);
    }
    CU_ASSERT_TRUE(fabs(off[0]) > 1e-3 && near(off[0] / off[1], 10, 1));
}

/* The stress jumps nowhere, though the velocity does. */
static void stress_is_continuous(void)
{
    for (size_t n = 0; n < KINDS; n++) {
        const struct oracle_kind *kind = kind_called(names[n]);
        struct oracle *oracle = create_with(kind, NULL);
        for (int quarter = 1; quarter < 8; quarter += 2) {
            double t = quarter * 0.25e-3;
            struct oracle_state before = at_corner(kind, oracle, t * (1 - 1e-12));
            struct oracle_state after = at_corner(kind, oracle, t * (1 + 1e-12));
            for (int i = 0; i < 9; i++) {
                CU_ASSERT_TRUE(near(after.P[i], before.P[i], 1));
            }
            CU_ASSERT_TRUE(near(after.v[0], -before.v[0], 1e-12) && before.v[0] != 0);
        }
        kind->destroy(oracle);
    }
}

static void holds_at_the_ends_of_its_parameters(void)
{
    const struct setting set[][SETTINGS] = {
        {{"amplitude", 1e-9}}, /* elastic */
        {{"amplitude", 0.5}},
        {{"cycles", 1}},
        {{"cycles", 100}},
        {{"cycles", 100}, {"amplitude", 1e-9}},
        {{"cycles", 70}, {"material.nu", 0.499999999}, {"amplitude", 0.36}, {"material.yield_stress", 38e9}},
        {{"cycles", 69}, {"material.E", 2.87e12}, {"material.yield_stress", 1e7}, {"material.hardening", 1e7}},
        {{"cycles", 1}, {"material.E", 7e12}, {"material.hardening", 2.7e6}},
        {{"material.hardening", 0}},
        {{"material.hardening", 1e13}},
        {{"material.yield_stress", 1e6}},
        {{"material.yield_stress", 1e12}},
        {{"material.nu", 0}},
        {{"material.nu", 0.4999}},
        {{"material.nu", 0.499999}, {"amplitude", 0.4}},
        {{"period", 1e-30}},
        {{"period", 1e30}},
        {{"material.rho", 1e-50}},
    };
    for (size_t n = 0; n < KINDS; n++) {
        holds_with_each(kind_called(names[n]), set, sizeof set / sizeof *set);
    }
}

static void refuses_what_is_no_cycle(void)
{
    unit_untrapped();
    for (size_t n = 0; n < KINDS; n++) {
        const struct oracle_kind *kind = kind_called(names[n]);
        refuses(kind, (const struct setting[SETTINGS]){{"cycles", 1.5}}, "must be a whole number; cycles = 2 would do");
        refuses(kind, (const struct setting[SETTINGS]){{"cycles", 0}}, "cycles = 0 [-]");
        refuses(kind, (const struct setting[SETTINGS]){{"amplitude", 0.51}}, "<= 0.5");
        refuses(kind, (const struct setting[SETTINGS]){{"material.yield_stress", 1e3}}, "at most 10000 times");
        refuses(kind, (const struct setting[SETTINGS]){{"period", 1e-200}}, "range of double precision");
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"agrees with a stretch by hand", agrees_with_a_stretch_by_hand},
        {"agrees with a shear by hand", agrees_with_a_shear_by_hand},
        {"agrees with the printed return map", agrees_with_the_printed_return_map},
        {"finite and small strains agree in the limit", finite_and_small_strains_agree_in_the_limit},
        {"stress is continuous", stress_is_continuous},
        {"holds at the ends of its parameters", holds_at_the_ends_of_its_parameters},
        {"refuses what is no cycle", refuses_what_is_no_cycle},
    };
    return unit_main("oracles: J2 cycles", tests, sizeof tests / sizeof *tests);
}
