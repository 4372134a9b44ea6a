/* What must hold between plain keys of a scene, and which of its defaults depend on others. */
#include "solver/material.h"
#include "solver/scene_internal.h"
#include "solver/stencil.h"

#include <stdio.h>
#include <string.h>

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
    scene_lua_push(L, "view.range");
    bool given = !lua_isnil(L, -1);
    lua_pop(L, 1);
    if (given && !(view->range[0] < view->range[1]))
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
 * (tests/unit/solver_perturbed.c), for up to 1.2 times the time and 1.4 times the memory. So it is near the surface of
 * a body of any shape, onto which particles are moved: a quarter of a tube, four spacings across its wall, grows by
 * 3e-3 per step with {p,F,J}. A pressure of its own takes no others. */
static bool slopes_grow(const struct solver_scene *scene)
{
    enum solver_shape_kind kind = scene->domain.kind;
    bool moved = scene->perturb > 0.0 || kind == SOLVER_SHAPE_SOLID || kind == SOLVER_SHAPE_STL;
    return moved && strcmp(scene->scheme, "upwind") == 0 && strcmp(scene->stencil, "closed") == 0;
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
    if (scene->nu == 0.5 && of->solver == SOLVER_PRESSURE_NONE)
        scene_refuse(L, "material.nu: 0.5 is incompressible, and the pressure is then an unknown of its own; take "
                        "incompressible.solver = \"poisson\", or nu < 0.5, say 0.4999");
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

/* What is said twice: by the oracle, and by a formula. */
static void check_sources(lua_State *L, const struct solver_scene *scene)
{
    for (int f = 0; strcmp(scene->initial_from, "oracle") == 0 && f <= SOLVER_INITIAL_F; f++)
        if (solver_scene_has(scene, (enum solver_formula)f))
            scene_refuse(L, "initial.from: the oracle gives the initial state, and the scene a formula for it besides");
    if (strcmp(scene->loads_from, "oracle") == 0 && solver_scene_has(scene, SOLVER_BODY_FORCE))
        scene_refuse(L, "loads.from: the oracle gives the body force, and the scene a formula for it besides");
}

void scene_check_plain(lua_State *L, struct solver_scene *scene)
{
    check_incompressible(L, scene);
    choose_slopes(L, scene);
    check_flow(L, scene);
    check_jst(L, scene);
    check_rigid_wall(L, scene);
}

void scene_check_bodies(lua_State *L, const struct solver_scene *scene)
{
    check_precision(L, scene);
    check_sources(L, scene);
    if (scene->has_view)
        check_view(L, &scene->view);
}
