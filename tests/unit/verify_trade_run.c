/* What a run of a study of costs is said to cost, against what a run by itself says. */
#include "solver/scene.h"
#include "tests/unit/unit.h"
#include "verify/find.h"
#include "verify/simulate.h"
#include "verify/trade_run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { N = 20 };
static struct verify_options options = {.operand = {"plastic-wave"}, .operand_count = 1};
static struct verify_trader trader; /* too large for a stack */
static struct verify_trade trade;
static struct solver_error error;

/* Facts of the same run, by itself. */
static struct solver_facts facts_of(const struct verify_trade_run *run)
{
    static char store[VERIFY_TRADE_STORE];
    struct verify_options with = options;
    struct solver_scene *scene = NULL;
    struct solver_run *alone = NULL;
    CU_ASSERT_TRUE_FATAL(verify_trade_configure(trader.scene, run, store, &with, &error) &&
                         verify_scene_open(&with, run->n, &scene, &error) && verify_run_create(scene, &alone, &error) &&
                         solver_run_to(alone, scene->t_end, NULL, NULL, &error));
    struct solver_facts facts = solver_run_facts(alone);
    solver_run_free(alone);
    solver_scene_free(scene);
    return facts;
}

static struct verify_trade_run measured_at(int n, const char *words)
{
    struct verify_trade_run run = {.n = n, .end = VERIFY_LEFT_OUT};
    (void)snprintf(run.words, sizeof run.words, "%s", words);
    CU_ASSERT_TRUE_FATAL(verify_trade_measure(&trader, &run, &error));
    return run;
}

static struct verify_trade_run measured(const char *words)
{
    return measured_at(N, words);
}

static void prepare(void)
{
    struct solver_scene *scene = NULL;
    CU_ASSERT_TRUE_FATAL(verify_scene_open(&options, 0, &scene, &error));
    trader = (struct verify_trader){.options = &options, .scene = scene, .trade = &trade, .deadline = INFINITY};
    trade.error_count = 1;
    strcpy(trade.error_name[0], "P_l1");
}

static void finish(void)
{
    verify_trader_free(&trader);
    solver_scene_free((struct solver_scene *)trader.scene);
}

static void costs(void)
{
    static const struct {
        const char *words;
        int stages;
    } cases[] = {{"stencil=sbp2 integrator=euler cfl=0.1", 1},
                 {"stencil=sbp2 integrator=tvd-rk2 cfl=0.3", 2},
                 {"stencil=sbp4 integrator=rk4 cfl=0.8", 4}};
    prepare();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct verify_trade_run run = measured(cases[i].words);
        struct solver_facts facts = facts_of(&run);
        double evaluations = (double)facts.steps * cases[i].stages;
        CU_ASSERT_EQUAL(run.end, VERIFY_MEASURED);
        CU_ASSERT(facts.steps > 10 && facts.particles > N && facts.pairs > N);
        CU_ASSERT(run.particles == facts.particles && run.pairs == facts.pairs && run.steps == facts.steps);
        CU_ASSERT_EQUAL(run.evaluations, evaluations);
        CU_ASSERT_EQUAL(run.cost[VERIFY_PAIRS], evaluations * (double)facts.pairs);
        CU_ASSERT_DOUBLE_EQUAL(run.cost[VERIFY_BYTES] / (double)facts.steps / (double)facts.particles,
                               facts.step_traffic, 1e-9 * facts.step_traffic);
        CU_ASSERT(run.cost[VERIFY_SECONDS] > 0 && run.repeats == 1 && isnan(run.noise));
        CU_ASSERT(run.error[0] > 0 && run.error[0] < 1);
    }
    finish();
}

static void other_ends(void)
{
    prepare();
    struct verify_trade_run refused = measured("stencil=sbp4 perturb=0.1");
    CU_ASSERT_EQUAL(refused.end, VERIFY_REFUSED);
    CU_ASSERT_STRING_NOT_EQUAL(refused.why, "");
    unit_untrapped(); /* steps too large by far */
    struct verify_trade_run broken = measured_at(100, "integrator=rk4 cfl=4");
    CU_ASSERT_EQUAL(broken.end, VERIFY_BROKE);
    unit_trapped();
    trader.deadline = -INFINITY;
    struct verify_trade_run late = measured("integrator=rk4 cfl=0.5");
    CU_ASSERT_EQUAL(late.end, VERIFY_LEFT_OUT);
    finish();
}

/* Timed again: the fastest of all times is kept. */
static void the_best_time(void)
{
    prepare();
    struct verify_trade_run run = measured("stencil=sbp2 integrator=tvd-rk2 cfl=0.3");
    run.cost[VERIFY_SECONDS] = 1e-9;
    CU_ASSERT_TRUE(verify_trade_time(&trader, &run, run.threads, 2, &error));
    CU_ASSERT(run.cost[VERIFY_SECONDS] == 1e-9 && run.repeats == 3 && run.noise > 1);
    run.cost[VERIFY_SECONDS] = 1e9;
    run.noise = NAN;
    CU_ASSERT_TRUE(verify_trade_time(&trader, &run, run.threads, 2, &error));
    CU_ASSERT(run.cost[VERIFY_SECONDS] < 1e3 && run.repeats == 5 && run.noise < 1e3);
    finish();
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"costs", costs},
        {"other ends", other_ends},
        {"the best time", the_best_time},
    };
    return unit_main("trade run", tests, sizeof tests / sizeof *tests);
}
