#include "verify/gates.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool verify_gate_judge(double value, const char *op, double bound)
{
    if (!isfinite(value) || !isfinite(bound)) {
        return false;
    }
    return strcmp(op, "<=") == 0 ? value <= bound : strcmp(op, ">=") == 0 && value >= bound;
}

bool verify_same_value(const char *a, const char *b)
{
    char *end_a = NULL, *end_b = NULL;
    double x = strtod(a, &end_a), y = strtod(b, &end_b);
    bool numbers = end_a != a && *end_a == '\0' && end_b != b && *end_b == '\0';
    return numbers ? x == y : strcmp(a, b) == 0;
}

static bool holds(const struct solver_scene *scene, size_t index, bool *met, struct solver_error *why)
{
    const struct solver_gate_rule *rule = &scene->gate[index];
    *met = true;
    for (size_t i = 0; i < rule->conditions; i++) {
        char text[SOLVER_TEXT];
        if (!solver_scene_text(scene, rule->key[i], text, sizeof text)) {
            return solver_fail(why, SOLVER_BAD_INPUT,
                               "%s: gates[%zu].when.%s: the scene has no such key; see assay list keys", scene->path,
                               index + 1, rule->key[i]);
        }
        *met = *met && verify_same_value(text, rule->text[i]);
    }
    return true;
}

static bool judge_bound(const struct solver_scene *scene, size_t index, const struct solver_named *bound,
                        const struct verify_level *finest, struct verify_gate *gate, struct solver_error *why)
{
    char where[SOLVER_TEXT];
    struct verify_value measured;
    (void)snprintf(where, sizeof where, "%.400s: gates[%zu]", scene->path, index + 1);
    if (!verify_level_value(scene, finest, bound->name, where, &measured, why)) {
        return false;
    }
    *gate = (struct verify_gate){
        .value = measured.value, .bound = bound->value, .op = measured.op, .unit = measured.unit, .why = measured.why};
    (void)snprintf(gate->name, sizeof gate->name, "%s", bound->name);
    gate->pass = verify_gate_judge(gate->value, gate->op, gate->bound);
    return true;
}

/* A rule for other configurations may name a field that this scene's scheme does not know. */
static bool is_unknown(const struct solver_scene *scene, const char *name)
{
    size_t error = verify_level_error(name, NULL);
    return error < VERIFY_ERRORS && !verify_error_known(scene, error);
}

bool verify_gates_judge(const struct solver_scene *scene, const struct verify_level *finest, struct verify_gates *gates,
                        struct solver_error *why)
{
    bool met[SOLVER_GATES] = {false}, any_with_conditions = false, some_for_others = false;
    for (size_t i = 0; i < scene->gate_count; i++) {
        if (!holds(scene, i, &met[i], why)) {
            return false;
        }
        any_with_conditions = any_with_conditions || (met[i] && scene->gate[i].conditions > 0);
        some_for_others = some_for_others || scene->gate[i].conditions > 0;
    }
    gates->count = 0;
    gates->general = some_for_others && !any_with_conditions;
    gates->pass = true;
    for (size_t i = 0; i < scene->gate_count; i++) {
        bool judged = met[i] && !(any_with_conditions && scene->gate[i].conditions == 0);
        for (size_t j = 0; j < scene->gate[i].bounds; j++) {
            struct verify_gate gate = {.pass = false};
            if (!judged && is_unknown(scene, scene->gate[i].bound[j].name)) {
                continue;
            }
            if (!judge_bound(scene, i, &scene->gate[i].bound[j], finest, &gate, why)) {
                return false;
            }
            if (judged) {
                gates->gate[gates->count++] = gate;
                gates->pass = gates->pass && gate.pass;
            }
        }
    }
    gates->pass = gates->pass && gates->count > 0;
    return true;
}
