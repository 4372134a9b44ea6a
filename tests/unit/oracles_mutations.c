/* Every formula of the swinging cube, spoiled on purpose, must be caught by the self-check of the true one. The suite
 * prints the smallest relative change that is still caught; `caught` in the table is what it must at least see. */
#include "oracles/oracle.h"
#include "tests/unit/spoilt_states.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { A, B, C, U0, YOUNG, POISSON, DENSITY, PARAMETERS };

/* Beside the oracle checked, one of each wave alone. */
static struct {
    double value[PARAMETERS];
    struct oracle *p_wave, *s_wave;
} part;

static struct oracle *create(const double value[PARAMETERS])
{
    struct oracle *oracle = NULL;
    char why[ORACLE_WHY] = "";
    CU_ASSERT_TRUE_FATAL(oracle_create(now.kind, value, &oracle, why));
    return oracle;
}

static void begin(double a, double b, double c)
{
    const double value[PARAMETERS] = {a, b, c, 5e-4, 17e6, 0.3, 1100};
    double alone[PARAMETERS], m = (a + b + c) / 3;
    memset(&now, 0, sizeof now);
    now.kind = oracle_find("swinging-cube");
    CU_ASSERT_PTR_NOT_NULL_FATAL(now.kind);
    memcpy(part.value, value, sizeof value);
    memcpy(alone, value, sizeof value);
    now.whole = create(value);
    alone[A] = alone[B] = alone[C] = m;
    part.p_wave = create(alone);
    alone[A] = a - m;
    alone[B] = b - m;
    alone[C] = c - m;
    part.s_wave = create(alone);
}

static void end(void)
{
    now.kind->destroy(now.whole);
    now.kind->destroy(part.p_wave);
    now.kind->destroy(part.s_wave);
}

static void wave_number(const double X[3], double t, double d, struct oracle_state *s)
{
    const double shorter[3] = {X[0] * (1 + d), X[1] * (1 + d), X[2] * (1 + d)};
    true_state(shorter, t, s);
    scale_gradient(s->F, 1 + d);
    scale(s->P, 9, 1 + d);
}

/* Both waves, each with its clock fast by a factor, in all fields alike. */
static void two_clocks(const double X[3], double t, double p_clock, double s_clock, struct oracle_state *s)
{
    struct oracle_state shear;
    now.kind->state(part.p_wave, X, t * p_clock, s);
    now.kind->state(part.s_wave, X, t * s_clock, &shear);
    for (int i = 0; i < 3; i++) {
        s->u[i] += shear.u[i];
        s->v[i] = s->v[i] * p_clock + shear.v[i] * s_clock;
        s->p[i] = s->p[i] * p_clock + shear.p[i] * s_clock;
    }
    for (int i = 0; i < 9; i++) {
        s->F[i] += shear.F[i] - (i % 4 == 0 ? 1 : 0);
        s->P[i] += shear.P[i];
    }
}

static void p_frequency(const double X[3], double t, double d, struct oracle_state *s)
{
    two_clocks(X, t, 1 + d, 1, s);
}

static void s_frequency(const double X[3], double t, double d, struct oracle_state *s)
{
    two_clocks(X, t, 1, 1 + d, s);
}

static void phase(const double X[3], double t, double d, struct oracle_state *s)
{
    true_state(X, t + d / 400, s); /* the p-wave has 393 rad/s */
}

static void place(const double X[3], double t, double d, struct oracle_state *s)
{
    const double moved[3] = {X[0] + d, X[1], X[2]};
    true_state(moved, t, s);
}

static void lame_lambda(const double X[3], double t, double d, struct oracle_state *s)
{
    true_state(X, t, s);
    for (int i = 0; i < 3; i++) {
        s->P[4 * i] += d * 9.8e6 * (s->F[0] + s->F[4] + s->F[8] - 3);
    }
}

static void lame_mu(const double X[3], double t, double d, struct oracle_state *s)
{
    true_state(X, t, s);
    for (int i = 0; i < 9; i++) {
        s->P[i] += d * 6.5e6 * (s->F[i] + s->F[i % 3 * 3 + i / 3] - (i % 4 == 0 ? 2 : 0));
    }
}

static const struct {
    const char *name;
    spoil_state *state;
    spoil_energy *energy;
    double caught; /* the smallest change that must be caught */
} mutations[] = {
    {"displacement", displacement, NULL, 1e-12},
    {"velocity", velocity, NULL, 1e-12},
    {"density in p", momentum, NULL, 1e-14},
    {"deformation gradient", gradient, NULL, 1e-11},
    {"stress", stress, NULL, 1e-12},
    {"amplitude of all fields", amplitude, NULL, 1e-12},
    {"wave number of all fields", wave_number, NULL, 1e-12},
    {"frequency of the p-wave", p_frequency, NULL, 1e-12},
    {"frequency of the s-wave", s_frequency, NULL, 1e-12},
    {"phase", phase, NULL, 1e-12},
    {"place", place, NULL, 1e-12},
    {"lambda in P", lame_lambda, NULL, 1e-11},
    {"mu in P", lame_mu, NULL, 1e-11},
    {"kinetic energy", NULL, kinetic_energy, 1e-12},
    {"strain energy", NULL, strain_energy, 1e-12},
    {"both energies", NULL, both_energies, 1e-12},
    {"share of the energies", NULL, exchanged_energy, 1e-12},
};

static void small_changes_are_caught(void)
{
    begin(1, -0.5, 0.25);
    CU_ASSERT_FALSE(caught(NULL)); /* going through the copy is no fault */
    printf("\n");
    for (size_t i = 0; i < sizeof mutations / sizeof *mutations; i++) {
        now.state = mutations[i].state;
        now.energy = mutations[i].energy;
        double smallest = smallest_caught(-2, -16, 1);
        printf("    %-28s caught down to %.0e\n", mutations[i].name, smallest);
        CU_ASSERT_TRUE(smallest <= mutations[i].caught * 1.5);
    }
    end();
}

/* Every parameter off in the fields alone: a solution without a flaw, but of another problem. */
static void another_problem_is_caught(void)
{
    begin(1, -0.5, 0.25);
    for (int i = 0; i < PARAMETERS; i++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            double value[PARAMETERS];
            memcpy(value, part.value, sizeof value);
            value[i] *= 1 + sign * 1e-9;
            now.other = create(value);
            now.state = other_oracle;
            CU_ASSERT_TRUE(caught(NULL));
            now.kind->destroy(now.other);
        }
    }
    now.other = now.whole;
    CU_ASSERT_FALSE(caught(NULL));
    end();
}

static void sines_for_cosines(const double X[3], double t, double d, struct oracle_state *s)
{
    (void)d;
    const double mirrored[3] = {1 - X[0], 1 - X[1], 1 - X[2]};
    true_state(mirrored, t, s);
}

static void transposed_gradient(const double X[3], double t, double d, struct oracle_state *s)
{
    (void)d;
    struct oracle_state given;
    true_state(X, t, &given);
    *s = given;
    for (int i = 0; i < 9; i++) {
        s->F[i] = given.F[i % 3 * 3 + i / 3];
    }
}

static void sign_of_one_shear(const double X[3], double t, double d, struct oracle_state *s)
{
    (void)d;
    true_state(X, t, s);
    s->P[5] = -s->P[5];
    s->P[7] = -s->P[7];
}

static void all_by_the_p_wave(const double X[3], double t, double d, struct oracle_state *s)
{
    (void)d;
    two_clocks(X, t, 1, 1.8708286933869707, s); /* cp / cs for nu = 0.3 */
}

static void all_by_the_s_wave(const double X[3], double t, double d, struct oracle_state *s)
{
    (void)d;
    two_clocks(X, t, 1 / 1.8708286933869707, 1, s);
}

static void nan_now_and_then(const double X[3], double t, double d, struct oracle_state *s)
{
    (void)d;
    true_state(X, t, s);
    if (X[0] > 0.5 && X[0] < 0.55 && X[1] > 0.5) {
        s->P[8] = NAN;
    }
}

static void swapped_energies(double d, struct energies *e)
{
    (void)d;
    double k = e->kinetic;
    e->kinetic = e->strain;
    e->strain = k;
}

static void wrong_formulas_are_caught(void)
{
    unit_untrapped();
    static spoil_state *const states[] = {sign_of_v,      sines_for_cosines, transposed_gradient, sign_of_one_shear,
                                          no_unit_matrix, all_by_the_p_wave, all_by_the_s_wave,   frozen,
                                          nothing,        nan_now_and_then};
    static spoil_energy *const energies[] = {swapped_energies, infinite_energy};
    begin(1, -0.5, 0.25);
    for (size_t i = 0; i < sizeof states / sizeof *states; i++) {
        now.state = states[i];
        CU_ASSERT_TRUE(caught(NULL));
    }
    now.state = NULL;
    CU_ASSERT_FALSE(caught(NULL));
    for (size_t i = 0; i < sizeof energies / sizeof *energies; i++) {
        now.energy = energies[i];
        CU_ASSERT_TRUE(caught(NULL));
    }
    end();
}

static void shifted(const double X[3], double t, double d, struct oracle_state *s)
{
    true_state(X, t, s);
    s->u[1] += d;
}

/* Where nothing moves there is no size to measure against: anything at all is an error. */
static void rest_is_not_beyond_reproach(void)
{
    begin(0, 0, 0);
    CU_ASSERT_FALSE(caught(NULL));
    now.d = 1e-300;
    now.state = shifted;
    CU_ASSERT_TRUE(caught(NULL));
    end();
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"small changes are caught", small_changes_are_caught},
        {"another problem is caught", another_problem_is_caught},
        {"wrong formulas are caught", wrong_formulas_are_caught},
        {"rest is not beyond reproach", rest_is_not_beyond_reproach},
    };
    return unit_main("oracles: mutations", tests, sizeof tests / sizeof *tests);
}
