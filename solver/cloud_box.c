/* Boxes: particles on a lattice, on the faces of its cells or in their centres, and the walls beyond its faces. */
#include "solver/cloud_internal.h"
#include "solver/cloud_moments.h"
#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Along each axis. Without walls the body has all points. */
struct lattice {
    uint32_t cells[3];  /* of the body */
    uint32_t first[3];  /* point of the body */
    uint32_t body[3];   /* points of the body */
    uint32_t points[3]; /* with walls */
};

/* SplitMix64 (Steele, Lea, Flood 2014): the shift of a particle depends on seed, site and axis alone, not on the order
 * in which particles are made. */
static double uniform(uint64_t seed, uint64_t site_code, uint64_t axis)
{
    uint64_t z = seed * 0x9e3779b97f4a7c15U + (site_code * 3U + axis + 1U) * 0xbf58476d1ce4e5b9U;
    for (int round = 0; round < 2; round++) {
        z += 0x9e3779b97f4a7c15U;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
        z ^= z >> 31;
    }
    return 2.0 * (double)(z >> 11) * 0x1p-53 - 1.0;
}

static bool check_box(const struct solver_box *box, struct solver_error *error)
{
    if (box->dim < 1 || box->dim > 3) {
        return solver_fail(error, SOLVER_BAD_INPUT, "dim = %d; expected 1, 2 or 3", box->dim);
    }
    if (!(box->spacing > 0.0) || !isfinite(box->spacing)) {
        return solver_fail(error, SOLVER_BAD_INPUT, "domain: a spacing of %g m; expected a positive length",
                           box->spacing);
    }
    if (!(box->perturb >= 0.0 && box->perturb < 0.5)) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "perturb = %g; expected a number from 0 to less than 0.5, so that neighbours cannot meet",
                           box->perturb);
    }
    for (int axis = 0; axis < box->dim; axis++) {
        if (!solver_grading_is_even(&box->grading[axis]) && (box->centred || box->perturb > 0.0)) {
            return solver_fail(error, SOLVER_BAD_INPUT,
                               "grading.%c: a graded lattice has particles on its faces and none moved at random; "
                               "expected lattice = \"nodes\" and perturb = 0",
                               "XYZ"[axis]);
        }
    }
    for (int face = 0; face < 6; face++) {
        if (box->wall[face] > 0 && (!box->centred || face >= 2 * box->dim)) {
            return solver_fail(error, SOLVER_BAD_INPUT,
                               "wall: a lattice with particles on its faces has none; expected lattice = \"centres\"");
        }
    }
    return true;
}

static bool count_cells(const struct solver_box *box, int axis, uint32_t *cells, struct solver_error *error)
{
    double edge = box->upper[axis] - box->lower[axis];
    double spacings = edge / box->spacing;
    if (spacings > 2e6) { /* 21 bits of a lattice index go into the Z-order code */
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "n: edge %c of %g m is %g spacings of %g m, and at most 2000000 are possible; choose a "
                           "smaller n",
                           "XYZ"[axis], edge, spacings, box -> spacing);
    }
    if (!(spacings > 0.5) || fabs(spacings - round(spacings)) > 1e-6) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "edge %c of %g m is not a whole number of spacings of %g m (it is %g of them)", "XYZ"[axis],
                           edge, box -> spacing, spacings);
    }
    *cells = (uint32_t)lround(spacings);
    if (box->centred && *cells < 2) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "n: edge %c of %g m is one spacing, and there is one particle in its centre; at least two "
                           "are needed: choose a larger n",
                           "XYZ"[axis], edge);
    }
    return true;
}

static bool lay_out(const struct solver_box *box, struct lattice *lattice, struct cloud_size *size,
                    struct solver_error *error)
{
    *size = (struct cloud_size){.particles = 1, .cells = 1};
    *lattice = (struct lattice){.cells = {1, 1, 1}, .body = {1, 1, 1}, .points = {1, 1, 1}};
    for (int axis = 0; axis < box->dim; axis++) {
        if (!count_cells(box, axis, &lattice->cells[axis], error)) {
            return false;
        }
        lattice->first[axis] = box->wall[2 * axis];
        lattice->body[axis] = lattice->cells[axis] + (box->centred ? 0 : 1);
        lattice->points[axis] = box->wall[2 * axis] + lattice->body[axis] + box->wall[2 * axis + 1];
        uint32_t thickest = box->wall[2 * axis + (box->wall[2 * axis + 1] > box->wall[2 * axis] ? 1 : 0)];
        if (box->mirrored && thickest > lattice->body[axis]) {
            return solver_fail(error, SOLVER_BAD_INPUT,
                               "wall: %u layers beyond a face across %c, and the body has %u to be mirrored in it; "
                               "choose a larger n",
                               thickest, "XYZ"[axis], lattice -> body[axis]);
        }
        size->particles *= lattice->points[axis];
        size->cells *= lattice->body[axis] - 1;
        if (size->particles > INT32_MAX) {
            return solver_fail(error, SOLVER_BAD_INPUT, "n: more than 2^31 particles; choose a smaller n");
        }
    }
    return true;
}

bool cloud_box_size(const struct solver_box *box, struct cloud_size *size, struct solver_error *error)
{
    struct lattice lattice;
    return check_box(box, error) && lay_out(box, &lattice, size, error);
}

/* Trapezoidal weight of a lattice index: half at both ends. */
static double end_weight(uint32_t index, uint32_t points)
{
    return index == 0 || index + 1 == points ? 0.5 : 1.0;
}

/* Length [m] of what a particle stands for along one axis: its cell, or half of the gaps to its neighbours. */
static double extent(const struct solver_cloud *cloud, bool centred, size_t axis, uint32_t index)
{
    const double *plane = cloud->plane[axis];
    uint32_t last = cloud->points[axis] - 1;
    if (plane != NULL) {
        return 0.5 * (plane[index < last ? index + 1 : last] - plane[index > 0 ? index - 1 : 0]);
    }
    return cloud->spacing * (centred ? 1.0 : end_weight(index, last + 1));
}

/* Tags of a site along one axis. */
static uint32_t tags_along(const struct lattice *lattice, bool centred, uint32_t axis, uint32_t index)
{
    uint32_t first = lattice->first[axis];
    uint32_t last = first + lattice->body[axis] - 1;
    uint32_t at_end = (index == first ? 1U : 0U) | (index == last ? 2U : 0U);
    uint32_t beyond = (index < first ? 1U : 0U) | (index > last ? 2U : 0U);
    return (at_end << (centred ? SOLVER_NEXT_TO_FACE : SOLVER_ON_FACE) | beyond << SOLVER_BEYOND_FACE) << (2 * axis);
}

static void place(struct solver_cloud *cloud, const struct solver_box *box, const struct lattice *lattice, size_t a,
                  const uint32_t site[3])
{
    size_t dim = (size_t)cloud->dim;
    cloud->tags[a] = 0;
    cloud->V[a] = 1.0;
    for (uint32_t axis = 0; axis < 3 && axis < dim; axis++) {
        double cells = (double)lattice->cells[axis];
        double along = ((double)site[axis] - (double)lattice->first[axis] + (box->centred ? 0.5 : 0.0)) / cells;
        bool even = cloud->plane[axis] == NULL;
        cloud->X[a * dim + axis] =
            even ? box->lower[axis] * (1.0 - along) + box->upper[axis] * along : cloud->plane[axis][site[axis]];
        cloud->V[a] *= extent(cloud, box->centred, axis, site[axis]);
        cloud->tags[a] |= tags_along(lattice, box->centred, axis, site[axis]);
    }
    bool on_face = !box->centred && cloud->tags[a] != 0;
    bool of_wall = cloud->tags[a] >> SOLVER_BEYOND_FACE != 0;
    if (box->perturb > 0.0 && !on_face && !of_wall) {
        for (size_t axis = 0; axis < dim; axis++) {
            cloud->X[a * dim + axis] += box->perturb * box->spacing * uniform(box->seed, cloud_morton(site), axis);
        }
    }
}

/* The site of the particle that is made as the a-th. */
static void site_of(const struct lattice *lattice, size_t a, uint32_t site[3])
{
    const uint32_t *points = lattice->points;
    site[0] = (uint32_t)(a % points[0]);
    site[1] = (uint32_t)(a / points[0] % points[1]);
    site[2] = (uint32_t)(a / points[0] / points[1]);
}

void cloud_box_fill(struct solver_cloud *cloud, const struct solver_box *box, struct cloud_size from)
{
    struct lattice lattice;
    struct cloud_size size;
    struct solver_error none;
    if (!lay_out(box, &lattice, &size, &none)) {
        return; /* never: its size was asked for before */
    }
    for (size_t a = 0; a < size.particles; a++) {
        uint32_t site[3];
        site_of(&lattice, a, site);
        place(cloud, box, &lattice, from.particles + a, site);
    }
    cloud_lattice_cells(box->dim, lattice.first, lattice.body, lattice.points, from.particles,
                        cloud->cell + (from.cells << box->dim));
}

static bool list_face_points(struct solver_cloud *cloud, struct solver_error *error)
{
    size_t dim = (size_t)cloud->dim;
    size_t made = 0;
    for (size_t axis = 0; axis < dim; axis++) {
        cloud->face_point_count += 2 * cloud->count / cloud->points[axis];
    }
    if (!solver_alloc((void **)&cloud->face_point, cloud->face_point_count, sizeof *cloud->face_point, "face points",
                      error)) {
        return false;
    }
    for (size_t a = 0; a < cloud->count; a++) {
        for (uint32_t face = 0; face < 2 * dim; face++) {
            if ((cloud->tags[a] >> face & 1U) == 0) {
                continue;
            }
            struct solver_face_point *point = &cloud->face_point[made++];
            *point = (struct solver_face_point){.particle = (uint32_t)a, .face = face};
            double area = 1.0;
            for (size_t axis = 0; axis < dim; axis++) {
                if (axis != face / 2) {
                    area *= extent(cloud, false, axis, cloud->site[a * dim + axis]);
                }
            }
            point->area[face / 2] = face % 2 == 0 ? -area : area;
        }
    }
    return true;
}

/* Index within the lattice of the site that mirrors the given one in the faces it lies beyond. */
static size_t image_of(const struct lattice *lattice, const uint32_t site[3])
{
    size_t at = 0;
    for (int axis = 2; axis >= 0; axis--) {
        uint32_t first = lattice->first[axis];
        uint32_t end = first + lattice->body[axis];
        uint32_t inside = site[axis] < first  ? 2 * first - 1 - site[axis]
                          : site[axis] >= end ? 2 * end - 1 - site[axis]
                                              : site[axis];
        at = at * lattice->points[axis] + inside;
    }
    return at;
}

static bool list_images(struct solver_cloud *cloud, const struct lattice *lattice, uint32_t (*site)[3],
                        struct solver_error *error)
{
    size_t body = cloud->count - cloud->wall_count;
    uint32_t *particle = NULL;
    bool ok = solver_alloc((void **)&cloud->image, cloud->wall_count, sizeof *cloud->image, "mirror images", error) &&
              solver_alloc((void **)&particle, cloud->count, sizeof *particle, "mirror images", error);
    for (size_t a = 0; ok && a < body; a++) {
        particle[image_of(lattice, site[a])] = (uint32_t)a;
    }
    for (size_t w = 0; ok && w < cloud->wall_count; w++) {
        cloud->image[w] = particle[image_of(lattice, site[body + w])];
    }
    free(particle);
    return ok;
}

static bool correct_moments(struct solver_cloud *cloud, const struct solver_box *box, struct solver_error *error)
{
    double centre[3] = {0};
    double volume = 1.0;
    for (int axis = 0; axis < cloud->dim; axis++) {
        centre[axis] = 0.5 * (box->lower[axis] + box->upper[axis]);
        volume *= box->upper[axis] - box->lower[axis];
    }
    return cloud_fit_volumes(cloud, volume, centre, error);
}

/* Places of the planes along axes that are graded. */
static bool grade(struct solver_cloud *cloud, const struct solver_box *box, struct solver_error *error)
{
    for (int axis = 0; axis < box->dim; axis++) {
        size_t points = cloud->points[axis];
        double **plane = &cloud->plane[axis];
        if (!solver_grading_is_even(&box->grading[axis]) &&
            !(solver_alloc((void **)plane, points, sizeof **plane, "planes of a graded lattice", error) &&
              solver_grading_places(&box->grading[axis], axis, box->lower[axis], box->upper[axis], points, *plane,
                                    error))) {
            return false;
        }
    }
    return true;
}

/* Fills and orders a cloud that has its arrays; keeps the sites. */
static bool make(struct solver_cloud *cloud, const struct solver_box *box, uint32_t (*site)[3],
                 struct solver_error *error)
{
    struct lattice lattice;
    struct cloud_size size;
    size_t dim = (size_t)cloud->dim;
    if (!lay_out(box, &lattice, &size, error)) {
        return false;
    }
    memcpy(cloud->points, lattice.points, sizeof cloud->points);
    if (!grade(cloud, box, error)) {
        return false;
    }
    cloud_box_fill(cloud, box, (struct cloud_size){0});
    for (size_t a = 0; a < cloud->count; a++) {
        site_of(&lattice, a, site[a]);
    }
    if (!cloud_order(cloud, site, error)) {
        return false;
    }
    for (size_t axis = 0; axis < dim && axis < 3; axis++) {
        for (size_t a = 0; a < cloud->count; a++) {
            cloud->site[a * dim + axis] = site[a][axis];
        }
    }
    return (box->centred || list_face_points(cloud, error)) &&
           (!box->mirrored || cloud->wall_count == 0 || list_images(cloud, &lattice, site, error)) &&
           (box->perturb > 0.0 ? correct_moments(cloud, box, error) : true);
}

bool solver_cloud_box(const struct solver_box *box, struct solver_cloud **out, struct solver_error *error)
{
    *out = NULL;
    struct solver_cloud *cloud = NULL;
    struct cloud_size size;
    uint32_t(*site)[3] = NULL;
    if (!cloud_box_size(box, &size, error) || !solver_alloc((void **)&cloud, 1, sizeof *cloud, "cloud", error)) {
        return false;
    }
    cloud->dim = box->dim;
    cloud->spacing = box->spacing;
    bool ok = cloud_reserve(cloud, size, error) &&
              solver_alloc((void **)&cloud->site, size.particles * (size_t)box->dim, sizeof(uint32_t), "lattice sites",
                           error) &&
              solver_alloc((void **)&site, size.particles, sizeof *site, "lattice sites", error) &&
              make(cloud, box, site, error);
    free(site);
    if (!ok) {
        solver_cloud_free(cloud);
        return false;
    }
    *out = cloud;
    return true;
}
