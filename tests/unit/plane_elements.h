/* Finite elements that know nothing of oracles/: nine-node rectangles, integrated by three-point Gauss rules, over the
 * whole height of a clamped body in SI units; lowest frequency by inverse iteration. For the second opinion. */
#ifndef TESTS_PLANE_ELEMENTS_H
#define TESTS_PLANE_ELEMENTS_H

#include <gsl/gsl_linalg.h>
#include <gsl/gsl_matrix.h>
#include <math.h>
#include <stdlib.h>

struct plane_body {
    double length, height;  /* [m] */
    double lambda, mu, rho; /* in the plane; [Pa], [Pa], [kg/m^3] */
};

/* Lines through the nodes; every second one bounds elements, which shrink with the cube towards the clamp and the free
 * faces, where the stress at the corners asks for it. n elements per quarter of the height. */
struct plane_grid {
    int nx, ny; /* lines */
    double x[400], y[100];
};

static void plane_grid_cut(const struct plane_body *body, int n, struct plane_grid *grid)
{
    double half = body->height / 2, end[] = {0, half, 2 * body->height, body->length};
    grid->nx = grid->ny = 0;
    grid->x[grid->nx++] = 0;
    for (int part = 0; part < 3; part++) {
        int pieces = 2 * n * (part == 2 ? 2 : 1);
        for (int i = 1; i <= pieces; i++) {
            double s = (double)i / pieces;
            grid->x[grid->nx++] = end[part] + (end[part + 1] - end[part]) * (part == 0 ? s * s * s : s);
        }
    }
    for (int i = -2 * n; i <= 2 * n; i++) {
        double s = 1 - fabs((double)i) / (2 * n);
        grid->y[grid->ny++] = half * (1 - s * s * s) * (i < 0 ? -1 : 1);
    }
    for (int i = 1; i < grid->nx; i += 2) {
        grid->x[i] = (grid->x[i - 1] + grid->x[i + 1]) / 2;
    }
    for (int i = 1; i < grid->ny; i += 2) {
        grid->y[i] = (grid->y[i - 1] + grid->y[i + 1]) / 2;
    }
}

static void quadratic(double s, double value[3], double slope[3])
{
    double v[3] = {s * (s - 1) / 2, 1 - s * s, s * (s + 1) / 2}, d[3] = {s - 0.5, -2 * s, s + 0.5};
    for (int i = 0; i < 3; i++) {
        value[i] = v[i];
        slope[i] = d[i];
    }
}

/* Adds one element to stiffness and mass, [18][18]: node 3 i + j, then component. */
static void plane_element(const struct plane_body *body, double hx, double hy, double K[18][18], double M[18][18])
{
    static const double point[3] = {-0.7745966692414834, 0, 0.7745966692414834},
                        weight[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
    for (int q = 0; q < 9; q++) {
        double X[3], dX[3], Y[3], dY[3], w = weight[q / 3] * weight[q % 3] * hx * hy / 4;
        quadratic(point[q / 3], X, dX);
        quadratic(point[q % 3], Y, dY);
        for (int a = 0; a < 18; a++) {
            double N = X[a / 6] * Y[a / 2 % 3], Nx = dX[a / 6] * 2 / hx * Y[a / 2 % 3],
                   Ny = X[a / 6] * dY[a / 2 % 3] * 2 / hy;
            double xx = a % 2 == 0 ? Nx : 0, yy = a % 2 == 1 ? Ny : 0, xy = a % 2 == 0 ? Ny : Nx;
            for (int b = 0; b < 18; b++) {
                double O = X[b / 6] * Y[b / 2 % 3], Ox = dX[b / 6] * 2 / hx * Y[b / 2 % 3];
                double Oy = X[b / 6] * dY[b / 2 % 3] * 2 / hy;
                double rr = b % 2 == 0 ? Ox : 0, ss = b % 2 == 1 ? Oy : 0, rs = b % 2 == 0 ? Oy : Ox;
                K[a][b] +=
                    w * (body->lambda * (xx + yy) * (rr + ss) + body->mu * (2 * xx * rr + 2 * yy * ss + xy * rs));
                M[a][b] += a % 2 == b % 2 ? w * body->rho * N * O : 0;
            }
        }
    }
}

/* Banded matrices as GSL has them: [unknowns][band + 1], entry (row, column) at (column, row - column). */
static void plane_assemble(const struct plane_body *body, const struct plane_grid *grid, gsl_matrix *K, gsl_matrix *M)
{
    for (int ex = 0; ex + 2 < grid->nx; ex += 2) {
        for (int ey = 0; ey + 2 < grid->ny; ey += 2) {
            double k[18][18] = {{0}}, m[18][18] = {{0}};
            plane_element(body, grid->x[ex + 2] - grid->x[ex], grid->y[ey + 2] - grid->y[ey], k, m);
            for (int a = 0; a < 18; a++) {
                int row = ((ex + a / 6 - 1) * grid->ny + ey + a / 2 % 3) * 2 + a % 2;
                for (int b = 0; b < 18; b++) {
                    int column = ((ex + b / 6 - 1) * grid->ny + ey + b / 2 % 3) * 2 + b % 2;
                    if (column >= 0 && row >= column && ex + a / 6 > 0 && ex + b / 6 > 0) {
                        *gsl_matrix_ptr(K, (size_t)column, (size_t)(row - column)) += k[a][b];
                        *gsl_matrix_ptr(M, (size_t)column, (size_t)(row - column)) += m[a][b];
                    }
                }
            }
        }
    }
}

static void plane_multiply(const gsl_matrix *M, const gsl_vector *x, gsl_vector *out)
{
    gsl_vector_set_zero(out);
    for (size_t column = 0; column < M->size1; column++) {
        for (size_t k = 0; k < M->size2 && column + k < M->size1; k++) {
            double m = gsl_matrix_get(M, column, k);
            *gsl_vector_ptr(out, column + k) += m * gsl_vector_get(x, column);
            *gsl_vector_ptr(out, column) += k > 0 ? m * gsl_vector_get(x, column + k) : 0;
        }
    }
}

/* Lowest frequency [rad/s] with n elements per quarter of the height. */
static double plane_frequency(const struct plane_body *body, int n)
{
    struct plane_grid grid;
    plane_grid_cut(body, n, &grid);
    size_t ny = (size_t)grid.ny, unknowns = 2 * ((size_t)grid.nx - 1) * ny, band = 4 * ny + 6;
    gsl_matrix *K = gsl_matrix_calloc(unknowns, band + 1), *M = gsl_matrix_calloc(unknowns, band + 1);
    gsl_vector *x = gsl_vector_alloc(unknowns), *Mx = gsl_vector_alloc(unknowns);
    double square = 0;
    plane_assemble(body, &grid, K, M);
    for (size_t i = 0; i < unknowns; i++) {
        gsl_vector_set(x, i, i % 2 == 1 ? grid.x[1 + i / 2 / (size_t)grid.ny] : 0);
    }
    (void)gsl_linalg_cholesky_band_decomp(K);
    for (int step = 0; step < 12; step++) {
        double after = 0, work = 0;
        plane_multiply(M, x, Mx);
        (void)gsl_linalg_cholesky_band_solve(K, Mx, x);
        for (size_t i = 0; i < unknowns; i++) {
            work += gsl_vector_get(x, i) * gsl_vector_get(Mx, i);
        }
        plane_multiply(M, x, Mx);
        for (size_t i = 0; i < unknowns; i++) {
            after += gsl_vector_get(x, i) * gsl_vector_get(Mx, i);
        }
        square = work / after;
        gsl_vector_scale(x, 1 / sqrt(after));
    }
    gsl_matrix_free(K);
    gsl_matrix_free(M);
    gsl_vector_free(x);
    gsl_vector_free(Mx);
    return sqrt(square);
}

#endif
