/* The cantilever as a body against other methods: finite elements, beam theory where it is exact, the theory of corner
 * singularities; its modes against one another; and what its self-check and its creation refuse. */
#include "oracles/beam.h"
#include "oracles/cantilever.h"
#include "tests/unit/one_oracle.h"
#include "tests/unit/plane_elements.h"

#include <gsl/gsl_integration.h>

static const double E = 1998447.2049689441, NU = 0.39751552795031056;

static const struct oracle_kind *the_kind(void)
{
    return kind_called("cantilever");
}

static const struct oracle_kind *in_plane_stress(void)
{
    return kind_called("cantilever-plane-stress");
}

/* Half as long as the source's, for what any length would do for, and takes less time. */
static const struct setting shorter[SETTINGS] = {{"L", 0.1}};

/* Frequencies of finite elements are upper bounds that fall towards the oracle's, which their extrapolation meets. */
static void agrees_with_elements_in(const struct oracle_kind *kind, double lambda)
{
    struct oracle *o = create_with(kind, NULL);
    struct plane_body body = {0.2, 0.02, lambda, 7.15e5, 1000};
    double w[3];
    for (int i = 0; i < 3; i++) {
        w[i] = plane_frequency(&body, 3 << i);
        CU_ASSERT_TRUE(w[i] > o->frequency && (i == 0 || w[i] < w[i - 1]));
    }
    double before = w[0] - w[1], after = w[1] - w[2];
    CU_ASSERT_TRUE(before > 10 * after);
    CU_ASSERT_DOUBLE_EQUAL((w[2] - after * after / (before - after)) / o->frequency, 1, 1e-6);
    kind->destroy(o);
}

static void agrees_with_finite_elements(void)
{
    agrees_with_elements_in(the_kind(), 3.25e6 - 2 * 7.15e5 / 3);
    agrees_with_elements_in(in_plane_stress(), E * NU / (1 - NU * NU));
}

/* Without Poisson's effect the clamp bends nothing but what a beam's does: Timoshenko's period is right but for the
 * cube of the slenderness, although none of his equations is solved here. */
static void meets_timoshenko_without_poisson_effect(void)
{
    double distance[2];
    for (int i = 0; i < 2; i++) {
        const struct setting set[SETTINGS] = {{"material.nu", 0}, {"L", i == 0 ? 0.2 : 0.4}};
        struct oracle *o = create_with(the_kind(), set);
        distance[i] = figure_of(the_kind(), o, "error of Timoshenko theory");
        the_kind()->destroy(o);
    }
    CU_ASSERT_TRUE(distance[0] > 0 && distance[0] < 1.2e-5);
    CU_ASSERT_DOUBLE_EQUAL(distance[0] / distance[1], 8, 0.1);
}

/* M. L. Williams, J. Appl. Mech. 19 (1952) 526: displacements go as r^a at a right-angled corner between a clamped and
 * a free side, sin^2(a pi/2) = ((k + 1)^2 - 4 a^2) / (4 k), k = 3 - 4 nu. */
static double corner_exponent(double nu)
{
    double k = 3 - 4 * nu, lower = 0.5, upper = 0.999;
    for (int i = 0; i < 60; i++) {
        double a = (lower + upper) / 2, s = sin(a * 1.5707963267948966);
        *(s * s < ((k + 1) * (k + 1) - 4 * a * a) / (4 * k) ? &lower : &upper) = a;
    }
    return lower;
}

/* Every layer makes the corner element smaller by the grading, and the error of the frequency by its power 2 a. */
static void converges_as_the_corner_singularity_says(void)
{
    static const double nu[] = {0.3, 0.39751552795031056, 0.45};
    for (size_t n = 0; n < sizeof nu / sizeof *nu; n++) {
        struct ritz_problem problem = {.length = 20, .lambda = 2 * nu[n] / (1 - 2 * nu[n]), .mode = 1};
        double w[3];
        for (int i = 0; i < 3; i++) {
            struct ritz_mesh mesh = {
                .layers = i + 1, .tip_layers = 1, .grading = 0.2, .growth = 2, .corner = 8, .middle = 12};
            struct ritz_mode mode;
            char why[ORACLE_WHY] = "";
            CU_ASSERT_TRUE_FATAL(ritz_solve(&problem, &mesh, &mode, why));
            w[i] = mode.frequency;
            ritz_free(&mode);
        }
        CU_ASSERT_TRUE(w[0] > w[1] && w[1] > w[2]);
        double power = log((w[1] - w[2]) / (w[0] - w[1])) / log(0.2);
        CU_ASSERT_DOUBLE_EQUAL(power, 2 * corner_exponent(nu[n]), 0.01);
    }
}

/* As many digits as it says: other elements, extrapolated on their own, give the same. */
static void is_as_certain_as_it_says(void)
{
    struct oracle *o = create_with(the_kind(), NULL);
    struct ritz_problem problem = {.length = 20, .lambda = o->lambda / o->mu, .mode = 1};
    struct ritz_mesh mesh = {.layers = 5, .tip_layers = 3, .grading = 0.18, .growth = 1.7, .corner = 6, .middle = 11};
    struct ritz_limit limit;
    char why[ORACLE_WHY] = "";
    CU_ASSERT_TRUE_FATAL(ritz_converge(&problem, &mesh, &limit, why));
    double distance = fabs(limit.frequency / o->solution.frequency - 1);
    CU_ASSERT_TRUE(o->solution.uncertainty < 1e-8);
    CU_ASSERT_TRUE(distance < o->solution.uncertainty && distance < 1e-9);
    CU_ASSERT_DOUBLE_EQUAL(figure_of(the_kind(), o, "period"), 0.2553288117, 1e-9);
    CU_ASSERT_DOUBLE_EQUAL(figure_of(the_kind(), o, "thin-plate period"), 0.254129, 5e-7);
    ritz_free(&limit.mode);
    the_kind()->destroy(o);
}

/* A body in plane stress tends to the beam in plane stress, from above: the clamp also keeps it from getting thinner.
 */
static void tends_to_the_beam_in_plane_stress(void)
{
    const struct oracle_kind *kind = in_plane_stress();
    double error[2];
    for (int i = 0; i < 2; i++) {
        const struct setting set[SETTINGS] = {{"material.nu", 0.3}, {"L", i == 0 ? 0.4 : 0.8}};
        struct oracle *o = create_with(kind, set);
        error[i] = figure_of(kind, o, "error of Timoshenko theory");
        kind->destroy(o);
    }
    CU_ASSERT_TRUE(error[0] > 0 && error[0] < 6e-4);
    CU_ASSERT_DOUBLE_EQUAL(error[0] / error[1], 2, 0.1); /* what the clamp adds goes with H / L */
}

/* Nothing holds the plate across: it gets thinner where it is stretched, and bears no stress there. */
static void gets_thinner_in_plane_stress(void)
{
    const struct oracle_kind *kind = in_plane_stress();
    struct oracle *o = create_with(kind, shorter);
    for (int i = 1; i < 8; i++) {
        double X[3] = {0.1 * i / 8, 0.009, 0};
        struct oracle_state s;
        kind->state(o, X, 0.01, &s);
        CU_ASSERT_TRUE(s.P[0] < 0 && s.P[8] == 0 && s.F[8] > 1); /* bent upwards: pressed above */
        CU_ASSERT_DOUBLE_EQUAL((s.F[8] - 1) * E / (-NU * (s.P[0] + s.P[4])), 1, 1e-10);
    }
    kind->destroy(o);
}

/* Integral of p of one mode times v of another, by ten-point Gauss rules in the elements of the first. */
static double overlap(const struct oracle *a, const struct oracle *b)
{
    const struct axis *x = &a->solution.mode.x, *y = &a->solution.mode.y;
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(14);
    double half = a->given.height / 2, sum = 0;
    for (int cell = 0; cell < x->elements * y->elements; cell++) {
        for (size_t n = 0; n < 14 * 14; n++) {
            int ex = cell / y->elements, ey = cell % y->elements;
            double X[3] = {0}, wx, wy;
            struct oracle_state s, t;
            (void)gsl_integration_glfixed_point(x->node[ex], x->node[ex + 1], n / 14, &X[0], &wx, rule);
            (void)gsl_integration_glfixed_point(y->node[ey], y->node[ey + 1], n % 14, &X[1], &wy, rule);
            X[0] *= half;
            X[1] *= half;
            the_kind()->state(a, X, 0, &s);
            the_kind()->state(b, X, 0, &t);
            sum += 2 * half * half * wx * wy * (s.p[0] * t.v[0] + s.p[1] * t.v[1]);
        }
    }
    gsl_integration_glfixed_table_free(rule);
    return sum;
}

/* Mode n crosses the middle line n - 1 times, further than a height from the clamp, where Poisson's effect pushes the
 * line aside; and it is orthogonal to all others. */
static void modes_are_what_their_numbers_say(void)
{
    struct oracle *mode[3];
    for (int n = 0; n < 3; n++) {
        int crossings = 0;
        double last = 0, energy[2];
        mode[n] = create_with(the_kind(), (const struct setting[SETTINGS]){{"L", 0.1}, {"mode", n + 1}});
        for (int i = 20; i <= 100; i++) {
            struct oracle_state s;
            double X[3] = {0.1 * i / 100, 0, 0};
            the_kind()->state(mode[n], X, 0, &s);
            crossings += s.v[1] * last < 0;
            last = s.v[1];
        }
        CU_ASSERT_EQUAL(crossings, n);
        CU_ASSERT_TRUE(n == 0 || mode[n]->frequency > mode[n - 1]->frequency);
        the_kind()->energy(mode[n], 0, &energy[0], &energy[1]);
        CU_ASSERT_DOUBLE_EQUAL(overlap(mode[n], mode[n]) / (2 * energy[0]), 1, 1e-10);
        for (int m = 0; m < n; m++) {
            CU_ASSERT_DOUBLE_EQUAL(overlap(mode[n], mode[m]) / (2 * energy[0]), 0, 2e-7);
        }
    }
    for (int n = 0; n < 3; n++) {
        the_kind()->destroy(mode[n]);
    }
}

/* Fields of another problem, or with another clock, under the check of the true one. */
static struct {
    const struct oracle *other;
    double clock;
} now;

static void other_state(const struct oracle *oracle, const double X[3], double t, struct oracle_state *state)
{
    the_kind()->state(now.other != NULL ? now.other : oracle, X, t * (1 + now.clock), state);
    for (int i = 0; i < 3; i++) {
        state->v[i] *= 1 + now.clock;
        state->p[i] *= 1 + now.clock;
    }
}

static bool caught(const struct oracle *oracle)
{
    struct oracle_kind spoiled = *the_kind();
    struct oracle_check line[ORACLE_LAWS];
    size_t count = 0;
    spoiled.state = other_state;
    return !oracle_self_check(&spoiled, oracle, line, &count);
}

static void another_problem_is_caught(void)
{
    struct oracle *o = create_with(the_kind(), shorter);
    now.other = NULL;
    now.clock = 0;
    CU_ASSERT_FALSE(caught(o)); /* going through the copy is no fault */
    now.clock = 1e-6;
    CU_ASSERT_TRUE(caught(o));
    now.clock = 0;
    for (const struct oracle_parameter *p = the_kind()->parameter; p->name != NULL; p++) {
        double typical = strcmp(p->name, "L") == 0 ? 0.1 : p->typical;
        double wrong = strcmp(p->name, "mode") == 0 ? 2 : typical * (1 + 1e-5);
        const struct setting set[SETTINGS] = {{p->name, wrong}, {typical == 0.1 ? NULL : "L", 0.1}};
        struct oracle *other = create_with(the_kind(), set);
        now.other = other;
        CU_ASSERT_TRUE(caught(o));
        the_kind()->destroy(other);
    }
    the_kind()->destroy(o);
}

static void holds_at_the_ends_of_its_parameters(void)
{
    const struct setting set[][SETTINGS] = {
        {{"L", 0.08}, {"material.nu", 0.49}},
        {{"L", 0.08}, {"material.nu", 0.49}, {"mode", 4}},
        {{"L", 1}, {"material.nu", 0.49}},
        {{"v_tip", 0}, {"material.nu", -0.9}},
        {{"L", 2e5}, {"H", 5e4}, {"v_tip", 1e-30}, {"material.E", 1e40}, {"material.rho", 1e-10}},
        {{"L", 2e-7}, {"H", 5e-8}, {"v_tip", -1e10}, {"material.E", 1e-9}, {"material.nu", 0}, {"material.rho", 1e9}},
    };
    holds_with_each(the_kind(), set, sizeof set / sizeof *set);
    holds_with_each(in_plane_stress(), set, sizeof set / sizeof *set);
}

static void refuses_what_it_cannot_answer(void)
{
    unit_untrapped();
    static const struct {
        struct setting set[SETTINGS];
        const char *says;
    } wrong[] = {{{{"L", 0.07}}, "4 to 50 times; L = 0.2 would do"},
                 {{{"L", 1.1}}, "55 times"},
                 {{{"H", 1e-300}}, "4 to 50 times"},
                 {{{"mode", 1.5}}, "a whole number"},
                 {{{"mode", 5}}, "<= 4"},
                 {{{"material.nu", 0.5}}, "<= 0.49"},
                 {{{"L", 0.1}, {"v_tip", 1e200}}, "range of double precision"},
                 {{{"L", 0.1}, {"material.E", 1e307}}, "range of double precision"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        refuses(the_kind(), wrong[i].set, wrong[i].says);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"agrees with finite elements", agrees_with_finite_elements},
        {"meets Timoshenko without Poisson's effect", meets_timoshenko_without_poisson_effect},
        {"converges as the corner singularity says", converges_as_the_corner_singularity_says},
        {"is as certain as it says", is_as_certain_as_it_says},
        {"tends to the beam in plane stress", tends_to_the_beam_in_plane_stress},
        {"gets thinner in plane stress", gets_thinner_in_plane_stress},
        {"modes are what their numbers say", modes_are_what_their_numbers_say},
        {"another problem is caught", another_problem_is_caught},
        {"holds at the ends of its parameters", holds_at_the_ends_of_its_parameters},
        {"refuses what it cannot answer", refuses_what_it_cannot_answer},
    };
    return unit_main("oracles: cantilever", tests, sizeof tests / sizeof *tests);
}
