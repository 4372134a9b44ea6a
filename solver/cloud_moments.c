#include "solver/cloud_moments.h"

#include "solver/small.h"

#include <math.h>
#include <string.h>

bool cloud_fit_volumes(struct solver_cloud *cloud, double volume, const double centroid[3], struct solver_error *error)
{
    size_t dim = (size_t)cloud->dim;
    size_t count = cloud->count - cloud->wall_count;
    for (int round = 0; round < 2; round++) {
        double A[4][4] = {{0}};
        double r[4] = {volume, 0.0, 0.0, 0.0};
        for (size_t a = 0; a < count; a++) {
            double basis[4] = {1.0, 0.0, 0.0, 0.0};
            for (size_t axis = 0; axis < dim; axis++) {
                basis[axis + 1] = (cloud->X[a * dim + axis] - centroid[axis]) / cloud->spacing;
            }
            for (size_t i = 0; i <= dim; i++) {
                r[i] -= cloud->V[a] * basis[i];
                for (size_t j = 0; j <= dim; j++) {
                    A[i][j] += cloud->V[a] * basis[i] * basis[j];
                }
            }
        }
        if (!solver_small_solve(dim + 1, A, r)) {
            return solver_fail(error, SOLVER_BAD_INPUT, "cloud: volumes cannot be corrected: particles are degenerate");
        }
        for (size_t a = 0; a < count; a++) {
            double factor = 1.0 + r[0];
            for (size_t axis = 0; axis < dim; axis++) {
                factor += r[axis + 1] * (cloud->X[a * dim + axis] - centroid[axis]) / cloud->spacing;
            }
            cloud->V[a] *= factor;
        }
    }
    return true;
}

enum { TERMS = 10, FIT_ROUNDS = 4 }; /* 1, X_i, X_i X_j in 3D */

/* The polynomials in x within the unit cube, and their slopes along axis k. Returns how many there are. */
static size_t polynomials(size_t dim, const double x[3], size_t k, double f[TERMS], double slope[TERMS])
{
    size_t terms = 0;
    f[terms] = 1.0;
    slope[terms++] = 0.0;
    for (size_t i = 0; i < dim; i++) {
        f[terms] = x[i];
        slope[terms++] = i == k ? 1.0 : 0.0;
        for (size_t j = i; j < dim; j++) {
            f[terms] = x[i] * x[j];
            slope[terms++] = (i == k ? x[j] : 0.0) + (j == k ? x[i] : 0.0);
        }
    }
    return terms;
}

/* Solves A c = r, A symmetric and at least semi-definite, by elimination along the diagonal with the largest pivot
 * first; what is left to round-off is taken as zero, where r is to be zero too. */
static void solve_semidefinite(size_t terms, double A[TERMS][TERMS], double r[TERMS])
{
    double largest = 0.0;
    bool done[TERMS] = {false};
    for (size_t i = 0; i < terms; i++) {
        largest = fmax(largest, A[i][i]);
    }
    for (size_t round = 0; round < terms; round++) {
        size_t p = terms;
        for (size_t i = 0; i < terms; i++) {
            p = !done[i] && (p == terms || A[i][i] > A[p][p]) ? i : p;
        }
        done[p] = true;
        bool zero = !(A[p][p] > 1e-11 * largest);
        for (size_t i = 0; i < terms; i++) {
            double factor = i == p || zero ? 0.0 : A[i][p] / A[p][p];
            for (size_t j = 0; j < terms; j++) {
                A[i][j] -= factor * A[p][j];
            }
            r[i] -= factor * r[p];
        }
        if (zero) { /* a combination of the others: leave it out */
            for (size_t i = 0; i < terms; i++) {
                A[i][p] = A[p][i] = 0.0;
            }
            A[p][p] = 1.0;
            r[p] = 0.0;
        }
    }
    for (size_t i = 0; i < terms; i++) {
        r[i] /= A[i][i];
    }
}

static double size_of(size_t dim, const double area[3])
{
    double square = 0.0;
    for (size_t i = 0; i < dim; i++) {
        square += area[i] * area[i];
    }
    return sqrt(square);
}

/* Place within the unit cube about the box's middle. */
static void place_in(const struct solver_cloud *cloud, size_t a, const double middle[3], const double half[3],
                     double x[3])
{
    for (size_t i = 0; i < (size_t)cloud->dim; i++) {
        x[i] = (cloud->X[a * (size_t)cloud->dim + i] - middle[i]) / half[i];
    }
}

/* How far the component may change: none across a plane face. */
static double weight(const struct solver_cloud *cloud, const struct solver_face_point *point, size_t k)
{
    bool along = point->face == SOLVER_SURFACE || point->face / 2 == k;
    return along ? size_of((size_t)cloud->dim, point->area) : 0.0;
}

static void fit_component(struct solver_cloud *cloud, size_t k, const double middle[3], const double half[3])
{
    size_t dim = (size_t)cloud->dim;
    size_t terms = 0;
    double A[TERMS][TERMS] = {{0}};
    double r[TERMS] = {0};
    double f[TERMS];
    double slope[TERMS];
    double x[3] = {0};
    for (size_t a = 0; a < cloud->count; a++) {
        place_in(cloud, a, middle, half, x);
        terms = polynomials(dim, x, k, f, slope);
        for (size_t i = 0; i < terms; i++) {
            r[i] += cloud->V[a] * slope[i] / half[k];
        }
    }
    for (size_t p = 0; p < cloud->face_point_count; p++) {
        const struct solver_face_point *point = &cloud->face_point[p];
        double w = weight(cloud, point, k);
        place_in(cloud, point->particle, middle, half, x);
        terms = polynomials(dim, x, k, f, slope);
        for (size_t i = 0; i < terms; i++) {
            r[i] -= point->area[k] * f[i];
            for (size_t j = 0; j < terms; j++) {
                A[i][j] += w * f[i] * f[j];
            }
        }
    }
    solve_semidefinite(terms, A, r);
    for (size_t p = 0; p < cloud->face_point_count; p++) {
        struct solver_face_point *point = &cloud->face_point[p];
        double w = weight(cloud, point, k);
        place_in(cloud, point->particle, middle, half, x);
        terms = polynomials(dim, x, k, f, slope);
        for (size_t i = 0; i < terms; i++) {
            point->area[k] += w * r[i] * f[i];
        }
    }
}

bool cloud_fit_areas(struct solver_cloud *cloud, const double lower[3], const double upper[3],
                     struct solver_error *error)
{
    double middle[3] = {0};
    double half[3] = {1.0, 1.0, 1.0};
    for (size_t i = 0; i < (size_t)cloud->dim; i++) {
        middle[i] = 0.5 * (lower[i] + upper[i]);
        half[i] = 0.5 * (upper[i] - lower[i]);
    }
    for (int round = 0; round < FIT_ROUNDS; round++) {
        for (size_t k = 0; k < (size_t)cloud->dim; k++) {
            fit_component(cloud, k, middle, half);
        }
    }
    for (size_t p = 0; p < cloud->face_point_count; p++) {
        if (!isfinite(size_of((size_t)cloud->dim, cloud->face_point[p].area))) {
            return solver_fail(error, SOLVER_BAD_INPUT, "cloud: areas cannot be corrected: particles are degenerate");
        }
    }
    return true;
}
