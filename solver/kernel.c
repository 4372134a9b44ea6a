#include "solver/kernel.h"

#include "solver/small.h"

#include <math.h>

double solver_kernel(double q, double *derivative)
{
    if (q >= 2.0) {
        *derivative = 0.0;
        return 0.0;
    }
    *derivative = 3.0 / 8.0 * q - 3.0 / 4.0;
    return 3.0 / 16.0 * q * q - 3.0 / 4.0 * q + 3.0 / 4.0;
}

/* W_b(X_a) and its gradient with respect to X_a; zero along axes that the cloud does not have. */
static double kernel_at(const struct solver_cloud *cloud, size_t a, size_t b, double radius, double gradient[3])
{
    size_t dim = (size_t)cloud->dim;
    double h = 0.5 * radius;
    double d[3] = {0};
    double square = 0.0;
    double slope;
    for (size_t axis = 0; axis < dim; axis++) {
        d[axis] = cloud->X[a * dim + axis] - cloud->X[b * dim + axis];
        square += d[axis] * d[axis];
    }
    double distance = sqrt(square);
    double value = solver_kernel(distance / h, &slope);
    for (size_t axis = 0; axis < 3; axis++) {
        gradient[axis] = distance > 0.0 ? slope / h * d[axis] / distance : 0.0;
    }
    return value;
}

/* Constant correction: sum_b V_b W_b and its gradient, the particle itself included. */
static double shepard(const struct solver_cloud *cloud, const struct solver_graph *graph, size_t a, double radius,
                      const double *volume, double gradient[3])
{
    double at_centre;
    double sum = (volume != NULL ? volume[a] : 1.0) * solver_kernel(0.0, &at_centre);
    gradient[0] = gradient[1] = gradient[2] = 0.0;
    for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
        size_t b = graph->neighbour[ab];
        double V = volume != NULL ? volume[b] : 1.0;
        double slope[3];
        sum += V * kernel_at(cloud, a, b, radius, slope);
        for (size_t axis = 0; axis < 3; axis++) {
            gradient[axis] += V * slope[axis];
        }
    }
    return sum;
}

bool solver_kernel_gradients(const struct solver_cloud *cloud, const struct solver_graph *graph, double radius,
                             const double *volume, double *gradient, struct solver_error *error)
{
    size_t dim = (size_t)cloud->dim;
    for (size_t a = 0; a < cloud->count; a++) {
        double sum_gradient[3];
        double sum = shepard(cloud, graph, a, radius, volume, sum_gradient);
        double moment[4][4] = {{0}};
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            size_t b = graph->neighbour[ab];
            double V = volume != NULL ? volume[b] : 1.0;
            double slope[3];
            double W = kernel_at(cloud, a, b, radius, slope);
            for (size_t j = 0; j < dim; j++) {
                double corrected = V * (slope[j] / sum - W * sum_gradient[j] / (sum * sum));
                gradient[ab * dim + j] = corrected;
                for (size_t i = 0; i < dim; i++) {
                    moment[j][i] += corrected * (cloud->X[b * dim + i] - cloud->X[a * dim + i]);
                }
            }
        }
        /* sum_b (X_b - X_a)_i g_j = delta_ij: g = M^-1 g~ with M_ji = sum_b g~_j (X_b - X_a)_i */
        if (!solver_small_invert(dim, moment)) {
            return solver_fail(error, SOLVER_BAD_INPUT,
                               "support: particle %zu at (%g, %g, %g) m has too few neighbours (%zu) for a linear "
                               "gradient; choose a larger support",
                               a, cloud->X[a * dim], dim > 1 ? cloud->X[a * dim + 1] : 0.0,
                               dim > 2 ? cloud->X[a * dim + 2] : 0.0, graph->row[a + 1] - graph->row[a]);
        }
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            double raw[3] = {0};
            for (size_t j = 0; j < dim; j++) {
                raw[j] = gradient[ab * dim + j];
            }
            for (size_t i = 0; i < dim; i++) {
                gradient[ab * dim + i] = 0.0;
                for (size_t j = 0; j < dim; j++) {
                    gradient[ab * dim + i] += moment[i][j] * raw[j];
                }
            }
        }
    }
    return true;
}
