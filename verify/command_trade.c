/* assay trade: what accuracy costs. */
#include "verify/commands.h"
#include "verify/figures.h"
#include "verify/find.h"
#include "verify/progress.h"
#include "verify/report.h"
#include "verify/report_trade.h"
#include "verify/signals.h"
#include "verify/study.h"
#include "verify/trade_run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Of what stands on the front of time, after it was timed once: more of what is short. */
enum { FEW_REPEATS = 2, MANY_REPEATS = 10 };
static const double time_to_repeat = 0.2; /* [s] */
static const double usual_budget = 120;
static const double repeat_share = 0.2; /* of the budget, kept for repeats */
/* A run timed once may be this much faster, by a factor and, where another program took the core, by a slice [s]. */
static const double near = 1.5, off = 0.01;

/* All that a study needs while it runs. */
struct work {
    struct verify_trader trader;
    struct verify_trade trade;
    struct solver_scene *scene;
    double begun; /* [s] on verify_now() */
    bool on;      /* standard error is a terminal */
};

static bool choose_levels(struct work *work, struct solver_error *error)
{
    const struct verify_options *options = work->trader.options;
    bool given = options->level_count > 0;
    struct verify_trade *trade = &work->trade;
    trade->level_count = given ? options->level_count : work->scene->level_count;
    memcpy(trade->level, given ? options->level : work->scene->levels, trade->level_count * sizeof *trade->level);
    if (trade->level_count == 0) {
        trade->level[trade->level_count++] = work->scene->n;
    }
    return verify_refuse_n(options, verify_by_levels, error);
}

/* Any error that the scene can have, shown or not. */
static bool choose_asked(struct work *work, const char *asked, struct solver_error *error)
{
    struct verify_trade *trade = &work->trade;
    struct verify_level nothing = {.n = 0};
    struct verify_value value;
    trade->chosen = verify_trade_error(trade, asked);
    if (trade->chosen < trade->error_count) {
        return true;
    }
    if (trade->error_count == VERIFY_TRADE_ERRORS) {
        return solver_fail(error, SOLVER_BAD_INPUT, "--error %s: the scene shows too many errors besides", asked);
    }
    (void)snprintf(trade->error_name[trade->error_count++], VERIFY_TRADE_NAME, "%s", asked);
    return verify_level_value(work->scene, &nothing, asked, "--error", &value, error) &&
           ((value.op[0] == '<' && strncmp(asked, "indicator ", 10) != 0) ||
            solver_fail(error, SOLVER_BAD_INPUT, "--error %s: no error", asked));
}

/* The errors that a study of the scene shows, and its figures; the first is chosen unless the command line names one.
 */
static bool choose_errors(struct work *work, struct solver_error *error)
{
    struct verify_trade *trade = &work->trade;
    size_t shown[VERIFY_ERRORS], count = 0;
    const char *asked = work->trader.options->error;
    if (!verify_shown(work->scene, shown, &count, error)) {
        return false;
    }
    for (size_t i = 0; i < count && trade->error_count < VERIFY_TRADE_ERRORS; i++) {
        if (verify_error_has_order(shown[i])) {
            (void)snprintf(trade->error_name[trade->error_count++], VERIFY_TRADE_NAME, "%s",
                           verify_error_name(shown[i]));
        }
    }
    for (size_t i = 0; i < work->scene->figure_count && trade->error_count < VERIFY_TRADE_ERRORS; i++) {
        (void)snprintf(trade->error_name[trade->error_count++], VERIFY_TRADE_NAME, "figure %s",
                       work->scene->figure[i].name);
    }
    return asked == NULL || choose_asked(work, asked, error);
}

static void show_progress(const struct work *work, size_t done, size_t all, double level_begun, int n)
{
    if (!work->on) {
        return;
    }
    double now = verify_now(), spent = now - work->begun;
    (void)fprintf(stderr, "\r\033[K%s, n = %d: run %zu of %zu, %.0f s of at most %.0f s", work->trade.scene, n,
                  done + 1, all, spent, work->trade.budget);
    if (done > 4) {
        (void)fprintf(stderr, ", about %.0f s to go at this n",
                      (now - level_begun) / (double)done * (double)(all - done));
    }
}

/* The runs of a level, which are those from `from` on, until the deadline. */
static bool run_level(struct work *work, size_t level, size_t from, double deadline, struct solver_error *error)
{
    struct verify_trade *trade = &work->trade;
    double begun = verify_now();
    size_t to = trade->run_count, done = 0, all = 0;
    for (size_t i = from; i < to; i++) {
        all += trade->run[i].why[0] == '\0';
    }
    for (size_t i = from; i < to; i++) {
        struct verify_trade_run *run = &trade->run[i];
        if (run->why[0] != '\0') {
            continue; /* beaten at the level before */
        }
        bool first = i == 0; /* the scene's own, without which there is nothing to compare with */
        work->trader.deadline = first ? INFINITY : deadline;
        show_progress(work, done++, all, begun, run->n);
        bool stopped = verify_signals_asked() != 0;
        if (stopped || (!first && verify_now() > deadline)) {
            (void)snprintf(run->why, sizeof run->why, "the %s before its turn",
                           stopped ? "study was stopped" : "budget was spent");
        } else if (!verify_trade_measure(&work->trader, run, error)) {
            return false;
        }
        if (first && run->end == VERIFY_LEFT_OUT) {
            return solver_fail(error, SOLVER_STOPPED,
                               "%s: stopped by %s before the scene's own configuration was measured; nothing is kept",
                               trade->scene, verify_signals_name(verify_signals_asked()));
        }
        if (first && run->end != VERIFY_MEASURED) {
            return solver_fail(error, run->end == VERIFY_REFUSED ? SOLVER_BAD_INPUT : SOLVER_BROKE_DOWN,
                               "the scene's own configuration at n = %d cannot be measured: %.400s", run->n, run->why);
        }
    }
    if (work->on) {
        (void)fprintf(stderr, "\r\033[K");
    }
    trade->spent = verify_now() - work->begun;
    verify_trade_print_level(stdout, trade, trade->level[level], from, to);
    return true;
}

/* Each level may take half of the time that is left, the last all of it. */
static bool run_levels(struct work *work, struct solver_error *error)
{
    struct verify_trade *trade = &work->trade;
    double end = work->begun + (1 - repeat_share) * trade->budget;
    size_t from = 0;
    for (size_t level = 0; level < trade->level_count && verify_signals_asked() == 0; level++) {
        bool last = level + 1 == trade->level_count;
        double now = verify_now();
        if (level > 0 && !verify_trade_promote(trade, level, error)) {
            return false;
        }
        if (!run_level(work, level, from, last ? end : now + 0.5 * (end - now), error)) {
            return false;
        }
        from = trade->run_count;
    }
    return true;
}

/* Of what was timed once the run nearest to the front of time, if it would stand there were its time off by what a time
 * may be off; NULL if there is none. */
static struct verify_trade_run *next_to_time(struct verify_trade *trade)
{
    struct verify_trade_run *found = NULL;
    double least = INFINITY;
    for (size_t i = 0; i < trade->run_count; i++) {
        struct verify_trade_run *run = &trade->run[i];
        if (run->end != VERIFY_MEASURED || run->repeated) {
            continue;
        }
        double bound = run->error[trade->chosen], seconds = run->cost[VERIFY_SECONDS];
        size_t cheapest = verify_trade_cheapest(trade, trade->chosen, bound, VERIFY_SECONDS, false);
        double fastest = trade->run[cheapest].cost[VERIFY_SECONDS];
        if (seconds - fastest <= off + (near - 1) * fastest && seconds / fastest < least) {
            found = run;
            least = seconds / fastest;
        }
    }
    return found;
}

/* Times once more what stands on the front of time or near it, with more threads too, which change no digit of the
 * result, unless the scene or the command line says how many. */
static bool repeat(struct work *work, struct solver_error *error)
{
    struct verify_trade *trade = &work->trade;
    work->trader.deadline = work->begun + trade->budget;
    struct verify_trade_run *next = next_to_time(trade);
    while (next != NULL && verify_now() < work->trader.deadline && verify_signals_asked() == 0) {
        if (work->on) {
            (void)fprintf(stderr, "\r\033[K%s: timing again, %.0f s of at most %.0f s", trade->scene,
                          verify_now() - work->begun, trade->budget);
        }
        double wanted = fmin(MANY_REPEATS, fmax(FEW_REPEATS, time_to_repeat / next->cost[VERIFY_SECONDS]));
        next->repeated = true;
        if (!verify_trade_time(&work->trader, next, next->threads, (int)wanted, error) ||
            (work->scene->threads == 0 && !verify_trade_time(&work->trader, next, 0, (int)wanted, error))) {
            return false;
        }
        next = next_to_time(trade);
    }
    if (work->on) {
        (void)fprintf(stderr, "\r\033[K");
    }
    trade->spent = verify_now() - work->begun;
    return verify_trade_fronts(trade, error);
}

/* Three verify_writers. */
static bool write_json(FILE *file, const void *context, struct solver_error *error)
{
    (void)error;
    verify_trade_json(file, &((const struct work *)context)->trade);
    return true;
}

static bool write_svg(FILE *file, const void *context, struct solver_error *error)
{
    (void)error;
    verify_trade_svg(file, &((const struct work *)context)->trade);
    return true;
}

static bool write_html(FILE *file, const void *context, struct solver_error *error)
{
    const struct work *work = context;
    (void)error;
    verify_trade_html(file, &work->trade, work->scene, &work->trader.truth[0]);
    return true;
}

/* A study that was stopped takes no place of one that was not. */
static const char *stem_of(const struct work *work)
{
    return work->trade.stopped[0] != '\0' ? "trade-stopped" : "trade";
}

static bool write_files(const struct work *work, struct solver_error *error)
{
    static const struct {
        const char *ending;
        verify_writer *write;
    } reports[] = {{".html", write_html}, {".svg", write_svg}, {".json", write_json}};
    const struct verify_options *options = work->trader.options;
    char folder[VERIFY_PATH], path[VERIFY_PATH];
    if (!verify_out_folder(options, work->scene->name, folder, error) ||
        !verify_path_join(path, folder, stem_of(work), ".tsv", error) ||
        !verify_trade_write(&work->trade, path, error)) {
        return false;
    }
    (void)printf("\nstudy      %s\n", path);
    for (size_t i = 0; i < sizeof reports / sizeof *reports; i++) {
        if (!verify_path_join(path, folder, stem_of(work), reports[i].ending, error) ||
            !verify_report_write(path, reports[i].write, work, error)) {
            return false;
        }
        (void)printf("           %s\n", path);
    }
    return options->json == NULL || verify_report_write(options->json, write_json, work, error);
}

/* Of a study that was stopped: what there is, and what it is good for. Always false. */
static bool say_stopped(const struct work *work, struct solver_error *error)
{
    const struct verify_options *options = work->trader.options;
    char folder[VERIFY_PATH], path[VERIFY_PATH], text[512];
    verify_trade_stopped(&work->trade, text, sizeof text);
    return verify_out_folder(options, work->scene->name, folder, error) &&
           verify_path_join(path, folder, stem_of(work), ".tsv", error) &&
           solver_fail(error, SOLVER_STOPPED, "%s: %s; assay run %.64s --error BOUND --study %.400s chooses among them",
                       work->trade.scene, text, options->operand[0], path);
}

/* Before anything is measured that would be lost. */
static bool check_files(const struct work *work, struct solver_error *error)
{
    const struct verify_options *options = work->trader.options;
    char folder[VERIFY_PATH], path[VERIFY_PATH];
    return verify_out_folder(options, work->scene->name, folder, error) &&
           verify_path_join(path, folder, "trade", ".tsv", error) && verify_file_check(path, error) &&
           (options->json == NULL || verify_file_check(options->json, error));
}

static bool study(struct work *work, struct solver_error *error)
{
    const struct verify_options *options = work->trader.options;
    struct verify_trade *trade = &work->trade;
    struct verify_truth *truth = &work->trader.truth[0];
    if (!verify_scene_open(options, 0, &work->scene, error) || !verify_trade_begin(work->scene, trade, error) ||
        !choose_levels(work, error) || !verify_truth_create(work->scene, truth, error)) {
        return false;
    }
    work->trader.scene = work->scene;
    work->trader.opened[0] = true;
    trade->budget = options->budget > 0 ? options->budget : usual_budget;
    if (!truth->proven) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%s: the oracle does not prove itself; assay verify says where",
                           work->scene->path);
    }
    if (!verify_figures_check(work->scene, truth, error) || !choose_errors(work, error) ||
        !verify_trade_axes(options, work->scene, trade, error) || !verify_trade_plan(work->scene, trade, error) ||
        !check_files(work, error)) {
        return false;
    }
    size_t chosen = verify_error_find(trade->error_name[trade->chosen]); /* figures have relative errors */
    trade->relative = chosen == VERIFY_ERRORS || strcmp(verify_error_unit(chosen), "-") == 0;
    verify_trade_print_begin(stdout, trade, work->scene, truth);
    verify_signals_watch();
    bool done = run_levels(work, error) && repeat(work, error);
    verify_signals_leave();
    if (!done) {
        return false;
    }
    if (verify_signals_asked() != 0) {
        (void)snprintf(trade->stopped, sizeof trade->stopped, "%s", verify_signals_name(verify_signals_asked()));
    }
    verify_trade_print_end(stdout, trade);
    return write_files(work, error) && (trade->stopped[0] == '\0' || say_stopped(work, error));
}

int verify_command_trade(const struct verify_options *options)
{
    struct solver_error error = {.code = SOLVER_OK};
    struct work *work = calloc(1, sizeof *work);
    if (work == NULL) {
        (void)solver_fail(&error, SOLVER_NO_MEMORY, "no memory for a study");
        return verify_complain(&error);
    }
    work->trader.options = options;
    work->trader.trade = &work->trade;
    work->begun = verify_now();
    work->on = isatty(STDERR_FILENO) == 1;
    bool done = study(work, &error);
    verify_trader_free(&work->trader);
    verify_trade_free(&work->trade);
    solver_scene_free(work->scene);
    free(work);
    return done ? VERIFY_PASSED : verify_complain(&error);
}
