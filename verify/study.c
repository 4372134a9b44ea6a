#include "verify/study.h"

#include "solver/scheme.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Errors that are not there are NaN, and one may be zero or infinite: none of these is computed with. */
double verify_order(double e1, double h1, double e2, double h2)
{
    bool sensible =
        isfinite(e1) && isfinite(e2) && e1 >= 0 && e2 >= 0 && isgreater(h1, 0) && isgreater(h2, 0) && h1 != h2;
    if (!sensible || (e1 == 0 && e2 == 0)) {
        return NAN;
    }
    return e2 == 0   ? copysign(INFINITY, log(h1 / h2))
           : e1 == 0 ? -copysign(INFINITY, log(h1 / h2))
                     : log(e1 / e2) / log(h1 / h2);
}

/* NaN if there is no level before. */
static double order_from(const struct verify_level *before, double error_before, const struct verify_level *now,
                         double error)
{
    return before == NULL ? NAN : verify_order(error_before, before->facts.spacing, error, now->facts.spacing);
}

void verify_study_add(struct verify_study *study, const struct verify_level *level)
{
    struct verify_level *added = &study->level[study->level_count];
    *added = *level;
    double particle_steps = (double)level->facts.particles * (double)level->facts.steps;
    added->ns_per_particle_step = 1e9 * level->facts.seconds / particle_steps;
    const struct verify_level *before = study->level_count > 0 ? added - 1 : NULL;
    added->follows = before != NULL;
    for (size_t i = 0; i < VERIFY_ERRORS; i++) {
        added->rate[i] = verify_error_has_order(i)
                             ? order_from(before, before != NULL ? before->error[i] : NAN, added, added->error[i])
                             : NAN;
    }
    for (size_t i = 0; i < SOLVER_FIGURES; i++) {
        struct verify_figure *figure = &added->figure[i];
        figure->rate = order_from(before, before != NULL ? before->figure[i].error : NAN, added, figure->error);
    }
    study->level_count++;
}

bool verify_study_history(struct verify_study *study, const struct solver_history *history, struct solver_error *error)
{
    study->totals = calloc(history->count, sizeof *study->totals);
    if (study->totals == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for %zu rows of history", history->count);
    }
    memcpy(study->totals, history->totals, history->count * sizeof *study->totals);
    study->total_count = history->count;
    study->first = history->totals[0];
    study->last = history->totals[history->count - 1];
    for (size_t probe = 0; probe < history->probe_count; probe++) {
        if (!verify_trace_take(history, probe, &study->trace[study->trace_count], error)) {
            return false;
        }
        study->trace_count++;
    }
    return true;
}

void verify_study_free(struct verify_study *study)
{
    verify_motion_free(&study->motion);
    for (size_t i = 0; i < study->trace_count; i++) {
        verify_trace_free(&study->trace[i]);
    }
    for (size_t i = 0; i < study->level_count; i++) {
        verify_level_free(&study->level[i]);
    }
    free(study->totals);
    study->totals = NULL;
    study->trace_count = study->level_count = study->total_count = 0;
}

bool verify_study_judge(struct verify_study *study, struct solver_error *error)
{
    return verify_gates_judge(study->scene, &study->level[study->level_count - 1], &study->gates, error);
}

const char *verify_verdict(const struct verify_study *study)
{
    return study->gates.count == 0 ? "NOT JUDGED: no gate of the scene holds for this configuration"
           : !study->gates.pass    ? "FAIL: a gate does not hold"
           : study->gates.general
               ? "PASS, but only of the bounds that the scene has for any configuration: none is set "
                 "for this one"
               : "PASS: all gates hold";
}

/* Whether all overrides of the command line leave the problem that was published. */
static bool is_as_published(const struct solver_scene *scene)
{
    for (const char *line = scene->overrides; line != NULL && *line != '\0';) {
        size_t length = strcspn(line, "\n");
        if (solver_scene_key_says(line, strcspn(line, "=")) == SOLVER_KEY_PROBLEM) {
            return false;
        }
        line += length + (line[length] == '\n' ? 1 : 0);
    }
    return true;
}

double verify_published(const struct solver_scene *scene, int n, const char *error_name)
{
    for (size_t i = 0; is_as_published(scene) && i < scene->published_count; i++) {
        const struct solver_published_row *row = &scene->published[i];
        for (size_t j = 0; row->n == n && j < row->count; j++) {
            if (strcmp(row->value[j].name, error_name) == 0) {
                return row->value[j].value;
            }
        }
    }
    return NAN;
}

bool verify_has_stencil(const struct solver_scene *scene)
{
    const struct solver_scheme *scheme = solver_scheme_find(scene->scheme);
    return scheme == NULL || scheme->stencil;
}

static void want(bool wanted[VERIFY_ERRORS], size_t error)
{
    if (error < VERIFY_ERRORS) {
        wanted[error] = true;
    }
}

/* Those wanted that the scheme knows and that can be measured; p and the stress where nothing is asked of the oracle,
 * then differences from the configuration beside. */
static size_t list(const struct solver_scene *scene, const bool wanted[VERIFY_ERRORS], size_t shown[VERIFY_ERRORS])
{
    size_t count = 0;
    for (size_t i = 0; i < VERIFY_BESIDE && scene->oracle[0] != '\0'; i++) {
        if (wanted[i] && verify_error_known(scene, i)) {
            shown[count++] = i;
        }
    }
    if (count == 0 && scene->oracle[0] != '\0') {
        shown[count++] = verify_error_find("p");
        shown[count++] = verify_error_find(verify_error_known(scene, verify_error_find("P")) ? "P" : "sigma");
    }
    for (size_t i = VERIFY_BESIDE; i < VERIFY_ERRORS && scene->beside.count > 0; i++) {
        shown[count++] = i;
    }
    return count;
}

bool verify_shown(const struct solver_scene *scene, size_t shown[VERIFY_ERRORS], size_t *count,
                  struct solver_error *error)
{
    bool wanted[VERIFY_ERRORS] = {false};
    for (size_t i = 0; i < scene->published_count; i++) {
        for (size_t j = 0; j < scene->published[i].count; j++) {
            const char *name = scene->published[i].value[j].name;
            want(wanted, verify_error_find(name));
            if (verify_error_find(name) == VERIFY_ERRORS) {
                return solver_fail(error, SOLVER_BAD_INPUT,
                                   "%s: published: there is no error called \"%s\"; there are %s", scene->path, name,
                                   verify_error_names);
            }
        }
    }
    for (size_t i = 0; i < scene->gate_count; i++) {
        for (size_t j = 0; j < scene->gate[i].bounds; j++) {
            const char *name = scene->gate[i].bound[j].name;
            want(wanted, verify_level_error(name, NULL));
        }
    }
    *count = list(scene, wanted, shown);
    return true;
}

size_t verify_shown_snapshots(const size_t *shown, size_t shown_count, size_t of_state[VERIFY_STATE_ERRORS])
{
    size_t count = 0;
    for (size_t i = 0; i < shown_count; i++) {
        if (shown[i] >= VERIFY_SNAPSHOT_ERRORS && shown[i] < VERIFY_SNAPSHOT_ERRORS + VERIFY_STATE_ERRORS) {
            of_state[count++] = shown[i] - VERIFY_SNAPSHOT_ERRORS;
        }
    }
    return count;
}
