/* Rows of pair vectors that are kept once: where they are, and that no number of a run depends on it. The linker puts
 * the function __wrap_ in front of the solver's (tests/share.cmake). */
#include "solver/stencil.h"
#include "tests/unit/clouds.h"
#include "tests/unit/runs.h"

static bool apart; /* rows stay as they are */

// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
bool __real_solver_stencil_share(struct solver_stencil *stencil, struct solver_error *error);
bool __wrap_solver_stencil_share(struct solver_stencil *stencil, struct solver_error *error);

bool __wrap_solver_stencil_share(struct solver_stencil *stencil, struct solver_error *error)
{
    return apart || __real_solver_stencil_share(stencil, error);
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

static struct solver_stencil *make(const char *name, int dim, int edge, double perturb)
{
    struct solver_box box = clouds_box(dim, edge, perturb, 3);
    struct solver_cloud *cloud = clouds_make(&box);
    struct solver_stencil *stencil = NULL;
    struct solver_error error;
    CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
    CU_ASSERT_FATAL(solver_stencil_create(solver_stencil_find(name), cloud, 2.1, &stencil, &error));
    solver_cloud_free(cloud);
    return stencil;
}

static void share(struct solver_stencil *stencil)
{
    struct solver_error error;
    CU_ASSERT_FATAL(__real_solver_stencil_share(stencil, &error));
}

/* Each pair still has its numbers, and there are few records. */
static void expect_shared(const char *name, int dim, int edge)
{
    struct solver_stencil *all = make(name, dim, edge, 0.0);
    struct solver_stencil *once = make(name, dim, edge, 0.0);
    size_t bytes = ((size_t)dim + 1) * sizeof(double);
    size_t wrong = 0;
    share(once);
    CU_ASSERT_PTR_NOT_NULL_FATAL(once->shared);
    CU_ASSERT_EQUAL(once->pairs, all->pairs);
    CU_ASSERT(once->records <= all->pairs / 4);
    CU_ASSERT(solver_stencil_bytes(once) < solver_stencil_bytes(all));
    for (size_t a = 0; a < all->count; a++) {
        size_t shift = solver_stencil_shift(once, a);
        for (size_t ab = all->graph.row[a]; ab < all->graph.row[a + 1]; ab++) {
            wrong += memcmp(solver_stencil_C(all, ab), solver_stencil_C(once, ab + shift), bytes) != 0 ? 1 : 0;
        }
    }
    CU_ASSERT_EQUAL(wrong, 0);
    solver_stencil_free(all);
    solver_stencil_free(once);
}

static void test_lattice(void)
{
    expect_shared("sbp2", 1, 40);
    expect_shared("sbp2", 2, 20);
    expect_shared("sbp2", 3, 9);
    expect_shared("sbp4", 1, 80);
    expect_shared("sbp4", 2, 80);
    expect_shared("sbp4", 3, 30); /* thousands: some meet in a slot of the table */
}

/* Where rows hardly repeat nothing is kept for it, and pairs stay where they are. */
static void expect_apart(const char *name, int dim, int edge, double perturb)
{
    struct solver_stencil *stencil = make(name, dim, edge, perturb);
    const double *pair = stencil->pair;
    size_t bytes = solver_stencil_bytes(stencil);
    share(stencil);
    CU_ASSERT_PTR_NULL(stencil->shared);
    CU_ASSERT_PTR_EQUAL(stencil->pair, pair);
    CU_ASSERT_EQUAL(stencil->records, stencil->pairs);
    CU_ASSERT_EQUAL(solver_stencil_bytes(stencil), bytes);
    CU_ASSERT_EQUAL(solver_stencil_shift(stencil, stencil->count - 1), 0);
    solver_stencil_free(stencil);
}

static void test_cloud(void)
{
    expect_apart("closed", 2, 20, 0.2);
    expect_apart("closed", 3, 6, 0.2);
    expect_apart("sph", 3, 6, 0.2);
    expect_apart("sph", 3, 27, 0.2); /* more different rows than are looked for */
    expect_apart("sbp2", 3, 2, 0.0); /* a lattice that is all edges */
}

/* Every loop that reads pair vectors, by overrides of a scene. */
static const char *const loops[] = {
    "dim=3 n=8 evolved=pF",
    "dim=3 n=8 evolved=pFHJ precision=mixed",
    "dim=3 n=8 evolved=pFJ material.model=linear-elastic",
    "dim=2 n=12 evolved=pFHJ volume_flux=stress",
    "dim=2 n=40 evolved=pFJ stencil=sbp4",
    "dim=2 n=12 evolved=pF reconstruction=least-squares",
    "dim=1 n=40 evolved=pFJ reconstruction=none precision=mixed",
    "dim=2 n=12 evolved=pFHJ scheme=jst jst.kappa2=0.5 jst.kappa4=0.1",
    "dim=2 n=12 evolved=pFJ material.nu=0.5 incompressible.solver=poisson",
    "dim=2 n=12 evolved=pFHJ material.nu=0.49 incompressible.solver=pseudo-time",
};

static struct sample run_with(bool kept_apart, const char *more, const char *settings)
{
    apart = kept_apart;
    struct sample sample = start(more, "%s", settings);
    advance(&sample, 3);
    return sample;
}

static void expect_same(const char *more, const char *settings)
{
    struct sample shared = run_with(false, more, settings);
    struct sample plain = run_with(true, more, settings);
    double one = solver_run_facts(shared.run).bytes_per_particle;
    double all = solver_run_facts(plain.run).bytes_per_particle;
    bool same = are_same(&shared, &plain);
    if (!same || one >= all) {
        printf("\n    %s: %s, %.1f of %.1f bytes per particle", settings, same ? "the same" : "not the same", one, all);
    }
    CU_ASSERT(same);
    CU_ASSERT(one < all);
    finish(&shared);
    finish(&plain);
}

static void test_runs(void)
{
    for (size_t i = 0; i < sizeof loops / sizeof *loops; i++) {
        expect_same(smooth_motion, loops[i]);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"a lattice keeps equal rows once", test_lattice},
        {"other clouds keep all of theirs", test_cloud},
        {"runs give the same bits", test_runs},
    };
    return unit_main("solver: shared rows of stencils", tests, sizeof tests / sizeof *tests);
}
