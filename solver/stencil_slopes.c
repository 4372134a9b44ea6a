/* Slopes for the reconstruction on lattices whose spacings change, or on which materials meet.
 *
 * The dissipation takes from the body sum A z [v] . (v_b - v_a) over its pairs, [v] = v_b - v_a - (G_a + G_b) . d / 2.
 * On an even lattice of one material that is never negative, as the slopes of either particle stand in the jumps of
 * both of its sides with the same weight. It may be negative where slopes by X go with distances d that are unlike on
 * both sides; and where that of a particle takes in what lies across an interface, whose pair does not take out what
 * this puts into the one behind it. So
 * - slopes and distances are those in the lattice's own coordinate, whose steps are even: what jumps is then what would
 *   on an even lattice, to the same order;
 * - where a row meets another material, its slope along that axis is that of least squares between the nearest
 *   neighbours of its own material, weighed by the areas A of the dissipation. With these weights alone the sum is never
 *   negative, since sum_b A d (v_b - v_a) G_a is the square of the fit, and at most that of what is fitted; there is no
 *   slope where no neighbour is alike. */
#include "solver/memory.h"
#include "solver/stencil.h"

/* Steps of the lattice from a to b along an axis. */
static double steps(const struct solver_cloud *cloud, size_t a, size_t b, size_t axis)
{
    size_t dim = (size_t)cloud->dim;
    return (double)cloud->site[b * dim + axis] - (double)cloud->site[a * dim + axis];
}

/* Whether all neighbours of a along an axis are of its material. */
static bool is_within(const struct solver_stencil *stencil, const struct solver_cloud *cloud,
                      const struct solver_material_constants *constants, size_t a, size_t axis)
{
    for (size_t ab = stencil->graph.row[a]; constants != NULL && ab < stencil->graph.row[a + 1]; ab++) {
        size_t b = stencil->graph.neighbour[ab];
        if (steps(cloud, a, b, axis) != 0.0 && !solver_material_same(&constants[a], &constants[b])) {
            return false;
        }
    }
    return true;
}

/* What a pair has in the sum of differences along an axis, before these are made exact for the coordinate: that of the
 * stencil, or that of least squares. */
static double share(const struct solver_stencil *stencil, const struct solver_cloud *cloud,
                    const struct solver_material_constants *constants, size_t a, size_t ab, size_t axis, bool within)
{
    size_t b = stencil->graph.neighbour[ab];
    const double *C = solver_stencil_C(stencil, ab);
    double d = steps(cloud, a, b, axis);
    bool alike = within || solver_material_same(&constants[a], &constants[b]);
    return d == 0.0 || !alike ? 0.0 : within ? C[axis] : C[stencil->dim] * d;
}

bool solver_stencil_add_lattice_slopes(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                                       const struct solver_material_constants *constants, struct solver_error *error)
{
    size_t dim = (size_t)stencil->dim;
    if (!solver_alloc((void **)&stencil->least_squares, stencil->pairs * dim, sizeof(double), "slopes of lattices",
                      error)) {
        return false;
    }
    for (size_t i = 0; i < stencil->count * dim; i++) {
        size_t a = i / dim;
        size_t axis = i % dim;
        bool within = is_within(stencil, cloud, constants, a, axis);
        double sum = 0.0;
        for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
            double d = steps(cloud, a, stencil->graph.neighbour[ab], axis);
            sum += share(stencil, cloud, constants, a, ab, axis, within) * d;
        }
        for (size_t ab = stencil->graph.row[a]; sum > 0.0 && ab < stencil->graph.row[a + 1]; ab++) {
            stencil->least_squares[ab * dim + axis] =
                share(stencil, cloud, constants, a, ab, axis, within) / (sum * cloud->spacing);
        }
    }
    return true;
}
