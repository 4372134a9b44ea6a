/* Motions x = F(t) X + t drift of the unit block, with the body force rho F'' X, the velocities and the tractions
 * P(F(t)) N that belong to them, for every material of the table. */
#ifndef TESTS_MOTIONS_H
#define TESTS_MOTIONS_H

#include "tests/unit/random_tensors.h"
#include "tests/unit/runs.h"

struct motion {
    size_t dim;
    const char *faces; /* letters of motion_scene */
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

/* A tensor of [dim][dim] or a vector in 3D, as scenes are told. */
static inline void motion_start_at(const void *context, const double X[3], double u[3], double v[3], double F[9])
{
    const struct motion *motion = context;
    double in_plane[9];
    motion->gradient(motion, 0.0, 0, in_plane);
    motion_place(motion, X, 0.0, 0, u);
    motion_place(motion, X, 0.0, 1, v);
    for (size_t i = 0; i < motion->dim; i++) {
        u[i] -= X[i];
        for (size_t j = 0; j < motion->dim; j++) {
            F[3 * i + j] = in_plane[i * motion->dim + j];
        }
    }
}

/* Body force; velocity of faces that are led; traction of those that are loaded, all of P N on rollers too. */
static inline void motion_drive(const void *context, enum solver_formula formula, const double X[3], double t,
                                double value[3])
{
    const struct motion *motion = context;
    size_t face = (size_t)(formula - SOLVER_FACE_X0) % SOLVER_FACES;
    bool loaded = formula >= SOLVER_FACE_X0 && (formula > SOLVER_FACE_Z1 || motion->faces[face] == 'T');
    double P[9];
    if (loaded) {
        motion_stress(motion, t, P);
        for (size_t i = 0; i < motion->dim; i++) {
            value[i] = (face % 2 == 0 ? -1.0 : 1.0) * P[i * motion->dim + face / 2];
        }
        return;
    }
    motion_place(motion, X, t, formula == SOLVER_BODY_FORCE ? 2 : 1, value);
    for (size_t i = 0; i < motion->dim && formula == SOLVER_BODY_FORCE; i++) {
        value[i] *= motion->constants.rho;
    }
}

/* `faces`: a letter for each of X0, X1, Y0, ...: Free, Symmetric, sKew-symmetric, Clamped, Traction, Motion, Roller. */
static inline void motion_scene(const struct motion *motion, char *out, size_t room)
{
    static const char letters[] = "FSKCTMR";
    static const char *const kinds[] = {"free",     "symmetric", "skew-symmetric", "clamped",
                                        "traction", "motion",    "roller"};
    size_t used = (size_t)snprintf(out, room, "initial = { from = 'oracle' }\nloads = { from = 'oracle' }\nfaces = {");
    for (size_t face = 0; face < 2 * motion->dim; face++) {
        const char *letter = strchr(letters, motion->faces[face]);
        CU_ASSERT_FATAL(letter != NULL && *letter != '\0');
        used += (size_t)snprintf(out + used, room - used, " %c%zu = '%s',", "XYZ"[face / 2], face % 2,
                                 kinds[letter - letters]);
    }
    used += (size_t)snprintf(out + used, room - used, " }\n");
    CU_ASSERT_FATAL(used < room);
}

/* A run that sets out on the motion, which must outlive it; on failure run is NULL. */
static inline struct sample motion_try(struct motion *motion, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
static inline struct sample motion_try(struct motion *motion, const char *format, ...)
{
    char text[1024];
    va_list arguments;
    motion_scene(motion, text, sizeof text);
    va_start(arguments, format);
    struct sample sample = load_scene(text, format, arguments);
    va_end(arguments);
    if (motion->constants.rho == 0.0) {
        motion->constants = solver_material_constants(sample.scene->E, sample.scene->nu, sample.scene->rho);
    }
    solver_scene_start_from(sample.scene, motion_start_at, motion);
    solver_scene_drive_from(sample.scene, motion_drive, motion, NULL);
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
        keep_larger(&worst, all[i]);
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
        keep_larger(&errors.u, largest_difference(dim, output.u + a * dim, x));
        keep_larger(&errors.v, largest_difference(dim, output.v + a * dim, v));
        if (output.F != NULL) {
            keep_larger(&errors.F, largest_difference(dim * dim, output.F + a * dim * dim, F));
            keep_larger(&errors.H, largest_difference(dim * dim, output.H + a * dim * dim, H));
            keep_larger(&errors.P, largest_difference(dim * dim, output.P + a * dim * dim, P));
            keep_larger(&errors.J, fabs(output.J[a] - J));
        }
    }
    errors.v /= motion->constants.cp;
    errors.P /= motion->constants.rho * motion->constants.cp * motion->constants.cp;
    return errors;
}

#endif
