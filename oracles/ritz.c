#include "oracles/ritz.h"
#include "oracles/ritz_system.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void append(struct axis *axis, double node, int degree)
{
    axis->degree[axis->elements] = degree;
    axis->node[++axis->elements] = node;
}

static void cut_length(double length, int mode, const struct ritz_mesh *mesh, struct axis *x)
{
    double tip[AXIS_ELEMENTS], half_wave = length / (mode - 0.5);
    int tips = 0;
    for (int k = 0; k <= mesh->layers; k++) {
        append(x, pow(mesh->grading, mesh->layers - k), mesh->corner + k);
    }
    for (int k = mesh->tip_layers; k >= 1; k--) {
        tip[tips++] = length - pow(mesh->grading, k);
    }
    double at = 1, size = 1;
    while (at + 0.6 * size < length / 2) {
        tip[tips++] = length - at;
        if (at > 1) {
            append(x, at, mesh->middle);
        }
        at += size;
        size = fmin(size * mesh->growth, half_wave);
    }
    append(x, length / 2, mesh->middle);
    while (tips > 0) {
        append(x, tip[--tips], mesh->middle);
    }
    append(x, length, mesh->middle);
}

static void cut_height(const struct ritz_mesh *mesh, struct axis *y)
{
    for (int k = mesh->layers; k >= 0; k--) {
        append(y, k > 0 ? 1 - pow(mesh->grading, mesh->layers + 1 - k) : 1, mesh->corner + k);
    }
}

static void cut(const struct ritz_problem *problem, const struct ritz_mesh *mesh, struct ritz_mode *mode)
{
    cut_length(problem->length, problem->mode, mesh, &mode->x);
    cut_height(mesh, &mode->y);
    mode->y.nested = true;
    axis_number(&mode->x);
    axis_number(&mode->y);
}

/* Coefficients in the order of the functions, scaled to u_y = 1 at the tip: there only one product is not zero. */
static void store(const struct ritz_system *s, const struct ritz_subspace *space, size_t wanted, struct ritz_mode *mode)
{
    int m = s->y->functions;
    const double *z = space->vector + wanted * s->unknowns;
    size_t tip;
    (void)ritz_system_unknown(s, s->x->functions - 1, 1, 0, &tip);
    for (int a = 0; a < s->x->functions; a++) {
        for (int c = 0; c < 2; c++) {
            for (int j = 0; j < m; j++) {
                size_t at;
                mode->shape[(a * 2 + c) * m + j] = ritz_system_unknown(s, a, c, j, &at) ? z[at] / z[tip] : 0;
            }
            axis_unnest(s->y, mode->shape + (a * 2 + c) * m);
        }
    }
    mode->frequency = sqrt(space->square[wanted]);
    mode->mass = 2 / (z[tip] * z[tip]); /* half the body has z^T M z = 1 */
    mode->unknowns = s->unknowns;
}

bool ritz_solve(const struct ritz_problem *problem, const struct ritz_mesh *mesh, struct ritz_mode *mode,
                char why[ORACLE_WHY])
{
    struct ritz_system system = {0};
    struct ritz_subspace space = {0};
    size_t wanted = (size_t)(problem->mode - 1);
    *mode = (struct ritz_mode){0};
    cut(problem, mesh, mode);
    mode->shape = malloc((size_t)(2 * mode->x.functions * mode->y.functions) * sizeof(double));
    bool solved = mode->shape != NULL && ritz_system_create(&system, &mode->x, &mode->y, problem->lambda) &&
                  ritz_subspace_find(&system, wanted, &space);
    if (solved) {
        store(&system, &space, wanted, mode);
    } else {
        (void)snprintf(
            why, ORACLE_WHY,
            "mode %d of a beam %g half heights long: the method of Ritz with %zu unknowns does not converge, or "
            "there is no memory for it; try a lower mode or a shorter beam",
            problem->mode, problem->length, system.unknowns);
        ritz_free(mode);
    }
    ritz_subspace_free(&space);
    ritz_system_free(&system);
    return solved;
}

/* Aitken: the limit of a sequence whose differences fall geometrically. */
static double limit(const double w[3])
{
    double before = w[0] - w[1], after = w[1] - w[2];
    return before != after ? w[2] - after / (before - after) * after : w[2];
}

/* What the factor of A cannot resolve: frequencies of long waves are small differences of large stiffnesses. */
static double round_off(double frequency)
{
    return 8 * DBL_EPSILON / (frequency * frequency);
}

bool ritz_converge(const struct ritz_problem *problem, const struct ritz_mesh *mesh, struct ritz_limit *result,
                   char why[ORACLE_WHY])
{
    enum { LEVELS = 4 };
    double w[LEVELS];
    struct ritz_mesh at = *mesh;
    *result = (struct ritz_limit){0};
    for (int level = 0; level < LEVELS; level++) {
        ritz_free(&result->mode);
        at.layers = mesh->layers - LEVELS + 1 + level;
        if (!ritz_solve(problem, &at, &result->mode, why)) {
            return false;
        }
        w[level] = result->mode.frequency;
    }
    result->frequency = limit(w + 1);
    result->uncertainty = fabs(limit(w) / result->frequency - 1) + 0.1 * fabs(w[LEVELS - 1] / result->frequency - 1) +
                          round_off(result->frequency);
    return true;
}

void ritz_free(struct ritz_mode *mode)
{
    free(mode->shape);
    *mode = (struct ritz_mode){0};
}

void ritz_evaluate(const struct ritz_mode *mode, double x, double y, double u[2], double gradient[4])
{
    int ex = axis_element(&mode->x, x), ey = axis_element(&mode->y, fabs(y)), m = mode->y.functions;
    double f[AXIS_DEGREE + 1], df[AXIS_DEGREE + 1], g[AXIS_DEGREE + 1], dg[AXIS_DEGREE + 1];
    axis_evaluate(&mode->x, ex, x, f, df);
    axis_evaluate(&mode->y, ey, fabs(y), g, dg);
    for (int c = 0; c < 2; c++) {
        double value = 0, along_x = 0, along_y = 0;
        for (int a = 0; a <= mode->x.degree[ex]; a++) {
            const double *shape = mode->shape + ((mode->x.first[ex] + a) * 2 + c) * m + mode->y.first[ey];
            double at = 0, slope = 0;
            for (int j = 0; j <= mode->y.degree[ey]; j++) {
                at += shape[j] * g[j];
                slope += shape[j] * dg[j];
            }
            value += f[a] * at;
            along_x += df[a] * at;
            along_y += f[a] * slope;
        }
        double mirror = c == 0 && y < 0 ? -1 : 1; /* u_x is odd, u_y even */
        u[c] = mirror * value;
        gradient[2 * c] = mirror * along_x;
        gradient[2 * c + 1] = (y < 0 ? -mirror : mirror) * along_y;
    }
}
