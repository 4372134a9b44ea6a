#include "solver/ulsph_step.h"

#include "solver/meeting.h"

/* What the weights are taken of: pairs of numbers that follow one another. */
struct pairs {
    const double *pair;
    size_t dim;
};

/* Of k = sum_b V_b (lambda + 2 mu)_b |V_a s L_b r|^2. */
static double meeting_weight(const void *context, size_t a, size_t ab)
{
    const struct pairs *pairs = context;
    const double *pair = pairs->pair + ab * (pairs->dim + 2);
    double square = 0.0;
    (void)a;
    for (size_t i = 0; i < pairs->dim; i++) {
        square += pair[i] * pair[i];
    }
    return pair[pairs->dim] * pair[pairs->dim] * square;
}

/* What is dissipated where materials meet is that of the lighter one (ulsph_dim.c) and asks for nothing. */
double solver_ulsph_step_share(const struct solver_ulsph *work, const struct solver_body *body)
{
    struct pairs pairs = {work->pair, (size_t)body->cloud->dim};
    return solver_meeting_share(body, work->row, work->neighbour, meeting_weight, &pairs);
}
