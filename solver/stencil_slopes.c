/* Slopes for the reconstruction on lattices on which materials meet; graded ones have their own
 * (stencil_slopes_graded.c).
 *
 * The dissipation takes from the body sum A z [v] . (v_b - v_a) over its pairs, [v] = v_b - v_a - (G_a + G_b) d / 2.
 * That is never negative where the matrix from differences to jumps is symmetric, has no positive entries beside its
 * diagonal, and leaves nothing of a linear field, whose differences all have one sign. On a lattice of one material,
 * sbp2, it is so. It is not where a slope takes in what lies across an interface, whose pair does not take it out
 * again. So where a row meets another material, its slope along that axis is that between the nearest neighbours of its
 * own material, and there is none where none is. So it is on short lines too. The rows of sbp4 are wider and have other
 * entries at the ends of lines; by their eigenvalues they feed in nothing there. */
#include "solver/memory.h"
#include "solver/stencil.h"

#include <stdlib.h>

/* Steps of the lattice from a to b along an axis. */
static double steps(const struct solver_cloud *cloud, size_t a, size_t b, size_t axis)
{
    size_t dim = (size_t)cloud->dim;
    return (double)cloud->site[b * dim + axis] - (double)cloud->site[a * dim + axis];
}

/* Lines with fewer points have sbp4's closure with four rows, and no order to lose. */
static const uint32_t fewest = 12;

/* Whether a's row along an axis is taken as it is: all neighbours are of its material, and the line is long. */
static bool is_within(const struct solver_stencil *stencil, const struct solver_cloud *cloud,
                      const struct solver_material_constants *constants, size_t a, size_t axis)
{
    if (cloud->points[axis] < fewest) {
        return false;
    }
    for (size_t ab = stencil->graph.row[a]; constants != NULL && ab < stencil->graph.row[a + 1]; ab++) {
        size_t b = stencil->graph.neighbour[ab];
        if (steps(cloud, a, b, axis) != 0.0 && !solver_material_same(&constants[a], &constants[b])) {
            return false;
        }
    }
    return true;
}

/* What a pair has in the slope along an axis, up to a factor of the particle: what it has in the stencil's gradient, or
 * in the mean of neighbours weighed by areas A. */
static double share(const struct solver_stencil *stencil, const struct solver_cloud *cloud,
                    const struct solver_material_constants *constants, size_t a, size_t ab, size_t axis, bool within)
{
    size_t b = stencil->graph.neighbour[ab];
    const double *C = solver_stencil_C(stencil, ab);
    double d = steps(cloud, a, b, axis);
    bool alike = constants == NULL || solver_material_same(&constants[a], &constants[b]);
    return d == 0.0 || !alike ? 0.0 : within ? C[axis] : C[stencil->dim] * d;
}

/* Slopes of particle a along an axis. */
static void add_slope(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                      const struct solver_material_constants *constants, size_t a, size_t axis)
{
    size_t dim = (size_t)stencil->dim;
    bool within = is_within(stencil, cloud, constants, a, axis);
    double sum = 0.0;
    for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
        double d = cloud->X[stencil->graph.neighbour[ab] * dim + axis] - cloud->X[a * dim + axis];
        sum += share(stencil, cloud, constants, a, ab, axis, within) * d;
    }
    for (size_t ab = stencil->graph.row[a]; sum > 0.0 && ab < stencil->graph.row[a + 1]; ab++) {
        stencil->least_squares[ab * dim + axis] = share(stencil, cloud, constants, a, ab, axis, within) / sum;
    }
}

bool solver_stencil_add_lattice_slopes(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                                       const struct solver_material_constants *constants, struct solver_error *error)
{
    size_t dim = (size_t)stencil->dim;
    if (solver_cloud_graded(cloud)) {
        return solver_stencil_add_graded_slopes(stencil, cloud, constants, error);
    }
    if (!solver_alloc((void **)&stencil->least_squares, stencil->pairs * dim, sizeof(double), "slopes of lattices",
                      error)) {
        return false;
    }
    for (size_t a = 0; a < stencil->count; a++) {
        for (size_t axis = 0; axis < dim; axis++) {
            add_slope(stencil, cloud, constants, a, axis);
        }
    }
    return true;
}
