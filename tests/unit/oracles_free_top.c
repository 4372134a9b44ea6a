/* The free top against values from elsewhere and another method, where its motion is known without elliptic functions,
 * and what it refuses. */
#include "tests/unit/one_oracle.h"

#include <float.h>

static const double PI = 3.14159265358979323846;

static const struct oracle_kind *the_kind(void)
{
    return kind_called("free-top");
}

struct expected {
    struct setting set[SETTINGS];
    double t, u[3], v[3], F[9];
};

/* Euler's equations and those of the attitude by Taylor series, to 20 digits, at X = (1.2, -0.8, 0.4) m. */
static const struct expected expected[] = {
    {.t = 9, /* within a period */
     .u = {-1.849311659130066, 1.72506119045891238, -1.38115042843821906},
     .v = {-1.28346565461974815, 0.00244896753635825613, 0.851688624131097602},
     .F = {-0.53653628810244523, -0.371915361646813461, -0.757501006811456221, 0.0259907163352988077,
           -0.904500621647810155, 0.425679583845764225, -0.843476907931466681, 0.208704550045860136,
           0.494963752790572677}},
    {.set = {{"spin_x", -0.3}, {"spin_z", 0.1}}, /* about the axis of the smallest moment, more than a period */
     .t = 30,
     .u = {-2.61948396846766322, 1.20991628211810303, -0.161182276793019686},
     .v = {0.186309284090425659, -0.206869593704593274, 1.46246372332682734},
     .F = {-0.949671419072466825, 0.273406923118602569, -0.152881817714552432, -0.255901058048796414,
           -0.958620310192480771, -0.124746740943314733, -0.180662238130699637, -0.0793457955867259077,
           0.980339431236097881}},
};

static void agrees_with_multiple_precision(void)
{
    static const double X[3] = {1.2, -0.8, 0.4};
    const double bound = 3e-13;
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        const struct expected *e = &expected[i];
        struct oracle *o = create_with(the_kind(), e->set);
        struct oracle_state s;
        the_kind()->state(o, X, e->t, &s);
        for (int k = 0; k < 3; k++) {
            CU_ASSERT_TRUE(near(s.u[k], e->u[k], bound));
            CU_ASSERT_TRUE(near(s.v[k], e->v[k], bound));
            CU_ASSERT_TRUE(near(s.p[k], 1000 * e->v[k], 1000 * bound));
        }
        for (int k = 0; k < 9; k++) {
            CU_ASSERT_TRUE(near(s.F[k], e->F[k], bound));
            CU_ASSERT_EQUAL(s.P[k], 0);
        }
        the_kind()->destroy(o);
    }
}

/* About the axes of the largest and the smallest moment it turns steadily, either way round. */
static void turns_steadily_about_two_axes(void)
{
    for (int axis = 0; axis <= 2; axis += 2) {
        for (int sign = -1; sign <= 1; sign += 2) {
            const struct setting set[SETTINGS] = {
                {"spin_x", axis == 0 ? 2 * sign : 0}, {"spin_y", 0}, {"spin_z", axis == 2 ? 2 * sign : 0}};
            struct oracle *o = create_with(the_kind(), set);
            struct oracle_state s;
            int next = (axis + 1) % 3, last = (axis + 2) % 3;
            double t = 7.3, angle = 2 * sign * t, X[3] = {0, 0, 0}, turned[3] = {0, 0, 0};
            X[axis] = turned[axis] = 0.3;
            X[next] = 0.5;
            turned[next] = 0.5 * cos(angle);
            turned[last] = 0.5 * sin(angle);
            the_kind()->state(o, X, t, &s);
            for (int k = 0; k < 3; k++) {
                CU_ASSERT_TRUE(near(X[k] + s.u[k], turned[k], 1e-13));
            }
            the_kind()->destroy(o);
        }
    }
}

/* Next to such an axis the spin circles about it, at the rate that linear theory gives. */
static void small_nutations_are_linear(void)
{
    static const double I[3] = {5, 10, 13}; /* times 12 over mass */
    struct oracle *z =
        create_with(the_kind(), (const struct setting[SETTINGS]){{"spin_x", 0}, {"spin_y", 1e-6}, {"spin_z", 1}});
    struct oracle *x =
        create_with(the_kind(), (const struct setting[SETTINGS]){{"spin_x", 1}, {"spin_y", 1e-6}, {"spin_z", 0}});
    double about_z = 2 * PI / sqrt((I[2] - I[0]) * (I[2] - I[1]) / (I[0] * I[1]));
    double about_x = 2 * PI / sqrt((I[1] - I[0]) * (I[2] - I[0]) / (I[1] * I[2]));
    CU_ASSERT_TRUE(near(figure_of(the_kind(), z, "period"), about_z, 1e-10));
    CU_ASSERT_TRUE(near(figure_of(the_kind(), x, "period"), about_x, 1e-10));
    the_kind()->destroy(z);
    the_kind()->destroy(x);
}

/* Half a period after it spins about the middle axis one way it does so the other way: it has turned over. */
static void turns_over(void)
{
    struct oracle *o =
        create_with(the_kind(), (const struct setting[SETTINGS]){{"spin_x", 0}, {"spin_y", 1}, {"spin_z", 0.1}});
    double half = figure_of(the_kind(), o, "period") / 2;
    static const double X[3] = {1, 0, 0};
    struct oracle_state first, then;
    the_kind()->state(o, X, 0, &first);
    the_kind()->state(o, X, half, &then);
    double seen[3] = {0, 0, 0}, began[3] = {0, 0, 0}; /* velocity as the body sees it */
    for (int k = 0; k < 9; k++) {
        began[k % 3] += first.F[k] * first.v[k / 3];
        seen[k % 3] += then.F[k] * then.v[k / 3];
    }
    CU_ASSERT_TRUE(near(began[2], -1, 1e-13) && near(seen[2], 1, 1e-12));
    CU_ASSERT_TRUE(near(seen[1], began[1], 1e-12));
    the_kind()->destroy(o);
}

/* Sides and spins of any size and either sign: all prove themselves. */
static void holds_at_the_ends_of_its_parameters(void)
{
    static const struct setting end[][SETTINGS] = {
        {{"spin_y", -1}},
        {{"spin_x", -0.1}, {"spin_z", -0.2}},
        {{"spin_x", 0}, {"spin_y", 1}, {"spin_z", 0.03}}, /* near the separatrix */
        {{"spin_x", 0.04}, {"spin_y", -1}, {"spin_z", 0}},
        {{"A", 3e-6}, {"B", 2e-6}, {"C", 1e-6}, {"spin_x", 1e5}},
        {{"A", 3e6}, {"B", 2e6}, {"C", 1e6}, {"material.rho", 1e-3}},
        {{"A", 1.45}, {"B", 1.2}},
        {{"C", 1e-3}, {"spin_z", 3}},
        {{"A", 30}, {"spin_x", 2}},
        {{"A", 60}, {"spin_x", 2}},
        {{"A", 60}, {"C", 0.02}, {"spin_x", -0.8}},
    };
    holds_with_each(the_kind(), end, sizeof end / sizeof *end);
}

static void refuses_what_it_cannot_answer(void)
{
    unit_untrapped();
    static const struct {
        struct setting set[SETTINGS];
        const char *says;
    } wrong[] = {{{{"A", 2}}, "A = 2 m and B = 2 m, but each side must be at least 1.2 times the next; A = 3 would do"},
                 {{{"C", 1.9}}, "B = 2 m and C = 1.9 m"},
                 {{{"A", 61}}, "A = 61 m and B = 2 m, but A must be at most 30 times as long; A = 3 would do"},
                 {{{"C", 9e-4}}, "C = 0.0009 m, but A must be at most 3000 times as long; C = 1.33333 would do"},
                 {{{"spin_x", 0}, {"spin_y", 0}, {"spin_z", 0}}, "the body must spin; spin_z = 1 would do"},
                 {{{"spin_x", 0}, {"spin_z", 0}}, "is a spin about the middle axis"},
                 {{{"spin_x", 0}, {"spin_z", 1e-3}}, "is a spin about the middle axis"},
                 {{{"A", 1e200}, {"B", 1e199}, {"C", 1e198}}, "range of double precision"},
                 {{{"material.rho", 5e-324}}, "range of double precision"},
                 {{{"material.rho", 0}}, "> 0"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        refuses(the_kind(), wrong[i].set, wrong[i].says);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"agrees with multiple precision", agrees_with_multiple_precision},
        {"turns steadily about two axes", turns_steadily_about_two_axes},
        {"small nutations are linear", small_nutations_are_linear},
        {"turns over", turns_over},
        {"holds at the ends of its parameters", holds_at_the_ends_of_its_parameters},
        {"refuses what it cannot answer", refuses_what_it_cannot_answer},
    };
    return unit_main("oracles: free top", tests, sizeof tests / sizeof *tests);
}
