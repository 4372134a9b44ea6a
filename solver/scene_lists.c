/* Reads the structured parts of a scene: probes, oracle, published figures, gates, other configurations. */
#include "solver/scene_internal.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int compare_named(const void *a, const void *b)
{
    return strcmp(((const struct solver_named *)a)->name, ((const struct solver_named *)b)->name);
}

/* Lua's tables have no order of their own: names are sorted, so that every run sees the same list. */
static void sort_named(struct solver_named *named, size_t count)
{
    qsort(named, count, sizeof *named, compare_named);
}

bool scene_push_table(lua_State *L, const char *path, const char *expected)
{
    scene_lua_push(L, path);
    if (!lua_isnil(L, -1) && !lua_istable(L, -1))
        scene_refuse_value(L, path, expected, -1);
    return lua_istable(L, -1);
}

size_t scene_list_length(lua_State *L, const char *key, size_t limit, bool named_too)
{
    size_t length = lua_rawlen(L, -1);
    if (length > limit)
        scene_refuse(L, "%s: at most %zu entries are possible, got %zu", key, limit, length);
    for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1)) {
        if (named_too && lua_type(L, -2) == LUA_TSTRING)
            continue;
        lua_Integer place = lua_isinteger(L, -2) ? lua_tointeger(L, -2) : 0;
        if (place < 1 || place > (lua_Integer)length)
            scene_refuse_value(L, key, "a list without gaps and without names", -2);
    }
    return length;
}

/* Appends the number on top of the stack under `name`. */
static void append(lua_State *L, const char *key, const char *name, struct solver_named *named, size_t *count)
{
    char path[4 * SOLVER_NAME];
    snprintf(path, sizeof path, "%.100s.%.100s", key, name);
    if (*count == SOLVER_NAMED)
        scene_refuse(L, "%s: at most %d numbers are possible", key, SOLVER_NAMED);
    if (!name[0] || strlen(name) >= SOLVER_NAME)
        scene_refuse(L, "%s: expected a name of 1 to %d bytes", path, SOLVER_NAME - 1);
    struct solver_named *entry = &named[(*count)++];
    snprintf(entry->name, sizeof entry->name, "%s", name);
    entry->value = scene_read_number(L, path, -1, -DBL_MAX, DBL_MAX, "a number");
}

/* --- probes --- */

void scene_read_probes(lua_State *L, struct solver_scene *scene)
{
    static const char expected[] = "a list of { name = text, X = { ... } }";
    if (scene_push_table(L, "probes", expected)) {
        scene->probe_count = scene_list_length(L, "probes", SOLVER_PROBES, false);
        for (size_t i = 0; i < scene->probe_count; i++) {
            struct solver_probe *probe = &scene->probe[i];
            char key[32], part[48];
            snprintf(key, sizeof key, "probes[%zu]", i + 1);
            lua_rawgeti(L, -1, (lua_Integer)i + 1);
            if (!lua_istable(L, -1))
                scene_refuse_value(L, key, "{ name = text, X = { ... } }", -1);
            for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1)) {
                const char *name = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : "1";
                if (strcmp(name, "name") != 0 && strcmp(name, "X") != 0)
                    scene_refuse(L, "%s.%.60s: unknown key; expected name and X", key, name);
            }
            lua_getfield(L, -1, "name");
            snprintf(part, sizeof part, "%s.name", key);
            scene_read_text(L, part, -1, probe->name, sizeof probe->name);
            for (size_t j = 0; j < i; j++)
                if (!strcmp(scene->probe[j].name, probe->name))
                    scene_refuse(L, "%s: the name '%s' is taken", part, probe->name);
            lua_getfield(L, -2, "X");
            snprintf(part, sizeof part, "%s.X", key);
            scene_read_numbers(L, part, -1, probe->X, (size_t)scene->dim);
            for (int d = 0; d < scene->dim; d++)
                if (probe->X[d] < scene->lower[d] || probe->X[d] > scene->upper[d])
                    scene_refuse(L, "%s[%d]: %g lies outside the domain, %g to %g", part, d + 1, probe->X[d],
                                 scene->lower[d], scene->upper[d]);
            lua_pop(L, 3);
        }
    }
    lua_pop(L, 1);
}

/* --- oracle --- */

/* The full path of a number told to the oracle: "nu" stands for "material.nu". */
static void resolve_told(const struct solver_scene *scene, const char *name, char *out, size_t size)
{
    double ignored;
    snprintf(out, size, "%s", name);
    if (strchr(name, '.') || solver_scene_number(scene, name, &ignored))
        return;
    for (int k = 0; solver_scene_keys()[k].key; k++) {
        const char *dot = strchr(solver_scene_keys()[k].key, '.');
        if (dot && !strcmp(dot + 1, name) && solver_scene_number(scene, solver_scene_keys()[k].key, &ignored))
            snprintf(out, size, "%s", solver_scene_keys()[k].key);
    }
}

/* Numbers of the table on top of the stack, tables within it as "material.nu". */
static void read_told(lua_State *L, struct solver_scene *scene, const char *prefix)
{
    for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1)) {
        char name[2 * SOLVER_NAME], path[2 * SOLVER_NAME];
        if (lua_type(L, -2) != LUA_TSTRING)
            scene_refuse_value(L, "oracle", "names as keys", -2);
        if (!prefix[0] && !strcmp(lua_tostring(L, -2), "name"))
            continue;
        snprintf(name, sizeof name, "%s%.60s", prefix, lua_tostring(L, -2));
        if (lua_istable(L, -1) && !prefix[0]) {
            snprintf(path, sizeof path, "%.60s.", name);
            read_told(L, scene, path);
            continue;
        }
        resolve_told(scene, name, path, sizeof path);
        for (size_t i = 0; i < scene->oracle_told_count; i++)
            if (!strcmp(scene->oracle_told[i].name, path))
                scene_refuse(L, "oracle.%s: told twice", path);
        append(L, "oracle", path, scene->oracle_told, &scene->oracle_told_count);
    }
}

void scene_read_oracle(lua_State *L, struct solver_scene *scene)
{
    if (scene_push_table(L, "oracle", "{ name = text }")) {
        lua_getfield(L, -1, "name");
        scene_read_text(L, "oracle.name", -1, scene->oracle, sizeof scene->oracle);
        lua_pop(L, 1);
        read_told(L, scene, "");
        sort_named(scene->oracle_told, scene->oracle_told_count);
    }
    lua_pop(L, 1);
}

/* --- published figures --- */

void scene_read_published(lua_State *L, struct solver_scene *scene)
{
    if (scene_push_table(L, "published", "{ source = text, { n = ..., NAME = error, ... }, ... }")) {
        scene->published_count = scene_list_length(L, "published", SOLVER_ROWS, true);
        for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1))
            if (lua_type(L, -2) == LUA_TSTRING && strcmp(lua_tostring(L, -2), "source") != 0)
                scene_refuse(L, "published.%.60s: unknown key; expected source and rows", lua_tostring(L, -2));
        lua_getfield(L, -1, "source");
        scene_read_text(L, "published.source", -1, scene->published_source, sizeof scene->published_source);
        lua_pop(L, 1);
        for (size_t i = 0; i < scene->published_count; i++) {
            struct solver_published_row *row = &scene->published[i];
            char key[32], part[48];
            snprintf(key, sizeof key, "published[%zu]", i + 1);
            snprintf(part, sizeof part, "%s.n", key);
            lua_rawgeti(L, -1, (lua_Integer)i + 1);
            if (!lua_istable(L, -1))
                scene_refuse_value(L, key, "{ n = ..., NAME = error, ... }", -1);
            lua_getfield(L, -1, "n");
            double n = scene_read_number(L, part, -1, 1, 1e9, "whole number >= 1");
            if (n != floor(n))
                scene_refuse_value(L, part, "whole number >= 1", -1);
            row->n = (int)n;
            lua_pop(L, 1);
            for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1)) {
                if (lua_type(L, -2) != LUA_TSTRING)
                    scene_refuse_value(L, key, "names as keys", -2);
                if (strcmp(lua_tostring(L, -2), "n") != 0)
                    append(L, key, lua_tostring(L, -2), row->value, &row->count);
            }
            sort_named(row->value, row->count);
            lua_pop(L, 1);
        }
    }
    lua_pop(L, 1);
}

/* --- gates --- */

/* One condition, the value on top of the stack; it must be one that the key can have, or the gate would be mute. */
static void read_condition(lua_State *L, const struct solver_scene *scene, const char *path, const char *name,
                           char *out)
{
    char known[SOLVER_TEXT], number[32];
    int k = scene_key_find(name);
    if (!solver_scene_text(scene, name, known, sizeof known)) {
        char near[2 * SOLVER_NAME];
        scene_key_suggest(name, near, sizeof near);
        scene_refuse(L, "%s: '%.60s' is no plain key and no parameter of this scene%s", path, name, near);
    }
    if (lua_type(L, -1) == LUA_TNUMBER) {
        double ignored;
        const struct scene_key *rule = k < 0 ? NULL : scene_key_rule(k);
        bool ranged = rule && (rule->kind == SCENE_NUMBER || rule->kind == SCENE_INTEGER);
        if (!solver_scene_number(scene, name, &ignored))
            scene_refuse_value(L, path, k < 0 ? "text" : solver_scene_keys()[k].expects, -1);
        scene_number_text(scene_read_number(L, path, -1, ranged ? rule->low : -DBL_MAX, ranged ? rule->high : DBL_MAX,
                                            k < 0 ? "a number" : solver_scene_keys()[k].expects),
                          number, sizeof number);
        snprintf(out, SOLVER_NAME, "%s", number);
        return;
    }
    double ignored;
    bool later, words = k >= 0 && scene_key_rule(k)->words[0];
    if (solver_scene_number(scene, name, &ignored) || lua_type(L, -1) != LUA_TSTRING ||
        (words && scene_word_find(scene_key_rule(k)->words, lua_tostring(L, -1), &later) < 0))
        scene_refuse_value(L, path, k < 0 ? "a number" : solver_scene_keys()[k].expects, -1);
    scene_read_text(L, path, -1, out, SOLVER_NAME);
}

/* Plain keys and their values, the table on top of the stack, in the order of their names. */
static void read_settings(lua_State *L, const struct solver_scene *scene, const char *table, size_t *count,
                          char (*key)[SOLVER_NAME], char (*text)[SOLVER_NAME])
{
    struct solver_named name[SOLVER_NAMED];
    if (!lua_istable(L, -1))
        scene_refuse_value(L, table, "{ KEY = value, ... }", -1);
    for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1)) {
        if (lua_type(L, -2) != LUA_TSTRING)
            scene_refuse_value(L, table, "names as keys", -2);
        lua_pushnumber(L, 0);
        append(L, table, lua_tostring(L, -3), name, count);
        lua_pop(L, 1);
    }
    sort_named(name, *count);
    for (size_t i = 0; i < *count; i++) {
        char path[3 * SOLVER_NAME];
        snprintf(path, sizeof path, "%s.%s", table, name[i].name);
        snprintf(key[i], SOLVER_NAME, "%s", name[i].name);
        lua_getfield(L, -1, name[i].name);
        read_condition(L, scene, path, name[i].name, text[i]);
        lua_pop(L, 1);
    }
}

void scene_read_gates(lua_State *L, struct solver_scene *scene)
{
    if (scene_push_table(L, "gates", "a list of { when = { KEY = value, ... }, NAME = bound, ... }")) {
        scene->gate_count = scene_list_length(L, "gates", SOLVER_GATES, false);
        for (size_t i = 0; i < scene->gate_count; i++) {
            struct solver_gate_rule *gate = &scene->gate[i];
            char key[32], when[48];
            snprintf(key, sizeof key, "gates[%zu]", i + 1);
            snprintf(when, sizeof when, "%s.when", key);
            lua_rawgeti(L, -1, (lua_Integer)i + 1);
            if (!lua_istable(L, -1))
                scene_refuse_value(L, key, "{ when = { KEY = value, ... }, NAME = bound, ... }", -1);
            for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1)) {
                if (lua_type(L, -2) != LUA_TSTRING)
                    scene_refuse_value(L, key, "names as keys", -2);
                if (!strcmp(lua_tostring(L, -2), "when"))
                    read_settings(L, scene, when, &gate->conditions, gate->key, gate->text);
                else
                    append(L, key, lua_tostring(L, -2), gate->bound, &gate->bounds);
            }
            if (gate->bounds == 0)
                scene_refuse(L, "%s: expected at least one NAME = bound; it would hold nothing", key);
            sort_named(gate->bound, gate->bounds);
            lua_pop(L, 1);
        }
    }
    lua_pop(L, 1);
}

/* --- beside --- */

void scene_read_beside(lua_State *L, struct solver_scene *scene)
{
    static const char *const same[] = {"dim", "t_end"};
    struct solver_settings *beside = &scene->beside;
    if (scene_push_table(L, "beside", "{ KEY = value, ... }")) {
        read_settings(L, scene, "beside", &beside->count, beside->key, beside->text);
        for (size_t i = 0; i < beside->count; i++)
            for (size_t j = 0; j < sizeof same / sizeof *same; j++)
                if (!strcmp(beside->key[i], same[j]))
                    scene_refuse(L, "beside.%s: both configurations have the same %s", same[j], same[j]);
        if (beside->count > 0 && scene->probe_count == 0)
            scene_refuse(L, "beside: probes are what is compared, and the scene has none");
    }
    lua_pop(L, 1);
}

/* --- trade --- */

/* Names stand in tables and files: no control characters. */
static void read_variant_name(lua_State *L, char name[SOLVER_NAME])
{
    if (lua_type(L, -2) != LUA_TSTRING)
        scene_refuse_value(L, "trade", "names as keys", -2);
    const char *text = lua_tostring(L, -2);
    bool fits = *text && strlen(text) < SOLVER_NAME && strlen(text) == lua_rawlen(L, -2);
    snprintf(name, SOLVER_NAME, "%.*s", SOLVER_NAME - 1, text);
    solver_plain(name, false);
    if (!fits || strcmp(name, text) != 0)
        scene_refuse(L, "trade: expected names of 1 to %d bytes without control characters", SOLVER_NAME - 1);
}

static int compare_variants(const void *a, const void *b)
{
    return strcmp(((const struct solver_variant *)a)->name, ((const struct solver_variant *)b)->name);
}

void scene_read_trade(lua_State *L, struct solver_scene *scene)
{
    static const char *const same[] = {"dim", "n", "levels"};
    if (scene_push_table(L, "trade", "{ [NAME] = { KEY = value, ... }, ... }")) {
        for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1)) {
            char path[2 * SOLVER_NAME];
            if (scene->variant_count == SOLVER_VARIANTS)
                scene_refuse(L, "trade: at most %d entries are possible", SOLVER_VARIANTS);
            struct solver_variant *variant = &scene->variant[scene->variant_count++];
            struct solver_settings *settings = &variant->settings;
            read_variant_name(L, variant->name);
            snprintf(path, sizeof path, "trade.%s", variant->name);
            read_settings(L, scene, path, &settings->count, settings->key, settings->text);
            if (settings->count == 0)
                scene_refuse(L, "%s: expected at least one KEY = value", path);
            for (size_t i = 0; i < settings->count; i++)
                for (size_t j = 0; j < sizeof same / sizeof *same; j++)
                    if (!strcmp(settings->key[i], same[j]))
                        scene_refuse(L, "%s.%s: the study varies it, or it is another problem", path, same[j]);
        }
        qsort(scene->variant, scene->variant_count, sizeof *scene->variant, compare_variants);
    }
    lua_pop(L, 1);
}
