#include "verify/manufactured.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOTIONS = 8, MATERIALS = 16, NAME = 96, SUMMARY = 192, QUADRATURE = 16 };

static const struct verify_manufactured_body *body_of(const struct oracle *oracle)
{
    return (const struct verify_manufactured_body *)oracle;
}

void verify_manufactured_measures(const struct verify_manufactured_body *body, const double F[9],
                                  struct verify_measures *measures)
{
    int dim = body->of.dim;
    double H[9];
    measures->J = oracle_measures(!body->material->linear, F, H);
    for (int i = 0; i < dim; i++) {
        for (int I = 0; I < dim; I++) {
            measures->F[i * dim + I] = F[3 * i + I];
            measures->H[i * dim + I] = H[3 * i + I];
        }
    }
}

static void state(const struct oracle *oracle, const double X[3], double t, struct oracle_state *out)
{
    const struct verify_manufactured_body *body = body_of(oracle);
    int dim = body->of.dim;
    struct oracle_kinematics at;
    struct verify_measures measures;
    double P[9];
    oracle_motion_at(body->of.motion, &body->shape, dim, X, t, &at);
    verify_manufactured_measures(body, at.F, &measures);
    double normal;
    verify_manufactured_stress(body, &measures, P, &normal);
    memcpy(out->u, at.u, sizeof out->u);
    memcpy(out->v, at.v, sizeof out->v);
    memcpy(out->F, at.F, sizeof out->F);
    for (int i = 0; i < 3; i++) {
        out->p[i] = body->constants.rho * at.v[i];
        for (int I = 0; I < 3; I++) {
            out->P[3 * i + I] = i < dim && I < dim ? P[i * dim + I] : i == I ? normal : 0;
        }
    }
}

/* Whether bodies of the kind may flow: plastic flow along a fixed direction has a solution in closed form. */
static bool flows(const struct verify_manufactured *of)
{
    return of->motion->proportional && of->model->in[of->dim - 1]->flow != NULL;
}

static void body_force(const struct oracle *oracle, const double X[3], double t, double value[ORACLE_EXTRAS])
{
    const struct verify_manufactured_body *body = body_of(oracle);
    int dim = body->of.dim;
    struct oracle_kinematics at;
    struct verify_measures measures;
    double divergence[3];
    oracle_motion_at(body->of.motion, &body->shape, dim, X, t, &at);
    verify_manufactured_measures(body, at.F, &measures);
    verify_manufactured_divergence(body, &measures, at.dF, divergence);
    for (int i = 0; i < dim; i++) {
        value[VERIFY_BODY_FORCE_EXTRA + i] = body->constants.rho * at.a[i] - divergence[i];
    }
    if (flows(&body->of)) {
        value[VERIFY_BODY_FORCE_EXTRA + dim] =
            verify_manufactured_plastic_strain(body, verify_manufactured_strain(body, &measures));
    }
}

static double outside(const struct oracle *oracle, const double X[3])
{
    const struct verify_manufactured_body *body = body_of(oracle);
    double square = 0;
    for (int i = 0; i < body->of.dim; i++) {
        double beyond = fmax(fmax(-X[i], X[i] - body->shape.L), 0);
        square += beyond * beyond;
    }
    return sqrt(square);
}

void verify_manufactured_energies(const struct oracle *oracle, double t, double *kinetic, double *strain,
                                  double *plastic)
{
    const struct verify_manufactured_body *body = body_of(oracle);
    int dim = body->of.dim;
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(QUADRATURE);
    size_t points = 1;
    *kinetic = *strain = *plastic = rule != NULL ? 0 : NAN;
    for (int i = 0; i < dim; i++) {
        points *= QUADRATURE;
    }
    for (size_t point = 0; rule != NULL && point < points; point++) {
        struct oracle_kinematics at;
        struct verify_measures measures;
        double X[3] = {0}, weight = 1, flown;
        size_t rest = point;
        for (int i = 0; i < dim; i++, rest /= QUADRATURE) {
            double w;
            gsl_integration_glfixed_point(0, body->shape.L, rest % QUADRATURE, &X[i], &w, rule);
            weight *= w;
        }
        oracle_motion_at(body->of.motion, &body->shape, dim, X, t, &at);
        verify_manufactured_measures(body, at.F, &measures);
        double square = at.v[0] * at.v[0] + at.v[1] * at.v[1] + at.v[2] * at.v[2];
        *kinetic += weight * 0.5 * body->constants.rho * square;
        *strain += weight * verify_manufactured_energy(body, &measures, &flown);
        *plastic += weight * flown;
    }
    gsl_integration_glfixed_table_free(rule);
}

static void energy(const struct oracle *oracle, double t, double *kinetic, double *strain)
{
    double plastic;
    verify_manufactured_energies(oracle, t, kinetic, strain, &plastic);
}

static void destroy(struct oracle *oracle)
{
    free(oracle);
}

static bool create(const struct oracle_kind *kind, const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    const struct verify_manufactured *of = kind->about;
    struct verify_manufactured_body *body = calloc(1, sizeof *body);
    if (body == NULL) {
        (void)snprintf(why, ORACLE_WHY, "no memory for a manufactured solution");
        return false;
    }
    *body = (struct verify_manufactured_body){
        .of = *of,
        .material = of->model->in[of->dim - 1],
        .shape = {.L = value[0], .period = value[1], .amplitude = value[2]},
        .constants = solver_material_constants(value[3], value[4], value[5]),
        .yield = flows(of) ? value[6] : 0,
        .hardening = flows(of) ? value[7] : 0,
    };
    if (value[4] == 0.5 && !of->motion->isochoric) {
        (void)snprintf(why, ORACLE_WHY,
                       "material.nu: an incompressible body needs a motion that keeps every volume; "
                       "take manufactured-isochoric, or nu < 0.5");
        free(body);
        return false;
    }
    if (value[4] == 0.5) { /* J is 1: any bulk modulus gives the stress without pressure, which the body force is of */
        body->constants.kappa = body->constants.mu;
        body->constants.lambda = body->constants.mu / 3;
    }
    *oracle = (struct oracle *)body;
    return true;
}

/* --- the kinds: one per motion, material and dimension --- */

struct entry {
    struct verify_manufactured about;
    struct oracle_kind kind;
    struct oracle_parameter parameter[9];
    struct oracle_extra extra[5];
    char name[NAME], summary[SUMMARY];
};

static const struct oracle_extra forces[3] = {{"body_force_x", "N/m^3", "body force per reference volume"},
                                              {"body_force_y", "N/m^3", "body force per reference volume"},
                                              {"body_force_z", "N/m^3", "body force per reference volume"}};
static const struct oracle_extra plastic_strain = {"plastic_strain", "-", "equivalent plastic strain"};

static void describe(struct entry *entry)
{
    const struct oracle_motion *motion = entry->about.motion;
    const struct solver_material_model *model = entry->about.model;
    int dim = entry->about.dim;
    (void)snprintf(entry->name, NAME, "manufactured-%s-%s-%dd", motion->name, model->name, dim);
    (void)snprintf(entry->summary, SUMMARY, "manufactured: %s; %s", motion->summary, model->summary);
    const struct oracle_parameter parameter[] = {
        {"L", "m", "edge of the body, half a wave of the motion", 0, INFINITY, true, true, 1},
        {"period", "s", "period of the motion", 0, INFINITY, true, true, 1},
        {"amplitude", "-", motion->amplitude, 0, motion->most, true, false, motion->typical},
        {"material.E", "Pa", "Young's modulus", 0, INFINITY, true, true, 1},
        {"material.nu", "-", "Poisson's ratio; 0.5 where the motion keeps volumes", -1, 0.5, true, false, 0.3},
        {"material.rho", "kg/m^3", "density", 0, INFINITY, true, true, 1},
        {"material.yield_stress", "Pa", "yield stress; 0: the body is elastic", 0, INFINITY, false, true, 0.02},
        {"material.hardening", "Pa", "rise of the yield stress per plastic strain", 0, INFINITY, false, true, 0.5},
        {.name = NULL},
    };
    memcpy(entry->parameter, parameter, sizeof parameter);
    memcpy(entry->extra, forces, (size_t)dim * sizeof *forces);
    if (flows(&entry->about)) {
        entry->extra[dim] = plastic_strain;
    } else {
        entry->parameter[6] = (struct oracle_parameter){.name = NULL};
    }
    entry->kind = (struct oracle_kind){
        .name = entry->name,
        .summary = entry->summary,
        .source = "manufactured: a motion by formula, the body force by the material's tangent (verify/manufactured.h)",
        .dim = dim,
        .smoothness = ORACLE_SMOOTH,
        .finite_strain = !model->in[dim - 1]->linear,
        .parameter = entry->parameter,
        .extra = entry->extra,
        .create_as = create,
        .about = &entry->about,
        .destroy = destroy,
        .state = state,
        .extras = body_force,
        .outside = outside,
        .energy = energy,
        .check = verify_manufactured_check,
    };
}

static struct entry *entry_of(size_t motion, size_t model, int dim)
{
    static struct entry entries[MOTIONS][MATERIALS][3];
    struct entry *entry = &entries[motion][model][dim - 1];
    if (entry->kind.name == NULL) {
        entry->about = (struct verify_manufactured){&oracle_motions()[motion], &solver_material_models()[model], dim};
        describe(entry);
    }
    return entry;
}

static bool is_named(const struct entry *entry, const char *name, const char *material, int dim)
{
    char shortened[NAME];
    (void)snprintf(shortened, NAME, "manufactured-%s", entry->about.motion->name);
    if (material == NULL) {
        return strcmp(name, entry->name) == 0;
    }
    return strcmp(name, shortened) == 0 && strcmp(material, entry->about.model->name) == 0 && dim == entry->about.dim;
}

const struct oracle_kind *verify_manufactured_find(const char *name, const char *material, int dim)
{
    for (size_t i = 0; i < MOTIONS && oracle_motions()[i].name != NULL; i++) {
        for (size_t j = 0; j < MATERIALS && solver_material_models()[j].name != NULL; j++) {
            for (int d = oracle_motions()[i].least_dim; d <= 3; d++) {
                struct entry *entry = entry_of(i, j, d);
                if (is_named(entry, name, material, dim)) {
                    return &entry->kind;
                }
            }
        }
    }
    return NULL;
}

const struct oracle_kind *verify_kind_find(const char *name)
{
    const struct oracle_kind *kind = oracle_find(name);
    return kind != NULL ? kind : verify_manufactured_find(name, NULL, 0);
}

int verify_plastic_strain_extra(const struct oracle_kind *kind)
{
    const struct verify_manufactured *about = kind->about;
    return verify_is_manufactured(kind) && flows(about) ? VERIFY_BODY_FORCE_EXTRA + about->dim : -1;
}

bool verify_is_manufactured(const struct oracle_kind *kind)
{
    return kind->create_as == create;
}

void verify_body_force(const struct oracle_kind *kind, const struct oracle *oracle, const double X[3], double t,
                       double force[3])
{
    double value[ORACLE_EXTRAS] = {0};
    if (verify_is_manufactured(kind)) {
        kind->extras(oracle, X, t, value);
    }
    memcpy(force, value + VERIFY_BODY_FORCE_EXTRA, 3 * sizeof *force);
}
