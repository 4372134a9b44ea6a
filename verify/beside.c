#include "verify/beside.h"

#include "verify/find.h"
#include "verify/gates.h"
#include "verify/simulate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* "parameters.omega" is also set by "omega". */
static bool sets(const char *override, const char *key)
{
    static const char prefix[] = "parameters.";
    override += strncmp(override, prefix, sizeof prefix - 1) == 0 ? sizeof prefix - 1 : 0;
    size_t length = strlen(key);
    return strncmp(override, key, length) == 0 && override[length] == '=';
}

static bool is_overridden(const struct solver_settings *settings, const char *override)
{
    for (size_t i = 0; i < settings->count; i++) {
        if (sets(override, settings->key[i])) {
            return true;
        }
    }
    return false;
}

static bool has(const struct solver_settings *settings, const char *key)
{
    for (size_t i = 0; i < settings->count; i++) {
        if (strcmp(settings->key[i], key) == 0) {
            return true;
        }
    }
    return false;
}

/* "KEY = value, ..." as the scene has them. */
static void describe(const struct solver_settings *settings, const struct solver_scene *scene, char label[VERIFY_LABEL])
{
    size_t used = 0;
    label[0] = '\0';
    for (size_t i = 0; i < settings->count && used < VERIFY_LABEL; i++) {
        char text[SOLVER_TEXT] = "";
        (void)solver_scene_text(scene, settings->key[i], text, sizeof text);
        used += (size_t)snprintf(label + used, VERIFY_LABEL - used, "%s%s = %s", i == 0 ? "" : ", ", settings->key[i],
                                 text);
    }
}

static bool is_same(const struct solver_scene *scene)
{
    bool same = true;
    for (size_t i = 0; i < scene->beside.count; i++) {
        char text[SOLVER_TEXT] = "";
        (void)solver_scene_text(scene, scene->beside.key[i], text, sizeof text);
        same = same && verify_same_value(text, scene->beside.text[i]);
    }
    return same;
}

/* Displacements are compared probe by probe and time by time. */
static bool check(const struct solver_scene *scene, const struct solver_scene *other, struct solver_error *error)
{
    bool same = scene->dim == other->dim && scene->t_end == other->t_end && scene->probe_count == other->probe_count;
    for (size_t i = 0; same && i < scene->probe_count; i++) {
        const struct solver_probe *a = &scene->probe[i], *b = &other->probe[i];
        same = strcmp(a->name, b->name) == 0 && a->X[0] == b->X[0] && a->X[1] == b->X[1] && a->X[2] == b->X[2];
    }
    return same || solver_fail(error, SOLVER_BAD_INPUT,
                               "%s: beside: the configuration beside this one has another dim, t_end or other probes, "
                               "so the two cannot be compared",
                               scene->path);
}

bool verify_beside_open(const struct verify_options *options, const struct solver_scene *finest,
                        struct verify_beside *beside, struct solver_error *error)
{
    const struct solver_settings *settings = &finest->beside;
    char text[SOLVER_NAMED][2 * SOLVER_NAME], path[VERIFY_PATH];
    const char *override[VERIFY_OVERRIDES + SOLVER_NAMED + 1];
    size_t count = 0;
    *beside = (struct verify_beside){.scene = NULL};
    if (settings->count == 0 || is_same(finest)) {
        return true;
    }
    for (size_t i = 0; i < options->override_count; i++) {
        if (!is_overridden(settings, options->override[i])) {
            override[count++] = options->override[i];
        }
    }
    for (size_t i = 0; i < settings->count; i++) {
        (void)snprintf(text[i], sizeof text[i], "%s=%s", settings->key[i], settings->text[i]);
        override[count++] = text[i];
    }
    char n[32];
    if (!has(settings, "n")) { /* that of the finest level, not the one the file has */
        (void)snprintf(n, sizeof n, "n=%d", finest->n);
        override[count++] = n;
    }
    if (!verify_scene_find(options->operand[0], path, error) ||
        !solver_scene_load(path, override, count, &beside->scene, error)) {
        return false;
    }
    describe(settings, beside->scene, beside->label);
    describe(settings, finest, beside->label_of_study);
    return check(finest, beside->scene, error);
}

bool verify_beside_run(struct verify_beside *beside, const char *folder, const char *command,
                       struct solver_error *error)
{
    struct solver_run *run = NULL;
    bool done = verify_simulate(beside->scene, folder, command, NULL, NULL, &run, error) &&
                verify_motion_take(solver_run_history(run), &beside->motion, error);
    solver_run_free(run);
    return done;
}

void verify_beside_free(struct verify_beside *beside)
{
    solver_scene_free(beside->scene);
    verify_motion_free(&beside->motion);
    *beside = (struct verify_beside){.scene = NULL};
}

bool verify_beside_measure(const struct verify_beside *beside, const struct solver_history *history,
                           double error[VERIFY_ERRORS], struct solver_error *why)
{
    size_t probes = history->probe_count, count = history->count * probes;
    error[VERIFY_BESIDE] = error[VERIFY_BESIDE_ABS] = NAN;
    if (beside->motion.count == 0 || count == 0) {
        return true;
    }
    double *other = calloc(count, 4 * sizeof *other);
    if (other == NULL) {
        return solver_fail(why, SOLVER_NO_MEMORY, "no memory to compare %zu rows of history", history->count);
    }
    double *weight = other + 3 * count;
    for (size_t i = 0; i < count; i++) {
        verify_motion_at(&beside->motion, i % probes, history->totals[i / probes].time, other + 3 * i);
        weight[i] = 1;
    }
    struct verify_norms norms = verify_norms_field(count, 3, weight, history->probe_u, other);
    error[VERIFY_BESIDE] = norms.relative_l2;
    error[VERIFY_BESIDE_ABS] = norms.absolute_l2;
    free(other);
    return true;
}
