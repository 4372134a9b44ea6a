#include "verify/indicators.h"

#include "verify/norms.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name, *op, *meaning, *lacks;
} table[VERIFY_INDICATORS] = {
    [VERIFY_CLUMPING] = {"clumping", ">=", "smallest distance of two particles over the spacing",
                         "places are no numbers"},
    [VERIFY_CHECKERBOARD] = {"checkerboard", "<=", "departure of the pressure from its neighbours' mean, over itself",
                             "there is no pressure, or no particle has neighbours on all sides; take a larger n"},
    [VERIFY_LINEAR_MOMENTUM] = {"linear momentum",
                                "<=", "drift of the free body, with a wall it meets, over sqrt(2 mass kinetic energy)",
                                "faces or loads act on the body, or it does not move"},
    [VERIFY_ANGULAR_MOMENTUM] = {"angular momentum", "<=", "drift of the free body, over that and its half diagonal",
                                 "faces, loads or a wall act on the body, or it does not move"},
    [VERIFY_ENERGY_GAIN] = {"energy gain", "<=", "largest gain beyond what was put in, over that",
                            "a face is moved, and what it puts in is not measured, or there is no energy"},
};

const char *verify_indicator_name(size_t indicator)
{
    return table[indicator].name;
}

const char *verify_indicator_meaning(size_t indicator)
{
    return table[indicator].meaning;
}

const char *verify_indicator_op(size_t indicator)
{
    return table[indicator].op;
}

const char *verify_indicator_lacks(size_t indicator)
{
    return table[indicator].lacks;
}

size_t verify_indicator_find(const char *name)
{
    size_t indicator = 0;
    while (indicator < VERIFY_INDICATORS && strcmp(table[indicator].name, name) != 0) {
        indicator++;
    }
    return indicator;
}

static double distance(const double a[3], const double b[3])
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

void verify_indicators_history(const struct solver_history *history, double mass, double size,
                               double value[VERIFY_INDICATORS])
{
    const struct solver_totals *first = &history->totals[0];
    double linear = 0, angular = 0, gain = 0, kinetic = 0, before = first->kinetic + first->strain, supply = before;
    for (size_t i = 0; i < history->count; i++) {
        const struct solver_totals *now = &history->totals[i];
        double work = now->external - first->external;
        double both[3]; /* of the body and of the wall that it has met */
        for (int axis = 0; axis < 3; axis++) {
            both[axis] = history->mirrored[axis] ? first->linear[axis] : now->linear[axis] + now->wall[axis];
        }
        linear = verify_larger(linear, distance(both, first->linear));
        angular = verify_larger(angular, distance(now->angular, first->angular));
        kinetic = verify_larger(kinetic, now->kinetic);
        supply = verify_larger(supply, before + fabs(work));
        gain = verify_larger(gain, now->kinetic + now->strain - before - work);
    }
    double scale = sqrt(2 * mass * kinetic);
    value[VERIFY_LINEAR_MOMENTUM] = scale > 0 ? linear / scale : NAN;
    value[VERIFY_ANGULAR_MOMENTUM] = scale * size > 0 && !history->walled ? angular / (scale * size) : NAN;
    value[VERIFY_ENERGY_GAIN] = supply > 0 ? gain / supply : NAN;
}

/* Half the diagonal of the box around the body at rest [m]. */
static double half_diagonal(const struct solver_cloud *cloud)
{
    double square = 0;
    for (int axis = 0; axis < cloud->dim; axis++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t a = 0; a < cloud->count; a++) {
            double X = cloud->X[a * (size_t)cloud->dim + (size_t)axis];
            low = fmin(low, X);
            high = fmax(high, X);
        }
        square += (high - low) * (high - low);
    }
    return sqrt(square) / 2;
}

bool verify_supply_is_known(const struct solver_scene *scene)
{
    bool moved = false;
    for (int face = 0; face < SOLVER_FACES; face++) {
        moved = moved || scene->face[face] == SOLVER_MOTION || scene->face[face] == SOLVER_ROLLER;
    }
    return !moved;
}

/* Nothing from outside acts on a body whose faces are all free and that has no body force; on planes of symmetry acts
 * what holds it along their normals. */
static void forget_what_is_not_conserved(const struct solver_scene *scene, double value[VERIFY_INDICATORS])
{
    bool loaded = solver_scene_has(scene, SOLVER_BODY_FORCE), mirrored = false, free[3] = {true, true, true};
    for (int face = 0; face < SOLVER_FACES; face++) {
        bool plane = face < SOLVER_SURFACE && scene->face[face] == SOLVER_SYMMETRIC;
        loaded = loaded || (scene->face[face] != SOLVER_FREE && !plane);
        mirrored = mirrored || plane;
        free[plane ? face / 2 : 0] = free[plane ? face / 2 : 0] && !plane;
    }
    bool any = free[0] || (scene->dim > 1 && free[1]) || (scene->dim > 2 && free[2]);
    value[VERIFY_LINEAR_MOMENTUM] = loaded || !any ? NAN : value[VERIFY_LINEAR_MOMENTUM];
    value[VERIFY_ANGULAR_MOMENTUM] = loaded || mirrored ? NAN : value[VERIFY_ANGULAR_MOMENTUM];
    value[VERIFY_ENERGY_GAIN] = verify_supply_is_known(scene) ? value[VERIFY_ENERGY_GAIN] : NAN;
}

bool verify_indicators_measure(const struct solver_scene *scene, const struct solver_output *output,
                               const struct solver_history *history, const struct solver_facts *facts,
                               double value[VERIFY_INDICATORS], struct solver_error *error)
{
    const struct solver_cloud *cloud = output->cloud;
    size_t numbers = cloud->count * (size_t)cloud->dim;
    double *x = calloc(numbers, sizeof *x);
    if (x == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for the positions of %zu particles", cloud->count);
    }
    for (size_t i = 0; i < numbers; i++) {
        x[i] = cloud->X[i] + output->u[i];
    }
    const struct solver_points now = {
        .dim = cloud->dim, .count = cloud->count, .stride = (size_t)cloud->dim, .x = x, .body = cloud->body};
    bool done = solver_cloud_graded(cloud)
                    ? verify_indicators_lattice(cloud, &now, output->V, output->pressure, value, error)
                    : verify_indicators_cloud(&now, output->V, output->pressure, cloud->spacing, value, error);
    free(x);
    verify_indicators_history(history, facts->mass, half_diagonal(cloud), value);
    forget_what_is_not_conserved(scene, value);
    return done;
}
