/* Neighbour lists with a skin, against all pairs, while particles move. */
#include "solver/skin.h"
#include "tests/unit/clouds.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <omp.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 512, LANES = 4 };

/* A box whose particles belong to two bodies in turn, and where they are now. */
struct moving {
    struct solver_cloud *cloud;
    struct solver_skin skin;
    double x[MOST * LANES];
    uint64_t random;
};

static void begin(struct moving *moving, int dim, double radius, enum solver_pairs which)
{
    struct solver_error error = {.code = SOLVER_OK};
    struct solver_box box = clouds_box(dim, dim == 1 ? 40 : dim == 2 ? 9 : 4, 0.2, 3);
    *moving = (struct moving){.cloud = clouds_make(&box), .random = 11};
    size_t count = moving->cloud->count;
    CU_ASSERT_FATAL(count <= MOST);
    moving->cloud->body = calloc(count, sizeof *moving->cloud->body);
    CU_ASSERT_PTR_NOT_NULL_FATAL(moving->cloud->body);
    for (size_t a = 0; a < MOST * LANES; a++) {
        moving->x[a] = NAN; /* what is beyond dim must not be read */
    }
    for (size_t a = 0; a < count; a++) {
        moving->cloud->body[a] = (uint32_t)(a % 2);
        memcpy(moving->x + a * LANES, moving->cloud->X + a * (size_t)dim, (size_t)dim * sizeof(double));
    }
    CU_ASSERT_FATAL(solver_skin_create(moving->cloud, radius * box.spacing, which, &moving->skin, &error));
}

static void end(struct moving *moving)
{
    solver_skin_free(&moving->skin);
    CU_ASSERT(moving->skin.built == NULL && moving->skin.graph.row == NULL);
    solver_cloud_free(moving->cloud);
}

/* Every particle by up to `most` spacings along each axis. */
static void move(struct moving *moving, double most)
{
    for (size_t a = 0; a < moving->cloud->count; a++) {
        for (size_t i = 0; i < (size_t)moving->cloud->dim; i++) {
            moving->x[a * LANES + i] += most * moving->cloud->spacing * clouds_random(&moving->random);
        }
    }
}

static double distance(const struct moving *moving, size_t a, size_t b)
{
    double square = 0.0;
    for (size_t i = 0; i < (size_t)moving->cloud->dim; i++) {
        double d = moving->x[b * LANES + i] - moving->x[a * LANES + i];
        square += d * d;
    }
    return sqrt(square);
}

/* Pairs within the radius that the list lacks, entries that are no pairs of the right kind, and those so far apart
 * that the list is older than it should be. */
static size_t faults(const struct moving *moving)
{
    const struct solver_skin *skin = &moving->skin;
    double reach = skin->radius + 2.0 * skin->margin; /* as listed, and each particle half a margin away since */
    size_t wrong = 0;
    size_t found = 0;
    for (size_t a = 0; a < moving->cloud->count; a++) {
        size_t next = skin->graph.row[a];
        for (size_t b = 0; b < moving->cloud->count; b++) {
            bool listed = next < skin->graph.row[a + 1] && skin->graph.neighbour[next] == b;
            bool together = moving->cloud->body[a] == moving->cloud->body[b];
            bool right = a != b && together == (skin->which == SOLVER_PAIRS_WITHIN);
            double apart = distance(moving, a, b);
            wrong += right && apart < skin->radius && !listed;
            wrong += listed && (!right || apart > reach * (1.0 + 1e-12));
            next += listed;
            found += listed;
        }
        wrong += next != skin->graph.row[a + 1];
    }
    return wrong + (found != solver_skin_pairs(skin));
}

static void test_moving(void)
{
    static const enum solver_pairs kinds[] = {SOLVER_PAIRS_WITHIN, SOLVER_PAIRS_BETWEEN};
    struct solver_error error;
    for (int dim = 1; dim <= 3; dim++) {
        for (size_t i = 0; i < 2; i++) {
            struct moving moving;
            begin(&moving, dim, 2.4, kinds[i]);
            CU_ASSERT_EQUAL(moving.skin.updates, 1);
            for (int step = 0; step < 60; step++) {
                move(&moving, 0.02);
                CU_ASSERT_FATAL(solver_skin_update(&moving.skin, moving.x, LANES, &error));
                CU_ASSERT_EQUAL(faults(&moving), 0);
            }
            CU_ASSERT(moving.skin.updates > 2 && moving.skin.updates < 30); /* now and then, not each time */
            size_t before = moving.skin.updates;
            move(&moving, 1.0);
            CU_ASSERT_FATAL(solver_skin_update(&moving.skin, moving.x, LANES, &error));
            CU_ASSERT_EQUAL(moving.skin.updates, before + 1);
            CU_ASSERT_EQUAL(faults(&moving), 0);
            end(&moving);
        }
    }
}

/* Two particles that close in on one another from beyond the radius plus the margin are found in time, however the way
 * is cut into steps. */
static void test_just_in_time(void)
{
    struct solver_error error;
    for (int steps = 1; steps < 40; steps++) {
        struct moving moving;
        begin(&moving, 1, 2.4, SOLVER_PAIRS_WITHIN);
        double width = moving.skin.radius + moving.skin.margin;
        size_t last = moving.cloud->count - 1;
        moving.cloud->body[last] = moving.cloud->body[0];
        for (size_t a = 0; a <= last; a++) {
            moving.x[a * LANES] = 100.0 * (double)a;
        }
        moving.x[last * LANES] = moving.x[0] + 1.001 * width;
        CU_ASSERT_FATAL(solver_skin_update(&moving.skin, moving.x, LANES, &error));
        for (int step = 0; step < steps; step++) {
            moving.x[0] += 0.1 * width / steps;
            moving.x[last * LANES] -= 0.1 * width / steps;
            CU_ASSERT_FATAL(solver_skin_update(&moving.skin, moving.x, LANES, &error));
            CU_ASSERT_EQUAL(faults(&moving), 0);
        }
        CU_ASSERT(distance(&moving, 0, last) < moving.skin.radius);
        end(&moving);
    }
}

/* Particles that swing to and fro ask for no memory after the first time. */
static void test_memory(void)
{
    struct solver_error error;
    struct moving moving;
    begin(&moving, 3, 2.4, SOLVER_PAIRS_WITHIN);
    double at_rest[MOST * LANES];
    memcpy(at_rest, moving.x, sizeof at_rest);
    struct solver_skin first = moving.skin;
    for (int step = 1; step <= 80; step++) {
        for (size_t a = 0; a < moving.cloud->count; a++) {
            double stretch = 1.0 + 0.15 * (1.0 - cos(0.4 * step));
            for (size_t i = 0; i < 3; i++) {
                moving.x[a * LANES + i] = at_rest[a * LANES + i] * stretch;
            }
        }
        CU_ASSERT_FATAL(solver_skin_update(&moving.skin, moving.x, LANES, &error));
        CU_ASSERT_EQUAL(faults(&moving), 0);
        CU_ASSERT(moving.skin.graph.row == first.graph.row && moving.skin.graph.neighbour == first.graph.neighbour);
        CU_ASSERT(moving.skin.built == first.built && moving.skin.graph.neighbour_room == first.graph.neighbour_room);
    }
    CU_ASSERT(moving.skin.updates > 10);
    end(&moving);
}

/* The particle that is lost is named by its number and where it started; the list stays as it was. */
static void test_lost(void)
{
    unit_untrapped();
    static const double bad[] = {NAN, INFINITY, -INFINITY, 1e200};
    struct moving moving;
    begin(&moving, 2, 2.4, SOLVER_PAIRS_WITHIN);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct solver_error error = {.code = SOLVER_OK};
        char expected[128];
        double kept = moving.x[77 * LANES + 1];
        const double *X = moving.cloud->X + 77 * 2;
        (void)snprintf(expected, sizeof expected, "particle 77 at X = (%g, %g, 0) m: position x is not finite", X[0],
                       X[1]);
        moving.x[77 * LANES + 1] = bad[i];
        moving.x[90 * LANES] = bad[i];
        size_t updates = moving.skin.updates;
        CU_ASSERT_FALSE(solver_skin_update(&moving.skin, moving.x, LANES, &error));
        CU_ASSERT_EQUAL(error.code, SOLVER_BROKE_DOWN);
        CU_ASSERT_EQUAL(strncmp(error.text, expected, strlen(expected)), 0);
        moving.x[77 * LANES + 1] = kept;
        moving.x[90 * LANES] = moving.cloud->X[90 * 2];
        CU_ASSERT(solver_skin_update(&moving.skin, moving.x, LANES, &error));
        CU_ASSERT_EQUAL(moving.skin.updates, updates);
        CU_ASSERT_EQUAL(faults(&moving), 0);
    }
    end(&moving);
}

/* So many particles in one place that their pairs would fill the memory: an error, no list, and one again once they
 * are apart. */
static void test_collapsed(void)
{
    static const double edges[] = {1500, 50, 11};
    for (int dim = 1; dim <= 3; dim++) {
        struct solver_error error = {.code = SOLVER_OK};
        struct solver_box box = clouds_box(dim, (int)edges[dim - 1], 0.0, 1);
        struct solver_cloud *cloud = clouds_make(&box);
        struct solver_skin skin;
        CU_ASSERT_FATAL(solver_skin_create(cloud, 2.4 * box.spacing, SOLVER_PAIRS_WITHIN, &skin, &error));
        double *x = calloc(cloud->count * (size_t)dim, sizeof *x);
        CU_ASSERT_PTR_NOT_NULL_FATAL(x);
        size_t pairs = solver_skin_pairs(&skin);
        CU_ASSERT_FALSE(solver_skin_update(&skin, x, (size_t)dim, &error));
        CU_ASSERT_EQUAL(error.code, SOLVER_BROKE_DOWN);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "particle 0: more than 1024 others are nearer than 0.13 m"));
        CU_ASSERT_EQUAL(solver_skin_pairs(&skin), 0);
        CU_ASSERT_FALSE(solver_skin_update(&skin, x, (size_t)dim, &error));
        CU_ASSERT(solver_skin_update(&skin, cloud->X, (size_t)dim, &error));
        CU_ASSERT_EQUAL(solver_skin_pairs(&skin), pairs);
        free(x);
        solver_skin_free(&skin);
        solver_cloud_free(cloud);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"moving particles", test_moving}, {"two that close in", test_just_in_time}, {"memory", test_memory},
        {"lost particles", test_lost},     {"collapsed particles", test_collapsed},
    };
    omp_set_num_threads(1); /* the bodies are small; threads have tests of their own */
    return unit_main("skin", tests, sizeof tests / sizeof *tests);
}
