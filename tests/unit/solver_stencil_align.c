/* Rows sorted by axis: where they are, and that runs do not depend on it but for the order of sums. The linker puts the
 * function __wrap_ in front of the solver's (tests/share.cmake). */
#include "solver/stencil.h"
#include "tests/unit/clouds.h"
#include "tests/unit/runs.h"

#include <float.h>

static bool as_built; /* rows stay as they are */

// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
bool __real_solver_stencil_align(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                                 struct solver_error *error);
bool __wrap_solver_stencil_align(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                                 struct solver_error *error);

bool __wrap_solver_stencil_align(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                                 struct solver_error *error)
{
    return as_built || __real_solver_stencil_align(stencil, cloud, error);
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

struct made {
    struct solver_cloud *cloud;
    struct solver_stencil *stencil;
};

static struct made make(const char *name, int dim, int edge, double perturb)
{
    struct solver_box box = clouds_box(dim, edge, perturb, 3);
    struct made made = {.cloud = clouds_make(&box)};
    struct solver_error error;
    CU_ASSERT_PTR_NOT_NULL_FATAL(made.cloud);
    CU_ASSERT_FATAL(solver_stencil_create(solver_stencil_find(name), made.cloud, 2.1, &made.stencil, &error));
    return made;
}

static void align(struct made *made)
{
    struct solver_error error;
    CU_ASSERT_FATAL(__real_solver_stencil_align(made->stencil, made->cloud, &error));
}

static void let_go(struct made *made)
{
    solver_stencil_free(made->stencil);
    solver_cloud_free(made->cloud);
}

/* Whether C_ab has a component along the axis alone, as X_b - X_a has. */
static bool lies_along(const struct made *made, size_t a, size_t ab, size_t axis)
{
    size_t dim = (size_t)made->cloud->dim;
    const double *X = made->cloud->X;
    size_t b = made->stencil->graph.neighbour[ab];
    bool along = true;
    for (size_t i = 0; i < dim; i++) {
        bool apart = X[b * dim + i] != X[a * dim + i];
        along = along && apart == (i == axis) && (i == axis || solver_stencil_C(made->stencil, ab)[i] == 0.0);
    }
    return along;
}

/* Each row has the pairs that it had, along each axis in their order. */
static void expect_aligned(const char *name, int dim, int edge)
{
    struct made built = make(name, dim, edge, 0.0);
    struct made sorted = make(name, dim, edge, 0.0);
    const struct solver_graph *graph = &sorted.stencil->graph;
    size_t bytes = ((size_t)dim + 1) * sizeof(double);
    size_t wrong = 0;
    align(&sorted);
    CU_ASSERT_PTR_NOT_NULL_FATAL(sorted.stencil->along);
    for (size_t a = 0; a < graph->count; a++) {
        size_t at = graph->row[a];
        for (size_t axis = 0; axis < (size_t)dim; axis++) {
            size_t last = 0;
            for (size_t k = 0; k < sorted.stencil->along[a * (dim == 3 ? 4 : (size_t)dim) + axis]; k++, at++) {
                size_t b = graph->neighbour[at];
                size_t was = solver_graph_find(&built.stencil->graph, a, b);
                wrong += k > 0 && b <= last;
                wrong += !lies_along(&sorted, a, at, axis) || was == SIZE_MAX ||
                         memcmp(solver_stencil_C(sorted.stencil, at), solver_stencil_C(built.stencil, was), bytes) != 0;
                last = b;
            }
        }
        wrong += at != graph->row[a + 1];
    }
    CU_ASSERT_EQUAL(wrong, 0);
    let_go(&built);
    let_go(&sorted);
}

static void test_lattice(void)
{
    expect_aligned("sbp2", 1, 9);
    expect_aligned("sbp2", 2, 7);
    expect_aligned("sbp2", 3, 4);
    expect_aligned("sbp4", 1, 20);
    expect_aligned("sbp4", 2, 12);
    expect_aligned("sbp4", 3, 8);
    expect_aligned("closed", 1, 9);
}

/* Where a pair lies along no axis nothing is kept for it, and rows stay as they are. */
static void expect_as_built(struct made *made)
{
    const struct solver_graph *graph = &made->stencil->graph;
    size_t bytes = solver_stencil_bytes(made->stencil);
    size_t wrong = 0;
    align(made);
    CU_ASSERT_PTR_NULL(made->stencil->along);
    CU_ASSERT_EQUAL(solver_stencil_bytes(made->stencil), bytes);
    for (size_t a = 0; a < graph->count; a++) {
        for (size_t ab = graph->row[a] + 1; ab < graph->row[a + 1]; ab++) {
            wrong += graph->neighbour[ab] <= graph->neighbour[ab - 1];
        }
    }
    CU_ASSERT_EQUAL(wrong, 0);
    let_go(made);
}

static void test_cloud(void)
{
    struct made closed = make("closed", 2, 7, 0.0);
    struct made perturbed = make("closed", 2, 7, 0.2);
    struct made sph = make("sph", 1, 9, 0.0);
    struct made weighted = make("sbp2", 2, 7, 0.0);
    struct solver_error error;
    expect_as_built(&closed);
    expect_as_built(&perturbed);
    expect_as_built(&sph); /* has transposed pair vectors */
    CU_ASSERT_FATAL(solver_stencil_add_least_squares(weighted.stencil, weighted.cloud, &error));
    expect_as_built(&weighted);
}

/* The last pair alone, by the last bit. */
static void test_bits(void)
{
    struct made turned = make("sbp2", 3, 4, 0.0);
    struct made moved = make("sbp2", 3, 4, 0.0);
    double *C = solver_stencil_C(turned.stencil, turned.stencil->pairs - 1);
    for (size_t i = 0; i < 3; i++) {
        C[i] = C[i] == 0.0 ? DBL_TRUE_MIN : C[i];
    }
    expect_as_built(&turned);
    double *X = moved.cloud->X + (moved.cloud->count - 1) * 3;
    X[0] = nextafter(X[0], INFINITY);
    expect_as_built(&moved);
}

/* Every loop over rows sorted by axis, by overrides of a scene. */
static const char *const loops[] = {
    "dim=3 n=6 evolved=pF",
    "dim=3 n=6 evolved=pFHJ precision=mixed",
    "dim=3 n=6 evolved=pFJ material.model=linear-elastic",
    "dim=3 n=8 evolved=pF material.model=linear-elastic stencil=sbp4 precision=mixed",
    "dim=2 n=11 evolved=pFHJ",
    "dim=2 n=12 evolved=pF precision=mixed",
    "dim=2 n=12 evolved=pFHJ volume_flux=stress",
    "dim=2 n=14 evolved=pFJ stencil=sbp4",
    "dim=2 n=12 evolved=pF material.model=linear-elastic",
    "dim=2 n=12 evolved=pFHJ material.model=hencky",
    "dim=1 n=40 evolved=pFJ reconstruction=none precision=mixed",
    "dim=1 n=40 evolved=pFHJ stencil=closed support=2.1",
    "dim=2 n=12 evolved=pFJ material.nu=0.5 incompressible.solver=poisson",
};

static struct sample run_with(bool rows_as_built, const char *settings)
{
    as_built = rows_as_built;
    struct sample sample = start(smooth_motion, "%s", settings);
    advance(&sample, 3);
    return sample;
}

/* Largest difference of two arrays, over the largest number of the first, or over `size`. */
static double difference(const double *one, const double *other, size_t count, double size)
{
    double worst = 0.0;
    for (size_t i = 0; i < count; i++) {
        worst = fmax(worst, fabs(one[i] - other[i]));
        size = fmax(size, fabs(one[i]));
    }
    return worst / size;
}

/* A stage's change, at these CFL numbers no more than what there is, is a sum of up to 33 terms of up to six factors:
 * in either order it is within 39 roundings. Six stages, and stresses are a few times the strain's size. */
static void expect_alike(const char *settings, double rounding)
{
    struct sample sorted = run_with(false, settings);
    struct sample plain = run_with(true, settings);
    struct solver_output a = output_of(&sorted);
    struct solver_output b = output_of(&plain);
    size_t vectors = a.cloud->count * (size_t)a.cloud->dim;
    size_t tensors = vectors * (size_t)a.cloud->dim;
    double bound = 2.0 * 6.0 * 39.0 * rounding;
    const struct solver_scene *scene = sorted.scene;
    double cp = wave_speed(&sorted);
    expect_below(settings, difference(a.v, b.v, vectors, 0.0), bound);
    expect_below(settings, difference(a.F, b.F, tensors, 1.0), bound);
    expect_below(settings, difference(a.H, b.H, tensors, 1.0), bound);
    expect_below(settings, difference(a.J, b.J, a.cloud->count, 1.0), bound);
    expect_below(settings, difference(a.P, b.P, tensors, isfinite(cp) ? scene->rho * cp * cp : scene->E), bound);
    double rank = (double)sizeof(struct solver_rank) / (scene->n + 1.0); /* of a row */
    double more = scene->dim > 1 ? 5.01 + rank : 5.01;
    CU_ASSERT(solver_run_facts(sorted.run).bytes_per_particle < solver_run_facts(plain.run).bytes_per_particle + more);
    finish(&sorted);
    finish(&plain);
}

static void test_runs(void)
{
    for (size_t i = 0; i < sizeof loops / sizeof *loops; i++) {
        expect_alike(loops[i], DBL_EPSILON);
    }
    expect_alike("dim=3 n=6 evolved=pF material.model=linear-elastic precision=single", FLT_EPSILON);
    expect_alike("dim=3 n=6 evolved=pFHJ precision=single", FLT_EPSILON);
    expect_alike("dim=2 n=12 evolved=pFJ precision=single", FLT_EPSILON);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"rows of a lattice are sorted by axis", test_lattice},
        {"other rows stay as they are", test_cloud},
        {"a bit off the axis is none", test_bits},
        {"runs are the same to round-off", test_runs},
    };
    return unit_main("solver: rows sorted by axis", tests, sizeof tests / sizeof *tests);
}
