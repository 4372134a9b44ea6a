#include "verify/trade_run.h"

#include "verify/find.h"
#include "verify/level.h"
#include "verify/progress.h"
#include "verify/signals.h"
#include "verify/simulate.h"

#include "solver/integrator.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A run under way. */
struct attempt {
    const struct verify_trader *trader;
    const struct verify_truth *truth; /* NULL: it is only timed */
    struct solver_scene *scene;
    struct solver_run *run;
    bool late; /* given up */
};

/* A solver_progress that stops at the deadline, or when the program is asked to end. */
static bool watch(void *context, double time, double t_end, size_t step)
{
    struct attempt *attempt = context;
    (void)time;
    (void)t_end;
    (void)step;
    attempt->late = verify_now() > attempt->trader->deadline || verify_signals_asked() != 0;
    return !attempt->late;
}

/* The oracle that judges the run. A variant may give it other parameters; it has to prove itself too. */
static bool truth_of(struct verify_trader *trader, const struct verify_trade_run *run, const struct solver_scene *scene,
                     const struct verify_truth **truth, struct solver_error *error)
{
    size_t which = 0;
    for (size_t i = 0; i < trader->scene->variant_count; i++) {
        which = strcmp(trader->scene->variant[i].name, run->variant) == 0 ? i + 1 : which;
    }
    if (!trader->opened[which]) {
        trader->opened[which] = verify_truth_create(scene, &trader->truth[which], error);
        if (!trader->opened[which]) {
            return false;
        }
    }
    *truth = &trader->truth[which];
    return (*truth)->proven || solver_fail(error, SOLVER_BAD_INPUT, "%s: the oracle does not prove itself%s%s",
                                           scene->path, which > 0 ? " of " : "", run->variant);
}

static bool advance(struct attempt *attempt, struct verify_level *level, struct solver_error *error)
{
    const struct solver_scene *scene = attempt->scene;
    for (size_t i = 0; i <= scene->snapshot_count; i++) {
        bool last = i == scene->snapshot_count;
        if (!solver_run_to(attempt->run, last ? scene->t_end : scene->snapshot[i], watch, attempt, error)) {
            return false;
        }
        if (attempt->late) {
            return true;
        }
        if (!last && attempt->truth != NULL &&
            !verify_level_snapshot(level, attempt->run, attempt->truth->kind, attempt->truth->oracle, error)) {
            return false;
        }
    }
    return true;
}

static bool open_scene(const struct verify_trader *trader, const struct verify_trade_run *run, int threads,
                       struct solver_scene **scene, struct solver_error *error)
{
    struct verify_options with = *trader->options;
    char store[VERIFY_TRADE_STORE], text[32];
    if (!verify_trade_configure(trader->scene, run, store, &with, error)) {
        return false;
    }
    (void)snprintf(text, sizeof text, "threads=%d", threads);
    with.override[with.override_count++] = text;
    return verify_scene_open(&with, run->n, scene, error);
}

static bool keep_errors(const struct verify_trade *trade, const struct attempt *attempt,
                        const struct verify_level *level, struct verify_trade_run *run, struct solver_error *error)
{
    for (size_t i = 0; i < trade->error_count; i++) {
        struct verify_value value;
        bool there = verify_level_value(attempt->scene, level, trade->error_name[i], trade->scene, &value, error);
        if (!there && i == trade->chosen) {
            return false;
        }
        run->error[i] = there ? value.value : NAN;
    }
    return isfinite(run->error[trade->chosen]) ||
           solver_fail(error, SOLVER_BROKE_DOWN, "the error %s is no number", trade->error_name[trade->chosen]);
}

static void keep_costs(const struct attempt *attempt, struct verify_trade_run *run)
{
    struct solver_facts facts = solver_run_facts(attempt->run);
    const struct solver_integrator *integrator = solver_integrator_find(attempt->scene->integrator);
    run->particles = facts.particles;
    run->pairs = facts.pairs;
    run->steps = facts.steps;
    run->threads = facts.threads;
    run->repeats = 1;
    run->noise = NAN;
    run->evaluations = (double)facts.steps * (double)integrator->stages;
    run->cost[VERIFY_PAIRS] = run->evaluations * (double)facts.pairs;
    run->cost[VERIFY_BYTES] = (double)facts.steps * (double)facts.particles * facts.step_traffic;
    run->cost[VERIFY_SECONDS] = facts.setup_seconds + facts.seconds;
}

static bool attempt_run(struct verify_trader *trader, struct verify_trade_run *run, struct attempt *attempt,
                        struct verify_level *level, struct solver_error *error)
{
    struct solver_output output;
    if (!open_scene(trader, run, trader->scene->threads > 0 ? trader->scene->threads : 1, &attempt->scene, error) ||
        !truth_of(trader, run, attempt->scene, &attempt->truth, error) ||
        !verify_run_create(attempt->scene, &attempt->run, error) || !advance(attempt, level, error)) {
        return false;
    }
    if (attempt->late) {
        return true;
    }
    keep_costs(attempt, run);
    return solver_run_output(attempt->run, &output, error) &&
           verify_level_measure(level, attempt->scene, attempt->run, &output, attempt->truth, error) &&
           keep_errors(trader->trade, attempt, level, run, error);
}

bool verify_trade_measure(struct verify_trader *trader, struct verify_trade_run *run, struct solver_error *error)
{
    struct attempt attempt = {.trader = trader};
    struct verify_level level = {.n = run->n};
    struct solver_error why = {.code = SOLVER_OK};
    bool done = attempt_run(trader, run, &attempt, &level, &why);
    verify_level_free(&level);
    solver_run_free(attempt.run);
    solver_scene_free(attempt.scene);
    run->end = !done && why.code == SOLVER_BAD_INPUT ? VERIFY_REFUSED
               : !done                               ? VERIFY_BROKE
               : attempt.late                        ? VERIFY_LEFT_OUT
                                                     : VERIFY_MEASURED;
    (void)snprintf(run->why, sizeof run->why, "%.511s",
                   !done                         ? why.text
                   : !attempt.late               ? ""
                   : verify_signals_asked() != 0 ? "the study was stopped before it was done"
                                                 : "the budget was spent before it was done");
    if (!done && why.code == SOLVER_IO) {
        *error = why;
        return false;
    }
    return true;
}

/* One more time of a run that was measured; infinite if there was no time left for it. */
static bool time_once(struct verify_trader *trader, const struct verify_trade_run *run, int threads, double *seconds,
                      int *used, struct solver_error *error)
{
    struct attempt attempt = {.trader = trader};
    bool done = open_scene(trader, run, threads, &attempt.scene, error) &&
                verify_run_create(attempt.scene, &attempt.run, error) && advance(&attempt, NULL, error);
    if (done) {
        struct solver_facts facts = solver_run_facts(attempt.run);
        *seconds = attempt.late ? INFINITY : facts.setup_seconds + facts.seconds;
        *used = facts.threads;
    }
    solver_run_free(attempt.run);
    solver_scene_free(attempt.scene);
    return done;
}

/* The two smallest times so far. */
static void keep_best(double best[2], double seconds)
{
    if (seconds < best[0]) {
        best[1] = best[0];
        best[0] = seconds;
    } else {
        best[1] = fmin(best[1], seconds);
    }
}

bool verify_trade_time(struct verify_trader *trader, struct verify_trade_run *run, int threads, int repeats,
                       struct solver_error *error)
{
    double best[2] = {INFINITY, INFINITY};
    int used = 0, timed = 0;
    for (double seconds = 0; timed < repeats; timed++) {
        if (!time_once(trader, run, threads, &seconds, &used, error)) {
            return false;
        }
        if (!isfinite(seconds)) {
            break;
        }
        keep_best(best, seconds);
    }
    bool together = used == run->threads; /* with the times that there are */
    if (timed > 0 && together) {
        double before = run->cost[VERIFY_SECONDS];
        keep_best(best, before);
        if (!isnan(run->noise)) {
            keep_best(best, before * (1 + run->noise));
        }
    }
    if (timed > 0 && (together || best[0] < run->cost[VERIFY_SECONDS])) {
        run->repeats = together ? run->repeats + timed : timed;
        run->threads = used;
        run->cost[VERIFY_SECONDS] = best[0];
        run->noise = isfinite(best[1]) ? best[1] / best[0] - 1 : NAN;
    }
    return true;
}

void verify_trader_free(struct verify_trader *trader)
{
    for (size_t i = 0; i <= SOLVER_VARIANTS; i++) {
        verify_truth_free(&trader->truth[i]);
    }
}
