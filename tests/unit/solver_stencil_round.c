/* Stencils on discs, balls and cylinders: what the closed one keeps there, and who needs a lattice. */
#include "tests/unit/round_shapes.h"
#include "tests/unit/stencil_properties.h"
#include "tests/unit/unit.h"

#include <string.h>

/* The closed stencil meets its constraints to round-off: closure, so that a constant stress with its tractions gives no
 * force anywhere, and linear exactness up to the surface; and so gradient and divergence are adjoint. */
static void closed(void)
{
    static const int n_of[SHAPES][3] = {{4, 8, 16}, {3, 4, 6}, {4}};
    const struct solver_stencil_builder *builder = solver_stencil_find("closed");
    for (int s = 0; s < SHAPES; s++) {
        for (int level = 0; level < 3 && n_of[s][level] > 0; level++) {
            int n = n_of[s][level];
            double widest = n <= 4 || s == 0 ? 2.1 : 1.6; /* the rest takes seconds */
            for (double support = 1.6; support <= widest; support += 0.5) {
                struct solver_cloud *cloud = round_cloud(&shapes[s], n);
                struct solver_stencil *stencil = NULL;
                struct solver_error error;
                struct stencil_properties found = {.antisymmetry = 0.0};
                CU_ASSERT_FATAL(solver_stencil_create(builder, cloud, support, &stencil, &error));
                struct solver_stencil_residuals residuals = solver_stencil_check(stencil, cloud);
                double *area = properties_areas(stencil);
                properties_pairs(stencil, area, &found);
                properties_identities(stencil, area, &found);
                (void)printf("\n    shape %d, n %2d, support %.1f: antisymmetry %.1e closure %.1e linear %.1e stress "
                             "%.1e parts %.1e adjoint %.1e",
                             s, n, support, found.antisymmetry, found.closure, residuals.linear, found.stress,
                             found.parts, found.adjoint);
                CU_ASSERT(found.antisymmetry == 0.0 && found.closure <= 1e-11 && residuals.linear <= 1e-11);
                CU_ASSERT(found.stress <= 1e-11 && found.parts <= 1e-11 && found.adjoint <= 1e-14);
                free(area);
                solver_stencil_free(stencil);
                solver_cloud_free(cloud);
            }
        }
    }
}

/* What the closed stencil needs: areas a thousandth too large or volumes a thousandth too small cannot be met, and are
 * refused. */
static void incompatible(void)
{
    struct solver_error error;
    for (int s = 0; s < SHAPES; s++) {
        for (int spoil = 0; spoil < 2; spoil++) {
            struct solver_cloud *cloud = round_cloud(&shapes[s], 4);
            struct solver_stencil *stencil = NULL;
            for (size_t i = 0; spoil == 0 && i < 3 * cloud->face_point_count; i++) {
                cloud->face_point[i / 3].area[i % 3] *= 1.001;
            }
            for (size_t a = 0; spoil == 1 && a < cloud->count; a++) {
                cloud->V[a] *= 0.999;
            }
            CU_ASSERT_FALSE(solver_stencil_create(solver_stencil_find("closed"), cloud, 2.0, &stencil, &error));
            CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "no solution of closure and linear exactness was found"));
            solver_cloud_free(cloud);
        }
    }
}

/* Builders that need a lattice say so; the others take any round body. */
static void builders(void)
{
    for (const struct solver_stencil_builder *builder = solver_stencil_builders(); builder->name; builder++) {
        for (int s = 0; s < SHAPES; s++) {
            struct solver_cloud *cloud = round_cloud(&shapes[s], 4);
            struct solver_stencil *stencil = NULL;
            struct solver_error error = {.code = SOLVER_OK};
            bool made = solver_stencil_create(builder, cloud, 2.0, &stencil, &error);
            CU_ASSERT_EQUAL(made, !builder->lattice_only);
            CU_ASSERT(made || (error.code == SOLVER_BAD_INPUT && strstr(error.text, builder->name) != NULL &&
                               strstr(error.text, "a body of another shape has none; expected closed") != NULL));
            solver_stencil_free(stencil);
            solver_cloud_free(cloud);
        }
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"closed stencil", closed},
        {"incompatible moments", incompatible},
        {"builders", builders},
    };
    return unit_main("solver stencils on round clouds", tests, sizeof tests / sizeof *tests);
}
