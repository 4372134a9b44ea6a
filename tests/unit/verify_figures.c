/* Figures: what is refused, and what the measures find in made-up motions and profiles. */
#include "tests/unit/unit.h"
#include "verify/figures.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { ROWS = 2001 };
static double times[ROWS], motion[ROWS];

/* A damped oscillation about an offset, with another motion added: `rows` rows over 4.3 s. */
static double period_of(size_t rows, double T, double damping, double offset, double other)
{
    for (size_t i = 0; i < rows; i++) {
        double t = 4.3 * (double)i / (double)(rows - 1);
        times[i] = t;
        motion[i] = offset + 2e-3 * exp(-damping * t) * sin(2 * M_PI * t / T + 0.3) + other * sin(40 * t);
    }
    return verify_period_fit(rows, times, motion, NULL);
}

static void clean_oscillations(void)
{
    for (int i = 0; i < 20; i++) {
        double T = 0.3 + 0.13 * i; /* 14 to 1.5 periods */
        CU_ASSERT_DOUBLE_EQUAL(period_of(201, T, 0, 0, 0), T, 1e-9 * T);
        CU_ASSERT_DOUBLE_EQUAL(period_of(ROWS, T, 0, 5e-4, 0), T, 1e-9 * T);
        CU_ASSERT_DOUBLE_EQUAL(period_of(201, T, 0.2, -5e-4, 0), T, 1e-9 * T);
    }
}

/* A second mode of 2 % moves the period of least squares by far less than itself. */
static void another_mode(void)
{
    double T = 0.5, found = period_of(ROWS, T, 0, 0, 4e-5);
    CU_ASSERT_DOUBLE_EQUAL(found, T, 2e-4 * T);
    CU_ASSERT(found != T);
}

/* No period, and why. */
static void says(size_t rows, const char *words)
{
    const char *why = NULL;
    CU_ASSERT(isnan(verify_period_fit(rows, times, motion, &why)));
    CU_ASSERT_FATAL(why != NULL);
    CU_ASSERT_PTR_NOT_NULL(strstr(why, words));
}

static void no_oscillation(void)
{
    CU_ASSERT(isnan(period_of(201, 9, 0, 0, 0))); /* half a period */
    says(201, "fewer than three times, so that one and a half periods are not there; set t_end higher");
    for (size_t i = 0; i < 201; i++) {
        motion[i] = 3;
    }
    says(201, "does not move");
    for (size_t i = 0; i < 201; i++) {
        motion[i] = (double)((i * i * 7919 + i * 104729) % 1009); /* noise */
    }
    says(201, "no damped oscillation explains half");
    says(0, "fewer than 10 rows");
    says(9, "fewer than 10 rows; set history");
    const char *why = NULL;
    (void)period_of(201, 0.5, 0, 0, 0);
    CU_ASSERT(isfinite(verify_period_fit(201, times, motion, &why)));
    CU_ASSERT_PTR_NULL(why);
    unit_untrapped();
    motion[77] = NAN;
    CU_ASSERT(isnan(verify_period_fit(201, times, motion, NULL)));
}

static struct verify_point point[64];

/* A parabola of height -7 about X = 0.313, between particles. */
static void peaks(void)
{
    for (size_t i = 0; i < 64; i++) {
        double X = (double)i / 63;
        point[i] = (struct verify_point){.X = X, .computed = -7 + 30 * (X - 0.313) * (X - 0.313)};
    }
    CU_ASSERT_DOUBLE_EQUAL(verify_peak(64, point, 0, 0.7), -7, 1e-12);
    CU_ASSERT(isnan(verify_peak(64, point, 0.4, 0.7))); /* the largest lies at an end of the window: no peak */
    CU_ASSERT(isnan(verify_peak(64, point, 2, 3)));
    CU_ASSERT(isnan(verify_peak(64, point, 0, 0.01)));
    point[20].X += 0.004; /* uneven spacing */
    point[20].computed = -7 + 30 * (point[20].X - 0.313) * (point[20].X - 0.313);
    CU_ASSERT_DOUBLE_EQUAL(verify_peak(64, point, 0, 0.7), -7, 1e-12);
    point[5].computed = NAN;
    CU_ASSERT(isnan(verify_peak(64, point, 0, 0.7)));
}

static struct solver_scene *scene;
static struct verify_truth truth;
static struct solver_error error;

static void open_scene(const char *name)
{
    char path[512];
    verify_truth_free(&truth);
    solver_scene_free(scene);
    (void)snprintf(path, sizeof path, TEST_SOURCE_DIR "/verify/scenes/%s.lua", name);
    CU_ASSERT_FATAL(solver_scene_load(path, NULL, 0, &scene, &error) && verify_truth_open(scene, &truth, &error));
}

static struct verify_level level;

/* The exact profiles in place of computed ones. */
static void exact_snapshots(size_t count)
{
    static struct verify_point all[SOLVER_SNAPSHOTS][4097];
    level = (struct verify_level){.snapshot_count = scene->snapshot_count};
    for (size_t s = 0; s < scene->snapshot_count; s++) {
        level.snapshot[s] = (struct verify_snapshot){.time = scene->snapshot[s], .count = count, .point = all[s]};
        for (size_t i = 0; i < count; i++) {
            const double X[3] = {scene->upper[0] * (double)i / (double)(count - 1), 0, 0};
            struct oracle_state state;
            truth.kind->state(truth.oracle, X, scene->snapshot[s], &state);
            all[s][i] = (struct verify_point){.X = X[0], .computed = state.P[0], .exact = state.P[0]};
        }
    }
}

static const struct verify_figure *figure_of(const char *name)
{
    for (size_t i = 0; i < scene->figure_count; i++) {
        if (strcmp(scene->figure[i].name, name) == 0) {
            return &level.figure[i];
        }
    }
    CU_FAIL_FATAL("the scene has no such figure");
    return NULL;
}

/* The measures of the exact solution give the oracle's own figures, and what is put there on purpose. */
static void of_the_exact_wave(void)
{
    const struct solver_history none = {.count = 0};
    open_scene("bimaterial-wave");
    CU_ASSERT_FATAL(verify_figures_check(scene, &truth, &error));
    exact_snapshots(4097);
    CU_ASSERT_FATAL(verify_figures_measure(scene, &truth, &none, NULL, &level, &error));
    CU_ASSERT(figure_of("reflection")->error < 1e-8 && figure_of("transmission")->error < 1e-8);
    CU_ASSERT_DOUBLE_EQUAL(figure_of("reflection")->exact, 0.40583, 5e-6);
    CU_ASSERT_DOUBLE_EQUAL(figure_of("transmission")->exact, 1.40583, 5e-6);
    CU_ASSERT(figure_of("ahead of the front")->measured == 0);
    double peak = 0;
    for (size_t i = 0; i < 4097; i++) {
        level.snapshot[1].point[i].computed *= 1.01; /* the incident pulse, 1 % too high */
        peak = fmax(peak, fabs(level.snapshot[1].point[i].exact));
    }
    level.snapshot[1].point[4000].computed = 0.02 * peak; /* where nothing has arrived */
    CU_ASSERT_FATAL(verify_figures_measure(scene, &truth, &none, NULL, &level, &error));
    CU_ASSERT_DOUBLE_EQUAL(figure_of("reflection")->error, 1 - 1 / 1.01, 1e-8);
    CU_ASSERT_DOUBLE_EQUAL(figure_of("ahead of the front")->error, 0.02, 1e-12);
    level.snapshot[1].point[4001].computed = NAN;
    CU_ASSERT_FATAL(verify_figures_measure(scene, &truth, &none, NULL, &level, &error));
    CU_ASSERT(isnan(figure_of("ahead of the front")->error));
}

/* Behind the pulse nothing is left either, but no front is coming: what stands there is not ahead. */
static void behind_is_not_ahead(void)
{
    const struct solver_history none = {.count = 0};
    open_scene("bimaterial-wave");
    exact_snapshots(4097);
    level.snapshot[1].point[5].computed = 1e9;
    CU_ASSERT_FATAL(verify_figures_measure(scene, &truth, &none, NULL, &level, &error));
    CU_ASSERT(figure_of("ahead of the front")->measured == 0);
}

static void refused(const char *expected)
{
    bool good = verify_figures_check(scene, &truth, &error);
    bool told = !good && error.code == SOLVER_BAD_INPUT && strstr(error.text, expected) != NULL;
    if (!told) {
        printf("\n    expected: %s\n         got: %s", expected, good ? "no error" : error.text);
    }
    CU_ASSERT(told);
}

static struct solver_figure *first_figure(void)
{
    open_scene("bimaterial-wave");
    scene->figure_count = 1;
    scene->figure[0] = (struct solver_figure){.name = "reflection",
                                              .measure = "stress ratio",
                                              .option_count = 2,
                                              .option = {{.name = "of", .count = 3, .number = {3e-4, 0, 1}},
                                                         {.name = "over", .count = 3, .number = {1e-4, 0, 1}}}};
    CU_ASSERT(verify_figures_check(scene, &truth, &error));
    return &scene->figure[0];
}

static void refusals(void)
{
    strcpy(first_figure()->measure, "stress");
    refused("figures.reflection: there is no measure \"stress\"; see assay list measures");
    strcpy(first_figure()->name, "reflexion");
    refused("figures.reflexion: the oracle \"bimaterial-wave\" has no figure of this name");
    first_figure()->option_count = 1;
    refused("figures.reflection: over: missing; expected { t [s], X0 [m], X1 [m] }, t being one of the snapshots");
    first_figure()->option[0].number[0] = 3.1e-4;
    refused("figures.reflection: of: expected { t [s], X0 [m], X1 [m] }");
    first_figure()->option[1].number[2] = -1;
    refused("figures.reflection: over: expected");
    first_figure()->option[1].count = 2;
    refused("figures.reflection: over: expected");
    struct solver_figure *figure = first_figure();
    figure->option_count = 3;
    strcpy(figure->option[2].name, "time");
    refused("figures.reflection: the measure \"stress ratio\" has no option \"time\"");
    figure = first_figure();
    *figure = (struct solver_figure){.name = "first echo", .measure = "period", .option_count = 1};
    figure->option[0] = (struct solver_option){.name = "probe", .text = "tip"};
    refused("figures.first echo: probe: expected the name of a probe");
    (void)first_figure();
    scene->dim = 2;
    refused("figures.reflection: the measure \"stress ratio\" is for dim = 1, the scene has dim = 2");
    figure = first_figure();
    *figure = (struct solver_figure){.name = "noise", .measure = "stress ahead", .option_count = 1};
    figure->option[0] = (struct solver_option){.name = "beyond", .number = {-1}, .count = 1};
    refused("figures.noise: beyond: expected { d }, a length [m]");
    figure->option[0].number[0] = 0.01;
    CU_ASSERT(verify_figures_check(scene, &truth, &error));
    scene->snapshot_count = 0;
    refused("figures.noise: the measure \"stress ahead\" needs snapshots");
    open_scene("swinging-cube");
    scene->dim = 1; /* for the oracle's sake alone */
    scene->figure_count = 1;
    scene->figure[0] = (struct solver_figure){.name = "noise", .measure = "stress ahead"};
    refused("figures.noise: the measure \"stress ahead\" needs an oracle that has fronts");
    scene->figure[0] = (struct solver_figure){.name = "flow", .measure = "plastic work", .option_count = 1};
    scene->figure[0].option[0] = (struct solver_option){.name = "expected", .number = {1}, .count = 1};
    refused("figures.flow: the measure \"plastic work\" is of a material with a yield stress");
    scene->hardening.yield = 1;
    CU_ASSERT(verify_figures_check(scene, &truth, &error));
    scene->figure[0].option[0].count = 2;
    refused("figures.flow: expected: expected { value }, a number");
    strcpy(scene->figure[0].measure, "plastic strain");
    scene->figure[0].option_count = 3;
    scene->figure[0].option[0].count = 1;
    scene->figure[0].option[1] = (struct solver_option){.name = "from", .number = {1, 2}, .count = 2};
    refused("figures.flow: from: expected { x, y }, as many numbers as dimensions [m]");
}

/* A probe that is carried along Y and has gone 5e-3 m aside on the way, by 3 and 4 along X and Z. */
static void drift_of_a_probe(void)
{
    double u[] = {0, 0, 0, 9, 9, 9, 0, 7, 0, 9, 9, 9, 3e-3, 8, -4e-3, 9, 9, 9, 1e-3, 9, 0, 9, 9, 9};
    const struct solver_history history = {.count = 4, .probe_count = 2, .probe_u = u}, none = {.count = 0};
    const struct verify_measuring in = {.history = &history}, nothing = {.history = &none};
    struct verify_argument argument[2] = {{.probe = 0}, {.axis = 1}};
    double value;
    CU_ASSERT(verify_drift(&in, argument, &value, &error));
    CU_ASSERT_DOUBLE_EQUAL(value, 5e-3, 1e-18);
    argument[1].axis = 0;
    CU_ASSERT(verify_drift(&in, argument, &value, &error));
    CU_ASSERT_DOUBLE_EQUAL(value, 9, 1e-15);
    argument[0].probe = 1;
    CU_ASSERT(verify_drift(&in, argument, &value, &error));
    CU_ASSERT_DOUBLE_EQUAL(value, 9 * sqrt(2), 1e-14);
    u[9] = u[10] = u[11] = NAN;
    CU_ASSERT(verify_drift(&in, argument, &value, &error) && isnan(value));
    CU_ASSERT(verify_drift(&nothing, argument, &value, &error) && isnan(value));
}

/* Energy falls from 10 to 4 J and rises by 2 J on the way, of which a load has done half; the most there was is 10 J.
 */
static void rise_of_the_energy(void)
{
    struct solver_totals totals[] = {{.kinetic = 6, .strain = 4},
                                     {.kinetic = 3, .strain = 2},
                                     {.kinetic = 2, .strain = 5, .external = 1},
                                     {.kinetic = 1, .strain = 4, .external = 1}};
    const struct solver_history history = {.count = 4, .totals = totals}, none = {.count = 0};
    const struct verify_measuring in = {.history = &history}, nothing = {.history = &none};
    double value;
    CU_ASSERT(verify_energy_rise(&in, NULL, &value, &error));
    CU_ASSERT_DOUBLE_EQUAL(value, 0.1, 1e-16);
    totals[2].external = totals[3].external = 3;
    CU_ASSERT(verify_energy_rise(&in, NULL, &value, &error) && value == 0);
    totals[1].strain = NAN;
    CU_ASSERT(verify_energy_rise(&in, NULL, &value, &error) && isnan(value));
    CU_ASSERT(verify_energy_rise(&nothing, NULL, &value, &error) && isnan(value));
}

/* Of a disc of which a half, or a quarter, is modelled the oracle's energies are as much; of a body of any shape nobody
 * knows how much of it the oracle's is. */
static void energies_of_the_part(void)
{
    double whole[2], part[2];
    open_scene("breathing-cylinder");
    for (int planes = 0; planes <= 2; planes++) {
        scene->symmetric[0] = planes > 0;
        scene->symmetric[1] = planes > 1;
        verify_truth_energy(&truth, scene, 1e-3, &part[0], &part[1]);
        if (planes == 0) {
            memcpy(whole, part, sizeof whole);
        }
        CU_ASSERT(part[0] > 0 && part[0] == whole[0] / (1 << planes) && part[1] == whole[1] / (1 << planes));
    }
    scene->domain.kind = SOLVER_SHAPE_SOLID;
    verify_truth_energy(&truth, scene, 1e-3, &part[0], &part[1]);
    CU_ASSERT(isnan(part[0]) && isnan(part[1]));
}

/* Of 10 J there were and 2 J that loads put in, 3 are there, 4 flowed, 2 went into dissipation and 1 into a wall: 2 J
 * are missing at the end, on the way 3 too many. */
static void balance_of_energies(void)
{
    struct solver_scene kept = {.balance = true}, other = {.path = "free.lua"};
    struct solver_totals totals[] = {
        {.kinetic = 6, .strain = 4},
        {.kinetic = 5, .strain = 4, .numerical = 3, .impact = 2, .plastic = 1, .external = 2},
        {.kinetic = 2, .strain = 1, .plastic = 4, .numerical = 2, .impact = 1, .external = 2}};
    const struct solver_history history = {.count = 3, .totals = totals}, none = {.count = 0};
    const struct verify_measuring in = {.history = &history, .scene = &kept},
                                  without = {.history = &history, .scene = &other};
    const struct verify_measuring nothing = {.history = &none, .scene = &kept};
    double value;
    CU_ASSERT(verify_energy_balance(&in, NULL, &value, &error));
    CU_ASSERT_DOUBLE_EQUAL(value, 0.3, 1e-15);
    totals[1].impact = -1;
    CU_ASSERT(verify_energy_balance(&in, NULL, &value, &error));
    CU_ASSERT_DOUBLE_EQUAL(value, 0.2, 1e-15);
    CU_ASSERT(verify_numerical_dissipation(&in, NULL, &value, &error));
    CU_ASSERT_DOUBLE_EQUAL(value, 0.2, 1e-15);
    CU_ASSERT(verify_impact_loss(&in, NULL, &value, &error));
    CU_ASSERT_DOUBLE_EQUAL(value, 0.1, 1e-15);
    CU_ASSERT(verify_energy_balance(&nothing, NULL, &value, &error) && isnan(value));
    CU_ASSERT(!verify_energy_balance(&without, NULL, &value, &error) &&
              !verify_impact_loss(&without, NULL, &value, &error));
    CU_ASSERT(strstr(error.text, "free.lua: figures: this one needs balance = true") != NULL);
}

/* Of a pressure that is solved for: iterations by all steps, volumes at their worst. */
static void of_a_pressure(void)
{
    struct verify_level run = {.facts = {.steps = 8}};
    struct solver_totals totals[] = {
        {.volume_change = 1e-3}, {.volume_change = 3e-3, .iterations = 9}, {.volume_change = 2e-3, .iterations = 20}};
    struct solver_history history = {.count = 3, .totals = totals, .incompressible = true};
    const struct verify_measuring in = {.history = &history, .level = &run};
    double value;
    CU_ASSERT(verify_iterations(&in, NULL, &value, &error) && value == 2.5);
    CU_ASSERT(verify_volume_change(&in, NULL, &value, &error) && value == 3e-3);
    history.incompressible = false;
    CU_ASSERT(verify_iterations(&in, NULL, &value, &error) && isnan(value));
    CU_ASSERT(verify_volume_change(&in, NULL, &value, &error) && isnan(value));
}

/* From the first press to the last, and the velocity of one body of three. */
static void of_contact(void)
{
    const struct solver_history history = {
        .contact_begin = 0.25, .contact_end = 0.75, .body_velocity = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}};
    const struct verify_measuring in = {.history = &history};
    const struct verify_argument second = {.body = 1};
    double value;
    CU_ASSERT(verify_contact_time(&in, NULL, &value, &error) && value == 0.5);
    CU_ASSERT(verify_body_velocity(&in, &second, &value, &error) && value == 4);
}

/* Two probes that lay 3 m apart along X and have moved to be 5 m apart; of 10 J and 2 J of work, 3 J are there and 4 J
 * flowed. */
static void distance_and_loss(void)
{
    double X[][3] = {{1, 0, 0}, {4, 0, 0}};
    double u[] = {9, 9, 9, 9, 9, 9, 0, 1, 0, 0, 1, 4};
    struct solver_totals totals[] = {{.kinetic = 6, .strain = 4},
                                     {.kinetic = 2, .strain = 1, .plastic = 4, .external = 2}};
    const struct solver_history history = {.count = 2, .probe_count = 2, .probe_u = u, .probe_X = X, .totals = totals};
    const struct solver_history none = {.count = 0};
    const struct verify_measuring in = {.history = &history}, nothing = {.history = &none};
    const struct verify_argument argument[] = {{.length = 7}, {.probe = 1}, {.probe = 0}};
    double value;
    CU_ASSERT(verify_distance(&in, argument, &value, &error));
    CU_ASSERT_DOUBLE_EQUAL(value, 5, 1e-15);
    CU_ASSERT(verify_distance(&nothing, argument, &value, &error) && isnan(value));
    CU_ASSERT(verify_energy_lost(&in, NULL, &value, &error));
    CU_ASSERT_DOUBLE_EQUAL(value, 0.5, 1e-15);
    CU_ASSERT(verify_energy_lost(&nothing, NULL, &value, &error) && isnan(value));
    open_scene("taylor-bar");
    CU_ASSERT_FATAL(verify_figures_check(scene, &truth, &error));
    scene->figure_count = 1;
    scene->figure[0] = (struct solver_figure){.name = "apart", .measure = "distance", .option_count = 3};
    scene->figure[0].option[0] = (struct solver_option){.name = "expected", .number = {10}, .count = 1};
    scene->figure[0].option[1] = (struct solver_option){.name = "from", .text = "foot"};
    scene->figure[0].option[2] = (struct solver_option){.name = "to", .text = "rim"};
    CU_ASSERT_FATAL(verify_figures_check(scene, &truth, &error));
    CU_ASSERT_FATAL(verify_figures_measure(scene, &truth, &history, NULL, &level, &error));
    CU_ASSERT(level.figure[0].exact == 10 && strcmp(level.figure[0].unit, "m") == 0);
    CU_ASSERT_DOUBLE_EQUAL(level.figure[0].error, 0.5, 1e-15);
    scene->figure[0].option[2].text[0] = 'R';
    refused("figures.apart: to: expected the name of a probe");
}

/* What symmetry alone says needs no oracle; all else does. */
static void without_an_oracle(void)
{
    open_scene("twisting-column");
    scene->figure_count = 1; /* the drift */
    CU_ASSERT(verify_figures_check(scene, &truth, &error));
    struct solver_option *axis = &scene->figure[0].option[strcmp(scene->figure[0].option[0].name, "probe") == 0];
    for (int k = -1; k < 5; k++) {
        axis->number[0] = k;
        if (k >= 1 && k <= 3) {
            CU_ASSERT(verify_figures_check(scene, &truth, &error));
        } else {
            refused("figures.drift: across: expected { k }, the k-th of the axes");
        }
    }
    strcpy(scene->figure[0].measure, "period");
    refused("figures.drift: the measure \"period\" is compared with an oracle, and the scene has none");
    strcpy(scene->figure[0].measure, "stress ahead");
    scene->dim = 1;
    refused("figures.drift: the measure \"stress ahead\" is compared with an oracle, and the scene has none");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"clean oscillations", clean_oscillations},
        {"another mode besides", another_mode},
        {"no oscillation has no period", no_oscillation},
        {"peaks", peaks},
        {"of the exact wave", of_the_exact_wave},
        {"behind is not ahead", behind_is_not_ahead},
        {"refusals", refusals},
        {"distance and loss", distance_and_loss},
        {"energies of the part that is modelled", energies_of_the_part},
        {"balance of energies", balance_of_energies},
        {"what a pressure takes", of_a_pressure},
        {"contact", of_contact},
        {"drift of a probe", drift_of_a_probe},
        {"rise of the energy", rise_of_the_energy},
        {"without an oracle", without_an_oracle},
    };
    int code = unit_main("figures", tests, sizeof tests / sizeof *tests);
    verify_truth_free(&truth);
    solver_scene_free(scene);
    return code;
}
