#include "verify/figures.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define WHERE             "%.300s: figures.%s: "
#define OF(scene, figure) (scene)->path, (figure)->name

static bool read_window(const struct solver_scene *scene, const struct solver_option *given,
                        struct verify_argument *argument)
{
    *argument = (struct verify_argument){.snapshot = 0, .from = given->number[1], .to = given->number[2]};
    while (argument->snapshot < scene->snapshot_count && scene->snapshot[argument->snapshot] != given->number[0]) {
        argument->snapshot++;
    }
    return given->count == 3 && argument->snapshot < scene->snapshot_count && argument->from < argument->to;
}

static bool read_probe(const struct solver_scene *scene, const struct solver_option *given,
                       struct verify_argument *argument)
{
    *argument = (struct verify_argument){.probe = 0};
    while (argument->probe < scene->probe_count && strcmp(scene->probe[argument->probe].name, given->text) != 0) {
        argument->probe++;
    }
    return argument->probe < scene->probe_count;
}

static bool read_body(const struct solver_scene *scene, const struct solver_option *given,
                      struct verify_argument *argument)
{
    size_t bodies = scene->shape_count > 0 ? scene->shape_count : 1;
    double k = given->count == 1 ? given->number[0] : 0;
    *argument = (struct verify_argument){.body = k >= 1 && k <= (double)bodies && k == floor(k) ? (size_t)k - 1 : 0};
    return k == (double)argument->body + 1;
}

static bool read_length(const struct solver_scene *scene, const struct solver_option *given,
                        struct verify_argument *argument)
{
    (void)scene;
    *argument = (struct verify_argument){.length = given->number[0]};
    return given->count == 1 && argument->length >= 0;
}

static bool read_axis(const struct solver_scene *scene, const struct solver_option *given,
                      struct verify_argument *argument)
{
    double k = given->count == 1 ? given->number[0] : 0;
    *argument = (struct verify_argument){.axis = k >= 1 && k <= scene->dim && k == floor(k) ? (size_t)k - 1 : 0};
    return k == (double)argument->axis + 1;
}

static bool read_number(const struct solver_scene *scene, const struct solver_option *given,
                        struct verify_argument *argument)
{
    (void)scene;
    *argument = (struct verify_argument){.number = given->number[0]};
    return given->count == 1;
}

static bool read_place(const struct solver_scene *scene, const struct solver_option *given,
                       struct verify_argument *argument)
{
    *argument = (struct verify_argument){.place = {given->number[0], given->number[1], given->number[2]}};
    return given->count == (size_t)scene->dim;
}

typedef bool reader(const struct solver_scene *scene, const struct solver_option *given,
                    struct verify_argument *argument);
static reader *const readers[] = {
    [VERIFY_WINDOW] = read_window, [VERIFY_PROBE] = read_probe, [VERIFY_BODY] = read_body,
    [VERIFY_LENGTH] = read_length, [VERIFY_AXIS] = read_axis,   [VERIFY_NUMBER] = read_number,
    [VERIFY_PLACE] = read_place};

static const struct solver_option *find_option(const struct solver_figure *figure, const char *name)
{
    for (size_t i = 0; i < figure->option_count; i++) {
        if (strcmp(figure->option[i].name, name) == 0) {
            return &figure->option[i];
        }
    }
    return NULL;
}

/* Always false. */
static bool refuse_argument(const struct solver_scene *scene, const struct solver_figure *figure, const char *name,
                            const struct solver_option *given, const char *expected, struct solver_error *error)
{
    char got[SOLVER_TEXT] = "{";
    size_t used = 1;
    if (given == NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT, WHERE "%s: missing; expected %s", OF(scene, figure), name,
                           expected);
    }
    for (size_t i = 0; i < given->count && used < sizeof got; i++) {
        used += (size_t)snprintf(got + used, sizeof got - used, "%s%.15g%s", i > 0 ? ", " : "", given->number[i],
                                 i + 1 == given->count ? "}" : "");
    }
    return solver_fail(error, SOLVER_BAD_INPUT, WHERE "%s: expected %s, got %s", OF(scene, figure), name, expected,
                       given->count > 0 ? got : given->text);
}

/* The arguments that the scene gives the measure, in its order; refuses those missing, wrong and unknown. */
static bool read_arguments(const struct solver_scene *scene, const struct solver_figure *figure,
                           const struct verify_measure *measure, struct verify_argument *argument,
                           struct solver_error *error)
{
    size_t known = 0;
    for (; known < VERIFY_ARGUMENTS && measure->option[known].kind != VERIFY_NO_OPTION; known++) {
        const char *name = measure->option[known].name;
        enum verify_option kind = measure->option[known].kind;
        const struct solver_option *given = find_option(figure, name);
        if (given == NULL || !readers[kind](scene, given, &argument[known])) {
            return refuse_argument(scene, figure, name, given, verify_option_spelling(kind), error);
        }
    }
    for (size_t i = 0; i < figure->option_count; i++) {
        bool taken = false;
        for (size_t j = 0; j < known; j++) {
            taken = taken || strcmp(figure->option[i].name, measure->option[j].name) == 0;
        }
        if (!taken) {
            return solver_fail(error, SOLVER_BAD_INPUT, WHERE "the measure \"%s\" has no option \"%s\"",
                               OF(scene, figure), measure->name, figure->option[i].name);
        }
    }
    return true;
}

/* The oracle's figure of that name; a NaN value and no unit if it has none. */
static struct oracle_figure exact_figure(const struct verify_truth *truth, const char *name)
{
    struct oracle_figure figure[ORACLE_FIGURES];
    size_t count = !truth->none && truth->kind->figures != NULL ? truth->kind->figures(truth->oracle, figure) : 0;
    for (size_t i = 0; i < count; i++) {
        if (strcmp(figure[i].name, name) == 0) {
            return figure[i];
        }
    }
    return (struct oracle_figure){.value = NAN};
}

static bool check(const struct solver_scene *scene, const struct verify_truth *truth,
                  const struct solver_figure *figure, struct solver_error *error)
{
    const struct verify_measure *measure = verify_measure_find(figure->measure);
    struct verify_argument argument[VERIFY_ARGUMENTS];
    if (measure == NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT, WHERE "there is no measure \"%s\"; see assay list measures",
                           OF(scene, figure), figure->measure);
    }
    if (measure->in_1d_only && scene->dim != 1) {
        return solver_fail(error, SOLVER_BAD_INPUT, WHERE "the measure \"%s\" is for dim = 1, the scene has dim = %d",
                           OF(scene, figure), measure->name, scene->dim);
    }
    if (measure->flow && !solver_scene_flows(scene)) {
        return solver_fail(error, SOLVER_BAD_INPUT, WHERE "the measure \"%s\" is of a material with a yield stress",
                           OF(scene, figure), measure->name);
    }
    if (truth->none && (measure->needs_fronts || !(measure->none_is_exact || measure->expected))) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           WHERE "the measure \"%s\" is compared with an oracle, and the scene has none",
                           OF(scene, figure), measure->name);
    }
    if (measure->needs_fronts && (truth->kind->fronts == NULL || scene->snapshot_count == 0)) {
        return solver_fail(error, SOLVER_BAD_INPUT, WHERE "the measure \"%s\" needs %s", OF(scene, figure),
                           measure->name, truth->kind->fronts == NULL ? "an oracle that has fronts" : "snapshots");
    }
    if (!measure->none_is_exact && !measure->expected && exact_figure(truth, figure->name).unit == NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           WHERE "the oracle \"%s\" has no figure of this name; the report lists those it has",
                           OF(scene, figure), truth->kind->name);
    }
    return read_arguments(scene, figure, measure, argument, error);
}

bool verify_figures_check(const struct solver_scene *scene, const struct verify_truth *truth,
                          struct solver_error *error)
{
    for (size_t i = 0; i < scene->figure_count; i++) {
        if (!check(scene, truth, &scene->figure[i], error)) {
            return false;
        }
    }
    return true;
}

bool verify_figures_measure(const struct solver_scene *scene, const struct verify_truth *truth,
                            const struct solver_history *history, const struct solver_output *output,
                            struct verify_level *level, struct solver_error *error)
{
    const char *why = NULL;
    const struct verify_measuring in = {
        .scene = scene, .truth = truth, .level = level, .history = history, .output = output, .why = &why};
    for (size_t i = 0; i < scene->figure_count; i++) {
        const struct verify_measure *measure = verify_measure_find(scene->figure[i].measure);
        struct verify_argument argument[VERIFY_ARGUMENTS] = {{0}};
        struct verify_figure *out = &level->figure[i];
        struct oracle_figure exact = exact_figure(truth, scene->figure[i].name);
        bool of_oracle = !measure->none_is_exact && !measure->expected;
        *out = (struct verify_figure){.exact = measure->none_is_exact ? 0 : exact.value,
                                      .unit = of_oracle               ? exact.unit
                                              : measure->unit != NULL ? measure->unit
                                                                      : "-"};
        if (!read_arguments(scene, &scene->figure[i], measure, argument, error)) {
            return false;
        }
        bool length = measure->option[0].kind == VERIFY_LENGTH;
        out->exact = !measure->expected ? out->exact : length ? argument[0].length : argument[0].number;
        why = measure->lacks;
        if (!measure->measure(&in, argument, &out->measured, error)) {
            return false;
        }
        out->error = out->exact == 0 ? fabs(out->measured) : fabs(out->measured / out->exact - 1);
        out->why = isfinite(out->error) ? "" : isfinite(out->measured) ? "what is expected is no number" : why;
    }
    return true;
}
