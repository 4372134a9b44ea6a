#include "solver/material.h"

#include "solver/path.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

#define IN_EVERY_DIMENSION(material) SOLVER_LOOPS(material)
#define DECLARE(material)            SOLVER_DECLARE_LOOPS(struct solver_material, material)

DECLARE(solver_linear_elastic);
DECLARE(solver_neo_hookean);
DECLARE(solver_neo_hookean_polyconvex);
DECLARE(solver_hencky);

static const struct row {
    const char *name, *summary;
    const struct solver_material *on[SOLVER_PATHS][3];
} rows[] = {
    {"linear-elastic", "Hooke's law, small strain", IN_EVERY_DIMENSION(solver_linear_elastic)},
    {"neo-hookean", "neo-Hookean, det F in the isochoric energy, J in the volumetric",
     IN_EVERY_DIMENSION(solver_neo_hookean)},
    {"neo-hookean-polyconvex", "neo-Hookean, the evolved J in both energies: polyconvex",
     IN_EVERY_DIMENSION(solver_neo_hookean_polyconvex)},
    {"hencky", "Hencky's: quadratic in logarithmic strains; with material.yield_stress it flows plastically",
     IN_EVERY_DIMENSION(solver_hencky)},
    {.name = NULL},
};

/* The table of each path, made when first asked for. */
static struct solver_material_model models[SOLVER_PATHS][sizeof rows / sizeof *rows];
static pthread_once_t made = PTHREAD_ONCE_INIT;

static void make(void)
{
    for (int path = 0; path < SOLVER_PATHS; path++) {
        for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
            struct solver_material_model *model = &models[path][i];
            model->name = rows[i].name;
            model->summary = rows[i].summary;
            memcpy(model->in, rows[i].on[path], sizeof model->in);
        }
    }
}

const struct solver_material_model *solver_material_models(void)
{
    (void)pthread_once(&made, make);
    return models[solver_path()];
}

const struct solver_material_model *solver_material_find(const char *name)
{
    for (const struct solver_material_model *model = solver_material_models(); model->name != NULL; model++) {
        if (strcmp(model->name, name) == 0) {
            return model;
        }
    }
    return NULL;
}

struct solver_material_constants solver_material_constants(double E, double nu, double rho)
{
    struct solver_material_constants material = {
        .rho = rho,
        .mu = E / (2.0 * (1.0 + nu)),
        .lambda = nu < 0.5 ? E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)) : INFINITY,
        .kappa = nu < 0.5 ? E / (3.0 * (1.0 - 2.0 * nu)) : INFINITY,
    };
    material.cp = sqrt((material.kappa + 4.0 / 3.0 * material.mu) / rho);
    material.cs = sqrt(material.mu / rho);
    material.zp = rho * material.cp;
    material.zs = rho * material.cs;
    return material;
}
