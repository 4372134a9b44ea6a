/* The configuration that --error picks from a study, and what is refused. */
#include "tests/unit/scene_files.h"
#include "tests/unit/trades.h"
#include "verify/trade_pick.h"

static char study[SCRATCH];
static struct solver_scene *scene;

/* A study of the plain scene: what is cheapest in time is not so in pairs. */
static void keep_study(void)
{
    write_changed(NULL, "");
    solver_scene_free(scene);
    verify_trade_free(&trade);
    CU_ASSERT_TRUE_FATAL(solver_scene_load(path, NULL, 0, &scene, &error));
    CU_ASSERT_TRUE_FATAL(verify_trade_begin(scene, &trade, &error));
    CU_ASSERT_TRUE_FATAL(verify_trade_reserve(&trade, 8, &error));
    trade.error_count = 2;
    strcpy(trade.error_name[0], "p");
    strcpy(trade.error_name[1], "figure period");
    add("scheme=upwind cfl=0.8", 8, 1e-2, 1e-6, 1, 100)->own = true;
    add("scheme=upwind cfl=0.3", 16, 5e-4, 3e-4, 3, 900)->threads = 2;
    add("scheme=jst cfl=0.8", 16, 9e-4, NAN, 5, 300);
    add("scheme=upwind cfl=0.8", 32, 1e-5, 1e-6, 30, 3000);
    CU_ASSERT_TRUE_FATAL(verify_trade_write(&trade, study, &error));
}

static bool opens(const char *asked, const char *override, struct verify_pick *pick)
{
    struct verify_options options = {.error = asked, .study = study, .operand = {"here/scene.lua"}, .operand_count = 1};
    if (override != NULL) {
        options.override[options.override_count++] = override;
    }
    error = (struct solver_error){.code = SOLVER_OK};
    (void)fputc('\n', stdout);
    return verify_pick_open(&options, scene, pick, &error);
}

static void picks(const char *asked, size_t expected)
{
    struct verify_pick pick;
    CU_ASSERT_TRUE_FATAL(opens(asked, NULL, &pick));
    CU_ASSERT_STRING_EQUAL(pick.run.words, trade.run[expected].words);
    CU_ASSERT_EQUAL(pick.run.n, trade.run[expected].n);
    CU_ASSERT_EQUAL(pick.level.n, trade.run[expected].n);
    verify_pick_free(&pick);
}

static void the_fastest_that_reaches_it(void)
{
    keep_study();
    picks("0.1", 0);
    picks("1e-3", 1);
    picks("5e-4", 1);
    picks("4.9e-4", 3);
    picks("p=1e-3", 1);
    picks("figure period=1e-3", 0);
}

static void what_the_run_is_told(void)
{
    struct verify_pick pick;
    keep_study();
    CU_ASSERT_TRUE_FATAL(opens("1e-3", NULL, &pick));
    CU_ASSERT_EQUAL_FATAL(pick.options.override_count, 3);
    CU_ASSERT_STRING_EQUAL(pick.options.override[0], "scheme=upwind");
    CU_ASSERT_STRING_EQUAL(pick.options.override[1], "cfl=0.3");
    CU_ASSERT_STRING_EQUAL(pick.options.override[2], "threads=2");
    verify_pick_free(&pick);
    scene->threads = 1; /* the scene says how many */
    CU_ASSERT_TRUE_FATAL(opens("1e-3", NULL, &pick));
    CU_ASSERT_EQUAL(pick.options.override_count, 2);
    verify_pick_free(&pick);
}

static void refused(const char *asked, const char *override, const char *says)
{
    struct verify_pick pick;
    CU_ASSERT_FALSE(opens(asked, override, &pick));
    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
    if (strstr(error.text, says) == NULL) {
        printf("\n    %s", error.text);
    }
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, says));
    verify_pick_free(&pick);
}

static void refusals(void)
{
    keep_study();
    refused("1e-6", NULL, "nothing measured reaches p <= 1e-06");
    refused("q=1e-3", NULL, "the study has no error q; it has p, figure period");
    refused("0", NULL, "expected a number above 0");
    refused("1e-3x", NULL, "expected a number above 0");
    refused("1e-3", "n=8", "n is what --error picks");
    strcpy(trade.scene, "another");
    CU_ASSERT_TRUE_FATAL(verify_trade_write(&trade, study, &error));
    refused("1e-3", NULL, "a study of the scene another");
    keep_study();
    write_changed(NULL, "-- another text");
    solver_scene_free(scene);
    CU_ASSERT_TRUE_FATAL(solver_scene_load(path, NULL, 0, &scene, &error));
    refused("1e-3", NULL, "the scene has changed since the study");
    keep_study();
    solver_scene_free(scene);
    CU_ASSERT_TRUE_FATAL(solver_scene_load(path, (const char *[]){"material.E=11"}, 1, &scene, &error));
    refused("1e-3", NULL, "other keys are overridden than then (none)");
    unlink(study);
    refused("1e-3", NULL, "make one: assay trade here/scene.lua"); /* as it was called */
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"the fastest that reaches it", the_fastest_that_reaches_it},
        {"what the run is told", what_the_run_is_told},
        {"refusals", refusals},
    };
    scratch_file(study);
    int result = scene_files_main("trade pick", tests, sizeof tests / sizeof *tests);
    unlink(study);
    verify_trade_free(&trade);
    solver_scene_free(scene);
    return result;
}
