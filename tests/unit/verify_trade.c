/* Costs against errors: fronts, what is cheapest, which configurations there are, and the file that a study is kept in.
 */
#include "tests/unit/scene_files.h"
#include "tests/unit/trades.h"
#include "verify/report_trade.h"

#include "solver/scheme.h"
#include "solver/stencil.h"

#include <math.h>

static void front_is(size_t count, const double *e, const double *c, const char *expected)
{
    bool front[8];
    char found[9] = "";
    verify_pareto(count, e, c, front);
    for (size_t i = 0; i < count; i++) {
        found[i] = front[i] ? '1' : '0';
        found[i + 1] = '\0';
    }
    CU_ASSERT_STRING_EQUAL(found, expected);
}

static void fronts(void)
{
    front_is(0, NULL, NULL, "");
    front_is(1, (const double[]){1}, (const double[]){1}, "1");
    front_is(3, (const double[]){1, 2, 3}, (const double[]){3, 2, 1}, "111");
    front_is(3, (const double[]){1, 2, 3}, (const double[]){1, 2, 3}, "100");
    front_is(4, (const double[]){1, 2, 2, 3}, (const double[]){3, 2, 2, 1}, "1101"); /* the first of equals */
    front_is(3, (const double[]){1, 1, 2}, (const double[]){2, 1, 1}, "010");        /* equal in one */
    front_is(4, (const double[]){NAN, 2, INFINITY, 1}, (const double[]){0, 2, 0, NAN}, "0100");
    front_is(2, (const double[]){0, 1}, (const double[]){1, 1}, "10");
}

static void choices(void)
{
    char text[VERIFY_ADVICE], value[SOLVER_NAME];
    double decade[16];
    begin();
    CU_ASSERT_TRUE(verify_trade_fronts(&trade, &error));
    const bool expected[5][VERIFY_COSTS] = {{1, 1, 1}, {1, 1, 1}, {0, 0, 1}, {0, 0, 0}, {1, 1, 1}};
    for (size_t i = 0; i < trade.run_count; i++) {
        CU_ASSERT_EQUAL(memcmp(trade.run[i].front, expected[i], sizeof expected[i]), 0);
    }
    CU_ASSERT_EQUAL(verify_trade_cheapest(&trade, 0, 5e-3, VERIFY_SECONDS, false), 1);
    CU_ASSERT_EQUAL(verify_trade_cheapest(&trade, 0, 4.9e-3, VERIFY_SECONDS, false), 2);
    CU_ASSERT_EQUAL(verify_trade_cheapest(&trade, 0, 4.9e-3, VERIFY_PAIRS, false), 0);
    CU_ASSERT_EQUAL(verify_trade_cheapest(&trade, 0, 5e-3, VERIFY_SECONDS, true), 0);
    CU_ASSERT_EQUAL(verify_trade_cheapest(&trade, 0, 1e-6, VERIFY_SECONDS, false), trade.run_count);
    CU_ASSERT_EQUAL(verify_trade_cheapest(&trade, 1, 3e-4, VERIFY_SECONDS, false), 3); /* NaN reaches nothing */
    CU_ASSERT_EQUAL(verify_trade_cheapest(&trade, 1, 1e-9, VERIFY_SECONDS, false), trade.run_count);
    CU_ASSERT_EQUAL(verify_trade_best(&trade, 0), 4);
    CU_ASSERT_EQUAL(verify_trade_error(&trade, "figure period"), 1);
    CU_ASSERT_EQUAL(verify_trade_error(&trade, "u"), 2);
    verify_trade_advise(&trade, 0, 1e-2, text);
    CU_ASSERT_PTR_NOT_NULL(strstr(text, "choose upwind sbp2 cfl=0.8 at n = 8: 1 s"));
    CU_ASSERT_PTR_NOT_NULL(strstr(text, "0.25 of the scene's own (4 s at n = 8)"));
    verify_trade_advise(&trade, 0, 1e-6, text);
    CU_ASSERT_PTR_NOT_NULL(strstr(text, "nothing measured reaches p <= 1e-06; the best was 1.000e-05 by upwind sbp4"));
    trade.run[4].own = false;
    verify_trade_advise(&trade, 0, 1e-4, text);
    CU_ASSERT_PTR_NOT_NULL(strstr(text, "the scene's own configuration does not reach it"));
    /* 0.1, where the worst that is of use is below 1, to 1e-6, which nothing reaches */
    CU_ASSERT_EQUAL(verify_trade_decades(&trade, 0, decade, 16), 6);
    CU_ASSERT_DOUBLE_EQUAL(decade[0], 0.1, 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(decade[5], 1e-6, 1e-18);
    trade.run_count = 1;
    verify_trade_short(&trade, &trade.run[0], text);
    CU_ASSERT_STRING_EQUAL(text, trade.run[0].words); /* nothing varies */
    CU_ASSERT_TRUE(verify_trade_word("a=1 bc=d", "bc", value) && strcmp(value, "d") == 0);
    CU_ASSERT_FALSE(verify_trade_word("a=1 bc=d", "c", value));
    CU_ASSERT_FALSE(verify_trade_word("a=1 bc=d", "b", value));
    trade.run_count = 0;
    verify_trade_advise(&trade, 0, 1e-4, text);
    CU_ASSERT_STRING_EQUAL(text, "nothing was measured");
    CU_ASSERT_EQUAL(verify_trade_decades(&trade, 0, decade, 16), 0);
}

/* --- configurations --- */

static const char traded[] = "trade = { half = { cfl = 0.7 }, ['a b'] = { E1 = 2 } } parameters = { E1 = 1 }";

static void plan(char *const *words, int count, struct solver_scene **scene)
{
    struct verify_options options;
    const struct verify_command command = {
        .name = "trade", .takes = VERIFY_TAKES_SET | VERIFY_TAKES_VARY | VERIFY_TAKES_LEVELS, .most = 1};
    verify_trade_free(&trade);
    CU_ASSERT_TRUE_FATAL(verify_options_parse(&command, count, words, &options, &error));
    CU_ASSERT_TRUE_FATAL(solver_scene_load(path, options.override, options.override_count, scene, &error));
    CU_ASSERT_TRUE_FATAL(verify_trade_begin(*scene, &trade, &error));
    trade.level[trade.level_count++] = 4;
    trade.level[trade.level_count++] = 8;
    CU_ASSERT_TRUE_FATAL(verify_trade_axes(&options, *scene, &trade, &error));
    CU_ASSERT_TRUE_FATAL(verify_trade_plan(*scene, &trade, &error));
}

static size_t with(const char *key, const char *wanted)
{
    size_t found = 0;
    for (size_t i = 0; i < trade.run_count; i++) {
        char value[SOLVER_NAME];
        found += verify_trade_word(trade.run[i].words, key, value) && strcmp(value, wanted) == 0;
    }
    return found;
}

static size_t count_of(const char *key)
{
    size_t i = 0;
    while (i < trade.axis_count && strcmp(trade.axis[i].key, key) != 0) {
        i++;
    }
    return i < trade.axis_count ? trade.axis[i].count : 0;
}

/* Schemes on a stencil vary that, its support if it has one, and the evolved set; others have a support. */
static size_t expected_runs(void)
{
    size_t builders = 0, kinds = 0;
    for (const struct solver_stencil_builder *b = solver_stencil_builders(); b->name != NULL; b++) {
        builders += b->lattice_only ? 1 : count_of("support");
    }
    for (const struct solver_scheme *const *scheme = solver_schemes(); *scheme != NULL; scheme++) {
        kinds += (*scheme)->stencil ? builders * count_of("evolved") : count_of("support");
    }
    return kinds * count_of("integrator") * count_of("cfl") * count_of("precision");
}

static void configurations(void)
{
    struct solver_scene *scene = NULL;
    write_changed(NULL, "");
    plan(NULL, 0, &scene);
    CU_ASSERT_EQUAL_FATAL(trade.axis_count, 7);
    CU_ASSERT_EQUAL(trade.run_count, expected_runs());
    CU_ASSERT_EQUAL(with("scheme", "ulsph"),
                    count_of("support") * count_of("integrator") * count_of("cfl") * count_of("precision"));
    CU_ASSERT(count_of("support") == 3 && count_of("cfl") == 3); /* the scene's own are among the usual ones */
    CU_ASSERT_TRUE(trade.run[0].own && trade.run[0].distance == 0);
    for (size_t i = 1; i < trade.run_count; i++) {
        CU_ASSERT_FALSE(trade.run[i].own);
        CU_ASSERT_TRUE(trade.run[i].distance >= trade.run[i - 1].distance && trade.run[i].distance > 0);
    }
    CU_ASSERT_STRING_EQUAL(trade.run[0].words, "scheme=upwind stencil=sbp4 evolved=pFHJ integrator=rk4 cfl=0.8 "
                                               "precision=double");
    solver_scene_free(scene);
    char *const narrow[] = {"-s", "scheme=jst", "-v", "stencil=sbp2,closed", "-v", "jst.kappa4=0.01,0.02",
                            "-s", "evolved=pF", "-s", "precision=double",    "-v", "cfl=0.2",
                            "-v", "support=2",  "-v", "ulsph.delta=0,1",     "-v", "integrator=rk4"};
    plan(narrow, sizeof narrow / sizeof *narrow, &scene);
    CU_ASSERT_EQUAL(trade.run_count, 1 + 2 * 2); /* the scene's own too, which --vary leaves out */
    CU_ASSERT_EQUAL(with("ulsph.delta", "0"), 0);
    CU_ASSERT_EQUAL(with("support", "2"), 2);
    solver_scene_free(scene);
}

static void variants(void)
{
    struct solver_scene *scene = NULL;
    struct verify_options options = {.override_count = 0};
    char store[VERIFY_TRADE_STORE];
    write_changed(NULL, traded);
    char *const narrow[] = {"-s", "scheme=upwind",  "-v", "stencil=sbp2", "-s", "evolved=pF",
                            "-s", "integrator=rk4", "-s", "cfl=0.8",      "-s", "precision=double"};
    plan(narrow, sizeof narrow / sizeof *narrow, &scene);
    CU_ASSERT_EQUAL(scene->variant_count, 2);
    CU_ASSERT_EQUAL(trade.run_count, 1 + 3);
    size_t named = 0;
    for (size_t i = 0; i < trade.run_count; i++) {
        named += strcmp(trade.run[i].variant, "a b") == 0;
    }
    CU_ASSERT_EQUAL(named, 1);
    snprintf(trade.run[1].variant, SOLVER_NAME, "a b");
    CU_ASSERT_TRUE(verify_trade_configure(scene, &trade.run[1], store, &options, &error));
    CU_ASSERT_EQUAL_FATAL(options.override_count, 2);
    CU_ASSERT_STRING_EQUAL(options.override[0], "E1=2");
    CU_ASSERT_STRING_EQUAL(options.override[1], "stencil=sbp2");
    snprintf(trade.run[1].variant, SOLVER_NAME, "none");
    CU_ASSERT_FALSE(verify_trade_configure(scene, &trade.run[1], store, &options, &error));
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "trade has no \"none\""));
    solver_scene_free(scene);
}

/* From a level to the next: what nothing of its kind beats, and what was refused, which may be for want of particles.
 */
static void promotion(void)
{
    begin();
    trade.run_count = 0;
    trade.level_count = 2;
    trade.level[1] = 16;
    add("scheme=upwind stencil=sbp2 cfl=0.8", 8, 5e-3, 0, 1, 40);
    add("scheme=upwind stencil=sbp2 cfl=0.5", 8, 6e-3, 0, 1, 50);             /* beaten by the first */
    add("scheme=upwind stencil=sbp4 cfl=0.5", 8, 6e-3, 0, 1, 50);             /* by one of another kind */
    add("scheme=upwind stencil=sbp4 cfl=0.8", 8, 7e-3, 0, 1, 60)->own = true; /* beaten, and the scene's own */
    add("scheme=upwind stencil=sbp4 cfl=0.9", 8, 0, 0, 1, 0)->end = VERIFY_BROKE;
    add("scheme=upwind stencil=sph cfl=0.9", 8, 0, 0, 1, 0)->end = VERIFY_REFUSED;
    CU_ASSERT_TRUE(verify_trade_promote(&trade, 1, &error));
    CU_ASSERT_EQUAL_FATAL(trade.run_count, 11);
    static const char *const order[] = {"scheme=upwind stencil=sbp4 cfl=0.8", "scheme=upwind stencil=sbp2 cfl=0.8",
                                        "scheme=upwind stencil=sph cfl=0.9", "scheme=upwind stencil=sbp2 cfl=0.5",
                                        "scheme=upwind stencil=sbp4 cfl=0.5"};
    for (size_t i = 0; i < 5; i++) {
        const struct verify_trade_run *run = &trade.run[6 + i];
        CU_ASSERT_STRING_EQUAL(run->words, order[i]);
        CU_ASSERT_EQUAL(run->n, 16);
        CU_ASSERT_EQUAL(run->end, VERIFY_LEFT_OUT);
        CU_ASSERT_STRING_EQUAL(run->why, i == 3 ? "beaten at n = 8 by another of its kind" : "");
        CU_ASSERT_STRING_EQUAL(run->by, i == 3 ? "scheme=upwind stencil=sbp2 cfl=0.8" : "");
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"fronts", fronts},     {"choices", choices},     {"configurations", configurations},
        {"variants", variants}, {"promotion", promotion},
    };
    int result = scene_files_main("trade", tests, sizeof tests / sizeof *tests);
    verify_trade_free(&trade);
    return result;
}
