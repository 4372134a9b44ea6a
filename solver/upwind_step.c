/* What couples faster than the waves of eq. 41 count: where materials meet, and where particles crowd. */
#include "solver/upwind_step.h"

#include "solver/meeting.h"
#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>

/* Of k = sum_b (lambda + 2 mu)_b |C_ab|^2 / 4 V_b. */
static double meeting_weight(const void *context, size_t a, size_t ab)
{
    const struct solver_stencil *stencil = context;
    const double *C = solver_stencil_C(stencil, ab + solver_stencil_shift(stencil, a));
    double square = 0.0;
    for (int i = 0; i < stencil->dim; i++) {
        square += C[i] * C[i];
    }
    return square / stencil->V[stencil->graph.neighbour[ab]];
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

/* With it no pair has a faster wave over a smaller spacing than either of its particles is counted with: the operator's
 * norm is at most that of its largest row, and a row knows neighbours alone. */
static double finest_near(const struct solver_stencil *stencil, size_t a)
{
    double least = stencil->fine[a];
    for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
        least = fmin(least, stencil->fine[stencil->graph.neighbour[ab]]);
    }
    return least;
}

bool solver_upwind_pace(struct solver_stencil *stencil, const struct solver_body *body,
                        struct solver_material_constants **paced, struct solver_error *error)
{
    size_t count = stencil->count;
    if (stencil->fine == NULL) {
        return true;
    }
    if (!solver_alloc((void **)paced, count, sizeof **paced, "constants that steps go by", error)) {
        return false;
    }
    for (size_t a = 0; a < count; a++) {
        struct solver_material_constants *of_a = *paced + a;
        double times = finest_near(stencil, a) / stencil->finest;
        *of_a = body->constants[a * body->stride];
        of_a->rho *= times * times;
        of_a->cp /= times;
        of_a->cs /= times;
        of_a->zp *= times;
        of_a->zs *= times;
    }
    free(stencil->fine);
    stencil->fine = NULL;
    return true;
}

double solver_upwind_step_share(const struct solver_stencil *stencil, const struct solver_body *body)
{
    const struct solver_graph *graph = &stencil->graph;
    bool composite = body->stride != 0;
    double meeting =
        composite ? solver_meeting_share(body, graph->row, graph->neighbour, meeting_weight, stencil) : 1.0;
    return body->scene->perturb > 0.0 ? fmax(meeting, crowding_of(stencil, body->cloud)) : meeting;
}
