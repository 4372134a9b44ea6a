/* Loading a scene: file, run in the sandbox, plain keys, structured parts, and what must hold between keys. */
#include "solver/material.h"
#include "solver/scene_internal.h"
#include "solver/stencil.h"

#include <errno.h>
#include <fcntl.h>
#include <lauxlib.h>
#include <limits.h>
#include <math.h>
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
    if (strcmp(scene->path, path) !=
        0) /* it is printed, and stands in records; that of a checkpoint comes from a file */
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

/* --- what must hold between keys --- */

static void check_frame(lua_State *L, const double frame[6])
{
    bool given = false, wide = false;
    for (int i = 0; i < 3; i++) {
        double from = frame[2 * i], to = frame[2 * i + 1];
        given = given || from != 0 || to != 0;
        wide = wide || to > from;
        if (!(from <= to))
            scene_refuse(L, "view.frame: expected x0 <= x1, y0 <= y1, z0 <= z1, got %g and %g along %c", from, to,
                         "XYZ"[i]);
    }
    if (given && !wide)
        scene_refuse(L, "view.frame: expected a box, got a point");
}

static void check_view(lua_State *L, const struct solver_view *view)
{
    const double *d = view->direction, *up = view->up;
    double cross[3] = {d[1] * up[2] - d[2] * up[1], d[2] * up[0] - d[0] * up[2], d[0] * up[1] - d[1] * up[0]};
    if (!(view->range[0] < view->range[1]))
        scene_refuse(L, "view.range: expected two increasing numbers, got %g and %g", view->range[0], view->range[1]);
    if (cross[0] == 0 && cross[1] == 0 && cross[2] == 0)
        scene_refuse(L, "view.up: expected a direction that is neither zero nor along view.direction");
    check_frame(L, view->frame);
}

/* Constants of plastic flow that belong together. */
static void check_flow(lua_State *L, const struct solver_scene *scene)
{
    const struct solver_hardening *of = &scene->hardening;
    const struct solver_material_model *model = solver_material_find(scene->material_model);
    bool saturates = of->law == SOLVER_HARDENING_SATURATION, power = of->law == SOLVER_HARDENING_POWER;
    if (!solver_scene_flows(scene) && (of->law != 0 || of->modulus > 0))
        scene_refuse(L, "material.yield_stress: missing, and the scene says how the material hardens; expected number "
                        "> 0 [Pa]");
    if (solver_scene_flows(scene) && (model == NULL || model->in[scene->dim - 1]->flow == NULL))
        scene_refuse(L,
                     "material.yield_stress: the model %s does not flow plastically; take material.model = "
                     "\"hencky\"",
                     scene->material_model);
    if (saturates && !(of->saturation >= of->yield))
        scene_refuse(L, "material.saturation: expected number >= yield_stress = %g [Pa], got %g", of->yield,
                     of->saturation);
    if (saturates && !(of->rate > 0))
        scene_refuse(L, "material.saturation_rate: expected number > 0, got %g", of->rate);
    if (!saturates && (of->saturation > 0 || of->rate > 0))
        scene_refuse(L, "material.saturation: belongs to material.law = \"saturation\"");
    if (power && !(of->strain > 0))
        scene_refuse(L, "material.hardening_strain: expected number > 0, got %g", of->strain);
    if (power && !(of->exponent > 0))
        scene_refuse(L, "material.hardening_exponent: expected number in (0, 1], got %g", of->exponent);
    if (power && of->modulus > 0)
        scene_refuse(L, "material.hardening: the power law has no H");
    if (!power && (of->strain > 0 || of->exponent > 0))
        scene_refuse(L, "material.hardening_strain, hardening_exponent: belong to material.law = \"power\"");
}

/* JST's dependence on plastic strain. */
static void check_jst(lua_State *L, struct solver_scene *scene)
{
    struct solver_jst_terms *jst = &scene->jst;
    scene_lua_push(L, "jst.kappa4_plastic");
    jst->fades = !lua_isnil(L, -1);
    lua_pop(L, 1);
    if (jst->fades && !solver_scene_flows(scene))
        scene_refuse(L, "jst.kappa4_plastic: the material does not flow; expected material.yield_stress > 0 with it");
    if (!jst->fades && jst->plastic_at > 0)
        scene_refuse(L, "jst.plastic_at: belongs to jst.kappa4_plastic, which is missing");
    if (jst->fades && jst->plastic_at == 0)
        jst->plastic_at = 0.5;
}

/* A state in single precision is for the loops of upwind, and for what reads it through accessors. */
static void check_single(lua_State *L, const struct solver_scene *scene)
{
    static const char *const expected = "expected double or mixed";
    if (solver_scene_flows(scene))
        scene_refuse(L, "precision: single knows no plastic flow (material.yield_stress); %s", expected);
    if (strcmp(scene->angular_momentum, "projected") == 0)
        scene_refuse(L, "precision: single keeps no momentum to round-off (angular_momentum = \"projected\"); %s",
                     expected);
    const double *n = scene->rigid_wall.normal;
    if (n[0] != 0 || n[1] != 0 || n[2] != 0 || scene->die_count > 0)
        scene_refuse(L, "precision: single knows no walls (rigid_wall, die); %s", expected);
    if (scene->shape_count > 0)
        scene_refuse(L, "precision: single knows no contact of bodies (bodies); %s", expected);
    if (scene->balance)
        scene_refuse(L, "precision: single measures no dissipation (balance); %s", expected);
}

/* Of closed pair vectors between particles that were moved, as upwind takes them. Slopes taken with these feed energy
 * in. By its eigenvalues a cloud of 6 x 6 particles grows at any perturbation from 0.02 on: with {p,F} two in twenty,
 * by up to e-fold per step, and with {p,F,J} fifteen. With least-squares slopes none was found to, up to 0.45
 * (tests/unit/solver_perturbed.c), for up to 1.2 times the time and 1.4 times the memory. A pressure of its own takes
 * no others. */
static bool slopes_grow(const struct solver_scene *scene)
{
    return scene->perturb > 0.0 && strcmp(scene->scheme, "upwind") == 0 && strcmp(scene->stencil, "closed") == 0;
}

static const double slopes_hold = 0.15; /* of the spacing */

static bool is_graded(const struct solver_scene *scene)
{
    return scene->grading[0].ratio > 1.0 || scene->grading[1].ratio > 1.0 || scene->grading[2].ratio > 1.0;
}

static bool is_along_lines(const struct solver_scene *scene)
{
    return strcmp(scene->stencil, "sbp2") == 0 || strcmp(scene->stencil, "sbp4") == 0;
}

/* Likewise along lines of lattices whose spacings change, with sbp4, or on which materials meet (stencil_slopes.c). By
 * their eigenvalues a line of 25 grows by 1.4e-3 per step where the largest spacing is ten times the smallest, and ends
 * within 29000 steps, a square of 9 x 9 with four times by 1.3e-2; composite ones by up to 2e-2, graded or not
 * (tests/unit/solver_slopes.c). */
static bool slopes_grow_along_lines(const struct solver_scene *scene)
{
    bool composite = solver_scene_has(scene, SOLVER_MATERIAL_AT);
    bool fourth = strcmp(scene->stencil, "sbp4") == 0;
    return strcmp(scene->scheme, "upwind") == 0 && is_along_lines(scene) && (composite || (fourth && is_graded(scene)));
}

/* In single precision places along lines are where particles are, and slopes those that go with them. */
static const char *slopes_along_lines(const struct solver_scene *scene)
{
    return strcmp(scene->precision, "single") == 0 && is_graded(scene) ? "least-squares" : "lattice";
}

/* What `reconstruction` = "lattice" needs. */
static void check_lattice_slopes(lua_State *L, const struct solver_scene *scene)
{
    if (strcmp(scene->reconstruction, "lattice") != 0)
        return;
    if (strcmp(scene->scheme, "upwind") != 0 || !is_along_lines(scene))
        scene_refuse(L,
                     "reconstruction: lattice is for scheme = \"upwind\" with stencil = \"sbp2\" or \"sbp4\", not %s "
                     "with %s; expected stencil, least-squares or none",
                     scene->scheme, scene->stencil);
    if (strcmp(scene->precision, "single") == 0 && is_graded(scene))
        scene_refuse(L,
                     "reconstruction: lattice with a grading is for precision = \"double\" or \"mixed\", not single; "
                     "expected stencil, least-squares or none");
}

static void choose_slopes(lua_State *L, struct solver_scene *scene)
{
    if (scene->reconstruction[0] == '\0') {
        bool pressure = scene->incompressible.solver != SOLVER_PRESSURE_NONE;
        const char *own = slopes_grow(scene)               ? "least-squares"
                          : slopes_grow_along_lines(scene) ? slopes_along_lines(scene)
                                                           : "stencil";
        (void)snprintf(scene->reconstruction, SOLVER_NAME, "%s", pressure ? "stencil" : own);
    }
    check_lattice_slopes(L, scene);
    if (scene->perturb > slopes_hold && slopes_grow(scene) && strcmp(scene->reconstruction, "stencil") == 0)
        scene_refuse(
            L,
            "reconstruction: slopes of the stencil feed energy in where particles are moved by more than %g of "
            "the spacing, and perturb = %g; expected least-squares or none",
            slopes_hold, scene->perturb);
}

/* Pair vectors in single precision are for what the loops of upwind take from them. */
static void check_precision(lua_State *L, const struct solver_scene *scene)
{
    const struct solver_stencil_builder *builder = solver_stencil_find(scene->stencil);
    const char *precision = scene->precision;
    if (strcmp(precision, "double") == 0)
        return;
    if (strcmp(scene->scheme, "upwind") != 0)
        scene_refuse(L, "precision: %s is for scheme = \"upwind\", not %s; expected double", precision, scene->scheme);
    if (builder == NULL || !builder->antisymmetric)
        scene_refuse(L, "precision: %s is for antisymmetric stencils, closed, sbp2 and sbp4, not %s; expected double",
                     precision, scene->stencil);
    if (scene->evolved != SOLVER_PF && strcmp(scene->volume_flux, "stress") == 0)
        scene_refuse(L, "precision: %s knows volume_flux = \"pressure\" alone; expected double", precision);
    if (scene->incompressible.solver != SOLVER_PRESSURE_NONE)
        scene_refuse(L, "precision: %s knows no pressure of its own (incompressible.solver); expected double",
                     precision);
    if (scene->domain.cut[0] || scene->domain.cut[1] || scene->domain.cut[2])
        scene_refuse(L, "precision: %s knows no mirror images (domain.symmetry of a round body); expected double",
                     precision);
    if (strcmp(precision, "single") == 0)
        check_single(L, scene);
}

/* A plane wall has a point and a normal that is one. */
static void check_rigid_wall(lua_State *L, const struct solver_scene *scene)
{
    static const char *const keys[] = {"rigid_wall.point", "rigid_wall.normal"};
    const double *n = scene->rigid_wall.normal;
    scene_lua_push(L, "rigid_wall");
    bool given = !lua_isnil(L, -1);
    lua_pop(L, 1);
    for (int i = 0; given && i < 2; i++) {
        scene_lua_push(L, keys[i]);
        if (lua_isnil(L, -1))
            scene_refuse(L, "%s: missing; expected list of dim numbers, for a wall by a point and its normal", keys[i]);
        lua_pop(L, 1);
    }
    if (given && n[0] == 0 && n[1] == 0 && n[2] == 0)
        scene_refuse(L, "rigid_wall.normal: expected a direction, from the wall to the body, got zeros");
}

/* A pressure of its own is part of the scheme upwind, and belongs to a material that hardly yields in volume. */
static void check_incompressible(lua_State *L, const struct solver_scene *scene)
{
    const struct solver_incompressible *of = &scene->incompressible;
    if (of->solver == SOLVER_PRESSURE_NONE)
        return;
    if (strcmp(scene->scheme, "upwind") != 0)
        scene_refuse(L, "incompressible.solver: the scheme %s has no pressure of its own; take scheme = \"upwind\"",
                     scene->scheme);
    if (!(scene->nu >= 0.4))
        scene_refuse(L,
                     "incompressible.solver: expected material.nu in [0.4, 0.5], got %g; a body that yields so much "
                     "in volume needs none",
                     scene->nu);
    if (of->solver != SOLVER_PRESSURE_PSEUDO_TIME && of->alpha > 0)
        scene_refuse(L, "incompressible.alpha: belongs to incompressible.solver = \"pseudo-time\"");
}

static int read_scene(lua_State *L)
{
    struct solver_scene *scene = lua_touserdata(L, 1);
    luaL_checkstack(L, 100, "scene");
    scene_lua_run_file(L);
    scene_overrides_finish(L);
    scene_read_plain(L, scene);
    if (scene->nu == 0.5 && scene->incompressible.solver == SOLVER_PRESSURE_NONE)
        scene_refuse(L, "material.nu: 0.5 is incompressible, and the pressure is then an unknown of its own; take "
                        "incompressible.solver = \"poisson\", or nu < 0.5, say 0.4999");
    check_incompressible(L, scene);
    choose_slopes(L, scene);
    check_flow(L, scene);
    check_jst(L, scene);
    check_rigid_wall(L, scene);
    scene_read_bodies(L, scene);
    scene_read_die(L, scene);
    scene_check_range(L, scene);
    check_precision(L, scene);
    for (int f = 0; strcmp(scene->initial_from, "oracle") == 0 && f <= SOLVER_INITIAL_F; f++)
        if (solver_scene_has(scene, (enum solver_formula)f))
            scene_refuse(L, "initial.from: the oracle gives the initial state, and the scene a formula for it besides");
    if (strcmp(scene->loads_from, "oracle") == 0 && solver_scene_has(scene, SOLVER_BODY_FORCE))
        scene_refuse(L, "loads.from: the oracle gives the body force, and the scene a formula for it besides");
    if (scene->has_view)
        check_view(L, &scene->view);
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

/* Asks each formula once, so that one that fails does so at once. */
static bool try_formulas(const struct solver_scene *scene, struct solver_error *error)
{
    for (int f = 0; f < SOLVER_FORMULAS; f++) {
        double X[3], value[9];
        size_t dim = (size_t)scene->dim;
        size_t count = f == SOLVER_INITIAL_F ? dim * dim : f == SOLVER_MATERIAL_AT ? 3 : f == SOLVER_DISTANCE ? 1 : dim;
        if (!solver_scene_has(scene, (enum solver_formula)f))
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
