#include "solver/stencil.h"

#include "solver/memory.h"
#include "solver/small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct solver_stencil_builder builders[] = {
    {.name = "sph",
     .summary = "corrected kernel gradient of the Upwind-SPH paper, quadratic kernel; not closed, first order at best",
     .degree = 1,
     .boundary = 1,
     .build = solver_stencil_sph},
    {.name = "closed",
     .summary = "kernel pair vectors projected once onto antisymmetry, closure and linear exactness; any cloud",
     .antisymmetric = true,
     .closed = true,
     .degree = 1,
     .boundary = 1,
     .build = solver_stencil_closed},
    {.name = "sbp2",
     .summary = "summation-by-parts 2-1 along lattice lines; nearest neighbours only",
     .antisymmetric = true,
     .closed = true,
     .lattice_only = true,
     .faces = true,
     .degree = 2,
     .boundary = 1,
     .build = solver_stencil_sbp2},
    {.name = "sbp4",
     .summary = "summation-by-parts 4-2 along lattice lines; the most accurate on a box",
     .antisymmetric = true,
     .closed = true,
     .lattice_only = true,
     .faces = true,
     .degree = 4,
     .boundary = 2,
     .build = solver_stencil_sbp4},
    {.name = NULL},
};

const struct solver_stencil_builder *solver_stencil_builders(void)
{
    return builders;
}

const struct solver_stencil_builder *solver_stencil_find(const char *name)
{
    for (const struct solver_stencil_builder *builder = builders; builder->name != NULL; builder++) {
        if (strcmp(builder->name, name) == 0) {
            return builder;
        }
    }
    return NULL;
}

/* Between two particles in one place there is no direction. */
static bool are_apart(const struct solver_cloud *cloud, const struct solver_graph *graph, struct solver_error *error)
{
    size_t dim = (size_t)cloud->dim;
    double least = 1e-6 * solver_cloud_finest(cloud);
    for (size_t a = 0; a < cloud->count; a++) {
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            size_t b = graph->neighbour[ab];
            double square = 0.0;
            for (size_t axis = 0; axis < dim; axis++) {
                double d = cloud->X[b * dim + axis] - cloud->X[a * dim + axis];
                square += d * d;
            }
            if (square < least * least) {
                return solver_fail(error, SOLVER_BAD_INPUT,
                                   "particles %zu and %zu are %.3g m apart, at a spacing of %g m: two in one place; "
                                   "leave one out",
                                   a, b, sqrt(square), cloud->spacing);
            }
        }
    }
    return true;
}

bool solver_stencil_reserve(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                            struct solver_error *error)
{
    size_t dim = (size_t)cloud->dim;
    stencil->dim = cloud->dim;
    stencil->count = cloud->count;
    stencil->spacing = cloud->spacing;
    stencil->finest = solver_cloud_finest(cloud);
    stencil->unit = 1.0;
    stencil->pairs = stencil->graph.row[cloud->count];
    stencil->records = stencil->pairs;
    stencil->face_point_count = cloud->face_point_count;
    if (!solver_alloc((void **)&stencil->pair, stencil->pairs * (dim + 1), sizeof(double), "pair vectors", error) ||
        !solver_alloc((void **)&stencil->row_sum, cloud->count * dim, sizeof(double), "pair vector sums", error) ||
        !solver_alloc((void **)&stencil->V, cloud->count, sizeof(double), "stencil volumes", error) ||
        !solver_alloc((void **)&stencil->face_point, cloud->face_point_count, sizeof *cloud->face_point, "face points",
                      error)) {
        return false;
    }
    memcpy(stencil->V, cloud->V, cloud->count * sizeof *cloud->V);
    if (cloud->face_point_count > 0) { /* else it is NULL, which memcpy must not be given */
        memcpy(stencil->face_point, cloud->face_point, cloud->face_point_count * sizeof *cloud->face_point);
    }
    return true;
}

/* Row sums, D_ab where it is not C_ab, and the face measure. NUMERICS: wide stencils have pairs with N . C < 0, which
 * would feed energy in; they take no part in the dissipation. */
static bool finish(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                   const struct solver_stencil_builder *builder, struct solver_error *error)
{
    size_t dim = (size_t)stencil->dim;
    if (!are_apart(cloud, &stencil->graph, error)) {
        return false;
    }
    if (!builder->antisymmetric && !solver_alloc((void **)&stencil->transposed, stencil->pairs * dim, sizeof(double),
                                                 "transposed pair vectors", error)) {
        return false;
    }
#pragma omp parallel for schedule(static)
    for (size_t a = 0; a < stencil->count; a++) {
        for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
            size_t b = stencil->graph.neighbour[ab];
            double *C = solver_stencil_C(stencil, ab);
            const double *opposite = solver_stencil_C(stencil, solver_graph_find(&stencil->graph, b, a));
            double along = 0.0;
            double square = 0.0;
            for (size_t axis = 0; axis < dim; axis++) {
                double d = cloud->X[b * dim + axis] - cloud->X[a * dim + axis];
                along += 0.5 * (C[axis] - opposite[axis]) * d;
                square += d * d;
                stencil->row_sum[a * dim + axis] += C[axis];
                if (!builder->antisymmetric) {
                    stencil->transposed[ab * dim + axis] = -opposite[axis];
                }
            }
            if (!builder->faces) {
                C[dim] = fmax(0.0, along) / sqrt(square);
            }
        }
    }
    return true;
}

bool solver_stencil_create(const struct solver_stencil_builder *builder, const struct solver_cloud *cloud,
                           double support, struct solver_stencil **out, struct solver_error *error)
{
    struct solver_stencil *stencil = NULL;
    *out = NULL;
    if (builder->closed && cloud->face_point_count == 0) {
        return solver_fail(
            error, SOLVER_BAD_INPUT,
            "stencil: %s closes over the faces of the body and needs particles on them; expected lattice = "
            "\"nodes\", or another stencil, say sph",
            builder->name);
    }
    if (builder->lattice_only && cloud->site == NULL) {
        return solver_fail(
            error, SOLVER_BAD_INPUT,
            "stencil: %s works along the lines of a box's lattice, and a body of another shape has none; expected "
            "closed, or another stencil for any cloud",
            builder->name);
    }
    if (!builder->lattice_only && solver_cloud_graded(cloud)) {
        return solver_fail(
            error, SOLVER_BAD_INPUT,
            "stencil: %s has one support for all particles, and spacings of this lattice change; expected "
            "sbp2 or sbp4",
            builder->name);
    }
    if (!solver_alloc((void **)&stencil, 1, sizeof *stencil, "stencil", error)) {
        return false;
    }
    if (!builder->build(cloud, support, stencil, error) || !finish(stencil, cloud, builder, error)) {
        solver_stencil_free(stencil);
        return false;
    }
    *out = stencil;
    return true;
}

void solver_stencil_free(struct solver_stencil *stencil)
{
    if (stencil == NULL) {
        return;
    }
    solver_graph_free(&stencil->graph);
    free(stencil->pair);
    free(stencil->shared);
    free(stencil->along);
    free(stencil->abreast);
    free(stencil->rank);
    free(stencil->narrow);
    free(stencil->transposed);
    free(stencil->row_sum);
    free(stencil->least_squares);
    free(stencil->V);
    free(stencil->own);
    free(stencil->fine);
    free(stencil->face_point);
    free(stencil);
}

bool solver_stencil_add_least_squares(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                                      struct solver_error *error)
{
    size_t dim = (size_t)stencil->dim;
    if (!solver_alloc((void **)&stencil->least_squares, stencil->pairs * dim, sizeof(double), "least-squares gradient",
                      error)) {
        return false;
    }
    for (size_t a = 0; a < stencil->count; a++) {
        double moment[4][4] = {{0}};
        for (int pass = 0; pass < 2; pass++) {
            for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
                double d[3] = {0};
                double square = 0.0;
                for (size_t axis = 0; axis < dim; axis++) {
                    d[axis] = cloud->X[stencil->graph.neighbour[ab] * dim + axis] - cloud->X[a * dim + axis];
                    square += d[axis] * d[axis];
                }
                for (size_t i = 0; i < dim; i++) {
                    for (size_t j = 0; j < dim; j++) {
                        if (pass == 0) {
                            moment[i][j] += d[i] * d[j] / square;
                        } else {
                            stencil->least_squares[ab * dim + i] += moment[i][j] * d[j] / square;
                        }
                    }
                }
            }
            if (pass == 0 && !solver_small_invert(dim, moment)) {
                return solver_fail(error, SOLVER_BAD_INPUT,
                                   "least-squares gradient: neighbours of particle %zu lie "
                                   "in a plane; choose a larger support",
                                   a);
            }
        }
    }
    return true;
}

void solver_stencil_arrays(const struct solver_stencil *stencil, struct solver_cost_arrays *arrays)
{
    static const char group[] = "stencil";
    size_t dim = (size_t)stencil->dim;
    size_t lanes = dim == 3 ? 4 : dim;
    solver_graph_arrays(&stencil->graph, group, arrays);
    solver_cost_array(arrays, group, "pair vectors and areas", stencil->pair, stencil->records * (dim + 1),
                      sizeof(double));
    solver_cost_array(arrays, group, "narrow pair vectors and areas", stencil->narrow, stencil->records * (dim + 1),
                      sizeof(float));
    solver_cost_array(arrays, group, "rows of pair vectors", stencil->shared, stencil->count, sizeof *stencil->shared);
    solver_cost_array(arrays, group, "pairs along axes", stencil->along, stencil->count * lanes,
                      sizeof *stencil->along);
    solver_cost_array(arrays, group, "particles abreast", stencil->abreast, stencil->count, sizeof *stencil->abreast);
    solver_cost_array(arrays, group, "ranks", stencil->rank, stencil->rank_count, sizeof *stencil->rank);
    solver_cost_array(arrays, group, "transposed", stencil->transposed, stencil->pairs * dim, sizeof(double));
    solver_cost_array(arrays, group, "least squares", stencil->least_squares, stencil->pairs * dim, sizeof(double));
    solver_cost_array(arrays, group, "row sums", stencil->row_sum, stencil->count * dim, sizeof(double));
    solver_cost_array(arrays, group, "volumes", stencil->V, stencil->count, sizeof(double));
    solver_cost_array(arrays, group, "volumes of the part", stencil->own, stencil->count, sizeof(double));
    solver_cost_array(arrays, group, "face points", stencil->face_point, stencil->face_point_count,
                      sizeof *stencil->face_point);
    solver_cost_array(arrays, group, "itself", stencil, 1, sizeof *stencil);
}

size_t solver_stencil_bytes(const struct solver_stencil *stencil)
{
    size_t dim = (size_t)stencil->dim;
    size_t lanes = dim == 3 ? 4 : dim;
    size_t per_record = (stencil->pair != NULL ? (dim + 1) * sizeof(double) : 0) +
                        (stencil->narrow != NULL ? (dim + 1) * sizeof(float) : 0);
    size_t per_pair = sizeof *stencil->graph.neighbour + (stencil->transposed != NULL ? dim * sizeof(double) : 0) +
                      (stencil->least_squares != NULL ? dim * sizeof(double) : 0);
    size_t per_particle = sizeof *stencil->graph.row + (stencil->shared != NULL ? sizeof *stencil->shared : 0) +
                          (stencil->along != NULL ? lanes * sizeof *stencil->along : 0) +
                          (stencil->abreast != NULL ? sizeof *stencil->abreast : 0) + (dim + 1) * sizeof(double) +
                          (stencil->own != NULL ? sizeof(double) : 0);
    return stencil->records * per_record + stencil->pairs * per_pair + stencil->count * per_particle +
           stencil->face_point_count * sizeof *stencil->face_point + stencil->rank_count * sizeof *stencil->rank;
}

/* Keeps the larger of two, and a NaN, which fmax would lose. */
static double worse(double worst, double next)
{
    return isnan(worst) || isgreaterequal(worst, next) ? worst : next;
}

struct solver_stencil_residuals solver_stencil_check(const struct solver_stencil *stencil,
                                                     const struct solver_cloud *cloud)
{
    size_t dim = (size_t)stencil->dim;
    struct solver_stencil_residuals worst = {0};
    double largest = 0.0;
    for (size_t record = 0; record < stencil->records; record++) {
        for (size_t axis = 0; axis < dim; axis++) {
            largest = worse(largest, fabs(solver_stencil_C(stencil, record)[axis]));
        }
    }
    size_t next_face = 0;
    for (size_t a = 0; a < stencil->count; a++) {
        double closure[3] = {0};
        double linear[3][3] = {{0}};
        for (; next_face < stencil->face_point_count && stencil->face_point[next_face].particle == a; next_face++) {
            for (size_t axis = 0; axis < dim; axis++) {
                closure[axis] += stencil->face_point[next_face].area[axis];
            }
        }
        for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
            size_t b = stencil->graph.neighbour[ab];
            size_t ba = solver_graph_find(&stencil->graph, b, a);
            const double *C = solver_stencil_C(stencil, ab + solver_stencil_shift(stencil, a));
            const double *opposite = solver_stencil_C(stencil, ba + solver_stencil_shift(stencil, b));
            for (size_t axis = 0; axis < dim; axis++) {
                worst.antisymmetry = worse(worst.antisymmetry, fabs(C[axis] + opposite[axis]) / largest);
                closure[axis] += C[axis];
                for (size_t i = 0; i < dim; i++) {
                    linear[i][axis] += 0.5 * (cloud->X[b * dim + i] - cloud->X[a * dim + i]) * C[axis] / stencil->V[a];
                }
            }
        }
        for (size_t i = 0; i < dim; i++) {
            worst.closure = worse(worst.closure, fabs(closure[i]) / largest);
            for (size_t axis = 0; axis < dim; axis++) {
                worst.linear = worse(worst.linear, fabs(linear[i][axis] - (i == axis ? 1.0 : 0.0)));
            }
        }
    }
    return worst;
}
