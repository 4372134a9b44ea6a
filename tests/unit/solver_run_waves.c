/* Whether the sweeps of a step go as one wave or stage by stage, which is a matter of caches: the same bytes. */
#include "solver/memory.h"
#include "solver/run_internal.h"
#include "tests/unit/runs.h"

/* The evolved state after some steps, and how many sweeps the first wave of each had; the caller frees. */
static double *state_after(const char *settings, bool by_stages, size_t *count, int *sweeps)
{
    struct solver_error error;
    struct sample sample = start(smooth_motion, "dim=3 n=9 %s", settings); /* four pieces of particles */
    CU_ASSERT_FATAL(solver_run_make_waves(sample.run, by_stages, &error));
    *sweeps = solver_run_wave(sample.run, 0);
    CU_ASSERT_FATAL(solver_run_steps(sample.run, 4, &error));
    const struct solver_state *state = &sample.run->state;
    double *U = malloc(state->evolved * sizeof *U);
    CU_ASSERT_PTR_NOT_NULL_FATAL(U);
    memcpy(U, state->U, state->evolved * sizeof *U);
    *count = state->evolved;
    finish(&sample);
    return U;
}

static void test_stages(void)
{
    static const struct {
        const char *settings;
        int whole; /* sweeps of a step */
    } of[] = {
        {"threads=1", 2 * SOLVER_STAGE_SWEEPS},
        {"threads=3", 2 * SOLVER_STAGE_SWEEPS},
        {"threads=2 stencil=closed evolved=pF integrator=rk4", 4 * SOLVER_STAGE_SWEEPS},
    };
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        size_t count[2];
        int sweeps[2];
        double *one = state_after(of[i].settings, false, &count[0], &sweeps[0]);
        double *several = state_after(of[i].settings, true, &count[1], &sweeps[1]);
        CU_ASSERT_EQUAL(sweeps[0], of[i].whole);
        CU_ASSERT_EQUAL(sweeps[1], SOLVER_STAGE_SWEEPS);
        CU_ASSERT_EQUAL_FATAL(count[0], count[1]);
        CU_ASSERT(memcmp(one, several, count[0] * sizeof *one) == 0);
        free(one);
        free(several);
    }
}

/* By the caches' sizes, where the system tells them: a plane has 11^2 particles, and a step's sweeps eight planes. */
static void test_caches(void)
{
    struct sample sample = start(smooth_motion, "dim=3 n=10");
    struct solver_error error;
    double each = solver_run_facts(sample.run).bytes_per_particle;
    bool more = each * 121 * 8 > (double)solver_cache_bytes(2);
    bool fits = each * 1331 <= (double)solver_cache_bytes(3); /* 1 MB, which is within reach */
    CU_ASSERT_EQUAL(solver_run_parts_stages(sample.run), more && fits);
    CU_ASSERT_EQUAL(sample.run->by_stages, more && fits);
    CU_ASSERT(solver_run_steps(sample.run, 1, &error));
    finish(&sample);
}

/* Of bodies and windows. Whatever the system says of its last cache, a body beyond reach is not in it: one wave, unless
 * its window is not in it either. */
static void test_reach(void)
{
    double own = (double)solver_cache_bytes(2);
    double last = (double)solver_cache_bytes(3);
    double most = last < SOLVER_WITHIN_REACH ? last : SOLVER_WITHIN_REACH;
    bool told = last > 0.0;
    CU_ASSERT_EQUAL(solver_run_parts(most, own + 1.0, 2), told);
    CU_ASSERT_FALSE(solver_run_parts(most, own, 2));
    CU_ASSERT_FALSE(solver_run_parts(most + 1.0, most, 2));
    CU_ASSERT_EQUAL(solver_run_parts(most + 1.0, most + 1.0, 2), told);
    CU_ASSERT_FALSE(solver_run_parts(most + 1.0, 2.0 * most, 4));
    CU_ASSERT_EQUAL(solver_run_parts(most + 1.0, 2.0 * most + 1.0, 4), told);
    CU_ASSERT_FALSE(solver_run_parts(SOLVER_WITHIN_REACH + 1.0, most, 2));
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"one wave or a wave for each stage", test_stages},
        {"by the sizes of caches", test_caches},
        {"no more of a cache than is within reach", test_reach},
    };
    return unit_main("solver run waves", tests, sizeof tests / sizeof *tests);
}
