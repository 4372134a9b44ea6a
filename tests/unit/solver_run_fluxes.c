/* Runs: the upwind fluxes. Exact reconstruction of linear states, no J made or lost, and the same motion for an
 * observer who has turned. */
#include "tests/unit/runs.h"

#include <stdbool.h>

/* F_xX = 1 + 0.1 X at rest: the stress is linear in X for Hooke's law, U'(J) for both models. */
static const char linear_stress[] =
    "initial = { F = function(X) if d == 1 then return 1 + 0.1 * X end\n"
    "    if d == 2 then return 1 + 0.1 * X, 0, 0, 1 end return 1 + 0.1 * X, 0, 0, 0, 1, 0, 0, 0, 1 end }\n";

/* What one small step does to J, largest over particles, per unit time. */
static double rate_of_J(const char *settings, const char *reconstruction)
{
    struct sample sample = start(linear_stress, "cfl=1e-7 reconstruction=%s %s", reconstruction, settings);
    struct solver_output output = output_of(&sample);
    size_t count = output.cloud->count;
    double *before = malloc(count * sizeof *before);
    CU_ASSERT_PTR_NOT_NULL_FATAL(before);
    memcpy(before, output.J, count * sizeof *before);
    advance(&sample, 1);
    output = output_of(&sample);
    double worst = 0.0;
    for (size_t a = 0; a < count; a++) {
        worst = fmax(worst, fabs(output.J[a] - before[a]) / output.time);
    }
    free(before);
    finish(&sample);
    return worst;
}

/* The jump of a linear state vanishes: what the dissipation of J then does is round-off. */
static void test_linear_jumps_of_stress(void)
{
    static const char *const settings[] = {
        "dim=1 evolved=pFJ material.model=linear-elastic",
        "dim=2 evolved=pFHJ material.model=linear-elastic volume_flux=stress",
        "dim=3 evolved=pFHJ material.model=linear-elastic volume_flux=stress",
        "dim=3 evolved=pFJ material.model=linear-elastic volume_flux=stress stencil=closed perturb=0.15",
        "dim=2 evolved=pFJ stencil=closed perturb=0.15",
        "dim=3 evolved=pFHJ",
    };
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        double none = rate_of_J(settings[i], "none");
        CU_ASSERT(none > 1e-3);
        expect_below(settings[i], rate_of_J(settings[i], "stencil") / none, 1e-5);
        expect_below(settings[i], rate_of_J(settings[i], "least-squares") / none, 1e-5);
    }
}

/* Largest change of momentum by one small step per unit time, away from the faces; a linear velocity, no stress. */
static double rate_of_p(const char *settings, const char *reconstruction)
{
    struct sample sample = start("initial = { velocity = function(X, Y, Z)\n"
                                 "    return first(0.3 * X - 0.2 * Y, 0.1 * X + 0.2 * Z, 0.3 * Y - 0.1 * Z) end }\n",
                                 "n=6 cfl=1e-7 reconstruction=%s %s", reconstruction, settings);
    struct solver_output output = output_of(&sample);
    size_t width = (size_t)output.cloud->dim, count = output.cloud->count;
    double *before = malloc(width * count * sizeof *before);
    CU_ASSERT_PTR_NOT_NULL_FATAL(before);
    memcpy(before, output.p, width * count * sizeof *before);
    advance(&sample, 1);
    output = output_of(&sample);
    double worst = 0.0;
    for (size_t a = 0; a < count; a++) {
        for (size_t i = 0; i < width; i++) {
            worst = fmax(worst, fabs(output.p[a * width + i] - before[a * width + i]) / output.time);
        }
    }
    free(before);
    finish(&sample);
    return worst;
}

static void test_linear_jumps_of_momentum(void)
{
    static const char *const settings[] = {"dim=1 evolved=pF", "dim=2 evolved=pFJ stencil=closed perturb=0.15",
                                           "dim=3 evolved=pFHJ", "dim=3 evolved=pF stencil=closed perturb=0.15"};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        double none = rate_of_p(settings[i], "none");
        CU_ASSERT(none > 1e-2);
        expect_below(settings[i], rate_of_p(settings[i], "stencil") / none, 1e-5);
        expect_below(settings[i], rate_of_p(settings[i], "least-squares") / none, 1e-5);
    }
}

/* The reconstruction that is asked for is the one that runs: three of them, three results. */
static void test_reconstructions_differ(void)
{
    static const char *const names[] = {"stencil", "least-squares", "none"};
    double v[3][50];
    for (size_t i = 0; i < 3; i++) {
        struct sample sample = start(smooth_motion, "dim=2 n=4 evolved=pFJ stencil=closed reconstruction=%s", names[i]);
        advance(&sample, 5);
        struct solver_output output = output_of(&sample);
        CU_ASSERT_EQUAL_FATAL(output.cloud->count, 25);
        memcpy(v[i], output.v, 50 * sizeof(double));
        finish(&sample);
    }
    for (size_t i = 0; i < 3; i++) {
        double most = 0.0;
        for (size_t k = 0; k < 50; k++) {
            most = fmax(most, fabs(v[i][k] - v[(i + 1) % 3][k]));
        }
        CU_ASSERT(most > 1e-6);
    }
}

/* A bar or block of 8 cells at rest whose stretch f(X) goes through U'' = 0 of Hencky's model, at J = e; across X it is
 * wider by t. Bodies of one material have loops along axes of their own; those said to be composite have not. */
#define STRETCHED                                                                                                      \
    "local f, t = function(X) return 0.6 + 2.5 * X end, d == 3 and 1.2 or 1\n"                                         \
    "initial = { F = function(X) if d == 1 then return f(X) end\n"                                                     \
    "    return f(X), 0, 0, 0, t, 0, 0, 0, 1 end }\n"
enum { CELLS = 8 };
static const char stretched[] = STRETCHED;
static const char said_to_be_composite[] =
    STRETCHED "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2, at = function() return 3, 0.3, 2 end }\n";

struct stretched {
    double t, slope[CELLS + 1], stiffness[CELLS + 1]; /* U', U'' in each plane of particles across X */
};

/* Of two neighbours along X it is that of U' over 2 rho c, c^2 = (4/3 mu + U'' t^2) / rho with the larger U''
 * (upwind.h, dim_fluxes.h), and none where U' falls with J. Returns the rate of J in plane i. */
static double flux_of_J(const struct stretched *at, long i)
{
    static const double mu = 3.0 / 2.6, rho = 2.0; /* of plain_material */
    double rate = 0.0, per_length = i == 0 || i == CELLS ? 2.0 * CELLS : CELLS;
    for (long j = i - 1; j <= i + 1; j += 2) {
        if (j >= 0 && j <= CELLS && at->stiffness[i] > 0.0 && at->stiffness[j] > 0.0) {
            double modulus = 4.0 / 3.0 * mu + fmax(at->stiffness[i], at->stiffness[j]) * at->t * at->t;
            rate += per_length * at->t * at->t * (at->slope[j] - at->slope[i]) / (2.0 * sqrt(rho * modulus));
        }
    }
    return rate;
}

/* Small strain has the areas and the impedance at rest. */
static void test_flux_of_J_by_formula(void)
{
    static const char *const models[] = {"linear-elastic", "neo-hookean", "hencky"};
    static const double kappa = 3.0 / 1.2; /* of plain_material */
    for (int row = 0; row < 12; row++) {
        int model = row % 3, dim = row % 6 < 3 ? 1 : 3;
        struct stretched at = {.t = dim == 3 && model > 0 ? 1.2 : 1.0};
        double worst = 0.0, most = 0.0;
        struct sample sample =
            start(row < 6 ? stretched : said_to_be_composite,
                  "dim=%d n=%d evolved=pFJ cfl=1e-7 reconstruction=none material.model=%s", dim, CELLS, models[model]);
        struct solver_output output = output_of(&sample);
        size_t count = output.cloud->count;
        double *before = malloc(count * sizeof *before);
        CU_ASSERT_PTR_NOT_NULL_FATAL(before);
        memcpy(before, output.J, count * sizeof *before);
        for (size_t a = 0; a < count; a++) {
            long i = lround(output.cloud->X[a * (size_t)dim] * CELLS);
            double J = before[a], l = log(J);
            at.slope[i] = kappa * (model == 2 ? l / J : J - 1.0);
            at.stiffness[i] = kappa * (model == 2 ? fmax(0.0, (1.0 - l) / (J * J)) : 1.0);
        }
        advance(&sample, 1);
        output = output_of(&sample);
        for (size_t a = 0; a < count; a++) {
            double rate = flux_of_J(&at, lround(output.cloud->X[a * (size_t)dim] * CELLS));
            worst = fmax(worst, fabs((output.J[a] - before[a]) / output.time - rate));
            most = fmax(most, fabs(rate));
        }
        free(before);
        CU_ASSERT(most > 1.0);
        expect_below(models[model], worst / most, 1e-5);
        finish(&sample);
    }
}

/* Another density, so that impedances differ where bulk moduli do not. */
static const char composite[] = "material.nu=0.3";
static const char two_densities[] = "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2, at = function(X) "
                                    "return 3, 0.3, X < 0.5 and 2 or 50 end }\n";

/* What one particle of a pair gains in V J, the other loses. */
static void test_flux_of_J_is_antisymmetric(void)
{
    static const char *const settings[] = {"volume_flux=pressure",
                                           "volume_flux=stress",
                                           "volume_flux=pressure material.model=linear-elastic",
                                           "volume_flux=pressure material.model=hencky",
                                           "volume_flux=stress stencil=closed perturb=0.15",
                                           composite};
    static const char strained[] =
        "initial = { F = function(X, Y, Z) return 1 + 0.2 * sin(3 * X + Y), 0.1 * X, 0, 0.1 * cos(4 * Z), 1, 0.2 * Y,\n"
        "    0, 0.1 * sin(2 * Y), 1 + 0.2 * cos(5 * Z) end }\n";
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        char text[2048];
        (void)snprintf(text, sizeof text, "%s%s", settings[i] == composite ? two_densities : "", strained);
        struct sample sample = start(text, "evolved=pFJ cfl=1e-7 reconstruction=none %s", settings[i]);
        struct solver_output output = output_of(&sample);
        size_t count = output.cloud->count;
        double sum = 0.0, scale = 0.0;
        double *before = malloc(count * sizeof *before);
        CU_ASSERT_PTR_NOT_NULL_FATAL(before);
        memcpy(before, output.J, count * sizeof *before);
        advance(&sample, 1);
        output = output_of(&sample);
        for (size_t a = 0; a < count; a++) {
            sum += output.V[a] * (output.J[a] - before[a]);
            scale += output.V[a] * fabs(output.J[a] - before[a]);
        }
        free(before);
        CU_ASSERT(scale > 0.0);
        expect_below(settings[i], fabs(sum) / scale, 1e-5);
        finish(&sample);
    }
}

/* A motion at large strain, by an observer who is turned by 0.7 about (1, 2, 3) or not. */
static struct sample observed(bool turned, const char *settings)
{
    static const char motion[] =
        "local l = math.sqrt(14)\n"
        "local x, y, z, s, c = 1 / l, 2 / l, 3 / l, sin(%s), cos(%s)\n"
        "local R = { {c + x * x * (1 - c), x * y * (1 - c) - z * s, x * z * (1 - c) + y * s},\n"
        "            {y * x * (1 - c) + z * s, c + y * y * (1 - c), y * z * (1 - c) - x * s},\n"
        "            {z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c)} }\n"
        "local function turn(a, b, c)\n"
        "    return R[1][1] * a + R[1][2] * b + R[1][3] * c, R[2][1] * a + R[2][2] * b + R[2][3] * c,\n"
        "           R[3][1] * a + R[3][2] * b + R[3][3] * c end\n"
        "initial = { displacement = function(X, Y, Z) local a, b, c = turn(X, Y, Z) return a - X, b - Y, c - Z end,\n"
        "    velocity = function(X, Y, Z)\n"
        "        return turn(0.4 * sin(2 * X + Y), 0.3 * cos(3 * Y - Z), 0.4 * sin(X - 2 * Z)) end }\n";
    char text[2048];
    (void)snprintf(text, sizeof text, motion, turned ? "0.7" : "0", turned ? "0.7" : "0");
    struct sample sample = start(text, "%s", settings);
    advance(&sample, 12);
    return sample;
}

static void test_objectivity(void)
{
    static const char *const settings[] = {"evolved=pF", "evolved=pFJ", "evolved=pFHJ volume_flux=stress",
                                           "evolved=pFHJ stencil=closed perturb=0.15",
                                           "evolved=pFHJ stencil=sph support=2 material.model=neo-hookean-polyconvex"};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        struct sample one = observed(false, settings[i]), other = observed(true, settings[i]);
        struct solver_output a = output_of(&one), b = output_of(&other);
        double worst = 0.0, strain = 0.0;
        for (size_t k = 0; k < a.cloud->count; k++) {
            const double *v = a.v + 3 * k, *w = b.v + 3 * k;
            worst = fmax(worst, fabs(a.J[k] - b.J[k]));
            worst = fmax(worst, fabs(a.von_mises[k] - b.von_mises[k]));
            worst = fmax(worst, fabs(a.pressure[k] - b.pressure[k]));
            worst =
                fmax(worst, fabs(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - w[0] * w[0] - w[1] * w[1] - w[2] * w[2]));
            strain = fmax(strain, a.von_mises[k]);
        }
        printf("\n    %.1e of %.1e  %s", worst, strain, settings[i]);
        CU_ASSERT(strain > 0.1);
        expect_below(settings[i], worst, 1e-12);
        finish(&one);
        finish(&other);
    }
}

/* A free body at large strain: what it loses is dissipation, and it never gains. */
static void test_free_body_loses_energy(void)
{
    static const char *const settings[] = {"evolved=pF",
                                           "evolved=pFJ",
                                           "evolved=pFHJ",
                                           "evolved=pFHJ material.nu=0.45",
                                           "evolved=pFHJ material.nu=0.45 stencil=closed perturb=0.15",
                                           "evolved=pFHJ stencil=sbp4 n=8 integrator=rk4"};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        struct sample sample = observed(false, settings[i]);
        advance_to(&sample, 1.2);
        const struct solver_history *history = solver_run_history(sample.run);
        double before = INFINITY, rise = 0.0, most = 0.0;
        for (size_t row = 0; row < history->count; row++) {
            double energy = history->totals[row].kinetic + history->totals[row].strain;
            rise = fmax(rise, energy - before);
            most = fmax(most, energy);
            before = energy;
        }
        printf("\n    %.1e of %.1e, %.3f left  %s", rise, most, before / most, settings[i]);
        expect_below(settings[i], rise / most, 1e-12);
        finish(&sample);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"linear states of stress do not jump", test_linear_jumps_of_stress},
        {"linear states of momentum do not jump", test_linear_jumps_of_momentum},
        {"the reconstruction asked for is the one that runs", test_reconstructions_differ},
        {"the flux of J by its formula", test_flux_of_J_by_formula},
        {"the flux of J is antisymmetric", test_flux_of_J_is_antisymmetric},
        {"the same motion for an observer who has turned", test_objectivity},
        {"a free body never gains energy", test_free_body_loses_energy},
    };
    return unit_main("fluxes", tests, sizeof tests / sizeof *tests);
}
