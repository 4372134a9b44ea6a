#include "oracles/axis.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void axis_number(struct axis *axis)
{
    axis->first[0] = 0;
    for (int e = 0; e < axis->elements; e++) {
        axis->first[e + 1] = axis->first[e] + axis->degree[e];
    }
    axis->functions = axis->first[axis->elements] + 1;
}

int axis_element(const struct axis *axis, double x)
{
    int e = 0;
    while (e < axis->elements - 1 && x >= axis->node[e + 1]) {
        e++;
    }
    return e;
}

struct axis_function axis_function(const struct axis *axis, int function)
{
    int e = 0;
    while (e < axis->elements && function >= axis->first[e + 1]) {
        e++;
    }
    bool at_node = function == axis->first[e];
    return (struct axis_function){.order = at_node ? 1 : function - axis->first[e] + 1,
                                  .begin = at_node && e > 0 ? e - 1 : e,
                                  .end = e < axis->elements ? e + 1 : e};
}

bool axis_coupled(const struct axis *axis, int a, int b)
{
    struct axis_function f = axis_function(axis, a), g = axis_function(axis, b);
    return f.begin < g.end && g.begin < f.end && abs(f.order - g.order) <= 2;
}

void axis_evaluate(const struct axis *axis, int element, double x, double value[AXIS_DEGREE + 1],
                   double slope[AXIS_DEGREE + 1])
{
    double left = axis->node[element], half = (axis->node[element + 1] - left) / 2, xi = (x - left) / half - 1;
    int degree = axis->degree[element];
    double before = 1, legendre = xi; /* P_(k-2), P_(k-1) */
    value[0] = (1 - xi) / 2;
    slope[0] = -0.5 / half;
    for (int k = 2; k <= degree; k++) {
        double next = ((2 * k - 1) * xi * legendre - (k - 1) * before) / k;
        value[k - 1] = (next - before) / sqrt(2.0 * (2 * k - 1));
        slope[k - 1] = sqrt((2 * k - 1) / 2.0) * legendre / half;
        before = legendre;
        legendre = next;
    }
    value[degree] = (1 + xi) / 2;
    slope[degree] = 0.5 / half;
}

/* Values and derivatives of all functions, those of nested nodes in place of the local ones. */
static void evaluate_all(const struct axis *axis, int element, double x, double *value, double *slope)
{
    double end = axis->node[axis->elements], whole = end - axis->node[0];
    memset(value, 0, (size_t)axis->functions * sizeof *value);
    memset(slope, 0, (size_t)axis->functions * sizeof *slope);
    axis_evaluate(axis, element, x, value + axis->first[element], slope + axis->first[element]);
    for (int k = 0; axis->nested && k <= element; k++) {
        value[axis->first[k]] = (end - x) / (end - axis->node[k]);
        slope[axis->first[k]] = -1 / (end - axis->node[k]);
    }
    if (axis->nested) {
        value[axis->functions - 1] = (x - axis->node[0]) / whole;
        slope[axis->functions - 1] = 1 / whole;
    }
}

void axis_unnest(const struct axis *axis, double *coefficient)
{
    double end = axis->node[axis->elements], whole = end - axis->node[0], last = coefficient[axis->functions - 1];
    for (int k = axis->elements - 1; k >= 0; k--) {
        double at = (axis->node[k] - axis->node[0]) / whole * last;
        for (int j = 0; j <= k; j++) {
            at += (end - axis->node[k]) / (end - axis->node[j]) * coefficient[axis->first[j]];
        }
        coefficient[axis->first[k]] = at;
    }
}

static bool add_element(const struct axis *axis, int element, struct axis_matrices *to)
{
    size_t points = (size_t)axis->degree[element] + 1, n = (size_t)axis->functions;
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(points);
    double *value = malloc(2 * n * sizeof *value), *slope = value + n;
    bool done = rule != NULL && value != NULL;
    for (size_t q = 0; done && q < points; q++) {
        double x, weight;
        (void)gsl_integration_glfixed_point(axis->node[element], axis->node[element + 1], q, &x, &weight, rule);
        evaluate_all(axis, element, x, value, slope);
        for (size_t a = 0; a < n; a++) {
            for (size_t b = 0; b < n; b++) {
                to->mass[a * n + b] += weight * value[a] * value[b];
                to->stiffness[a * n + b] += weight * slope[a] * slope[b];
                to->mixed[a * n + b] += weight * value[a] * slope[b];
            }
        }
    }
    if (rule != NULL) {
        gsl_integration_glfixed_table_free(rule);
    }
    free(value);
    return done;
}

bool axis_integrate(const struct axis *axis, struct axis_matrices *matrices)
{
    size_t size = (size_t)axis->functions * (size_t)axis->functions;
    *matrices = (struct axis_matrices){.mass = calloc(size, sizeof(double)),
                                       .stiffness = calloc(size, sizeof(double)),
                                       .mixed = calloc(size, sizeof(double))};
    bool done = matrices->mass != NULL && matrices->stiffness != NULL && matrices->mixed != NULL;
    for (int e = 0; done && e < axis->elements; e++) {
        done = add_element(axis, e, matrices);
    }
    if (!done) {
        axis_free(matrices);
    }
    return done;
}

void axis_free(struct axis_matrices *matrices)
{
    free(matrices->mass);
    free(matrices->stiffness);
    free(matrices->mixed);
    *matrices = (struct axis_matrices){0};
}
