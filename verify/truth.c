#include "verify/truth.h"

#include "solver/suggest.h"
#include "verify/inside.h"
#include "verify/manufactured.h"

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
    if (*kind != NULL && verify_is_manufactured(*kind) && solver_scene_flows(scene) &&
        (verify_plastic_strain_extra(*kind) < 0 || scene->hardening.law != SOLVER_HARDENING_LINEAR)) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: oracle: \"%s\" is of an elastic body%s, and the scene has material.yield_stress",
                           scene->path, scene->oracle,
                           verify_plastic_strain_extra(*kind) < 0 ? "" : ", or one that hardens linearly");
    }
    if (*kind == NULL && verify_manufactured_find(scene->oracle, NULL, 0) != NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: oracle: \"%s\" is a whole name; a scene names the motion alone, as in "
                           "manufactured-stretch, and gives material.model and dim itself",
                           scene->path, scene->oracle);
    }
    if (*kind == NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: oracle: there is no oracle \"%s\"; assay list shows those there are", scene->path,
                           scene->oracle);
    }
    if ((*kind)->awaits != NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: oracle: \"%s\" cannot judge a run, because the solver lacks %s", scene->path,
                           scene->oracle, (*kind)->awaits);
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

/* What gives the oracle its parameters, for messages: a scene by its key oracle, or a command line by an option. */
struct teller {
    const char *where, *key; /* "swinging-cube.lua", "oracle."; "--param", "" */
    const struct solver_named *told;
    size_t count;
};

static bool refuse_unknown(const struct teller *teller, const struct oracle_kind *kind, struct solver_error *error)
{
    for (size_t i = 0; i < teller->count; i++) {
        const char *names[ORACLE_PARAMETERS];
        size_t count = 0;
        bool known = false;
        for (const struct oracle_parameter *p = kind->parameter; p->name != NULL && count < ORACLE_PARAMETERS; p++) {
            names[count++] = p->name;
            known = known || means(teller->told[i].name, p->name);
        }
        if (!known) {
            const char *meant = solver_suggest(teller->told[i].name, names, count);
            return solver_fail(error, SOLVER_BAD_INPUT, "%s: %s%s: the oracle \"%s\" has no such parameter%s%s%s%s",
                               teller->where, teller->key, teller->told[i].name, kind->name,
                               meant != NULL ? "; did you mean " : "", meant != NULL ? teller->key : "",
                               meant != NULL ? meant : "",
                               meant != NULL ? "?" : "; assay list oracles shows what it has");
        }
    }
    return true;
}

/* What was told of a parameter, the last word counting; false if nothing was. */
static bool is_told(const struct teller *teller, const struct oracle_parameter *parameter, double *value)
{
    bool told = false;
    for (size_t i = 0; i < teller->count; i++) {
        if (means(teller->told[i].name, parameter->name)) {
            *value = teller->told[i].value;
            told = true;
        }
    }
    return told;
}

static bool few_enough(const struct oracle_kind *kind, struct solver_error *error)
{
    size_t count = 0;
    while (kind->parameter[count].name != NULL) {
        count++;
    }
    return count <= ORACLE_PARAMETERS ||
           solver_fail(error, SOLVER_BAD_INPUT, "the oracle \"%s\" has more than %d parameters", kind->name,
                       (int)ORACLE_PARAMETERS);
}

/* Whether the body itself starts from the oracle, or is driven by it: by what the scene says, not by what the oracle is
 * told. */
static bool leads(const struct solver_scene *scene)
{
    return strcmp(scene->initial_from, "oracle") == 0 || strcmp(scene->loads_from, "oracle") == 0;
}

static bool parameters(const struct solver_scene *scene, const struct teller *teller, struct verify_truth *truth,
                       struct solver_error *error)
{
    for (const struct oracle_parameter *p = truth->kind->parameter; p->name != NULL; p++) {
        size_t i = truth->parameter_count++;
        bool said = solver_scene_number(scene, p->name, &truth->value[i]);
        truth->told[i] = is_told(teller, p, &truth->value[i]);
        if (!said && (!truth->told[i] || leads(scene))) {
            return solver_fail(error, SOLVER_BAD_INPUT,
                               "%s: the oracle \"%s\" needs %s (%s) [%s]: give it under parameters%s%s", scene->path,
                               truth->kind->name, p->name, p->help, p->unit,
                               leads(scene) ? ", as the body starts from it or is driven by it" : " or by oracle.",
                               leads(scene) ? "" : p->name);
        }
    }
    return true;
}

/* Creates the oracle from the values and has it prove itself. */
static bool create(const char *where, struct verify_truth *truth, struct solver_error *error)
{
    char why[ORACLE_WHY] = "";
    if (!oracle_create(truth->kind, truth->value, &truth->oracle, why)) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%s: oracle \"%s\": %s", where, truth->kind->name, why);
    }
    truth->proven = oracle_self_check(truth->kind, truth->oracle, truth->check, &truth->check_count);
    return true;
}

bool verify_truth_create(const struct solver_scene *scene, struct verify_truth *truth, struct solver_error *error)
{
    struct teller teller = {
        .where = scene->path, .key = "oracle.", .told = scene->oracle_told, .count = scene->oracle_told_count};
    *truth = (struct verify_truth){.kind = NULL};
    if (!find_kind(scene, &truth->kind, error) || !few_enough(truth->kind, error) ||
        !refuse_unknown(&teller, truth->kind, error) || !parameters(scene, &teller, truth, error)) {
        return false;
    }
    if (!create(scene->path, truth, error)) {
        return false;
    }
    bool inside = verify_inside_domain(scene, truth, error);
    if (!inside) {
        verify_truth_free(truth);
    }
    return inside;
}

/* All that is missing, at once. */
static bool refuse_missing(const struct oracle_kind *kind, const bool *given, struct solver_error *error)
{
    char missing[768] = "";
    size_t used = 0;
    for (size_t i = 0; kind->parameter[i].name != NULL && used < sizeof missing; i++) {
        const struct oracle_parameter *p = &kind->parameter[i];
        if (!given[i]) {
            int added = snprintf(missing + used, sizeof missing - used, "\n  --param %s=%g   [%s] %s", p->name,
                                 p->typical, p->unit, p->help);
            used += added > 0 ? (size_t)added : 0;
        }
    }
    return solver_fail(error, SOLVER_BAD_INPUT,
                       "the oracle \"%s\" needs more parameters; give them, or --typical for these values:%s",
                       kind->name, missing);
}

/* NULL, with the error, if there is none of that name. */
static const struct oracle_kind *find_named(const char *name, struct solver_error *error)
{
    const char *names[256];
    size_t count = 0;
    const struct oracle_kind *kind = verify_kind_find(name);
    for (const struct oracle_kind *const *k = oracle_kinds(); *k != NULL && count < sizeof names / sizeof *names; k++) {
        names[count++] = (*k)->name;
    }
    const char *meant = kind == NULL ? solver_suggest(name, names, count) : NULL;
    if (kind == NULL) {
        (void)solver_fail(error, SOLVER_BAD_INPUT, "there is no oracle \"%s\"%s%s%s", name,
                          meant != NULL ? "; did you mean " : "", meant != NULL ? meant : "",
                          meant != NULL ? "?" : "; assay list oracles shows those there are");
    }
    return kind;
}

bool verify_truth_tell(const char *name, const struct solver_named *told, size_t count, bool typical,
                       struct verify_truth *truth, struct solver_error *error)
{
    struct teller teller = {.where = "--param", .key = "", .told = told, .count = count};
    bool given[ORACLE_PARAMETERS] = {false}, all = true;
    const struct oracle_kind *kind = find_named(name, error);
    *truth = (struct verify_truth){.kind = kind};
    if (kind == NULL || !few_enough(kind, error) || !refuse_unknown(&teller, kind, error)) {
        return false;
    }
    for (const struct oracle_parameter *p = kind->parameter; p->name != NULL; p++) {
        size_t i = truth->parameter_count++;
        truth->value[i] = p->typical;
        given[i] = is_told(&teller, p, &truth->value[i]) || typical;
        all = all && given[i];
    }
    return (all || refuse_missing(kind, given, error)) && create("--param", truth, error);
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

void verify_truth_energy(const struct verify_truth *truth, const struct solver_scene *scene, double t, double *kinetic,
                         double *strain)
{
    double share = 1.0;
    for (int axis = 0; axis < scene->dim; axis++) {
        if (scene->symmetric[axis]) {
            share *= solver_shape_in_box(scene->domain.kind) ? NAN : 0.5;
        }
    }
    truth->kind->energy(truth->oracle, t, kinetic, strain);
    *kinetic *= share;
    *strain *= share;
}
