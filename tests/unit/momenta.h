/* What the tests of free flight share: momenta and their drift. */
#ifndef TESTS_MOMENTA_H
#define TESTS_MOMENTA_H

#include "solver/stencil.h"
#include "tests/unit/runs.h"

struct momenta {
    long double linear[3], angular[3];
    double linear_size, angular_size; /* sums of magnitudes */
};

static inline struct momenta momenta_of(const struct solver_output *output)
{
    struct momenta sum = {.linear_size = 0.0};
    size_t dim = (size_t)output->cloud->dim;
    for (size_t a = 0; a < output->cloud->count; a++) {
        long double x[3] = {0}, p[3] = {0};
        for (size_t i = 0; i < dim; i++) {
            x[i] = (long double)output->cloud->X[a * dim + i] + (long double)output->u[a * dim + i];
            p[i] = (long double)output->V[a] * (long double)output->p[a * dim + i];
            sum.linear[i] += p[i];
            sum.linear_size += (double)fabsl(p[i]);
        }
        for (size_t i = 0; i < 3; i++) {
            size_t j = (i + 1) % 3, k = (i + 2) % 3;
            sum.angular[i] += x[j] * p[k] - x[k] * p[j];
            sum.angular_size += (double)(fabsl(x[j] * p[k]) + fabsl(x[k] * p[j]));
        }
    }
    return sum;
}

struct drift {
    double linear, angular; /* largest change, relative to what there is */
};

static inline struct drift drift_between(const struct momenta *before, const struct momenta *after)
{
    struct drift drift = {.linear = 0.0};
    for (int i = 0; i < 3; i++) {
        drift.linear = fmax(drift.linear, (double)fabsl(after->linear[i] - before->linear[i]) / before->linear_size);
        drift.angular =
            fmax(drift.angular, before->angular_size > 0.0
                                    ? (double)fabsl(after->angular[i] - before->angular[i]) / before->angular_size
                                    : 0.0);
    }
    return drift;
}

/* The fewest spacings that the stencil takes, as a scene says them. */
static inline int fewest(const struct solver_stencil_builder *builder, size_t dim)
{
    int n = 4;
    for (bool built = false; !built && n < 32; n++) {
        struct solver_error error;
        struct solver_cloud *cloud = NULL;
        struct solver_stencil *stencil = NULL;
        struct solver_box box = {.dim = (int)dim, .spacing = 1.0 / n, .upper = {1, 1, 1}};
        CU_ASSERT_FATAL(solver_cloud_box(&box, &cloud, &error));
        built = solver_stencil_create(builder, cloud, dim == 1 ? 3.0 : 2.1, &stencil, &error);
        solver_stencil_free(stencil);
        solver_cloud_free(cloud);
        if (built) {
            break;
        }
    }
    return n;
}

#endif
