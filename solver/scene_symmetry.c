/* Reads the planes of symmetry of a domain, domain.symmetry = { X = 0, Y = 0 }: what lies above them is modelled, and
 * they are faces that hold the velocity along their normal. */
#include "solver/scene_internal.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char expected[] = "{ X = place, ... }: where planes of symmetry lie across X, Y or Z [m]";

/* The axis that is named by the key at `index`. */
static int read_axis(lua_State *L, const struct solver_scene *scene, int index)
{
    const char *name = lua_type(L, index) == LUA_TSTRING ? lua_tostring(L, index) : "";
    const char *axes = "XYZ";
    const char *found = strlen(name) == 1 ? strchr(axes, name[0]) : NULL;
    if (found == NULL)
        scene_refuse(L, "domain.symmetry.%.60s: unknown key; expected %s", name, expected);
    if (found - axes >= scene->dim)
        scene_refuse(L, "domain.symmetry.%s: a body of dim = %d has no such axis", name, scene->dim);
    return (int)(found - axes);
}

/* The lattice of a box, or of what is cut out of one, begins at the plane. */
static void cut_box(lua_State *L, struct solver_scene *scene, const char *key, int axis, double plane)
{
    if (!(plane >= scene->lower[axis] && plane < scene->upper[axis]))
        scene_refuse(L, "%s: expected a plane that cuts the domain, from %g to less than %g m, got %g", key,
                     scene->lower[axis], scene->upper[axis], plane);
    scene->lower[axis] = plane;
}

/* The particles of a round body are their own mirror images in planes through its centre. */
static void cut_round(lua_State *L, struct solver_scene *scene, const char *key, int axis, double plane)
{
    struct solver_shape *shape = &scene->domain;
    if (axis == 2 && shape->kind == SOLVER_SHAPE_CYLINDER)
        scene_refuse(L,
                     "%s: expected a plane across a curved axis; half the length, with faces.Z0 = \"symmetric\", does "
                     "it along a cylinder",
                     key);
    if (!(fabs(plane - shape->centre[axis]) <= 1e-9 * shape->outer))
        scene_refuse(L, "%s: expected the centre of the round body, %g, got %g", key, shape->centre[axis], plane);
    shape->cut[axis] = true;
    shape->plane[axis] = plane;
    scene->lower[axis] = shape->centre[axis];
}

void scene_read_symmetry(lua_State *L, struct solver_scene *scene)
{
    if (!scene_push_table(L, "domain.symmetry", expected)) {
        lua_pop(L, 1);
        return;
    }
    for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1)) {
        int axis = read_axis(L, scene, -2);
        char key[] = "domain.symmetry.X";
        key[sizeof key - 2] = "XYZ"[axis];
        double plane = scene_read_number(L, key, -1, -DBL_MAX, DBL_MAX, "a number [m]");
        if (solver_shape_in_box(scene->domain.kind))
            cut_box(L, scene, key, axis, plane);
        else
            cut_round(L, scene, key, axis, plane);
        scene->symmetric[axis] = true;
    }
    lua_pop(L, 1);
}

void scene_hold_symmetry(lua_State *L, struct solver_scene *scene)
{
    for (int axis = 0; axis < 3; axis++) {
        enum solver_face_kind *kind = &scene->face[2 * axis];
        if (!scene->symmetric[axis])
            continue;
        if (*kind != SOLVER_FREE && *kind != SOLVER_SYMMETRIC)
            scene_refuse(L, "faces.%c0: domain.symmetry.%c makes it symmetric; expected \"symmetric\", or nothing",
                         "XYZ"[axis], "XYZ"[axis]);
        *kind = SOLVER_SYMMETRIC;
    }
}
