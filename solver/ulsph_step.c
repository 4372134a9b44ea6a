#include "solver/ulsph_step.h"

#include <math.h>

/* As of the total-Lagrangian scheme (upwind_step.c): a particle held by its neighbours alone swings with omega^2 = k
 * / m, k = sum_b V_b (lambda + 2 mu)_b |V_a s L_b r|^2, where kernels reach from a stiff material to a light one faster
 * than waves run in either. On a line of one material omega is c / sqrt(2) over the spacing for neighbours next to one
 * another, where the fastest mode has c. Returns the square root of the largest half mean modulus of neighbours over a
 * particle's own density, over c^2 of the fastest wave, or 1. What is dissipated where materials meet is that of the
 * lighter one (ulsph_dim.c) and asks for nothing. */
double solver_ulsph_step_share(const struct solver_ulsph *work, const struct solver_body *body, double fastest)
{
    size_t dim = (size_t)body->cloud->dim;
    double meeting = 0.0;
    for (size_t a = 0; a < body->cloud->count; a++) {
        double sum = 0.0;
        double weights = 0.0;
        for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
            const double *pair = work->pair + ab * (dim + 2);
            const struct solver_material_constants *of_b = body->constants + work->neighbour[ab] * body->stride;
            double weight = 0.0;
            for (size_t i = 0; i < dim; i++) {
                weight += pair[dim] * pair[dim] * pair[i] * pair[i];
            }
            sum += weight * of_b->zp * of_b->cp;
            weights += weight;
        }
        double rho = body->constants[a * body->stride].rho;
        meeting = weights > 0.0 ? fmax(meeting, sum / (weights * rho)) : meeting;
    }
    return fmax(1.0, sqrt(0.5 * meeting) / fastest);
}
