/* Updated-Lagrangian SPH: density diffusion (001_363f711843f01da4.txt eq. 32 to 35) moves mass from here to there
 * within one material, and leaves a linear field alone. */
#include "tests/unit/ulsph_states.h"

static const char *const blocks[] = {"dim=1 n=12", "dim=2 n=6", "dim=3 n=4"};

enum { TRIALS = 10 };

/* One state with and without diffusion: rates of density that it adds, [count]. */
struct twins {
    struct sample with, without;
    double added[256], size;
};

static void start_twins(struct twins *twins, const char *material, const char *terms)
{
    twins->with = start(material, "%s ulsph.delta=0.1", terms);
    twins->without = start(material, "%s ulsph.delta=0", terms);
    CU_ASSERT_FATAL(twins->with.run->cloud->count <= sizeof twins->added / sizeof *twins->added);
}

static void compare(struct twins *twins)
{
    ulsph_copy(&twins->with, &twins->without);
    ulsph_evaluate(&twins->with);
    ulsph_evaluate(&twins->without);
    twins->size = 0.0;
    for (size_t a = 0; a < twins->with.run->cloud->count; a++) {
        twins->added[a] = ulsph_field(&twins->with, "rho").rate[a] - ulsph_field(&twins->without, "rho").rate[a];
        twins->size = fmax(twins->size, fabs(twins->added[a]));
    }
}

static void finish_twins(struct twins *twins)
{
    finish(&twins->with);
    finish(&twins->without);
}

/* Sum of V rho_rate over the particles of one of two materials. */
static double gained(const struct twins *twins, bool heavy)
{
    const double *rho = ulsph_field(&twins->with, "rho").value;
    double sum = 0.0;
    for (size_t a = 0; a < twins->with.run->cloud->count; a++) {
        if ((solver_run_density(twins->with.run, a) > 5.0) == heavy) {
            sum += ulsph_mass(&twins->with, a) / rho[a] * twins->added[a];
        }
    }
    return sum;
}

static void test_conservation(void)
{
    static const char *const materials[] = {ulsph_material, ulsph_halves};
    for (size_t i = 0; i < 6; i++) {
        struct twins twins;
        start_twins(&twins, materials[i % 2], blocks[i / 2]);
        for (int trial = 0; trial < TRIALS; trial++) {
            ulsph_scatter(&twins.with);
            compare(&twins);
            CU_ASSERT(twins.size > 0.01);
            expect_below("gain of the lighter material", fabs(gained(&twins, false)) / twins.size, 1e-14);
            expect_below("gain of the heavier material", fabs(gained(&twins, true)) / twins.size, 1e-14);
        }
        finish_twins(&twins);
    }
}

/* Each material at a density of its own, the same throughout: nothing flows, however far the two are apart. Materials
 * that differ in their shear modulus alone are two as well, since their pressures need not meet. */
static void test_phases(void)
{
    static const char shear[] = "material = { model = 'linear-elastic', E = 3, nu = 0, rho = 2,\n"
                                "    at = function(X) if X < 0.5 then return 3, 0, 2 end return 1.5, 0.25, 2 end }\n"
                                "scheme, support = 'ulsph', 2.4\n";
    static const char *const materials[] = {ulsph_halves, shear};
    for (size_t i = 0; i < 6; i++) {
        struct twins twins;
        start_twins(&twins, materials[i % 2], blocks[i / 2]);
        const struct solver_material_constants *constants = twins.with.run->constants;
        double *rho = ulsph_field(&twins.with, "rho").value;
        size_t stiffer = 0;
        ulsph_scatter(&twins.with);
        for (size_t a = 0; a < twins.with.run->cloud->count; a++) {
            rho[a] = constants[a].rho * (constants[a].mu > 1.3 ? 1.2 : 0.9);
            stiffer += constants[a].mu > 1.3;
        }
        compare(&twins);
        CU_ASSERT(stiffer > 0 && stiffer < twins.with.run->cloud->count);
        CU_ASSERT_EQUAL(twins.size, 0.0);
        finish_twins(&twins);
    }
}

static void test_linear_density(void)
{
    for (size_t dim = 1; dim <= 3; dim++) {
        struct twins twins;
        start_twins(&twins, ulsph_material, blocks[dim - 1]);
        struct ulsph_field rho = ulsph_field(&twins.with, "rho");
        struct ulsph_field x = ulsph_field(&twins.with, "x");
        for (int trial = 0; trial < TRIALS; trial++) {
            double N[3];
            ulsph_scatter(&twins.with);
            compare(&twins);
            double random = twins.size;
            random_direction(dim, N);
            for (size_t a = 0; a < twins.with.run->cloud->count; a++) {
                rho.value[a] = 2.0;
                for (size_t i = 0; i < dim; i++) {
                    rho.value[a] += 0.3 * N[i] * x.value[a * x.width + i];
                }
            }
            compare(&twins);
            expect_below("diffusion of a linear density", twins.size / random, 1e-12);
        }
        finish_twins(&twins);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"mass of each material", test_conservation},
        {"nothing crosses between materials", test_phases},
        {"a linear density", test_linear_density},
    };
    return unit_main("ulsph diffusion", tests, sizeof tests / sizeof *tests);
}
