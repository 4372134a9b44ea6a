/* Runs: boundary conditions, and the balance of energy. */
#include "tests/unit/runs.h"

/* Which components faces hold, by kind; the union on edges and in corners. */
static unsigned held_axes(const struct solver_scene *scene, uint32_t tags)
{
    unsigned held = 0;
    unsigned all = (1U << scene->dim) - 1U;
    for (unsigned face = 0; face < 2U * (unsigned)scene->dim; face++) {
        if ((tags >> face & 1U) != 0) {
            unsigned normal = 1U << face / 2;
            held |= scene->face[face] == SOLVER_CLAMPED     ? all
                    : scene->face[face] == SOLVER_SYMMETRIC ? normal
                    : scene->face[face] == SOLVER_SKEW      ? all & ~normal
                                                            : 0U;
        }
    }
    return held;
}

/* Momentum is held exactly. `of_position`: how far round-off may take the position; nowhere, but for ssp-rk3, whose
 * thirds are no binary fractions. */
static void check_held(const char *faces, const char *settings, double of_position)
{
    char text[1024];
    (void)snprintf(text, sizeof text, "%s%s", faces, smooth_motion);
    struct sample sample = start(text, "%s", settings);
    for (size_t leg = 0; leg < 2; leg++) {
        struct solver_output output = output_of(&sample);
        size_t dim = (size_t)output.cloud->dim;
        size_t held = 0;
        size_t loose = 0;
        for (size_t a = 0; a < output.cloud->count; a++) {
            unsigned axes = held_axes(sample.scene, output.cloud->tags[a]);
            for (size_t i = 0; i < dim; i++) {
                if ((axes >> i & 1U) != 0) {
                    CU_ASSERT(output.v[a * dim + i] == 0.0);
                    CU_ASSERT(fabs(output.u[a * dim + i]) <= of_position);
                    held++;
                } else {
                    loose += output.v[a * dim + i] != 0.0 ? 0 : 1;
                }
            }
        }
        CU_ASSERT(held > 0);
        CU_ASSERT_EQUAL(loose, 0); /* nothing else stands still */
        advance(&sample, 30);
    }
    finish(&sample);
}

static void test_faces_hold(void)
{
    static const char *const faces[] = {
        "faces = { X0 = 'symmetric', X1 = 'skew-symmetric', Y0 = 'clamped', Z1 = 'symmetric' }\n",
        "faces = { X0 = 'symmetric', Y0 = 'symmetric', Z0 = 'symmetric', X1 = 'skew-symmetric' }\n",
        "faces = { X0 = 'clamped', X1 = 'clamped', Y1 = 'skew-symmetric' }\n",
        "faces = { Z0 = 'skew-symmetric', Z1 = 'skew-symmetric', X1 = 'symmetric', Y1 = 'free' }\n",
    };
    for (size_t i = 0; i < sizeof faces / sizeof *faces; i++) {
        check_held(faces[i], "dim=3 n=4 stencil=sbp2 evolved=pFHJ integrator=tvd-rk2", 0.0);
        check_held(faces[i], "dim=3 n=4 stencil=closed evolved=pF integrator=rk4 material.model=linear-elastic", 0.0);
        check_held(faces[i], "dim=3 n=5 stencil=sph evolved=pFJ integrator=ssp-rk3", 0.0);
    }
    check_held("faces = { X0 = 'symmetric', Y1 = 'skew-symmetric', X1 = 'clamped' }\n", "dim=2 n=7", 0.0);
    check_held("faces = { X0 = 'symmetric' }\n", "dim=1 n=7 integrator=rk4", 0.0);
}

/* Prescribed motion: the momentum is the formula's, the position its integral as far as the integrator goes. */
static void test_motion(void)
{
    static const struct {
        const char *integrator, *rate;
        double power;
    } rows[] = {{"euler", "t^0", 1.0}, {"tvd-rk2", "t", 2.0}, {"ssp-rk3", "t^2", 3.0}, {"rk4", "t^3", 4.0}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[512];
        (void)snprintf(text, sizeof text,
                       "faces = { X0 = { kind = 'motion', value = function(X, Y, Z, t)\n"
                       "    return 0.1 * %s, 0.05 * Y * %s, -0.02 end }, Y0 = 'symmetric', Y1 = 'clamped' }\n",
                       rows[i].rate, rows[i].rate);
        struct sample sample = start(text, "dim=3 n=4 integrator=%s", rows[i].integrator);
        advance_to(&sample, 0.8);
        struct solver_output output = output_of(&sample);
        double rate = pow(0.8, rows[i].power - 1.0);
        double path = pow(0.8, rows[i].power) / rows[i].power;
        size_t moving = 0;
        for (size_t a = 0; a < output.cloud->count; a++) {
            const double *X = output.cloud->X + 3 * a;
            const double v[] = {0.1 * rate, 0.05 * X[1] * rate, -0.02};
            const double u[] = {0.1 * path, 0.05 * X[1] * path, -0.02 * 0.8};
            bool clamped = (output.cloud->tags[a] & 1U << 3) != 0; /* where both meet, the clamp holds */
            for (size_t k = 0; (output.cloud->tags[a] & 1U) != 0 && k < 3; k++) {
                CU_ASSERT_DOUBLE_EQUAL(output.v[3 * a + k], clamped ? 0.0 : v[k], 1e-16);
                CU_ASSERT_DOUBLE_EQUAL(output.u[3 * a + k], clamped ? 0.0 : u[k], 1e-14);
                moving++;
            }
        }
        CU_ASSERT_EQUAL(moving, 3 * 25);
        finish(&sample);
    }
}

/* A bar pulled at one end and clamped at the other. Kinetic and strain energy less the work done: never more than at
 * the start, and less only by what the upwind flux takes. Returns what it took, relative to the work. */
static double energy_taken(const char *settings, int n)
{
    static const char pulled[] =
        "faces = { X0 = 'clamped', X1 = { kind = 'traction', value = function(X, Y, Z, t)\n"
        "    return first(0.2 * sin(math.pi * t / 2)^4, 0.1 * sin(math.pi * t / 2)^4, 0) end } }\n";
    struct sample sample = start(pulled, "n=%d integrator=rk4 cfl=0.4 %s", n, settings);
    advance_to(&sample, 2.0);
    const struct solver_history *history = solver_run_history(sample.run);
    double before = 0.0;
    double work = 0.0;
    double rise = 0.0;
    for (size_t row = 0; row < history->count; row++) {
        const struct solver_totals *totals = &history->totals[row];
        double balance = totals->kinetic + totals->strain - totals->external;
        CU_ASSERT(totals->kinetic >= 0.0 && totals->strain >= -1e-15);
        rise = fmax(rise, balance - before);
        before = balance;
        work = fmax(work, fabs(totals->external));
    }
    CU_ASSERT(work > 1e-4);
    expect_below(settings, rise / work, 1e-5);
    finish(&sample);
    return -before / work;
}

static void test_energy(void)
{
    static const char *const settings[] = {"dim=1 stencil=sbp2 evolved=pF material.model=linear-elastic",
                                           "dim=1 stencil=sbp4 evolved=pFHJ", "dim=2 stencil=sbp2 evolved=pFJ",
                                           "dim=2 stencil=closed evolved=pFHJ material.model=linear-elastic",
                                           "dim=2 stencil=closed evolved=pF"};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        double coarse = energy_taken(settings[i], 8);
        double fine = energy_taken(settings[i], 16);
        printf("\n    energy taken: %.1e at n = 8, %.1e at n = 16  %s", coarse, fine, settings[i]);
        expect_below("energy taken", fine, 0.05);
        expect_below("energy taken at half the spacing, against the whole", fine / coarse, 0.36); /* order 1.5 */
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"faces hold their components, also on edges and in corners", test_faces_hold},
        {"prescribed motion follows its formula", test_motion},
        {"energy: what is not work is dissipation", test_energy},
    };
    return unit_main("faces", tests, sizeof tests / sizeof *tests);
}
