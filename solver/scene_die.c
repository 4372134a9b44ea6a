/* Reads rigid walls by their paths, and refuses what encloses nothing. */
#include "solver/die.h"
#include "solver/scene_internal.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

/* The list `name` of the table on top of the stack, pushed; its length has to be within [least, most]. */
static size_t push_list(lua_State *L, const char *key, const char *name, size_t least, size_t most,
                        const char *expected)
{
    char path[64];
    snprintf(path, sizeof path, "%s.%s", key, name);
    lua_getfield(L, -1, name);
    if (!lua_istable(L, -1))
        scene_refuse_value(L, path, expected, -1);
    size_t length = scene_list_length(L, path, most, false);
    if (length < least)
        scene_refuse(L, "%s: expected %s, got %zu entries", path, expected, length);
    return length;
}

static void read_wall(lua_State *L, const char *key, struct solver_die_wall *wall)
{
    char entry[64], why[256];
    for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1)) {
        const char *name = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : "1";
        if (strcmp(name, "path") != 0 && strcmp(name, "fillets") != 0)
            scene_refuse(L, "%s.%.60s: unknown key; expected path and fillets", key, name);
    }
    wall->count = push_list(L, key, "path", 2, SOLVER_DIE_POINTS, "a list of 2 to 16 places {x, y} [m]");
    for (size_t i = 0; i < wall->count; i++) {
        snprintf(entry, sizeof entry, "%s.path[%zu]", key, i + 1);
        lua_rawgeti(L, -1, (lua_Integer)i + 1);
        scene_read_numbers(L, entry, -1, wall->point[i], 2);
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
    lua_getfield(L, -1, "fillets");
    bool sharp = lua_isnil(L, -1);
    lua_pop(L, 1);
    if (!sharp) {
        size_t corners = wall->count - 2;
        char expected[64];
        snprintf(expected, sizeof expected, "a list of %zu radii [m], one for each corner", corners);
        push_list(L, key, "fillets", corners, corners, expected);
        for (size_t i = 0; i < corners; i++) {
            snprintf(entry, sizeof entry, "%s.fillets[%zu]", key, i + 1);
            lua_rawgeti(L, -1, (lua_Integer)i + 1);
            wall->fillet[i + 1] = scene_read_number(L, entry, -1, 0, DBL_MAX, "number >= 0 [m]");
            lua_pop(L, 1);
        }
        lua_pop(L, 1);
    }
    if (solver_die_is_wrong(wall, why, sizeof why))
        scene_refuse(L, "%s: %s", key, why);
}

void scene_read_die(lua_State *L, struct solver_scene *scene)
{
    static const char expected[] = "a list of { path = { {x, y}, ... }, fillets = { r, ... } }";
    if (scene_push_table(L, "die", expected)) {
        if (scene->dim != 2)
            scene_refuse(L, "die: walls by paths are there in the plane; expected dim = 2, got %d", scene->dim);
        scene->die_count = scene_list_length(L, "die", SOLVER_DIE_WALLS, false);
        if (scene->die_count == 0)
            scene_refuse(L, "die: expected %s, got none", expected);
        for (size_t w = 0; w < scene->die_count; w++) {
            char key[32];
            snprintf(key, sizeof key, "die[%zu]", w + 1);
            lua_rawgeti(L, -1, (lua_Integer)w + 1);
            if (!lua_istable(L, -1))
                scene_refuse_value(L, key, "{ path = { {x, y}, ... }, fillets = { r, ... } }", -1);
            read_wall(L, key, &scene->die[w]);
            lua_pop(L, 1);
            for (size_t other = 0; other < w; other++)
                if (solver_die_cross(&scene->die[other], &scene->die[w]))
                    scene_refuse(L, "%s: the wall crosses or touches die[%zu]", key, other + 1);
        }
    }
    lua_pop(L, 1);
}
