/* What the conformance suites of materials share: every material in every dimension for a range of constants. */
#ifndef TESTS_MATERIALS_H
#define TESTS_MATERIALS_H

#include "solver/material.h"
#include "tests/unit/random_tensors.h"
#include "tests/unit/unit.h"

#include <stdio.h>

enum { SAMPLES = 40 };

/* One material with one set of constants in one dimension. */
struct sample {
    const char *name;
    const struct solver_material *material, *in_3d;
    struct solver_material_constants constants;
    size_t dim;
    double modulus; /* [Pa] of the stresses that are zero or cancel */
};

/* Auxetic to nearly incompressible; units of size one are no special case. */
static const double ratios[] = {-0.9, -0.5, 0.0, 0.3, 0.45, 0.4999};

static inline void each(void (*check)(const struct sample *sample))
{
    for (const struct solver_material_model *model = solver_material_models(); model->name != NULL; model++) {
        for (size_t dim = 1; dim <= 3; dim++) {
            for (size_t i = 0; i < sizeof ratios / sizeof *ratios; i++) {
                struct sample sample = {.name = model->name,
                                        .material = model->in[dim - 1],
                                        .in_3d = model->in[2],
                                        .constants = solver_material_constants(17e6, ratios[i], 1100.0),
                                        .dim = dim};
                sample.modulus = sample.constants.mu + sample.constants.kappa;
                check(&sample);
            }
        }
    }
}

/* Counts an assertion and says which material, dimension and Poisson's ratio broke it. */
static inline void expect(const struct sample *sample, const char *what, double value, double bound)
{
    bool holds = value <= bound;
    if (!holds) {
        double nu = sample->constants.lambda / (2.0 * (sample->constants.lambda + sample->constants.mu));
        printf("\n    %s, %zud, nu = %g: %s: %.3e > %.1e", sample->name, sample->dim, nu, what, value, bound);
    }
    CU_ASSERT(holds);
}

/* The cofactor and Jacobian that belong to F: linearised where the material is. */
static inline void measures(const struct sample *sample, const double *F, double *H, double *J)
{
    measures_of(sample->material->linear, sample->dim, F, H, J);
}

static inline double energy(const struct sample *sample, const double *F)
{
    double H[9];
    double J;
    measures(sample, F, H, &J);
    return sample->material->energy(&sample->constants, F, H, J);
}

static inline void stress(const struct sample *sample, const double *F, double *P)
{
    double H[9];
    double J;
    measures(sample, F, H, &J);
    sample->material->stress(&sample->constants, F, H, J, P);
}

#endif
