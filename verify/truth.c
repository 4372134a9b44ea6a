#include "verify/truth.h"

#include "verify/manufactured.h"
#include "verify/suggest.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void state_unknown(const struct oracle *oracle, const double X[3], double t, struct oracle_state *state)
{
    (void)oracle;
    (void)X;
    (void)t;
    for (int i = 0; i < 9; i++) {
        state->F[i] = state->P[i] = NAN;
    }
    for (int i = 0; i < 3; i++) {
        state->u[i] = state->v[i] = state->p[i] = NAN;
    }
}

static void energy_unknown(const struct oracle *oracle, double t, double *kinetic, double *strain)
{
    (void)oracle;
    (void)t;
    *kinetic = *strain = NAN;
}

static void destroy_nothing(struct oracle *oracle)
{
    (void)oracle;
}

/* Stands where there is no oracle. */
static const struct oracle_kind unknown = {
    .name = "", .state = state_unknown, .energy = energy_unknown, .destroy = destroy_nothing};

static bool find_kind(const struct solver_scene *scene, const struct oracle_kind **kind, struct solver_error *error)
{
    if (scene->oracle[0] == '\0') {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: the scene answers to no oracle (key oracle.name), so there is nothing to verify it "
                           "against; assay run simulates it",
                           scene->path);
    }
    *kind = oracle_find(scene->oracle);
    if (*kind == NULL) {
        *kind = verify_manufactured_find(scene->oracle, scene->material_model, scene->dim);
    }
    if (*kind != NULL && verify_is_manufactured(*kind) && solver_scene_has(scene, SOLVER_MATERIAL_AT)) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: oracle: \"%s\" is of a body of one material, and the scene has material.at",
                           scene->path, scene->oracle);
    }
    if (*kind == NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: oracle: there is no oracle \"%s\"; assay list shows those there are", scene->path,
                           scene->oracle);
    }
    if ((*kind)->dim != scene->dim) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%s: oracle: \"%s\" is %dD and the scene is %dD", scene->path,
                           scene->oracle, (*kind)->dim, scene->dim);
    }
    return true;
}

/* "material.nu" is also meant by "nu". */
static bool means(const char *key, const char *parameter)
{
    const char *dot = strrchr(parameter, '.');
    return strcmp(key, parameter) == 0 || (dot != NULL && strcmp(key, dot + 1) == 0);
}

static bool refuse_unknown(const struct solver_scene *scene, const struct oracle_kind *kind, struct solver_error *error)
{
    for (size_t i = 0; i < scene->oracle_told_count; i++) {
        const char *names[ORACLE_PARAMETERS];
        size_t count = 0;
        bool known = false;
        for (const struct oracle_parameter *p = kind->parameter; p->name != NULL && count < ORACLE_PARAMETERS; p++) {
            names[count++] = p->name;
            known = known || means(scene->oracle_told[i].name, p->name);
        }
        if (!known) {
            const char *meant = verify_suggest(scene->oracle_told[i].name, names, count);
            return solver_fail(error, SOLVER_BAD_INPUT, "%s: oracle.%s: the oracle \"%s\" has no such parameter%s%s%s",
                               scene->path, scene->oracle_told[i].name, kind->name,
                               meant != NULL ? "; did you mean oracle." : "", meant != NULL ? meant : "",
                               meant != NULL ? "?" : "; assay list oracles shows what it has");
        }
    }
    return true;
}

static bool parameters(const struct solver_scene *scene, struct verify_truth *truth, struct solver_error *error)
{
    for (const struct oracle_parameter *p = truth->kind->parameter; p->name != NULL; p++) {
        size_t i = truth->parameter_count++;
        if (i == ORACLE_PARAMETERS) {
            return solver_fail(error, SOLVER_BAD_INPUT, "the oracle \"%s\" has more than %d parameters",
                               truth->kind->name, (int)ORACLE_PARAMETERS);
        }
        for (size_t j = 0; j < scene->oracle_told_count; j++) {
            if (means(scene->oracle_told[j].name, p->name)) {
                truth->value[i] = scene->oracle_told[j].value;
                truth->told[i] = true;
            }
        }
        if (!truth->told[i] && !solver_scene_number(scene, p->name, &truth->value[i])) {
            return solver_fail(error, SOLVER_BAD_INPUT,
                               "%s: the oracle \"%s\" needs %s (%s) [%s]: give it under parameters or by oracle.%s",
                               scene->path, truth->kind->name, p->name, p->help, p->unit, p->name);
        }
    }
    return true;
}

bool verify_truth_create(const struct solver_scene *scene, struct verify_truth *truth, struct solver_error *error)
{
    *truth = (struct verify_truth){.kind = NULL};
    if (!find_kind(scene, &truth->kind, error) || !refuse_unknown(scene, truth->kind, error) ||
        !parameters(scene, truth, error)) {
        return false;
    }
    char why[ORACLE_WHY] = "";
    if (!oracle_create(truth->kind, truth->value, &truth->oracle, why)) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%s: oracle \"%s\": %s", scene->path, truth->kind->name, why);
    }
    truth->proven = oracle_self_check(truth->kind, truth->oracle, truth->check, &truth->check_count);
    return true;
}

bool verify_truth_open(const struct solver_scene *scene, struct verify_truth *truth, struct solver_error *error)
{
    if (scene->oracle[0] != '\0') {
        return verify_truth_create(scene, truth, error);
    }
    *truth = (struct verify_truth){.kind = &unknown, .proven = true, .none = true};
    return scene->gate_count > 0 ||
           solver_fail(
               error, SOLVER_BAD_INPUT,
               "%s: the scene answers to no oracle (key oracle.name) and has no gates on indicators, so there is "
               "nothing to verify; assay run simulates it",
               scene->path);
}

void verify_truth_free(struct verify_truth *truth)
{
    if (truth->oracle != NULL) {
        truth->kind->destroy(truth->oracle);
    }
    *truth = (struct verify_truth){.kind = NULL};
}
