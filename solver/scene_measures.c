/* Reads what a study measures on the way and besides errors: snapshots and figures. */
#include "solver/scene_internal.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

/* The name on top of the stack but one; `key` says of what. */
static void read_name(lua_State *L, const char *key, char out[SOLVER_NAME])
{
    if (lua_type(L, -2) != LUA_TSTRING)
        scene_refuse_value(L, key, "names as keys", -2);
    scene_read_text(L, key, -2, out, SOLVER_NAME);
}

/* Text, a number or a list of up to four, on top of the stack. */
static void read_option(lua_State *L, const char *key, struct solver_option *option)
{
    if (lua_type(L, -1) == LUA_TSTRING) {
        scene_read_text(L, key, -1, option->text, sizeof option->text);
        return;
    }
    option->count = 1;
    if (lua_istable(L, -1)) {
        option->count = scene_list_length(L, key, 4, false);
        scene_read_numbers(L, key, -1, option->number, option->count);
        return;
    }
    option->number[0] = scene_read_number(L, key, -1, -DBL_MAX, DBL_MAX, "text, a number or a list of up to 4 numbers");
}

static int compare_options(const void *a, const void *b)
{
    return strcmp(((const struct solver_option *)a)->name, ((const struct solver_option *)b)->name);
}

static int compare_figures(const void *a, const void *b)
{
    return strcmp(((const struct solver_figure *)a)->name, ((const struct solver_figure *)b)->name);
}

/* The table on top of the stack; lists are sorted by name, since Lua's tables have no order of their own. */
static void read_figure(lua_State *L, struct solver_figure *figure)
{
    char key[2 * SOLVER_NAME], path[4 * SOLVER_NAME];
    snprintf(key, sizeof key, "figures.%s", figure->name);
    if (!lua_istable(L, -1))
        scene_refuse_value(L, key, "{ measure = text, OPTION = ..., ... }", -1);
    for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1)) {
        struct solver_option option = {.count = 0};
        read_name(L, key, option.name);
        snprintf(path, sizeof path, "%s.%s", key, option.name);
        if (!strcmp(option.name, "measure")) {
            scene_read_text(L, path, -1, figure->measure, sizeof figure->measure);
            continue;
        }
        if (figure->option_count == SOLVER_OPTIONS)
            scene_refuse(L, "%s: at most %d options are possible", key, SOLVER_OPTIONS);
        read_option(L, path, &option);
        figure->option[figure->option_count++] = option;
    }
    if (!figure->measure[0])
        scene_refuse(L, "%s.measure: missing; expected text, see assay list measures", key);
    qsort(figure->option, figure->option_count, sizeof *figure->option, compare_options);
}

void scene_read_figures(lua_State *L, struct solver_scene *scene)
{
    if (scene_push_table(L, "figures", "{ [NAME] = { measure = text, OPTION = ..., ... }, ... }")) {
        for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1)) {
            if (scene->figure_count == SOLVER_FIGURES)
                scene_refuse(L, "figures: at most %d are possible", SOLVER_FIGURES);
            struct solver_figure *figure = &scene->figure[scene->figure_count++];
            read_name(L, "figures", figure->name);
            read_figure(L, figure);
        }
        qsort(scene->figure, scene->figure_count, sizeof *scene->figure, compare_figures);
    }
    lua_pop(L, 1);
}
