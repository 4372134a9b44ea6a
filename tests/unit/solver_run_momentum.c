/* Free flight, over the tables: a free body that deforms keeps its linear momentum to round-off, whatever the stencil,
 * since pair forces are equal and opposite. What becomes of its angular momentum is said here, and promised of
 * angular_momentum = "projected" alone: solver_run_angular.c. */
#include "tests/unit/momenta.h"

#include "solver/scheme.h"

static const double kept = 1e-12;
enum { STEPS = 1000 };

static struct drift fly(const char *settings)
{
    struct sample sample = start(smooth_motion, "%s", settings);
    struct solver_output output = output_of(&sample);
    struct momenta before = momenta_of(&output);
    advance(&sample, STEPS);
    output = output_of(&sample);
    struct momenta after = momenta_of(&output);
    struct drift drift = drift_between(&before, &after);
    finish(&sample);
    return drift;
}

/* All of a scheme on one kind of cloud; evolved sets and materials in turn. Stencils of fourth order take the
 * integrator of that order: with two stages at this CFL number they are unstable, whatever the material, and the energy
 * of such a body is ten times what it was after 300 steps. */
static void fly_with(const struct solver_scheme *scheme, const struct solver_stencil_builder *builder, size_t dim,
                     bool perturbed)
{
    static const char *const evolved[] = {"pF", "pFJ", "pFHJ"};
    static size_t next = 0;
    const struct solver_material_model *models = solver_material_models();
    size_t materials = 0, turn = next++;
    char settings[256];
    while (models[materials].name != NULL) {
        materials++;
    }
    const char *material = scheme->deformation ? models[turn / 3 % materials].name : "linear-elastic";
    (void)snprintf(
        settings, sizeof settings,
        "dim=%zu scheme=%s stencil=%s n=%d support=%g perturb=%g evolved=%s material.model=%s reconstruction=%s "
        "integrator=%s %s",
        dim, scheme->name, builder->name, fewest(builder, dim), dim == 1 ? 3.0 : 2.1, perturbed ? 0.15 : 0.0,
        evolved[turn % 3], material, turn % 4 == 3 ? "least-squares" : "stencil",
        builder->boundary >= 2 ? "rk4" : "tvd-rk2", scheme->claims.momentum);
    struct drift drift = fly(settings);
    printf("\n    linear %.1e, angular %.1e  %s", drift.linear, drift.angular, settings);
    expect_below(settings, drift.linear, kept);
}

static void fly_all(size_t dim)
{
    size_t claims = 0;
    for (const struct solver_scheme *const *scheme = solver_schemes(); *scheme != NULL; scheme++) {
        const struct solver_stencil_builder *builder = solver_stencil_builders();
        for (; (*scheme)->claims.momentum != NULL && builder->name != NULL; builder++) {
            fly_with(*scheme, builder, dim, false);
            if (!builder->lattice_only) {
                fly_with(*scheme, builder, dim, true);
            }
            claims++;
            if (!(*scheme)->stencil) {
                break; /* it stands on none: once is enough */
            }
        }
    }
    CU_ASSERT(claims >= 5);
}

static void test_1d(void)
{
    fly_all(1);
}

static void test_2d(void)
{
    fly_all(2);
}

static void test_3d(void)
{
    fly_all(3);
}

/* Without an override that the claim stands under, momentum is not kept. */
static void test_needed(void)
{
    for (const struct solver_scheme *const *scheme = solver_schemes(); *scheme != NULL; scheme++) {
        char needs[128], settings[256];
        const char *claim = (*scheme)->claims.momentum;
        for (size_t word = 0; claim != NULL && without_word(claim, word, needs, sizeof needs); word++) {
            (void)snprintf(settings, sizeof settings,
                           "dim=2 scheme=%s n=10 support=2.1 perturb=0.15 material.model=linear-elastic %s",
                           (*scheme)->name, needs);
            struct drift drift = fly(settings);
            printf("\n    %s: linear %.1e with \"%s\" instead of \"%s\"", (*scheme)->name, drift.linear, needs, claim);
            CU_ASSERT(drift.linear > 1e4 * kept);
        }
    }
}

/* The measure sees a force, however small. */
static void test_measure_sees(void)
{
    struct sample sample = start("body_force = function() return first(1e-9, 0, 0) end\n", "dim=3");
    advance(&sample, 10);
    struct solver_output output = output_of(&sample);
    struct momenta sum = momenta_of(&output);
    double impulse = 1e-9 * output.time; /* force on the unit block, times time */
    CU_ASSERT_DOUBLE_EQUAL((double)sum.linear[0] / impulse, 1.0, 1e-12);
    CU_ASSERT_DOUBLE_EQUAL(sum.linear_size / impulse, 1.0, 1e-12);
    finish(&sample);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"linear momentum over 1000 steps, 1D", test_1d},      {"linear momentum over 1000 steps, 2D", test_2d},
        {"linear momentum over 1000 steps, 3D", test_3d},      {"what a claim needs is needed", test_needed},
        {"the measure sees a small force", test_measure_sees},
    };
    return unit_main("momentum", tests, sizeof tests / sizeof *tests);
}
