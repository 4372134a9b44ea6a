/* The judge: fields by their names, shapes and units, places and times, orders and gates. */
#include "tests/unit/sample_files.h"
#include "verify/judge.h"

static struct verify_truth truth;
static struct verify_judgement judgement;
static struct verify_samples given;
static struct solver_error why;

/* The oracle called so, with its typical values; begins a new judgement. */
static void begin(const char *oracle)
{
    verify_truth_free(&truth);
    verify_samples_free(&given);
    memset(&judgement, 0, sizeof judgement);
    CU_ASSERT_TRUE_FATAL(verify_truth_tell(oracle, NULL, 0, true, &truth, &why));
    judgement.truth = &truth;
}

/* A level of five places in the cube at 1 ms, without fields yet. */
static struct verify_sample *level(double h)
{
    static const double X[15] = {0.1, 0.2, 0.3, 0.5, 0.5, 0.5, 1, 0.25, 0, 0.7, 0.1, 0.9, 0.3, 0.3, 0.3};
    struct verify_sample *sample = verify_samples_add(&given, "made.h5", &why);
    CU_ASSERT_TRUE_FATAL(sample != NULL && verify_sample_points(sample, 5, 3, &why));
    memcpy(sample->X, X, sizeof X);
    sample->time = (struct verify_sample_number){.value = 1e-3, .unit = "s", .has_unit = true};
    sample->h.value = h;
    (void)snprintf(sample->h.unit, sizeof sample->h.unit, "m");
    (void)snprintf(sample->unit, sizeof sample->unit, "m");
    sample->h.has_unit = sample->has_unit = sample->needs_units = true;
    return sample;
}

static struct verify_sample_field *add(struct verify_sample *sample, const char *name, int width, const char *unit)
{
    struct verify_sample_field *field = verify_sample_add(sample, name, width, &why);
    CU_ASSERT_PTR_NOT_NULL_FATAL(field);
    field->has_unit = unit != NULL;
    (void)snprintf(field->unit, sizeof field->unit, "%s", unit != NULL ? unit : "");
    return field;
}

static struct oracle_state exact_at(const struct verify_sample *sample, size_t a)
{
    struct oracle_state state;
    truth.kind->state(truth.oracle, sample->X + 3 * a, 1e-3, &state);
    return state;
}

/* Nine exact stresses times a factor. */
static struct verify_sample_field *add_stress(struct verify_sample *sample, const char *name, double factor,
                                              const char *unit)
{
    struct verify_sample_field *field = add(sample, name, 9, unit);
    for (size_t a = 0; a < sample->count; a++) {
        struct oracle_state state = exact_at(sample, a);
        for (size_t i = 0; i < 9; i++) {
            field->value[9 * a + i] = state.P[i] * factor;
        }
    }
    return field;
}

static bool compare(const struct verify_sample *sample)
{
    struct verify_judged_level *to = &judgement.level[judgement.level_count];
    bool done = verify_judge_level(&truth, sample, NAN, NAN, to, &why);
    judgement.level_count += done;
    return done;
}

static void refused(const struct verify_sample *sample, const char *words)
{
    bool said = !compare(sample) && strstr(why.text, words) != NULL && strstr(why.text, "made.h5") != NULL;
    if (!said) {
        printf("expected \"%s\", got \"%s\"\n", words, why.text);
    }
    CU_ASSERT_TRUE(said);
    CU_ASSERT_EQUAL(why.code, SOLVER_BAD_INPUT);
}

static double error_called(const char *name)
{
    size_t which = verify_judged_find(truth.kind, name);
    CU_ASSERT_TRUE_FATAL(which < VERIFY_JUDGED_ERRORS);
    return judgement.level[judgement.level_count - 1].error[which];
}

static bool near(double a, double b)
{
    return fabs(a - b) <= 1e-12 * fmax(1, fabs(b));
}

static void an_offset_is_measured_in_every_norm(void)
{
    static const char *const relative[] = {"P", "P_max", "P_l1", "P_all", "P_all_max", "P_all_l1"};
    begin("swinging-cube");
    struct verify_sample *sample = level(0.1);
    (void)add_stress(sample, "P", 1.01, "Pa");
    CU_ASSERT_TRUE_FATAL(compare(sample));
    for (size_t i = 0; i < sizeof relative / sizeof *relative; i++) {
        CU_ASSERT_TRUE(near(error_called(relative[i]), 0.01));
    }
    CU_ASSERT_TRUE(error_called("P_abs") > 0 && error_called("P_abs_max") >= error_called("P_abs"));
    CU_ASSERT_TRUE(isnan(error_called("u")));
}

/* One point of weight 3 with an error, and four of weight 1 without. */
static void weights_count(void)
{
    for (int weighted = 0; weighted < 2; weighted++) {
        begin("swinging-cube");
        struct verify_sample *sample = level(0.1);
        double error = 0, size = 0;
        CU_ASSERT_TRUE_FATAL(weighted == 0 || verify_sample_weights(sample, &why));
        struct verify_sample_field *u = add(sample, "displacement", 3, "m");
        for (size_t a = 0; a < 5; a++) {
            struct oracle_state state = exact_at(sample, a);
            double weight = weighted != 0 && a == 0 ? 3 : 1;
            if (weighted != 0) {
                sample->weight[a] = weight;
            }
            memcpy(u->value + 3 * a, state.u, sizeof state.u);
            size += weight * (state.u[0] * state.u[0] + state.u[1] * state.u[1] + state.u[2] * state.u[2]);
        }
        u->value[1] += 1e-6;
        error = (weighted != 0 ? 3 : 1) * 1e-12;
        CU_ASSERT_TRUE_FATAL(compare(sample));
        CU_ASSERT_TRUE(fabs(error_called("u") / sqrt(error / size) - 1) < 1e-9);
    }
}

static void names_shapes_and_units(void)
{
    static const char *const stress[] = {"sigma", "cauchy", "Cauchy_Stress", "STRESS"};
    for (size_t i = 0; i < sizeof stress / sizeof *stress; i++) {
        begin("swinging-cube");
        struct verify_sample *sample = level(0.1);
        (void)add_stress(sample, stress[i], 1e-6, "MPa");
        CU_ASSERT_TRUE_FATAL(compare(sample));
        CU_ASSERT_TRUE(error_called("sigma") < 1e-15 && error_called("sigma_all") < 1e-15);
    }
    begin("swinging-cube");
    struct verify_sample *sample = level(0.1);
    struct verify_sample_field *six = add(sample, "sigma", 6, "kPa"), *mean = add(sample, "pressure", 1, "Pa");
    for (size_t a = 0; a < 5; a++) {
        struct oracle_state state = exact_at(sample, a);
        const double *P = state.P;
        double value[6] = {P[0], P[4], P[8], P[1], P[5], P[2]};
        for (size_t i = 0; i < 6; i++) {
            six->value[6 * a + i] = value[i] * 1e-3;
        }
        mean->value[a] = (P[0] + P[4] + P[8]) / 3;
    }
    CU_ASSERT_TRUE_FATAL(compare(sample));
    CU_ASSERT_TRUE(error_called("sigma_all") < 1e-14 && error_called("pressure") < 1e-14);
    CU_ASSERT_STRING_EQUAL(judgement.level[0].ignored, "");
}

static void what_is_not_all_there(void)
{
    begin("swinging-cube");
    struct verify_sample *sample = level(0.1);
    struct verify_sample_field *P = add_stress(sample, "P", 1, "Pa");
    P->given = 1U | 1U << 4 | 1U << 8;
    (void)add(sample, "temperature", 1, "K");
    CU_ASSERT_TRUE_FATAL(compare(sample));
    CU_ASSERT_TRUE(error_called("P") == 0 && isnan(error_called("P_all")));
    CU_ASSERT_STRING_EQUAL(judgement.level[0].ignored, "temperature");
    P->given = 1U | 1U << 4;
    refused(sample, "holds no field that can be compared");
}

static void refuses_fields(void)
{
    static const struct {
        const char *name, *unit, *words;
        int width;
    } wrong[] = {
        {"u", "inch", "the unit of field u is [inch]; expected [m]", 3},
        {"u", NULL, "the unit of field u is missing", 3},
        {"u", "m", "field u has 1 numbers a point", 1},
        {"u", "m", "field u has 2 numbers a point", 2},
        {"P", "Pa", "field P has 3 numbers a point", 3},
        {"P", "Pa", "field P has 6 numbers a point", 6}, /* it is not symmetric */
        {"P", "Pa", "field P has 4 numbers a point", 4},
        {"pressure", "Pa", "field pressure has 3 numbers a point", 3},
        {"F", "m", "the unit of field F is [m]; expected [-]", 9},
        {"q", "m", "it has q", 3},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        begin("swinging-cube");
        struct verify_sample *sample = level(0.1);
        (void)add(sample, wrong[i].name, wrong[i].width, wrong[i].unit);
        refused(sample, wrong[i].words);
    }
    begin("swinging-cube");
    struct verify_sample *sample = level(0.1);
    (void)add(sample, "u", 3, "m");
    (void)add(sample, "displacement", 3, "m");
    refused(sample, "fields u and displacement are two names of one field");
}

static void refuses_places_and_times(void)
{
    begin("swinging-cube");
    struct verify_sample *sample = level(0.1);
    (void)add_stress(sample, "P", 1, "Pa");
    sample->X[4] = 1 + 1e-15;
    CU_ASSERT_TRUE(compare(sample)); /* round-off */
    sample->X[4] = 1.001;
    refused(sample, "point 1, (0.5, 1.001, 0.5) m, lies 0.001 m outside the body of \"swinging-cube\"");
    sample->X[4] = 1 + 1e-7;
    refused(sample, "outside the body");
    sample->single = true;
    CU_ASSERT_TRUE(compare(sample));
    sample->X[4] = 0.5;
    (void)snprintf(sample->unit, sizeof sample->unit, "km");
    refused(sample, "outside the body");
    (void)snprintf(sample->unit, sizeof sample->unit, "ft");
    refused(sample, "the unit of the points is [ft]");
    (void)snprintf(sample->unit, sizeof sample->unit, "m");
    sample->dim = 2;
    refused(sample, "points have 2 coordinates; the oracle \"swinging-cube\" is 3D");
    sample->dim = 3;
    sample->time.value = NAN;
    refused(sample, "does not say its time");
    CU_ASSERT_TRUE(verify_judge_level(&truth, sample, 1e-3, NAN, &judgement.level[0], &why));
    sample->time.value = 1;
    (void)snprintf(sample->time.unit, sizeof sample->time.unit, "ms");
    CU_ASSERT_TRUE(verify_judge_level(&truth, sample, NAN, NAN, &judgement.level[0], &why));
    CU_ASSERT_EQUAL(judgement.level[0].time, 1e-3);
    CU_ASSERT_TRUE(near(judgement.level[0].error[VERIFY_NORMS * VERIFY_P], 0));
    sample->time.value = -1;
    refused(sample, "is of t = -0.001 s; every oracle begins at t = 0");
    sample->time.value = 1;
    CU_ASSERT_FALSE(verify_judge_level(&truth, sample, 2e-3, NAN, &judgement.level[0], &why));
    CU_ASSERT_PTR_NOT_NULL(strstr(why.text, "but --time says"));
    CU_ASSERT_FALSE(verify_judge_level(&truth, sample, NAN, 0.2, &judgement.level[0], &why));
    CU_ASSERT_PTR_NOT_NULL(strstr(why.text, "but --spacing says"));
    (void)snprintf(sample->h.unit, sizeof sample->h.unit, "mm");
    sample->h.value = 250;
    CU_ASSERT_TRUE(verify_judge_level(&truth, sample, NAN, NAN, &judgement.level[0], &why));
    CU_ASSERT_DOUBLE_EQUAL(judgement.level[0].h, 0.25, 1e-15);
}

/* Where no body is, or not yet. */
static void gaps_are_outside(void)
{
    begin("rod-impact");
    struct verify_sample *sample = level(0.1);
    (void)add(sample, "u", 3, "m");
    for (size_t a = 0; a < 5; a++) {
        sample->X[3 * a] = 0.5;
    }
    CU_ASSERT_TRUE(compare(sample));
    sample->X[3] = 1.00005;
    refused(sample, "lies 5e-05 m outside the body");
}

/* Errors of h^2 at 0.4, 0.2, 0.1, given in another order. */
static void orders_and_gates(void)
{
    static const double h[] = {0.2, 0.1, 0.4};
    static const char *const holds[] = {"P=0.0101", "rate P=1.99", "P_l1=0.0101"}, *const fails[] = {"rate P=2.01"};
    begin("swinging-cube");
    for (size_t i = 0; i < 3; i++) {
        struct verify_sample *sample = level(h[i]);
        (void)add_stress(sample, "P", 1 + h[i] * h[i], "Pa");
        CU_ASSERT_TRUE_FATAL(compare(sample));
    }
    CU_ASSERT_TRUE_FATAL(verify_judge_order(&judgement, &why));
    CU_ASSERT_TRUE(judgement.level[0].h == 0.4 && judgement.level[2].h == 0.1);
    CU_ASSERT_TRUE(isnan(judgement.level[0].rate[VERIFY_NORMS * VERIFY_P]));
    CU_ASSERT_TRUE(fabs(judgement.level[2].rate[VERIFY_NORMS * VERIFY_P] - 2) < 1e-9);
    CU_ASSERT_TRUE(strncmp(verify_judge_verdict(&judgement), "NOT JUDGED", 10) == 0);
    CU_ASSERT_TRUE(verify_judge_gates(&judgement, holds, 3, false, &why));
    CU_ASSERT_TRUE(judgement.gates.pass && judgement.gates.count == 3);
    CU_ASSERT_TRUE(strncmp(verify_judge_verdict(&judgement), "PASS", 4) == 0);
    CU_ASSERT_TRUE(verify_judge_gates(&judgement, fails, 1, false, &why));
    CU_ASSERT_TRUE(!judgement.gates.pass && !judgement.gates.gate[3].pass);
    CU_ASSERT_TRUE(strncmp(verify_judge_verdict(&judgement), "FAIL", 4) == 0);
    CU_ASSERT_TRUE(verify_judge_gates(&judgement, &(const char *){"P=1"}, 1, true, &why));
    CU_ASSERT_STRING_EQUAL(judgement.gates.gate[4].name, "rate P");
    CU_ASSERT_TRUE(judgement.gates.gate[4].pass && !judgement.gates.pass);
    static const char *const norms[] = {"l1", "max"};
    CU_ASSERT_TRUE(verify_judge_shown(&judgement, norms, 2, &why));
    CU_ASSERT_EQUAL(judgement.shown_count, 5); /* of P and P_all, and P itself, which is gated */
}

static void refuses_gates(void)
{
    unit_untrapped();
    static const struct {
        const char *gate, *words;
    } wrong[] = {
        {"P", "expected NAME=number"},      {"P=", "expected NAME=number"},
        {"P=much", "expected NAME=number"}, {"P=1e999", "expected NAME=number"},
        {"P=nan", "expected NAME=number"},  {"=1", "no error of that name"},
        {"Q=1", "no error of that name"},   {"rate Q=1", "no error of that name"},
        {"v=1", "field v is missing"},      {"probes=1", "no error of that name"},
    };
    begin("swinging-cube");
    struct verify_sample *sample = level(0.1);
    (void)add_stress(sample, "P", 1, "Pa");
    CU_ASSERT_TRUE_FATAL(compare(sample));
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        CU_ASSERT_FALSE(verify_judge_gates(&judgement, &wrong[i].gate, 1, false, &why));
        if (strstr(why.text, wrong[i].words) == NULL) {
            printf("%s: %s\n", wrong[i].gate, why.text);
        }
        CU_ASSERT_PTR_NOT_NULL(strstr(why.text, wrong[i].words));
    }
    CU_ASSERT_FALSE(verify_judge_shown(&judgement, &(const char *){"l3"}, 1, &why));
}

static void refuses_levels_that_do_not_match(void)
{
    for (int fault = 0; fault < 4; fault++) {
        static const char *const words[] = {"levels must be of one time", "the same spacing",
                                            "says of its spacing something else", "field P is missing"};
        begin("swinging-cube");
        for (int i = 0; i < 2; i++) {
            struct verify_sample *sample = level(fault == 1 ? 0.1 : 0.1 + i);
            (void)add_stress(sample, fault == 3 && i == 1 ? "sigma" : "P", 1, "Pa");
            sample->time.value = fault == 0 && i == 1 ? 1.1e-3 : 1e-3;
            if (fault == 2 && i == 1) {
                sample->h.value = NAN;
                sample->n = 8;
            }
            CU_ASSERT_TRUE_FATAL(compare(sample));
        }
        CU_ASSERT_FALSE(verify_judge_order(&judgement, &why));
        CU_ASSERT_PTR_NOT_NULL(strstr(why.text, words[fault]));
    }
}

/* A name that two fields go by would be compared with either: with pressures of both signs, for instance. */
static void every_name_is_of_one_field(void)
{
    for (const struct oracle_kind *const *kind = oracle_kinds(); *kind != NULL; kind++) {
        size_t fields = verify_judged_count(*kind);
        for (size_t i = VERIFY_STATE_FIELDS; i < fields; i++) {
            for (size_t j = 0; j < i; j++) {
                bool other = !verify_judged_is(*kind, j, verify_judged_field(*kind, i).name);
                if (!other) {
                    printf("%s: %s\n", (*kind)->name, verify_judged_field(*kind, i).name);
                }
                CU_ASSERT_TRUE(other);
            }
        }
        CU_ASSERT_TRUE(fields <= VERIFY_JUDGED_FIELDS);
    }
}

/* Scalars that the oracle has beside the state, at a time that it reaches and at one that it does not. */
static void extras_and_reach(void)
{
    begin("plate-impact-stiffened");
    struct verify_sample *sample = verify_samples_add(&given, "made.h5", &why);
    CU_ASSERT_TRUE_FATAL(sample != NULL && verify_sample_points(sample, 2, 1, &why));
    double reach = truth.kind->reach(truth.oracle), value[ORACLE_EXTRAS];
    sample->needs_units = sample->has_unit = true;
    (void)snprintf(sample->unit, sizeof sample->unit, "m");
    sample->time = (struct verify_sample_number){.value = reach / 2, .unit = "s", .has_unit = true};
    struct verify_sample_field *density = add(sample, "density", 1, "kg/m^3");
    for (size_t a = 0; a < 2; a++) {
        truth.kind->extras(truth.oracle, sample->X + 3 * a, reach / 2, value);
        density->value[a] = 1.01 * value[0];
    }
    CU_ASSERT_TRUE_FATAL(compare(sample));
    CU_ASSERT_TRUE(near(error_called("density"), 0.01) && near(error_called("density_max"), 0.01));
    char meaning[VERIFY_JUDGED_MEANING];
    CU_ASSERT_STRING_EQUAL(verify_judged_meaning(truth.kind, verify_judged_find(truth.kind, "density_abs"), meaning),
                           "absolute L2 error of the mass per current volume");
    CU_ASSERT_STRING_EQUAL(verify_judged_unit(truth.kind, verify_judged_find(truth.kind, "density_abs")), "kg/m^3");
    sample->time.value = reach * 2;
    refused(sample, "reaches to");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"an offset is measured in every norm", an_offset_is_measured_in_every_norm},
        {"weights count", weights_count},
        {"names, shapes and units", names_shapes_and_units},
        {"what is not all there", what_is_not_all_there},
        {"refuses fields", refuses_fields},
        {"refuses places and times", refuses_places_and_times},
        {"gaps are outside", gaps_are_outside},
        {"orders and gates", orders_and_gates},
        {"refuses gates", refuses_gates},
        {"every name is of one field", every_name_is_of_one_field},
        {"extras and reach", extras_and_reach},
        {"refuses levels that do not match", refuses_levels_that_do_not_match},
    };
    int code = unit_main("verify: judge", tests, sizeof tests / sizeof *tests);
    verify_samples_free(&given);
    verify_truth_free(&truth);
    return sample_files_end(code);
}
