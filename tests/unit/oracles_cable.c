/* The elastic cable against values that follow from its waves by hand, its modal series summed up, and a grid of
 * characteristics; at the ends of its parameters. */
#include "tests/unit/bar_oracles.h"

static const double PI = 3.14159265358979323846;

static const struct oracle_kind *the_kind(void)
{
    return kind_called("cable");
}

/* c = 5000 m/s, L = 10 m, the outer 2.5 m start with 5 m/s; rho c = 4e7 kg/(m^2 s). */
static void has_the_values_found_by_hand(void)
{
    const struct oracle_kind *kind = the_kind();
    struct oracle *oracle = create_with(kind, NULL);
    CU_ASSERT_EQUAL(figure_of(kind, oracle, "wave speed"), 5000);
    CU_ASSERT_EQUAL(figure_of(kind, oracle, "period"), 8e-3);
    CU_ASSERT_EQUAL(figure_of(kind, oracle, "pulse stress"), 1e8);
    /* The free end goes on until the front of the rest arrives, has then moved by U0 moving / c, and waits for the echo
     * of the fixed end, which brings it back beyond where it was, just as far. */
    CU_ASSERT_TRUE(near(state_of(kind, oracle, 10, 4e-4).u[0], 2e-3, 1e-17));
    CU_ASSERT_TRUE(near(state_of(kind, oracle, 10, 2e-3).u[0], 2.5e-3, 1e-17));
    CU_ASSERT_TRUE(near(state_of(kind, oracle, 10, 4e-3).u[0], 0, 1e-17));
    CU_ASSERT_TRUE(near(state_of(kind, oracle, 10, 6e-3).u[0], -2.5e-3, 1e-17));
    CU_ASSERT_TRUE(near(state_of(kind, oracle, 10, 4e-4).v[0], 5, 0));
    CU_ASSERT_TRUE(near(state_of(kind, oracle, 10, 1e-3).v[0], 0, 0));
    CU_ASSERT_TRUE(near(state_of(kind, oracle, 10, 4e-3).v[0], -5, 0));
    /* The pulse, 5 m long, pulls the fixed end with twice its stress while it is reflected. */
    CU_ASSERT_TRUE(near(state_of(kind, oracle, 0, 1.4e-3).P[0], 0, 0));
    CU_ASSERT_TRUE(near(state_of(kind, oracle, 0, 2e-3).P[0], 2e8, 1e-6));
    CU_ASSERT_TRUE(near(state_of(kind, oracle, 5, 1e-3).P[0], 1e8, 1e-6));
    CU_ASSERT_TRUE(near(state_of(kind, oracle, 5, 1e-3).v[0], 2.5, 0));
    CU_ASSERT_TRUE(near(state_of(kind, oracle, 0, 2.6e-3).P[0], 0, 0));
    kind->destroy(oracle);
}

static void starts_again_after_a_period(void)
{
    const struct oracle_kind *kind = the_kind();
    struct oracle *oracle = create_with(kind, NULL);
    for (int i = 0; i < 40; i++) {
        double X = 0.13 + 0.25 * i, t = 1.7e-3 + 1e-5 * i;
        struct oracle_state first = state_of(kind, oracle, X, t), later = state_of(kind, oracle, X, t + 1e6 * 8e-3);
        CU_ASSERT_TRUE(near(later.u[0], first.u[0], 1e-11) && near(later.v[0], first.v[0], 0));
        CU_ASSERT_TRUE(near(later.P[0], first.P[0], 0));
    }
    kind->destroy(oracle);
}

/* What the series lacks after N modes is less than the sum of 2 U0 / (k^2 L c) over the rest, below
 * 2 U0 L / (pi^2 c) / (N - 1). */
static void is_the_sum_of_its_modes(void)
{
    const struct oracle_kind *kind = the_kind();
    struct oracle *oracle = create_with(kind, NULL);
    enum { N = 20000 };
    double L = 10, U0 = 5, c = 5000, bound = 2 * U0 * L / (PI * PI * c) / (N - 1);
    for (int i = 0; i < 24; i++) {
        double X = 0.41 * (i + 1), t = 4.1e-4 * (i + 1), u = 0;
        for (int n = 1; n <= N; n++) {
            double k = (n - 0.5) * PI / L, w = k * c;
            u += 2 * U0 * cos(k * 7.5) / (k * L * w) * sin(k * X) * sin(w * t);
        }
        CU_ASSERT_TRUE(near(state_of(kind, oracle, X, t).u[0], u, bound));
    }
    kind->destroy(oracle);
}

static void agrees_with_a_grid_of_characteristics(void)
{
    const struct oracle_kind *kind = the_kind();
    struct oracle *oracle = create_with(kind, NULL);
    struct grid_bar bar = {.cells = 80, .Z = 4e7};
    double worst = 0;
    fill(&bar, 0);
    for (int i = 60; i < 80; i++) {
        bar.right[i] = bar.left[i] = 5;
    }
    for (int step = 1; step <= 4000; step++) {
        shift(&bar, -bar.left[0], bar.right[79]);
        if (step % 37 == 0) {
            worst = fmax(worst, compare_grid(kind, oracle, &bar, 0, 10, step * (10.0 / 80 / 5000)));
        }
    }
    CU_ASSERT_TRUE(near(worst, 0, 0));
    kind->destroy(oracle);
}

static void lists_four_fronts_at_most(void)
{
    const struct oracle_kind *kind = the_kind();
    struct oracle *oracle = create_with(kind, NULL);
    struct oracle_front front[ORACLE_FRONTS];
    /* After 1 m: one runs to the free end, one to the fixed one. */
    CU_ASSERT_EQUAL_FATAL(kind->fronts(oracle, 2e-4, front), 2);
    CU_ASSERT_TRUE(near(front[0].X, 6.5, 1e-12) && front[0].speed == -5000 && front[0].jump == 2.5);
    CU_ASSERT_TRUE(near(front[1].X, 8.5, 1e-12) && front[1].speed == 5000 && front[1].jump == 2.5);
    /* The second one has come back from the free end. */
    CU_ASSERT_EQUAL_FATAL(kind->fronts(oracle, 1e-3, front), 2);
    CU_ASSERT_TRUE(near(front[1].X, 7.5, 1e-12) && front[1].speed == -5000 && front[1].jump == -2.5);
    kind->destroy(oracle);
    oracle = create_with(kind, (const struct setting[SETTINGS]){{"moving", 10}});
    CU_ASSERT_EQUAL_FATAL(kind->fronts(oracle, 1e-3, front), 1);
    CU_ASSERT_TRUE(near(front[0].X, 5, 1e-12) && front[0].jump == 5);
    kind->destroy(oracle);
    oracle = create_with(kind, (const struct setting[SETTINGS]){{"U0", 0}});
    CU_ASSERT_EQUAL(kind->fronts(oracle, 1e-3, front), 0);
    kind->destroy(oracle);
}

static void holds_at_the_ends_of_its_parameters(void)
{
    const struct setting set[][SETTINGS] = {
        {{"moving", 10}},
        {{"moving", 9.9999999}},
        {{"moving", 0.01}},
        {{"moving", 10.0 / 3}},
        {{"moving", 5}},
        {{"U0", 0}},
        {{"U0", -1e-9}},
        {{"U0", 1e90}},
        {{"L", 1e-6}, {"moving", 3.1e-7}},
        {{"material.E", 1e-30}, {"material.rho", 1e30}},
        {{"material.E", 1e30}, {"material.rho", 1e-30}},
    };
    holds_with_each(the_kind(), set, sizeof set / sizeof *set);
}

static void refuses_parts_that_do_not_fit(void)
{
    unit_untrapped();
    const struct oracle_kind *kind = the_kind();
    refuses(kind, (const struct setting[SETTINGS]){{"moving", 10.1}},
            "moving = 10.1 [m], but it must be at most L = 10");
    refuses(kind, (const struct setting[SETTINGS]){{"moving", 1e-3}}, "at least a thousandth of it");
    refuses(kind, (const struct setting[SETTINGS]){{"U0", 1e200}}, "range of double precision");
    refuses(kind, (const struct setting[SETTINGS]){{"U0", 1e-200}}, "range of double precision");
    refuses(kind, (const struct setting[SETTINGS]){{"material.rho", 1e-320}}, "range of double precision");
    refuses(kind, (const struct setting[SETTINGS]){{"material.E", 5e-324}, {"material.rho", 1}}, "double precision");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"has the values found by hand", has_the_values_found_by_hand},
        {"starts again after a period", starts_again_after_a_period},
        {"is the sum of its modes", is_the_sum_of_its_modes},
        {"agrees with a grid of characteristics", agrees_with_a_grid_of_characteristics},
        {"lists four fronts at most", lists_four_fronts_at_most},
        {"holds at the ends of its parameters", holds_at_the_ends_of_its_parameters},
        {"refuses parts that do not fit", refuses_parts_that_do_not_fit},
    };
    return unit_main("oracles: cable", tests, sizeof tests / sizeof *tests);
}
