#include "verify/level.h"

#include "verify/figures.h"
#include "verify/inside.h"

#include <math.h>
#include <string.h>

/* Whether text begins with the word; *rest is what follows it. */
static bool begins(const char *text, const char *word, const char **rest)
{
    size_t length = strlen(word);
    bool so = strncmp(text, word, length) == 0;
    *rest = so ? text + length : text;
    return so;
}

size_t verify_level_error(const char *name, bool *is_rate)
{
    bool rate = begins(name, "rate ", &name);
    if (is_rate != NULL) {
        *is_rate = rate;
    }
    return verify_error_find(name);
}

const char *verify_why_no_error(double error)
{
    return isfinite(error) ? ""
           : isnan(error)  ? "a field is no number, or the exact one is 0 throughout; of the latter take the _abs error"
                           : "a field has grown beyond all numbers";
}

const char *verify_why_no_order(double order, double error, bool follows)
{
    return isfinite(order)    ? ""
           : !follows         ? "one level has no order; give two or more, as in --levels 8,16"
           : !isfinite(error) ? "the error that it would be of is no number"
                              : "the error of a level is 0, or no number";
}

static bool figure_value(const struct solver_scene *scene, const struct verify_level *level, const char *name,
                         bool is_rate, const char *where, struct verify_value *value, struct solver_error *error)
{
    for (size_t i = 0; i < scene->figure_count; i++) {
        if (strcmp(scene->figure[i].name, name) == 0) {
            const struct verify_figure *figure = &level->figure[i];
            value->value = is_rate ? figure->rate : figure->error;
            value->why = is_rate && isfinite(figure->error)
                             ? verify_why_no_order(figure->rate, figure->error, level->follows)
                             : figure->why;
            if (!is_rate && figure->exact == 0.0 && figure->unit != NULL) {
                value->unit = figure->unit; /* of an absolute error; others are relative */
            }
            return true;
        }
    }
    return solver_fail(error, SOLVER_BAD_INPUT, "%s: \"figure %s\": the scene's key figures has no such figure", where,
                       name);
}

static bool indicator_value(const struct verify_level *level, const char *name, bool is_rate, const char *where,
                            struct verify_value *value, struct solver_error *error)
{
    size_t which = verify_indicator_find(name);
    if (which == VERIFY_INDICATORS || is_rate) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: \"%sindicator %s\": there are the indicators clumping, checkerboard, linear momentum, "
                           "angular momentum and energy gain, and no rates of them",
                           where, is_rate ? "rate " : "", name);
    }
    value->value = level->indicator[which];
    value->why = isfinite(value->value) ? "" : verify_indicator_lacks(which);
    value->op = verify_indicator_op(which);
    return true;
}

static bool error_value(const struct solver_scene *scene, const struct verify_level *level, const char *name,
                        const char *where, struct verify_value *value, struct solver_error *error)
{
    bool is_rate;
    size_t which = verify_level_error(name, &is_rate);
    const char *lacks = NULL;
    if (which == VERIFY_ERRORS) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: there is no error called \"%s\"; there are %s, and \"rate \" before any of them", where,
                           name, verify_error_names);
    }
    if (is_rate && !verify_error_has_order(which)) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: \"%s\": a difference from another configuration has no order; gate its value", where,
                           name);
    }
    if (!verify_error_applies(scene, which, &lacks)) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%s: \"%s\" needs the scene's key %s", where, name, lacks);
    }
    value->value = is_rate ? level->rate[which] : level->error[which];
    value->unit = is_rate ? "-" : verify_error_unit(which);
    value->why = is_rate ? verify_why_no_order(level->rate[which], level->error[which], level->follows)
                         : verify_why_no_error(level->error[which]);
    return true;
}

bool verify_level_value(const struct solver_scene *scene, const struct verify_level *level, const char *name,
                        const char *where, struct verify_value *value, struct solver_error *error)
{
    const char *of;
    bool is_rate = begins(name, "rate ", &of);
    *value = (struct verify_value){.op = is_rate ? ">=" : "<=", .unit = "-", .why = ""};
    if (begins(of, "indicator ", &of)) {
        return indicator_value(level, of, is_rate, where, value, error);
    }
    return begins(of, "figure ", &of) ? figure_value(scene, level, of, is_rate, where, value, error)
                                      : error_value(scene, level, name, where, value, error);
}

bool verify_level_snapshot(struct verify_level *level, struct solver_run *run, const struct oracle_kind *kind,
                           const struct oracle *oracle, struct solver_error *error)
{
    struct verify_snapshot *taken = &level->snapshot[level->snapshot_count];
    level->snapshot_count++; /* also of what was begun and failed: it is freed with the level */
    if (!verify_snapshot_take(run, kind, oracle, taken, error)) {
        return false;
    }
    verify_norms_worst(level->snapshot_count - 1, taken->error, level->error);
    return true;
}

bool verify_level_measure(struct verify_level *level, const struct solver_scene *scene, struct solver_run *run,
                          const struct solver_output *output, const struct verify_truth *truth,
                          struct solver_error *error)
{
    const struct solver_history *history = solver_run_history(run);
    level->facts = solver_run_facts(run);
    return verify_inside_cloud(scene, truth, output->cloud, error) &&
           verify_norms_state(output, truth->kind, truth->oracle, level->error, error) &&
           verify_norms_probes(history, truth->kind, truth->oracle, scene->probe_scale, level->error, error) &&
           verify_figures_measure(scene, truth, history, output, level, error);
}

void verify_level_free(struct verify_level *level)
{
    for (size_t i = 0; i < level->snapshot_count; i++) {
        verify_snapshot_free(&level->snapshot[i]);
    }
    level->snapshot_count = 0;
}
