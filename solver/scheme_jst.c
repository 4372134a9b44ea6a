/* JST-SPH (004_0c0448173ed5e9bd.txt) as a scheme of the table: forces and geometric measures of the mixed
 * total-Lagrangian system, with the dissipation of jst.h. The Laplacian's weights are made here, once. */
#include "solver/jst.h"
#include "solver/memory.h"
#include "solver/scheme_upwind.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct system {
    struct solver_upwind_system base; /* first */
    const struct solver_jst_loops *loops;
    struct solver_jst jst;
    double *laplacian, *exchange;
};

static void destroy(void *of)
{
    struct system *system = of;
    if (system != NULL) {
        free(system->laplacian);
        free(system->exchange);
    }
    solver_upwind_destroy(system);
}

/* On a graded lattice dx^3 in D4 is one factor of it to this power in either Laplacian, so that they stay each other's
 * adjoint. */
static const double of_laplacian = 1.5;

/* Length of a pair over the spacing where that changes, else 1: what dx is for the pair. */
static double lengthened(const struct solver_cloud *cloud, size_t a, size_t b)
{
    size_t dim = (size_t)cloud->dim;
    double square = 0.0;
    if (!solver_cloud_graded(cloud)) {
        return 1.0;
    }
    for (size_t i = 0; i < dim; i++) {
        double d = cloud->X[b * dim + i] - cloud->X[a * dim + i];
        square += d * d;
    }
    return sqrt(square) / cloud->spacing;
}

/* Of particle a: k = A_ab / |X_ab| of each of its pairs into `weight`, and what scales and corrects them. */
struct sums {
    double scale;     /* s_a */
    double moment[3]; /* m_a [m^(dim - 1)] */
};

static struct sums sum_weights(const struct solver_stencil *stencil, const struct solver_cloud *cloud, size_t a,
                               double *weight)
{
    const double *X = cloud->X;
    size_t dim = (size_t)stencil->dim;
    struct sums sums = {.scale = 0.0};
    double second = 0.0;
    size_t shift = solver_stencil_shift(stencil, a);
    for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
        size_t b = stencil->graph.neighbour[ab];
        double d[3] = {0};
        double square = 0.0;
        for (size_t i = 0; i < dim; i++) {
            d[i] = X[b * dim + i] - X[a * dim + i];
            square += d[i] * d[i];
        }
        weight[ab] = solver_stencil_C(stencil, ab + shift)[dim] / sqrt(square);
        second += weight[ab] * square;
        weight[ab] *= pow(lengthened(cloud, a, b), of_laplacian);
        for (size_t i = 0; i < dim; i++) {
            sums.moment[i] += weight[ab] * d[i];
        }
    }
    sums.scale = second > 0.0 ? 2.0 * (double)dim * stencil->V[a] / second : 0.0;
    for (size_t i = 0; i < dim; i++) {
        sums.moment[i] *= sums.scale;
    }
    return sums;
}

/* g_ab . m_a: what a linear field's part of the sum takes away. */
static double correction(const struct solver_stencil *stencil, size_t a, size_t ab, const double *moment)
{
    size_t dim = (size_t)stencil->dim;
    const double *g = stencil->least_squares != NULL ? stencil->least_squares + ab * dim
                                                     : solver_stencil_C(stencil, ab + solver_stencil_shift(stencil, a));
    double scale = stencil->least_squares != NULL ? 1.0 : 0.5 / stencil->V[a];
    double sum = 0.0;
    for (size_t i = 0; i < dim; i++) {
        sum += scale * g[i] * moment[i];
    }
    return sum;
}

static bool make_weights(struct system *system, bool harmonic, bool corrected, struct solver_error *error)
{
    const struct solver_stencil *stencil = system->base.stencil;
    const struct solver_graph *graph = &stencil->graph;
    const struct solver_cloud *cloud = system->base.body->cloud;
    double *weight = NULL;
    double *scale = NULL;
    bool done = solver_alloc((void **)&weight, stencil->pairs, sizeof *weight, "weights of a Laplacian", error) &&
                solver_alloc((void **)&scale, stencil->count, sizeof *scale, "weights of a Laplacian", error) &&
                solver_alloc((void **)&system->laplacian, 2 * stencil->pairs, sizeof(double), "Laplacian", error) &&
                (!harmonic ||
                 solver_alloc((void **)&system->exchange, stencil->pairs, sizeof(double), "harmonic weights", error));
    for (size_t a = 0; done && a < stencil->count; a++) {
        struct sums sums = sum_weights(stencil, cloud, a, weight);
        scale[a] = sums.scale;
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            double l = sums.scale * weight[ab] - (corrected ? correction(stencil, a, ab, sums.moment) : 0.0);
            system->laplacian[2 * ab] = l;
            size_t ba = solver_graph_find(graph, graph->neighbour[ab], a);
            if (ba != SIZE_MAX) { /* an image may lack the row */
                system->laplacian[2 * ba + 1] = l;
            }
        }
    }
    for (size_t a = 0; done && harmonic && a < stencil->count; a++) {
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            size_t b = graph->neighbour[ab];
            double dx = pow(lengthened(cloud, a, b), 1.0 - of_laplacian); /* over what the weight has of it */
            system->exchange[ab] = 0.5 * (scale[a] + scale[b]) * weight[ab] * dx;
        }
    }
    free(weight);
    free(scale);
    return done;
}

static void gather(const void *of, const struct solver_upwind *work, size_t begin, size_t end)
{
    const struct system *system = of;
    system->loops->gather(work, &system->jst, begin, end);
}

static void rates(const void *of, const struct solver_upwind *work, size_t begin, size_t end)
{
    const struct system *system = of;
    system->loops->rates(work, &system->jst, begin, end);
}

static void rate_terms(const void *of, struct solver_cost_terms *terms)
{
    const struct system *system = of;
    system->loops->terms(&system->base.work, &system->jst, system->base.body->cloud->count, terms);
}

static void arrays(const void *of, struct solver_cost_arrays *list)
{
    const struct system *system = of;
    size_t pairs = system->base.stencil->pairs;
    solver_upwind_arrays(of, list);
    solver_cost_array(list, "scheme", "Laplacian", system->laplacian, 2 * pairs, sizeof *system->laplacian);
    solver_cost_array(list, "scheme", "harmonic weights", system->exchange, pairs, sizeof *system->exchange);
}

static bool create(const struct solver_body *body, void **out, struct solver_error *error)
{
    static const struct solver_jst_loops *const loops[][3] = SOLVER_LOOPS(solver_jst);
    const struct solver_scene *scene = body->scene;
    double dx = body->cloud->spacing;
    void *made = NULL;
    if (!solver_upwind_create(body, sizeof(struct system), false, &made, error)) {
        return false;
    }
    struct system *system = made;
    system->loops = loops[solver_path()][body->cloud->dim - 1];
    system->base.gather = gather;
    system->base.rates = rates;
    system->base.terms = rate_terms;
    if (!make_weights(system, scene->jst.kappa2 > 0.0, system->base.work.reconstruct, error)) {
        destroy(system);
        return false;
    }
    /* the Laplacian was corrected by them; no step reads them */
    free(system->base.stencil->least_squares);
    system->base.stencil->least_squares = NULL;
    system->base.work.least_squares = NULL;
    system->jst.harmonic = scene->jst.kappa2 * dx;
    system->jst.fades = scene->jst.fades;
    system->jst.elastic = scene->jst.kappa4;
    system->jst.plastic = scene->jst.kappa4_plastic;
    system->jst.plastic_at = scene->jst.plastic_at;
    system->jst.biharmonic = (scene->jst.fades ? 1.0 : scene->jst.kappa4) * dx * dx * dx;
    system->jst.laplacian = system->laplacian;
    system->jst.exchange = system->exchange;
    *out = system;
    return true;
}

static struct solver_geometry geometry(const void *of)
{
    const struct system *system = of;
    struct solver_geometry geometry = solver_upwind_geometry(system);
    geometry.bytes += (double)(geometry.pairs * (system->exchange != NULL ? 3 : 2) * sizeof(double));
    return geometry;
}

static size_t fields(void *of, struct solver_field table[SOLVER_STATE_FIELDS])
{
    struct system *system = of;
    size_t rows = solver_upwind_fields(system, table);
    bool J = system->base.work.evolves_J;
    table[rows++] =
        (struct solver_field){"Lap v", system->base.loops->lanes, false, {&system->jst.v_laplacian}, {NULL}, 0};
    table[rows++] = (struct solver_field){"Lap J", J ? 1 : 0, false, {&system->jst.J_laplacian}, {NULL}, 0};
    return rows;
}

static const struct solver_scheme_choice choices[] = {
    SOLVER_UPWIND_EVOLVED,
    {"jst.kappa2", "harmonic dissipation; 0: none"},
    {"jst.kappa4", "biharmonic dissipation; 0: none"},
    {"jst.kappa4_plastic", "what kappa4 falls to while the plastic strain grows"},
    {"jst.plastic_at", "plastic strain at which it has fallen"},
    {NULL, NULL},
};

const struct solver_scheme solver_scheme_jst = {
    .name = "jst",
    .summary = "total-Lagrangian mixed method with harmonic and biharmonic dissipation (004_0c0448173ed5e9bd.txt)",
    .advice = "a smaller cfl, a finer n or another jst.kappa4",
    .choice = choices,
    .claims = {.affine = "", .turning = "", .momentum = "", .angular = "angular_momentum=projected"},
    .create = create,
    .destroy = destroy,
    .geometry = geometry,
    .fields = fields,
    .arrays = arrays,
    .terms = solver_upwind_terms,
    SOLVER_UPWIND_SHARED,
};
