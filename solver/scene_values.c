/* Reads plain keys out of a scene by the table in scene_keys.c. */
#include "solver/scene_internal.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

double scene_read_number(lua_State *L, const char *key, int index, double low, double high, const char *expected)
{
    double value = lua_type(L, index) == LUA_TNUMBER ? lua_tonumber(L, index) : NAN;
    if (!(isgreaterequal(value, low) && islessequal(value, high))) { /* refuses NaN */
        if (lua_type(L, index) == LUA_TNUMBER && !isfinite(value))
            scene_refuse(L, "%s: expected %s, got %s", key, expected, isnan(value) ? "NaN" : "an infinite number");
        scene_refuse_value(L, key, expected, index);
    }
    return value;
}

static int read_integer(lua_State *L, const char *key, int index, double low, double high, const char *expected)
{
    double value = scene_read_number(L, key, index, low, high, expected);
    if (value != floor(value))
        scene_refuse_value(L, key, expected, index);
    return (int)value;
}

void scene_read_text(lua_State *L, const char *key, int index, char *out, size_t size)
{
    if (lua_type(L, index) != LUA_TSTRING)
        scene_refuse_value(L, key, "text", index);
    size_t length;
    const char *text = lua_tolstring(L, index, &length);
    if (length == 0 || length >= size)
        scene_refuse(L, "%s: expected text of 1 to %zu bytes, got %zu", key, size - 1, length);
    for (size_t i = 0; i < length; i++)
        if ((unsigned char)text[i] < ' ')
            scene_refuse(L, "%s: expected text on one line, got a control character (code %d)", key, text[i]);
    memcpy(out, text, length + 1);
    solver_plain(out, false);
    if (memcmp(out, text, length) != 0)
        scene_refuse(L, "%s: expected text in UTF-8 without control characters", key);
}

void scene_read_numbers(lua_State *L, const char *key, int index, double *out, size_t count)
{
    char expected[64], entry[2 * SOLVER_NAME];
    snprintf(expected, sizeof expected, "a list of %zu number%s", count, count == 1 ? "" : "s");
    if (!lua_istable(L, index))
        scene_refuse_value(L, key, expected, index);
    index = lua_absindex(L, index);
    size_t found = 0;
    for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1))
        found++;
    if (found != count || lua_rawlen(L, index) != count)
        scene_refuse(L, "%s: expected %s, got %zu entries", key, expected, found);
    for (size_t i = 0; i < count; i++) {
        lua_rawgeti(L, index, (lua_Integer)i + 1);
        snprintf(entry, sizeof entry, "%.100s[%zu]", key, i + 1);
        out[i] = scene_read_number(L, entry, -1, -DBL_MAX, DBL_MAX, "a number");
        lua_pop(L, 1);
    }
}

/* Returns the place of the word at `index` among the admissible ones. */
static int read_word(lua_State *L, const struct solver_scene_key *key, const struct scene_key *rule, int index)
{
    bool later = false;
    int place = lua_type(L, index) == LUA_TSTRING ? scene_word_find(rule->words, lua_tostring(L, index), &later) : -1;
    if (place >= 0 && later)
        scene_refuse(L, "%s: '%s' is not there yet; expected %s", key->key, lua_tostring(L, index), key->expects);
    if (place < 0)
        scene_refuse_value(L, key->key, key->expects, index);
    return place;
}

static uint64_t read_seed(lua_State *L, const struct solver_scene_key *key)
{
    int whole = 0;
    lua_Integer seed = lua_type(L, -1) == LUA_TNUMBER ? lua_tointegerx(L, -1, &whole) : 0;
    if (!whole || seed < 0)
        scene_refuse_value(L, key->key, key->expects, -1);
    return (uint64_t)seed;
}

/* Of at most two. */
static void read_integers(lua_State *L, const struct solver_scene_key *key, const struct scene_key *rule, int *out,
                          size_t count)
{
    double pair[2];
    scene_read_numbers(L, key->key, -1, pair, count);
    for (size_t i = 0; i < count; i++) {
        if (!(pair[i] >= rule->low && pair[i] <= rule->high && pair[i] == floor(pair[i])))
            scene_refuse(L, "%s: expected %s, got %g in place %zu", key->key, key->expects, pair[i], i + 1);
        out[i] = (int)pair[i];
    }
}

/* Reads the value on top of the stack into its place within the scene. */
static void read_value(lua_State *L, struct solver_scene *scene, int k)
{
    const struct solver_scene_key *key = &solver_scene_keys()[k];
    const struct scene_key *rule = scene_key_rule(k);
    void *place = (char *)scene + rule->offset;
    size_t count = rule->count ? (size_t)rule->count : (size_t)scene->dim;
    switch (rule->kind) {
    case SCENE_TEXT:
        scene_read_text(L, key->key, -1, place, rule->count ? (size_t)rule->count : SOLVER_TEXT);
        break;
    case SCENE_WORD:
        read_word(L, key, rule, -1);
        snprintf(place, SOLVER_NAME, "%s", lua_tostring(L, -1));
        break;
    case SCENE_INDEX:
        *(int *)place = read_word(L, key, rule, -1);
        break;
    case SCENE_FLAG:
        if (!lua_isboolean(L, -1))
            scene_refuse_value(L, key->key, key->expects, -1);
        *(bool *)place = lua_toboolean(L, -1);
        break;
    case SCENE_NUMBER:
        *(double *)place = scene_read_number(L, key->key, -1, rule->low, rule->high, key->expects);
        break;
    case SCENE_INTEGER:
        *(int *)place = read_integer(L, key->key, -1, rule->low, rule->high, key->expects);
        break;
    case SCENE_SEED:
        *(uint64_t *)place = read_seed(L, key);
        break;
    case SCENE_NUMBERS:
        scene_read_numbers(L, key->key, -1, place, count);
        break;
    case SCENE_INTEGERS:
        read_integers(L, key, rule, place, count);
        break;
    case SCENE_FORMULA:
        if (!lua_isfunction(L, -1))
            scene_refuse_value(L, key->key, key->expects, -1);
        lua_pushvalue(L, -1);
        scene_lua_keep_formula(L, (enum solver_formula)rule->offset);
        break;
    case SCENE_FACE:
    case SCENE_RESOLUTION:
    case SCENE_STRUCTURED:
        break;
    }
}

/* Refuses what the scene puts into a group of plain keys ("material") beside them. */
static void check_group(lua_State *L, const char *group)
{
    scene_lua_push(L, group);
    if (!lua_isnil(L, -1)) {
        char path[2 * SOLVER_NAME], near[SOLVER_TEXT];
        if (!lua_istable(L, -1))
            scene_refuse_value(L, group, "a table", -1);
        for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1)) {
            if (lua_type(L, -2) != LUA_TSTRING)
                scene_refuse_value(L, group, "names as keys", -2);
            snprintf(path, sizeof path, "%s.%.60s", group, lua_tostring(L, -2));
            if (scene_key_find(path) >= 0)
                continue;
            scene_key_suggest(path, near, sizeof near);
            scene_refuse(L, "%s: unknown key%s", path, near);
        }
    }
    lua_pop(L, 1);
}

/* What a key without a value has: a body in a plane is seen face on. */
static const char *preset_of(const struct solver_scene *scene, const struct solver_scene_key *key,
                             const struct scene_key *rule)
{
    bool flat = scene->dim < 3;
    return flat && !strcmp(key->key, "view.direction") ? "{0,0,1}"
           : flat && !strcmp(key->key, "view.up")      ? "{0,1,0}"
                                                       : rule->preset;
}

void scene_read_plain(lua_State *L, struct solver_scene *scene)
{
    static const char *const groups[] = {"domain", "material", "incompressible", "jst",  "ulsph",  "contact",
                                         "golden", "initial",  "faces",          "view", "grading"};
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++)
        check_group(L, groups[i]);
    scene_lua_push(L, "view");
    scene->has_view = !lua_isnil(L, -1);
    lua_pop(L, 1);
    for (int k = 0; solver_scene_keys()[k].key; k++) {
        const struct solver_scene_key *key = &solver_scene_keys()[k];
        const struct scene_key *rule = scene_key_rule(k);
        if (!scene->has_view && !strncmp(key->key, "view.", 5))
            continue;
        scene_lua_push(L, key->key);
        if (lua_isnil(L, -1)) {
            lua_pop(L, 1);
            const char *preset = preset_of(scene, key, rule);
            if (!preset)
                scene_refuse(L, "%s: missing; expected %s (%s)", key->key, key->expects, key->meaning);
            if (!preset[0])
                continue;
            scene_push_spelling(L, key->key, preset);
        }
        read_value(L, scene, k);
        lua_pop(L, 1);
    }
}

bool solver_scene_number(const struct solver_scene *scene, const char *path, double *value)
{
    const struct solver_scene_lua *lua = scene->lua;
    for (size_t i = 0; i < lua->parameter_count; i++)
        if (!strcmp(lua->parameter[i].name, path)) {
            *value = lua->parameter[i].value;
            return true;
        }
    int k = scene_key_find(path);
    if (k < 0)
        return false;
    const struct scene_key *rule = scene_key_rule(k);
    const void *place = (const char *)scene + rule->offset;
    switch (rule->kind) {
    case SCENE_NUMBER:
        *value = *(const double *)place;
        return true;
    case SCENE_INTEGER:
    case SCENE_RESOLUTION:
        *value = *(const int *)place;
        return true;
    case SCENE_SEED:
        *value = (double)*(const uint64_t *)place;
        return true;
    default:
        return false;
    }
}

bool solver_scene_text(const struct solver_scene *scene, const char *path, char *out, size_t size)
{
    double number;
    int k = scene_key_find(path);
    const struct scene_key *rule = k < 0 ? NULL : scene_key_rule(k);
    const void *place = rule ? (const char *)scene + rule->offset : NULL;
    if (rule && (rule->kind == SCENE_WORD || rule->kind == SCENE_TEXT))
        return (size_t)snprintf(out, size, "%s", (const char *)place) < size;
    if (rule && rule->kind == SCENE_SEED)
        return (size_t)snprintf(out, size, "%llu", (unsigned long long)*(const uint64_t *)place) < size;
    if (rule && rule->kind == SCENE_FLAG)
        return (size_t)snprintf(out, size, "%s", *(const bool *)place ? "true" : "false") < size;
    if (rule && rule->kind == SCENE_INDEX) {
        char word[SOLVER_NAME];
        scene_word_at(rule->words, *(const int *)place, word, sizeof word);
        return (size_t)snprintf(out, size, "%s", word) < size;
    }
    if (!strcmp(path, "oracle"))
        return (size_t)snprintf(out, size, "%s", scene->oracle) < size;
    if (!solver_scene_number(scene, path, &number))
        return false;
    char text[32];
    scene_number_text(number, text, sizeof text);
    return (size_t)snprintf(out, size, "%s", text) < size;
}
