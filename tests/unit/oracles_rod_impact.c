/* The impact of two rods against what is known of it in closed form, a grid of characteristics with unilateral contact,
 * and the conservation of momentum; at the ends of its parameters. */
#include "tests/unit/bar_oracles.h"

static const double E = 200e9, RHO = 7850;

static const struct oracle_kind *the_kind(void)
{
    return kind_called("rod-impact");
}

/* Equal rods exchange their velocities; they press for the time a wave takes there and back, with rho c dv / 2. */
static void equal_rods_exchange_their_velocities(void)
{
    const struct oracle_kind *kind = the_kind();
    struct oracle *oracle =
        create_with(kind, (const struct setting[SETTINGS]){{"E2", E}, {"rho2", RHO}, {"L2", 1}, {"gap", 3e-3}});
    double c = sqrt(E / RHO);
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "first contact"), 1e-3, 1e-18));
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "contact time"), 2 / c, 1e-18));
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "contact stress"), RHO * c * 1.5, 1e-7));
    CU_ASSERT_EQUAL(figure_of(kind, oracle, "contact velocity"), 0.5);
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "exit velocity 1"), -1, 1e-15));
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "exit velocity 2"), 2, 1e-15));
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "restitution"), 1, 1e-15));
    /* Half way, all stands under stress; afterwards nothing swings. */
    struct oracle_state s = state_of(kind, oracle, 0.3, 1e-3 + 1 / c);
    CU_ASSERT_TRUE(near(s.P[0], -RHO * c * 1.5, 1e-6) && near(s.v[0], 0.5, 1e-15));
    s = state_of(kind, oracle, 0.3, 1);
    CU_ASSERT_TRUE(s.P[0] == 0 && s.v[0] == -1);
    CU_ASSERT_TRUE(near(s.u[0], 2 * 1e-3 + 0.5 * 2 / c - (1 - 1e-3 - 2 / c), 1e-14));
    kind->destroy(oracle);
}

/* One material: the shorter rod comes out with all of the other's velocity, and the restitution is the ratio of the
 * lengths (Saint-Venant). */
static void restitution_is_the_ratio_of_lengths(void)
{
    const struct oracle_kind *kind = the_kind();
    static const double length[] = {1.5, 2, 3, 10, 0.5, 0.61803398874989485, 0.3, 99, 0.0101};
    for (size_t i = 0; i < sizeof length / sizeof *length; i++) {
        double L2 = length[i], shorter = fmin(1, L2), c = sqrt(E / RHO);
        struct oracle *oracle =
            create_with(kind, (const struct setting[SETTINGS]){{"E2", E}, {"rho2", RHO}, {"L2", L2}, {"v2", 0}});
        CU_ASSERT_TRUE(near(figure_of(kind, oracle, "contact time"), 2 * shorter / c, 1e-15));
        CU_ASSERT_TRUE(near(figure_of(kind, oracle, "restitution"), shorter / fmax(1, L2), 1e-13));
        CU_ASSERT_TRUE(near(figure_of(kind, oracle, "exit velocity 1"), L2 > 1 ? 0 : 2 * (1 - L2), 1e-12));
        CU_ASSERT_TRUE(near(figure_of(kind, oracle, "exit velocity 2"), L2 > 1 ? 2 / L2 : 2, 1e-12));
        kind->destroy(oracle);
    }
}

/* A rod that is a million times as heavy is a wall: the other one comes back as it went. */
static void bounces_off_a_wall(void)
{
    const struct oracle_kind *kind = the_kind();
    struct oracle *oracle = create_with(
        kind, (const struct setting[SETTINGS]){{"E2", E * 1e9}, {"rho2", RHO * 1e9}, {"L2", 1.3}, {"v2", 0}});
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "contact time"), 2 / sqrt(E / RHO), 1e-15));
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "exit velocity 1"), -2, 1e-8));
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "contact stress"), 2 * sqrt(E * RHO), 1));
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "contact velocity"), 0, 1e-8));
    kind->destroy(oracle);
}

static void keeps_momentum(void)
{
    const struct oracle_kind *kind = the_kind();
    for (int i = 0; i < 60; i++) {
        double z = pow(10, -3 + 0.1 * i), c = pow(1.3, i % 7 - 3), L2 = c * pow(1.31, i % 11 - 5), m1 = RHO;
        double rho2 = RHO * z / c, m2 = rho2 * L2;
        struct oracle *oracle =
            create_with(kind, (const struct setting[SETTINGS]){{"E2", E * z * c}, {"rho2", rho2}, {"L2", L2}});
        double after =
            m1 * figure_of(kind, oracle, "exit velocity 1") + m2 * figure_of(kind, oracle, "exit velocity 2");
        double restitution = figure_of(kind, oracle, "restitution");
        CU_ASSERT_TRUE(near(after, m1 * 2 - m2 * 1, 1e-12 * (m1 + m2)));
        CU_ASSERT_TRUE(restitution > 0 && restitution <= 1 + 1e-12);
        kind->destroy(oracle);
    }
}

/* Times of travel of 40 and `cells` steps; the rods touch at first, and the grid finds out when they part. */
static void agrees_with_a_grid_of_characteristics(void)
{
    const struct oracle_kind *kind = the_kind();
    static const struct {
        double impedance;
        int cells;
    } with[] = {{1, 40}, {1, 60}, {0.37, 100}, {0.37, 30}, {2.5, 110}, {2.5, 20}, {1e-3, 90}, {1e3, 50}};
    for (size_t n = 0; n < sizeof with / sizeof *with; n++) {
        double c = sqrt(E / RHO), dt = 1 / c / 40, gap = 0, worst = 0, z = with[n].impedance;
        int cells = with[n].cells, pressed = 0;
        struct oracle *oracle = create_with(
            kind, (const struct setting[SETTINGS]){{"E2", E * z}, {"rho2", RHO * z}, {"L2", cells / 40.0}, {"gap", 0}});
        struct grid_bar left = {.cells = 40, .Z = RHO * c}, right = {.cells = cells, .Z = RHO * c * z};
        fill(&left, 2);
        fill(&right, -1);
        for (int step = 1; step <= 3000; step++) {
            double a = left.right[39], b = right.left[0], v = (left.Z * a + right.Z * b) / (left.Z + right.Z);
            bool press = gap <= 1e-12 * dt && a > b + 1e-12;
            gap = press ? 0 : gap + (b - a) * dt;
            pressed += press;
            shift(&left, left.left[0], press ? 2 * v - a : a);
            shift(&right, press ? 2 * v - b : b, right.right[cells - 1]);
            if (step % 61 == 0) {
                worst = fmax(worst, compare_grid(kind, oracle, &left, 0, 1, step * dt));
                worst = fmax(worst, compare_grid(kind, oracle, &right, 1, cells / 40.0, step * dt));
            }
        }
        CU_ASSERT_TRUE(near(worst, 0, 1e-11));
        CU_ASSERT_TRUE(near(figure_of(kind, oracle, "contact time"), pressed * dt, 1e-15));
        kind->destroy(oracle);
    }
}

static void says_nothing_of_the_gap(void)
{
    const struct oracle_kind *kind = the_kind();
    struct oracle *oracle = create_with(kind, (const struct setting[SETTINGS]){{"gap", 0.1}});
    CU_ASSERT_TRUE(isnan(state_of(kind, oracle, 1.05, 1e-3).v[0]) && isnan(state_of(kind, oracle, 1.05, 1e-3).P[0]));
    CU_ASSERT_TRUE(state_of(kind, oracle, 1, 1e-3).v[0] == 2 && state_of(kind, oracle, 1.1, 1e-3).v[0] == -1);
    kind->destroy(oracle);
}

static void holds_at_the_ends_of_its_parameters(void)
{
    const struct setting set[][SETTINGS] = {
        {{"E2", E}, {"rho2", RHO}, {"L2", 1}, {"v2", 0}, {"gap", 0}},
        {{"E2", E}, {"rho2", RHO}, {"L2", 2}, {"v2", 0}},
        {{"E2", E}, {"rho2", RHO}, {"L2", 0.61803398874989485}},
        {{"E2", E}, {"rho2", RHO}, {"L2", 90}},
        {{"E2", E}, {"rho2", RHO}, {"L2", 0.011}},
        {{"E2", E * 1e6}, {"rho2", RHO * 1e6}, {"L2", 1.3}},
        {{"E2", E / 1e6}, {"rho2", RHO / 1e6}, {"L2", 77}},
        {{"E2", E / 100}, {"rho2", RHO / 100}, {"L2", 33}},
        {{"E2", E * 100}, {"rho2", RHO * 100}, {"L2", 0.0123}},
        {{"E2", E * 6}, {"rho2", RHO * 1.5}, {"L2", 2}}, /* one time of travel */
        {{"v1", 1000.001}, {"v2", 1000}},
        {{"gap", 1}},
        {{"gap", 100}, {"v1", 1e-3}, {"v2", 0}},
        {{"v1", 1e-70}, {"v2", -1e-72}, {"gap", 0}},
    };
    holds_with_each(the_kind(), set, sizeof set / sizeof *set);
}

/* Each broke the check once. */
static void holds_with_hostile_parameters(void)
{
    const struct setting set[][SETTINGS] = {
        /* A change that came within round-off of the end of the list, and was neither in it nor repeated. */
        {{"E1", 13020066.38841412},
         {"rho1", 2.594582187918093},
         {"L1", 0.001130212368091176},
         {"E2", 340.82793716768617},
         {"rho2", 4.055487108827843},
         {"L2", 2.3126145679016023e-06},
         {"gap", 4.7239215804397573e-08}},
        /* Changes that run on together and leave nothing of each other: no front. */
        {{"E1", 1}, {"rho1", 3}, {"L1", 0.7}, {"E2", 1}, {"rho2", 300}, {"L2", 0.07}, {"gap", 5e4}},
        /* Changes nearer to each other than a time so long after zero can tell. */
        {{"E1", 1}, {"rho1", 3}, {"L1", 0.7}, {"E2", 0.01}, {"rho2", 0.03}, {"L2", 1.4}, {"gap", 5e4}},
    };
    holds_with_each(the_kind(), set, sizeof set / sizeof *set);
}

static void refuses_rods_that_do_not_meet(void)
{
    unit_untrapped();
    const struct oracle_kind *kind = the_kind();
    refuses(kind, (const struct setting[SETTINGS]){{"v1", 1000.0000001}, {"v2", 1000}}, "too few digits are left");
    refuses(kind, (const struct setting[SETTINGS]){{"gap", 1e8}}, "choose a smaller gap");
    refuses(kind, (const struct setting[SETTINGS]){{"v1", -1}}, "or the rods never meet");
    refuses(kind, (const struct setting[SETTINGS]){{"v2", 3}}, "v1 = 2 m/s, but it must be greater than v2 = 3 m/s");
    refuses(kind, (const struct setting[SETTINGS]){{"gap", -1e-9}}, "gap = -1e-09 [m]");
    refuses(kind, (const struct setting[SETTINGS]){{"L2", 1e4}}, "neither may take more than 100 times as long");
    refuses(kind, (const struct setting[SETTINGS]){{"v1", 1e200}}, "range of double precision");
    refuses(kind, (const struct setting[SETTINGS]){{"rho1", 1e-320}}, "range of double precision");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"equal rods exchange their velocities", equal_rods_exchange_their_velocities},
        {"restitution is the ratio of lengths", restitution_is_the_ratio_of_lengths},
        {"bounces off a wall", bounces_off_a_wall},
        {"keeps momentum", keeps_momentum},
        {"agrees with a grid of characteristics", agrees_with_a_grid_of_characteristics},
        {"says nothing of the gap", says_nothing_of_the_gap},
        {"holds at the ends of its parameters", holds_at_the_ends_of_its_parameters},
        {"holds with hostile parameters", holds_with_hostile_parameters},
        {"refuses rods that do not meet", refuses_rods_that_do_not_meet},
    };
    return unit_main("oracles: rod impact", tests, sizeof tests / sizeof *tests);
}
