#include "verify/trade_pick.h"

#include "verify/find.h"
#include "verify/report_trade.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A run repeats a study's errors to round-off, which another machine's arithmetic may magnify, and single precision
 * more so. */
static const double repeats_to = 1e-3;

static bool read_bound(const struct verify_options *options, struct verify_pick *pick, struct solver_error *error)
{
    const char *equals = strrchr(options->error, '='), *number = equals != NULL ? equals + 1 : options->error;
    char name[VERIFY_TRADE_NAME] = "", *end = NULL;
    pick->bound = strtod(number, &end);
    if (end == number || *end != '\0' || !(pick->bound > 0) || !isfinite(pick->bound)) {
        return solver_fail(error, SOLVER_BAD_INPUT, "--error %s: expected a number above 0, as in 1e-3 or p=1e-3",
                           options->error);
    }
    pick->error = pick->trade.chosen;
    if (equals != NULL) {
        (void)snprintf(name, sizeof name, "%.*s", (int)(equals - options->error), options->error);
        pick->error = verify_trade_error(&pick->trade, name);
    }
    if (pick->error == pick->trade.error_count) {
        char known[512] = "";
        for (size_t i = 0, used = 0; i < pick->trade.error_count && used < sizeof known; i++) {
            used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", i > 0 ? ", " : "",
                                     pick->trade.error_name[i]);
        }
        return solver_fail(error, SOLVER_BAD_INPUT, "--error %s: the study has no error %s; it has %s", options->error,
                           name, known);
    }
    return true;
}

/* What the scene was called on the command line. */
static const char *called(const struct verify_options *options, const struct solver_scene *scene)
{
    return options->operand_count > 0 ? options->operand[0] : scene->name;
}

/* Whether the study is of this scene as it is now. */
static bool is_of(const struct verify_trade *trade, const struct verify_options *options,
                  const struct solver_scene *scene, const char *path, struct solver_error *error)
{
    if (strcmp(trade->scene, scene->name) != 0) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%s: a study of the scene %s, not of %s", path, trade->scene,
                           scene->name);
    }
    return trade->hash == verify_trade_hash(scene) ||
           solver_fail(error, SOLVER_BAD_INPUT,
                       "%s: the scene has changed since the study, or other keys are overridden than then (%s); make "
                       "another: assay trade %s",
                       path, trade->overrides[0] != '\0' ? trade->overrides : "none", called(options, scene));
}

static bool find_study(const struct verify_options *options, const struct solver_scene *scene, char path[VERIFY_PATH],
                       struct solver_error *error)
{
    char folder[VERIFY_PATH];
    if (options->study != NULL) {
        return (size_t)snprintf(path, VERIFY_PATH, "%s", options->study) < VERIFY_PATH ||
               solver_fail(error, SOLVER_BAD_INPUT, "--study: the path is too long");
    }
    return verify_out_folder(options, scene->name, folder, error) &&
           verify_path_join(path, folder, "trade", ".tsv", error);
}

static bool read_study(const char *path, const struct verify_options *options, const struct solver_scene *scene,
                       struct verify_trade *trade, struct solver_error *error)
{
    struct solver_error why = {.code = SOLVER_OK};
    if (verify_trade_read(path, trade, &why)) {
        return is_of(trade, options, scene, path, error);
    }
    if (why.code == SOLVER_IO) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%.600s. --error picks from a study of the scene; make one: assay trade %s", why.text,
                           called(options, scene));
    }
    *error = why;
    return false;
}

static bool pick_run(struct verify_pick *pick, const char *path, struct solver_error *error)
{
    const struct verify_trade *trade = &pick->trade;
    size_t picked = verify_trade_cheapest(trade, pick->error, pick->bound, VERIFY_SECONDS, false);
    if (picked == trade->run_count) {
        char text[VERIFY_ADVICE];
        verify_trade_advise(trade, pick->error, pick->bound, text);
        return solver_fail(error, SOLVER_BAD_INPUT, "%s: %.800s; a study with larger --levels%s may reach it", path,
                           text, trade->stopped[0] != '\0' ? ", or one that is not stopped," : "");
    }
    pick->run = trade->run[picked];
    return true;
}

static void say(const struct verify_pick *pick, const char *path)
{
    char text[VERIFY_ADVICE];
    verify_trade_advise(&pick->trade, pick->error, pick->bound, text);
    (void)printf("%s\n           (%s)\npicked     n=%d %s%s%s %s\n           where the study measured %s = %.3e\n\n",
                 text, path, pick->run.n, pick->run.words, pick->run.variant[0] != '\0' ? " way: " : "",
                 pick->run.variant, pick->threads, pick->trade.error_name[pick->error], pick->run.error[pick->error]);
    if (pick->trade.stopped[0] != '\0') {
        (void)printf("The study was stopped by %s: of what it did not measure something may cost less.\n\n",
                     pick->trade.stopped);
    }
}

/* The words of the study are foreign text: each is a key that a study varies, and the scene checks their values. */
static bool configure(struct verify_pick *pick, const struct solver_scene *scene, struct solver_error *error)
{
    if (!verify_trade_configure(scene, &pick->run, pick->store, &pick->options, error)) {
        return false;
    }
    if (scene->threads == 0) {
        (void)snprintf(pick->threads, sizeof pick->threads, "threads=%d", pick->run.threads);
        pick->options.override[pick->options.override_count++] = pick->threads;
    }
    return true;
}

bool verify_pick_open(const struct verify_options *options, const struct solver_scene *scene, struct verify_pick *pick,
                      struct solver_error *error)
{
    char path[VERIFY_PATH];
    *pick = (struct verify_pick){.options = *options};
    if (!verify_refuse_n(options, "n is what --error picks", error) || !find_study(options, scene, path, error) ||
        !read_study(path, options, scene, &pick->trade, error) || !read_bound(options, pick, error) ||
        !pick_run(pick, path, error) || !configure(pick, scene, error)) {
        return false;
    }
    pick->level.n = pick->run.n;
    say(pick, path);
    return true;
}

bool verify_pick_take(void *context, struct solver_run *run, struct solver_error *error)
{
    struct verify_pick *pick = context;
    return verify_level_snapshot(&pick->level, run, pick->truth.kind, pick->truth.oracle, error);
}

/* `why`: the value is no number. */
static void add_gate(struct verify_gates *gates, const char *name, const char *what, double value, double bound,
                     const char *unit, const char *why)
{
    struct verify_gate *gate = &gates->gate[gates->count++];
    *gate = (struct verify_gate){.value = value,
                                 .bound = bound,
                                 .op = "<=",
                                 .unit = unit,
                                 .why = why,
                                 .pass = verify_gate_judge(value, "<=", bound)};
    (void)snprintf(gate->name, sizeof gate->name, "%.40s%s", name, what);
    gates->pass = gates->pass && gate->pass;
}

bool verify_pick_judge(struct verify_pick *pick, const struct solver_scene *scene, struct solver_run *run,
                       struct solver_error *error)
{
    const char *name = pick->trade.error_name[pick->error];
    double said = pick->run.error[pick->error];
    struct solver_output output;
    struct verify_value value;
    if (!solver_run_output(run, &output, error) ||
        !verify_level_measure(&pick->level, scene, run, &output, &pick->truth, error) ||
        !verify_level_value(scene, &pick->level, name, scene->path, &value, error)) {
        return false;
    }
    pick->gates = (struct verify_gates){.pass = true};
    add_gate(&pick->gates, name, "", value.value, pick->bound, value.unit, value.why);
    /* an error of nothing has no size: what is asked for has */
    add_gate(&pick->gates, name, " off the study", fabs(value.value - said) / (said > 0.0 ? said : pick->bound),
             repeats_to, "-", value.why);
    return true;
}

void verify_pick_free(struct verify_pick *pick)
{
    verify_level_free(&pick->level);
    verify_truth_free(&pick->truth);
    verify_trade_free(&pick->trade);
}
