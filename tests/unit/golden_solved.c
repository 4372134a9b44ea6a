/* Pair vectors of `closed` are solved for, and paths (solver/path.h) leave other remainders of the solution: over a
 * family of bodies they stay within the bounds of golden records (golden/tolerance.c), which see a tenth digit. */
#include "tests/unit/paths.h"

enum { SEEDS = 20, SETS = 6 };

static const char *const sets[SETS] = {
    "evolved=pF reconstruction=least-squares",   "evolved=pF reconstruction=stencil",
    "evolved=pFJ reconstruction=least-squares",  "evolved=pFJ reconstruction=stencil",
    "evolved=pFHJ reconstruction=least-squares", "evolved=pFHJ reconstruction=stencil",
};

static const double small = 1e-3; /* a strain as golden records have it */

/* Particles moved by 2, 10 or 40 %, or by seed 0 the lattice. Those with slopes of the stencil are moved by 10 % at
 * most: further no scene is let have them. */
static void describe(char *settings, size_t room, int dim, int seed, int set)
{
    static const double moved[] = {0.02, 0.1, 0.4};
    double most = strstr(sets[set], "=stencil") != NULL ? 0.1 : 0.45;
    (void)snprintf(settings, room, "dim=%d n=%d stencil=closed seed=%d perturb=%g %s material.model=linear-elastic",
                   dim, dim == 2 ? 7 : 4, seed, seed == 0 ? 0.0 : fmin(most, moved[seed % 3]), sets[set]);
}

struct shares {
    double least, most;
    int runs;
};

static void add_share(struct shares *shares, const char *settings)
{
    struct solver_record *stored = run_on(0, small, settings);
    for (int path = 1; path < 2 && solver_path_runs(path); path++) { /* avx512 has the bits of avx2 (golden_paths.c) */
        struct solver_record *fresh = run_on(path, small, settings);
        double share = share_of_bounds(stored, fresh);
        if (share >= 1.0) {
            printf("\n    out of bounds, %.3g of them: %s", share, settings);
        }
        CU_ASSERT(share < 1.0);
        shares->least = fmin(shares->least, share);
        shares->most = fmax(shares->most, share);
        shares->runs++;
        solver_record_free(fresh);
    }
    solver_record_free(stored);
}

/* The bounds are for the worst, and a body may be far from them: of the last bits of F, which is near one, few differ
 * after so few steps. No family is. */
static void test_family(void)
{
    for (int dim = 2; dim <= 3; dim++) {
        struct shares lattices = {.least = 1.0}, clouds = {.least = 1.0};
        char settings[256];
        for (int set = 0; set < SETS; set++) {
            describe(settings, sizeof settings, dim, 0, set);
            add_share(&lattices, settings);
        }
        for (int seed = 1; seed <= SEEDS; seed++) {
            for (int slopes = 0; slopes < 2; slopes++) {
                describe(settings, sizeof settings, dim, seed, seed / 3 % 3 * 2 + slopes);
                add_share(&clouds, settings);
            }
        }
        printf("\n    %dD: %d lattices are apart by %.3f to %.3f of the bounds, %d clouds by %.3f to %.3f", dim,
               lattices.runs, lattices.least, lattices.most, clouds.runs, clouds.least, clouds.most);
        CU_ASSERT(clouds.runs == 0 || (lattices.most > 0.01 && clouds.most > 0.01));
    }
    printf("\n    ");
}

/* On one path: of the stiffness, of the density, and of the pair vectors by their support, which those of a lattice do
 * not depend on; but the same is the same. */
static void test_tenth_digit(void)
{
    static const char *const defects[] = {"", "material.E=3.0000000003", "material.rho=2.0000000002",
                                          "support=2.0000000002"};
    for (int dim = 2; dim <= 3; dim++) {
        for (int set = 0; set < SETS; set++) {
            char settings[256], changed[320];
            describe(settings, sizeof settings, dim, set + 1, set);
            struct solver_record *stored = run_on(0, small, settings);
            for (size_t d = 0; d < sizeof defects / sizeof *defects; d++) {
                (void)snprintf(changed, sizeof changed, "%s %s", settings, defects[d]);
                struct solver_record *fresh = run_on(0, small, changed);
                double share = share_of_bounds(stored, fresh);
                if ((share > 1.0) != (d > 0)) {
                    printf("\n    %.3g of the bounds: %s", share, changed);
                }
                CU_ASSERT_EQUAL(share > 1.0, d > 0);
                solver_record_free(fresh);
            }
            solver_record_free(stored);
        }
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"paths are within the bounds, and not by far", test_family},
        {"a tenth digit is seen", test_tenth_digit},
    };
    return unit_main("pair vectors that are solved for", tests, sizeof tests / sizeof *tests);
}
