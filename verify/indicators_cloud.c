/* Indicators that look at the particles where they are now. */
#include "solver/graph.h"
#include "solver/memory.h"
#include "solver/small.h"
#include "verify/indicators.h"

#include <math.h>
#include <stdlib.h>

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

/* --- graded lattices, where one radius does not find the neighbours --- */

/* The neighbours of particle a along the axes and across the faces of a lattice; returns how many. */
static size_t list_sites(const struct solver_cloud *cloud, const uint32_t *particle_at, size_t a, uint32_t *out)
{
    size_t found = 0;
    for (int to = 0; to < 27; to++) {
        const int step[3] = {to % 3 - 1, to / 3 % 3 - 1, to / 9 - 1};
        int steps = abs(step[0]) + abs(step[1]) + abs(step[2]);
        size_t at = 0;
        bool there = steps == 1 || steps == 2;
        for (int axis = 2; axis >= 0; axis--) {
            uint32_t own = axis < cloud->dim ? cloud->site[a * (size_t)cloud->dim + (size_t)axis] : 0;
            int64_t site = (int64_t)own + step[axis];
            there = there && site >= 0 && site < cloud->points[axis];
            at = at * cloud->points[axis] + (size_t)site;
        }
        if (there) {
            out[found++] = particle_at[at];
        }
    }
    return found;
}

/* A graph of them, within which nothing is looked up by number. */
static bool link_sites(const struct solver_cloud *cloud, struct solver_graph *graph, struct solver_error *error)
{
    enum { MOST = 18 };
    size_t dim = (size_t)cloud->dim;
    uint32_t *particle_at = NULL;
    bool made =
        solver_alloc((void **)&particle_at, cloud->count, sizeof *particle_at, "lattice map", error) &&
        solver_alloc((void **)&graph->row, cloud->count + 1, sizeof *graph->row, "neighbours", error) &&
        solver_alloc((void **)&graph->neighbour, cloud->count * MOST, sizeof *graph->neighbour, "neighbours", error);
    for (size_t a = 0; made && a < cloud->count; a++) {
        size_t at = 0;
        for (size_t axis = dim; axis-- > 0;) {
            at = at * cloud->points[axis] + cloud->site[a * dim + axis];
        }
        particle_at[at] = (uint32_t)a;
    }
    for (size_t a = 0; made && a < cloud->count; a++) {
        graph->row[a + 1] = graph->row[a] + list_sites(cloud, particle_at, a, graph->neighbour + graph->row[a]);
    }
    free(particle_at);
    return made;
}

/* Of each pair what is left of the distance that it had, times that of an even lattice, 1 or the root of 2. */
static double closest_sites(const struct solver_cloud *cloud, const struct solver_points *now,
                            const struct solver_graph *graph)
{
    const struct solver_points first = {.dim = cloud->dim, .count = cloud->count, .stride = now->stride, .x = cloud->X};
    double smallest = reach;
    for (size_t a = 0; a < now->count; a++) {
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            size_t b = graph->neighbour[ab];
            double r[3], R[3], axes = 0;
            offset(now, a, b, r);
            offset(&first, a, b, R);
            for (int i = 0; i < 3; i++) {
                axes += R[i] != 0 ? 1 : 0;
            }
            smallest = fmin(smallest, sqrt(axes) * length(r) / length(R));
        }
    }
    return smallest;
}

bool verify_indicators_lattice(const struct solver_cloud *cloud, const struct solver_points *now, const double *V,
                               const double *pressure, double value[VERIFY_INDICATORS], struct solver_error *error)
{
    struct solver_graph graph = {.count = cloud->count};
    bool done = link_sites(cloud, &graph, error);
    if (done) {
        value[VERIFY_CLUMPING] = closest_sites(cloud, now, &graph);
        value[VERIFY_CHECKERBOARD] = checkerboard(now, &graph, V, pressure);
    }
    solver_graph_free(&graph);
    return done;
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
