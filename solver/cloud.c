#include "solver/cloud.h"

#include "solver/memory.h"
#include "solver/small.h"

#include <math.h>
#include <stdlib.h>

/* Interleaves the low 21 bits of three lattice indices: position along a Z-order (Morton) curve. */
static uint64_t morton(const uint32_t site[3])
{
    uint64_t code = 0;
    for (unsigned bit = 0; bit < 21; bit++) {
        for (unsigned axis = 0; axis < 3; axis++) {
            code |= (uint64_t)(site[axis] >> bit & 1U) << (3 * bit + axis);
        }
    }
    return code;
}

struct ordered_site {
    uint64_t code;
    uint32_t site[3];
};

static int by_code(const void *left, const void *right)
{
    uint64_t a = ((const struct ordered_site *)left)->code;
    uint64_t b = ((const struct ordered_site *)right)->code;
    return a < b ? -1 : a > b;
}

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
    return true;
}

static bool count_points(const struct solver_box *box, uint32_t points[3], size_t *count, struct solver_error *error)
{
    *count = 1;
    for (int axis = 0; axis < 3; axis++) {
        points[axis] = 1;
        if (axis >= box->dim) {
            continue;
        }
        double spacings = (box->upper[axis] - box->lower[axis]) / box->spacing;
        if (spacings > 2e6) { /* 21 bits of a lattice index go into the Z-order code */
            return solver_fail(error, SOLVER_BAD_INPUT,
                               "n: edge %c of %g m is %g spacings of %g m, and at most 2000000 are possible; choose a "
                               "smaller n",
                               "XYZ"[axis], box -> upper[axis] - box -> lower[axis], spacings, box -> spacing);
        }
        if (!(spacings > 0.5) || fabs(spacings - round(spacings)) > 1e-6) {
            return solver_fail(error, SOLVER_BAD_INPUT,
                               "domain: edge %c of %g m is not a whole number of spacings of %g m (it is %g of them)",
                               "XYZ"[axis], box -> upper[axis] - box -> lower[axis], box -> spacing, spacings);
        }
        points[axis] = (uint32_t)lround(spacings) + 1;
        *count *= points[axis];
        if (*count > INT32_MAX) {
            return solver_fail(error, SOLVER_BAD_INPUT, "n: more than 2^31 particles; choose a smaller n");
        }
    }
    return true;
}

static bool reserve(struct solver_cloud *cloud, size_t face_points, size_t cells, struct solver_error *error)
{
    size_t dim = (size_t)cloud->dim;
    cloud->face_point_count = face_points;
    cloud->cell_count = cells;
    return solver_alloc((void **)&cloud->X, cloud->count * dim, sizeof(double), "particle positions", error) &&
           solver_alloc((void **)&cloud->V, cloud->count, sizeof(double), "particle volumes", error) &&
           solver_alloc((void **)&cloud->tags, cloud->count, sizeof(uint32_t), "particle tags", error) &&
           solver_alloc((void **)&cloud->site, cloud->count * dim, sizeof(uint32_t), "lattice sites", error) &&
           solver_alloc((void **)&cloud->face_point, face_points, sizeof *cloud->face_point, "face points", error) &&
           solver_alloc((void **)&cloud->cell, cells << dim, sizeof(uint32_t), "lattice cells", error);
}

/* Trapezoidal weight of a lattice index: half at both ends. */
static double end_weight(uint32_t index, uint32_t points)
{
    return index == 0 || index + 1 == points ? 0.5 : 1.0;
}

static void place(struct solver_cloud *cloud, const struct solver_box *box, size_t a, const struct ordered_site *from)
{
    size_t dim = (size_t)cloud->dim;
    cloud->tags[a] = 0;
    cloud->V[a] = 1.0;
    for (size_t axis = 0; axis < dim; axis++) {
        uint32_t index = from->site[axis];
        uint32_t last = cloud->points[axis] - 1;
        double along = (double)index / (double)last;
        cloud->site[a * dim + axis] = index;
        cloud->X[a * dim + axis] = box->lower[axis] * (1.0 - along) + box->upper[axis] * along;
        cloud->V[a] *= cloud->spacing * end_weight(index, cloud->points[axis]);
        cloud->tags[a] |= (index == 0 ? 1U : 0U) << (2 * axis) | (index == last ? 2U : 0U) << (2 * axis);
    }
    if (cloud->tags[a] == 0 && box->perturb > 0.0) {
        for (size_t axis = 0; axis < dim; axis++) {
            cloud->X[a * dim + axis] += box->perturb * cloud->spacing * uniform(box->seed, from->code, axis);
        }
    }
}

static void list_face_points(struct solver_cloud *cloud)
{
    size_t dim = (size_t)cloud->dim;
    size_t made = 0;
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
                    area *= cloud->spacing * end_weight(cloud->site[a * dim + axis], cloud->points[axis]);
                }
            }
            point->area[face / 2] = face % 2 == 0 ? -area : area;
        }
    }
}

static void list_cells(struct solver_cloud *cloud, const uint32_t *particle_at)
{
    static const uint32_t corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                          {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    size_t width = (size_t)1 << cloud->dim;
    const uint32_t *points = cloud->points;
    uint32_t cells[3];
    for (int axis = 0; axis < 3; axis++) {
        cells[axis] = axis < cloud->dim ? points[axis] - 1 : 1;
    }
    uint32_t *out = cloud->cell;
    for (uint32_t k = 0; k < cells[2]; k++) {
        for (uint32_t j = 0; j < cells[1]; j++) {
            for (uint32_t i = 0; i < cells[0]; i++) {
                for (size_t c = 0; c < width; c++) {
                    size_t site =
                        ((size_t)(k + corner[c][2]) * points[1] + j + corner[c][1]) * points[0] + i + corner[c][0];
                    *out++ = particle_at[site];
                }
            }
        }
    }
}

/* V_a <- V_a (1 + c0 + c . (X_a - centre)/h) such that sum V = |V| and sum V X = integral of X. Two rounds, so that
 * round-off in the first is corrected by the second. */
static bool correct_moments(struct solver_cloud *cloud, const struct solver_box *box, struct solver_error *error)
{
    size_t dim = (size_t)cloud->dim;
    double centre[3] = {0};
    double volume = 1.0;
    for (size_t axis = 0; axis < dim; axis++) {
        centre[axis] = 0.5 * (box->lower[axis] + box->upper[axis]);
        volume *= box->upper[axis] - box->lower[axis];
    }
    for (int round = 0; round < 2; round++) {
        double A[4][4] = {{0}};
        double r[4] = {volume, 0.0, 0.0, 0.0};
        for (size_t a = 0; a < cloud->count; a++) {
            double basis[4] = {1.0, 0.0, 0.0, 0.0};
            for (size_t axis = 0; axis < dim; axis++) {
                basis[axis + 1] = (cloud->X[a * dim + axis] - centre[axis]) / box->spacing;
            }
            for (size_t i = 0; i <= dim; i++) {
                r[i] -= cloud->V[a] * basis[i];
                for (size_t j = 0; j <= dim; j++) {
                    A[i][j] += cloud->V[a] * basis[i] * basis[j];
                }
            }
        }
        if (!solver_small_solve(dim + 1, A, r)) {
            return solver_fail(error, SOLVER_BAD_INPUT, "cloud: volumes cannot be corrected: particles are degenerate");
        }
        for (size_t a = 0; a < cloud->count; a++) {
            double factor = 1.0 + r[0];
            for (size_t axis = 0; axis < dim; axis++) {
                factor += r[axis + 1] * (cloud->X[a * dim + axis] - centre[axis]) / box->spacing;
            }
            cloud->V[a] *= factor;
        }
    }
    return true;
}

static bool fill(struct solver_cloud *cloud, const struct solver_box *box, struct ordered_site *order,
                 uint32_t *particle_at, struct solver_error *error)
{
    const uint32_t *points = cloud->points;
    size_t made = 0;
    for (uint32_t k = 0; k < points[2]; k++) {
        for (uint32_t j = 0; j < points[1]; j++) {
            for (uint32_t i = 0; i < points[0]; i++) {
                struct ordered_site *site = &order[made++];
                *site = (struct ordered_site){.site = {i, j, k}};
                site->code = morton(site->site);
            }
        }
    }
    qsort(order, cloud->count, sizeof *order, by_code);
    for (size_t a = 0; a < cloud->count; a++) {
        const uint32_t *site = order[a].site;
        particle_at[((size_t)site[2] * points[1] + site[1]) * points[0] + site[0]] = (uint32_t)a;
        place(cloud, box, a, &order[a]);
    }
    list_face_points(cloud);
    list_cells(cloud, particle_at);
    return box->perturb > 0.0 ? correct_moments(cloud, box, error) : true;
}

bool solver_cloud_box(const struct solver_box *box, struct solver_cloud **out, struct solver_error *error)
{
    *out = NULL;
    struct solver_cloud *cloud = NULL;
    struct ordered_site *order = NULL;
    uint32_t *particle_at = NULL;
    if (!check_box(box, error) || !solver_alloc((void **)&cloud, 1, sizeof *cloud, "cloud", error)) {
        return false;
    }
    cloud->dim = box->dim;
    cloud->spacing = box->spacing;
    bool ok = count_points(box, cloud->points, &cloud->count, error);
    size_t face_points = 0;
    size_t cells = 1;
    for (int axis = 0; ok && axis < box->dim; axis++) {
        face_points += 2 * cloud->count / cloud->points[axis];
        cells *= cloud->points[axis] - 1;
    }
    ok = ok && reserve(cloud, face_points, cells, error) &&
         solver_alloc((void **)&order, cloud->count, sizeof *order, "lattice order", error) &&
         solver_alloc((void **)&particle_at, cloud->count, sizeof *particle_at, "lattice map", error) &&
         fill(cloud, box, order, particle_at, error);
    free(order);
    free(particle_at);
    if (!ok) {
        solver_cloud_free(cloud);
        return false;
    }
    *out = cloud;
    return true;
}

void solver_cloud_free(struct solver_cloud *cloud)
{
    if (cloud == NULL) {
        return;
    }
    free(cloud->X);
    free(cloud->V);
    free(cloud->tags);
    free(cloud->site);
    free(cloud->face_point);
    free(cloud->cell);
    free(cloud);
}
