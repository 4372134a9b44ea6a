/* Contact between bodies: impulses of two particles by the formula (001_363f711843f01da4.txt eq. 53, 54), and what
 * holds for many of them. */
#include "solver/contact.h"
#include "tests/unit/clouds.h"
#include "tests/unit/random_tensors.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 512, LANES = 4 };

/* Two bodies, a particle of each in turn; the second may be denser. */
struct bodies {
    struct solver_scene scene;
    struct solver_cloud *cloud;
    struct solver_material_constants *constants;
    struct solver_body body;
    struct solver_contact contact;
    double x[MOST * LANES], v[MOST * LANES];
};

static void make(struct bodies *bodies, int dim, int edge, double ratio)
{
    struct solver_box box = clouds_box(dim, edge, 0.0, 1);
    *bodies = (struct bodies){.cloud = clouds_make(&box)};
    struct solver_cloud *cloud = bodies->cloud;
    CU_ASSERT_FATAL(cloud->count <= MOST);
    cloud->body = calloc(cloud->count, sizeof *cloud->body);
    bodies->constants = calloc(cloud->count, sizeof *bodies->constants);
    CU_ASSERT_FATAL(cloud->body != NULL && bodies->constants != NULL);
    for (size_t a = 0; a < cloud->count; a++) {
        cloud->body[a] = (uint32_t)(a % 2);
        cloud->V[a] = 1.0; /* whatever the box has on its faces */
        bodies->constants[a].rho = a % 2 == 0 ? 2.0 : 2.0 * ratio;
    }
    for (size_t k = 0; k < MOST * LANES; k++) {
        bodies->x[k] = bodies->v[k] = NAN; /* what is beyond dim must not be read */
    }
    (void)snprintf(bodies->scene.path, sizeof bodies->scene.path, "touching.lua");
    bodies->body =
        (struct solver_body){.scene = &bodies->scene, .cloud = cloud, .constants = bodies->constants, .stride = 1};
}

static bool create(struct bodies *bodies, enum solver_contact_law law, double distance, struct solver_error *error)
{
    bodies->scene.contact_law = law;
    bodies->scene.contact_distance = distance;
    return solver_contact_create(&bodies->body, bodies->cloud->V, &bodies->contact, error);
}

static void apply(struct bodies *bodies)
{
    struct solver_error error = {.code = SOLVER_OK};
    CU_ASSERT_FATAL(solver_contact_apply(&bodies->contact, bodies->x, LANES, bodies->v, &error));
}

static void drop(struct bodies *bodies)
{
    solver_contact_free(&bodies->contact);
    solver_cloud_free(bodies->cloud);
    free(bodies->constants);
}

static double mass(const struct bodies *bodies, size_t a)
{
    return bodies->cloud->V[a] * bodies->constants[a].rho;
}

static void measure(const struct bodies *bodies, double momentum[3], double *kinetic)
{
    memset(momentum, 0, 3 * sizeof *momentum);
    *kinetic = 0.0;
    for (size_t a = 0; a < bodies->cloud->count; a++) {
        for (size_t i = 0; i < (size_t)bodies->cloud->dim; i++) {
            double v = bodies->v[a * LANES + i];
            momentum[i] += mass(bodies, a) * v;
            *kinetic += 0.5 * mass(bodies, a) * v * v;
        }
    }
}

static double relative(const struct bodies *bodies, const double *direction)
{
    double sum = 0.0;
    for (size_t i = 0; i < (size_t)bodies->cloud->dim; i++) {
        sum += (bodies->v[LANES + i] - bodies->v[i]) * direction[i];
    }
    return sum;
}

static const enum solver_contact_law laws[] = {SOLVER_CONTACT_PAIRWISE, SOLVER_CONTACT_SEQUENTIAL};

/* The second particle `apart` along n from the first, both with random velocities; all others are far away. n becomes
 * the direction that round-off leaves. */
static void pose(struct bodies *bodies, double *n, double apart)
{
    for (size_t a = 0; a < bodies->cloud->count; a++) {
        for (size_t i = 0; i < (size_t)bodies->cloud->dim; i++) {
            bodies->x[a * LANES + i] = a < 2 ? 0.3 + (double)a * apart * n[i] : 100.0 * (double)a;
            bodies->v[a * LANES + i] = uniform(-1.0, 1.0);
        }
    }
    double length = 0.0;
    for (size_t i = 0; i < (size_t)bodies->cloud->dim; i++) {
        n[i] = bodies->x[LANES + i] - bodies->x[i];
        length = hypot(length, n[i]);
    }
    for (size_t i = 0; i < (size_t)bodies->cloud->dim && apart > 0.0; i++) {
        n[i] /= length;
    }
}

/* Two that approach stop doing so, along their line and in no other direction; two that part, or are farther apart than
 * the distance, go on. */
static void test_two(void)
{
    static const double ratios[] = {1.0, 3.5, 1e6};
    for (size_t i = 0; i < 18; i++) {
        struct bodies bodies;
        struct solver_error error;
        double ratio = ratios[i / 6];
        size_t dim = i / 2 % 3 + 1;
        size_t stopped = 0;
        make(&bodies, (int)dim, 1, ratio);
        CU_ASSERT_FATAL(create(&bodies, laws[i % 2], 0.06, &error));
        for (int trial = 0; trial < 50; trial++) {
            double n[3];
            double before[3];
            double after[3];
            double energy[2];
            double v[MOST * LANES];
            double apart = trial % 5 == 0 ? 0.0601 : uniform(0.001, 0.0599);
            random_direction(dim, n);
            pose(&bodies, n, apart);
            memcpy(v, bodies.v, sizeof v);
            measure(&bodies, before, &energy[0]);
            double approach = relative(&bodies, n);
            bool touches = approach < 0.0 && trial % 5 != 0;
            apply(&bodies);
            measure(&bodies, after, &energy[1]);
            if (touches) {
                CU_ASSERT_DOUBLE_EQUAL(relative(&bodies, n), 0.0, 1e-14);
                double reduced = 2.0 * ratio / (1.0 + ratio); /* of masses 2 and 2 ratio */
                CU_ASSERT_DOUBLE_EQUAL(energy[0] - energy[1], 0.5 * reduced * approach * approach, 1e-13 * energy[0]);
                for (size_t k = 0; k < dim; k++) { /* the first moves along n alone */
                    double along = approach * ratio / (1.0 + ratio) * n[k];
                    CU_ASSERT_DOUBLE_EQUAL(bodies.v[k] - v[k], along, 1e-14);
                }
                stopped++;
            } else {
                CU_ASSERT_EQUAL(memcmp(v, bodies.v, sizeof v), 0);
            }
            CU_ASSERT(largest_difference(dim, before, after) <= 1e-14 * ratio);
        }
        CU_ASSERT(stopped > 5 && stopped < 40);
        drop(&bodies);
    }
}

/* Particles of the same body, and particles at the same place, do nothing to one another. */
static void test_none(void)
{
    struct bodies bodies;
    struct solver_error error;
    make(&bodies, 2, 1, 1.0);
    double v[MOST * LANES];
    for (size_t law = 0; law < 2; law++) {
        bodies.cloud->body[1] = 0;
        CU_ASSERT_FATAL(create(&bodies, laws[law], 0.0, &error));
        CU_ASSERT_EQUAL(bodies.contact.distance, bodies.cloud->spacing);
        pose(&bodies, (double[3]){1.0}, 0.01);
        memcpy(v, bodies.v, sizeof v);
        apply(&bodies);
        CU_ASSERT_EQUAL(memcmp(v, bodies.v, sizeof v), 0);
        solver_contact_free(&bodies.contact);
        bodies.cloud->body[1] = 1;
        CU_ASSERT_FATAL(create(&bodies, laws[law], 0.0, &error));
        pose(&bodies, (double[3]){1.0}, 0.0);
        memcpy(v, bodies.v, sizeof v);
        apply(&bodies);
        CU_ASSERT_EQUAL(memcmp(v, bodies.v, sizeof v), 0);
        solver_contact_free(&bodies.contact);
    }
    CU_ASSERT_FATAL(create(&bodies, SOLVER_CONTACT_NONE, 0.0, &error));
    apply(&bodies);
    CU_ASSERT_EQUAL(memcmp(v, bodies.v, sizeof v), 0);
    drop(&bodies);
}

/* Both bodies mixed up in a heap, each particle with a velocity of its own. */
static void heap(struct bodies *bodies)
{
    for (size_t a = 0; a < bodies->cloud->count; a++) {
        for (size_t i = 0; i < (size_t)bodies->cloud->dim; i++) {
            bodies->x[a * LANES + i] = uniform(0.0, 0.1);
            bodies->v[a * LANES + i] = uniform(-1.0, 1.0);
        }
    }
}

/* Each impulse alone takes energy. One after the other they take it all the way; all at once, each from velocities
 * that the others are about to change, they may give it. */
static void test_energy(void)
{
    for (size_t i = 0; i < 6; i++) {
        struct bodies bodies;
        struct solver_error error;
        size_t gains = 0;
        double most = 0.0;
        make(&bodies, (int)(i / 2) + 1, i < 2 ? 20 : 3, 3.0);
        CU_ASSERT_FATAL(create(&bodies, laws[i % 2], 0.05, &error));
        for (int trial = 0; trial < 100; trial++) {
            double before[3];
            double after[3];
            double energy[2];
            heap(&bodies);
            measure(&bodies, before, &energy[0]);
            apply(&bodies);
            measure(&bodies, after, &energy[1]);
            CU_ASSERT(largest_difference(3, before, after) <= 1e-13 * energy[0]);
            gains += energy[1] > energy[0];
            most = fmax(most, energy[1] / energy[0]);
        }
        printf("\n    %zuD %s: %zu of 100 heaps gain energy, at most %.2f of what was there", i / 2 + 1,
               i % 2 == 0 ? "pairwise" : "sequential", gains, most);
        CU_ASSERT(i % 2 == 0 ? gains > 0 && most > 1.1 : gains == 0);
        drop(&bodies);
    }
}

/* The same bytes for any number of threads. */
static void test_threads(void)
{
    int threads = omp_get_max_threads();
    for (size_t law = 0; law < 2; law++) {
        static struct bodies bodies;
        static double x[MOST * LANES];
        static double v[MOST * LANES];
        static double first[MOST * LANES];
        struct solver_error error;
        make(&bodies, 3, 5, 3.0);
        CU_ASSERT_FATAL(create(&bodies, laws[law], 0.05, &error));
        heap(&bodies);
        memcpy(x, bodies.x, sizeof x);
        memcpy(v, bodies.v, sizeof v);
        for (int number = 1; number <= 5; number++) {
            omp_set_num_threads(number);
            memcpy(bodies.v, v, sizeof v);
            apply(&bodies);
            memcpy(number == 1 ? first : bodies.v, bodies.v, sizeof v);
            CU_ASSERT_EQUAL(memcmp(first, bodies.v, sizeof v), 0);
        }
        CU_ASSERT(memcmp(first, v, sizeof v) != 0);
        drop(&bodies);
    }
    omp_set_num_threads(threads);
}

static void test_refused(void)
{
    struct bodies bodies;
    struct solver_error error = {.code = SOLVER_OK};
    make(&bodies, 2, 2, 1.0);
    CU_ASSERT_FALSE(create(&bodies, SOLVER_CONTACT_PAIRWISE, 0.21, &error));
    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
    CU_ASSERT_PTR_NOT_NULL(
        strstr(error.text, "touching.lua: contact.distance: expected at most 4 spacings, 0.2 m, got 0.21 m"));
    free(bodies.cloud->body);
    bodies.cloud->body = NULL;
    CU_ASSERT_FALSE(create(&bodies, SOLVER_CONTACT_SEQUENTIAL, 0.0, &error));
    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "touching.lua: contact.law: there is one body"));
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "expected several under bodies"));
    CU_ASSERT(create(&bodies, SOLVER_CONTACT_NONE, 0.0, &error)); /* none is no contact */
    drop(&bodies);
}

static void test_lost(void)
{
    struct bodies bodies;
    struct solver_error error = {.code = SOLVER_OK};
    make(&bodies, 2, 2, 1.0);
    CU_ASSERT_FATAL(create(&bodies, SOLVER_CONTACT_SEQUENTIAL, 0.0, &error));
    heap(&bodies);
    bodies.x[3 * LANES] = NAN;
    CU_ASSERT_FALSE(solver_contact_apply(&bodies.contact, bodies.x, LANES, bodies.v, &error));
    CU_ASSERT_EQUAL(error.code, SOLVER_BROKE_DOWN);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "particle 3 at X = "));
    drop(&bodies);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"two particles", test_two}, {"no contact", test_none},  {"energy of heaps", test_energy},
        {"threads", test_threads},   {"refusals", test_refused}, {"lost particles", test_lost},
    };
    return unit_main("contact", tests, sizeof tests / sizeof *tests);
}
