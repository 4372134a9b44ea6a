/* What the tests of updated-Lagrangian SPH share: a block whose state a test sets, field by field, and the rates that
 * the scheme makes of it. */
#ifndef TESTS_ULSPH_STATES_H
#define TESTS_ULSPH_STATES_H

#include "solver/run_internal.h"
#include "tests/unit/random_tensors.h"
#include "tests/unit/runs.h"

static const char ulsph_material[] = "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2 }\n"
                                     "scheme, support = 'ulsph', 2.4\n";

/* Two materials that meet at X = 0.5. */
static const char ulsph_halves[] = "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2,\n"
                                   "    at = function(X) if X < 0.5 then return 3, 0.3, 2 end return 40, 0.1, 7 end }\n"
                                   "scheme, support = 'ulsph', 2.4\n";

/* A field of the state by its name in the scheme's table; value is NULL where the scene's terms need no such field. */
struct ulsph_field {
    size_t width;
    double *value, *rate;
};

static inline struct ulsph_field ulsph_field(const struct sample *sample, const char *name)
{
    const struct solver_state *state = &sample->run->state;
    for (size_t i = 0; i < state->field_count; i++) {
        const struct solver_field *field = &state->field[i];
        if (strcmp(field->name, name) == 0) {
            return (struct ulsph_field){field->width, *field->value, field->evolved ? *field->rate : NULL};
        }
    }
    return (struct ulsph_field){.value = NULL};
}

static inline size_t ulsph_dim(const struct sample *sample)
{
    return (size_t)sample->run->cloud->dim;
}

static inline double ulsph_mass(const struct sample *sample, size_t a)
{
    return sample->run->cloud->V[a] * solver_run_density(sample->run, a);
}

/* Entry (i, j) of particle a's tensor, stored by padded columns. */
static inline double *ulsph_entry(const struct sample *sample, double *tensors, size_t a, size_t i, size_t j)
{
    return tensors + (a * ulsph_dim(sample) + j) * sample->run->state.lanes + i;
}

/* Every particle, those on faces too, is moved by up to `shift` spacings along each axis from F X, row by row (NULL:
 * X). */
static inline void ulsph_place(const struct sample *sample, const double *F, double shift)
{
    const struct solver_cloud *cloud = sample->run->cloud;
    size_t dim = ulsph_dim(sample);
    double unit[9];
    unit_tensor(dim, unit);
    for (size_t a = 0; a < cloud->count; a++) {
        for (size_t i = 0; i < dim; i++) {
            double *x = &sample->run->state.x[a * sample->run->state.lanes + i];
            *x = uniform(-shift, shift) * cloud->spacing;
            for (size_t j = 0; j < dim; j++) {
                *x += (F != NULL ? F : unit)[i * dim + j] * cloud->X[a * dim + j];
            }
        }
    }
}

/* v = G x + c, row by row. */
static inline void ulsph_move(const struct sample *sample, const double *G, const double *c)
{
    size_t dim = ulsph_dim(sample);
    size_t lanes = sample->run->state.lanes;
    for (size_t a = 0; a < sample->run->cloud->count; a++) {
        for (size_t i = 0; i < dim; i++) {
            double *v = &sample->run->state.v[a * lanes + i];
            *v = c[i];
            for (size_t j = 0; j < dim; j++) {
                *v += G[i * dim + j] * sample->run->state.x[a * lanes + j];
            }
        }
    }
}

static inline void ulsph_move_randomly(const struct sample *sample, double speed)
{
    for (size_t a = 0; a < sample->run->cloud->count; a++) {
        for (size_t i = 0; i < ulsph_dim(sample); i++) {
            sample->run->state.v[a * sample->run->state.lanes + i] = uniform(-speed, speed);
        }
    }
}

/* Densities within `part` of those at rest, and symmetric S with entries of up to `stress` [Pa]. */
static inline void ulsph_strain(const struct sample *sample, double part, double stress)
{
    size_t dim = ulsph_dim(sample);
    double *rho = ulsph_field(sample, "rho").value;
    double *S = ulsph_field(sample, "S").value;
    for (size_t a = 0; a < sample->run->cloud->count; a++) {
        rho[a] = solver_run_density(sample->run, a) * (1.0 + uniform(-part, part));
        for (size_t i = 0; i < dim; i++) {
            for (size_t j = 0; j <= i; j++) {
                double value = uniform(-stress, stress);
                *ulsph_entry(sample, S, a, i, j) = value;
                *ulsph_entry(sample, S, a, j, i) = value;
            }
        }
    }
}

/* Places, velocities, densities and stresses at random: nothing is smooth, nothing cancels by symmetry. */
static inline void ulsph_scatter(const struct sample *sample)
{
    ulsph_place(sample, NULL, 0.2);
    ulsph_move_randomly(sample, 1.0);
    ulsph_strain(sample, 0.1, 0.5);
}

/* Makes the evolved state of one block that of another of the same particles. */
static inline void ulsph_copy(const struct sample *from, const struct sample *to)
{
    CU_ASSERT_EQUAL_FATAL(from->run->state.evolved, to->run->state.evolved);
    memcpy(to->run->state.U, from->run->state.U, from->run->state.evolved * sizeof(double));
}

/* The rates of the state as it is. */
static inline void ulsph_evaluate(struct sample *sample)
{
    solver_run_refresh(sample->run);
    bool ok = solver_scheme_evaluate(sample->run->scheme, sample->run->system, sample->run->cloud->count, 0.0, 0.0,
                                     &sample->error);
    if (!ok) {
        printf("\n    %s", sample->error.text);
    }
    CU_ASSERT_FATAL(ok);
}

#endif
