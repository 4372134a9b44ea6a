/* A slab between rollers is a bar: what depends on X alone in two dimensions is the one-dimensional solution. */
#include "tests/unit/runs.h"

/* Two materials that meet at X = 1, a pulse from the left end, which is let go after it. */
static const char bar[] =
    "material = { model = 'linear-elastic', E = 3, nu = 0, rho = 2,\n"
    "    at = function(X) if X < 1 then return 3, 0, 2 elseif X > 1 then return 40, 0, 7 end return 5.6, 0, 4.5 end }\n"
    "faces = { X0 = { kind = 'motion', value = function(X, Y, Z, t) return first(1e-3 * sin(10 * t), 0, 0) end,\n"
    "                 free_after = 0.314 },\n"
    "          Y0 = d == 2 and 'symmetric' or nil, Y1 = d == 2 and 'symmetric' or nil }\n";

/* Largest difference of the slab's axial stress from the bar's, relative to the largest of the bar's. */
static double difference(const struct solver_output *one, const struct solver_output *two)
{
    double most = 0.0;
    double size = 0.0;
    for (size_t a = 0; a < one->cloud->count; a++) {
        size = fmax(size, fabs(one->sigma[a]));
        size_t met = 0;
        for (size_t b = 0; b < two->cloud->count; b++) {
            if (fabs(one->cloud->X[a] - two->cloud->X[2 * b]) < 1e-9) {
                most = fmax(most, fabs(one->sigma[a] - two->sigma[4 * b]));
                met++;
            }
        }
        CU_ASSERT_FATAL(met == two->cloud->points[1]);
    }
    return most / size;
}

static double slab_against_bar(int n, const char *keys)
{
    struct sample line = start(bar, "dim=1 n=%d domain.upper={2} %s", n, keys);
    struct sample slab = start(bar, "dim=2 n=%d domain.upper={2,0.1875} %s", n, keys);
    CU_ASSERT_FATAL(solver_run_to(line.run, 1.2, NULL, NULL, &line.error));
    CU_ASSERT_FATAL(solver_run_to(slab.run, 1.2, NULL, NULL, &slab.error));
    struct solver_output one = output_of(&line);
    struct solver_output two = output_of(&slab);
    double result = difference(&one, &two);
    printf("\n    n = %d %s: %.2e", n, keys, result);
    finish(&line);
    finish(&slab);
    return result;
}

/* The same stencil along the lattice's lines: equal to round-off. */
static void test_total_lagrangian(void)
{
    CU_ASSERT(slab_against_bar(128, "evolved=pF stencil=sbp2") < 1e-11);
    CU_ASSERT(slab_against_bar(128, "evolved=pF stencil=sbp4 integrator=rk4 cfl=0.8") < 1e-10);
}

/* The kernel's sums over a plane are not those over a line: equal as the spacing goes to zero. The largest difference
 * falls unevenly, 0.058, 0.030, 0.018 and, at n = 512, 0.0066. */
static void test_updated_lagrangian(void)
{
    static const char keys[] = "scheme=ulsph support=2.4 cfl=0.4";
    double coarse = slab_against_bar(64, keys);
    double middle = slab_against_bar(128, keys);
    double fine = slab_against_bar(256, keys);
    CU_ASSERT(coarse < 0.08 && middle < 0.7 * coarse && fine < coarse / 3.0);
}

int main(void)
{
    static const struct unit_test tests[] = {{"a slab is a bar: total Lagrangian", test_total_lagrangian},
                                             {"a slab is a bar: updated Lagrangian", test_updated_lagrangian}};
    return unit_main("slab", tests, sizeof tests / sizeof *tests);
}
