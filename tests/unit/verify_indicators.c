/* Indicators on made-up particles and histories: they fire where they must and are quiet otherwise. */
#include "tests/unit/unit.h"
#include "verify/indicators.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 24 * 24 * 24 };
static double x[3 * MOST], V[MOST], pressure[MOST], value[VERIFY_INDICATORS];
static uint32_t body[MOST];
static int parity[MOST]; /* of a particle's place in the lattice */
static struct solver_error error;

/* A number in [-1, 1] that depends on i alone. */
static double noise(size_t i)
{
    uint64_t z = (i + 1) * 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    return 2.0 * (double)((z ^ (z >> 27)) >> 11) / 9007199254740992.0 - 1.0;
}

/* n^dim particles of spacing 1 / n, moved by up to `perturb` spacings along each axis. */
static struct solver_points lattice(int dim, size_t n, double perturb)
{
    size_t count = dim == 1 ? n : dim == 2 ? n * n : n * n * n;
    for (size_t a = 0; a < count; a++) {
        size_t site[3] = {a % n, a / n % n, a / n / n};
        parity[a] = (site[0] + site[1] + site[2]) % 2 == 0 ? 1 : -1;
        V[a] = pow(1.0 / (double)n, dim);
        for (size_t i = 0; i < (size_t)dim; i++) {
            x[a * (size_t)dim + i] = ((double)site[i] + perturb * noise(3 * a + i)) / (double)n;
        }
    }
    return (struct solver_points){.dim = dim, .count = count, .stride = (size_t)dim, .x = x};
}

static void measure(const struct solver_points *now, double spacing)
{
    value[VERIFY_CLUMPING] = value[VERIFY_CHECKERBOARD] = -1;
    CU_ASSERT_FATAL(verify_indicators_cloud(now, V, pressure, spacing, value, &error));
}

/* Two half waves along each axis, with a trend; `checkers` is added with alternating sign. */
static void pressures(const struct solver_points *now, double checkers)
{
    for (size_t a = 0; a < now->count; a++) {
        double wave = 1, trend = 0;
        for (size_t i = 0; i < now->stride; i++) {
            wave *= cos(2 * M_PI * x[a * now->stride + i]);
            trend += x[a * now->stride + i];
        }
        pressure[a] = 1e6 * (wave + trend + checkers * parity[a]);
    }
}

static double smooth_departure(int dim, size_t n, double perturb)
{
    struct solver_points now = lattice(dim, n, perturb);
    pressures(&now, 0);
    measure(&now, 1.0 / (double)n);
    return value[VERIFY_CHECKERBOARD];
}

/* Small, and falling with the square of the spacing, disordered or not. */
static void smooth_fields_are_quiet(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        for (int disordered = 0; disordered <= 1; disordered++) {
            double perturb = disordered ? 0.2 : 0;
            double coarse = smooth_departure(dim, 12, perturb), fine = smooth_departure(dim, 24, perturb);
            CU_ASSERT(coarse > 0 && fine < 0.03);
            CU_ASSERT(log2(coarse / fine) > 1.6);
        }
    }
}

/* A field that is linear is reproduced, wherever the particles are. */
static void linear_fields_are_silent(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct solver_points now = lattice(dim, 10, 0.2);
        for (size_t a = 0; a < now.count; a++) {
            pressure[a] = 3 + 2 * x[a * now.stride] - x[a * now.stride + now.stride - 1];
        }
        measure(&now, 0.1);
        CU_ASSERT(value[VERIFY_CHECKERBOARD] < 1e-12);
    }
}

static void checkerboards_fire(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        for (int disordered = 0; disordered <= 1; disordered++) {
            struct solver_points now = lattice(dim, 20, disordered ? 0.2 : 0);
            pressures(&now, 0);
            measure(&now, 0.05);
            double quiet = value[VERIFY_CHECKERBOARD];
            pressures(&now, 0.2); /* a fifth of the wave's height */
            measure(&now, 0.05);
            CU_ASSERT(value[VERIFY_CHECKERBOARD] > 0.06 && value[VERIFY_CHECKERBOARD] > 3 * quiet);
            for (size_t a = 0; a < now.count; a++) {
                pressure[a] = 7 * parity[a];
            }
            measure(&now, 0.05);
            CU_ASSERT(value[VERIFY_CHECKERBOARD] > 0.6);
            if (!disordered) { /* of 2, 8 or 18 neighbours 2, 4 or 6 are of the other sign */
                CU_ASSERT_DOUBLE_EQUAL(value[VERIFY_CHECKERBOARD], 2.0 / dim, 1e-12);
            }
        }
    }
}

static void no_pressure(void)
{
    struct solver_points now = lattice(2, 10, 0);
    memset(pressure, 0, sizeof pressure);
    measure(&now, 0.1);
    CU_ASSERT(isnan(value[VERIFY_CHECKERBOARD]));
    pressures(&now, 0);
    now.count = 1; /* no neighbours */
    measure(&now, 0.1);
    CU_ASSERT(isnan(value[VERIFY_CHECKERBOARD]));
    CU_ASSERT(value[VERIFY_CLUMPING] == 1.5);
    now.count = 100;
    unit_untrapped();
    pressure[55] = NAN;
    measure(&now, 0.1);
    CU_ASSERT(isnan(value[VERIFY_CHECKERBOARD]));
    pressure[55] = 0;
}

static void pairs_pulled_together(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct solver_points now = lattice(dim, 10, 0);
        measure(&now, 0.1);
        CU_ASSERT_DOUBLE_EQUAL(value[VERIFY_CLUMPING], 1, 1e-12);
        x[4 * now.stride] += 0.07; /* along X, towards its neighbour */
        measure(&now, 0.1);
        CU_ASSERT_DOUBLE_EQUAL(value[VERIFY_CLUMPING], 0.3, 1e-12);
        for (size_t i = 0; i < now.count * now.stride; i++) {
            x[i] *= 3; /* all apart */
        }
        measure(&now, 0.1);
        CU_ASSERT_DOUBLE_EQUAL(value[VERIFY_CLUMPING], 0.9, 1e-12); /* but for that pair */
    }
}

/* On a graded lattice smooth pressures are quiet and alternating ones are not, however the spacing changes, and what
 * counts of a distance is how much of it is left. */
static void graded_lattices(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct solver_cloud *cloud = NULL;
        struct solver_box box = {.dim = dim, .upper = {1.0, 1.0, 1.0}, .spacing = 1.0 / 16.0};
        box.grading[0] = (struct solver_grading){.ratio = 10.0};
        CU_ASSERT_FATAL(solver_cloud_box(&box, &cloud, &error));
        size_t stride = (size_t)dim;
        struct solver_points now = {.dim = dim, .count = cloud->count, .stride = stride, .x = cloud->X};
        for (size_t a = 0; a < cloud->count; a++) {
            size_t sites = 0;
            for (size_t i = 0; i < stride; i++) {
                sites += cloud->site[a * stride + i];
            }
            pressure[a] = 3 + 2 * cloud->X[a * stride] - cloud->X[a * stride + stride - 1];
            parity[a] = sites % 2 == 0 ? 1 : -1;
        }
        CU_ASSERT_FATAL(verify_indicators_lattice(cloud, &now, cloud->V, pressure, value, &error));
        CU_ASSERT(value[VERIFY_CHECKERBOARD] < 1e-12);
        CU_ASSERT_DOUBLE_EQUAL(value[VERIFY_CLUMPING], 1, 1e-12);
        for (size_t a = 0; a < cloud->count; a++) {
            pressure[a] = 7 * parity[a];
        }
        cloud->X[0] += 0.7 * cloud->plane[0][1]; /* from the corner, towards its neighbour */
        for (size_t i = 0; i < cloud->count * stride; i++) {
            x[i] = cloud->X[i];
        }
        cloud->X[0] -= 0.7 * cloud->plane[0][1];
        now.x = x;
        CU_ASSERT_FATAL(verify_indicators_lattice(cloud, &now, cloud->V, pressure, value, &error));
        CU_ASSERT(value[VERIFY_CHECKERBOARD] > 0.6);
        CU_ASSERT_DOUBLE_EQUAL(value[VERIFY_CLUMPING], 0.3, 1e-12);
        solver_cloud_free(cloud);
    }
}

/* Bodies that touch are no clump. */
static void bodies_apart(void)
{
    struct solver_points now = lattice(2, 10, 0);
    for (size_t a = 0; a < now.count; a++) {
        body[a] = a % 10 < 5 ? 0 : 1;
        x[2 * a] += body[a] == 1 ? -0.08 : 0;
    }
    now.body = body;
    measure(&now, 0.1);
    CU_ASSERT_DOUBLE_EQUAL(value[VERIFY_CLUMPING], 1, 1e-12);
    now.body = NULL;
    measure(&now, 0.1);
    CU_ASSERT_DOUBLE_EQUAL(value[VERIFY_CLUMPING], 0.2, 1e-12);
}

static void positions_that_are_none(void)
{
    unit_untrapped();
    struct solver_points now = lattice(2, 10, 0);
    x[7] = NAN;
    CU_ASSERT_FALSE(verify_indicators_cloud(&now, V, pressure, 0.1, value, &error));
    CU_ASSERT_EQUAL(error.code, SOLVER_BROKE_DOWN);
}

/* A body of 2 kg and 3 m with 25 J at most: 10 kg m/s in one direction. */
static void drifts(void)
{
    struct solver_totals totals[] = {
        {.time = 0, .linear = {1, 2, 3}, .angular = {4, 5, 6}, .kinetic = 20, .strain = 4},
        {.time = 1, .linear = {1.3, 2.4, 3}, .angular = {4, 5, 6.6}, .kinetic = 25, .strain = 1},
        {.time = 2, .linear = {1, 2, 3}, .angular = {4, 5, 6}, .kinetic = 10, .strain = 10},
    };
    const struct solver_history history = {.count = 3, .totals = totals};
    verify_indicators_history(&history, 2, 3, value);
    CU_ASSERT_DOUBLE_EQUAL(value[VERIFY_LINEAR_MOMENTUM], 0.05, 1e-15); /* on the way; in the end it is back */
    CU_ASSERT_DOUBLE_EQUAL(value[VERIFY_ANGULAR_MOMENTUM], 0.02, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(value[VERIFY_ENERGY_GAIN], 2.0 / 24, 1e-15);
    struct solver_history walled = {.count = 3, .totals = totals, .walled = true};
    totals[1].wall[0] = -0.3; /* of 0.3 and 0.4, which a wall has given and nobody knows */
    verify_indicators_history(&walled, 2, 3, value);
    CU_ASSERT_DOUBLE_EQUAL(value[VERIFY_LINEAR_MOMENTUM], 0.04, 1e-15);
    CU_ASSERT(isnan(value[VERIFY_ANGULAR_MOMENTUM])); /* where the wall pushed is not known */
    walled.mirrored[1] = true;                        /* 0.4 across a plane of symmetry */
    verify_indicators_history(&walled, 2, 3, value);
    CU_ASSERT_DOUBLE_EQUAL(value[VERIFY_LINEAR_MOMENTUM], 0, 1e-15);
    totals[1].wall[0] = 0;
    totals[1].external = totals[2].external = 8; /* what was put in is no gain */
    verify_indicators_history(&history, 2, 3, value);
    CU_ASSERT(value[VERIFY_ENERGY_GAIN] == 0);
    totals[2].strain = 26;
    verify_indicators_history(&history, 2, 3, value);
    CU_ASSERT_DOUBLE_EQUAL(value[VERIFY_ENERGY_GAIN], 4.0 / 32, 1e-15);
    totals[1].external = totals[2].external = -8; /* nor is it a loss that loads took some */
    totals[2].strain = 8;
    verify_indicators_history(&history, 2, 3, value);
    CU_ASSERT_DOUBLE_EQUAL(value[VERIFY_ENERGY_GAIN], 10.0 / 32, 1e-15);
}

/* What is no number at any time keeps no momentum and no energy. */
static void drifts_that_are_none(void)
{
    struct solver_totals totals[3] = {{.time = 0, .kinetic = 1}, {.time = 1, .kinetic = 1}, {.time = 2, .kinetic = 1}};
    const struct solver_history history = {.count = 3, .totals = totals};
    unit_untrapped();
    totals[1].linear[1] = totals[1].angular[2] = totals[1].strain = NAN;
    verify_indicators_history(&history, 2, 3, value);
    CU_ASSERT(isnan(value[VERIFY_LINEAR_MOMENTUM]));
    CU_ASSERT(isnan(value[VERIFY_ANGULAR_MOMENTUM]));
    CU_ASSERT(isnan(value[VERIFY_ENERGY_GAIN]));
}

static void at_rest(void)
{
    struct solver_totals totals[2] = {{.time = 0}, {.time = 1}};
    const struct solver_history history = {.count = 2, .totals = totals};
    verify_indicators_history(&history, 2, 3, value);
    CU_ASSERT(isnan(value[VERIFY_LINEAR_MOMENTUM]) && isnan(value[VERIFY_ANGULAR_MOMENTUM]));
    CU_ASSERT(isnan(value[VERIFY_ENERGY_GAIN]));
}

/* The drift of the angular momentum is over sqrt(2 m E) and half the diagonal: of a plate of 1 m, sqrt(1/2) m. */
static void half_the_diagonal(void)
{
    static const char *const overrides[] = {"n=8", "t_end=2e-3", "evolved=pF"};
    struct solver_scene *scene = NULL;
    struct solver_run *run = NULL;
    struct solver_output output;
    CU_ASSERT_FATAL(
        solver_scene_load(TEST_SOURCE_DIR "/verify/scenes/rotating-plate.lua", overrides, 3, &scene, &error));
    CU_ASSERT_FATAL(solver_run_create(scene, &run, &error));
    CU_ASSERT_FATAL(solver_run_to(run, scene->t_end, NULL, NULL, &error) && solver_run_output(run, &output, &error));
    const struct solver_facts facts = solver_run_facts(run);
    const struct solver_history *history = solver_run_history(run);
    double drift = 0, kinetic = 0;
    for (size_t i = 0; i < history->count; i++) {
        drift = fmax(drift, fabs(history->totals[i].angular[2] - history->totals[0].angular[2]));
        kinetic = fmax(kinetic, history->totals[i].kinetic);
    }
    CU_ASSERT_FATAL(verify_indicators_measure(scene, &output, history, &facts, value, &error));
    CU_ASSERT(drift > 0);
    CU_ASSERT_DOUBLE_EQUAL(value[VERIFY_ANGULAR_MOMENTUM] / (drift / sqrt(2 * 1100 * kinetic * 0.5)), 1, 1e-9);
    solver_run_free(run);
    solver_scene_free(scene);
}

/* What the scene does to the body decides what is conserved. */
static void faces(void)
{
    static const struct {
        const char *more;
        bool momentum, energy;
    } cases[] = {
        {"faces={}", true, true},
        {"faces.X0=clamped", false, true},
        {"faces.X0=symmetric", false, true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *overrides[] = {"n=8", cases[i].more};
        struct solver_scene *scene = NULL;
        struct solver_run *run = NULL;
        struct solver_output output;
        CU_ASSERT_FATAL(
            solver_scene_load(TEST_SOURCE_DIR "/verify/scenes/elastic-cable.lua", overrides, 2, &scene, &error));
        CU_ASSERT_FATAL(solver_run_create(scene, &run, &error));
        CU_ASSERT_FATAL(solver_run_to(run, scene->t_end, NULL, NULL, &error) &&
                        solver_run_output(run, &output, &error));
        struct solver_facts facts = solver_run_facts(run);
        CU_ASSERT_DOUBLE_EQUAL(facts.mass, 80000, 1e-8); /* 10 m of 8000 kg/m^3 and 1 m^2 */
        CU_ASSERT_FATAL(verify_indicators_measure(scene, &output, solver_run_history(run), &facts, value, &error));
        CU_ASSERT_EQUAL(!isnan(value[VERIFY_LINEAR_MOMENTUM]), cases[i].momentum);
        CU_ASSERT_EQUAL(!isnan(value[VERIFY_ENERGY_GAIN]), cases[i].energy);
        CU_ASSERT(!cases[i].momentum || value[VERIFY_LINEAR_MOMENTUM] < 1e-12);
        solver_run_free(run);
        solver_scene_free(scene);
    }
}

static void names(void)
{
    for (size_t i = 0; i < VERIFY_INDICATORS; i++) {
        CU_ASSERT_EQUAL(verify_indicator_find(verify_indicator_name(i)), i);
        CU_ASSERT(strlen(verify_indicator_meaning(i)) > 0);
    }
    CU_ASSERT_EQUAL(verify_indicator_find("clump"), VERIFY_INDICATORS);
    CU_ASSERT_STRING_EQUAL(verify_indicator_op(VERIFY_CLUMPING), ">=");
    CU_ASSERT_STRING_EQUAL(verify_indicator_op(VERIFY_ENERGY_GAIN), "<=");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"smooth fields are quiet", smooth_fields_are_quiet},
        {"linear fields are silent", linear_fields_are_silent},
        {"checkerboards fire", checkerboards_fire},
        {"no pressure", no_pressure},
        {"pairs pulled together", pairs_pulled_together},
        {"graded lattices", graded_lattices},
        {"bodies apart", bodies_apart},
        {"positions that are none", positions_that_are_none},
        {"drifts", drifts},
        {"drifts that are none", drifts_that_are_none},
        {"half the diagonal", half_the_diagonal},
        {"at rest", at_rest},
        {"faces", faces},
        {"names", names},
    };
    return unit_main("indicators", tests, sizeof tests / sizeof *tests);
}
