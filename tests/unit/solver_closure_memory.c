/* Where there is no memory for the factor of a closed stencil, iterations make the stencil; where there is none for
 * them either, it is an error. The linker puts the function __wrap_ in front of the library's (tests/share.cmake). */
#include "solver/stencil.h"
#include "tests/unit/clouds.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static size_t refused_from = SIZE_MAX, refusals; /* requests of so many bytes get nothing */

// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
void *__real_aligned_alloc(size_t alignment, size_t bytes);
void *__wrap_aligned_alloc(size_t alignment, size_t bytes);

void *__wrap_aligned_alloc(size_t alignment, size_t bytes)
{
    if (bytes >= refused_from) {
        refusals++;
        return NULL;
    }
    return __real_aligned_alloc(alignment, bytes);
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

static bool build(const struct solver_cloud *cloud, size_t most, struct solver_stencil **out,
                  struct solver_error *error)
{
    refused_from = most;
    refusals = 0;
    bool ok = solver_stencil_create(solver_stencil_find("closed"), cloud, 2.0, out, error);
    refused_from = SIZE_MAX;
    return ok;
}

/* The same pair vectors but for what is left of the constraints, and for their part without energy. */
static void without_factor(void)
{
    struct solver_box box = clouds_box(2, 24, 0.15, 7);
    struct solver_cloud *cloud = clouds_make(&box);
    struct solver_stencil *whole = NULL, *iterated = NULL;
    struct solver_error error;
    CU_ASSERT_FATAL(build(cloud, SIZE_MAX, &whole, &error));
    CU_ASSERT_EQUAL(refusals, 0);
    /* pairs and multipliers take less for a particle, the factor more */
    CU_ASSERT_FATAL(build(cloud, 600 * cloud->count, &iterated, &error));
    CU_ASSERT(refusals > 0);
    double worst = 0.0;
    for (size_t i = 0; i < whole->pairs * 2; i++) {
        size_t ab = i / 2, k = i % 2;
        worst = fmax(worst, fabs(solver_stencil_C(whole, ab)[k] - solver_stencil_C(iterated, ab)[k]));
    }
    (void)printf("\n    %zu particles, %zu requests refused: pair vectors differ by %.1e of a face", cloud->count,
                 refusals, worst / cloud->spacing);
    CU_ASSERT(worst <= 1e-9 * cloud->spacing);
    solver_stencil_free(whole);
    solver_stencil_free(iterated);
    solver_cloud_free(cloud);
}

static void without_anything(void)
{
    struct solver_box box = clouds_box(2, 24, 0.15, 7);
    struct solver_cloud *cloud = clouds_make(&box);
    struct solver_stencil *stencil = NULL;
    struct solver_error error;
    CU_ASSERT_FALSE(build(cloud, 20 * cloud->count, &stencil, &error));
    CU_ASSERT(error.code == SOLVER_NO_MEMORY && strstr(error.text, "no memory") != NULL);
    CU_ASSERT_PTR_NULL(stencil);
    solver_cloud_free(cloud);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"iterations without memory for the factor", without_factor},
        {"an error without memory for those", without_anything},
    };
    return unit_main("solver closure memory", tests, sizeof tests / sizeof *tests);
}
