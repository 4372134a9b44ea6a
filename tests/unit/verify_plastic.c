/* Measures of plastic flow, on a square whose strains are given. */
#include "tests/unit/unit.h"
#include "verify/measures.h"

#include <math.h>

enum { SIDE = 21, COUNT = SIDE * SIDE };

static double X[2 * COUNT], u[2 * COUNT], V[COUNT], J[COUNT], strain[COUNT];

/* The unit square, pulled to twice its length along x, with strains by a formula of where particles are now. */
static struct solver_output square(const struct solver_cloud *cloud, double (*of)(double x, double y))
{
    for (int a = 0; a < COUNT; a++) {
        int row = a / SIDE;
        X[2 * a] = (double)(a % SIDE) / (SIDE - 1);
        X[2 * a + 1] = (double)row / (SIDE - 1);
        u[2 * a] = X[2 * a];
        V[a] = 1.0;
        J[a] = 2.0;
        strain[a] = of(2.0 * X[2 * a], X[2 * a + 1]);
    }
    return (struct solver_output){.cloud = cloud, .u = u, .V = V, .J = J, .plastic_strain = strain};
}

static double same(double x, double y)
{
    (void)x;
    (void)y;
    return 0.7;
}

static double linear(double x, double y)
{
    return 0.3 + 0.5 * x + 0.2 * y;
}

static double measured(double (*of)(double x, double y), const double from[2], const double to[2])
{
    const struct solver_cloud cloud = {.dim = 2, .count = COUNT, .spacing = 1.0 / (SIDE - 1), .X = X};
    struct solver_output output = square(&cloud, of);
    const struct verify_measuring in = {.output = &output};
    const struct verify_argument argument[] = {{.number = 0}, {.place = {from[0], from[1]}}, {.place = {to[0], to[1]}}};
    double value = 0.0;
    struct solver_error error;
    CU_ASSERT(verify_plastic_section(&in, argument, &value, &error));
    return value;
}

/* Where the body is now, and not where it was; nowhere else. */
static void section(void)
{
    static const double from[] = {1.5, 0.2}, to[] = {1.5, 0.8}, off[] = {3.0, 0.5};
    CU_ASSERT_DOUBLE_EQUAL(measured(same, from, to), 0.7, 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(measured(linear, from, to), 0.3 + 0.5 * 1.5 + 0.2 * 0.5, 2e-3);
    CU_ASSERT(isnan(measured(same, from, off)));
}

static double of_one(double x, double y)
{
    return x == 1.0 && y == 0.5 ? 1.0 : 0.0;
}

/* The mean is by the kernel of eq. 3.4 (004_0c0448173ed5e9bd.txt), of which 16 is at a particle, 1 a spacing away and
 * nothing two spacings away, as neighbours along x now are. */
static void weights(void)
{
    static const double place[] = {1.0, 0.5};
    CU_ASSERT_DOUBLE_EQUAL(measured(of_one, place, place), 16.0 / 18.0, 1e-12);
}

/* Volumes are those of now: neighbours that have become three times as large count three times. */
static void volumes_of_now(void)
{
    const struct solver_cloud cloud = {.dim = 2, .count = COUNT, .spacing = 1.0 / (SIDE - 1), .X = X};
    struct solver_output output = square(&cloud, of_one);
    const struct verify_measuring in = {.output = &output};
    const struct verify_argument argument[] = {{.number = 0}, {.place = {1.0, 0.5}}, {.place = {1.0, 0.5}}};
    double value = 0.0;
    struct solver_error error;
    for (size_t a = 0; a < COUNT; a++) {
        J[a] *= X[2 * a + 1] != 0.5 ? 3.0 : 1.0;
    }
    CU_ASSERT(verify_plastic_section(&in, argument, &value, &error));
    CU_ASSERT_DOUBLE_EQUAL(value, 16.0 / 22.0, 1e-12);
}

static void largest(void)
{
    const struct solver_cloud cloud = {.dim = 2, .count = COUNT, .spacing = 1.0 / (SIDE - 1), .X = X};
    struct solver_output output = square(&cloud, linear);
    const struct verify_measuring in = {.output = &output};
    double value;
    struct solver_error error;
    CU_ASSERT(verify_plastic_most(&in, NULL, &value, &error));
    CU_ASSERT_DOUBLE_EQUAL(value, 1.5, 1e-14);
    strain[7] = NAN;
    CU_ASSERT(verify_plastic_most(&in, NULL, &value, &error) && isnan(value));
}

/* A ram that presses with 3 N along -y for 2 s at 0.5 m/s does 3 J; 2.5 of them are accounted for. The walls' part of
 * the impulse is none of the ram's. */
static void ram(void)
{
    struct solver_totals totals[] = {
        {.linear = {0, -1, 0}, .kinetic = 0.25},
        {.time = 2, .linear = {0, -2, 0}, .wall = {4, -5, 0}, .kinetic = 0.5, .strain = 0.25, .plastic = 2}};
    const struct solver_history history = {.count = 2, .totals = totals};
    const struct verify_measuring in = {.history = &history};
    const struct verify_argument argument[] = {{.axis = 1}, {.number = -0.5}};
    double value;
    struct solver_error error;
    CU_ASSERT(verify_ram_loss(&in, argument, &value, &error));
    CU_ASSERT_DOUBLE_EQUAL(value, (3.0 + 0.25 - 2.75) / 2.0, 1e-14);
    CU_ASSERT(verify_plastic_work(&in, NULL, &value, &error));
    CU_ASSERT_EQUAL(value, 2.0);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"strain across a section", section},
        {"weights of a section", weights},
        {"volumes of now", volumes_of_now},
        {"largest strain", largest},
        {"work of a ram", ram},
    };
    return unit_main("measures of plastic flow", tests, sizeof tests / sizeof *tests);
}
