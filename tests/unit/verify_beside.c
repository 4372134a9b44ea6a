/* Histories of two configurations compared, and which configuration is beside which. */
#include "tests/unit/scratch.h"
#include "tests/unit/unit.h"
#include "verify/beside.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS = 9, PROBES = 2 };

static struct solver_error error;

static double cubic(size_t probe, int axis, double t)
{
    double a = (double)probe + 1, b = (double)axis - 1;
    return a + b * t - 2 * a * t * t + (b + 0.5) * t * t * t;
}

/* Rows at uneven times from 0 to 2, of motions that are cubic in time. */
struct rows {
    struct solver_totals totals[ROWS];
    double u[ROWS * PROBES * 3];
    struct solver_history history;
};

static void fill(struct rows *rows, size_t count, double unevenness)
{
    rows->history =
        (struct solver_history){.count = count, .totals = rows->totals, .probe_count = PROBES, .probe_u = rows->u};
    for (size_t i = 0; i < count; i++) {
        double s = count > 1 ? (double)i / (double)(count - 1) : 0;
        double t = 2 * (s + unevenness * s * (1 - s));
        rows->totals[i].time = t;
        for (size_t j = 0; j < PROBES * 3; j++) {
            rows->u[i * PROBES * 3 + j] = cubic(j / 3, (int)(j % 3), t);
        }
    }
}

static void cubics_are_exact(void)
{
    struct rows rows;
    struct verify_motion motion;
    fill(&rows, ROWS, 0.7);
    CU_ASSERT_FATAL(verify_motion_take(&rows.history, &motion, &error));
    for (int i = 0; i <= 200; i++) {
        double t = 2.0 * i / 200, u[3];
        for (size_t probe = 0; probe < PROBES; probe++) {
            verify_motion_at(&motion, probe, t, u);
            for (int axis = 0; axis < 3; axis++) {
                CU_ASSERT_DOUBLE_EQUAL(u[axis], cubic(probe, axis, t), 1e-13);
            }
        }
    }
    verify_motion_free(&motion);
}

/* Of a sine, the error falls with the fourth power of the time between rows. */
static void order_of_interpolation(void)
{
    static struct solver_totals totals[81];
    static double u[81 * 3];
    double worst[2] = {0, 0};
    for (int fine = 0; fine < 2; fine++) {
        const struct solver_history history = {
            .count = fine ? 81 : 41, .totals = totals, .probe_count = 1, .probe_u = u};
        struct verify_motion motion;
        for (size_t i = 0; i < history.count; i++) {
            totals[i].time = 6.0 * (double)i / (double)(history.count - 1);
            u[3 * i] = sin(totals[i].time);
        }
        CU_ASSERT_FATAL(verify_motion_take(&history, &motion, &error));
        for (int i = 0; i <= 1000; i++) {
            double t = 6.0 * i / 1000, at[3];
            verify_motion_at(&motion, 0, t, at);
            worst[fine] = fmax(worst[fine], fabs(at[0] - sin(t)));
        }
        verify_motion_free(&motion);
    }
    CU_ASSERT(worst[1] > 0 && log2(worst[0] / worst[1]) > 3.7);
}

static void rows_few_and_none(void)
{
    struct rows rows;
    struct verify_motion motion;
    double u[3];
    for (size_t count = 0; count <= 3; count++) {
        fill(&rows, count, 0);
        CU_ASSERT_FATAL(verify_motion_take(&rows.history, &motion, &error));
        verify_motion_at(&motion, 1, 0, u);
        CU_ASSERT(count > 0 ? u[0] == cubic(1, 0, 0) : isnan(u[0]));
        if (count == 2) { /* linear then */
            verify_motion_at(&motion, 1, 1, u);
            CU_ASSERT_DOUBLE_EQUAL(u[2], 0.5 * (cubic(1, 2, 0) + cubic(1, 2, 2)), 1e-13);
        }
        verify_motion_free(&motion);
    }
    fill(&rows, ROWS, 0);
    CU_ASSERT_FATAL(verify_motion_take(&rows.history, &motion, &error));
    static const double outside[] = {-1e-9, 2 + 1e-9, NAN, INFINITY};
    for (size_t i = 0; i < 4; i++) { /* nothing is made up beyond the rows */
        verify_motion_at(&motion, 0, outside[i], u);
        CU_ASSERT(isnan(u[0]) && isnan(u[1]) && isnan(u[2]));
    }
    verify_motion_free(&motion);
}

/* One motion at other times differs by nothing; a shift in one component shows, and so does a NaN on either side. */
static void differences(void)
{
    struct rows here, there;
    struct verify_beside beside = {.scene = NULL};
    double value[VERIFY_ERRORS];
    fill(&here, 7, 0.2);
    fill(&there, ROWS, -0.5);
    CU_ASSERT_FATAL(verify_beside_measure(&beside, &here.history, value, &error));
    CU_ASSERT(isnan(value[VERIFY_BESIDE]) && isnan(value[VERIFY_BESIDE_ABS])); /* nothing was run */
    CU_ASSERT_FATAL(verify_motion_take(&there.history, &beside.motion, &error));
    CU_ASSERT_FATAL(verify_beside_measure(&beside, &here.history, value, &error));
    CU_ASSERT(value[VERIFY_BESIDE] < 1e-14 && value[VERIFY_BESIDE_ABS] < 1e-13);
    double size = 0;
    for (size_t i = 0; i < 7 * PROBES * 3; i++) {
        size += here.u[i] * here.u[i];
    }
    for (size_t row = 0; row < 7; row++) {
        here.u[(row * PROBES + 1) * 3 + 2] += 0.3; /* one probe of two */
    }
    CU_ASSERT_FATAL(verify_beside_measure(&beside, &here.history, value, &error));
    CU_ASSERT_DOUBLE_EQUAL(value[VERIFY_BESIDE_ABS], 0.3 * sqrt(0.5), 1e-13);
    CU_ASSERT_DOUBLE_EQUAL(value[VERIFY_BESIDE], sqrt(7 * 0.09 / size), 1e-13);
    here.u[4] = NAN;
    CU_ASSERT_FATAL(verify_beside_measure(&beside, &here.history, value, &error));
    CU_ASSERT(isnan(value[VERIFY_BESIDE]) && isnan(value[VERIFY_BESIDE_ABS]));
    fill(&here, 7, 0.2);
    here.totals[6].time = 2.5; /* later than what is beside */
    CU_ASSERT_FATAL(verify_beside_measure(&beside, &here.history, value, &error));
    CU_ASSERT(isnan(value[VERIFY_BESIDE]) && isnan(value[VERIFY_BESIDE_ABS]));
    verify_beside_free(&beside);
}

static const char plate[] = TEST_SOURCE_DIR "/verify/scenes/rotating-plate.lua";

/* Opens the plate with the words and what is beside it; false if either is refused. */
static bool open_plate(size_t count, const char *const *words, struct solver_scene **scene,
                       struct verify_beside *beside)
{
    struct verify_options options = {.operand_count = 1, .operand = {plate}, .override_count = count};
    memcpy(options.override, words, count * sizeof *words);
    return solver_scene_load(plate, words, count, scene, &error) &&
           verify_beside_open(&options, *scene, beside, &error);
}

static void which_is_beside(void)
{
    static const char *const words[] = {"scheme=ulsph", "n=10", "cfl=0.3", "parameters.omega=50", "t_end=0.01"};
    struct solver_scene *scene = NULL;
    struct verify_beside beside;
    double omega = 0;
    CU_ASSERT_FATAL(open_plate(5, words, &scene, &beside));
    CU_ASSERT_PTR_NOT_NULL_FATAL(beside.scene);
    CU_ASSERT_STRING_EQUAL(beside.scene->scheme, "upwind");
    CU_ASSERT_STRING_EQUAL(beside.scene->material_model, "neo-hookean"); /* the file's other branch */
    CU_ASSERT_EQUAL(beside.scene->n, 50);
    CU_ASSERT(beside.scene->cfl == 0.3 && beside.scene->t_end == 0.01); /* the user's other words hold for both */
    CU_ASSERT(solver_scene_number(beside.scene, "omega", &omega) && omega == 50);
    CU_ASSERT_STRING_EQUAL(beside.label, "n = 50, scheme = upwind");
    CU_ASSERT_STRING_EQUAL(beside.label_of_study, "n = 10, scheme = ulsph");
    verify_beside_free(&beside);
    solver_scene_free(scene);
    static const char *const same[] = {"scheme=upwind", "n=50"};
    CU_ASSERT_FATAL(open_plate(2, same, &scene, &beside));
    CU_ASSERT_PTR_NULL(beside.scene);
    solver_scene_free(scene);
    CU_ASSERT_FATAL(open_plate(1, same, &scene, &beside)); /* another n */
    CU_ASSERT_PTR_NOT_NULL(beside.scene);
    verify_beside_free(&beside);
    solver_scene_free(scene);
}

/* A scene of its own, written to a file with `more` at its end; what the loader or the study says against it. */
static void refused(const char *more, const char *says)
{
    char path[SCRATCH];
    scratch_text(path,
                 "title, dim, n, t_end = 'block', 2, 4, 1\nparameters = { a = 1 }\n"
                 "domain = { lower = {0, 0}, upper = {1, 1} }\n"
                 "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2 }\n"
                 "probes = { { name = 'corner', X = {1, a} } }\n%s\n",
                 more);
    struct verify_options options = {.operand_count = 1, .operand = {path}};
    struct verify_beside beside = {.scene = NULL};
    struct solver_scene *scene = NULL;
    bool opened =
        solver_scene_load(path, NULL, 0, &scene, &error) && verify_beside_open(&options, scene, &beside, &error);
    CU_ASSERT_FALSE(opened);
    bool said = !opened && strstr(error.text, says) != NULL;
    if (!said) {
        printf("\n    %s: %s", more, opened ? "accepted" : error.text);
    }
    CU_ASSERT(said);
    verify_beside_free(&beside);
    solver_scene_free(scene);
    (void)remove(path);
}

static void refusals(void)
{
    refused("beside = 3", "beside: expected { KEY = value, ... }");
    refused("beside = { 1, 2 }", "beside: expected names as keys");
    refused("beside = { shceme = 'upwind' }", "no plain key and no parameter");
    refused("beside = { scheme = 'upwid' }", "beside.scheme");
    refused("beside = { cfl = -1 }", "beside.cfl");
    refused("beside = { cfl = 'fast' }", "beside.cfl");
    refused("beside = { t_end = 2 }", "both configurations have the same t_end");
    refused("beside = { dim = 3 }", "both configurations have the same dim");
    refused("beside = { a = 0.5 }", "other probes");
    refused("beside = { a = 2 }", "outside the domain"); /* the other configuration is checked as any scene is */
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"cubic motions are exact", cubics_are_exact},
        {"order of the interpolation", order_of_interpolation},
        {"few rows, none, and times beyond them", rows_few_and_none},
        {"differences", differences},
        {"which configuration is beside", which_is_beside},
        {"refusals", refusals},
    };
    return unit_main("beside", tests, sizeof tests / sizeof *tests);
}
