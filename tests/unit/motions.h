/* Motions x = F(t) X + t drift of the unit block, whose velocity, body force rho F'' X and tractions P(F(t)) N the
 * scene gets from C, so that every material of the table can be asked. */
#ifndef TESTS_MOTIONS_H
#define TESTS_MOTIONS_H

#include "solver/scene_internal.h"
#include "tests/unit/random_tensors.h"
#include "tests/unit/runs.h"

struct motion {
    size_t dim;
    const struct solver_material *material;
    struct solver_material_constants constants; /* the scene's, unless set before */
    /* d^order F / dt^order at time t, [dim][dim] */
    void (*gradient)(const struct motion *motion, double t, int order, double *F);
    double drift[3];           /* [m/s] */
    double start[9], rate[9];  /* of an affine motion: F = start + t rate */
    double axis[3], frequency; /* of a rotation: unit vector, [rad/s] */
};

static inline void affine_gradient(const struct motion *motion, double t, int order, double *F)
{
    for (size_t k = 0; k < motion->dim * motion->dim; k++) {
        F[k] = order == 0 ? motion->start[k] + t * motion->rate[k] : order == 1 ? motion->rate[k] : 0.0;
    }
}

/* P of F with the cofactor and Jacobian that belong to it. */
static inline void motion_stress(const struct motion *motion, double t, double *P)
{
    double F[9], H[9], J;
    motion->gradient(motion, t, 0, F);
    measures_of(motion->material->linear, motion->dim, F, H, &J);
    motion->material->stress(&motion->constants, F, H, J, P);
}

/* d^order x / dt^order */
static inline void motion_place(const struct motion *motion, const double *X, double t, int order, double *x)
{
    double F[9];
    motion->gradient(motion, t, order, F);
    for (size_t i = 0; i < motion->dim; i++) {
        x[i] = order == 0 ? t * motion->drift[i] : order == 1 ? motion->drift[i] : 0.0;
        for (size_t I = 0; I < motion->dim; I++) {
            x[i] += F[i * motion->dim + I] * X[I];
        }
    }
}

/* What the scene is told when it asks for a formula: f(X, Y, Z, t). */
static inline int motion_answer(lua_State *L)
{
    const struct motion *motion = lua_touserdata(L, lua_upvalueindex(1));
    enum solver_formula formula = (enum solver_formula)lua_tointeger(L, lua_upvalueindex(2));
    const struct solver_scene *scene = scene_lua_of(L)->scene;
    size_t count = motion->dim;
    const double X[3] = {lua_tonumber(L, 1), lua_tonumber(L, 2), lua_tonumber(L, 3)};
    double t = lua_tonumber(L, 4), value[9] = {0}, P[9];
    if (formula == SOLVER_INITIAL_F) {
        motion->gradient(motion, 0.0, 0, value);
        count *= count;
    } else if (formula >= SOLVER_FACE_X0 && scene->face[formula - SOLVER_FACE_X0] == SOLVER_TRACTION) {
        size_t face = (size_t)(formula - SOLVER_FACE_X0);
        motion_stress(motion, t, P);
        for (size_t i = 0; i < count; i++) {
            value[i] = (face % 2 == 0 ? -1.0 : 1.0) * P[i * count + face / 2];
        }
    } else {
        int order = formula == SOLVER_INITIAL_DISPLACEMENT ? 0 : formula == SOLVER_BODY_FORCE ? 2 : 1;
        motion_place(motion, X, t, order, value);
        for (size_t i = 0; i < count; i++) {
            value[i] = order == 0 ? value[i] - X[i] : order == 2 ? motion->constants.rho * value[i] : value[i];
        }
    }
    for (size_t i = 0; i < count; i++) {
        lua_pushnumber(L, value[i]);
    }
    return (int)count;
}

/* Replaces every formula that the scene gives. */
static inline int motion_replace(lua_State *L)
{
    struct motion *motion = lua_touserdata(L, 1);
    for (int formula = 0; formula < SOLVER_FORMULAS; formula++) {
        if (solver_scene_has(scene_lua_of(L)->scene, (enum solver_formula)formula)) {
            lua_pushlightuserdata(L, motion);
            lua_pushinteger(L, formula);
            lua_pushcclosure(L, motion_answer, 2);
            scene_lua_keep_formula(L, (enum solver_formula)formula);
        }
    }
    return 0;
}

/* `faces`: a letter for each of X0, X1, Y0, ...: Free, Symmetric, sKew-symmetric, Clamped, Traction, Motion. A body
 * force acts where the motion has an acceleration. */
static inline void motion_scene(const struct motion *motion, const char *faces, char *out, size_t room)
{
    static const char letters[] = "FSKCTM";
    static const char *const kinds[] = {"free", "symmetric", "skew-symmetric", "clamped", "traction", "motion"};
    double second[9];
    motion->gradient(motion, 0.0, 2, second);
    bool accelerates = largest_entry(motion->dim * motion->dim, second) > 0.0;
    static const char zeros[] = "0, 0, 0, 0, 0, 0, 0, 0, 0"; /* formulas are tried before they are replaced */
    size_t used =
        (size_t)snprintf(out, room,
                         "local function f() return first(0, 0, 0) end\n"
                         "initial = { displacement = f, velocity = f, F = function() return %.*s end }\n"
                         "%sfaces = {",
                         (int)(3 * motion->dim * motion->dim - 2), zeros, accelerates ? "body_force = f\n" : "");
    for (size_t face = 0; face < 2 * motion->dim; face++) {
        const char *letter = strchr(letters, faces[face]);
        CU_ASSERT_FATAL(letter != NULL && *letter != '\0');
        used += (size_t)snprintf(out + used, room - used, " %c%zu = { kind = '%s'%s },", "XYZ"[face / 2], face % 2,
                                 kinds[letter - letters], letter - letters > 3 ? ", value = f" : "");
    }
    used += (size_t)snprintf(out + used, room - used, " }\n");
    CU_ASSERT_FATAL(used < room);
}

/* A run that sets out on the motion, which must outlive it; on failure run is NULL. */
static inline struct sample motion_try(struct motion *motion, const char *faces, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
static inline struct sample motion_try(struct motion *motion, const char *faces, const char *format, ...)
{
    char text[2048];
    va_list arguments;
    motion_scene(motion, faces, text, sizeof text);
    va_start(arguments, format);
    struct sample sample = load_scene(text, format, arguments);
    va_end(arguments);
    if (motion->constants.rho == 0.0) {
        motion->constants = solver_material_constants(sample.scene->E, sample.scene->nu, sample.scene->rho);
    }
    if (!scene_lua_protect(sample.scene->lua, motion_replace, motion, &sample.error)) {
        printf("\n    %s", sample.error.text);
        CU_FAIL_FATAL("the scene does not take the motion");
    }
    (void)solver_run_create(sample.scene, &sample.run, &sample.error);
    return sample;
}

/* Largest differences between what the run shows and the motion; fields that the scheme does not have count as 0. */
struct motion_errors {
    double v;       /* over the p-wave's speed */
    double u;       /* over the block's edge */
    double F, H, J; /* as they are */
    double P;       /* over rho cp^2 */
};

static inline double motion_worse(const struct motion_errors *errors)
{
    const double all[] = {errors->v, errors->u, errors->F, errors->H, errors->J, errors->P};
    double worst = 0.0;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        worst = isnan(all[i]) || all[i] > worst ? all[i] : worst;
    }
    return worst;
}

static inline struct motion_errors motion_judge(struct sample *sample, const struct motion *motion)
{
    struct solver_output output = output_of(sample);
    struct motion_errors errors = {0};
    size_t dim = motion->dim;
    double F[9], H[9], J, P[9], x[3], v[3];
    motion->gradient(motion, output.time, 0, F);
    measures_of(motion->material->linear, dim, F, H, &J);
    motion_stress(motion, output.time, P);
    for (size_t a = 0; a < output.cloud->count; a++) {
        const double *X = output.cloud->X + a * dim;
        motion_place(motion, X, output.time, 0, x);
        motion_place(motion, X, output.time, 1, v);
        for (size_t i = 0; i < dim; i++) {
            x[i] -= X[i];
        }
        errors.u = fmax(errors.u, largest_difference(dim, output.u + a * dim, x));
        errors.v = fmax(errors.v, largest_difference(dim, output.v + a * dim, v));
        if (output.F != NULL) {
            errors.F = fmax(errors.F, largest_difference(dim * dim, output.F + a * dim * dim, F));
            errors.H = fmax(errors.H, largest_difference(dim * dim, output.H + a * dim * dim, H));
            errors.P = fmax(errors.P, largest_difference(dim * dim, output.P + a * dim * dim, P));
            errors.J = fmax(errors.J, fabs(output.J[a] - J));
        }
    }
    errors.v /= motion->constants.cp;
    errors.P /= motion->constants.rho * motion->constants.cp * motion->constants.cp;
    return errors;
}

#endif
