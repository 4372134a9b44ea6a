#include "verify/inside.h"

#include <math.h>

static const double round_off = 1e-12; /* of the largest coordinate */

static bool judge(const struct solver_scene *scene, const struct verify_truth *truth, const char *what,
                  const double X[3], double slack, struct solver_error *error)
{
    double outside = truth->kind->outside(truth->oracle, X);
    return outside <= slack ||
           solver_fail(error, SOLVER_BAD_INPUT,
                       "%s: %s at (%.9g, %.9g, %.9g) m lies %.3g m outside the body that the oracle \"%s\" speaks of; "
                       "the domain has to lie within that, as its parameters have it",
                       scene->path, what, X[0], X[1], X[2], outside, truth->kind->name);
}

static double largest(const double *X, size_t count)
{
    double size = 0.0;
    for (size_t i = 0; i < count; i++) {
        size = fmax(size, fabs(X[i]));
    }
    return size;
}

static bool check_corners(const struct solver_scene *scene, const struct verify_truth *truth,
                          struct solver_error *error)
{
    double slack =
        round_off * fmax(largest(scene->lower, (size_t)scene->dim), largest(scene->upper, (size_t)scene->dim));
    for (int corner = 0; corner < 1 << scene->dim; corner++) {
        double X[3] = {0};
        for (int axis = 0; axis < scene->dim; axis++) {
            X[axis] = corner >> axis & 1 ? scene->upper[axis] : scene->lower[axis];
        }
        if (!judge(scene, truth, "the domain's corner", X, slack, error)) {
            return false;
        }
    }
    return true;
}

bool verify_inside_domain(const struct solver_scene *scene, const struct verify_truth *truth,
                          struct solver_error *error)
{
    const struct oracle_kind *kind = truth->kind;
    if (kind->reach != NULL && scene->t_end > kind->reach(truth->oracle)) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%s: t_end = %.9g s; the oracle \"%s\" reaches to %.9g s",
                           scene->path, scene->t_end, kind->name, kind->reach(truth->oracle));
    }
    return scene->shape_count > 0 || scene->domain.kind != SOLVER_SHAPE_BOX || check_corners(scene, truth, error);
}

bool verify_inside_cloud(const struct solver_scene *scene, const struct verify_truth *truth,
                         const struct solver_cloud *cloud, struct solver_error *error)
{
    if (truth->none) {
        return true;
    }
    size_t dim = (size_t)cloud->dim, count = cloud->count - cloud->wall_count;
    double slack = round_off * largest(cloud->X, count * dim);
    if (cloud->quality != NULL) {
        slack += cloud->quality->off_surface * cloud->spacing;
    }
    for (size_t a = 0; a < count; a++) {
        double X[3] = {0};
        for (size_t axis = 0; axis < dim; axis++) {
            X[axis] = cloud->X[a * dim + axis];
        }
        if (!judge(scene, truth, "a particle", X, slack, error)) {
            return false;
        }
    }
    return true;
}
