/* Rings: concentric layers of particles (001_363f711843f01da4.txt, section 4.4).
 *
 * A layer has one spacing of the thickness and particles in its middle, evenly around and about a spacing apart: a
 * whole number of them in each quarter, the nearest, so that the ring is its own mirror image. The paper's two rings
 * have 4386 particles at a spacing of 1 mm, 2193 each, an odd number that no mirror image allows; whole quarters give
 * 2196, the nearest even numbers for whole layers 2200, those below 2188, and 2 pi r over the spacing, rounded down,
 * 2194. (Its 0.03 m and 0.04 m must be radii, as in the test by Gray et al. that it repeats: were they diameters, two
 * rings would have an area of 1100 squares of a spacing.) */
#include "solver/cloud_internal.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

static size_t layers_of(const struct solver_shape *ring, double spacing)
{
    return (size_t)lround((ring->outer - ring->inner) / spacing);
}

/* Radii of a layer's inner border for `layer`, and its outer one for layer + 1. */
static double border(const struct solver_shape *ring, size_t layers, size_t layer)
{
    double along = (double)layer / (double)layers;
    return ring->inner * (1.0 - along) + ring->outer * along;
}

/* Particles in a quarter of a layer. */
static size_t quarter(const struct solver_shape *ring, double spacing, size_t layer)
{
    size_t layers = layers_of(ring, spacing);
    double radius = 0.5 * (border(ring, layers, layer) + border(ring, layers, layer + 1));
    return (size_t)lround(fmax(1.0, 0.5 * pi * radius / spacing));
}

bool cloud_ring_size(const struct solver_shape *ring, double spacing, struct cloud_size *size,
                     struct solver_error *error)
{
    double thickness = ring->outer - ring->inner;
    double spacings = thickness / spacing;
    if (!(ring->inner > 0.0) || !(thickness > 0.0) || !isfinite(ring->centre[0]) || !isfinite(ring->centre[1])) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "ring: radii %g m and %g m; expected 0 < inner < outer, and a centre that is finite",
                           ring->inner, ring->outer);
    }
    if (!(fabs(spacings - round(spacings)) <= 1e-6) || spacings < 1.5) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "ring: a thickness of %g m is %g spacings of %g m; expected a whole number, two or more",
                           thickness, spacings, spacing);
    }
    if (pi * (ring->outer + ring->inner) / spacing * spacings > 0x1p30) {
        return solver_fail(error, SOLVER_BAD_INPUT, "n: a ring of more than 2^30 particles; choose a smaller n");
    }
    *size = (struct cloud_size){0};
    for (size_t layer = 0; layer < layers_of(ring, spacing); layer++) {
        size->particles += 4 * quarter(ring, spacing, layer);
        size->cells += layer > 0 ? 4 * quarter(ring, spacing, layer) : 0;
    }
    return true;
}

/* A layer's particles counterclockwise from the positive x-axis, on which there is none. Those of the first quarter are
 * computed and the others are their mirror images, to the bit. */
static void fill_layer(struct solver_cloud *cloud, const struct solver_shape *ring, size_t layer, size_t first)
{
    size_t layers = layers_of(ring, cloud->spacing);
    size_t count = quarter(ring, cloud->spacing, layer);
    double inside = border(ring, layers, layer);
    double outside = border(ring, layers, layer + 1);
    double radius = 0.5 * (inside + outside);
    double V = 0.25 * pi * (outside - inside) * (outside + inside) / (double)count;
    for (size_t i = 0; i < count; i++) {
        double angle = 0.5 * pi * ((double)i + 0.5) / (double)count;
        double x = radius * cos(angle);
        double y = radius * sin(angle);
        const double at[4][2] = {{x, y}, {-x, y}, {-x, -y}, {x, -y}};
        const size_t place[4] = {i, 2 * count - 1 - i, 2 * count + i, 4 * count - 1 - i};
        for (size_t image = 0; image < 4; image++) {
            size_t a = first + place[image];
            cloud->X[2 * a] = ring->centre[0] + at[image][0];
            cloud->X[2 * a + 1] = ring->centre[1] + at[image][1];
            cloud->V[a] = V;
        }
    }
}

/* Cells between a layer of `inside` particles and the next one of `outside`, which are as many or more: one for each
 * step around the outer layer, from and to the nearest inner particles, which are one step apart or the same. */
static void join_layers(uint32_t *cell, size_t first_inside, size_t inside, size_t first_outside, size_t outside)
{
    for (size_t j = 0; j < outside; j++) {
        size_t next = (j + 1) % outside;
        size_t near = (2 * j + 1) * inside / (2 * outside); /* the particle in whose share of the circle j lies */
        size_t near_next = (2 * next + 1) * inside / (2 * outside);
        cell[4 * j] = (uint32_t)(first_inside + near);
        cell[4 * j + 1] = (uint32_t)(first_outside + j);
        cell[4 * j + 2] = (uint32_t)(first_outside + next);
        cell[4 * j + 3] = (uint32_t)(first_inside + near_next);
    }
}

void cloud_ring_fill(struct solver_cloud *cloud, const struct solver_shape *ring, struct cloud_size from)
{
    size_t layers = layers_of(ring, cloud->spacing);
    size_t first = from.particles;
    uint32_t *cell = cloud->cell + 4 * from.cells;
    for (size_t layer = 0; layer < layers; layer++) {
        size_t count = 4 * quarter(ring, cloud->spacing, layer);
        size_t inside = layer > 0 ? 4 * quarter(ring, cloud->spacing, layer - 1) : 0;
        fill_layer(cloud, ring, layer, first);
        if (layer > 0) {
            join_layers(cell, first - inside, inside, first, count);
            cell += 4 * count;
        }
        first += count;
    }
}
