/* Runs of bodies that flow plastically: what they cost, remember, show and dissipate. */
#include "solver/record.h"
#include "tests/unit/runs.h"
#include "tests/unit/scratch.h"

static const char elastic[] = "material = { model = 'hencky', E = 3, nu = 0.3, rho = 2 }\n";
static const char plastic[] =
    "material = { model = 'hencky', E = 3, nu = 0.3, rho = 2, yield_stress = 0.03, hardening = 0.3 }\n";
/* A free body that is torn apart along its diagonal, turning. */
static const char torn[] = "initial = { velocity = function(X, Y, Z)\n"
                           "    return first(0.4 * X - 0.1 * Y, 0.2 * X + 0.1 * sin(3 * X), 0.3 * Z * X) end }\n";

static const char *with(const char *material, const char *more)
{
    static char text[2048];
    CU_ASSERT_FATAL((size_t)snprintf(text, sizeof text, "%s%s", material, more) < sizeof text);
    return text;
}

/* Only a scene whose material yields has anything to remember. */
static void what_it_costs(void)
{
    static const char *const evolved[] = {"pF", "pFJ", "pFHJ"};
    static const double remembered[] = {3, 5, 7};
    for (int dim = 1; dim <= 3; dim++) {
        for (int e = 0; e < 3; e++) {
            struct sample other = start("", "dim=%d evolved=%s", dim, evolved[e]);
            struct sample bare = start(elastic, "dim=%d evolved=%s", dim, evolved[e]);
            struct sample yields = start(plastic, "dim=%d evolved=%s", dim, evolved[e]);
            struct solver_facts of_other = solver_run_facts(other.run), of_bare = solver_run_facts(bare.run);
            struct solver_facts of_yields = solver_run_facts(yields.run);
            double stiffness = e > 0 ? 8.0 : 0.0; /* U''(J), which the other material has constant */
            CU_ASSERT_EQUAL(of_bare.state_bytes, of_other.state_bytes + stiffness);
            CU_ASSERT_EQUAL(of_bare.bytes_per_particle, of_other.bytes_per_particle + stiffness);
            /* now, and at the start of the step */
            CU_ASSERT_EQUAL(of_yields.state_bytes, of_bare.state_bytes + 2 * 8 * remembered[dim - 1]);
            CU_ASSERT_PTR_NULL(output_of(&bare).plastic_strain);
            CU_ASSERT_PTR_NOT_NULL(output_of(&yields).plastic_strain);
            finish(&other);
            finish(&bare);
            finish(&yields);
        }
    }
}

static double largest_apart(size_t count, const double *left, const double *right)
{
    double most = 0;
    for (size_t i = 0; i < count; i++) {
        most = fmax(most, fabs(left[i] - right[i]));
    }
    return most;
}

/* A yield surface that is never met changes nothing. */
static void within_the_yield_surface(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct sample bare = start(with(elastic, torn), "dim=%d n=6 integrator=rk4", dim);
        struct sample yields = start(with(plastic, torn), "dim=%d n=6 integrator=rk4 material.yield_stress=1e3", dim);
        advance_to(&bare, 0.3);
        advance_to(&yields, 0.3);
        struct solver_output of_bare = output_of(&bare), of_yields = output_of(&yields);
        size_t count = of_bare.cloud->count, d = (size_t)dim;
        CU_ASSERT_EQUAL(of_bare.step, of_yields.step);
        expect_below("P apart / E", largest_apart(count * d * d, of_bare.P, of_yields.P) / 3, 1e-13);
        expect_below("v apart", largest_apart(count * d, of_bare.v, of_yields.v), 1e-13);
        for (size_t a = 0; a < count; a++) {
            CU_ASSERT_EQUAL(of_yields.plastic_strain[a], 0);
        }
        finish(&bare);
        finish(&yields);
    }
}

/* What plastic flow takes is no loss: with it, a free body keeps all its energy but for what the scheme dissipates,
 * which vanishes as n grows. */
static void balance(void)
{
    double lost[2], flown = 0;
    for (int level = 0; level < 2; level++) {
        struct sample sample =
            start(with(plastic, torn), "dim=2 n=%d integrator=rk4 evolved=pFJ t_end=0.5 material.yield_stress=0.01",
                  16 << level);
        advance_to(&sample, 0.5);
        const struct solver_history *history = solver_run_history(sample.run);
        const struct solver_totals *first = &history->totals[0];
        double before = first->kinetic, least = 0;
        CU_ASSERT(history->flows && history->count > 10);
        CU_ASSERT_EQUAL(first->plastic, 0);
        for (size_t row = 1; row < history->count; row++) {
            const struct solver_totals *at = &history->totals[row];
            CU_ASSERT(at->plastic >= least);
            least = at->plastic;
            lost[level] = 1 - (at->kinetic + at->strain + at->plastic) / before;
            expect_below("energy gained", -lost[level], 1e-6);
        }
        flown = least / before;
        finish(&sample);
    }
    CU_ASSERT(flown > 0.05); /* the body flies off with the most of it */
    expect_below("energy lost by the scheme / taken by plastic flow", lost[1] / flown, 0.02);
    expect_below("what is lost as n doubles", lost[1] / lost[0], 0.3);
}

static void threads(void)
{
    static const int n[] = {600, 24, 8};
    for (int dim = 1; dim <= 3; dim++) {
        struct sample one =
            start(with(plastic, torn), "dim=%d n=%d material.yield_stress=1e-3 threads=1", dim, n[dim - 1]);
        advance(&one, 4);
        struct solver_output expected = output_of(&one);
        size_t count = expected.cloud->count, d = (size_t)dim;
        double flown = 0;
        for (size_t a = 0; a < count; a++) {
            flown = fmax(flown, expected.plastic_strain[a]);
        }
        CU_ASSERT(flown > 1e-5);
        for (int threads = 2; threads <= 3; threads++) {
            struct sample more = start(with(plastic, torn), "dim=%d n=%d material.yield_stress=1e-3 threads=%d", dim,
                                       n[dim - 1], threads);
            advance(&more, 4);
            struct solver_output found = output_of(&more);
            CU_ASSERT_EQUAL(memcmp(found.plastic_strain, expected.plastic_strain, count * sizeof(double)), 0);
            CU_ASSERT_EQUAL(memcmp(found.P, expected.P, count * d * d * sizeof(double)), 0);
            CU_ASSERT_EQUAL(memcmp(found.v, expected.v, count * d * sizeof(double)), 0);
            finish(&more);
        }
        finish(&one);
    }
}

/* A step that breaks a particle is taken back, and with it what has flown in it. */
static void taken_back(void)
{
    unit_untrapped();
    struct sample sample = start(with(plastic, torn), "dim=2 n=6 cfl=3 integrator=rk4");
    double *before = NULL;
    bool ok = true;
    for (int step = 0; ok && step < 400; step++) {
        struct solver_output output = output_of(&sample);
        before = realloc(before, output.cloud->count * sizeof *before);
        CU_ASSERT_PTR_NOT_NULL_FATAL(before);
        memcpy(before, output.plastic_strain, output.cloud->count * sizeof *before);
        ok = solver_run_steps(sample.run, 1, &sample.error);
    }
    CU_ASSERT_FATAL(!ok);
    CU_ASSERT_EQUAL(sample.error.code, SOLVER_BROKE_DOWN);
    struct solver_output output = output_of(&sample);
    double flown = 0;
    for (size_t a = 0; a < output.cloud->count; a++) {
        flown = fmax(flown, before[a]);
    }
    CU_ASSERT(flown > 0);
    expect_below("plastic strain, taken back / largest",
                 largest_apart(output.cloud->count, before, output.plastic_strain) / flown, 1e-14);
    free(before);
    finish(&sample);
}

static void shown(void)
{
    struct solver_record *record = NULL;
    struct sample sample = start(with(plastic, torn), "dim=2 n=6 t_end=0.3");
    advance_to(&sample, 0.3);
    struct solver_output output = output_of(&sample);
    CU_ASSERT_FATAL(
        solver_record_make(sample.scene, &output, solver_run_history(sample.run), "", "", &record, &sample.error));
    const struct solver_record_field *field = solver_record_find(record, "plastic_strain");
    CU_ASSERT_PTR_NOT_NULL_FATAL(field);
    CU_ASSERT_STRING_EQUAL(field->unit, "-");
    CU_ASSERT_EQUAL(memcmp(field->value, output.plastic_strain, record->count * sizeof(double)), 0);
    bool found = false;
    for (size_t column = 0; column < record->history_columns; column++) {
        if (strcmp(record->history_name[column], "plastic_work") == 0) {
            double last = record->history[(record->history_count - 1) * record->history_columns + column];
            CU_ASSERT_STRING_EQUAL(record->history_unit[column], "J/m");
            CU_ASSERT(last > 0);
            CU_ASSERT_EQUAL(last, solver_run_history(sample.run)->totals[record->history_count - 1].plastic);
            found = true;
        }
    }
    CU_ASSERT(found);
    solver_record_free(record);
    finish(&sample);
}

/* Which scenes are refused, and how. */
static void refused(void)
{
    static const char *const cases[][2] = {
        {"material.model=neo-hookean", "the model neo-hookean does not flow plastically; take material.model = "},
        {"material.yield_stress=0", "material.yield_stress: missing"},
        {"material.yield_stress=-1", "material.yield_stress: expected number >= 0 [Pa]"},
        {"material.law=saturation material.saturation=0.02 material.saturation_rate=3",
         "material.saturation: expected number >= yield_stress = 0.03 [Pa], got 0.02"},
        {"material.law=saturation material.saturation=0.04", "material.saturation_rate: expected number > 0"},
        {"material.saturation=0.04", "material.saturation: belongs to material.law"},
        {"material.law=power material.hardening=0 material.hardening_exponent=0.3",
         "material.hardening_strain: expected number > 0"},
        {"material.law=power material.hardening=0 material.hardening_strain=0.3",
         "material.hardening_exponent: expected number in (0, 1]"},
        {"material.law=power material.hardening_strain=0.3 material.hardening_exponent=0.3",
         "material.hardening: the power law has no H"},
        {"material.hardening_strain=0.3", "belong to material.law = "},
        {"material.law=ideal", "material.law: expected one of linear, saturation, power"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct solver_scene *scene = NULL;
        struct solver_error error = {.code = SOLVER_OK};
        char path[SCRATCH], words[256];
        const char *override[8];
        size_t count = 0;
        scratch_text(path, "%s%s%s", block, plain_domain, plastic);
        (void)snprintf(words, sizeof words, "%s", cases[i][0]);
        char *rest = words;
        for (char *word = strtok_r(rest, " ", &rest); word != NULL && count < 8; word = strtok_r(rest, " ", &rest)) {
            override[count++] = word;
        }
        bool good = solver_scene_load(path, override, count, &scene, &error);
        CU_ASSERT(!good && error.code == SOLVER_BAD_INPUT);
        bool said = !good && strstr(error.text, cases[i][1]) != NULL;
        if (!said) {
            printf("\n    %s: %s", cases[i][0], good ? "loads" : error.text);
        }
        CU_ASSERT(said);
        solver_scene_free(scene);
        (void)unlink(path);
    }
    struct solver_error error = refusal(plastic, "dim=2 scheme=ulsph");
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "material.yield_stress: the scheme ulsph knows no plastic flow"));
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"what plasticity costs, and what it does not without it", what_it_costs},
        {"a yield surface that is never met changes nothing", within_the_yield_surface},
        {"energy balance", balance},
        {"the same bytes for any number of threads", threads},
        {"a step taken back", taken_back},
        {"what is shown and recorded", shown},
        {"refusals", refused},
    };
    return unit_main("plastic runs", tests, sizeof tests / sizeof *tests);
}
