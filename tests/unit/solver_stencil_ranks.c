/* Ranks: which particles are in them, and that the loops that take each pair once agree with the others. The linker
 * puts the function __wrap_ in front of the solver's (tests/share.cmake). */
#include "solver/path.h"
#include "tests/unit/lattices.h"
#include "tests/unit/runs.h"

/* One weight, or one distance, by a thousandth. */
enum finding { FOUND, NONE, ALONG_WRONG, ACROSS_WRONG, END_WRONG, HALF_WRONG };

static enum finding ranks;

// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
bool __real_solver_stencil_find_ranks(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                                      struct solver_error *error);
bool __wrap_solver_stencil_find_ranks(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                                      struct solver_error *error);

bool __wrap_solver_stencil_find_ranks(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                                      struct solver_error *error)
{
    bool done = ranks == NONE || __real_solver_stencil_find_ranks(stencil, cloud, error);
    if (ranks == NONE || ranks == FOUND) {
        return done;
    }
    CU_ASSERT_FATAL(stencil->rank_count > 0);
    struct solver_rank *some = stencil->rank + stencil->rank_count / 2;
    int across = some->axis == 0 ? 1 : 0;
    if (ranks == ALONG_WRONG) {
        some->weight[some->axis][SOLVER_RANK_INSIDE] *= 1.001;
    } else if (ranks == ACROSS_WRONG) {
        some->weight[across][SOLVER_RANK_INSIDE] *= 1.001;
    } else if (ranks == END_WRONG) {
        some->weight[across][SOLVER_RANK_LAST] *= 1.001;
    } else {
        some->half[across][1] *= 1.001;
    }
    return done;
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

static void find(struct made *made)
{
    struct solver_error error;
    CU_ASSERT_FATAL(__real_solver_stencil_find_ranks(made->stencil, made->cloud, &error));
}

/* Pairs of particle a that are not where a rank says, or weigh something else; `kind` of its place in it. */
static size_t wrong_pairs(const struct made *made, const struct solver_rank *rank, size_t a, int kind)
{
    const struct solver_stencil *stencil = made->stencil;
    const struct solver_graph *graph = &stencil->graph;
    size_t dim = (size_t)stencil->dim;
    size_t expected = 0;
    size_t found = 0;
    for (size_t I = 0; I < dim; I++) {
        bool along = (int)I == rank->axis;
        size_t away[2] = {along && kind == SOLVER_RANK_FIRST ? 0 : rank->back[I],
                          along && kind == SOLVER_RANK_LAST ? 0 : rank->ahead[I]};
        double weight = 2.0 * stencil->V[a] * rank->weight[I][kind];
        expected += (size_t)(away[0] > 0) + (size_t)(away[1] > 0);
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            size_t b = graph->neighbour[ab];
            bool ahead = b > a;
            const double *C = solver_stencil_C(stencil, ab + solver_stencil_shift(stencil, a));
            double apart = fabs(made->cloud->X[b * dim + I] - made->cloud->X[a * dim + I]);
            bool right = (ahead ? b - a : a - b) == away[ahead] && fabs(C[dim] - weight) <= 1e-15 * weight &&
                         fabs((ahead ? C[I] : -C[I]) - weight) <= 1e-15 * weight &&
                         fabs(apart - 2.0 * rank->half[I][ahead]) <= 1e-14;
            found += right ? 1 : 0;
        }
    }
    return graph->row[a + 1] - graph->row[a] != expected || found != expected ? 1 : 0;
}

/* Ranks and particles that are not what they are in a lattice whose every row is one. */
static size_t wrong_ranks(const struct made *made, size_t edge)
{
    const struct solver_stencil *stencil = made->stencil;
    size_t wrong = 0;
    for (size_t r = 0; r < stencil->rank_count; r++) {
        const struct solver_rank *rank = stencil->rank + r;
        wrong += rank->begin != r * edge || rank->end != (r + 1) * edge;
        for (size_t a = rank->begin; a < rank->end; a++) {
            wrong += wrong_pairs(made, rank, a,
                                 a == rank->begin    ? SOLVER_RANK_FIRST
                                 : a + 1 < rank->end ? SOLVER_RANK_INSIDE
                                                     : SOLVER_RANK_LAST);
        }
    }
    return wrong;
}

/* Every row of a lattice of sbp2 is one rank, unless it is in the plane and too long. */
static void test_lattice(void)
{
    static const struct {
        int dim, edges;
    } lattices[] = {{2, 4}, {2, 20}, {2, 21}, {2, SOLVER_RANK_MOST - 1}, {3, 3}, {3, 12}, {3, 15}};
    struct made longer = make("sbp2", 2, SOLVER_RANK_MOST);
    find(&longer);
    CU_ASSERT_EQUAL(longer.stencil->rank_count, 0);
    let_go(&longer);
    for (size_t i = 0; i < sizeof lattices / sizeof *lattices; i++) {
        struct made made = make("sbp2", lattices[i].dim, lattices[i].edges);
        size_t edge = (size_t)lattices[i].edges + 1;
        find(&made);
        CU_ASSERT_EQUAL_FATAL(made.stencil->rank_count * edge, made.stencil->count);
        CU_ASSERT_EQUAL(wrong_ranks(&made, edge), 0);
        let_go(&made);
    }
}

/* One volume, one face measure, one neighbour that is another, one place: its particle is in no rank with those beside
 * it. */
static void test_ends(void)
{
    enum { EDGE = 21, AT = 10 * EDGE + 10 };
    for (int broken = 0; broken < 4; broken++) {
        struct made made = make("sbp2", 2, EDGE - 1);
        struct solver_stencil *stencil = made.stencil;
        size_t record = stencil->graph.row[AT] + solver_stencil_shift(stencil, AT);
        if (broken == 0) {
            stencil->V[AT] = nextafter(stencil->V[AT], INFINITY);
        } else if (broken == 1) { /* that of all particles inside, as rows are shared */
            solver_stencil_C(stencil, record)[2] *= 0.5;
        } else if (broken == 2) {
            stencil->graph.neighbour[stencil->graph.row[AT]]++;
        } else {
            made.cloud->X[2 * AT] += 1e-12;
        }
        find(&made);
        size_t with = 0;
        for (size_t r = 0; r < stencil->rank_count; r++) {
            with += stencil->rank[r].begin < AT && stencil->rank[r].end > AT + 1;
        }
        CU_ASSERT_EQUAL(with, 0);
        CU_ASSERT(broken == 1 ? stencil->rank_count == 2 : stencil->rank_count > 2); /* the first row and the last */
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

/* All that the loops distinguish, in the plane and in space, by overrides of a scene; rows that pieces of work cut
 * anywhere, the longest there are, and no multiple of a register's width. */
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
    "n=21 evolved=pF material.model=linear-elastic grading.Y=4",
    "n=24 evolved=pFHJ material.model=linear-elastic integrator=rk4 precision=mixed",
    "dim=3 n=9 evolved=pF",
    "dim=3 n=10 evolved=pFJ",
    "dim=3 n=11 evolved=pFHJ material.model=hencky",
    "dim=3 n=12 evolved=pF material.model=linear-elastic",
    "dim=3 n=9 evolved=pFJ material.model=linear-elastic",
    "dim=3 n=13 evolved=pFHJ material.model=linear-elastic integrator=rk4",
    "dim=3 n=10 evolved=pFHJ material.model=linear-elastic precision=mixed",
    "dim=3 n=10 evolved=pFJ material.model=linear-elastic reconstruction=none",
    "dim=3 n=11 evolved=pFJ material.model=linear-elastic grading.X=4",
    "dim=3 n=11 evolved=pFJ material.model=linear-elastic grading.Z=4",
    "n=17 evolved=pF precision=single",
    "n=30 evolved=pFHJ precision=single",
    "n=35 evolved=pFJ precision=single material.model=hencky",
    "n=21 evolved=pFHJ precision=single material.model=linear-elastic",
    "n=21 evolved=pFJ precision=single grading.Y=4",
    "dim=3 n=9 evolved=pFJ precision=single material.model=linear-elastic",
    "dim=3 n=17 evolved=pFHJ precision=single material.model=linear-elastic integrator=rk4",
};

/* Fast enough that pairs turn and are stretched by some percent. */
static const char motion[] =
    "initial = { velocity = function(X, Y, Z)\n"
    "    return first(0.3 + 0.6 * sin(2 * X + Y + Z + 0.3), 0.2 - 0.5 * X + 0.4 * cos(3 * Y - X + 2 * Z),\n"
    "                 0.1 + 0.4 * sin(Z + X - 2 * Y))\n"
    "end }\n";

static struct sample run_with(enum finding which, int path, const char *settings)
{
    ranks = which;
    solver_path_use(path);
    struct sample sample = start(motion, "%s%s", strncmp(settings, "dim=", 4) == 0 ? "" : "dim=2 ", settings);
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
    size_t vectors = count * (size_t)a.cloud->dim;
    size_t tensors = vectors * (size_t)a.cloud->dim;
    double worst = fmax(apart(a.v, b.v, vectors) / wave_speed(one), apart(a.u, b.u, vectors));
    worst = fmax(worst, fmax(apart(a.F, b.F, tensors), apart(a.H, b.H, tensors)));
    return fmax(worst, fmax(apart(a.P, b.P, tensors) / one->scene->E, apart(a.J, b.J, count)));
}

/* Round-off of a scene's precision, over some steps. */
static double round_off(const char *settings)
{
    return strstr(settings, "single") != NULL ? 5e-7 : 1e-14;
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
            expect_below(loops[i], far_apart(&with, &without), round_off(loops[i]));
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

/* That the comparison can see: a weight that is wrong by a thousandth, along a rank, across, and at its end, and, where
 * it counts, a distance. */
static void test_wrong(void)
{
    static const struct {
        const char *settings;
        enum finding last;
    } scenes[] = {{"n=20 evolved=pF", END_WRONG},
                  {"n=20 evolved=pFHJ", END_WRONG},
                  {"n=20 evolved=pF material.model=linear-elastic", HALF_WRONG},
                  {"dim=3 n=9 evolved=pFHJ", END_WRONG},
                  {"dim=3 n=9 evolved=pFJ material.model=linear-elastic", HALF_WRONG},
                  {"n=20 evolved=pFHJ precision=single", END_WRONG},
                  {"dim=3 n=9 evolved=pFJ material.model=linear-elastic precision=single", HALF_WRONG}};
    int before = solver_path();
    int widest = SOLVER_PATHS - 1;
    while (!solver_path_runs(widest)) {
        widest--;
    }
    for (size_t i = 0; widest > 0 && i < sizeof scenes / sizeof *scenes; i++) {
        struct sample right = run_with(NONE, widest, scenes[i].settings);
        for (enum finding which = ALONG_WRONG; which <= scenes[i].last; which++) {
            struct sample wrong = run_with(which, widest, scenes[i].settings);
            CU_ASSERT(far_apart(&wrong, &right) > fmax(1e-9, 2.0 * round_off(scenes[i].settings)));
            finish(&wrong);
        }
        finish(&right);
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
