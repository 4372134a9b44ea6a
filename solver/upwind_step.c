/* What couples faster than the waves of eq. 41 count: where materials meet, and where particles crowd. */
#include "solver/upwind_step.h"

#include <math.h>

/* Where the stencil of a stiff particle reaches a light one its stress moves that one's mass, faster than waves run in
 * either material. A particle held by its neighbours alone swings with omega^2 = k / m, k = sum_b (lambda + 2 mu)_b
 * |C_ab|^2 / 4 V_b. On a line of one material omega h is c / sqrt(2), where the fastest mode has c: so what counts is
 * half the neighbours' mean modulus over a particle's own density. Returns the square root of the largest over c^2 of
 * the fastest wave, or 1, which it is where a particle on the interface, of both sides' mean density and compliance,
 * hides them from each other. */
static double meeting_of(const struct solver_stencil *stencil, const struct solver_material_constants *constants)
{
    double fastest = 0.0;
    double meeting = 0.0;
    for (size_t a = 0; a < stencil->graph.count; a++) {
        double sum = 0.0;
        double weights = 0.0;
        size_t shift = solver_stencil_shift(stencil, a);
        for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
            size_t b = stencil->graph.neighbour[ab];
            const double *C = solver_stencil_C(stencil, ab + shift);
            double weight = 0.0;
            for (int i = 0; i < stencil->dim; i++) {
                weight += C[i] * C[i] / stencil->V[b];
            }
            sum += weight * constants[b].zp * constants[b].cp;
            weights += weight;
        }
        fastest = fmax(fastest, constants[a].cp * constants[a].cp);
        meeting = weights > 0.0 ? fmax(meeting, sum / (weights * constants[a].rho)) : meeting;
    }
    return fmax(1.0, sqrt(0.5 * meeting / fastest));
}

/* What particles that were moved at random share as faces: the areas A_ab = max(0, N_ab . C_ab) of the dissipation sum
 * to 2 dim V_a / h on a lattice, whose particles are h apart, and to more where some are nearer, or where pair vectors
 * point away from their pairs and others make up for it. The fastest decay grows by as much, and the step shrinks: CFL
 * numbers mean on such clouds what they do on lattices. Of a hundred clouds moved by up to 0.45 RK4's limit, by their
 * eigenvalues, times this was 1.02 and more: that of lattices (tests/unit/solver_perturbed.c). At least 1. */
static double crowding_of(const struct solver_stencil *stencil, const struct solver_cloud *cloud)
{
    size_t dim = (size_t)stencil->dim;
    double most = 1.0;
    for (size_t a = 0; a < stencil->graph.count; a++) {
        double area = 0.0;
        size_t shift = solver_stencil_shift(stencil, a);
        for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
            const double *C = solver_stencil_C(stencil, ab + shift);
            double square = 0.0;
            double along = 0.0;
            for (size_t i = 0; i < dim; i++) {
                double d = cloud->X[stencil->graph.neighbour[ab] * dim + i] - cloud->X[a * dim + i];
                square += d * d;
                along += d * C[i];
            }
            area += fmax(0.0, along / sqrt(square));
        }
        most = fmax(most, area * cloud->spacing / (2.0 * (double)dim * stencil->V[a]));
    }
    return most;
}

double solver_upwind_step_share(const struct solver_stencil *stencil, const struct solver_body *body)
{
    double meeting = body->stride != 0 ? meeting_of(stencil, body->constants) : 1.0;
    return body->scene->perturb > 0.0 ? fmax(meeting, crowding_of(stencil, body->cloud)) : meeting;
}
