/* The balance of energy: what is there, what plastic flow, numerical dissipation and impacts on a wall have taken, less
 * the work of loads, stays what it was, up to the error of the steps; and it costs nothing where it is not asked for.
 */
#include "tests/unit/runs.h"

#define FAST                                                                                                           \
    "initial = { velocity = function(X, Y, Z)\n"                                                                       \
    "    return first(0.3 * sin(4 * X + Y), 0.2 * cos(5 * Y - X + Z), 0.3 * sin(4 * Z + X)) end }\n"
#define METAL "material = { model = 'hencky', E = 3, nu = 0.3, rho = 2, yield_stress = 0.03, hardening = 0.3 }\n"
#define FALLING                                                                                                        \
    "initial = { velocity = function() return first(-0.3, 0, 0) end }\n"                                               \
    "rigid_wall = { point = each(0), normal = { first(1, 0, 0) } }\n"
#define LOADED                                                                                                         \
    "body_force = function(X, Y, Z, t) return first(0.5 * cos(3 * Y) * sin(2 * t), 0, 0) end\n"                        \
    "faces = { X1 = { kind = 'traction', value = function(X, Y, Z, t) return first(0, 0.3 * sin(3 * t), 0) end } }\n"

/* Largest gap over the energy that was ever there, and what dissipation and impacts have taken of it. */
struct gap {
    double most, numerical, impact, plastic;
};

static struct gap gap_of(const char *more, const char *words, double cfl)
{
    struct sample sample = start(more, "balance=true history=100000 %s cfl=%g", words, cfl);
    advance_to(&sample, 0.6);
    const struct solver_history *history = solver_run_history(sample.run);
    const struct solver_totals *first = &history->totals[0], *last = &history->totals[history->count - 1];
    struct gap gap = {.most = 0};
    double supply = 0;
    CU_ASSERT(history->balanced);
    for (size_t i = 0; i < history->count; i++) {
        const struct solver_totals *at = &history->totals[i];
        double there = at->kinetic + at->strain + at->plastic + at->numerical + at->impact - at->external;
        supply = fmax(supply, at->kinetic + at->strain);
        gap.most = fmax(gap.most, fabs(there - first->kinetic - first->strain));
    }
    gap = (struct gap){gap.most / supply, last->numerical / supply, last->impact / supply, last->plastic / supply};
    finish(&sample);
    return gap;
}

/* Steps half as long leave an eighth of the gap of TVD-RK2, a sixth where it flows. */
static void closes(void)
{
    static const struct {
        const char *more, *words;
        double most; /* at the shorter step */
    } cases[] = {
        {FAST, "dim=1 n=16 evolved=pF", 2e-4},
        {FAST, "dim=2 n=8 evolved=pF", 2e-4},
        {FAST, "dim=2 n=8 evolved=pFJ", 2e-4},
        {FAST, "dim=3 n=4 evolved=pFHJ", 1e-3},
        {FAST, "dim=2 n=8 evolved=pFHJ material.model=neo-hookean-polyconvex", 2e-4},
        {FAST, "dim=2 n=8 evolved=pFHJ volume_flux=stress", 2e-4},
        {FAST, "dim=2 n=8 evolved=pFJ stencil=closed perturb=0.1", 2e-4},
        {FAST, "dim=2 n=8 evolved=pFHJ scheme=jst", 2e-4},
        {FAST, "dim=2 n=8 evolved=pF scheme=jst jst.kappa2=0.1", 2e-4},
        {FAST LOADED, "dim=2 n=8 evolved=pFJ", 2e-4},
        {FAST METAL, "dim=2 n=8 evolved=pF", 2e-4},
        {FAST METAL, "dim=3 n=4 evolved=pFJ", 1e-3},
        {FALLING, "dim=1 n=16 evolved=pF", 1e-4},
        {FALLING METAL, "dim=2 n=8 evolved=pF", 1e-4},
        {FALLING METAL, "dim=2 n=8 evolved=pF scheme=jst", 1e-4},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        struct gap coarse = gap_of(cases[c].more, cases[c].words, 0.2);
        struct gap fine = gap_of(cases[c].more, cases[c].words, 0.1);
        printf("\n    %-60s %.1e %.1e of %.1e numerical, %.1e impact, %.1e plastic", cases[c].words, coarse.most,
               fine.most, fine.numerical, fine.impact, fine.plastic);
        expect_below(cases[c].words, fine.most, cases[c].most);
        expect_below("what shorter steps leave of the gap", fine.most / coarse.most, 0.25);
        CU_ASSERT(fine.numerical > 20 * fine.most);
        CU_ASSERT((fine.impact > 20 * fine.most) == (strstr(cases[c].more, "rigid_wall") != NULL));
        CU_ASSERT((fine.plastic > 20 * fine.most) == (strstr(cases[c].more, "hencky") != NULL));
    }
}

/* Who does not ask has no bytes for it, and the same run to the bit; nor do threads change anything. */
static void asked_for(void)
{
    double v[3] = {0}, bytes[3] = {0}, numerical[3] = {0};
    for (int i = 0; i < 3; i++) {
        struct sample sample =
            start(FAST, "dim=2 n=24 balance=%s threads=%d", i == 0 ? "false" : "true", i == 2 ? 3 : 1);
        advance_to(&sample, 0.1);
        struct solver_output output = output_of(&sample);
        const struct solver_history *history = solver_run_history(sample.run);
        v[i] = output.v[2 * (output.cloud->count / 2)];
        bytes[i] = solver_run_facts(sample.run).state_bytes;
        numerical[i] = history->totals[history->count - 1].numerical;
        CU_ASSERT_EQUAL(history->balanced, i > 0);
        finish(&sample);
    }
    CU_ASSERT(v[0] == v[1] && v[1] == v[2]);
    CU_ASSERT_DOUBLE_EQUAL(bytes[1] - bytes[0], 16, 1e-9);
    CU_ASSERT(numerical[0] == 0 && numerical[1] > 0 && numerical[1] == numerical[2]);
}

static void refusals(void)
{
    struct solver_error error = refusal("material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2 }\n",
                                        "dim=2 scheme=ulsph support=2.4 balance=true");
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "balance: what the dissipation of the scheme ulsph takes"));
}

int main(void)
{
    static const struct unit_test tests[] = {{"closes", closes}, {"asked for", asked_for}, {"refusals", refusals}};
    return unit_main("solver balance of energy", tests, sizeof tests / sizeof *tests);
}
