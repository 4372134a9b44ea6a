/* Planes of symmetry of a domain: what lies above them is modelled, and the particles on them stay on them. */
#include "solver/scene_internal.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

static const char *const axes[] = {"X", "Y", "Z"};

/* The axis of that name, below dim. */
static int axis_of(const struct solver_scene *scene, const char *name)
{
    for (int axis = 0; axis < 3 && axis < scene->dim; axis++)
        if (strcmp(name, axes[axis]) == 0)
            return axis;
    return -1;
}

void scene_read_symmetry(lua_State *L, struct solver_scene *scene)
{
    if (!scene_push_table(L, "domain.symmetry", "{ X = number, ... } [m]")) {
        lua_pop(L, 1);
        return;
    }
    if (!solver_shape_in_box(scene->domain.kind))
        scene_refuse(
            L,
            "domain.symmetry: a domain of this shape has none; expected domain.shape = \"box\", \"solid\" or \"stl\"");
    for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1)) {
        char key[2 * SOLVER_NAME];
        const char *name = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : "1";
        int axis = axis_of(scene, name);
        snprintf(key, sizeof key, "domain.symmetry.%.60s", name);
        if (axis < 0)
            scene_refuse(L, "%s: unknown key; expected X, Y or Z, along which a body of dim = %d reaches", key,
                         scene->dim);
        double plane = scene_read_number(L, key, -1, -DBL_MAX, DBL_MAX, "number [m]");
        if (!(plane >= scene->lower[axis] && plane < scene->upper[axis]))
            scene_refuse(L, "%s: expected a plane that cuts the domain, from %g to less than %g m, got %g", key,
                         scene->lower[axis], scene->upper[axis], plane);
        scene->lower[axis] = plane;
        scene->symmetric[axis] = true;
    }
    lua_pop(L, 1);
}

void scene_hold_symmetry(lua_State *L, struct solver_scene *scene)
{
    for (int axis = 0; axis < 3; axis++) {
        enum solver_face_kind *face = &scene->face[2 * axis];
        if (!scene->symmetric[axis])
            continue;
        if (*face != SOLVER_FREE)
            scene_refuse(L, "faces.%s0: domain.symmetry.%s makes it a plane of symmetry; expected no other condition",
                         axes[axis], axes[axis]);
        *face = SOLVER_SYMMETRIC;
    }
}
