/* Indicators that look at the particles where they are now. */
#include "solver/graph.h"
#include "solver/small.h"
#include "verify/indicators.h"

#include <math.h>

/* Neighbours within this many spacings: on a lattice those along the axes and across the faces. */
static const double reach = 1.5;
/* Where the neighbours' centre lies this part of their mean distance aside, a side is missing. */
static const double one_sided = 0.25;

/* Of the neighbours of one particle: weight, centre and mean pressure relative to the particle. */
struct around {
    double weight, centre[3], distance, pressure;
};

static void offset(const struct solver_points *now, size_t a, size_t b, double r[3])
{
    r[0] = r[1] = r[2] = 0;
    for (int i = 0; i < now->dim; i++) {
        r[i] = now->x[b * now->stride + (size_t)i] - now->x[a * now->stride + (size_t)i];
    }
}

static double length(const double r[3])
{
    return sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
}

static struct around look_around(const struct solver_points *now, const struct solver_graph *graph, const double *V,
                                 const double *pressure, size_t a)
{
    struct around all = {.weight = 0};
    for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
        size_t b = graph->neighbour[ab];
        double r[3];
        offset(now, a, b, r);
        all.weight += V[b];
        all.distance += V[b] * length(r);
        all.pressure += V[b] * (pressure[b] - pressure[a]);
        for (int i = 0; i < 3; i++) {
            all.centre[i] += V[b] * r[i];
        }
    }
    if (all.weight == 0) {
        return all;
    }
    for (int i = 0; i < 3; i++) {
        all.centre[i] /= all.weight;
    }
    all.distance /= all.weight;
    all.pressure /= all.weight;
    return all;
}

/* What the plane through the neighbours' pressures, by least squares, says at the particle, less its own. False if they
 * define no plane. */
static bool departure(const struct solver_points *now, const struct solver_graph *graph, const double *V,
                      const double *pressure, size_t a, const struct around *all, double *out)
{
    double A[4][4] = {{0}}, slope[4] = {0};
    for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
        size_t b = graph->neighbour[ab];
        double r[3];
        offset(now, a, b, r);
        for (int i = 0; i < now->dim; i++) {
            slope[i] += V[b] * (r[i] - all->centre[i]) * (pressure[b] - pressure[a] - all->pressure);
            for (int j = 0; j < now->dim; j++) {
                A[i][j] += V[b] * (r[i] - all->centre[i]) * (r[j] - all->centre[j]);
            }
        }
    }
    *out = all->pressure;
    if (!solver_small_solve((size_t)now->dim, A, slope)) {
        return false;
    }
    for (int i = 0; i < now->dim; i++) {
        *out -= slope[i] * all->centre[i];
    }
    return true;
}

static double checkerboard(const struct solver_points *now, const struct solver_graph *graph, const double *V,
                           const double *pressure)
{
    double departures = 0, pressures = 0;
    for (size_t a = 0; a < now->count; a++) {
        struct around all = look_around(now, graph, V, pressure, a);
        double d;
        if (all.weight > 0 && length(all.centre) <= one_sided * all.distance &&
            departure(now, graph, V, pressure, a, &all, &d)) {
            departures += V[a] * d * d;
            pressures += V[a] * pressure[a] * pressure[a];
        }
    }
    return pressures > 0 ? sqrt(departures / pressures) : NAN;
}

static double closest(const struct solver_points *now, const struct solver_graph *graph, double spacing)
{
    double smallest = reach;
    for (size_t a = 0; a < now->count; a++) {
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            double r[3];
            offset(now, a, graph->neighbour[ab], r);
            smallest = fmin(smallest, length(r) / spacing);
        }
    }
    return smallest;
}

bool verify_indicators_cloud(const struct solver_points *now, const double *V, const double *pressure, double spacing,
                             double value[VERIFY_INDICATORS], struct solver_error *error)
{
    struct solver_graph graph = {.count = 0};
    bool done = solver_graph_update(&graph, now, SOLVER_PAIRS_WITHIN, reach * spacing, error);
    if (done) {
        value[VERIFY_CLUMPING] = closest(now, &graph, spacing);
        value[VERIFY_CHECKERBOARD] = checkerboard(now, &graph, V, pressure);
    }
    solver_graph_free(&graph);
    return done;
}
