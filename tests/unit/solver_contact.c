/* Contact between bodies: forces of two particles by the formula (001_363f711843f01da4.txt eq. 53, 54), and what
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
    double x[MOST * LANES], v[MOST * LANES], v_rate[MOST * LANES];
};

static const double dt = 1e-3; /* [s] */

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
        bodies->x[k] = bodies->v[k] = bodies->v_rate[k] = NAN; /* what is beyond dim must not be read */
    }
    (void)snprintf(bodies->scene.path, sizeof bodies->scene.path, "touching.lua");
    bodies->body =
        (struct solver_body){.scene = &bodies->scene, .cloud = cloud, .constants = bodies->constants, .stride = 1};
}

static bool create(struct bodies *bodies, enum solver_contact_law law, double distance, struct solver_error *error)
{
    bodies->scene.contact_law = (int)law;
    bodies->scene.contact_distance = distance;
    return solver_contact_create(&bodies->body, bodies->cloud->V, &bodies->contact, error);
}

static void act(struct bodies *bodies)
{
    struct solver_error error = {.code = SOLVER_OK};
    CU_ASSERT_FATAL(solver_contact_act(&bodies->contact, bodies->x, bodies->v, LANES, 7.0, dt, bodies->v_rate, &error));
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

/* To the bit; what lies beyond dim is NaN in both. */
static bool same(const struct bodies *bodies, const double *left, const double *right)
{
    return memcmp(left, right, bodies->cloud->count * LANES * sizeof *left) == 0;
}

/* Velocities at the end of a step of size dt that begins with v_rate: those that the predicted law has in mind. The
 * printed one has only v in mind, whatever else acts. */
static void foresee(const struct bodies *bodies, const double *v_rate, double *foreseen)
{
    for (size_t k = 0; k < MOST * LANES; k++) {
        foreseen[k] = bodies->v[k] + dt * v_rate[k];
    }
}

static void measure(const struct bodies *bodies, const double *v, double momentum[3], double *kinetic)
{
    memset(momentum, 0, 3 * sizeof *momentum);
    *kinetic = 0.0;
    for (size_t a = 0; a < bodies->cloud->count; a++) {
        for (size_t i = 0; i < (size_t)bodies->cloud->dim; i++) {
            momentum[i] += mass(bodies, a) * v[a * LANES + i];
            *kinetic += 0.5 * mass(bodies, a) * v[a * LANES + i] * v[a * LANES + i];
        }
    }
}

static double approach_of(const struct bodies *bodies, const double *v, const double *direction)
{
    double sum = 0.0;
    for (size_t i = 0; i < (size_t)bodies->cloud->dim; i++) {
        sum += (v[LANES + i] - v[i]) * direction[i];
    }
    return sum;
}

static const enum solver_contact_law laws[] = {SOLVER_CONTACT_PRINTED, SOLVER_CONTACT_PREDICTED};

/* Random velocities; random accelerations under the predicted law, none under the printed one, which does not see them:
 * `foreseen` is then what either stops. */
static void shake(struct bodies *bodies, double *foreseen)
{
    bool sees = bodies->contact.law == SOLVER_CONTACT_PREDICTED;
    for (size_t a = 0; a < bodies->cloud->count; a++) {
        for (size_t i = 0; i < (size_t)bodies->cloud->dim; i++) {
            bodies->v[a * LANES + i] = uniform(-1.0, 1.0);
            bodies->v_rate[a * LANES + i] = sees ? uniform(-1e3, 1e3) : 0.0;
        }
    }
    foresee(bodies, bodies->v_rate, foreseen);
}

/* The second particle `apart` along n from the first; all others are far away. n becomes the direction that round-off
 * leaves. */
static void pose(struct bodies *bodies, double *n, double apart)
{
    double length = 0.0;
    for (size_t a = 0; a < bodies->cloud->count; a++) {
        for (size_t i = 0; i < (size_t)bodies->cloud->dim; i++) {
            bodies->x[a * LANES + i] = a < 2 ? 0.3 + (double)a * apart * n[i] : 100.0 * (double)a;
        }
    }
    for (size_t i = 0; i < (size_t)bodies->cloud->dim; i++) {
        n[i] = bodies->x[LANES + i] - bodies->x[i];
        length = hypot(length, n[i]);
    }
    for (size_t i = 0; i < (size_t)bodies->cloud->dim && apart > 0.0; i++) {
        n[i] /= length;
    }
}

/* Two that would approach along n with `approach` < 0: they do not, the masses share what that takes, and nothing
 * happens across n. */
static void check_stopped(const struct bodies *bodies, const double *before, const double *n, double ratio)
{
    double after[MOST * LANES];
    double momentum[2][3];
    double energy[2];
    size_t dim = (size_t)bodies->cloud->dim;
    double approach = approach_of(bodies, before, n);
    foresee(bodies, bodies->v_rate, after);
    measure(bodies, before, momentum[0], &energy[0]);
    measure(bodies, after, momentum[1], &energy[1]);
    CU_ASSERT_DOUBLE_EQUAL(approach_of(bodies, after, n), 0.0, 1e-14);
    double reduced = 2.0 * ratio / (1.0 + ratio); /* of masses 2 and 2 ratio */
    CU_ASSERT_DOUBLE_EQUAL(energy[0] - energy[1], 0.5 * reduced * approach * approach, 1e-13 * energy[0]);
    CU_ASSERT(largest_difference(dim, momentum[0], momentum[1]) <= 1e-14 * ratio);
    for (size_t k = 0; k < dim; k++) {
        CU_ASSERT_DOUBLE_EQUAL(after[k] - before[k], approach * ratio / (1.0 + ratio) * n[k], 1e-14);
    }
}

/* Two that approach stop doing so; two that part, or are farther apart than the distance, go on. */
static void test_two(void)
{
    static const double ratios[] = {1.0, 3.5, 1e6};
    for (size_t i = 0; i < 18; i++) {
        struct bodies bodies;
        struct solver_error error;
        size_t dim = i / 2 % 3 + 1;
        size_t stopped = 0;
        make(&bodies, (int)dim, 1, ratios[i / 6]);
        CU_ASSERT_FATAL(create(&bodies, laws[i % 2], 0.06, &error));
        CU_ASSERT(isnan(bodies.contact.begin) && isnan(bodies.contact.end));
        for (int trial = 0; trial < 50; trial++) {
            double n[3];
            double foreseen[MOST * LANES];
            double v_rate[MOST * LANES];
            double apart = trial % 5 == 0 ? 0.0601 : uniform(0.001, 0.0599);
            random_direction(dim, n);
            pose(&bodies, n, apart);
            shake(&bodies, foreseen);
            memcpy(v_rate, bodies.v_rate, sizeof v_rate);
            act(&bodies);
            if (approach_of(&bodies, foreseen, n) < 0.0 && trial % 5 != 0) {
                check_stopped(&bodies, foreseen, n, ratios[i / 6]);
                stopped++;
            } else {
                CU_ASSERT(same(&bodies, v_rate, bodies.v_rate));
            }
        }
        CU_ASSERT(stopped > 5 && stopped < 40);
        CU_ASSERT(bodies.contact.begin == 7.0 && bodies.contact.end == 7.0);
        drop(&bodies);
    }
}

/* As printed, the force is of the velocities alone: what presses the two together comes on top. */
static void test_printed(void)
{
    struct bodies bodies;
    struct solver_error error;
    double foreseen[MOST * LANES];
    double n[3] = {1.0};
    make(&bodies, 1, 1, 1.0);
    CU_ASSERT_FATAL(create(&bodies, SOLVER_CONTACT_PRINTED, 0.06, &error));
    pose(&bodies, n, 0.05);
    shake(&bodies, foreseen);
    bodies.v[0] = 0.3;
    bodies.v[LANES] = -0.5;
    bodies.v_rate[0] = 10.0;
    bodies.v_rate[LANES] = -10.0;
    act(&bodies);
    CU_ASSERT_DOUBLE_EQUAL(bodies.v_rate[0], 10.0 - 0.4 / dt, 1e-11);
    CU_ASSERT_DOUBLE_EQUAL(bodies.v_rate[LANES], -10.0 + 0.4 / dt, 1e-11);
    drop(&bodies);
}

/* Particles of the same body, and particles at the same place, do nothing to one another. */
static void test_none(void)
{
    struct bodies bodies;
    struct solver_error error;
    double foreseen[MOST * LANES];
    double v_rate[MOST * LANES];
    make(&bodies, 2, 1, 1.0);
    for (size_t i = 0; i < 5; i++) {
        bool together = i % 2 == 0;
        bodies.cloud->body[1] = together ? 0 : 1;
        CU_ASSERT_FATAL(create(&bodies, i == 4 ? SOLVER_CONTACT_NONE : laws[i / 2], 0.0, &error));
        CU_ASSERT_EQUAL(bodies.contact.distance, i == 4 ? 0.0 : bodies.cloud->spacing);
        for (int trial = 0; trial < 10; trial++) {
            pose(&bodies, (double[3]){1.0}, together ? 0.01 : 0.0);
            shake(&bodies, foreseen);
            memcpy(v_rate, bodies.v_rate, sizeof v_rate);
            act(&bodies);
            CU_ASSERT(same(&bodies, v_rate, bodies.v_rate));
        }
        CU_ASSERT(isnan(bodies.contact.begin));
        solver_contact_free(&bodies.contact);
    }
    drop(&bodies);
}

/* Both bodies mixed up in a heap, each particle with a motion of its own. */
static void heap(struct bodies *bodies, double *foreseen)
{
    for (size_t a = 0; a < bodies->cloud->count; a++) {
        for (size_t i = 0; i < (size_t)bodies->cloud->dim; i++) {
            bodies->x[a * LANES + i] = uniform(0.0, 0.1);
        }
    }
    shake(bodies, foreseen);
}

/* Each force alone takes energy from the motion that it foresees. One after the other, each seeing what those before
 * it did, they take it all the way; all of the same velocities, as printed, they may give it. */
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
            double before[MOST * LANES];
            double after[MOST * LANES];
            double momentum[2][3];
            double energy[2];
            heap(&bodies, before);
            act(&bodies);
            foresee(&bodies, bodies.v_rate, after);
            measure(&bodies, before, momentum[0], &energy[0]);
            measure(&bodies, after, momentum[1], &energy[1]);
            CU_ASSERT(largest_difference(3, momentum[0], momentum[1]) <= 1e-13 * energy[0]);
            gains += energy[1] > energy[0];
            most = fmax(most, energy[1] / energy[0]);
        }
        printf("\n    %zuD %s: %zu of 100 heaps gain energy, at most %.2f of what was there", i / 2 + 1,
               i % 2 == 0 ? "printed" : "predicted", gains, most);
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
        double foreseen[MOST * LANES];
        double v_rate[MOST * LANES];
        double first[MOST * LANES];
        struct solver_error error;
        make(&bodies, 3, 5, 3.0);
        CU_ASSERT_FATAL(create(&bodies, laws[law], 0.05, &error));
        heap(&bodies, foreseen);
        memcpy(v_rate, bodies.v_rate, sizeof v_rate);
        for (int number = 4; number >= 1; number--) {
            omp_set_num_threads(number);
            memcpy(bodies.v_rate, v_rate, sizeof v_rate);
            act(&bodies);
            if (number == 4) {
                memcpy(first, bodies.v_rate, sizeof first);
            }
            CU_ASSERT(same(&bodies, first, bodies.v_rate));
        }
        CU_ASSERT_FALSE(same(&bodies, first, v_rate));
        drop(&bodies);
    }
    omp_set_num_threads(threads);
}

static void test_refused(void)
{
    struct bodies bodies;
    struct solver_error error = {.code = SOLVER_OK};
    make(&bodies, 2, 2, 1.0);
    CU_ASSERT_FALSE(create(&bodies, SOLVER_CONTACT_PRINTED, 0.21, &error));
    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
    CU_ASSERT_PTR_NOT_NULL(
        strstr(error.text, "touching.lua: contact.distance: expected at most 4 spacings, 0.2 m, got 0.21 m"));
    free(bodies.cloud->body);
    bodies.cloud->body = NULL;
    CU_ASSERT_FALSE(create(&bodies, SOLVER_CONTACT_PREDICTED, 0.0, &error));
    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "touching.lua: contact.law: there is one body"));
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "expected several under bodies"));
    CU_ASSERT(create(&bodies, SOLVER_CONTACT_NONE, 0.0, &error)); /* none is no contact */
    drop(&bodies);
}

/* Bodies so fast that within a step they could pass through one another, whatever axis they move along. */
static void test_fast(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct bodies bodies;
        struct solver_error error = {.code = SOLVER_OK};
        double foreseen[MOST * LANES];
        double v_rate[MOST * LANES];
        double *last = &bodies.v[(size_t)dim - 1];
        make(&bodies, dim, 2, 1.0);
        CU_ASSERT_FATAL(create(&bodies, SOLVER_CONTACT_PRINTED, 0.06, &error));
        heap(&bodies, foreseen);
        memcpy(v_rate, bodies.v_rate, sizeof v_rate);
        last[0] = 70.0;
        last[LANES] = 11.0; /* a millisecond at 59 m/s */
        for (size_t a = 2; a < bodies.cloud->count; a++) {
            last[a * LANES] = 40.0;
        }
        CU_ASSERT(solver_contact_act(&bodies.contact, bodies.x, bodies.v, LANES, 0.0, dt, bodies.v_rate, &error));
        memcpy(bodies.v_rate, v_rate, sizeof v_rate);
        last[LANES] = 9.0;
        CU_ASSERT_FALSE(solver_contact_act(&bodies.contact, bodies.x, bodies.v, LANES, 0.0, dt, bodies.v_rate, &error));
        CU_ASSERT_EQUAL(error.code, SOLVER_BROKE_DOWN);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "particles move past one another by up to 0.061"));
        CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "bodies touch at 0.06 m: they would go through one another unseen"));
        CU_ASSERT(same(&bodies, v_rate, bodies.v_rate));
        drop(&bodies);
    }
}

static void test_lost(void)
{
    struct bodies bodies;
    struct solver_error error = {.code = SOLVER_OK};
    make(&bodies, 2, 2, 1.0);
    CU_ASSERT_FATAL(create(&bodies, SOLVER_CONTACT_PREDICTED, 0.0, &error));
    double foreseen[MOST * LANES];
    heap(&bodies, foreseen);
    bodies.x[3 * LANES] = NAN;
    CU_ASSERT_FALSE(solver_contact_act(&bodies.contact, bodies.x, bodies.v, LANES, 0.0, dt, bodies.v_rate, &error));
    CU_ASSERT_EQUAL(error.code, SOLVER_BROKE_DOWN);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "particle 3 at X = "));
    drop(&bodies);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"two particles", test_two},      {"as printed", test_printed},  {"no contact", test_none},
        {"energy of heaps", test_energy}, {"threads", test_threads},     {"refusals", test_refused},
        {"too fast", test_fast},          {"lost particles", test_lost},
    };
    return unit_main("contact", tests, sizeof tests / sizeof *tests);
}
