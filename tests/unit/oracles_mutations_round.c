/* Formulas of the round bodies, spoiled on purpose, must be caught by the self-check of the true kinds. The suite
 * prints the smallest relative change that is still caught; `caught` in the tables is what it must at least see. */
#include "oracles/oracle.h"
#include "tests/unit/spoilt_states.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { INNER = 1, OUTER = 2 }; /* radii of the typical tube [m]; the others are the typical values, too */
static const double LAMBDA = 6.8e6, MU = 6.8e6, SHEAR = 1e6, U0 = 5e-4;

static void begin(const char *name)
{
    double value[ORACLE_PARAMETERS];
    char why[ORACLE_WHY] = "";
    memset(&now, 0, sizeof now);
    now.kind = oracle_find(name);
    CU_ASSERT_PTR_NOT_NULL_FATAL(now.kind);
    for (size_t i = 0; now.kind->parameter[i].name != NULL; i++) {
        value[i] = now.kind->parameter[i].typical;
    }
    CU_ASSERT_TRUE_FATAL(oracle_create(now.kind, value, &now.whole, why));
    CU_ASSERT_FALSE(caught(NULL)); /* going through the copy is no fault */
}

static void end(void)
{
    now.kind->destroy(now.whole);
}

/* n n, and I - n n in the plane or in space. */
static double radius_of(const double X[3], double along[9], double around[9])
{
    double r = now.kind->dim == 3 ? hypot(hypot(X[0], X[1]), X[2]) : hypot(X[0], X[1]);
    memset(along, 0, 9 * sizeof *along);
    memset(around, 0, 9 * sizeof *around);
    for (int i = 0; i < now.kind->dim && r > 0; i++) {
        for (int j = 0; j < now.kind->dim; j++) {
            along[3 * i + j] = X[i] / r * (X[j] / r);
            around[3 * i + j] = (i == j ? 1 : 0) - along[3 * i + j];
        }
    }
    return r;
}

static void add(double *to, const double *what, double factor)
{
    for (int i = 0; i < 9; i++) {
        to[i] += factor * what[i];
    }
}

/* The part of the stress that the spoiler names, too large. */
static void too_large(const double X[3], double d, bool radial, struct oracle_state *s)
{
    double part[2][9], sum = 0, r = radius_of(X, part[0], part[1]);
    const double *which = part[radial ? 0 : 1];
    for (int i = 0; i < 9; i++) {
        sum += which[i] * s->P[i];
    }
    add(s->P, which, r > 0 ? d * sum / (radial ? 1 : now.kind->dim - 1) : 0);
}

static void radial_stress(const double X[3], double t, double d, struct oracle_state *s)
{
    true_state(X, t, s);
    too_large(X, d, true, s);
}

static void hoop_stress(const double X[3], double t, double d, struct oracle_state *s)
{
    true_state(X, t, s);
    too_large(X, d, false, s);
}

static void axial_stress(const double X[3], double t, double d, struct oracle_state *s)
{
    true_state(X, t, s);
    s->P[8] *= 1 + d;
}

static void wave_number(const double X[3], double t, double d, struct oracle_state *s)
{
    const double further[3] = {X[0] * (1 + d), X[1] * (1 + d), X[2] * (1 + d)};
    true_state(further, t, s);
    scale_gradient(s->F, 1 + d);
    scale(s->P, 9, 1 + d);
}

static void frequency(const double X[3], double t, double d, struct oracle_state *s)
{
    true_state(X, t * (1 + d), s);
    scale(s->v, 3, 1 + d);
    scale(s->p, 3, 1 + d);
}

static void phase(const double X[3], double t, double d, struct oracle_state *s)
{
    true_state(X, t + d / 300, s); /* the ball has 349 rad/s, the cylinder 282 */
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
        s->P[4 * i] += d * LAMBDA * (s->F[0] + s->F[4] + s->F[8] - 3);
    }
}

static void lame_mu(const double X[3], double t, double d, struct oracle_state *s)
{
    true_state(X, t, s);
    for (int i = 0; i < 9; i++) {
        s->P[i] += d * MU * (s->F[i] + s->F[i % 3 * 3 + i / 3] - (i % 4 == 0 ? 2 : 0));
    }
}

/* U0 R^(d - 1) / r^(d - 1), which bears itself at rest everywhere but in the centre. */
static void singular(const double X[3], double t, double d, struct oracle_state *s)
{
    double along[9], around[9], r = fmax(1e-3, radius_of(X, along, around)), power = now.kind->dim - 1;
    double moved = d * U0 / pow(r, power);
    true_state(X, t, s);
    for (int i = 0; i < now.kind->dim; i++) {
        s->u[i] += moved * X[i] / r;
    }
    add(s->F, along, -power * moved / r);
    add(s->F, around, moved / r);
    add(s->P, along, -2 * MU * power * moved / r);
    add(s->P, around, 2 * MU * moved / r);
}

/* A pressure, which nothing but the faces and the momentum equation determine: P less p F^-T. */
static void pressed(double pressure, struct oracle_state *s)
{
    const double cofactor[9] = {s->F[4], -s->F[3], 0, -s->F[1], s->F[0], 0, 0, 0, 1};
    add(s->P, cofactor, -SHEAR * pressure);
}

static void pressure(const double X[3], double t, double d, struct oracle_state *s)
{
    true_state(X, t, s);
    pressed(d, s);
}

static void pressure_within(const double X[3], double t, double d, struct oracle_state *s)
{
    double R = hypot(X[0], X[1]);
    true_state(X, t, s);
    pressed(d * (R - INNER) * (OUTER - R), s);
}

/* u goes as 1/R, as in a small oscillation, by a part of it. */
static void linear_motion(const double X[3], double t, double d, struct oracle_state *s)
{
    double along[9], around[9], R = radius_of(X, along, around);
    struct oracle_state face;
    true_state(X, t, s);
    true_state((const double[3]){INNER, 0, 0}, t, &face);
    for (int i = 0; i < 2; i++) {
        s->u[i] += d * (face.u[0] * INNER / R * X[i] / R - s->u[i]);
        s->v[i] += d * (face.v[0] * INNER / R * X[i] / R - s->v[i]);
        s->p[i] = 1000 * s->v[i];
    }
}

struct mutation {
    const char *name;
    spoil_state *state;
    spoil_energy *energy;
    double caught; /* the smallest change that must be caught */
};

static void each_is_caught(const char *kind, const struct mutation *mutations, size_t count)
{
    begin(kind);
    printf("\n");
    for (size_t i = 0; i < count; i++) {
        now.state = mutations[i].state;
        now.energy = mutations[i].energy;
        double smallest = smallest_caught(-2, -16, 1);
        printf("    %-18s %-28s caught down to %.0e\n", kind, mutations[i].name, smallest);
        CU_ASSERT_TRUE(smallest <= mutations[i].caught * 1.5);
    }
    end();
}

static void small_changes_of_a_breathing_body_are_caught(void)
{
    static const struct mutation mutations[] = {
        {"radial stress", radial_stress, NULL, 1e-12},
        {"hoop stress", hoop_stress, NULL, 1e-12},
        {"axial stress", axial_stress, NULL, 1e-12},
        {"wave number of all fields", wave_number, NULL, 1e-12},
        {"frequency", frequency, NULL, 1e-13},
        {"phase", phase, NULL, 1e-13},
        {"place", place, NULL, 1e-13},
        {"lambda in P", lame_lambda, NULL, 1e-11},
        {"mu in P", lame_mu, NULL, 1e-11},
        {"singular in the centre", singular, NULL, 1e-12},
        {"share of the energies", NULL, exchanged_energy, 1e-12},
    };
    each_is_caught("breathing-sphere", mutations, sizeof mutations / sizeof *mutations);
    each_is_caught("breathing-cylinder", mutations, sizeof mutations / sizeof *mutations);
}

static void small_changes_of_a_tube_are_caught(void)
{
    static const struct mutation mutations[] = {
        {"radial stress", radial_stress, NULL, 1e-11},
        {"hoop stress", hoop_stress, NULL, 1e-11},
        {"axial stress", axial_stress, NULL, 1e-11},
        {"frequency", frequency, NULL, 1e-11},
        {"place", place, NULL, 1e-11},
        {"pressure", pressure, NULL, 1e-11},
        {"pressure between the faces", pressure_within, NULL, 1e-11},
        {"motion of small strains", linear_motion, NULL, 1e-11},
        {"share of the energies", NULL, exchanged_energy, 1e-11},
    };
    each_is_caught("tube-oscillation", mutations, sizeof mutations / sizeof *mutations);
}

static void hoop_for_radial(const double X[3], double t, double d, struct oracle_state *s)
{
    double along[9], around[9], hoop = 0, radial = 0, spread = now.kind->dim - 1;
    (void)d;
    true_state(X, t, s);
    (void)radius_of(X, along, around);
    for (int i = 0; i < 9; i++) {
        radial += along[i] * s->P[i];
        hoop += around[i] * s->P[i] / spread;
    }
    add(s->P, along, hoop - radial);
    add(s->P, around, radial - hoop);
}

static void inwards(const double X[3], double t, double d, struct oracle_state *s)
{
    (void)d;
    amplitude(X, t, -2, s);
}

static void cauchy_for_P(const double X[3], double t, double d, struct oracle_state *s)
{
    double sigma[9];
    (void)d;
    true_state(X, t, s);
    oracle_cauchy(now.kind, s, sigma);
    memcpy(s->P, sigma, sizeof sigma);
}

static void plane_stress(const double X[3], double t, double d, struct oracle_state *s)
{
    (void)d;
    true_state(X, t, s);
    s->P[8] = 0;
}

static void nan_in_the_centre(const double X[3], double t, double d, struct oracle_state *s)
{
    (void)d;
    true_state(X, t, s);
    s->P[0] = X[0] == 0 && X[1] == 0 ? NAN : s->P[0];
}

static void wrong_formulas_are_caught(void)
{
    unit_untrapped();
    static const struct {
        const char *kind;
        spoil_state *state;
    } wrong[] = {
        {"breathing-sphere", hoop_for_radial},   {"breathing-sphere", inwards},
        {"breathing-sphere", plane_stress},      {"breathing-sphere", nan_in_the_centre},
        {"breathing-cylinder", hoop_for_radial}, {"breathing-cylinder", inwards},
        {"breathing-cylinder", plane_stress},    {"breathing-cylinder", nan_in_the_centre},
        {"tube-oscillation", hoop_for_radial},   {"tube-oscillation", inwards},
        {"tube-oscillation", plane_stress},      {"tube-oscillation", cauchy_for_P},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        begin(wrong[i].kind);
        now.state = wrong[i].state;
        CU_ASSERT_TRUE(caught(NULL));
        end();
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"small changes of a breathing body are caught", small_changes_of_a_breathing_body_are_caught},
        {"small changes of a tube are caught", small_changes_of_a_tube_are_caught},
        {"wrong formulas are caught", wrong_formulas_are_caught},
    };
    return unit_main("oracles: mutations of round bodies", tests, sizeof tests / sizeof *tests);
}
