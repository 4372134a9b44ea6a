/* Overrides: what `--set KEY=VALUE` puts in place of the scene's own values. */
#include "solver/scene_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool scene_overrides_parse(struct solver_scene_lua *lua, const char *const *overrides, size_t count,
                           struct solver_error *error)
{
    const char *path = lua->scene->path;
    lua->override = calloc(count + 1, sizeof *lua->override);
    if (!lua->override)
        return solver_fail(error, SOLVER_NO_MEMORY, "%.400s: no memory for %zu overrides", path, count);
    for (size_t i = 0; i < count; i++) {
        struct scene_override *override = &lua->override[i];
        const char *text = overrides[i], *equals = strchr(text, '=');
        if (!equals || equals == text || !equals[1] || strchr(text, '\n'))
            return solver_fail(error, SOLVER_BAD_INPUT, "%.400s: --set %.60s: expected KEY=VALUE on one line", path,
                               text);
        if ((size_t)(equals - text) >= sizeof override->key)
            return solver_fail(error, SOLVER_BAD_INPUT, "%.400s: --set %.60s...: no key is that long", path, text);
        snprintf(override->key, sizeof override->key, "%.*s", (int)(equals - text), text);
        override->value = equals + 1;
        override->text = text;
        if (strchr(override->key, '.') && !scene_key_admits(override->key)) {
            char near[SOLVER_TEXT];
            scene_key_suggest(override->key, near, sizeof near);
            return solver_fail(error, SOLVER_BAD_INPUT, "%.400s: --set %.120s: unknown key%s", path, text, near);
        }
    }
    lua->override_count = count;
    return true;
}

/* A number, true, false or a word; nil, nan and inf are words and so refused where a number is due. */
static void push_scalar(lua_State *L, const char *text)
{
    if (!strcmp(text, "true") || !strcmp(text, "false"))
        lua_pushboolean(L, text[0] == 't');
    else if (!lua_stringtonumber(L, text))
        lua_pushstring(L, text);
}

void scene_push_spelling(lua_State *L, const char *key, const char *text)
{
    if (text[0] != '{') {
        push_scalar(L, text);
        return;
    }
    size_t length = strlen(text);
    if (text[length - 1] != '}' || strcspn(text + 1, "{}") != length - 2)
        scene_refuse(L, "--set %s=%.120s: expected a list {a,b,c}", key, text);
    lua_newtable(L);
    text++;
    for (lua_Integer i = 1; length > 2; i++) { /* {} is the empty list */
        char item[SOLVER_NAME];
        size_t span = strcspn(text, ",}");
        if (span == 0 || span >= sizeof item)
            scene_refuse(L, "--set %s: expected a list {a,b,c}, entry %d is empty or too long", key, (int)i);
        snprintf(item, sizeof item, "%.*s", (int)span, text);
        push_scalar(L, item);
        lua_rawseti(L, -2, i);
        if (text[span] == '}')
            return;
        text += span + 1;
    }
}

static _Noreturn void refuse_unknown(lua_State *L, const struct scene_override *override)
{
    char near[SOLVER_TEXT];
    scene_key_suggest(override->key, near, sizeof near);
    scene_refuse(L, "--set %.120s: unknown key%s", override->text, near);
}

static void apply(lua_State *L, struct scene_override *override)
{
    scene_lua_push(L, override->key);
    if (!strncmp(override->key, "parameters.", 11) && lua_isnil(L, -1))
        refuse_unknown(L, override); /* only the file declares parameters */
    lua_pop(L, 1);
    scene_push_spelling(L, override->key, override->value);
    scene_lua_set(L, override->key);
    override->used = true;
}

void scene_overrides_apply(lua_State *L, const char *root)
{
    struct solver_scene_lua *lua = scene_lua_of(L);
    size_t length = strlen(root);
    for (size_t i = 0; i < lua->override_count; i++) {
        const char *key = lua->override[i].key;
        if (!strncmp(key, root, length) && (key[length] == '.' || key[length] == '\0'))
            apply(L, &lua->override[i]);
    }
}

void scene_overrides_finish(lua_State *L)
{
    struct solver_scene_lua *lua = scene_lua_of(L);
    for (size_t i = 0; i < lua->override_count; i++) {
        struct scene_override *override = &lua->override[i];
        if (override->used)
            continue;
        if (!scene_key_admits(override->key))
            refuse_unknown(L, override);
        apply(L, override);
    }
}
