/* Which maker makes the cloud of a run, by the shape of the scene's domain or bodies. */
#include "solver/run_internal.h"
#include "solver/solid.h"
#include "solver/stl.h"
#include "solver/symmetry.h"

#include <stdio.h>
#include <string.h>

static bool distance_of(const void *context, const double X[3], double *distance, struct solver_error *error)
{
    return solver_scene_eval(context, SOLVER_DISTANCE, X, 0.0, distance, 1, error);
}

static bool make_box(const struct solver_scene *scene, double spacing, struct solver_cloud **cloud,
                     struct solver_error *error)
{
    struct solver_box box = {.dim = scene->dim,
                             .spacing = spacing,
                             .perturb = scene->perturb,
                             .seed = scene->seed,
                             .centred = scene->lattice == SOLVER_CENTRES,
                             .mirrored = scene->wall_motion == SOLVER_WALL_MIRRORED};
    memcpy(box.lower, scene->lower, sizeof box.lower);
    memcpy(box.upper, scene->upper, sizeof box.upper);
    memcpy(box.grading, scene->grading, sizeof box.grading);
    for (int face = 0; face < SOLVER_SURFACE; face++) {
        box.wall[face] = (uint32_t)solver_scene_wall(scene, face);
    }
    return solver_cloud_box(&box, cloud, error);
}

static bool make_solid(const struct solver_scene *scene, double spacing, struct solver_cloud **cloud,
                       struct solver_error *error)
{
    struct solver_solid solid = {.dim = scene->dim, .spacing = spacing, .distance = distance_of, .context = scene};
    memcpy(solid.lower, scene->lower, sizeof solid.lower);
    memcpy(solid.upper, scene->upper, sizeof solid.upper);
    return solver_cloud_solid(&solid, cloud, error);
}

static bool distance_from_surface(const void *context, const double X[3], double *distance, struct solver_error *error)
{
    (void)error;
    *distance = solver_stl_distance(context, X);
    return true;
}

/* A body given by a file, whose name is relative to the scene's folder. */
static bool make_stl(const struct solver_scene *scene, double spacing, struct solver_cloud **cloud,
                     struct solver_error *error)
{
    char path[sizeof scene->path + SOLVER_TEXT];
    struct solver_stl *surface = NULL;
    const char *slash = scene->domain_file[0] == '/' ? NULL : strrchr(scene->path, '/');
    (void)snprintf(path, sizeof path, "%.*s%s", slash != NULL ? (int)(slash + 1 - scene->path) : 0, scene->path,
                   scene->domain_file);
    if (!solver_stl_read(path, scene->domain_scale, &surface, error)) {
        return false;
    }
    struct solver_solid solid = {
        .dim = scene->dim, .spacing = spacing, .distance = distance_from_surface, .context = surface};
    memcpy(solid.lower, scene->lower, sizeof solid.lower);
    memcpy(solid.upper, scene->upper, sizeof solid.upper);
    bool made = solver_cloud_solid(&solid, cloud, error);
    solver_stl_free(surface);
    return made;
}

bool solver_run_cloud(struct solver_run *run, struct solver_error *error)
{
    const struct solver_scene *scene = run->scene;
    double spacing = scene->reference_length / scene->n;
    bool made = scene->shape_count > 0
                    ? solver_cloud_bodies(scene->dim, scene->shape, scene->shape_count, spacing, &run->cloud, error)
                : scene->domain.kind == SOLVER_SHAPE_BOX   ? make_box(scene, spacing, &run->cloud, error)
                : scene->domain.kind == SOLVER_SHAPE_SOLID ? make_solid(scene, spacing, &run->cloud, error)
                : scene->domain.kind == SOLVER_SHAPE_STL
                    ? make_stl(scene, spacing, &run->cloud, error)
                    : solver_cloud_round(&scene->domain, spacing, &run->cloud, error);
    const bool *cut = scene->domain.cut;
    if (made && (cut[0] || cut[1] || cut[2])) {
        made = solver_symmetry_cut(run->cloud, &scene->domain, scene->support * spacing, &run->cloud, error);
    }
    if (made) {
        run->shown = *run->cloud;
        run->shown.count -= run->cloud->wall_count;
        run->shown.wall_count = 0;
    }
    return made;
}
