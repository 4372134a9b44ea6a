/* Reads the conditions on the faces of a body. */
#include "solver/cloud.h"
#include "solver/scene_internal.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const char scene_face_kinds[] = "free symmetric skew-symmetric clamped traction motion roller";

static bool is_moved(int kind)
{
    return kind == SOLVER_MOTION || kind == SOLVER_ROLLER;
}

/* The table on top of the stack has no other keys than these. */
static void refuse_unknown(lua_State *L, const char *key)
{
    static const char *const known[] = {"kind", "value", "traction", "free_after", "within"};
    int given = lua_gettop(L);
    for (lua_pushnil(L); lua_next(L, given); lua_pop(L, 1)) {
        const char *name = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : "1";
        bool found = false;
        for (size_t i = 0; i < sizeof known / sizeof *known; i++)
            found = found || strcmp(name, known[i]) == 0;
        if (!found)
            scene_refuse(L, "%s.%.60s: unknown key; expected kind, value, traction, free_after and within", key, name);
    }
}

/* Keeps the formula under `name` of the table at index `given`, if it is there; `takes`: the face has such a formula,
 * `needs`: and cannot do without. */
static void read_formula(lua_State *L, const char *key, int given, const char *name, enum solver_formula formula,
                         int kind, bool takes, bool needs)
{
    const struct solver_scene *scene = scene_lua_of(L)->scene;
    bool driven = strcmp(scene->loads_from, "oracle") == 0;
    char word[SOLVER_NAME];
    scene_word_at(scene_face_kinds, kind, word, sizeof word);
    if (lua_istable(L, given))
        lua_getfield(L, given, name);
    else
        lua_pushnil(L);
    if (!lua_isnil(L, -1) && !takes)
        scene_refuse(L, "%s: '%s' takes no %s", key, word, name);
    if (!lua_isnil(L, -1) && driven)
        scene_refuse(L, "%s: loads.from: the oracle gives what the face prescribes, and the scene a %s besides", key,
                     name);
    if (takes && !driven && !lua_isfunction(L, -1) && (needs || !lua_isnil(L, -1)))
        scene_refuse(L, "%s: '%s' needs %s = function(X, Y, Z, t) returning %d number%s", key, word, name, scene->dim,
                     scene->dim == 1 ? "" : "s");
    if (lua_isfunction(L, -1))
        scene_lua_keep_formula(L, formula); /* pops it */
    else
        lua_pop(L, 1);
}

/* When a moved face is let go; infinity if never. */
static double read_end(lua_State *L, const char *key, int given, int kind)
{
    double until = INFINITY;
    if (!lua_istable(L, given))
        return until;
    if (lua_getfield(L, given, "free_after") != LUA_TNIL) {
        char path[2 * SOLVER_NAME];
        snprintf(path, sizeof path, "%s.free_after", key);
        until = scene_read_number(L, path, -1, DBL_MIN, DBL_MAX, "number > 0 [s]");
        if (!is_moved(kind)) {
            char word[SOLVER_NAME];
            scene_word_at(scene_face_kinds, kind, word, sizeof word);
            scene_refuse(L, "%s: only 'motion' and 'roller' take free_after, '%s' lasts", key, word);
        }
    }
    lua_pop(L, 1);
    return until;
}

/* The part of a moved face that is moved, the rest being free. */
static void read_part(lua_State *L, struct solver_scene *scene, const char *key, int given, int face)
{
    double(*within)[3] = scene->face_within[face];
    char path[2 * SOLVER_NAME];
    snprintf(path, sizeof path, "%s.within", key);
    if (!lua_istable(L, given) || lua_getfield(L, given, "within") == LUA_TNIL)
        return;
    if (!is_moved((int)scene->face[face]) || solver_scene_has(scene, (enum solver_formula)(SOLVER_SHEAR_X0 + face)))
        scene_refuse(L, "%s: only 'motion' and 'roller' without traction take it", path);
    if (scene->lattice == SOLVER_CENTRES)
        scene_refuse(L, "%s: with lattice = \"centres\" a wall moves the face, all of it", path);
    if (!lua_istable(L, -1) || lua_rawlen(L, -1) != 2)
        scene_refuse_value(L, path, "a list of two corners, { ... }, { ... } [m]", -1);
    for (int end = 0; end < 2; end++) {
        lua_rawgeti(L, -1, end + 1);
        scene_read_numbers(L, path, -1, within[end], (size_t)scene->dim);
        lua_pop(L, 1);
    }
    for (int i = 0; i < scene->dim; i++)
        if (within[0][i] > within[1][i])
            scene_refuse(L, "%s: expected a lower and an upper corner, got %g and %g along %c", path, within[0][i],
                         within[1][i], "XYZ"[i]);
    lua_pop(L, 1);
}

/* The kind of the face whose condition stands at index `given`: a word, or a table with the word. */
static int read_kind(lua_State *L, const struct solver_scene_key *key, int given)
{
    bool later;
    if (lua_istable(L, given)) {
        refuse_unknown(L, key->key);
        lua_getfield(L, given, "kind");
    } else
        lua_pushvalue(L, given);
    int kind = lua_type(L, -1) == LUA_TSTRING ? scene_word_find(scene_face_kinds, lua_tostring(L, -1), &later) : -1;
    if (kind < 0)
        scene_refuse_value(L, key->key, key->expects, -1);
    lua_pop(L, 1);
    return kind;
}

static void read_face(lua_State *L, struct solver_scene *scene, const struct solver_scene_key *key, int face)
{
    int given = lua_gettop(L);
    if (face < SOLVER_SURFACE && face / 2 >= scene->dim)
        scene_refuse(L, "%s: a body of dim = %d has no such face", key->key, scene->dim);
    int kind = read_kind(L, key, given);
    bool valued = kind == SOLVER_TRACTION || is_moved(kind);
    scene->face[face] = (enum solver_face_kind)kind;
    scene->face_until[face] = read_end(L, key->key, given, kind);
    if (isfinite(scene->face_until[face]) && strcmp(scene->loads_from, "oracle") == 0)
        scene_refuse(L, "%s.free_after: loads.from: the oracle drives the face for good", key->key);
    if (face == SOLVER_SURFACE && kind == SOLVER_TRACTION && solver_shape_in_box(scene->domain.kind) &&
        strcmp(scene->loads_from, "oracle") == 0)
        scene_refuse(L,
                     "%s: loads.from: the exact traction is that on a normal, which of a solid is not known; expected "
                     "formulas, and value = function(X, Y, Z, t)",
                     key->key);
    read_formula(L, key->key, given, "value", (enum solver_formula)(SOLVER_FACE_X0 + face), kind, valued, true);
    read_formula(L, key->key, given, "traction", (enum solver_formula)(SOLVER_SHEAR_X0 + face), kind,
                 kind == SOLVER_ROLLER, false);
    read_part(L, scene, key->key, given, face);
}

void scene_read_faces(lua_State *L, struct solver_scene *scene)
{
    for (int k = 0; solver_scene_keys()[k].key; k++) {
        const struct solver_scene_key *key = &solver_scene_keys()[k];
        const struct scene_key *rule = scene_key_rule(k);
        if (rule->kind != SCENE_FACE)
            continue;
        scene->face_until[rule->offset] = INFINITY;
        for (int i = 0; i < 6; i++)
            scene->face_within[rule->offset][i / 3][i % 3] = i < 3 ? -INFINITY : INFINITY;
        scene_lua_push(L, key->key);
        if (!lua_isnil(L, -1))
            read_face(L, scene, key, (int)rule->offset);
        lua_pop(L, 1);
    }
}
