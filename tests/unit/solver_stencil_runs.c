/* Particles that are abreast: which they are, and that no number of a run depends on it. The linker puts the function
 * __wrap_ in front of the solver's (tests/share.cmake). */
#include "solver/path.h"
#include "tests/unit/lattices.h"
#include "tests/unit/runs.h"

enum finding { FOUND, NONE, WRONG }; /* those that are, none, or a particle more in each */

static enum finding runs;

// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
bool __real_solver_stencil_find_runs(struct solver_stencil *stencil, struct solver_error *error);
bool __wrap_solver_stencil_find_runs(struct solver_stencil *stencil, struct solver_error *error);

bool __wrap_solver_stencil_find_runs(struct solver_stencil *stencil, struct solver_error *error)
{
    bool done = runs == NONE || __real_solver_stencil_find_runs(stencil, error);
    for (size_t a = 0; runs == WRONG && a + 1 < stencil->count; a++) {
        bool last = stencil->abreast[a] == 1 && a > 0 && stencil->abreast[a - 1] > 2;
        bool inside = stencil->abreast[a] > 1 && stencil->abreast[a] < UINT8_MAX;
        stencil->abreast[a] = (uint8_t)(stencil->abreast[a] + (last || inside ? 1 : 0));
    }
    return done;
}

/* None, which would take their particles from these loops. */
bool __wrap_solver_stencil_find_ranks(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                                      struct solver_error *error);

bool __wrap_solver_stencil_find_ranks(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                                      struct solver_error *error)
{
    (void)stencil;
    (void)cloud;
    (void)error;
    return true;
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

static void find(struct made *made)
{
    struct solver_error error;
    CU_ASSERT_FATAL(__real_solver_stencil_find_runs(made->stencil, &error));
}

/* Whether particle b has what loops take from particle a in its place. */
static bool stands_for(const struct solver_stencil *stencil, size_t a, size_t b)
{
    const struct solver_graph *graph = &stencil->graph;
    size_t dim = (size_t)stencil->dim;
    size_t lanes = dim == 3 ? 4 : dim;
    size_t length = graph->row[a + 1] - graph->row[a];
    bool same = graph->row[b + 1] - graph->row[b] == length && stencil->V[a] == stencil->V[b];
    for (size_t i = 0; i < dim; i++) {
        same = same && stencil->row_sum[a * dim + i] == stencil->row_sum[b * dim + i] &&
               stencil->along[a * lanes + i] == stencil->along[b * lanes + i];
    }
    for (size_t k = 0; same && k < length; k++) {
        const double *of_a = solver_stencil_C(stencil, graph->row[a] + k + solver_stencil_shift(stencil, a));
        const double *of_b = solver_stencil_C(stencil, graph->row[b] + k + solver_stencil_shift(stencil, b));
        same = graph->neighbour[graph->row[b] + k] - graph->neighbour[graph->row[a] + k] == b - a &&
               memcmp(of_a, of_b, (dim + 1) * sizeof(double)) == 0;
    }
    return same;
}

/* Each run is one, and goes as far as it can; `longest` is known. */
static void expect_runs(const char *name, int dim, int edge, size_t longest)
{
    struct made made = make(name, dim, edge);
    const struct solver_stencil *stencil = made.stencil;
    size_t found = 0;
    size_t wrong = 0;
    find(&made);
    CU_ASSERT_PTR_NOT_NULL_FATAL(stencil->abreast);
    for (size_t a = 0; a < stencil->count; a++) {
        size_t run = stencil->abreast[a];
        found = run > found ? run : found;
        wrong += run == 0 || a + run > stencil->count;
        for (size_t b = a + 1; b < a + run; b++) {
            wrong += !stands_for(stencil, a, b);
        }
        wrong += run < UINT8_MAX && a + run < stencil->count && stands_for(stencil, a, a + run);
    }
    CU_ASSERT_EQUAL(wrong, 0);
    if (found != longest) {
        printf("\n    %s in %dD, %d cells: the longest run has %zu particles", name, dim, edge, found);
    }
    CU_ASSERT_EQUAL(found, longest);
    let_go(&made);
}

static void test_lattice(void)
{
    expect_runs("sbp2", 1, 40, 39);
    expect_runs("sbp2", 1, 400, UINT8_MAX);
    expect_runs("sbp2", 2, 20, 19);
    expect_runs("sbp2", 3, 9, 8);
    expect_runs("sbp4", 1, 80, 69);
    expect_runs("sbp4", 2, 80, 69);
}

/* One volume, one sum, one neighbour that is another ends a run. */
static void test_ends(void)
{
    enum { AT = 30 }; /* in the middle of the second row of 21 */
    for (int broken = 0; broken < 3; broken++) {
        struct made made = make("sbp2", 2, 20);
        struct solver_stencil *stencil = made.stencil;
        if (broken == 0) {
            stencil->V[AT] = nextafter(stencil->V[AT], INFINITY);
        } else if (broken == 1) {
            stencil->row_sum[2 * AT + 1] = 1e-300;
        } else {
            stencil->graph.neighbour[stencil->graph.row[AT + 1] - 1]++;
        }
        find(&made);
        CU_ASSERT_EQUAL(stencil->abreast[AT - 2], 2);
        CU_ASSERT_EQUAL(stencil->abreast[AT], 1);
        CU_ASSERT(stencil->abreast[AT + 1] > 5);
        let_go(&made);
    }
}

/* Where rows are not sorted or not shared nobody looks. */
static void test_others(void)
{
    struct made made = make("closed", 2, 12);
    CU_ASSERT_PTR_NULL(made.stencil->along);
    size_t bytes = solver_stencil_bytes(made.stencil);
    find(&made);
    CU_ASSERT_PTR_NULL(made.stencil->abreast);
    CU_ASSERT_EQUAL(solver_stencil_bytes(made.stencil), bytes);
    let_go(&made);
}

/* Every loop over particles abreast, by overrides of a scene; rows no multiple of a register's width. */
static const char *const loops[] = {
    "dim=3 n=8 evolved=pF",
    "dim=3 n=8 evolved=pFHJ precision=mixed",
    "dim=3 n=8 evolved=pFJ material.model=linear-elastic",
    "dim=3 n=8 evolved=pFHJ precision=single",
    "dim=3 n=8 evolved=pF material.model=linear-elastic precision=single",
    "dim=3 n=16 evolved=pFJ stencil=sbp4",
    "dim=2 n=12 evolved=pF",
    "dim=2 n=13 evolved=pFJ",
    "dim=2 n=14 evolved=pFHJ precision=mixed",
    "dim=2 n=15 evolved=pFHJ material.model=hencky",
    "dim=2 n=12 evolved=pF material.model=linear-elastic",
    "dim=2 n=21 evolved=pFJ material.model=linear-elastic precision=mixed",
    "dim=2 n=40 evolved=pFHJ stencil=sbp4",
    "dim=2 n=21 evolved=pFHJ reconstruction=none",
    "dim=2 n=21 evolved=pFJ precision=single",
    "dim=2 n=40 evolved=pF precision=single stencil=sbp4",
    "dim=2 n=21 evolved=pF balance=true",
    "dim=2 n=21 evolved=pFHJ balance=true integrator=rk4",
    "dim=2 n=21 evolved=pFHJ grading.X=4",
    "dim=2 n=21 evolved=pFHJ volume_flux=stress",
    "dim=2 n=21 evolved=pFJ material.nu=0.5 incompressible.solver=poisson",
    "dim=1 n=70 evolved=pFHJ",
    "dim=1 n=70 evolved=pFJ stencil=sbp4 precision=single",
};

static struct sample run_with(enum finding which, int path, const char *more, const char *settings)
{
    runs = which;
    solver_path_use(path);
    struct sample sample = start(more, "%s", settings);
    advance(&sample, 3);
    return sample;
}

/* Apart and abreast on each path; those with fused multiply-adds also among each other. */
static void expect_same(const char *more, const char *settings)
{
    int before = solver_path();
    struct sample first = {.run = NULL};
    for (int path = 0; path < SOLVER_PATHS && solver_path_runs(path); path++) {
        struct sample apart = run_with(NONE, path, more, settings);
        struct sample abreast = run_with(FOUND, path, more, settings);
        bool same = are_same(&apart, &abreast) && (path < 2 || are_same(&first, &abreast));
        if (!same) {
            printf("\n    %s, path %s: not the same", settings, solver_path_name(path));
        }
        CU_ASSERT(same);
        finish(&apart);
        finish(&first);
        first = abreast;
    }
    finish(&first);
    solver_path_use(before);
    runs = FOUND;
}

static void test_runs(void)
{
    static const char composite[] =
        "initial = { velocity = function(X, Y, Z) return first(0.05 * sin(2 * X), 0.04 * cos(3 * Y), 0) end }\n"
        "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2,\n"
        "             at = function(X) return 3, 0.3, X < 0.5 and 2 or 3 end }\n";
    for (size_t i = 0; i < sizeof loops / sizeof *loops; i++) {
        expect_same(smooth_motion, loops[i]);
    }
    expect_same(composite, "dim=2 n=32 evolved=pF");
    expect_same(composite, "dim=2 n=32 evolved=pFHJ");
}

/* That the comparison can see: the end of a row of particles taken for one more of its inside. */
static void test_wrong(void)
{
    static const char *const settings[] = {"dim=2 n=21 evolved=pF", "dim=3 n=9 evolved=pFJ precision=single"};
    int before = solver_path();
    int widest = SOLVER_PATHS - 1;
    while (!solver_path_runs(widest)) {
        widest--;
    }
    for (size_t i = 0; widest > 0 && i < sizeof settings / sizeof *settings; i++) {
        struct sample right = run_with(FOUND, widest, smooth_motion, settings[i]);
        struct sample wrong = run_with(WRONG, widest, smooth_motion, settings[i]);
        CU_ASSERT(!are_same(&right, &wrong));
        finish(&right);
        finish(&wrong);
    }
    solver_path_use(before);
    runs = FOUND;
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"the rows of a lattice are abreast", test_lattice},
        {"what is not alike ends a run", test_ends},
        {"other stencils have none", test_others},
        {"runs give the same bits", test_runs},
        {"a wrong run is seen", test_wrong},
    };
    return unit_main("solver: particles abreast", tests, sizeof tests / sizeof *tests);
}
