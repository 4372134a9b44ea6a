/* Loading a scene: file, run in the sandbox, plain keys, structured parts. */
#include "solver/scene_internal.h"

#include <errno.h>
#include <fcntl.h>
#include <lauxlib.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { LARGEST_FILE = 1 << 20 }; /* bytes */

/* --- the file --- */

/* Reads what is open as `file` into scene->text. */
static bool read_open_file(struct solver_scene *scene, int file, struct solver_error *error)
{
    struct stat about;
    const char *path = scene->path;
    if (fstat(file, &about) != 0)
        return solver_fail(error, SOLVER_IO, "%.400s: cannot be examined: %s", path, strerror(errno));
    if (S_ISDIR(about.st_mode))
        return solver_fail(error, SOLVER_BAD_INPUT, "%.400s: is a directory; expected a scene file (.lua)", path);
    if (!S_ISREG(about.st_mode))
        return solver_fail(error, SOLVER_BAD_INPUT, "%.400s: is no regular file; expected a scene file (.lua)", path);
    if (about.st_size > LARGEST_FILE)
        return solver_fail(error, SOLVER_BAD_INPUT, "%.400s: has %lld bytes; a scene has at most %d", path,
                           (long long)about.st_size, LARGEST_FILE);
    size_t size = (size_t)about.st_size, got = 0;
    scene->text = malloc(size + 1);
    if (!scene->text)
        return solver_fail(error, SOLVER_NO_MEMORY, "%.400s: no memory for its %zu bytes", path, size);
    while (got < size) {
        ssize_t step = read(file, scene->text + got, size - got);
        if (step < 0 && errno == EINTR)
            continue;
        if (step <= 0)
            return solver_fail(error, SOLVER_IO, "%.400s: reading stopped after %zu of %zu bytes: %s", path, got, size,
                               step < 0 ? strerror(errno) : "the file was cut short");
        got += (size_t)step;
    }
    scene->text[size] = '\0';
    if (memchr(scene->text, '\0', size) || scene->text[0] == '\033')
        return solver_fail(error, SOLVER_BAD_INPUT, "%.400s: is binary; expected a scene written as text", path);
    return true;
}

static bool read_file(struct solver_scene *scene, struct solver_error *error)
{
    int file = open(scene->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK); /* a pipe must not make the program wait */
    if (file < 0)
        return solver_fail(error, SOLVER_BAD_INPUT, "%.400s: cannot be opened: %s", scene->path, strerror(errno));
    bool good = read_open_file(scene, file, error);
    close(file);
    return good;
}

/* Path and name of the scene, text of the overrides. */
static bool describe(struct solver_scene *scene, const char *path, const char *const *overrides, size_t count,
                     struct solver_error *error)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    size_t length = strlen(name), size = 1, used = 0;
    if (strlen(path) >= sizeof scene->path)
        return solver_fail(error, SOLVER_BAD_INPUT, "%.200s...: the path has %zu bytes; at most %zu are possible", path,
                           strlen(path), sizeof scene->path - 1);
    snprintf(scene->path, sizeof scene->path, "%s", path);
    solver_plain(scene->path, false);
    /* it is printed, and stands in records; that of a checkpoint comes from a file */
    if (strcmp(scene->path, path) != 0)
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%.400s: the path holds control characters, or bytes that are no UTF-8", path);
    if (length > 4 && !strcmp(name + length - 4, ".lua"))
        length -= 4;
    if (length >= sizeof scene->name)
        return solver_fail(error, SOLVER_BAD_INPUT, "%.400s: the name has %zu bytes; at most %zu are possible", path,
                           length, sizeof scene->name - 1);
    snprintf(scene->name, sizeof scene->name, "%.*s", (int)length, name);
    for (size_t i = 0; i < count; i++)
        size += strlen(overrides[i]) + 1;
    scene->overrides = calloc(size, 1);
    if (!scene->overrides)
        return solver_fail(error, SOLVER_NO_MEMORY, "%.400s: no memory for %zu overrides", path, count);
    for (size_t i = 0; i < count; i++)
        used += (size_t)snprintf(scene->overrides + used, size - used, "%s\n", overrides[i]);
    return true;
}

/* --- what it says --- */

static int read_scene(lua_State *L)
{
    struct solver_scene *scene = lua_touserdata(L, 1);
    luaL_checkstack(L, 100, "scene");
    scene_lua_run_file(L);
    scene_overrides_finish(L);
    scene_read_plain(L, scene);
    scene_check_plain(L, scene);
    scene_read_bodies(L, scene);
    scene_read_die(L, scene);
    scene_check_range(L, scene);
    scene_check_bodies(L, scene);
    scene_read_faces(L, scene);
    scene_hold_symmetry(L, scene);
    scene_check_faces(L, scene);
    scene_read_resolution(L, scene);
    scene_read_probes(L, scene);
    scene_read_snapshots(L, scene);
    scene_read_figures(L, scene);
    scene_read_oracle(L, scene);
    scene_read_published(L, scene);
    scene_read_gates(L, scene);
    scene_read_beside(L, scene);
    scene_read_trade(L, scene);
    scene_globals_freeze(L);
    return 0;
}

/* A place of the body, or of the first of several: a box's lower corner, or the outermost point along X of another. */
static void place_of_body(const struct solver_scene *scene, double X[3])
{
    const struct solver_shape *shape = scene->shape_count > 0 ? &scene->shape[0] : &scene->domain;
    memcpy(X, scene->shape_count > 0 ? shape->lower : scene->lower, 3 * sizeof *X);
    if (!solver_shape_in_box(shape->kind)) {
        X[0] = shape->centre[0] + shape->outer;
        X[1] = shape->centre[1];
        X[2] = shape->kind == SOLVER_SHAPE_CYLINDER ? X[2] : shape->centre[2];
    }
}

/* Asks each formula once, so that one that fails does so at once. Of a solid no place is known before its cloud is
 * made: its distance alone speaks of all of the box, and other formulas need not hold beyond the body. */
static bool try_formulas(const struct solver_scene *scene, struct solver_error *error)
{
    enum solver_shape_kind kind = scene->domain.kind;
    bool known = kind != SOLVER_SHAPE_SOLID && kind != SOLVER_SHAPE_STL;
    for (int f = 0; f < SOLVER_FORMULAS; f++) {
        double X[3], value[9];
        size_t dim = (size_t)scene->dim;
        size_t count = f == SOLVER_INITIAL_F ? dim * dim : f == SOLVER_MATERIAL_AT ? 3 : f == SOLVER_DISTANCE ? 1 : dim;
        if (!solver_scene_has(scene, (enum solver_formula)f) || (!known && f != SOLVER_DISTANCE))
            continue;
        place_of_body(scene, X);
        int face = (f - SOLVER_FACE_X0) % SOLVER_FACES;
        if (f > SOLVER_FACE_X0 && face % 2)
            X[face / 2] = scene->upper[face / 2];
        if (!solver_scene_eval(scene, (enum solver_formula)f, X, 0, value, count, error))
            return false;
    }
    return true;
}

static bool copy_text(struct solver_scene *scene, const char *text, struct solver_error *error)
{
    scene->text = strdup(text);
    return scene->text || solver_fail(error, SOLVER_NO_MEMORY, "%.400s: no memory for its text", scene->path);
}

/* Of `text`, or of what the file holds where it is NULL. */
static bool load(const char *path, const char *text, const char *const *overrides, size_t override_count,
                 struct solver_scene **scene, struct solver_error *error)
{
    *scene = NULL;
    struct solver_scene *fresh = calloc(1, sizeof *fresh);
    if (!fresh)
        return solver_fail(error, SOLVER_NO_MEMORY, "%.400s: no memory for a scene", path);
    bool good = describe(fresh, path, overrides, override_count, error) &&
                (text ? copy_text(fresh, text, error) : read_file(fresh, error)) && scene_lua_create(fresh, error) &&
                scene_overrides_parse(fresh->lua, overrides, override_count, error) &&
                scene_lua_protect(fresh->lua, read_scene, fresh, error) && try_formulas(fresh, error);
    if (!good) {
        solver_scene_free(fresh);
        return false;
    }
    free(fresh->lua->override); /* points into the caller's strings */
    fresh->lua->override = NULL;
    fresh->lua->override_count = 0;
    *scene = fresh;
    return true;
}

bool solver_scene_load(const char *path, const char *const *overrides, size_t override_count,
                       struct solver_scene **scene, struct solver_error *error)
{
    return load(path, NULL, overrides, override_count, scene, error);
}

bool solver_scene_load_text(const char *path, const char *text, const char *const *overrides, size_t override_count,
                            struct solver_scene **scene, struct solver_error *error)
{
    return load(path, text, overrides, override_count, scene, error);
}

void solver_scene_free(struct solver_scene *scene)
{
    if (!scene)
        return;
    solver_scene_drive_from(scene, NULL, NULL, NULL);
    scene_lua_free(scene->lua);
    free(scene->text);
    free(scene->overrides);
    free(scene);
}
