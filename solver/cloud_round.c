/* Round bodies: discs, balls and cylinders, in concentric shells with particles on the surface.
 *
 * The lattice of a square or cube is bent: its k-th shell goes to the circle or sphere of k spacings, and each of its 4
 * or 6 faces is divided into 2k equal angles (the equiangular cubed sphere: Ronchi, Iacono, Paolucci 1996, J. Comput.
 * Phys. 124, 93). A particle's share omega of all directions is the exact angle or solid angle between the half-way
 * lines of that grid, which are great circles. From it follow V = omega (outer^d - inner^d) / d,    B = omega R^(d-1)
 * N,    N = (X - centre) / R, the volume between half-way radii, and for a particle on the surface its area along the
 * exact normal there; d is 2 or 3. Shares of a shell sum to 2 pi or 4 pi, so sum V = |V| and sum (X - centre) . B = d
 * |V|. The cloud is its own image under all symmetries of the cube, so what is odd sums to zero and sum X (x) B is a
 * multiple of the identity: the divergence theorem holds for quadratic fields, and the constraints of a closed stencil
 * are compatible. (Area vectors of a polyhedron through the particles would close as well; but its volume is less than
 * the body's, and in 3D they are not along the normals, so that a traction given on the body's surface would not
 * balance a constant stress.) A cylinder is a disc times the trapezoidal rule along Z, which keeps all of it. */
#include "solver/cloud_internal.h"
#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

enum { MOST_SHELLS = (1 << (CLOUD_GRID_BITS - 1)) - 1 };

/* The bent lattice: indices -shells..shells along the curved axes, 0..layers along a cylinder. */
struct bent {
    const struct solver_shape *shape;
    double spacing;
    int dim, curved; /* axes, and how many of them are curved */
    uint32_t shells, layers;
    uint32_t points[3];
};

/* A whole number of spacings in a length, at least one; each may differ from the spacing by a share of `give`. */
static bool count_spacings(const char *what, double length, double spacing, double give, uint32_t *count,
                           struct solver_error *error)
{
    double spacings = length / spacing;
    double off = fabs(spacings - round(spacings));
    if (!(length > 0.0) || !(spacing > 0.0) || !(off <= fmax(1e-6, give * spacings)) || spacings < 0.5) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "domain: a %s of %g m is %g spacings of %g m; expected a whole number, one or more", what,
                           length, spacings, spacing);
    }
    if (spacings > MOST_SHELLS) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "n: a %s of %g m is %g spacings of %g m, and at most %d are possible; choose a smaller n",
                           what, length, spacings, spacing, (int)MOST_SHELLS);
    }
    *count = (uint32_t)lround(spacings);
    return true;
}

static bool lay_out(const struct solver_shape *shape, double spacing, struct bent *bent, struct cloud_size *size,
                    struct solver_error *error)
{
    bool cylinder = shape->kind == SOLVER_SHAPE_CYLINDER;
    *bent = (struct bent){.shape = shape,
                          .spacing = spacing,
                          .dim = shape->kind == SOLVER_SHAPE_DISC ? 2 : 3,
                          .curved = shape->kind == SOLVER_SHAPE_BALL ? 3 : 2,
                          .points = {1, 1, 1}};
    for (int axis = 0; axis < bent->dim; axis++) {
        if (!isfinite(shape->centre[axis])) {
            return solver_fail(error, SOLVER_BAD_INPUT, "domain: centre %c = %g m; expected a finite number",
                               "XYZ"[axis], shape -> centre[axis]);
        }
    }
    if (!count_spacings("radius", shape->outer, spacing, 0.0, &bent->shells, error) ||
        (cylinder && !count_spacings("length", shape->length, spacing, SOLVER_LAYERS_GIVE, &bent->layers, error))) {
        return false;
    }
    *size = (struct cloud_size){.particles = 1, .cells = 1};
    for (int axis = 0; axis < bent->dim; axis++) {
        uint32_t cells = axis < bent->curved ? 2 * bent->shells : bent->layers;
        bent->points[axis] = cells + 1;
        size->particles *= bent->points[axis];
        size->cells *= cells;
        if (size->particles > INT32_MAX) {
            return solver_fail(error, SOLVER_BAD_INPUT, "n: more than 2^31 particles; choose a smaller n");
        }
    }
    return true;
}

/* Indices along the curved axes, counted from the middle, of a site; returns the shell. */
static int32_t shell_of(const struct bent *bent, const uint32_t site[3], int32_t index[3])
{
    int32_t shell = 0;
    for (int axis = 0; axis < bent->curved; axis++) {
        index[axis] = (int32_t)site[axis] - (int32_t)bent->shells;
        shell = abs(index[axis]) > shell ? abs(index[axis]) : shell;
    }
    return shell;
}

/* Tangent of the angle from a face's middle to the place `along` in [-1, 1] of it. */
static double tangent(double along)
{
    return fabs(along) < 1.0 ? tan(0.25 * pi * along) : along;
}

/* Unit vector towards a site, [curved]; 0 in the middle. */
static void direction(const struct bent *bent, const int32_t index[3], int32_t shell, double normal[3])
{
    double square = 0.0;
    for (int axis = 0; axis < bent->curved; axis++) {
        normal[axis] = shell > 0 ? tangent((double)index[axis] / (double)shell) : 0.0;
        square += normal[axis] * normal[axis];
    }
    for (int axis = 0; shell > 0 && axis < bent->curved; axis++) {
        normal[axis] /= sqrt(square);
    }
}

/* Solid angle of the rectangle from (0, 0) to (x, y) in the plane at distance 1. */
static double corner(double x, double y)
{
    return atan2(x * y, sqrt(1.0 + x * x + y * y));
}

/* Share of directions on one face of a site's shell: from half-way lines on either side, or the face's rim, of the
 * axes that lie in the face. */
static double share_on_face(const struct bent *bent, const int32_t index[3], int32_t shell, int face_axis)
{
    double low[2] = {0};
    double high[2] = {0};
    int found = 0;
    for (int axis = 0; axis < bent->curved; axis++) {
        if (axis != face_axis) {
            low[found] = fmax(-1.0, ((double)index[axis] - 0.5) / (double)shell);
            high[found++] = fmin(1.0, ((double)index[axis] + 0.5) / (double)shell);
        }
    }
    if (found == 1) {
        return 0.25 * pi * (high[0] - low[0]);
    }
    double x0 = tangent(low[0]);
    double x1 = tangent(high[0]);
    double y0 = tangent(low[1]);
    double y1 = tangent(high[1]);
    return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

/* Share of all directions, of 2 pi or 4 pi. */
static double share(const struct bent *bent, const int32_t index[3], int32_t shell)
{
    double sum = 0.0;
    if (shell == 0) {
        return bent->curved == 2 ? 2.0 * pi : 4.0 * pi;
    }
    for (int axis = 0; axis < bent->curved; axis++) {
        sum += abs(index[axis]) == shell ? share_on_face(bent, index, shell, axis) : 0.0;
    }
    return sum;
}

/* The trapezoidal rule's weight [m] along a cylinder; 1 of other shapes. */
static double weight_along(const struct bent *bent, const uint32_t site[3])
{
    bool end = site[2] == 0 || site[2] == bent->layers;
    return bent->dim == bent->curved ? 1.0 : bent->shape->length / (double)bent->layers * (end ? 0.5 : 1.0);
}

/* Measure of a site within its disc or ball: its area [m^2] or volume [m^3]. */
static double measure(const struct bent *bent, const int32_t index[3], int32_t shell)
{
    double radius = bent->shape->outer;
    double inner = shell > 0 ? radius * ((double)shell - 0.5) / (double)bent->shells : 0.0;
    double outer = fmin(radius, radius * ((double)shell + 0.5) / (double)bent->shells);
    return share(bent, index, shell) * (pow(outer, bent->curved) - pow(inner, bent->curved)) / bent->curved;
}

static void place(struct solver_cloud *cloud, const struct bent *bent, size_t a, const uint32_t site[3])
{
    const struct solver_shape *shape = bent->shape;
    double *X = cloud->X + a * (size_t)bent->dim;
    int32_t index[3];
    int32_t shell = shell_of(bent, site, index);
    double normal[3];
    direction(bent, index, shell, normal);
    for (int axis = 0; axis < bent->curved; axis++) {
        X[axis] = shape->centre[axis] + shape->outer * (double)shell / (double)bent->shells * normal[axis];
    }
    cloud->tags[a] = (uint32_t)((uint32_t)shell == bent->shells) << SOLVER_SURFACE;
    if (bent->curved < bent->dim) {
        X[2] = shape->centre[2] + shape->length * ((double)site[2] / (double)bent->layers - 0.5);
        cloud->tags[a] |= (site[2] == 0 ? 1U << 4 : 0U) | (site[2] == bent->layers ? 1U << 5 : 0U);
    }
    cloud->V[a] = measure(bent, index, shell) * weight_along(bent, site);
}

/* A particle's share of the curved face, and of an end of a cylinder. */
static bool list_face_points(struct solver_cloud *cloud, const struct bent *bent, uint32_t (*site)[3],
                             struct solver_error *error)
{
    size_t made = 0;
    for (size_t a = 0; a < cloud->count; a++) {
        cloud->face_point_count += (size_t)__builtin_popcount(cloud->tags[a]);
    }
    if (!solver_alloc((void **)&cloud->face_point, cloud->face_point_count, sizeof *cloud->face_point, "face points",
                      error)) {
        return false;
    }
    for (size_t a = 0; a < cloud->count; a++) {
        int32_t index[3];
        int32_t shell = shell_of(bent, site[a], index);
        for (uint32_t face = 4; face <= SOLVER_SURFACE; face++) {
            if ((cloud->tags[a] >> face & 1U) == 0) {
                continue;
            }
            struct solver_face_point *point = &cloud->face_point[made++];
            *point = (struct solver_face_point){.particle = (uint32_t)a, .face = face};
            if (face < SOLVER_SURFACE) {
                point->area[2] = (face == 4 ? -1.0 : 1.0) * measure(bent, index, shell);
                continue;
            }
            double area = share(bent, index, shell) * pow(bent->shape->outer, bent->curved - 1);
            direction(bent, index, shell, point->area);
            for (int axis = 0; axis < bent->curved; axis++) {
                point->area[axis] *= area * weight_along(bent, site[a]);
            }
        }
    }
    return true;
}

static bool make(struct solver_cloud *cloud, const struct bent *bent, struct solver_error *error)
{
    static const uint32_t none[3] = {0};
    uint32_t(*site)[3] = NULL;
    if (!solver_alloc((void **)&site, cloud->count, sizeof *site, "lattice sites", error)) {
        return false;
    }
    for (size_t a = 0; a < cloud->count; a++) {
        site[a][0] = (uint32_t)(a % bent->points[0]);
        site[a][1] = (uint32_t)(a / bent->points[0] % bent->points[1]);
        site[a][2] = (uint32_t)(a / bent->points[0] / bent->points[1]);
        place(cloud, bent, a, site[a]);
    }
    cloud_lattice_cells(bent->dim, none, bent->points, bent->points, 0, cloud->cell);
    bool ok = cloud_order(cloud, site, error) && list_face_points(cloud, bent, site, error);
    free(site);
    return ok;
}

bool solver_cloud_round(const struct solver_shape *shape, double spacing, struct solver_cloud **out,
                        struct solver_error *error)
{
    struct solver_cloud *cloud = NULL;
    struct cloud_size size = {0};
    struct bent bent;
    *out = NULL;
    if (!lay_out(shape, spacing, &bent, &size, error) ||
        !solver_alloc((void **)&cloud, 1, sizeof *cloud, "cloud", error)) {
        return false;
    }
    cloud->dim = bent.dim;
    cloud->spacing = spacing;
    if (!cloud_reserve(cloud, size, error) || !make(cloud, &bent, error)) {
        solver_cloud_free(cloud);
        return false;
    }
    *out = cloud;
    return true;
}
