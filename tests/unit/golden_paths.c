/* Every path of the hot loops (solver/path.h) that this processor knows gives the same answer: avx2 and avx512 the same
 * bits, baseline to within the bounds of golden records. */
#include "solver/peak.h"
#include "tests/unit/paths.h"

static const double small = 1e-3; /* a strain as golden records have it */

static bool same_bits(const struct solver_record *left, const struct solver_record *right)
{
    bool same = left->count == right->count && left->field_count == right->field_count && left->step == right->step &&
                left->history_count == right->history_count;
    for (size_t f = 0; same && f < left->field_count; f++) {
        size_t size = left->count * (size_t)left->field[f].width * sizeof(double);
        same = memcmp(left->field[f].value, right->field[f].value, size) == 0;
    }
    return same && memcmp(left->history, right->history,
                          left->history_count * left->history_columns * sizeof *left->history) == 0;
}

static const char *const linear[] = {
    "dim=3 stencil=closed evolved=pFHJ perturb=0.1 material.model=linear-elastic",
    "dim=3 stencil=sbp2 evolved=pF material.model=linear-elastic",
    "dim=2 n=9 stencil=sbp4 evolved=pFJ integrator=rk4 material.model=linear-elastic",
    "dim=2 n=9 stencil=sph evolved=pFHJ material.model=linear-elastic",
    "dim=1 n=40 stencil=sbp4 evolved=pFHJ material.model=linear-elastic",
    "dim=2 n=9 scheme=jst stencil=sbp2 evolved=pFHJ material.model=linear-elastic",
    "dim=3 scheme=ulsph material.model=linear-elastic",
};

static const char *const nonlinear[] = {
    "dim=3 stencil=closed evolved=pFHJ perturb=0.1",
    "dim=2 n=9 stencil=sbp2 evolved=pFJ reconstruction=least-squares",
    "dim=2 n=9 stencil=sbp2 evolved=pFHJ volume_flux=stress integrator=rk4",
    "dim=3 stencil=sbp2 evolved=pF material.model=hencky material.yield_stress=1e-3 material.hardening=0.1",
    "dim=3 stencil=closed evolved=pFHJ perturb=0.1 precision=single",
    "dim=2 n=9 stencil=sbp4 evolved=pFJ precision=single integrator=rk4",
};

static void test_same_bits(void)
{
    if (SOLVER_PATHS < 3 || !solver_path_runs(2)) {
        printf("\n    only one of the paths avx2 and avx512 runs here");
        return;
    }
    for (size_t i = 0; i < sizeof linear / sizeof *linear + sizeof nonlinear / sizeof *nonlinear; i++) {
        size_t count = sizeof linear / sizeof *linear;
        const char *settings = i < count ? linear[i] : nonlinear[i - count];
        struct solver_record *avx2 = run_on(1, small, settings);
        struct solver_record *avx512 = run_on(2, small, settings);
        if (!same_bits(avx2, avx512)) {
            printf("\n    avx2 and avx512 differ: %s", settings);
        }
        CU_ASSERT(same_bits(avx2, avx512));
        avx512->field[0].value[0] += 1.0;
        CU_ASSERT_FALSE(same_bits(avx2, avx512));
        solver_record_free(avx2);
        solver_record_free(avx512);
    }
}

static void test_baseline(void)
{
    for (size_t i = 0; i < sizeof linear / sizeof *linear; i++) {
        struct solver_record *baseline = run_on(0, small, linear[i]);
        for (int path = 1; path < SOLVER_PATHS && solver_path_runs(path); path++) {
            struct solver_record *other = run_on(path, small, linear[i]);
            double share = share_of_bounds(baseline, other);
            if (share > 1.0) {
                printf("\n    %s is out of bounds, %.3g: %s", solver_path_name(path), share, linear[i]);
            }
            CU_ASSERT(share <= 1.0);
            solver_record_free(other);
        }
        solver_record_free(baseline);
    }
}

/* The paths differ by the width of their vectors: asking for one gives it. */
static void test_widths(void)
{
    for (int path = 0; SOLVER_PATHS == 3 && path < SOLVER_PATHS; path++) {
        solver_path_use(path);
        CU_ASSERT_EQUAL(solver_path(), path);
        CU_ASSERT_EQUAL(solver_peak()->lanes, 2 << path);
    }
}

/* Names in order, of the paths that were built, and of no other. */
static void test_names(void)
{
    for (int path = 0; path < SOLVER_PATHS; path++) {
        CU_ASSERT_PTR_NOT_NULL(solver_path_name(path));
    }
    CU_ASSERT_STRING_EQUAL(solver_path_name(0), "baseline");
    CU_ASSERT(solver_path_runs(0));
    CU_ASSERT_PTR_NULL(solver_path_name(SOLVER_PATHS));
    CU_ASSERT_PTR_NULL(solver_path_name(-1));
    CU_ASSERT_FALSE(solver_path_runs(SOLVER_PATHS));
}

static void test_environment(void)
{
    struct solver_error error = {.text = ""};
    CU_ASSERT_EQUAL(setenv("ASSAY_ISA", "avx1024", 1), 0);
    CU_ASSERT_FALSE(solver_path_check(&error));
    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "avx1024"));
    CU_ASSERT_EQUAL(setenv("ASSAY_ISA", "baseline", 1), 0);
    CU_ASSERT(solver_path_check(&error));
    CU_ASSERT_EQUAL(setenv("ASSAY_ISA", "", 1), 0);
    CU_ASSERT(solver_path_check(&error));
    CU_ASSERT_EQUAL(unsetenv("ASSAY_ISA"), 0);
    CU_ASSERT(solver_path_check(&error));
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"names of paths", test_names},
        {"the environment", test_environment},
        {"widths of vectors", test_widths},
        {"avx2 and avx512 give the same bits", test_same_bits},
        {"baseline is within the bounds of golden records", test_baseline},
    };
    return unit_main("paths", tests, sizeof tests / sizeof *tests);
}
