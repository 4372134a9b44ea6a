#include "solver/material.h"

#include <math.h>
#include <string.h>

#define IN_EVERY_DIMENSION(material)                                                                                   \
    {                                                                                                                  \
        &material##_1d, &material##_2d, &material##_3d                                                                 \
    }
#define DECLARE(material) extern const struct solver_material material##_1d, material##_2d, material##_3d

DECLARE(solver_linear_elastic);
DECLARE(solver_neo_hookean);
DECLARE(solver_neo_hookean_polyconvex);
DECLARE(solver_hencky);

static const struct solver_material_model models[] = {
    {"linear-elastic", "Hooke's law, small strain", IN_EVERY_DIMENSION(solver_linear_elastic)},
    {"neo-hookean", "neo-Hookean, det F in the isochoric energy, J in the volumetric",
     IN_EVERY_DIMENSION(solver_neo_hookean)},
    {"neo-hookean-polyconvex", "neo-Hookean, the evolved J in both energies: polyconvex",
     IN_EVERY_DIMENSION(solver_neo_hookean_polyconvex)},
    {"hencky", "Hencky's: quadratic in logarithmic strains; with material.yield_stress it flows plastically",
     IN_EVERY_DIMENSION(solver_hencky)},
    {NULL, NULL, {NULL}},
};

const struct solver_material_model *solver_material_models(void)
{
    return models;
}

const struct solver_material_model *solver_material_find(const char *name)
{
    for (const struct solver_material_model *model = models; model->name != NULL; model++) {
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
