/* Runs: boundary conditions, and the balance of energy. */
#include "tests/unit/runs.h"

/* Largest speed relative to the p-wave's, and largest departure from the displacement u = (F - 1) X. */
static double departure(struct sample *sample, const double *F)
{
    struct solver_output output = output_of(sample);
    size_t dim = (size_t)output.cloud->dim;
    double cp = wave_speed(sample);
    double worst = 0.0;
    for (size_t a = 0; a < output.cloud->count; a++) {
        for (size_t i = 0; i < dim; i++) {
            double u = -output.cloud->X[a * dim + i];
            for (size_t I = 0; I < dim; I++) {
                u += F[i * dim + I] * output.cloud->X[a * dim + I];
            }
            worst = fmax(worst, fabs(output.u[a * dim + i] - u));
            worst = fmax(worst, fabs(output.v[a * dim + i]) / cp);
        }
    }
    return worst;
}

/* Writes `values` as a Lua list without braces. */
static size_t list(char *out, size_t room, size_t count, size_t stride, const double *values)
{
    size_t used = 0;
    for (size_t i = 0; i < count; i++) {
        used += (size_t)snprintf(out + used, room - used, "%s%.17g", i == 0 ? "" : ", ", values[i * stride]);
    }
    CU_ASSERT_FATAL(used < room);
    return used;
}

/* A homogeneous deformation held by the tractions P N that belong to it. */
static void homogeneous(const char *model, size_t dim, const double *F, char *out, size_t room)
{
    const struct solver_material *material = solver_material_find(model)->in[dim - 1];
    struct solver_material_constants constants = solver_material_constants(3.0, 0.3, 2.0);
    double H[9] = {0};
    double P[9];
    double J = dim == 1 ? F[0] : dim == 2 ? F[0] * F[3] - F[1] * F[2] : 0.0;
    H[0] = 1.0;
    if (dim == 2) {
        memcpy(H, (double[4]){F[3], -F[2], -F[1], F[0]}, 4 * sizeof *H);
    } else if (dim == 3) {
        for (size_t k = 0; k < 9; k++) {
            size_t i = (k / 3 + 1) % 3;
            size_t j = (k % 3 + 1) % 3;
            size_t i2 = (k / 3 + 2) % 3;
            size_t j2 = (k % 3 + 2) % 3;
            H[k] = F[i * 3 + j] * F[i2 * 3 + j2] - F[i * 3 + j2] * F[i2 * 3 + j];
        }
        J = F[0] * H[0] + F[1] * H[1] + F[2] * H[2];
    }
    if (material->linear) {
        J = 1.0;
        for (size_t i = 0; i < dim; i++) {
            J += F[i * dim + i] - 1.0;
        }
    }
    material->stress(&constants, F, H, J, P);
    char F_text[256];
    (void)list(F_text, sizeof F_text, dim * dim, 1, F);
    size_t used =
        (size_t)snprintf(out, room,
                         "local F = { %s }\n"
                         "local function u(X, i) local s = -X[i]\n"
                         "    for I = 1, d do s = s + F[(i - 1) * d + I] * X[I] end return s end\n"
                         "initial = { F = function() return %s end, displacement = function(X, Y, Z)\n"
                         "    local x = {X, Y, Z} return first(u(x, 1), d > 1 and u(x, 2), d > 2 and u(x, 3)) "
                         "end }\nfaces = {\n",
                         F_text, F_text);
    for (size_t face = 0; face < 2 * dim; face++) {
        double traction[3];
        for (size_t i = 0; i < dim; i++) {
            traction[i] = (face % 2 == 0 ? -1.0 : 1.0) * P[i * dim + face / 2];
        }
        used += (size_t)snprintf(out + used, room - used, "    %c%zu = { kind = 'traction', value = function() return ",
                                 "XYZ"[face / 2], face % 2);
        used += list(out + used, room - used, dim, 1, traction);
        used += (size_t)snprintf(out + used, room - used, " end },\n");
    }
    used += (size_t)snprintf(out + used, room - used, "}\n");
    CU_ASSERT_FATAL(used < room);
}

static double patch(const char *model, size_t dim, const char *settings)
{
    static const double deformation[][9] = {
        {1.15}, {1.1, 0.2, -0.05, 0.95}, {1.1, 0.2, 0.05, -0.1, 0.9, 0.1, 0.0, 0.15, 1.05}};
    const double *F = deformation[dim - 1];
    char text[4096];
    homogeneous(model, dim, F, text, sizeof text);
    struct sample sample = start(text, "dim=%zu material.model=%s %s", dim, model, settings);
    advance(&sample, 5);
    double worst = departure(&sample, F);
    finish(&sample);
    return worst;
}

/* The patch test: a constant stress with matching tractions is equilibrium, for a stencil that is closed. */
static void test_patch(void)
{
    static const char *const closed[] = {"stencil=sbp2 n=4", "stencil=closed support=2.1 n=5", "stencil=sbp4 n=11",
                                         "stencil=closed support=3 perturb=0.15 n=5"};
    static const char *const evolved[] = {"pF", "pFJ", "pFHJ"};
    static const char *const models[] = {"neo-hookean", "linear-elastic"};
    double worst = 0.0;
    for (size_t i = 0; i < 4; i++) {
        for (size_t m = 0; m < 6; m++) {
            for (size_t dim = 1; dim <= 3; dim++) {
                char settings[128];
                (void)snprintf(settings, sizeof settings, "%s evolved=%s", closed[i], evolved[m % 3]);
                double found = patch(models[m / 3], dim, settings);
                expect_below(settings, found, 1e-12);
                worst = fmax(worst, found);
            }
        }
    }
    double sph = patch("neo-hookean", 3, "stencil=sph support=2.0 n=5 evolved=pF");
    printf("\n    departure from equilibrium: %.1e closed, %.1e sph", worst, sph);
    CU_ASSERT(sph > 1e-3); /* the same test sees a stencil that is not closed */
}

/* Tractions that do not match must be seen: 1 % too much. */
static void test_patch_sees(void)
{
    static const double F[] = {1.15};
    char text[4096];
    homogeneous("neo-hookean", 1, F, text, sizeof text);
    struct sample sample = start(text, "dim=1 stencil=sbp2 n=8 material.E=3.03");
    advance(&sample, 50);
    CU_ASSERT(departure(&sample, F) > 1e-4);
    finish(&sample);
}

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
        {"constant stress with matching tractions is equilibrium", test_patch},
        {"the patch test sees tractions that do not match", test_patch_sees},
        {"faces hold their components, also on edges and in corners", test_faces_hold},
        {"prescribed motion follows its formula", test_motion},
        {"energy: what is not work is dissipation", test_energy},
    };
    return unit_main("faces", tests, sizeof tests / sizeof *tests);
}
