/* Stencils of small lattices, rows sorted by axis and shared, for tests. */
#ifndef TESTS_UNIT_LATTICES_H
#define TESTS_UNIT_LATTICES_H

#include "solver/stencil.h"
#include "tests/unit/clouds.h"
#include "tests/unit/unit.h"

struct made {
    struct solver_cloud *cloud;
    struct solver_stencil *stencil;
};

static inline struct made make(const char *name, int dim, int edge)
{
    struct solver_box box = clouds_box(dim, edge, 0.0, 3);
    struct made made = {.cloud = clouds_make(&box)};
    struct solver_error error;
    CU_ASSERT_PTR_NOT_NULL_FATAL(made.cloud);
    CU_ASSERT_FATAL(solver_stencil_create(solver_stencil_find(name), made.cloud, 2.1, &made.stencil, &error) &&
                    solver_stencil_align(made.stencil, made.cloud, &error) &&
                    solver_stencil_share(made.stencil, &error));
    return made;
}

static inline void let_go(struct made *made)
{
    solver_stencil_free(made->stencil);
    solver_cloud_free(made->cloud);
}

#endif
