/* The plastic wave against what is known of it in closed form, a finite-volume scheme with a return map of its own that
 * must converge to it, and at the ends of its parameters. */
#include "tests/unit/one_oracle.h"

static const double E = 117e9, NU = 0.35, RHO = 8930, Y = 0.4e9, H = 0.1e9; /* the typical values */

static const struct oracle_kind *the_kind(void)
{
    return kind_called("plastic-wave");
}

/* The numbers by hand, in exact fractions: nu = 1/4, so that K = 2/3 E, M = 6/5 E, HEL = 3/2 Y, and Mp = K. */
static void agrees_with_a_calculation_by_hand(void)
{
    const struct oracle_kind *kind = the_kind();
    struct oracle *oracle = create_with(kind, (const struct setting[SETTINGS]){{"material.E", 150e9},
                                                                               {"material.nu", 0.25},
                                                                               {"material.rho", 5000},
                                                                               {"material.yield_stress", 0.2e9},
                                                                               {"material.hardening", 0},
                                                                               {"v0", 50}});
    double c = 6000, cp = sqrt(20e6), vh = 10;
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "elastic wave speed"), c, 1e-11));
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "plastic wave speed"), cp, 1e-11));
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "elastic limit"), 0.3e9, 1e-6));
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "yield velocity"), vh, 1e-13));
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "arrival"), 2 / c, 1e-18));
    double t = 2e-4;
    struct oracle_state s = state_of(kind, oracle, 1, t);
    CU_ASSERT_TRUE(near(s.P[0], -0.3e9, 1e-6) && near(s.P[4], -0.1e9, 1e-6) && near(s.v[0], vh, 1e-13));
    CU_ASSERT_TRUE(near(s.F[0], 1 - vh / c, 1e-15) && near(s.u[0], vh * (t - 1 / c), 1e-17));
    s = state_of(kind, oracle, 0.5, t);
    double stress = -0.3e9 - 5000 * cp * 40;
    CU_ASSERT_TRUE(near(s.P[0], stress, 1e-5) && near(s.P[4] - s.P[0], 0.2e9, 1e-5) && s.v[0] == 50);
    CU_ASSERT_TRUE(near(s.F[0], 1 - vh / c - 40 / cp, 1e-15));
    s = state_of(kind, oracle, 1.3, t);
    CU_ASSERT_TRUE(s.u[0] == 0 && s.v[0] == 0 && s.F[0] == 1 && s.P[0] == 0 && s.P[8] == 0);
    kind->destroy(oracle);
}

static void a_slow_face_sends_out_one_elastic_wave(void)
{
    const struct oracle_kind *kind = the_kind();
    struct oracle *oracle = create_with(kind, (const struct setting[SETTINGS]){{"v0", 21}});
    double c = figure_of(kind, oracle, "elastic wave speed"), extra[ORACLE_EXTRAS], X[3] = {0, 0, 0};
    struct oracle_front front[ORACLE_FRONTS];
    CU_ASSERT_TRUE(figure_of(kind, oracle, "yield velocity") > 21);
    CU_ASSERT_EQUAL(kind->fronts(oracle, 1e-4, front), 1);
    CU_ASSERT_TRUE(near(state_of(kind, oracle, 0, 1e-4).P[0], -RHO * c * 21, 1e-6));
    kind->extras(oracle, X, 1e-4, extra);
    CU_ASSERT_TRUE(extra[0] == 0 && extra[1] == Y);
    kind->destroy(oracle);
}

/* From the bulk wave speed of a perfectly plastic material to the elastic one. */
static void hardening_speeds_the_plastic_wave_up(void)
{
    const struct oracle_kind *kind = the_kind();
    static const double hardening[] = {0, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14};
    double before = 0, bulk = sqrt(E / (3 * (1 - 2 * NU)) / RHO);
    for (size_t i = 0; i < sizeof hardening / sizeof *hardening; i++) {
        struct oracle *oracle =
            create_with(kind, (const struct setting[SETTINGS]){{"material.hardening", hardening[i]}});
        double cp = figure_of(kind, oracle, "plastic wave speed"), c = figure_of(kind, oracle, "elastic wave speed");
        CU_ASSERT_TRUE(cp > before && cp < c);
        CU_ASSERT_TRUE(i > 0 || near(cp, bulk, 1e-12 * bulk));
        CU_ASSERT_TRUE(hardening[i] < 1e14 || near(cp, c, 1e-3 * c));
        before = cp;
        kind->destroy(oracle);
    }
}

/* Godunov's scheme with the elastic impedance at every face of a cell, and radial return within. */
enum { MOST_CELLS = 1600 };
struct cell {
    double v, strain, plastic, stress; /* plastic: the strain that has flown along X, negative in compression */
};

static void return_to_yield(struct cell *cell, double *accumulated)
{
    double mu = E / (2 * (1 + NU)), bulk = E / (3 * (1 - 2 * NU));
    double dev = 2 * mu * (2 * cell->strain / 3 - cell->plastic), excess = 1.5 * fabs(dev) - (Y + H * *accumulated);
    if (excess > 0) {
        double more = excess / (3 * mu + H);
        *accumulated += more;
        cell->plastic += dev > 0 ? more : -more;
        dev = 2 * mu * (2 * cell->strain / 3 - cell->plastic);
    }
    cell->stress = bulk * cell->strain + dev;
}

/* Mean error of v over v0, and of the plastic strain over the one behind the waves. */
static void march(const struct oracle_kind *kind, const struct oracle *oracle, int cells, double t, double error[2])
{
    static struct cell cell[MOST_CELLS];
    static double accumulated[MOST_CELLS], flux[MOST_CELLS + 1], motion[MOST_CELLS + 1];
    double c = figure_of(kind, oracle, "elastic wave speed"), Z = RHO * c, h = 2.0 / cells, v0 = 60;
    int steps = (int)ceil(t * c / h);
    double dt = t / steps;
    memset(cell, 0, sizeof cell);
    memset(accumulated, 0, sizeof accumulated);
    for (int step = 0; step < steps; step++) {
        for (int i = 1; i < cells; i++) {
            flux[i] = (cell[i - 1].stress + cell[i].stress) / 2 + Z * (cell[i].v - cell[i - 1].v) / 2;
            motion[i] = (cell[i - 1].v + cell[i].v) / 2 + (cell[i].stress - cell[i - 1].stress) / (2 * Z);
        }
        motion[0] = v0;
        flux[0] = cell[0].stress + Z * (cell[0].v - v0);
        motion[cells] = 0;
        flux[cells] = cell[cells - 1].stress - Z * cell[cells - 1].v;
        for (int i = 0; i < cells; i++) {
            cell[i].v += dt / (RHO * h) * (flux[i + 1] - flux[i]);
            cell[i].strain += dt / h * (motion[i + 1] - motion[i]);
            return_to_yield(&cell[i], &accumulated[i]);
        }
    }
    error[0] = error[1] = 0;
    for (int i = 0; i < cells; i++) {
        double extra[ORACLE_EXTRAS], X[3] = {(i + 0.5) * h, 0, 0};
        kind->extras(oracle, X, t, extra);
        error[0] += fabs(cell[i].v - state_of(kind, oracle, X[0], t).v[0]) / v0 / cells;
        error[1] += fabs(accumulated[i] - extra[0]) / figure_of(kind, oracle, "plastic strain") / cells;
    }
}

static void a_finite_volume_scheme_converges_to_it(void)
{
    const struct oracle_kind *kind = the_kind();
    struct oracle *oracle = create_with(kind, NULL);
    double t = 4e-4, error[3][2];
    for (int level = 0; level < 3; level++) {
        march(kind, oracle, MOST_CELLS >> (2 * (2 - level)), t, error[level]);
    }
    printf("\n    mean errors of v and of the plastic strain: %.3g, %.3g; %.3g, %.3g; %.3g, %.3g\n", error[0][0],
           error[0][1], error[1][0], error[1][1], error[2][0], error[2][1]);
    for (int field = 0; field < 2; field++) {
        /* Smeared fronts: order one half, a factor of two for four times as many cells. */
        CU_ASSERT_TRUE(error[1][field] < 0.55 * error[0][field] && error[2][field] < 0.55 * error[1][field]);
        CU_ASSERT_TRUE(error[2][field] < 0.01);
    }
    kind->destroy(oracle);
}

static void holds_at_the_ends_of_its_parameters(void)
{
    const struct setting set[][SETTINGS] = {
        {{"v0", 10}},           /* elastic */
        {{"v0", 21.16431741}},  /* all but at the limit */
        {{"v0", 21.164317411}}, /* just beyond it */
        {{"v0", 21.17}},
        {{"v0", 1e-9}},
        {{"v0", 1e100}},
        {{"material.hardening", 0}},
        {{"material.hardening", 1e13}},
        {{"material.yield_stress", 1e-5}},
        {{"material.yield_stress", 1e-5}, {"material.hardening", 6.6e7}}, /* hardly any of the strain is elastic */
        {{"material.yield_stress", 1e15}},
        {{"material.nu", 0}},
        {{"material.nu", 0.4999}, {"v0", 3000}},
        {{"material.rho", 1e-70}},
        {{"L", 1e-7}},
        {{"L", 1e30}},
        {{"material.E", 1e-50},
         {"material.yield_stress", 1e-53},
         {"material.hardening", 1e-51},
         {"material.rho", 1e-80}},
    };
    holds_with_each(the_kind(), set, sizeof set / sizeof *set);
}

static void refuses_what_it_cannot_tell_apart(void)
{
    unit_untrapped();
    const struct oracle_kind *kind = the_kind();
    refuses(kind, (const struct setting[SETTINGS]){{"material.hardening", 1e20}}, "too near to the elastic one");
    refuses(kind, (const struct setting[SETTINGS]){{"material.nu", 0.49999999}}, "too near to the elastic one");
    refuses(kind, (const struct setting[SETTINGS]){{"v0", 1e200}}, "range of double precision");
    refuses(kind, (const struct setting[SETTINGS]){{"material.yield_stress", 1e4}, {"material.hardening", 1e5}},
            "is more than 2000 times the elastic strain");
    refuses(kind, (const struct setting[SETTINGS]){{"v0", 0}}, "v0 = 0 [m/s]");
    refuses(kind, (const struct setting[SETTINGS]){{"material.hardening", -1}}, "material.hardening = -1 [Pa]");
    refuses(kind, (const struct setting[SETTINGS]){{"material.yield_stress", 0}}, "> 0 (yield stress");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"agrees with a calculation by hand", agrees_with_a_calculation_by_hand},
        {"a slow face sends out one elastic wave", a_slow_face_sends_out_one_elastic_wave},
        {"hardening speeds the plastic wave up", hardening_speeds_the_plastic_wave_up},
        {"a finite-volume scheme converges to it", a_finite_volume_scheme_converges_to_it},
        {"holds at the ends of its parameters", holds_at_the_ends_of_its_parameters},
        {"refuses what it cannot tell apart", refuses_what_it_cannot_tell_apart},
    };
    return unit_main("oracles: plastic wave", tests, sizeof tests / sizeof *tests);
}
