/* One conformance suite for every stencil builder in the table: which properties it has, to round-off, on lattices and
 * on perturbed lattices in 1, 2 and 3 dimensions. What a builder claims must hold; what it does not claim must be
 * measured as missing, so that no claim can be wrong unseen. A new builder is tested by standing in the table. */
#include "tests/unit/stencil_properties.h"
#include "tests/unit/unit.h"

#include <string.h>

static const double perturb = 0.15;
static const double support[4] = {0, 3.0, 2.1, 2.1}; /* closed has too few unknowns in 1D below about 3 */
static const double exact = 1e-12;                   /* round-off of sums over a row, relative */
static const double missing = 1e-5;                  /* at least this where a property is absent */

static void report(const struct solver_stencil_builder *builder, const struct solver_box *box,
                   const struct solver_stencil *stencil, const struct stencil_properties *found)
{
    static bool headed = false;
    if (!headed) {
        (void)printf("\nGradients of polynomials by degree, relative error: away from / next to the boundary.\n"
                     "%-7s dim edge cloud     pairs  antisym closure  c-stress by-parts adjoint  moments",
                     "builder");
        for (int degree = 1; degree <= PROPERTIES_DEGREES; degree++) {
            (void)printf("  degree %d       ", degree);
        }
        (void)printf("\n");
        headed = true;
    }
    double moments = fmax(fmax(found->volume, found->moment), fmax(found->area, found->area_moment));
    (void)printf("%-7s %dD  %3.0f  %-9s %5.1f  %.1e %.1e %.1e  %.1e  %.1e  %.1e", builder->name, box->dim,
                 (box->upper[0] - box->lower[0]) / box->spacing, box->perturb > 0.0 ? "perturbed" : "lattice",
                 (double)stencil->pairs / (double)stencil->count, found->antisymmetry, found->closure, found->stress,
                 found->parts, found->adjoint, moments);
    for (int degree = 1; degree <= PROPERTIES_DEGREES; degree++) {
        (void)printf("  %.1e/%.1e", found->inner[degree], found->outer[degree]);
    }
    (void)printf("\n");
}

/* A degree that is not claimed must be missing on a general cloud, that is on the most irregular kind that the builder
 * takes: the symmetry of a lattice gives some builders a degree that they do not have elsewhere. */
static bool degrees_hold(const struct solver_stencil_builder *builder, bool general,
                         const struct stencil_properties *found)
{
    if (builder->boundary < 1 || builder->boundary > builder->degree || builder->degree >= PROPERTIES_DEGREES) {
        return false;
    }
    for (int degree = 1; degree <= builder->degree; degree++) {
        if (!(found->inner[degree] <= exact) || (degree <= builder->boundary && !(found->outer[degree] <= exact))) {
            return false;
        }
    }
    return !general || (found->inner[builder->degree + 1] > missing && found->outer[builder->boundary + 1] > missing);
}

/* Whether exactly what is claimed was measured. */
static bool claims_hold(const struct solver_stencil_builder *builder, bool general,
                        const struct stencil_properties *found)
{
    bool conserves = solver_stencil_keeps_constant_stress(builder);
    return degrees_hold(builder, general, found) &&
           (builder->antisymmetric ? found->antisymmetry == 0.0 : found->antisymmetry > missing) &&
           (builder->closed ? found->closure <= exact : found->closure > missing) &&
           (conserves ? found->stress <= exact : found->stress > missing) &&
           (conserves ? found->parts <= exact : found->parts > missing);
}

/* Each claim turned into a false one, to be found out. */
static void false_claims_are_found(const struct solver_stencil_builder *builder, bool general,
                                   const struct stencil_properties *found)
{
    struct solver_stencil_builder liar = *builder;
    liar.antisymmetric = !builder->antisymmetric;
    CU_ASSERT(!claims_hold(&liar, general, found));
    liar = *builder;
    liar.closed = !builder->closed;
    CU_ASSERT(!claims_hold(&liar, general, found));
    for (int change = -1; change <= 1 && general; change += 2) {
        liar = *builder;
        liar.degree += change;
        CU_ASSERT(!claims_hold(&liar, general, found));
        liar = *builder;
        liar.boundary += change;
        CU_ASSERT(!claims_hold(&liar, general, found));
    }
}

/* The face measure of the dissipation: max(0, (C_ab - C_ba)/2 . N_ab), where the builder does not set its own; one
 * that does may not let a particle's faces enclose more than its volume, 1/2 sum_b A_ab |X_b - X_a| <= dim V_a, which
 * would shorten the time step. */
static void judge_faces(const struct solver_stencil_builder *builder, const struct solver_cloud *cloud,
                        const struct solver_stencil *stencil)
{
    size_t dim = (size_t)stencil->dim;
    double worst = 0.0, fullest = 0.0, face = pow(stencil->spacing, (double)dim - 1.0);
    for (size_t a = 0; a < stencil->count; a++) {
        double enclosed = 0.0;
        for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
            size_t b = stencil->graph.neighbour[ab];
            const double *C = solver_stencil_C(stencil, ab);
            const double *opposite = solver_stencil_C(stencil, solver_graph_find(&stencil->graph, b, a));
            double along = 0.0, square = 0.0;
            for (size_t axis = 0; axis < dim; axis++) {
                double d = cloud->X[b * dim + axis] - cloud->X[a * dim + axis];
                along += 0.5 * (C[axis] - opposite[axis]) * d;
                square += d * d;
            }
            enclosed += 0.5 * C[dim] * sqrt(square);
            properties_worse(&worst, fabs(C[dim] - fmax(0.0, along / sqrt(square))) / face);
        }
        properties_worse(&fullest, enclosed / ((double)dim * stencil->V[a]));
    }
    CU_ASSERT(builder->faces ? fullest <= 1.0 + exact && fullest > 0.1 : worst <= exact);
}

/* What no builder is free to lack. */
static void judge_duties(const struct solver_stencil_builder *builder, const struct solver_stencil *stencil,
                         const struct stencil_properties *found)
{
    CU_ASSERT((stencil->transposed == NULL) == builder->antisymmetric);
    CU_ASSERT(found->adjoint <= exact);
    CU_ASSERT(found->volume <= exact);
    CU_ASSERT(found->moment <= exact);
    CU_ASSERT(found->area <= exact);
    CU_ASSERT(found->area_moment <= exact);
}

static void conform(const struct solver_stencil_builder *builder, int dim, int edge, double shift)
{
    struct solver_error error = {.code = SOLVER_OK};
    struct solver_stencil *stencil = NULL;
    struct solver_box box = clouds_box(dim, edge, shift, 11);
    struct solver_cloud *cloud = clouds_make(&box);
    CU_ASSERT_PTR_NOT_NULL_FATAL(cloud);
    bool built = solver_stencil_create(builder, cloud, support[dim], &stencil, &error);
    if (builder->lattice_only && shift > 0.0) {
        CU_ASSERT(!built && stencil == NULL && error.code == SOLVER_BAD_INPUT);
        CU_ASSERT(strstr(error.text, builder->name) != NULL && strstr(error.text, "perturbed") != NULL);
    } else if (!built) {
        (void)printf("%s in %dD: %s\n", builder->name, dim, error.text);
        CU_FAIL("a builder must take this cloud");
    } else {
        bool general = builder->lattice_only || shift > 0.0;
        struct stencil_properties found = properties_measure(cloud, stencil, &box);
        report(builder, &box, stencil, &found);
        judge_duties(builder, stencil, &found);
        judge_faces(builder, cloud, stencil);
        CU_ASSERT(claims_hold(builder, general, &found));
        false_claims_are_found(builder, general, &found);
    }
    solver_stencil_free(stencil);
    solver_cloud_free(cloud);
}

/* Edges short and long, the latter with room for the widest boundary closure; in 1D also such that either closure of
 * sbp4 leaves rows of the interior between its ends. In 3D builders for any cloud, which may take long to set up, get a
 * short one only: memcheck runs this too. */
static void conform_all(int dim)
{
    size_t members = 0;
    for (const struct solver_stencil_builder *b = solver_stencil_builders(); b->name != NULL; b++) {
        bool slow = dim == 3 && !b->lattice_only;
        const int edge[4] = {slow ? 6 : 8, 12, 10, 16};
        for (int i = 0; i < (slow ? 1 : dim > 1 ? 2 : 4); i++) {
            conform(b, dim, edge[i], 0.0);
            conform(b, dim, edge[i], perturb);
        }
        members++;
    }
    CU_ASSERT(members >= 4);
}

static void conform_1d(void)
{
    conform_all(1);
}

static void conform_2d(void)
{
    conform_all(2);
}

static void conform_3d(void)
{
    conform_all(3);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"every builder in 1D", conform_1d},
        {"every builder in 2D", conform_2d},
        {"every builder in 3D", conform_3d},
    };
    return unit_main("solver stencil", tests, sizeof tests / sizeof *tests);
}
