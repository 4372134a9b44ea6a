/* The bimaterial wave against figures worked out by hand, the sum over all paths of a wave, and a grid of
 * characteristics; at the ends of its parameters. */
#include "tests/unit/bar_oracles.h"

static const double E1 = 79.1e9, RHO1 = 2785, C1 = 5329.3671671, PEAK = 1.5707963267948966, PI = 3.14159265358979323846;

static const struct oracle_kind *the_kind(void)
{
    return kind_called("bimaterial-wave");
}

static void has_the_figures_worked_out_by_hand(void)
{
    const struct oracle_kind *kind = the_kind();
    struct oracle *oracle = create_with(kind, NULL);
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "wave speed 1"), 5329.37, 5e-3));
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "wave speed 2"), 3932.52, 5e-3));
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "reflection"), 0.40583, 5e-6));
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "transmission"), 1.40583, 5e-6));
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "peak incident stress"), 2.33142e7, 5e1));
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "first echo"), 3.753e-4, 5e-8));
    kind->destroy(oracle);
}

/* Before, at and after the interface, by the formulas of Appendix A. */
static void first_reflection_is_as_printed(void)
{
    const struct oracle_kind *kind = the_kind();
    struct oracle *oracle = create_with(kind, NULL);
    double w = 31415.926535897932, T1 = 1 / C1, c2 = 3932.5215377;
    /* incident alone at 1e-4 s */
    struct oracle_state s = state_of(kind, oracle, 0.3, 1e-4);
    double wave = sin(w * (1e-4 - 0.3 / C1));
    CU_ASSERT_TRUE(near(s.P[0], -2.33142108e7 * wave, 2e1) && near(s.v[0], PEAK * wave, 1e-7));
    CU_ASSERT_TRUE(near(s.u[0], 5e-5 * (1 - cos(w * (1e-4 - 0.3 / C1))), 1e-13));
    /* nothing ahead of the front, and a bar moved by twice the amplitude behind the pulse */
    s = state_of(kind, oracle, 0.534, 1e-4);
    CU_ASSERT_TRUE(s.P[0] == 0 && s.v[0] == 0 && s.u[0] == 0);
    s = state_of(kind, oracle, 0.1, 2e-4);
    CU_ASSERT_TRUE(near(s.u[0], 1e-4, 1e-18) && fabs(s.P[0]) < 1e-6);
    /* at 3e-4 s the reflected pulse runs left, the transmitted one right */
    s = state_of(kind, oracle, 0.6, 3e-4);
    wave = sin(w * (3e-4 - T1 - 0.4 / C1));
    CU_ASSERT_TRUE(near(s.P[0], -0.40582965 * 2.33142108e7 * wave, 2e1));
    CU_ASSERT_TRUE(near(s.v[0], -0.40582965 * PEAK * wave, 1e-7));
    s = state_of(kind, oracle, 1.2, 3e-4);
    wave = sin(w * (3e-4 - T1 - 0.2 / c2));
    CU_ASSERT_TRUE(near(s.P[0], -1.40582965 * 2.33142108e7 * wave, 3e1));
    CU_ASSERT_TRUE(near(s.v[0], 0.59417035 * PEAK * wave, 1e-7));
    kind->destroy(oracle);
}

static void lists_the_front_and_the_end_of_the_pulse(void)
{
    const struct oracle_kind *kind = the_kind();
    struct oracle *oracle = create_with(kind, NULL);
    struct oracle_front front[ORACLE_FRONTS];
    CU_ASSERT_EQUAL_FATAL(kind->fronts(oracle, 1.5e-4, front), 3);
    CU_ASSERT_TRUE(near(front[0].X, C1 * 0.5e-4, 1e-9) && near(front[1].X, C1 * 1.5e-4, 1e-9) && front[2].X == 1);
    CU_ASSERT_TRUE(near(front[0].speed, C1, 1e-5) && near(front[1].speed, C1, 1e-5) && front[2].speed == 0);
    CU_ASSERT_TRUE(front[0].smoothness == ORACLE_KINKS && front[1].smoothness == ORACLE_KINKS);
    CU_ASSERT_TRUE(front[2].smoothness == ORACLE_JUMPS && front[0].jump == 0);
    kind->destroy(oracle);
    /* Let go at full speed, the end drops its velocity: a jump runs in. */
    oracle = create_with(kind, (const struct setting[SETTINGS]){{"t1", 0.5e-4}});
    CU_ASSERT_EQUAL_FATAL(kind->fronts(oracle, 1e-4, front), 3);
    CU_ASSERT_TRUE(front[0].smoothness == ORACLE_JUMPS && near(front[0].jump, PEAK, 1e-12));
    kind->destroy(oracle);
    /* One material: no interface, and no reflection there. */
    oracle = create_with(kind, (const struct setting[SETTINGS]){{"E2", E1}, {"rho2", RHO1}});
    CU_ASSERT_EQUAL(kind->fronts(oracle, 3e-4, front), 2);
    kind->destroy(oracle);
}

/* All paths of a wave that arrives at the interface at time t, one by one, as a tree: where it came from in bar 1 or
 * bar 2, and with what factor. Sums of w that leave it to the left (side 0) and to the right (side 1). */
struct tree {
    double R, T1, T2, t1, w;
    long branches;
};

static double leaving(struct tree *tree, int side, double t)
{
    tree->branches++;
    if (t < tree->T1) {
        return 0;
    }
    double emitted = t - tree->T1, source = 0;
    if (emitted < tree->t1) {
        source = 2 * PEAK * sin(tree->w * emitted);
    }
    double from_left = source + (emitted < tree->t1 ? -1 : 1) * leaving(tree, 0, emitted - tree->T1);
    double from_right = leaving(tree, 1, t - 2 * tree->T2);
    return side == 0 ? tree->R * from_left + (1 - tree->R) * from_right
                     : (1 + tree->R) * from_left - tree->R * from_right;
}

static void is_the_sum_over_all_paths(void)
{
    const struct oracle_kind *kind = the_kind();
    static const double end_of_drive[] = {1e-4, 4.1e-4, 9.3e-4};
    double c2 = sqrt(138.1e9 / 8930), Z2 = 8930 * c2, Z = 2785 * sqrt(E1 / RHO1), worst = 0;
    for (size_t n = 0; n < 3; n++) {
        struct tree tree = {(Z - Z2) / (Z + Z2), 1 / sqrt(E1 / RHO1), 1 / c2, end_of_drive[n], 31415.926535897932, 0};
        struct oracle *oracle = create_with(kind, (const struct setting[SETTINGS]){{"t1", end_of_drive[n]}});
        for (int i = 0; i < 48; i++) {
            double t = (i + 0.37) * 1e-4, v;
            v = (leaving(&tree, 1, t - 0.3 / c2) + leaving(&tree, 1, t - tree.T2 - 0.7 / c2)) / 2;
            worst = fmax(worst, fabs(state_of(kind, oracle, 1.3, t).v[0] - v));
        }
        CU_ASSERT_TRUE(tree.branches > 10000);
        kind->destroy(oracle);
    }
    CU_ASSERT_TRUE(near(worst, 0, 1e-12));
}

/* A hundred and fifty times of travel, 40 and 60 steps each, driven through the first echo. */
static void agrees_with_a_grid_of_characteristics(void)
{
    const struct oracle_kind *kind = the_kind();
    static const double impedance[] = {1, 2.366, 1e-6, 1e6, 0.3};
    for (size_t n = 0; n < sizeof impedance / sizeof *impedance; n++) {
        double c = sqrt(E1 / RHO1), dt = 1 / c / 40, t1 = 100 * dt, w = 2.5 / t1, peak = 5e-5 * w, worst = 0;
        struct oracle *oracle = create_with(
            kind, (const struct setting[SETTINGS]){
                      {"E2", E1 * impedance[n]}, {"rho2", RHO1 * impedance[n]}, {"L2", 1.5}, {"omega", w}, {"t1", t1}});
        struct grid_bar left = {.cells = 40, .Z = RHO1 * c}, right = {.cells = 60, .Z = RHO1 * c * impedance[n]};
        /* Waves are known in the middle of cells, half a step after they came in. */
        for (int step = 0; step < 6000; step++) {
            double a = left.right[39], b = right.left[0], out = left.left[0], t = (step + 0.5) * dt;
            double v = (left.Z * a + right.Z * b) / (left.Z + right.Z), driven = peak * sin(w * t);
            shift(&left, t < t1 ? 2 * driven - out : out, 2 * v - a);
            shift(&right, 2 * v - b, right.right[59]);
            if (step % 797 == 5) {
                worst = fmax(worst, compare_grid(kind, oracle, &left, 0, 1, (step + 1) * dt));
                worst = fmax(worst, compare_grid(kind, oracle, &right, 1, 1.5, (step + 1) * dt));
            }
        }
        CU_ASSERT_TRUE(near(worst / peak, 0, 1e-11));
        kind->destroy(oracle);
    }
}

static void holds_at_the_ends_of_its_parameters(void)
{
    static const double T1 = 1.8763953930e-4;
    const struct setting set[][SETTINGS] = {
        {{"E2", E1}, {"rho2", RHO1}},                         /* one material */
        {{"E2", E1 * 1e6}, {"rho2", RHO1 * 1e6}},             /* a rigid wall */
        {{"E2", E1 / 1e6}, {"rho2", RHO1 / 1e6}},             /* hardly anything */
        {{"E2", E1 * 1e6}, {"rho2", RHO1 * 1e6}, {"L2", 10}}, /* heavy and long */
        {{"E2", E1 * 4}, {"rho2", RHO1 / 4}},                 /* one impedance, two materials */
        {{"L2", 0.01}},                                       /* a thin coat */
        {{"L2", 70}},
        {{"L1", 0.015}},
        {{"L2", 0.7378985}},                                       /* nearly the same time of travel */
        {{"E2", E1}, {"rho2", RHO1 * 4}, {"L2", 0.5}, {"t1", T1}}, /* the same */
        {{"t1", 2 * T1}},                                          /* let go when the echo arrives */
        {{"t1", 7e-5}},                                            /* let go at speed */
        {{"t1", 1.3e-3}},                                          /* driven through many reflections */
        {{"t1", 1e-6}},
        {{"omega", 1e-3}},
        {{"omega", 3e5}},
        {{"A1", 0}},
        {{"A1", -1e3}},
        {{"A1", 1e-100}},
    };
    holds_with_each(the_kind(), set, sizeof set / sizeof *set);
}

/* Each broke the check, or the list of fronts, once. Of the right bar, over that of the left one: impedance, wave
 * speed, time of travel; then the phase at t1, and t1 over the time of travel of the left bar. */
static void holds_with_hostile_parameters(void)
{
    static const struct {
        double Z, c, T, phase, t1;
    } with[] = {
        {1e6, 1e-3, 0.084, 2.7, 0.0031}, /* a slow sliver far from the origin, where places have round-off */
        {1e5, 1e-4, 0.084, 2.7, 0.31},   /* the same, heavier on all lines */
        {10, 1, 6.25, 2 * PI, 0.04913},  /* a short pulse that leaves no displacement: samples miss it */
        {2, 0.1, 36.7, 1e-3, 0.427},     /* a jump, small beside A omega, that was listed as a kink */
        {1e6, 1, 1.5, 2 * PI, 40.8},     /* slowly moved against a wall: nothing is left swinging */
        {1e-3, 0.01, 2, 37.5, 4},        /* quickly moved before a soft end: little is */
        {2818, 6, 1, 2.5e-3, 35.6},      /* u grows with the fourth power of the time */
        {38627, 0.2, 75.8, 650, 345},    /* many echoes, of which most cancel */
        {336, 0.1, 40.1, 2 * PI, 251},   /* stresses so large beside the velocities that v is a small difference */
    };
    const double c = sqrt(E1 / RHO1), L = 1.3;
    for (size_t i = 0; i < sizeof with / sizeof *with; i++) {
        double t1 = with[i].t1 * L / c, stiffness = with[i].Z * with[i].c, density = with[i].Z / with[i].c;
        const struct setting set[][SETTINGS] = {{{"L1", L},
                                                 {"E2", E1 * stiffness},
                                                 {"rho2", RHO1 * density},
                                                 {"L2", L * with[i].c * with[i].T},
                                                 {"omega", with[i].phase / t1},
                                                 {"t1", t1}}};
        holds_with_each(the_kind(), set, 1);
    }
}

/* Where all times of travel are round parts of each other, jumps meet at the weld just when it is looked at. */
static void holds_in_step(void)
{
    static const double travel[] = {6, 2.5, 3, 2, 1.5}, drive[] = {2, 4, 6, 10};
    for (int i = 0; i < 20; i++) {
        const struct setting set[][SETTINGS] = {{{"E1", 1},
                                                 {"rho1", 1},
                                                 {"E2", 0.05},
                                                 {"rho2", 5},
                                                 {"L2", 0.1 * travel[i % 5]},
                                                 {"omega", 6.9 / drive[i / 5]},
                                                 {"t1", drive[i / 5]}}};
        holds_with_each(the_kind(), set, 1);
    }
}

static void refuses_what_it_cannot_check(void)
{
    unit_untrapped();
    const struct oracle_kind *kind = the_kind();
    refuses(kind, (const struct setting[SETTINGS]){{"L2", 1e3}}, "neither may take more than 100 times as long");
    refuses(kind, (const struct setting[SETTINGS]){{"t1", 1}}, "t1 must be at least");
    refuses(kind, (const struct setting[SETTINGS]){{"t1", 1e-9}}, "t1 must be at least");
    refuses(kind, (const struct setting[SETTINGS]){{"omega", 1e8}}, "omega with this t1 at most");
    refuses(kind, (const struct setting[SETTINGS]){{"E2", 1e-6}, {"rho2", 1e9}, {"L2", 5e-12}},
            "are too coarse in double precision");
    refuses(kind, (const struct setting[SETTINGS]){{"A1", 1e200}}, "range of double precision");
    refuses(kind, (const struct setting[SETTINGS]){{"E1", 1e-320}}, "range of double precision");
}

/* Beyond its reach it says so, and does not run on for ever. */
static void says_nothing_of_times_too_late(void)
{
    const struct oracle_kind *kind = the_kind();
    struct oracle *oracle = create_with(kind, NULL);
    struct oracle_front front[ORACLE_FRONTS];
    double kinetic, strain;
    CU_ASSERT_TRUE(isfinite(state_of(kind, oracle, 0.5, 1).v[0]));
    CU_ASSERT_TRUE(isnan(state_of(kind, oracle, 0.5, 1e3).v[0]) && isnan(state_of(kind, oracle, 1.5, 1e300).P[0]));
    unit_untrapped();
    CU_ASSERT_TRUE(isnan(state_of(kind, oracle, 0.5, INFINITY).u[0]) && isnan(state_of(kind, oracle, 0.5, NAN).u[0]));
    CU_ASSERT_EQUAL(kind->fronts(oracle, 1e3, front), ORACLE_TOO_MANY_FRONTS);
    CU_ASSERT_EQUAL(kind->fronts(oracle, NAN, front), ORACLE_TOO_MANY_FRONTS);
    unit_trapped();
    kind->energy(oracle, 1e3, &kinetic, &strain);
    CU_ASSERT_TRUE(isnan(kinetic) && isnan(strain));
    kind->destroy(oracle);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"has the figures worked out by hand", has_the_figures_worked_out_by_hand},
        {"first reflection is as printed", first_reflection_is_as_printed},
        {"lists the front and the end of the pulse", lists_the_front_and_the_end_of_the_pulse},
        {"is the sum over all paths", is_the_sum_over_all_paths},
        {"agrees with a grid of characteristics", agrees_with_a_grid_of_characteristics},
        {"holds at the ends of its parameters", holds_at_the_ends_of_its_parameters},
        {"holds with hostile parameters", holds_with_hostile_parameters},
        {"holds in step", holds_in_step},
        {"refuses what it cannot check", refuses_what_it_cannot_check},
        {"says nothing of times too late", says_nothing_of_times_too_late},
    };
    return unit_main("oracles: bimaterial wave", tests, sizeof tests / sizeof *tests);
}
