/* What a stencil can do, measured independently of solver_stencil_check: for the conformance suite. */
#ifndef TESTS_STENCIL_PROPERTIES_H
#define TESTS_STENCIL_PROPERTIES_H

#include "solver/memory.h"
#include "solver/stencil.h"
#include "tests/unit/clouds.h"

#include <math.h>
#include <stdlib.h>

enum { PROPERTIES_DEGREES = 5 };

struct stencil_properties {
    /* error of the gradient of polynomials by degree, relative to the largest gradient */
    double inner[PROPERTIES_DEGREES + 1];     /* away from the boundary */
    double outer[PROPERTIES_DEGREES + 1];     /* next to it */
    double antisymmetry, closure;             /* relative to max |C| */
    double stress;                            /* force of a constant stress with its own tractions */
    double parts;                             /* summation by parts of two fields, relative */
    double adjoint;                           /* divergence against the gradient's negative adjoint, relative */
    double volume, moment, area, area_moment; /* sum V, sum V X, sum B, sum X (x) B against the box */
};

/* Keeps the larger of two, and a NaN, which fmax would lose. */
static inline void properties_worse(double *worst, double next)
{
    *worst = isnan(*worst) || *worst >= next ? *worst : next;
}

static inline double *properties_field(size_t count)
{
    struct solver_error error;
    double *made = NULL;
    if (!solver_alloc((void **)&made, count, sizeof(double), "test field", &error)) {
        abort();
    }
    return made;
}

static inline double *properties_random(size_t count, uint64_t seed)
{
    double *made = properties_field(count);
    for (size_t i = 0; i < count; i++) {
        made[i] = clouds_random(&seed);
    }
    return made;
}

/* Boundary area vector of each particle, [count][dim]. */
static inline double *properties_areas(const struct solver_stencil *stencil)
{
    size_t dim = (size_t)stencil->dim;
    double *area = properties_field(stencil->count * dim);
    for (size_t i = 0; i < stencil->face_point_count; i++) {
        for (size_t axis = 0; axis < dim; axis++) {
            area[stencil->face_point[i].particle * dim + axis] += stencil->face_point[i].area[axis];
        }
    }
    return area;
}

/* V_a grad f_a, as the schemes evaluate it. */
static inline void properties_gradient(const struct solver_stencil *stencil, const double *f, size_t a, double out[3])
{
    out[0] = out[1] = out[2] = 0.0;
    for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
        for (int axis = 0; axis < stencil->dim; axis++) {
            out[axis] += 0.5 * (f[stencil->graph.neighbour[ab]] - f[a]) * solver_stencil_C(stencil, ab)[axis];
        }
    }
}

/* V_a (Div P)_a of a vector field P [count][dim] (one row of a stress) without tractions, as the schemes evaluate it.
 * *size: sum of the terms' magnitudes. */
static inline double properties_divergence(const struct solver_stencil *stencil, const double *P, size_t a,
                                           double *size)
{
    size_t dim = (size_t)stencil->dim;
    double sum = 0.0;
    *size = 0.0;
    for (size_t axis = 0; axis < dim; axis++) {
        for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
            double D = stencil->transposed != NULL ? stencil->transposed[ab * dim + axis]
                                                   : solver_stencil_C(stencil, ab)[axis];
            double term = 0.5 * P[stencil->graph.neighbour[ab] * dim + axis] * D;
            sum += term;
            *size += fabs(term);
        }
        double own = 0.5 * P[a * dim + axis] * stencil->row_sum[a * dim + axis];
        sum += own;
        *size += fabs(own);
    }
    return sum;
}

/* Rows next to the boundary that a stencil may treat differently: six, or what leaves some rows between. */
static inline uint32_t properties_block(const struct solver_cloud *cloud)
{
    uint32_t fewest = UINT32_MAX;
    for (int axis = 0; axis < cloud->dim; axis++) {
        fewest = cloud->points[axis] < fewest ? cloud->points[axis] : fewest;
    }
    return fewest > 12 ? 6 : (fewest - 1) / 2;
}

/* Lattice rows between a particle and the nearest face. */
static inline uint32_t properties_depth(const struct solver_cloud *cloud, size_t a)
{
    uint32_t least = UINT32_MAX;
    for (size_t axis = 0; axis < (size_t)cloud->dim; axis++) {
        uint32_t at = cloud->site[a * (size_t)cloud->dim + axis];
        uint32_t other = cloud->points[axis] - 1 - at;
        at = at < other ? at : other;
        least = at < least ? at : least;
    }
    return least;
}

static inline void properties_monomial(const struct solver_cloud *cloud, const struct solver_stencil *stencil,
                                       const int power[3], struct stencil_properties *found)
{
    size_t dim = (size_t)cloud->dim;
    int degree = power[0] + power[1] + power[2];
    double length = cloud->spacing * 8.0;
    double *f = properties_field(cloud->count);
    double *slope = properties_field(cloud->count * dim);
    double inner = 0.0, outer = 0.0, largest = 0.0;
    uint32_t block = properties_block(cloud);
    for (size_t a = 0; a < cloud->count; a++) {
        double xi[3] = {0};
        f[a] = 1.0;
        for (size_t axis = 0; axis < dim; axis++) {
            /* particle 0 is the box's lower corner; a shift, so that no monomial is even or odd about the middle */
            xi[axis] = (cloud->X[a * dim + axis] - cloud->X[axis]) / length - 0.3;
            f[a] *= pow(xi[axis], power[axis]);
        }
        for (size_t axis = 0; axis < dim; axis++) {
            double product = power[axis] / length;
            for (size_t other = 0; other < dim; other++) {
                int left = power[other] - (other == axis);
                product *= left > 0 ? pow(xi[other], left) : 1.0;
            }
            slope[a * dim + axis] = product;
            properties_worse(&largest, fabs(product));
        }
    }
    for (size_t a = 0; a < cloud->count; a++) {
        double g[3];
        properties_gradient(stencil, f, a, g);
        double *worst = properties_depth(cloud, a) >= block ? &inner : &outer;
        for (size_t axis = 0; axis < dim; axis++) {
            double error = fabs(g[axis] / stencil->V[a] - slope[a * dim + axis]) / largest;
            properties_worse(worst, error);
        }
    }
    properties_worse(&found->inner[degree], inner);
    properties_worse(&found->outer[degree], outer);
    free(f);
    free(slope);
}

/* Constants are differentiated exactly by the form of the gradient; their counterpart is the constant stress below. */
static inline void properties_polynomials(const struct solver_cloud *cloud, const struct solver_stencil *stencil,
                                          struct stencil_properties *found)
{
    for (int i = 0; i <= PROPERTIES_DEGREES; i++) {
        for (int j = 0; j <= (cloud->dim > 1 ? PROPERTIES_DEGREES - i : 0); j++) {
            for (int k = 0; k <= (cloud->dim > 2 ? PROPERTIES_DEGREES - i - j : 0); k++) {
                if (i + j + k > 0) {
                    properties_monomial(cloud, stencil, (int[]){i, j, k}, found);
                }
            }
        }
    }
}

/* sum V (f grad g + g grad f) = sum f g B, and sum f V Div P = -sum V grad f . P without tractions, for random f, g
 * and P; and the force of a constant stress P with its tractions P B. */
static inline void properties_identities(const struct solver_stencil *stencil, const double *area,
                                         struct stencil_properties *found)
{
    size_t dim = (size_t)stencil->dim;
    double *f = properties_random(stencil->count, 1), *g = properties_random(stencil->count, 2);
    double *P = properties_random(stencil->count * dim, 3), *same = properties_field(stencil->count * dim);
    const double stress[3] = {1.0, -0.7, 0.4};
    double parts[3] = {0}, parts_size[3] = {0};
    double adjoint = 0.0, adjoint_size = 0.0, face = pow(stencil->spacing, (double)dim - 1.0);
    for (size_t i = 0; i < stencil->count * dim; i++) {
        same[i] = stress[i % dim];
    }
    for (size_t a = 0; a < stencil->count; a++) {
        double of_f[3], of_g[3], size;
        properties_gradient(stencil, f, a, of_f);
        properties_gradient(stencil, g, a, of_g);
        adjoint += f[a] * properties_divergence(stencil, P, a, &size);
        adjoint_size += fabs(f[a]) * size;
        double force = properties_divergence(stencil, same, a, &size);
        for (size_t axis = 0; axis < dim; axis++) {
            double B = area[a * dim + axis];
            parts[axis] += f[a] * of_g[axis] + g[a] * of_f[axis] - f[a] * g[a] * B;
            parts_size[axis] += fabs(f[a] * of_g[axis]) + fabs(g[a] * of_f[axis]);
            adjoint += of_f[axis] * P[a * dim + axis];
            force += stress[axis] * B;
        }
        properties_worse(&found->stress, fabs(force) / face);
    }
    for (size_t axis = 0; axis < dim; axis++) {
        properties_worse(&found->parts, fabs(parts[axis]) / parts_size[axis]);
    }
    found->adjoint = fabs(adjoint) / adjoint_size;
    free(f);
    free(g);
    free(P);
    free(same);
}

/* Moments of volumes and areas, each against the box's. */
static inline void properties_moments(const struct solver_cloud *cloud, const struct solver_stencil *stencil,
                                      const double *area, const struct solver_box *box,
                                      struct stencil_properties *found)
{
    size_t dim = (size_t)cloud->dim;
    double volume = 1.0, sum = 0.0, first[3] = {0}, B[3] = {0}, XB[3][3] = {{0}};
    for (size_t a = 0; a < cloud->count; a++) {
        sum += stencil->V[a];
        for (size_t i = 0; i < dim; i++) {
            double middle = 0.5 * (box->lower[i] + box->upper[i]);
            double X = cloud->X[a * dim + i] - middle;
            first[i] += stencil->V[a] * X / (box->upper[i] - box->lower[i]);
            B[i] += area[a * dim + i];
            for (size_t j = 0; j < dim; j++) {
                XB[i][j] += X * area[a * dim + j];
            }
        }
    }
    for (size_t i = 0; i < dim; i++) {
        volume *= box->upper[i] - box->lower[i];
    }
    found->volume = fabs(sum / volume - 1.0);
    for (size_t i = 0; i < dim; i++) {
        properties_worse(&found->moment, fabs(first[i]) / volume);
        properties_worse(&found->area, fabs(B[i]) / pow(volume, 1.0 - 1.0 / (double)dim));
        for (size_t j = 0; j < dim; j++) {
            properties_worse(&found->area_moment, fabs(XB[i][j] / volume - (i == j ? 1.0 : 0.0)));
        }
    }
}

static inline void properties_pairs(const struct solver_stencil *stencil, const double *area,
                                    struct stencil_properties *found)
{
    size_t dim = (size_t)stencil->dim;
    const struct solver_graph *graph = &stencil->graph;
    double largest = 0.0, worst_transposed = 0.0, worst_sum = 0.0;
    for (size_t a = 0; a < stencil->count; a++) {
        double closure[3] = {0};
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            size_t b = graph->neighbour[ab];
            size_t ba = solver_graph_find(graph, b, a);
            CU_ASSERT_FATAL(ba != SIZE_MAX && b != a);
            CU_ASSERT(ab == graph->row[a] || b > graph->neighbour[ab - 1]);
            const double *C = solver_stencil_C(stencil, ab), *opposite = solver_stencil_C(stencil, ba);
            for (size_t axis = 0; axis < dim; axis++) {
                closure[axis] += C[axis];
                properties_worse(&largest, fabs(C[axis]));
                properties_worse(&found->antisymmetry, fabs(C[axis] + opposite[axis]));
                if (stencil->transposed != NULL) {
                    properties_worse(&worst_transposed, fabs(stencil->transposed[ab * dim + axis] + opposite[axis]));
                }
            }
            /* the dissipation must make neither momentum nor energy */
            CU_ASSERT(C[dim] >= 0.0 && isfinite(C[dim]) && C[dim] == opposite[dim]);
        }
        for (size_t axis = 0; axis < dim; axis++) {
            properties_worse(&worst_sum, fabs(closure[axis] - stencil->row_sum[a * dim + axis]));
            properties_worse(&found->closure, fabs(closure[axis] + area[a * dim + axis]));
        }
    }
    found->antisymmetry /= largest;
    found->closure /= largest;
    CU_ASSERT(largest > 0.0 && isfinite(largest));
    CU_ASSERT(worst_sum <= 1e-14 * largest);
    CU_ASSERT(worst_transposed == 0.0);
}

static inline struct stencil_properties
properties_measure(const struct solver_cloud *cloud, const struct solver_stencil *stencil, const struct solver_box *box)
{
    struct stencil_properties found = {.antisymmetry = 0.0};
    double *area = properties_areas(stencil);
    properties_pairs(stencil, area, &found);
    properties_moments(cloud, stencil, area, box, &found);
    properties_identities(stencil, area, &found);
    properties_polynomials(cloud, stencil, &found);
    free(area);
    return found;
}

#endif
