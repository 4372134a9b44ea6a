/* The interpreter in which a scene file and its formulas run: its limits, its errors, its life. What a scene may see
 * and set is in scene_globals.c. */
#include "solver/scene_internal.h"

#include <float.h>
#include <lauxlib.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    FILE_BUDGET = 10000000, /* instructions */
    CALL_BUDGET = 1000000,
    HOOK_STEP = 1000,
    WEIGHT_STEP = 256 << 10, /* bytes */
    MEMORY_LIMIT = 64 << 20, /* bytes */
    STRING_LIMIT = 16 << 10  /* bytes: what one instruction does to a string must stay short */
};
#define CHUNK "scene" /* stands for the file in Lua's messages, which cut long names */

struct solver_scene_lua *scene_lua_of(lua_State *L)
{
    return *(struct solver_scene_lua **)lua_getextraspace(L);
}

/* --- limits --- */

static void *allocate(void *context, void *block, size_t old_size, size_t new_size)
{
    struct solver_scene_lua *lua = context;
    size_t held = block ? old_size : 0; /* without a block, old_size tells what kind of object is wanted */
    if (new_size == 0) {
        free(block);
        lua->bytes -= held;
        return NULL;
    }
    if (!block && old_size == LUA_TSTRING && new_size > STRING_LIMIT) {
        lua->out_of = "a string of more than 16 KiB";
        return NULL;
    }
    if (new_size > held && lua->bytes - held + new_size > MEMORY_LIMIT) {
        lua->out_of = "more than 64 MiB of memory";
        return NULL;
    }
    void *grown = realloc(block, new_size);
    if (grown)
        lua->bytes = lua->bytes - held + new_size;
    else
        lua->out_of = "more memory than the machine has left";
    return grown;
}

static void count_down(lua_State *L, lua_Debug *where)
{
    (void)where;
    struct solver_scene_lua *lua = scene_lua_of(L);
    /* One instruction can copy what is held, so the more is held the faster the budget is spent. */
    lua->budget -= HOOK_STEP * (1 + (long)(lua->bytes / WEIGHT_STEP));
    if (lua->budget < 0)
        scene_refuse(L, "did not end within its budget of %ld instructions: an endless loop?", lua->budget_full);
}

static void set_budget(struct solver_scene_lua *lua, long instructions)
{
    lua->budget = lua->budget_full = instructions;
    lua_sethook(lua->L, count_down, LUA_MASKCOUNT, HOOK_STEP);
}

/* --- what formulas are asked --- */

struct scene_question {
    enum solver_formula formula;
    const double *X;
    double t;
    size_t count;
    double value[9]; /* the answer; no formula has more */
};

static void name_formula(enum solver_formula formula, char *out, size_t size)
{
    static const char *const name[] = {"initial.displacement", "initial.velocity", "initial.F",
                                       "body_force",           "material.at",      "domain.distance"};
    static const char *const face[] = {"X0", "X1", "Y0", "Y1", "Z0", "Z1", "surface"};
    if (formula < SOLVER_FACE_X0)
        snprintf(out, size, "%s", name[formula]);
    else if (formula < SOLVER_SHEAR_X0)
        snprintf(out, size, "faces.%s.value", face[formula - SOLVER_FACE_X0]);
    else
        snprintf(out, size, "faces.%s.traction", face[formula - SOLVER_SHEAR_X0]);
}

/* Said only where an answer fails: a body asks thousands of times. */
static void say_asked(struct solver_scene_lua *lua)
{
    const struct scene_question *ask = lua->asked;
    char name[SOLVER_NAME];
    if (ask == NULL)
        return;
    name_formula(ask->formula, name, sizeof name);
    snprintf(lua->doing, sizeof lua->doing, "%s at X = (%.6g, %.6g, %.6g), t = %.6g", name, ask->X[0], ask->X[1],
             ask->X[2], ask->t);
}

/* --- errors --- */

void scene_refuse(lua_State *L, const char *format, ...)
{
    struct solver_scene_lua *lua = scene_lua_of(L);
    char text[sizeof lua->error.text], line[32] = "";
    lua_Debug frame;
    for (int level = 0; lua_getstack(L, level, &frame); level++)
        if (lua_getinfo(L, "l", &frame) && frame.currentline > 0) {
            snprintf(line, sizeof line, ":%d", frame.currentline);
            break;
        }
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    say_asked(lua);
    solver_fail(&lua->error, SOLVER_BAD_INPUT, "%.400s%s: %s%s%s", lua->scene->path, line, lua->doing,
                lua->doing[0] ? ": " : "", text);
    lua_pushnil(L);
    for (;;)
        lua_error(L); /* does not return, which its declaration does not say */
}

void scene_refuse_value(lua_State *L, const char *key, const char *expected, int index)
{
    char got[128], number[32];
    switch (lua_type(L, index)) {
    case LUA_TNIL:
        snprintf(got, sizeof got, "nothing");
        break;
    case LUA_TNUMBER:
        scene_number_text(lua_tonumber(L, index), number, sizeof number);
        snprintf(got, sizeof got, "%s", number);
        break;
    case LUA_TBOOLEAN:
        snprintf(got, sizeof got, "%s", lua_toboolean(L, index) ? "true" : "false");
        break;
    case LUA_TSTRING:
        snprintf(got, sizeof got, "the text '%.60s'", lua_tostring(L, index));
        break;
    default:
        snprintf(got, sizeof got, "a %s", lua_typename(L, lua_type(L, index)));
    }
    const struct solver_scene_lua *lua = scene_lua_of(L);
    const char *from = "";
    for (size_t i = 0; i < lua->override_count; i++)
        if (!strcmp(lua->override[i].key, key))
            from = " (from --set)";
    scene_refuse(L, "%s: expected %s, got %s%s", key, expected, got, from);
}

bool scene_lua_protect(struct solver_scene_lua *lua, lua_CFunction body, void *argument, struct solver_error *error)
{
    lua_State *L = lua->L;
    lua->error.code = SOLVER_OK;
    lua->out_of = NULL;
    lua_settop(L, 0);
    lua_pushcfunction(L, body);
    lua_pushlightuserdata(L, argument);
    int status = lua_pcall(L, 1, 0, 0);
    if (status == LUA_OK)
        return true;
    say_asked(lua);
    const char *path = lua->scene->path, *doing = lua->doing, *colon = doing[0] ? ": " : "";
    const char *said = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "error without a message";
    if (lua->error.code != SOLVER_OK)
        *error = lua->error;
    else if (status == LUA_ERRMEM || (lua->out_of && !strcmp(said, "not enough memory"))) /* the latter by the parser */
        solver_fail(error, SOLVER_BAD_INPUT, "%.400s: %s%sasks for %s", path, doing, colon,
                    lua->out_of ? lua->out_of : "too much memory");
    else if (!strncmp(said, CHUNK ":", sizeof CHUNK)) { /* "scene:12: text" -> "FILE:12: text" */
        said += sizeof CHUNK;
        int digits = (int)strspn(said, "0123456789");
        solver_fail(error, SOLVER_BAD_INPUT, "%.400s:%.*s: %s%s%s", path, digits, said, doing, colon,
                    said + digits + strspn(said + digits, ": "));
    } else
        solver_fail(error, SOLVER_BAD_INPUT, "%.400s: %s%s%s", path, doing, colon, said);
    lua_settop(L, 0);
    return false;
}

/* --- life of the interpreter --- */

static int open_sandbox(lua_State *L)
{
    scene_globals_open(L);
    return 0;
}

bool scene_lua_create(struct solver_scene *scene, struct solver_error *error)
{
    struct solver_scene_lua *lua = calloc(1, sizeof *lua);
    scene->lua = lua;
    if (!lua)
        return solver_fail(error, SOLVER_NO_MEMORY, "%.400s: no memory for the interpreter", scene->path);
    lua->scene = scene;
    for (int i = 0; i < SOLVER_FORMULAS; i++)
        lua->formula[i] = LUA_NOREF;
    lua->L = lua_newstate(allocate, lua);
    if (!lua->L)
        return solver_fail(error, SOLVER_NO_MEMORY, "%.400s: no memory for the interpreter", scene->path);
    *(struct solver_scene_lua **)lua_getextraspace(lua->L) = lua;
    return scene_lua_protect(lua, open_sandbox, NULL, error);
}

void scene_lua_free(struct solver_scene_lua *lua)
{
    if (!lua)
        return;
    if (lua->L)
        lua_close(lua->L);
    free(lua->override);
    free(lua);
}

void scene_lua_run_file(lua_State *L)
{
    struct solver_scene_lua *lua = scene_lua_of(L);
    set_budget(lua, FILE_BUDGET);
    if (luaL_loadbufferx(L, lua->scene->text, strlen(lua->scene->text), "=" CHUNK, "t") != LUA_OK)
        lua_error(L);
    scene_globals_push(L);
    lua_pushvalue(L, -1);
    lua_setupvalue(L, -3, 1);
    lua_pushvalue(L, -2);
    lua_call(L, 0, 0);
    lua_getupvalue(L, -2, 1);
    if (!lua_rawequal(L, -1, -2))
        scene_refuse(L, "_ENV: assigned; keys after that would be lost");
    lua_pop(L, 3);
}

/* --- formulas --- */

void scene_lua_keep_formula(lua_State *L, enum solver_formula formula)
{
    scene_lua_of(L)->formula[formula] = luaL_ref(L, LUA_REGISTRYINDEX);
}

/* Whether `drive` stands in for the formula. */
static bool is_driven(const struct solver_scene *scene, enum solver_formula formula)
{
    return scene->drive != NULL && (formula == SOLVER_BODY_FORCE || formula >= SOLVER_FACE_X0);
}

void solver_scene_forget(struct solver_scene *scene, enum solver_formula formula)
{
    luaL_unref(scene->lua->L, LUA_REGISTRYINDEX, scene->lua->formula[formula]);
    scene->lua->formula[formula] = LUA_NOREF;
}

bool solver_scene_has(const struct solver_scene *scene, enum solver_formula formula)
{
    bool given = (scene->start != NULL && formula <= SOLVER_INITIAL_F) || is_driven(scene, formula);
    return given || scene->lua->formula[formula] != LUA_NOREF;
}

void solver_scene_start_from(struct solver_scene *scene, solver_start *start, void *context)
{
    scene->start = start;
    scene->start_context = context;
}

void solver_scene_drive_from(struct solver_scene *scene, solver_drive *drive, void *context,
                             void (*release)(void *context))
{
    if (scene->drive_release != NULL) {
        scene->drive_release(scene->drive_context);
    }
    scene->drive = drive;
    scene->drive_context = context;
    scene->drive_release = release;
}

/* What was given in place of an initial formula. */
static void ask_start(const struct solver_scene *scene, enum solver_formula formula, const double X[3], double *out)
{
    double u[3], v[3], F[9];
    size_t dim = (size_t)scene->dim;
    scene->start(scene->start_context, X, u, v, F);
    if (formula != SOLVER_INITIAL_F) {
        memcpy(out, formula == SOLVER_INITIAL_VELOCITY ? v : u, dim * sizeof *out);
        return;
    }
    for (size_t i = 0; i < dim; i++) {
        memcpy(out + i * dim, F + 3 * i, dim * sizeof *out);
    }
}

static int call_formula(lua_State *L)
{
    struct scene_question *ask = lua_touserdata(L, 1);
    struct solver_scene_lua *lua = scene_lua_of(L);
    set_budget(lua, CALL_BUDGET);
    int base = lua_gettop(L);
    lua_rawgeti(L, LUA_REGISTRYINDEX, lua->formula[ask->formula]);
    for (int i = 0; i < 3; i++)
        lua_pushnumber(L, ask->X[i]);
    lua_pushnumber(L, ask->t);
    lua_call(L, 4, LUA_MULTRET);
    size_t got = (size_t)(lua_gettop(L) - base);
    if (got != ask->count)
        scene_refuse(L, "expected %zu number%s, got %zu", ask->count, ask->count == 1 ? "" : "s", got);
    static const char *const which[] = {"value 1", "value 2", "value 3", "value 4", "value 5",
                                        "value 6", "value 7", "value 8", "value 9"};
    for (size_t i = 0; i < got; i++)
        ask->value[i] = scene_read_number(L, which[i], base + 1 + (int)i, -DBL_MAX, DBL_MAX, "a number");
    luaL_checkstack(L, 8, "formula");
    scene_globals_check(L);
    return 0;
}

static bool refuse_question(const struct solver_scene *scene, const struct scene_question *ask,
                            struct solver_error *error)
{
    char name[SOLVER_NAME];
    name_formula(ask->formula, name, sizeof name);
    return ask->count > sizeof ask->value / sizeof *ask->value
               ? solver_fail(error, SOLVER_BAD_INPUT, "%.400s: %s: no formula returns %zu numbers", scene->path, name,
                             ask->count)
               : solver_fail(error, SOLVER_BAD_INPUT, "%.400s: %s: the scene gives no such formula", scene->path, name);
}

bool solver_scene_eval(const struct solver_scene *scene, enum solver_formula formula, const double X[3], double t,
                       double *out, size_t count, struct solver_error *error)
{
    struct solver_scene_lua *lua = scene->lua;
    struct scene_question ask = {formula, X, t, count, {0}};
    if (count > sizeof ask.value / sizeof *ask.value || !solver_scene_has(scene, formula))
        return refuse_question(scene, &ask, error);
    if (scene->start != NULL && formula <= SOLVER_INITIAL_F) {
        ask_start(scene, formula, X, out);
        return true;
    }
    if (is_driven(scene, formula)) {
        double value[3];
        scene->drive(scene->drive_context, formula, X, t, value);
        memcpy(out, value, count * sizeof *out);
        return true;
    }
    lua->asked = &ask;
    bool good = scene_lua_protect(lua, call_formula, &ask, error);
    lua->asked = NULL;
    lua->doing[0] = '\0';
    if (good)
        memcpy(out, ask.value, count * sizeof *out);
    return good;
}
