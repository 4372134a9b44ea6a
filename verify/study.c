#include "verify/study.h"

#include "solver/scheme.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double verify_order(double e1, double h1, double e2, double h2)
{
    bool sensible = e1 >= 0 && e2 >= 0 && h1 > 0 && h2 > 0 && h1 != h2 && !(e1 == 0 && e2 == 0);
    return sensible ? log(e1 / e2) / log(h1 / h2) : NAN;
}

void verify_study_add(struct verify_study *study, const struct verify_level *level)
{
    struct verify_level *added = &study->level[study->level_count];
    *added = *level;
    double particle_steps = (double)level->facts.particles * (double)level->facts.steps;
    added->ns_per_particle_step = 1e9 * level->facts.seconds / particle_steps;
    for (size_t i = 0; i < VERIFY_ERRORS; i++) {
        const struct verify_level *before = added - 1;
        added->rate[i] = study->level_count == 0 ? NAN
                                                 : verify_order(before->error[i], before->facts.spacing,
                                                                added->error[i], added->facts.spacing);
    }
    study->level_count++;
}

static int liveliest(const struct solver_history *history, size_t probe)
{
    double reach[3] = {0};
    for (size_t row = 0; row < history->count; row++) {
        for (int axis = 0; axis < 3; axis++) {
            reach[axis] =
                fmax(reach[axis], fabs(history->probe_u[(row * history->probe_count + probe) * 3 + (size_t)axis]));
        }
    }
    return reach[0] >= reach[1] && reach[0] >= reach[2] ? 0 : reach[1] >= reach[2] ? 1 : 2;
}

bool verify_study_trace(struct verify_study *study, const struct solver_history *history, struct solver_error *error)
{
    for (size_t probe = 0; probe < history->probe_count; probe++) {
        struct verify_trace *trace = &study->trace[study->trace_count];
        *trace = (struct verify_trace){.axis = liveliest(history, probe), .count = history->count};
        trace->time = calloc(history->count, 2 * sizeof *trace->time);
        if (trace->time == NULL) {
            return solver_fail(error, SOLVER_NO_MEMORY, "no memory for the traces of %zu probes", history->probe_count);
        }
        study->trace_count++;
        trace->displacement = trace->time + history->count;
        memcpy(trace->name, history->probe_name[probe], sizeof trace->name);
        memcpy(trace->X, history->probe_X[probe], sizeof trace->X);
        for (size_t row = 0; row < history->count; row++) {
            trace->time[row] = history->totals[row].time;
            trace->displacement[row] = history->probe_u[(row * history->probe_count + probe) * 3 + (size_t)trace->axis];
        }
    }
    return true;
}

void verify_study_free(struct verify_study *study)
{
    for (size_t i = 0; i < study->trace_count; i++) {
        free(study->trace[i].time);
    }
    for (size_t i = 0; i < study->level_count; i++) {
        verify_level_free(&study->level[i]);
    }
    study->trace_count = study->level_count = 0;
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

/* Keys that say how a scene is solved, not what it is. */
static bool is_method(const char *key, size_t length)
{
    static const char *const methods[] = {"scheme",      "evolved",    "stencil", "support",   "reconstruction",
                                          "volume_flux", "integrator", "cfl",     "n",         "perturb",
                                          "seed",        "precision",  "threads", "snapshots", "history"};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        if (strlen(methods[i]) == length && strncmp(methods[i], key, length) == 0) {
            return true;
        }
    }
    return strncmp(key, "oracle.", 7) == 0 || strncmp(key, "view.", 5) == 0;
}

/* Whether all overrides of the command line leave the problem that was published. */
static bool is_as_published(const struct solver_scene *scene)
{
    for (const char *line = scene->overrides; line != NULL && *line != '\0';) {
        size_t length = strcspn(line, "\n");
        if (!is_method(line, strcspn(line, "="))) {
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

size_t verify_shown(const struct solver_scene *scene, size_t shown[VERIFY_ERRORS], struct solver_error *error)
{
    bool wanted[VERIFY_ERRORS] = {false};
    for (size_t i = 0; i < scene->published_count; i++) {
        for (size_t j = 0; j < scene->published[i].count; j++) {
            const char *name = scene->published[i].value[j].name;
            want(wanted, verify_error_find(name));
            if (verify_error_find(name) == VERIFY_ERRORS) {
                (void)solver_fail(error, SOLVER_BAD_INPUT,
                                  "%s: published: there is no error called \"%s\"; there are %s", scene->path, name,
                                  verify_error_names);
                return 0;
            }
        }
    }
    for (size_t i = 0; i < scene->gate_count; i++) {
        for (size_t j = 0; j < scene->gate[i].bounds; j++) {
            const char *name = scene->gate[i].bound[j].name;
            want(wanted, verify_level_error(name, NULL));
        }
    }
    size_t count = 0;
    for (size_t i = 0; i < VERIFY_ERRORS; i++) {
        if (wanted[i] && verify_error_known(scene, i)) {
            shown[count++] = i;
        }
    }
    if (count == 0) {
        shown[count++] = verify_error_find("p");
        shown[count++] = verify_error_find(verify_error_known(scene, verify_error_find("P")) ? "P" : "sigma");
    }
    return count;
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
