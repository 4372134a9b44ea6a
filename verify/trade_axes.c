/* Which keys a study of costs varies, and what values it tries. */
#include "solver/suggest.h"
#include "verify/gates.h"
#include "verify/trade.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What is varied unless the command line says otherwise; NULL: every word that the key can have. */
static const struct {
    const char *key, *values;
} usual[] = {
    {"scheme", NULL},     {"stencil", NULL},      {"support", "1.6,2,2.4"}, {"evolved", NULL},
    {"integrator", NULL}, {"cfl", "0.3,0.5,0.8"}, {"precision", NULL},
};

/* Whether one of the overrides sets the key. */
static bool is_set(const struct verify_options *options, const char *key)
{
    size_t length = strlen(key);
    for (size_t i = 0; i < options->override_count; i++) {
        if (strncmp(options->override[i], key, length) == 0 && options->override[i][length] == '=') {
            return true;
        }
    }
    return false;
}

static bool add_value(struct verify_trade_axis *axis, const char *value, size_t length, struct solver_error *error)
{
    if (length == 0 || length >= SOLVER_NAME || axis->count == VERIFY_TRADE_VALUES ||
        strcspn(value, " \t{}") < length) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "--vary %s: expected up to %d values with commas between, as in --vary cfl=0.3,0.8; a list "
                           "is none",
                           axis->key, (int)VERIFY_TRADE_VALUES);
    }
    char *added = axis->value[axis->count];
    (void)snprintf(added, SOLVER_NAME, "%.*s", (int)length, value);
    for (size_t i = 0; i < axis->count; i++) {
        if (verify_same_value(axis->value[i], added)) {
            return solver_fail(error, SOLVER_BAD_INPUT, "--vary %s: %s is given twice", axis->key, added);
        }
    }
    axis->count++;
    return true;
}

/* A slip of the hand would else be told when the budget is spent: the word is one that the key can have, or a number
 * where it takes no words. */
static bool check_value(const char *key, const char *value, struct solver_error *error)
{
    char word[VERIFY_TRADE_VALUES][SOLVER_NAME], list[512] = "", *end = NULL;
    const char *names[VERIFY_TRADE_VALUES];
    size_t count = solver_scene_words(key, word, VERIFY_TRADE_VALUES), used = 0;
    for (size_t i = 0; i < count; i++) {
        if (strcmp(word[i], value) == 0) {
            return true;
        }
        names[i] = word[i];
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", i > 0 ? ", " : "", word[i]);
    }
    if (count == 0) {
        double number = strtod(value, &end);
        return (end != value && *end == '\0' && isfinite(number)) ||
               solver_fail(error, SOLVER_BAD_INPUT, "--vary %s=%s: expected a number", key, value);
    }
    const char *meant = solver_suggest(value, names, count);
    return solver_fail(error, SOLVER_BAD_INPUT, "--vary %s=%s: expected one of %s%s%s%s", key, value, list,
                       meant != NULL ? "; did you mean " : "", meant != NULL ? meant : "", meant != NULL ? "?" : "");
}

static bool add_values(struct verify_trade_axis *axis, const char *values, struct solver_error *error)
{
    for (const char *value = values;; value++) {
        size_t length = strcspn(value, ",");
        if (!add_value(axis, value, length, error)) {
            return false;
        }
        value += length;
        if (*value == '\0') {
            return true;
        }
    }
}

/* The scene's own value is always among them. */
static bool add_usual(const struct solver_scene *scene, size_t which, struct verify_trade *trade,
                      struct solver_error *error)
{
    struct verify_trade_axis *axis = &trade->axis[trade->axis_count++];
    char own[SOLVER_TEXT] = "";
    (void)snprintf(axis->key, sizeof axis->key, "%s", usual[which].key);
    if (usual[which].values == NULL) {
        axis->count = solver_scene_words(axis->key, axis->value, VERIFY_TRADE_VALUES);
    } else if (!add_values(axis, usual[which].values, error)) {
        return false;
    }
    bool there = !solver_scene_text(scene, axis->key, own, sizeof own);
    for (size_t i = 0; i < axis->count; i++) {
        there = there || verify_same_value(axis->value[i], own);
    }
    return there || add_value(axis, own, strlen(own), error);
}

static bool refuse_key(const char *text, size_t length, struct solver_error *error)
{
    const char *names[sizeof usual / sizeof *usual];
    char key[SOLVER_NAME];
    for (size_t i = 0; i < sizeof usual / sizeof *usual; i++) {
        names[i] = usual[i].key;
    }
    (void)snprintf(key, sizeof key, "%.*s", (int)length, text);
    const char *meant = solver_suggest(key, names, sizeof names / sizeof *names);
    return solver_fail(error, SOLVER_BAD_INPUT,
                       "--vary %s: no key that says how a problem is solved, as scheme, stencil, support, evolved, "
                       "integrator, cfl or precision do%s%s%s",
                       key, meant != NULL ? "; did you mean " : "", meant != NULL ? meant : "",
                       meant != NULL ? "?" : "; levels have an option of their own");
}

static bool add_asked(const struct verify_options *options, const char *text, struct verify_trade *trade,
                      struct solver_error *error)
{
    size_t length = strcspn(text, "=");
    if (!verify_trade_key(text, length)) {
        return refuse_key(text, length, error);
    }
    struct verify_trade_axis *axis = &trade->axis[trade->axis_count++];
    (void)snprintf(axis->key, sizeof axis->key, "%.*s", (int)length, text);
    for (size_t i = 0; i + 1 < trade->axis_count; i++) {
        if (strcmp(trade->axis[i].key, axis->key) == 0) {
            return solver_fail(error, SOLVER_BAD_INPUT, "--vary %s: given twice", axis->key);
        }
    }
    if (is_set(options, axis->key)) {
        return solver_fail(error, SOLVER_BAD_INPUT, "--vary %s: --set fixes this key", axis->key);
    }
    if (!add_values(axis, text + length + 1, error)) {
        return false;
    }
    for (size_t i = 0; i < axis->count; i++) {
        if (!check_value(axis->key, axis->value[i], error)) {
            return false;
        }
    }
    return true;
}

static bool has_axis(const struct verify_trade *trade, const char *key)
{
    for (size_t i = 0; i < trade->axis_count; i++) {
        if (strcmp(trade->axis[i].key, key) == 0) {
            return true;
        }
    }
    return false;
}

bool verify_trade_axes(const struct verify_options *options, const struct solver_scene *scene,
                       struct verify_trade *trade, struct solver_error *error)
{
    for (size_t i = 0; i < options->vary.count; i++) {
        if (trade->axis_count == VERIFY_TRADE_AXES - sizeof usual / sizeof *usual) {
            return solver_fail(error, SOLVER_BAD_INPUT, "too many --vary");
        }
        if (!add_asked(options, options->vary.text[i], trade, error)) {
            return false;
        }
    }
    for (size_t i = 0; i < sizeof usual / sizeof *usual; i++) {
        if (!is_set(options, usual[i].key) && !has_axis(trade, usual[i].key) && !add_usual(scene, i, trade, error)) {
            return false;
        }
    }
    return true;
}
