/* Reads what a study measures besides errors: snapshots. */
#include "solver/scene_internal.h"

#include <float.h>
#include <stdio.h>

void scene_read_snapshots(lua_State *L, struct solver_scene *scene)
{
    if (scene_push_table(L, "snapshots", "list of increasing numbers in (0, t_end] [s]")) {
        scene->snapshot_count = scene_list_length(L, "snapshots", SOLVER_SNAPSHOTS, false);
        for (size_t i = 0; i < scene->snapshot_count; i++) {
            char key[32];
            snprintf(key, sizeof key, "snapshots[%zu]", i + 1);
            lua_rawgeti(L, -1, (lua_Integer)i + 1);
            scene->snapshot[i] = scene_read_number(L, key, -1, DBL_MIN, DBL_MAX, "number > 0 [s]");
            lua_pop(L, 1);
            if (i > 0 && scene->snapshot[i] <= scene->snapshot[i - 1])
                scene_refuse(L, "%s: expected increasing times, got %g s after %g s", key, scene->snapshot[i],
                             scene->snapshot[i - 1]);
            if (scene->snapshot[i] > scene->t_end)
                scene_refuse(L,
                             "%s: %g s lies after t_end = %g s; take a later t_end or fewer snapshots (--set "
                             "snapshots={} for none)",
                             key, scene->snapshot[i], scene->t_end);
        }
    }
    lua_pop(L, 1);
}
