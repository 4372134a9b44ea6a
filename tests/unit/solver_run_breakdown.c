/* Runs that break down, or should not start: what they say, and what they leave. */
#include "solver/integrator.h"
#include "tests/unit/runs.h"

static bool all_finite(size_t count, const double *values)
{
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(values[i])) {
            return false;
        }
    }
    return true;
}

/* The output is a state that the run could have gone on from. */
static void check_output(struct sample *sample)
{
    struct solver_output output = output_of(sample);
    size_t count = output.cloud->count;
    size_t dim = (size_t)output.cloud->dim;
    CU_ASSERT(isfinite(output.time));
    const double *vectors[] = {output.u, output.v, output.p};
    const double *tensors[] = {output.sigma, output.F, output.H, output.P}; /* the last three where there is an F */
    for (int i = 0; i < 3; i++) {
        CU_ASSERT(all_finite(count * dim, vectors[i]));
    }
    for (int i = 0; i < (output.F != NULL ? 4 : 1); i++) {
        CU_ASSERT(all_finite(count * dim * dim, tensors[i]));
    }
    CU_ASSERT(all_finite(count, output.J));
    CU_ASSERT(all_finite(count, output.pressure));
    CU_ASSERT(all_finite(count, output.von_mises));
    bool linear = output.F != NULL && solver_material_find(sample->scene->material_model)->in[0]->linear;
    for (size_t a = 0; !linear && a < count; a++) {
        CU_ASSERT(output.J[a] > 0.0);
    }
}

/* Whether the message begins with the step after the last good one, and names a particle and its place. */
static bool names_place(const char *text, const struct solver_output *output)
{
    const double *X = output->cloud->X;
    size_t dim = (size_t)output->cloud->dim;
    char expected[256];
    int length = snprintf(expected, sizeof expected, "step %zu, t = ", output->step + 1);
    if (length < 0 || strncmp(text, expected, (size_t)length) != 0) {
        return false;
    }
    char *rest;
    CU_ASSERT(strtod(text + length, &rest) > output->time);
    for (size_t a = 0; a < output->cloud->count; a++, X += dim) {
        (void)snprintf(expected, sizeof expected, " s: particle %zu at X = (%g, %g, %g) m: ", a, X[0],
                       dim > 1 ? X[1] : 0.0, dim > 2 ? X[2] : 0.0);
        if (strncmp(rest, expected, strlen(expected)) == 0) {
            return true;
        }
    }
    return false;
}

/* Runs until it breaks down; checks the message against the run, and that another attempt says the same. */
static void break_down(const char *more, const char *settings, const char *field)
{
    struct sample sample = start(more, "%s", settings);
    CU_ASSERT_FALSE_FATAL(solver_run_steps(sample.run, 5000, &sample.error));
    CU_ASSERT_EQUAL(sample.error.code, SOLVER_BROKE_DOWN);
    struct solver_output output = output_of(&sample);
    bool named = strstr(sample.error.text, field) != NULL && names_place(sample.error.text, &output);
    if (!named) {
        printf("\n    %s: \"%s\" does not name %s", settings, sample.error.text, field);
    }
    CU_ASSERT(named);
    const struct solver_scene *scene = sample.scene;
    bool could_evolve_more = strcmp(scene->scheme, "ulsph") != 0 && scene->evolved != SOLVER_PFHJ;
    CU_ASSERT_PTR_NOT_NULL(strstr(sample.error.text, "Try "));
    CU_ASSERT_EQUAL(strstr(sample.error.text, "evolved = \"pFHJ\"") != NULL, could_evolve_more);
    check_output(&sample);
    struct solver_error again;
    CU_ASSERT_FALSE(solver_run_steps(sample.run, 1, &again));
    CU_ASSERT_STRING_EQUAL(again.text, sample.error.text);
    finish(&sample);
}

static const char implosion[] =
    "initial = { velocity = function(X, Y, Z) return first(-60 * (X - 0.5), -50 * (Y - 0.5), -40 * (Z - 0.5)) end }\n";

static void test_inverted(void)
{
    static const char *const settings[] = {"dim=3 evolved=pF",   "dim=3 evolved=pFJ",
                                           "dim=3 evolved=pFHJ", "dim=2 evolved=pF integrator=rk4",
                                           "dim=1 evolved=pF",   "dim=3 evolved=pF stencil=closed support=2.1"};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        break_down(implosion, settings[i], "Jacobian J");
    }
}

/* Far beyond the stability limit a linear body grows until its numbers overflow. */
static void test_unstable(void)
{
    unit_untrapped();
    static const char *const settings[] = {
        "dim=3 cfl=10 material.model=linear-elastic evolved=pF",
        "dim=3 cfl=10 material.model=linear-elastic evolved=pFHJ integrator=rk4",
        "dim=2 cfl=10 material.model=linear-elastic evolved=pFJ integrator=ssp-rk3",
        "dim=1 cfl=10 material.model=linear-elastic evolved=pF",
    };
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        break_down(smooth_motion, settings[i], "finite");
    }
    break_down(smooth_motion, "dim=3 cfl=10 evolved=pFHJ", "J");
}

/* So do particles that leave their neighbours, or go past them, before these could feel it, whatever the integrator;
 * where they fall onto one another at the start, the run does not. */
static void test_moving_neighbours(void)
{
    for (const struct solver_integrator *integrator = solver_integrators(); integrator->name != NULL; integrator++) {
        for (int i = 0; i < 6; i++) {
            static const char apart[] = "initial = { velocity = function(X, Y, Z)\n"
                                        "    return first(50 * (X - 0.5), 50 * (Y - 0.5), 50 * (Z - 0.5)) end }\n";
            char settings[128];
            (void)snprintf(settings, sizeof settings, "dim=%d scheme=ulsph material.model=linear-elastic integrator=%s",
                           i / 2 + 1, integrator->name);
            break_down(i % 2 == 0 ? apart : implosion, settings, "density rho would change by ");
        }
    }
    static const char unstable[] = "cfl=10 scheme=ulsph material.model=linear-elastic integrator=rk4";
    break_down(smooth_motion, unstable, "density rho");
    static const char collapsed[] = "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2 }\n"
                                    "initial = { displacement = function(X) return 0.5 - X end,\n"
                                    "            F = function() return 1 end }\n";
    struct solver_error error = refusal(collapsed, "dim=1 n=1100 scheme=ulsph");
    CU_ASSERT_EQUAL(error.code, SOLVER_BROKE_DOWN);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "particle 0: more than 1024 others are nearer than"));
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "the particles have collapsed onto one another"));
}

/* A run to a time breaks down like one of steps, and its history ends before. */
static void test_run_to(void)
{
    struct sample sample = start(implosion, "dim=3 evolved=pF");
    CU_ASSERT_FALSE_FATAL(solver_run_to(sample.run, 1.0, NULL, NULL, &sample.error));
    CU_ASSERT_EQUAL(sample.error.code, SOLVER_BROKE_DOWN);
    const struct solver_history *history = solver_run_history(sample.run);
    CU_ASSERT_FATAL(history->count > 0);
    CU_ASSERT(history->totals[history->count - 1].time <= output_of(&sample).time);
    for (size_t row = 0; row < history->count; row++) {
        CU_ASSERT(isfinite(history->totals[row].kinetic) && isfinite(history->totals[row].strain));
    }
    check_output(&sample);
    finish(&sample);
}

/* A linear body that is a little unstable has no J <= 0 and no number that overflows for long: its energy stops it,
 * soon after there is ten times of what there was. */
static void test_energy_gained(void)
{
    struct sample sample =
        start(smooth_motion, "dim=1 cfl=1.8 material.model=linear-elastic evolved=pF history=100000");
    CU_ASSERT_FALSE_FATAL(solver_run_to(sample.run, 1000.0, NULL, NULL, &sample.error));
    CU_ASSERT_EQUAL(sample.error.code, SOLVER_BROKE_DOWN);
    CU_ASSERT_PTR_NOT_NULL(strstr(sample.error.text, "were ever put in: the run is unstable. Linear momentum p is"));
    CU_ASSERT_PTR_NOT_NULL(strstr(sample.error.text, " m/s at particle "));
    const struct solver_history *history = solver_run_history(sample.run);
    const struct solver_totals *row = history->totals;
    size_t last = history->count - 1;
    double first = row[0].kinetic + row[0].strain;
    CU_ASSERT_FATAL(last > 1);
    CU_ASSERT(row[last].kinetic + row[last].strain > 10.0 * first);
    CU_ASSERT(row[last - 1].kinetic + row[last - 1].strain <= 10.0 * first);
    finish(&sample);
}

/* Nor does a moved face hide it: what it can have put in at most is known. What it does put in, for a while, by a pulse
 * that is over before the only row of the history, is no gain. */
static void test_energy_gained_beside_a_moved_face(void)
{
    static const char pulse[] =
        "faces = { X0 = { kind = 'motion', free_after = 0.5,\n"
        "    value = function(X, Y, Z, t) return first(0.01 * sin(2 * math.pi * t), 0, 0) end } }\n";
    struct sample sample = start(pulse, "dim=1 cfl=1.8 material.model=linear-elastic evolved=pF history=100000");
    CU_ASSERT_FALSE_FATAL(solver_run_to(sample.run, 1000.0, NULL, NULL, &sample.error));
    CU_ASSERT_EQUAL(sample.error.code, SOLVER_BROKE_DOWN);
    CU_ASSERT_PTR_NOT_NULL(strstr(sample.error.text, "J were ever put in: the run is unstable"));
    finish(&sample);
    sample = start(pulse, "dim=1 cfl=0.3 material.model=linear-elastic evolved=pF history=1");
    CU_ASSERT_FATAL(solver_run_to(sample.run, 1.0, NULL, NULL, &sample.error));
    const struct solver_history *history = solver_run_history(sample.run);
    CU_ASSERT(history->totals[history->count - 1].kinetic > 0.0);
    CU_ASSERT_EQUAL(history->totals[0].kinetic + history->totals[0].strain, 0.0);
    finish(&sample);
}

/* A body at rest, turned, has no strain but that of round-off, whose energy may be less than none: no gain. */
static void test_turned_at_rest(void)
{
    static const char turned[] = "initial = { displacement = function(X, Y, Z)\n"
                                 "    return math.cos(0.7) * X - math.sin(0.7) * Y - X, math.sin(0.7) * X + "
                                 "math.cos(0.7) * Y - Y end }\n";
    static const char held[] = "faces = { X0 = { kind = 'motion', value = function() return 0, 0 end } }\n";
    char both[1024];
    (void)snprintf(both, sizeof both, "%s%s", turned, held);
    const char *const scenes[] = {turned, both};
    for (size_t i = 0; i < 2; i++) {
        struct sample sample = start(scenes[i], "dim=2 n=8 stencil=sbp2 evolved=pFHJ");
        CU_ASSERT_FATAL(solver_run_to(sample.run, 10.0, NULL, NULL, &sample.error));
        CU_ASSERT(solver_run_history(sample.run)->totals[0].strain < 1e-13);
        finish(&sample);
    }
}

/* The field that is broken is the one named. */
static void test_field_is_named(void)
{
    unit_untrapped();
    static const char fast[] = "initial = { velocity = function(X, Y, Z) return first(0, 1e200, 0) end }\n";
    struct solver_error error = refusal(fast, "dim=2");
    CU_ASSERT_EQUAL(error.code, SOLVER_BROKE_DOWN);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "linear momentum p"));
    static const char folded[] = "initial = { displacement = function(X, Y, Z) return first(-2 * X, 0, 0) end }\n";
    error = refusal(folded, "dim=2");
    CU_ASSERT_EQUAL(error.code, SOLVER_BROKE_DOWN);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "Jacobian J <= 0"));
    static const char torn[] = "initial = { F = function() return 1e160, 0, 0, 1e160 end }\n";
    error = refusal(torn, "dim=2");
    CU_ASSERT_EQUAL(error.code, SOLVER_BROKE_DOWN);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "deformation gradient F"));
}

/* What is turned inside out at the start is named before any stress is asked for: with traps on, as tests have them, a
 * logarithm of it would end the program. */
static void test_inverted_at_start(void)
{
    static const char *const materials[] = {"model = 'hencky'", "model = 'hencky', yield_stress = 0.1",
                                            "model = 'neo-hookean'", "model = 'neo-hookean-polyconvex'"};
    static const char *const settings[] = {"dim=1 evolved=pF",    "dim=2 evolved=pF", "dim=2 evolved=pFHJ",
                                           "dim=3 evolved=pFJ",   "dim=2 scheme=jst", "dim=3 precision=single",
                                           "dim=2 stencil=closed"};
    for (size_t i = 0; i < sizeof materials / sizeof *materials * (sizeof settings / sizeof *settings); i++) {
        char text[256];
        const char *words = settings[i / 4];
        if (i % 4 == 1 && strstr(words, "precision=single") != NULL) {
            continue; /* it knows no plastic flow */
        }
        (void)snprintf(text, sizeof text,
                       "material = { %s, E = 3, nu = 0.3, rho = 2 }\n"
                       "initial = { displacement = function(X, Y, Z) return first(-2 * X, 0, 0) end }\n",
                       materials[i % 4]);
        struct solver_error error = refusal(text, "%s", words);
        CU_ASSERT_EQUAL(error.code, SOLVER_BROKE_DOWN);
        static const char expected[] = "step 0, t = 0 s: particle 0 at X = (0, 0, 0) m: the particle is turned inside "
                                       "out, Jacobian J <= 0. Try ";
        if (strncmp(error.text, expected, strlen(expected)) != 0) {
            printf("\n    %s, %s: \"%s\"", materials[i % 4], words, error.text);
            CU_FAIL("the particle is not named");
        }
    }
}

/* A formula that fails later stops the run with the formula's error. */
static void test_formula_fails(void)
{
    unit_untrapped();
    static const char late[] = "faces = { X0 = { kind = 'motion', value = function(X, Y, Z, t)\n"
                               "    if t > 0.2 then return 0 / 0, 0, 0 end return 0.01, 0, 0 end } }\n";
    struct sample sample = start(late, "dim=3");
    CU_ASSERT_FALSE(solver_run_to(sample.run, 1.0, NULL, NULL, &sample.error));
    CU_ASSERT_EQUAL(sample.error.code, SOLVER_BAD_INPUT);
    CU_ASSERT_PTR_NOT_NULL(strstr(sample.error.text, "faces.X0"));
    CU_ASSERT(output_of(&sample).time < 0.2 + 0.1);
    check_output(&sample);
    finish(&sample);
}

/* Whichever stage a formula fails in, the output is the state after the last whole step. */
static void test_formula_fails_within_a_step(void)
{
    unit_untrapped();
    static const char *const late[] = {"return first(t > %s and 0 / 0 or 0.3, 0, 0)", "return first(0.3, 0, 0)"};
    static const char *const kinds[] = {"body_force = function(X, Y, Z, t) %s end\n",
                                        "faces = { X0 = { kind = 'traction', value = function(X, Y, Z, t) %s end } }\n",
                                        "faces = { X0 = { kind = 'motion', value = function(X, Y, Z, t) %s end } }\n"};
    static const char *const times[] = {"0.2", "0.225", "0.25", "0.275"};
    for (size_t i = 0; i < 12; i++) {
        char value[128], bad[256], good[256];
        (void)snprintf(value, sizeof value, late[0], times[i % 4]);
        (void)snprintf(bad, sizeof bad, kinds[i / 4], value);
        (void)snprintf(good, sizeof good, kinds[i / 4], late[1]);
        struct sample broken = start(bad, "dim=2 integrator=rk4"), whole = start(good, "dim=2 integrator=rk4");
        CU_ASSERT_FALSE(solver_run_steps(broken.run, 100, &broken.error));
        CU_ASSERT_EQUAL(broken.error.code, SOLVER_BAD_INPUT);
        struct solver_output output = output_of(&broken);
        CU_ASSERT(output.step > 0);
        advance(&whole, output.step);
        struct solver_output expected = output_of(&whole);
        size_t bytes = output.cloud->count * sizeof(double);
        CU_ASSERT_EQUAL(output.time, expected.time);
        CU_ASSERT_EQUAL(memcmp(output.u, expected.u, 2 * bytes), 0);
        CU_ASSERT_EQUAL(memcmp(output.v, expected.v, 2 * bytes), 0);
        CU_ASSERT_EQUAL(memcmp(output.F, expected.F, 4 * bytes), 0);
        CU_ASSERT_EQUAL(memcmp(output.P, expected.P, 4 * bytes), 0);
        finish(&broken);
        finish(&whole);
    }
}

/* A time step that has collapsed, and an end that no number of steps reaches, are said at once. */
static void test_steps_collapse(void)
{
    static const char *const settings[] = {"dim=2 cfl=1e-300", "dim=2 t_end=1e300", "dim=1 cfl=1e-14"};
    for (size_t i = 0; i < 3; i++) {
        struct sample sample = start("", "%s", settings[i]);
        CU_ASSERT_FALSE(solver_run_to(sample.run, sample.scene->t_end, NULL, NULL, &sample.error));
        CU_ASSERT_EQUAL(sample.error.code, SOLVER_BROKE_DOWN);
        CU_ASSERT_PTR_NOT_NULL(strstr(sample.error.text, "is too small to reach t_end"));
        CU_ASSERT_PTR_NOT_NULL(strstr(sample.error.text, "take a larger cfl"));
        CU_ASSERT_EQUAL(output_of(&sample).step, 0);
        check_output(&sample);
        finish(&sample);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"turned inside out", test_inverted},
        {"turned inside out at the start", test_inverted_at_start},
        {"unstable until not finite", test_unstable},
        {"neighbours that move", test_moving_neighbours},
        {"on the way to t_end", test_run_to},
        {"energy gained", test_energy_gained},
        {"turned and at rest", test_turned_at_rest},
        {"energy gained beside a moved face", test_energy_gained_beside_a_moved_face},
        {"a time step that has collapsed", test_steps_collapse},
        {"the broken field is the one named", test_field_is_named},
        {"a formula that fails on the way", test_formula_fails},
        {"a formula that fails within a step leaves the step before", test_formula_fails_within_a_step},
    };
    return unit_main("breakdown", tests, sizeof tests / sizeof *tests);
}
