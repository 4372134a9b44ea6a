/* What a scene sees and sets: its globals.
 *
 * A scene sees `math` (without random numbers), a handful of pure functions, its parameters and the keys assigned so
 * far, and nothing else: no files, no modules, no string library (patterns can take exponential time inside one
 * instruction), no metatables, no pcall and no coroutines (both could outlive the budget), no pairs and no tostring
 * (their results depend on addresses, and results must be the same in every run). What a scene sees of its own
 * tables is read-only. */
#include "solver/scene_internal.h"

#include <float.h>
#include <lauxlib.h>
#include <lualib.h>
#include <stdio.h>
#include <string.h>

enum {
    DEPTH_LIMIT = 8,   /* of nested tables */
    NESTING_LIMIT = 50 /* of functions that captured functions */
};

/* --- read-only tables: a userdata that shows a table kept as its user value --- */

static const char READ_ONLY[] = "assay.read_only";

static void push_read_only(lua_State *L, int index)
{
    index = lua_absindex(L, index);
    lua_newuserdatauv(L, 0, 1);
    lua_pushvalue(L, index);
    lua_setiuservalue(L, -2, 1);
    luaL_setmetatable(L, READ_ONLY);
}

static int read_only_get(lua_State *L)
{
    lua_getiuservalue(L, 1, 1);
    lua_pushvalue(L, 2);
    lua_rawget(L, -2);
    if (lua_istable(L, -1))
        push_read_only(L, -1);
    return 1;
}

static int read_only_set(lua_State *L)
{
    scene_refuse(L, "tables of a scene cannot be changed once they are assigned");
}

static int read_only_length(lua_State *L)
{
    lua_getiuservalue(L, 1, 1);
    lua_pushinteger(L, (lua_Integer)lua_rawlen(L, -1));
    return 1;
}

static void freeze_function(lua_State *L, int index);

/* Pushes a deep copy of the value at `index`; `key` is named in errors. */
static void push_copy(lua_State *L, int index, const char *key, int depth)
{
    index = lua_absindex(L, index);
    luaL_checkstack(L, 8, "nested tables");
    if (depth > DEPTH_LIMIT)
        scene_refuse(L, "%s: tables are nested more than %d deep", key, DEPTH_LIMIT);
    if (luaL_testudata(L, index, READ_ONLY)) {
        lua_getiuservalue(L, index, 1);
        push_copy(L, -1, key, depth);
        lua_remove(L, -2);
        return;
    }
    if (!lua_istable(L, index)) {
        if (lua_isfunction(L, index) && scene_lua_of(L)->phase == SCENE_FREEZING)
            freeze_function(L, index);
        lua_pushvalue(L, index);
        return;
    }
    lua_newtable(L);
    lua_pushnil(L);
    while (lua_next(L, index)) {
        if (lua_type(L, -2) != LUA_TSTRING && !lua_isinteger(L, -2))
            scene_refuse_value(L, key, "a table whose keys are names or 1, 2, 3, ...", -2);
        lua_pushvalue(L, -2);
        push_copy(L, -2, key, depth + 1);
        lua_rawset(L, -5);
        lua_pop(L, 1);
    }
}

/* --- what formulas captured --- */

/* Registry table `upvalues`: f1, i1, v1, f2, i2, v2, ... and [f] = true for functions already seen. */
static void freeze_function(lua_State *L, int index)
{
    index = lua_absindex(L, index);
    luaL_checkstack(L, 12, "nested functions");
    if (lua_iscfunction(L, index))
        return;
    struct solver_scene_lua *lua = scene_lua_of(L);
    if (++lua->nesting > NESTING_LIMIT)
        scene_refuse(L, "formulas call functions that are nested more than %d deep", NESTING_LIMIT);
    lua_rawgeti(L, LUA_REGISTRYINDEX, lua->upvalues);
    int list = lua_gettop(L);
    lua_pushvalue(L, index);
    if (lua_rawget(L, list) != LUA_TNIL) {
        lua_settop(L, list - 1);
        lua->nesting--;
        return;
    }
    lua_pushvalue(L, index);
    lua_pushboolean(L, true);
    lua_rawset(L, list);
    const char *name;
    for (int i = 1; (name = lua_getupvalue(L, index, i)); i++) {
        if (lua_istable(L, -1)) {
            push_copy(L, -1, name, 0);
            push_read_only(L, -1);
            lua_pushvalue(L, -1);
            lua_setupvalue(L, index, i);
        } else if (lua_isfunction(L, -1))
            freeze_function(L, -1);
        lua_Integer end = (lua_Integer)lua_rawlen(L, list);
        lua_pushvalue(L, index);
        lua_rawseti(L, list, end + 1);
        lua_pushinteger(L, i);
        lua_rawseti(L, list, end + 2);
        /* nil would end the list: it is stored as the list itself, which no formula can reach */
        lua_pushvalue(L, lua_isnil(L, -1) ? list : -1);
        lua_rawseti(L, list, end + 3);
        lua_settop(L, list);
    }
    lua_settop(L, list - 1);
    lua->nesting--;
}

void scene_globals_freeze(lua_State *L)
{
    struct solver_scene_lua *lua = scene_lua_of(L);
    lua->phase = SCENE_FREEZING;
    for (int i = 0; i < SOLVER_FORMULAS; i++)
        if (lua->formula[i] != LUA_NOREF) {
            lua_rawgeti(L, LUA_REGISTRYINDEX, lua->formula[i]);
            freeze_function(L, -1);
            lua_pop(L, 1);
        }
    lua->phase = SCENE_CLOSED;
}

void scene_globals_check(lua_State *L)
{
    lua_rawgeti(L, LUA_REGISTRYINDEX, scene_lua_of(L)->upvalues);
    int list = lua_gettop(L);
    lua_Integer end = (lua_Integer)lua_rawlen(L, list);
    for (lua_Integer k = 1; k + 2 <= end; k += 3) {
        lua_rawgeti(L, list, k);
        lua_rawgeti(L, list, k + 1);
        const char *name = lua_getupvalue(L, -2, (int)lua_tointeger(L, -1));
        lua_rawgeti(L, list, k + 2);
        bool was_nil = lua_rawequal(L, -1, list);
        if (was_nil ? !lua_isnil(L, -2) : !lua_rawequal(L, -1, -2))
            scene_refuse(L, "changes '%s', which outlives the call; a formula must depend on X, Y, Z and t alone",
                         name);
        lua_settop(L, list);
    }
    lua_pop(L, 1);
}

/* --- the scene's globals --- */

static int global_get(lua_State *L)
{
    struct solver_scene_lua *lua = scene_lua_of(L);
    lua_rawgeti(L, LUA_REGISTRYINDEX, lua->shown);
    lua_pushvalue(L, 2);
    if (lua_rawget(L, -2) != LUA_TNIL)
        return 1;
    const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "?";
    if (scene_key_is_root(name))
        scene_refuse(L, "%s: read before it is assigned", name);
    char near[SOLVER_TEXT];
    scene_key_suggest(name, near, sizeof near);
    scene_refuse(L, "%.60s: undefined name%s", name, near);
}

/* Declares the scene's own numbers, overridden where `--set NAME=...` says so. */
static void declare_parameters(lua_State *L, int table)
{
    struct solver_scene_lua *lua = scene_lua_of(L);
    if (!lua_istable(L, table))
        scene_refuse_value(L, "parameters", "table of NAME = number", table);
    lua_rawgeti(L, LUA_REGISTRYINDEX, lua->shown);
    int shown = lua_gettop(L);
    lua_pushnil(L);
    while (lua_next(L, table)) {
        char key[SOLVER_NAME + 16];
        if (lua_type(L, -2) != LUA_TSTRING)
            scene_refuse_value(L, "parameters", "NAME = number", -2);
        const char *name = lua_tostring(L, -2);
        size_t length = strspn(name, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_0123456789");
        if (length == 0 || name[length] || length >= SOLVER_NAME || strchr("0123456789", name[0]))
            scene_refuse_value(L, "parameters", "a name of letters, digits and _", -2);
        snprintf(key, sizeof key, "parameters.%.50s", name);
        lua_pushvalue(L, -2);
        if (scene_key_is_root(name) || lua_rawget(L, shown) != LUA_TNIL)
            scene_refuse(L, "%s: the name '%s' is taken; choose another", key, name);
        lua_settop(L, shown + 2);
        if (lua->parameter_count == SOLVER_PARAMETERS)
            scene_refuse(L, "parameters: at most %d are possible", SOLVER_PARAMETERS);
        for (size_t i = 0; i < lua->override_count; i++)
            if (!strcmp(lua->override[i].key, name)) {
                lua_pop(L, 1);
                scene_push_spelling(L, name, lua->override[i].value);
                lua->override[i].used = true;
            }
        struct solver_named *parameter = &lua->parameter[lua->parameter_count++];
        snprintf(parameter->name, sizeof parameter->name, "%s", name);
        parameter->value = scene_read_number(L, key, -1, -DBL_MAX, DBL_MAX, "a number");
        lua_pushvalue(L, -2);
        lua_insert(L, -2);
        lua_rawset(L, shown); /* pops the number, leaves the key for lua_next */
    }
    lua_settop(L, shown - 1);
}

static int global_set(lua_State *L)
{
    struct solver_scene_lua *lua = scene_lua_of(L);
    char near[SOLVER_TEXT];
    if (lua_type(L, 2) != LUA_TSTRING)
        scene_refuse_value(L, "_ENV", "a key that is text", 2);
    const char *name = lua_tostring(L, 2);
    if (lua->phase != SCENE_RUNNING_FILE)
        scene_refuse(L, "assigns the global '%.60s'; a formula must depend on X, Y, Z and t alone", name);
    if (!scene_key_is_root(name)) {
        scene_key_suggest(name, near, sizeof near);
        scene_refuse(L, "%.60s: unknown key%s (write `local` for a value of the scene's own)", name, near);
    }
    lua_rawgeti(L, LUA_REGISTRYINDEX, lua->values);
    if (lua_getfield(L, -1, name) != LUA_TNIL)
        scene_refuse(L, "%s: assigned twice", name);
    if (lua_isnil(L, 3))
        scene_refuse_value(L, name, "a value", 3);
    lua_pop(L, 1);
    push_copy(L, 3, name, 0);
    lua_setfield(L, -2, name);
    scene_overrides_apply(L, name);
    lua_getfield(L, -1, name);
    if (!strcmp(name, "parameters"))
        declare_parameters(L, lua_gettop(L));
    lua_rawgeti(L, LUA_REGISTRYINDEX, lua->shown);
    if (lua_istable(L, -2))
        push_read_only(L, -2);
    else
        lua_pushvalue(L, -2);
    lua_setfield(L, -2, name);
    return 0;
}

void scene_lua_push(lua_State *L, const char *path)
{
    char part[SOLVER_NAME];
    lua_rawgeti(L, LUA_REGISTRYINDEX, scene_lua_of(L)->values);
    for (;;) {
        size_t length = strcspn(path, ".");
        snprintf(part, sizeof part, "%.*s", (int)length, path);
        if (!lua_istable(L, -1)) {
            lua_pop(L, 1);
            lua_pushnil(L);
            return;
        }
        lua_getfield(L, -1, part);
        lua_remove(L, -2);
        if (!path[length])
            return;
        path += length + 1;
    }
}

void scene_lua_set(lua_State *L, const char *path)
{
    char part[SOLVER_NAME];
    const char *rest = path;
    int value = lua_gettop(L);
    lua_rawgeti(L, LUA_REGISTRYINDEX, scene_lua_of(L)->values);
    for (size_t length; length = strcspn(rest, "."), rest[length]; rest += length + 1) {
        snprintf(part, sizeof part, "%.*s", (int)length, rest);
        if (lua_getfield(L, -1, part) == LUA_TNIL) {
            lua_pop(L, 1);
            lua_newtable(L);
            lua_pushvalue(L, -1);
            lua_setfield(L, -3, part);
        } else if (!lua_istable(L, -1))
            scene_refuse(L, "--set %s: '%.*s' is no table here", path, (int)(rest - path) + (int)length, path);
    }
    lua_pushvalue(L, value);
    lua_setfield(L, -2, rest);
    lua_settop(L, value - 1);
}

/* --- the sandbox --- */

static const char *const allowed[] = {"assert", "error", "ipairs", "select", "tonumber", "type"};

void scene_globals_open(lua_State *L)
{
    struct solver_scene_lua *lua = scene_lua_of(L);
    static const luaL_Reg read_only[] = {
        {"__index", read_only_get}, {"__newindex", read_only_set}, {"__len", read_only_length}, {NULL, NULL}};
    luaL_newmetatable(L, READ_ONLY);
    luaL_setfuncs(L, read_only, 0);
    lua_settop(L, 0);

    lua_newtable(L);
    lua->values = luaL_ref(L, LUA_REGISTRYINDEX);
    lua_newtable(L);
    lua->upvalues = luaL_ref(L, LUA_REGISTRYINDEX);

    lua_newtable(L); /* what scripts see */
    luaL_requiref(L, LUA_GNAME, luaopen_base, 0);
    for (size_t i = 0; i < sizeof allowed / sizeof *allowed; i++) {
        lua_getfield(L, 2, allowed[i]);
        lua_setfield(L, 1, allowed[i]);
    }
    luaL_requiref(L, LUA_MATHLIBNAME, luaopen_math, 0);
    lua_pushnil(L);
    lua_setfield(L, 3, "random");
    lua_pushnil(L);
    lua_setfield(L, 3, "randomseed");
    push_read_only(L, 3);
    lua_setfield(L, 1, LUA_MATHLIBNAME);
    lua_settop(L, 1);
    lua->shown = luaL_ref(L, LUA_REGISTRYINDEX);
}

void scene_globals_push(lua_State *L)
{
    static const luaL_Reg globals[] = {{"__index", global_get}, {"__newindex", global_set}, {NULL, NULL}};
    lua_newuserdatauv(L, 0, 0);
    luaL_newlib(L, globals);
    lua_setmetatable(L, -2);
}
