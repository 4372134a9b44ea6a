/* The impacts of plates against limits known in closed form, each other, and a finite-volume scheme of their equations
 * of state that must converge to them; at the ends of their parameters. */
#include "tests/unit/one_oracle.h"

static const char *const names[] = {"plate-impact-stiffened", "plate-impact-mie-grueneisen"};
enum { KINDS = sizeof names / sizeof *names };

/* Density over that at rest behind the shocks of an ideal gas at rest and without pressure: (gamma + 1)/(gamma - 1),
 * however fast. */
static void an_ideal_gas_is_compressed_to_its_limit(void)
{
    const struct oracle_kind *kind = kind_called(names[0]);
    static const double gammas[] = {1.1, 1.4, 5.0 / 3, 3};
    for (size_t i = 0; i < sizeof gammas / sizeof *gammas; i++) {
        double gamma = gammas[i], before = 0;
        for (int fast = 0; fast < 3; fast++) {
            double v0 = pow(1000, fast);
            struct oracle *oracle = create_with(
                kind, (const struct setting[SETTINGS]){
                          {"material.gamma", gamma}, {"material.p_inf", 0}, {"v0", v0}, {"material.rho", 2}});
            double ratio = figure_of(kind, oracle, "density") / 2;
            CU_ASSERT_TRUE(near(ratio, (gamma + 1) / (gamma - 1), 1e-13 * ratio));
            CU_ASSERT_TRUE(near(figure_of(kind, oracle, "pressure"), (gamma + 1) * v0 * v0, 1e-13 * gamma * v0 * v0));
            CU_ASSERT_TRUE(fast == 0 || near(ratio, before, 1e-13 * ratio));
            before = ratio;
            kind->destroy(oracle);
        }
    }
}

/* A stiff one approaches that limit as it gets faster, from below. */
static void a_strong_shock_forgets_the_stiffness(void)
{
    const struct oracle_kind *kind = kind_called(names[0]);
    double before = 1, limit = (4.4 + 1) / (4.4 - 1);
    for (int i = 0; i <= 8; i++) {
        struct oracle *oracle = create_with(
            kind, (const struct setting[SETTINGS]){
                      {"material.gamma", 4.4}, {"material.p_inf", 6e8}, {"material.rho", 1000}, {"v0", pow(10, i)}});
        double ratio = figure_of(kind, oracle, "density") / 1000;
        CU_ASSERT_TRUE(ratio > before && ratio < limit);
        CU_ASSERT_TRUE(i < 8 || near(ratio, limit, 1e-8));
        before = ratio;
        kind->destroy(oracle);
    }
}

/* p = rho c v0 (1 + O(v0/c)): ten times slower, ten times nearer; and sound is as fast ahead as behind. */
static void a_weak_shock_is_sound(void)
{
    for (size_t n = 0; n < KINDS; n++) {
        const struct oracle_kind *kind = kind_called(names[n]);
        double rho = 2785, c = n == 0 ? sqrt(2 * 39.53e9 / rho) : 5328, before = INFINITY;
        for (int i = 0; i < 5; i++) {
            double v0 = pow(10, 1 - i);
            struct oracle *oracle = create_with(kind, (const struct setting[SETTINGS]){{"v0", v0}});
            double off = figure_of(kind, oracle, "pressure") / (rho * c * v0) - 1;
            CU_ASSERT_TRUE(off > 0 && off < 2 * v0 / c && off < 0.11 * before);
            CU_ASSERT_TRUE(near(figure_of(kind, oracle, "sound speed"), c, 3 * v0));
            before = off;
            kind->destroy(oracle);
        }
    }
}

/* To second order in v0/c0 the stiffened gas has the linear Hugoniot with s = (gamma + 1)/4; in the third they part. */
static void the_two_agree_to_second_order(void)
{
    const struct oracle_kind *stiff = kind_called(names[0]), *linear = kind_called(names[1]);
    double p_inf = 2785 * 5328.0 * 5328 / 2, off[2];
    for (int i = 0; i < 2; i++) {
        double v0 = i == 0 ? 400 : 40;
        struct oracle *a = create_with(stiff, (const struct setting[SETTINGS]){{"v0", v0}, {"material.p_inf", p_inf}});
        struct oracle *b = create_with(linear, (const struct setting[SETTINGS]){{"v0", v0}, {"material.s", 0.75}});
        off[i] = figure_of(stiff, a, "shock speed") / figure_of(linear, b, "shock speed") - 1;
        stiff->destroy(a);
        linear->destroy(b);
    }
    CU_ASSERT_TRUE(off[0] > 1e-5 && near(off[0] / off[1], 100, 12));
}

/* Aluminium by hand: U = 5328 + 1.338 * 1000. */
static void agrees_with_a_calculation_by_hand(void)
{
    const struct oracle_kind *kind = kind_called(names[1]);
    struct oracle *oracle = create_with(kind, NULL);
    double t = 1e-4, extra[ORACLE_EXTRAS];
    const double X[3] = {0.5, 0, 0};
    CU_ASSERT_EQUAL(figure_of(kind, oracle, "shock speed"), 6666);
    CU_ASSERT_TRUE(near(figure_of(kind, oracle, "pressure"), 18.56481e9, 1e-4));
    struct oracle_state s = state_of(kind, oracle, 0.5, t);
    CU_ASSERT_TRUE(near(s.u[0], 1000 * 0.5 / 6666, 1e-15) && s.v[0] == 0);
    CU_ASSERT_TRUE(near(s.F[0], 5666.0 / 6666, 1e-15) && near(s.P[4], -18.56481e9 * 5666 / 6666, 1e-4));
    kind->extras(oracle, X, t, extra);
    CU_ASSERT_TRUE(near(extra[0], 2785 * 6666.0 / 5666, 1e-11) && extra[1] == 5e5);
    s = state_of(kind, oracle, 1.7, t);
    CU_ASSERT_TRUE(near(s.u[0], -0.1, 1e-16) && s.v[0] == -1000 && s.F[0] == 1 && s.P[0] == 0);
    kind->destroy(oracle);
}

/* Godunov's scheme for mass, momentum and energy per unit of X, with the impedances of the cells at their faces. */
enum { MOST_CELLS = 1600 };
struct cell {
    double v, F, E; /* E: per mass, kinetic and internal, above rest */
    double p, Z;
};

/* By density, as the sources print it. */
static double pressure(size_t n, double F, double e)
{
    double rho0 = 2785, rho = rho0 / F;
    if (n == 0) {
        return (2 - 1) * rho * e + 2 * 39.53e9 / rho0 * (rho - rho0);
    }
    double eta = 1 - rho0 / rho, c0 = 5328, curve = rho0 * c0 * c0 * eta / pow(1 - 1.338 * eta, 2);
    return curve + 2 * rho0 * (e - curve * eta / (2 * rho0));
}

static void update(size_t n, struct cell *cell)
{
    double e = cell->E - cell->v * cell->v / 2, rho0 = 2785, d = 1e-6;
    cell->p = pressure(n, cell->F, e);
    double stiffer = pressure(n, cell->F - d, e + cell->p / rho0 * d),
           softer = pressure(n, cell->F + d, e - cell->p / rho0 * d);
    cell->Z = sqrt(rho0 * (stiffer - softer) / (2 * d));
}

/* Mean errors of v over v0, of p and of e over those behind the shocks. */
static void march(size_t n, const struct oracle *oracle, int cells, double t, double error[3])
{
    static struct cell cell[MOST_CELLS];
    static double flux[MOST_CELLS + 1], motion[MOST_CELLS + 1];
    const struct oracle_kind *kind = kind_called(names[n]);
    double h = 2.0 / cells, rho0 = 2785, v0 = 1000;
    int steps = (int)ceil(t / (0.8 * h / 9000)); /* nothing is faster, in X */
    double dt = t / steps;
    for (int i = 0; i < cells; i++) {
        cell[i] = (struct cell){.v = i < cells / 2 ? v0 : -v0, .F = 1, .E = v0 * v0 / 2};
        update(n, &cell[i]);
    }
    for (int step = 0; step < steps; step++) {
        flux[0] = flux[cells] = 0;
        motion[0] = cell[0].v - cell[0].p / cell[0].Z;
        motion[cells] = cell[cells - 1].v + cell[cells - 1].p / cell[cells - 1].Z;
        for (int i = 1; i < cells; i++) {
            const struct cell *l = &cell[i - 1], *r = &cell[i];
            flux[i] = (r->Z * l->p + l->Z * r->p + l->Z * r->Z * (l->v - r->v)) / (l->Z + r->Z);
            motion[i] = (l->Z * l->v + r->Z * r->v + l->p - r->p) / (l->Z + r->Z);
        }
        for (int i = 0; i < cells; i++) {
            cell[i].v -= dt / (rho0 * h) * (flux[i + 1] - flux[i]);
            cell[i].F += dt / h * (motion[i + 1] - motion[i]);
            cell[i].E -= dt / (rho0 * h) * (flux[i + 1] * motion[i + 1] - flux[i] * motion[i]);
            update(n, &cell[i]);
        }
    }
    memset(error, 0, 3 * sizeof *error);
    for (int i = 0; i < cells; i++) {
        double extra[ORACLE_EXTRAS], X[3] = {(i + 0.5) * h, 0, 0}, e = cell[i].E - cell[i].v * cell[i].v / 2;
        struct oracle_state s = state_of(kind, oracle, X[0], t);
        kind->extras(oracle, X, t, extra);
        error[0] += fabs(cell[i].v - s.v[0]) / v0 / cells;
        error[1] += fabs(cell[i].p + s.P[0]) / figure_of(kind, oracle, "pressure") / cells;
        error[2] += fabs(e - extra[1]) / figure_of(kind, oracle, "internal energy") / cells;
    }
}

static void a_finite_volume_scheme_converges_to_it(void)
{
    printf("\n");
    for (size_t n = 0; n < KINDS; n++) {
        const struct oracle_kind *kind = kind_called(names[n]);
        struct oracle *oracle = create_with(kind, NULL);
        double error[3][3];
        for (int level = 0; level < 3; level++) {
            march(n, oracle, MOST_CELLS >> (2 - level), 1.2e-4, error[level]);
            printf("    %s: mean errors of v, p and e: %.3g, %.3g, %.3g\n", names[n], error[level][0], error[level][1],
                   error[level][2]);
        }
        for (int field = 0; field < 3; field++) {
            /* Shocks are as wide as so many cells: order one. */
            CU_ASSERT_TRUE(error[1][field] < 0.55 * error[0][field] && error[2][field] < 0.55 * error[1][field]);
            CU_ASSERT_TRUE(error[2][field] < 0.01);
        }
        kind->destroy(oracle);
    }
}

static void holds_at_the_ends_of_its_parameters(void)
{
    const struct setting stiffened[][SETTINGS] = {
        {{"v0", 1e-3}},
        {{"v0", 1e-9}},
        {{"v0", 1e-20}},
        {{"v0", 1e5}},
        {{"v0", 1e50}},
        {{"material.p_inf", 0}},
        {{"material.p_inf", 1}},
        {{"material.gamma", 1.0000001}},
        {{"material.gamma", 1000}},
        {{"material.rho", 1e-80}},
        {{"L", 1e-50}},
    };
    const struct setting linear[][SETTINGS] = {
        {{"v0", 1e-3}},
        {{"v0", 1e-9}},
        {{"v0", 1e4}},
        {{"v0", 1e6}},
        {{"material.s", 0}},
        {{"material.s", 10}, {"material.Gamma0", 0}},
        {{"material.Gamma0", 13}}, /* not far from where the curve ends */
        {{"material.c0", 4}},      /* close to the pole of the curve */
        {{"material.rho", 1e-80}},
        {{"L", 1e-50}},
    };
    holds_with_each(kind_called(names[0]), stiffened, sizeof stiffened / sizeof *stiffened);
    holds_with_each(kind_called(names[1]), linear, sizeof linear / sizeof *linear);
}

/* Whatever is refused for its compression, what the message says would do is admitted, and proves itself. */
static void says_what_would_do(void)
{
    static const struct {
        int kind;
        struct setting set[SETTINGS];
    } wrong[] = {
        {1, {{"v0", 2e4}, {"material.s", 0}, {"material.Gamma0", 1}}},
        {1, {{"material.Gamma0", 20}}},
        {1, {{"material.s", 90}, {"v0", 1e4}}}, /* 1 - s eta cancels */
        {1, {{"material.c0", 3}}},              /* likewise */
        {0, {{"material.gamma", 1.0001}, {"v0", 1e7}}},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        const struct oracle_kind *kind = kind_called(names[wrong[i].kind]);
        char why[ORACLE_WHY] = "";
        double v0 = 0;
        CU_ASSERT_PTR_NULL_FATAL(try_with(kind, wrong[i].set, why));
        const char *advice = strrchr(why, ';');
        CU_ASSERT_FATAL(advice != NULL && sscanf(advice, "; v0 = %lf m/s would do", &v0) == 1);
        struct setting mended[1][SETTINGS] = {{{"v0", v0}}};
        for (size_t j = 0, next = 1; j < SETTINGS && wrong[i].set[j].name != NULL; j++) {
            if (strcmp(wrong[i].set[j].name, "v0") != 0) {
                mended[0][next++] = wrong[i].set[j];
            }
        }
        holds_with_each(kind, (const struct setting(*)[SETTINGS])mended, 1);
    }
    refuses(kind_called(names[0]), (const struct setting[SETTINGS]){{"material.gamma", 1.0001}, {"material.p_inf", 0}},
            "material.gamma = 1.4 would do");
}

static void refuses_what_no_shock_reaches(void)
{
    unit_untrapped();
    const struct oracle_kind *linear = kind_called(names[1]), *stiff = kind_called(names[0]);
    refuses(linear, (const struct setting[SETTINGS]){{"material.Gamma0", 20}}, "must be less than 0.1");
    refuses(linear, (const struct setting[SETTINGS]){{"v0", 2e4}, {"material.s", 0}, {"material.Gamma0", 1}},
            "where the equation of state ends");
    refuses(linear, (const struct setting[SETTINGS]){{"material.s", -1}}, "material.s = -1 [-]");
    refuses(linear, (const struct setting[SETTINGS]){{"material.Gamma0", 101}, {"v0", 1}}, "<= 100");
    refuses(stiff, (const struct setting[SETTINGS]){{"material.gamma", 1}}, "> 1 (ratio of specific heats)");
    refuses(stiff, (const struct setting[SETTINGS]){{"v0", 1e200}}, "range of double precision");
    refuses(stiff, (const struct setting[SETTINGS]){{"v0", -1}}, "v0 = -1 [m/s]");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"an ideal gas is compressed to its limit", an_ideal_gas_is_compressed_to_its_limit},
        {"a strong shock forgets the stiffness", a_strong_shock_forgets_the_stiffness},
        {"a weak shock is sound", a_weak_shock_is_sound},
        {"the two agree to second order", the_two_agree_to_second_order},
        {"agrees with a calculation by hand", agrees_with_a_calculation_by_hand},
        {"a finite-volume scheme converges to it", a_finite_volume_scheme_converges_to_it},
        {"holds at the ends of its parameters", holds_at_the_ends_of_its_parameters},
        {"refuses what no shock reaches", refuses_what_no_shock_reaches},
        {"says what would do", says_what_would_do},
    };
    return unit_main("oracles: plate impact", tests, sizeof tests / sizeof *tests);
}
