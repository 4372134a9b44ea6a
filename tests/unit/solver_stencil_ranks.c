/* Ranks: which particles are in them, and that the loops that take each pair once agree with the others. The linker
 * puts the function __wrap_ in front of the solver's (tests/share.cmake). */
#include "solver/path.h"
#include "tests/unit/lattices.h"
#include "tests/unit/runs.h"

enum finding { FOUND, NONE, ALONG_WRONG, ACROSS_WRONG, END_WRONG }; /* one weight by a thousandth */

static enum finding ranks;

// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
bool __real_solver_stencil_find_ranks(struct solver_stencil *stencil, struct solver_error *error);
bool __wrap_solver_stencil_find_ranks(struct solver_stencil *stencil, struct solver_error *error);

bool __wrap_solver_stencil_find_ranks(struct solver_stencil *stencil, struct solver_error *error)
{
    bool done = ranks == NONE || __real_solver_stencil_find_ranks(stencil, error);
    size_t some = stencil->rank_count / 2;
    if (ranks == ALONG_WRONG) {
        stencil->rank[some].weight[0][SOLVER_RANK_INSIDE] *= 1.001;
    } else if (ranks == ACROSS_WRONG) {
        stencil->rank[some].weight[1][SOLVER_RANK_INSIDE] *= 1.001;
    } else if (ranks == END_WRONG) {
        stencil->rank[some].weight[1][SOLVER_RANK_LAST] *= 1.001;
    }
    return done;
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

static void find(struct made *made)
{
    struct solver_error error;
    CU_ASSERT_FATAL(__real_solver_stencil_find_ranks(made->stencil, &error));
}

/* Pairs of particle a that are not where a rank says, or weigh something else; `kind` of its place in it. */
static size_t wrong_pairs(const struct solver_stencil *stencil, const struct solver_rank *rank, size_t a, int kind)
{
    const struct solver_graph *graph = &stencil->graph;
    size_t expected =
        (size_t)(a > rank->begin) + (size_t)(a + 1 < rank->end) + (size_t)(rank->below > 0) + (size_t)(rank->above > 0);
    size_t wrong = graph->row[a + 1] - graph->row[a] != expected;
    for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
        size_t b = graph->neighbour[ab];
        bool beside = (b + 1 == a && a > rank->begin) || (b == a + 1 && b < rank->end);
        bool across = (rank->below > 0 && b + rank->below == a) || (rank->above > 0 && b == a + rank->above);
        int I = beside ? rank->axis : 1 - rank->axis;
        const double *C = solver_stencil_C(stencil, ab + solver_stencil_shift(stencil, a));
        double weight = 2.0 * stencil->V[a] * rank->weight[beside ? 0 : 1][kind];
        wrong += !beside && !across;
        wrong += fabs(C[2] - weight) > 1e-15 * weight || fabs((b > a ? C[I] : -C[I]) - weight) > 1e-15 * weight;
    }
    return wrong;
}

/* Every row of a lattice of sbp2 is one rank, unless it is too long. */
static void test_lattice(void)
{
    static const int edges[] = {4, 20, 21, SOLVER_RANK_MOST - 1};
    struct made longer = make("sbp2", 2, SOLVER_RANK_MOST);
    find(&longer);
    CU_ASSERT_EQUAL(longer.stencil->rank_count, 0);
    let_go(&longer);
    for (size_t i = 0; i < sizeof edges / sizeof *edges; i++) {
        struct made made = make("sbp2", 2, edges[i]);
        const struct solver_stencil *stencil = made.stencil;
        size_t edge = (size_t)edges[i] + 1;
        size_t wrong = 0;
        find(&made);
        CU_ASSERT_EQUAL_FATAL(stencil->rank_count * edge, stencil->count);
        for (size_t r = 0; r < stencil->rank_count; r++) {
            const struct solver_rank *rank = stencil->rank + r;
            wrong += rank->begin != r * edge || rank->end != (r + 1) * edge;
            wrong += rank->below != (r > 0 ? edge : 0) || rank->above != (r + 1 < stencil->rank_count ? edge : 0);
            for (size_t a = rank->begin; a < rank->end; a++) {
                wrong += wrong_pairs(stencil, rank, a,
                                     a == rank->begin    ? SOLVER_RANK_FIRST
                                     : a + 1 < rank->end ? SOLVER_RANK_INSIDE
                                                         : SOLVER_RANK_LAST);
            }
        }
        CU_ASSERT_EQUAL(wrong, 0);
        let_go(&made);
    }
}

/* One volume, one face measure, one neighbour that is another: its particle is in no rank with those beside it. */
static void test_ends(void)
{
    enum { EDGE = 21, AT = 10 * EDGE + 10 };
    for (int broken = 0; broken < 3; broken++) {
        struct made made = make("sbp2", 2, EDGE - 1);
        struct solver_stencil *stencil = made.stencil;
        size_t record = stencil->graph.row[AT] + solver_stencil_shift(stencil, AT);
        if (broken == 0) {
            stencil->V[AT] = nextafter(stencil->V[AT], INFINITY);
        } else if (broken == 1) { /* that of all particles inside, as rows are shared */
            solver_stencil_C(stencil, record)[2] *= 0.5;
        } else {
            stencil->graph.neighbour[stencil->graph.row[AT]]++;
        }
        find(&made);
        size_t with = 0;
        for (size_t r = 0; r < stencil->rank_count; r++) {
            with += stencil->rank[r].begin < AT && stencil->rank[r].end > AT + 1;
        }
        CU_ASSERT_EQUAL(with, 0);
        CU_ASSERT_EQUAL(stencil->rank_count > 0, broken != 1);
        let_go(&made);
    }
}

/* Where rows are not sorted, or have more pairs, there are none. */
static void test_others(void)
{
    static const char *const names[] = {"closed", "sbp4"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        struct made made = make(names[i], 2, 12);
        find(&made);
        CU_ASSERT_EQUAL(made.stencil->rank_count, 0);
        CU_ASSERT_PTR_NULL(made.stencil->rank);
        let_go(&made);
    }
}

/* All that the loops distinguish, by overrides of a scene; rows that pieces of work cut anywhere, the longest there
 * are, and no multiple of a register's width. */
static const char *const loops[] = {
    "n=12 evolved=pF",
    "n=35 evolved=pF material.model=hencky",
    "n=18 evolved=pF precision=mixed",
    "n=13 evolved=pFJ",
    "n=30 evolved=pFHJ",
    "n=17 evolved=pFHJ integrator=rk4",
    "n=127 evolved=pFJ",
    "n=15 evolved=pFHJ material.model=hencky",
    "n=16 evolved=pFJ material.model=neo-hookean-polyconvex",
    "n=12 evolved=pF material.model=linear-elastic",
    "n=21 evolved=pFJ material.model=linear-elastic",
    "n=22 evolved=pFHJ material.model=linear-elastic precision=mixed",
    "n=14 evolved=pFHJ precision=mixed",
    "n=21 evolved=pFHJ reconstruction=none",
    "n=21 evolved=pF reconstruction=none material.model=linear-elastic",
    "n=21 evolved=pFHJ grading.X=4",
    "n=21 evolved=pFHJ grading.Y=4",
    "n=40 evolved=pFHJ cfl=0.2",
    "n=20 evolved=pFJ threads=2",
};

/* Fast enough that pairs turn and are stretched by some percent. */
static const char motion[] = "initial = { velocity = function(X, Y)\n"
                             "    return 0.3 + 0.6 * sin(2 * X + Y + 0.3), 0.2 - 0.5 * X + 0.4 * cos(3 * Y - X)\n"
                             "end }\n";

static struct sample run_with(enum finding which, int path, const char *settings)
{
    ranks = which;
    solver_path_use(path);
    struct sample sample = start(motion, "dim=2 %s", settings);
    advance(&sample, 6);
    ranks = FOUND;
    return sample;
}

static double apart(const double *one, const double *other, size_t count)
{
    double most = 0.0;
    for (size_t i = 0; i < count; i++) {
        most = fmax(most, fabs(one[i] - other[i]));
    }
    return most;
}

/* Largest difference of two runs, over the wave speed, the edge of the block, 1 and the modulus. */
static double far_apart(struct sample *one, struct sample *other)
{
    struct solver_output a = output_of(one);
    struct solver_output b = output_of(other);
    size_t count = a.cloud->count;
    double worst = fmax(apart(a.v, b.v, 2 * count) / wave_speed(one), apart(a.u, b.u, 2 * count));
    worst = fmax(worst, fmax(apart(a.F, b.F, 4 * count), apart(a.H, b.H, 4 * count)));
    return fmax(worst, fmax(apart(a.P, b.P, 4 * count) / one->scene->E, apart(a.J, b.J, count)));
}

/* With ranks and without: to round-off; the baseline takes none. Among paths with fused multiply-adds, and
 * for one thread and two, bit for bit. */
static void test_loops(void)
{
    int before = solver_path();
    for (size_t i = 0; i < sizeof loops / sizeof *loops; i++) {
        struct sample first = {.run = NULL};
        for (int path = 1; path < SOLVER_PATHS && solver_path_runs(path); path++) {
            char threaded[256];
            (void)snprintf(threaded, sizeof threaded, "%s threads=2", loops[i]);
            struct sample without = run_with(NONE, path, loops[i]);
            struct sample with = run_with(FOUND, path, loops[i]);
            struct sample by_two = run_with(FOUND, path, threaded);
            expect_below(loops[i], far_apart(&with, &without), 1e-14);
            CU_ASSERT(are_same(&with, &by_two));
            CU_ASSERT(path < 2 || are_same(&first, &with));
            finish(&without);
            finish(&by_two);
            finish(&first);
            first = with;
        }
        finish(&first);
    }
    solver_path_use(before);
}

/* That the comparison can see: a weight that is wrong by a thousandth, along a rank, across, and at its end. */
static void test_wrong(void)
{
    int before = solver_path();
    int widest = SOLVER_PATHS - 1;
    while (!solver_path_runs(widest)) {
        widest--;
    }
    for (enum finding which = ALONG_WRONG; widest > 0 && which <= END_WRONG; which++) {
        for (int set = 0; set < 2; set++) {
            const char *settings = set == 0 ? "n=20 evolved=pF" : "n=20 evolved=pFHJ";
            struct sample right = run_with(NONE, widest, settings);
            struct sample wrong = run_with(which, widest, settings);
            CU_ASSERT(far_apart(&wrong, &right) > 1e-9);
            finish(&right);
            finish(&wrong);
        }
    }
    solver_path_use(before);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"the rows of a lattice are ranks", test_lattice},
        {"what is not alike is in none", test_ends},
        {"other stencils have none", test_others},
        {"each pair once gives the same rates", test_loops},
        {"a wrong weight is seen", test_wrong},
    };
    return unit_main("solver: particles in ranks", tests, sizeof tests / sizeof *tests);
}
