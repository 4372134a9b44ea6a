/* The pressure of incompressible bodies (solver/pressure.h): the operator of its equation, its two solvers, what they
 * keep, and what is refused. */
#include "tests/unit/momenta.h"
#include "tests/unit/runs.h"

#include "solver/pressure_solvers.h"
#include "solver/run_internal.h"
#include "solver/scheme_upwind.h"

static const char incompressible[] = "material.nu=0.5 incompressible.solver=poisson";

/* A free body, one held on a face, and one whose surface is led all over. */
static const char clamped[] = "faces = { X0 = 'clamped' }\n"
                              "initial = { velocity = function(X, Y, Z) return first(0, 0.1 * X, 0.05 * X) end }\n";
static const char led[] =
    "local m = { kind = 'motion', value = function(X, Y, Z, t) return first(0.1 * X, -0.1 * Y, 0) end }\n"
    "faces = { X0 = m, X1 = m, Y0 = m, Y1 = m, Z0 = d > 2 and m or nil, Z1 = d > 2 and m or nil }\n"
    "initial = { velocity = function(X, Y, Z) return first(0.1 * X, -0.1 * Y, 0) end }\n";

static struct solver_pressure *pressure_of(const struct sample *sample)
{
    struct solver_upwind_system *system = sample->run->system;
    return system->pressure;
}

/* Numbers in (-1, 1), the same each time. */
static void fill(double *x, size_t count, unsigned seed)
{
    for (size_t i = 0; i < count; i++) {
        seed = seed * 1664525U + 1013904223U;
        x[i] = (double)(seed >> 8) / 8388608.0 - 1.0;
    }
}

static double scalar(const double *x, const double *y, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        sum += x[i] * y[i];
    }
    return sum;
}

static void check_operator(const char *body, const char *settings)
{
    struct sample sample = start(body, "%s %s", incompressible, settings);
    advance(&sample, 2);
    const struct solver_pressure *of = pressure_of(&sample);
    CU_ASSERT_PTR_NOT_NULL_FATAL(of);
    size_t count = of->stencil->count;
    double *x = malloc(4 * count * sizeof *x);
    CU_ASSERT_PTR_NOT_NULL_FATAL(x);
    double *y = x + count, *Ax = y + count, *Ay = Ax + count;
    fill(x, 2 * count, 7);
    if (of->sealed) { /* there it acts on pressures without a mean */
        for (int k = 0; k < 2; k++) {
            double mean = scalar(k == 0 ? x : y, of->stencil->V, count) / of->volume;
            for (size_t a = 0; a < count; a++) {
                (k == 0 ? x : y)[a] -= mean;
            }
        }
    }
    solver_pressure_apply(of, x, Ax);
    solver_pressure_apply(of, y, Ay);
    double size = sqrt(scalar(Ax, Ax, count) * scalar(y, y, count));
    expect_below(settings, fabs(scalar(y, Ax, count) - scalar(x, Ay, count)) / size, 1e-14);
    CU_ASSERT(scalar(x, Ax, count) > 0 && scalar(y, Ay, count) > 0);
    CU_ASSERT_EQUAL(of->sealed, body == led && strstr(settings, "nu=0.49") == NULL);
    free(x);
    finish(&sample);
}

static void the_operator_is_symmetric_and_positive(void)
{
    static const char *const settings[] = {
        "dim=2 stencil=sbp2",
        "dim=3 stencil=sbp2 evolved=pFJ",
        "dim=2 n=8 stencil=sbp4 integrator=rk4",
        "dim=2 stencil=sph",
        "dim=2 n=8 stencil=closed perturb=0.15",
        "dim=2 stencil=sbp2 reconstruction=none",
        "dim=3 stencil=sbp2 material.nu=0.499",
        "dim=2 stencil=sbp2 material.model=linear-elastic",
        "dim=2 stencil=sbp2 incompressible.dissipation=1",
    };
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        check_operator(smooth_motion, settings[i]);
        check_operator(clamped, settings[i]);
        if (strstr(settings[i], "sph") == NULL && strstr(settings[i], "closed") == NULL) {
            check_operator(led, settings[i]);
        }
    }
}

/* Largest difference of two arrays over the largest entry. */
static double difference(const double *x, const double *y, size_t count)
{
    double most = 0, size = 0;
    for (size_t i = 0; i < count; i++) {
        most = fmax(most, fabs(x[i] - y[i]));
        size = fmax(size, fabs(x[i]));
    }
    return most / size;
}

static void both_solvers_agree(void)
{
    static const char *const settings[] = {"dim=2 n=6 evolved=pFJ", "dim=2 n=6 material.nu=0.4999", "dim=3 n=4"};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        struct sample one = start(clamped, "%s incompressible.tolerance=1e-11 %s", incompressible, settings[i]);
        struct sample other = start(
            clamped,
            "%s incompressible.tolerance=1e-11 %s incompressible.solver=pseudo-time incompressible.iterations=100000",
            incompressible, settings[i]);
        advance(&one, 5);
        advance(&other, 5);
        size_t count = one.run->cloud->count;
        double p = difference(pressure_of(&one)->p, pressure_of(&other)->p, count);
        double v = difference(one.run->state.v, other.run->state.v, count * one.run->state.lanes);
        printf("\n    pressures differ by %.1e, velocities by %.1e, %zu and %zu iterations: %s", p, v,
               pressure_of(&one)->iterations, pressure_of(&other)->iterations, settings[i]);
        expect_below(settings[i], p, 1e-6);
        expect_below(settings[i], v, 1e-8);
        CU_ASSERT(pressure_of(&one)->iterations < pressure_of(&other)->iterations);
        finish(&one);
        finish(&other);
    }
}

/* The Laplacian spares iterations, and changes what they come to. */
static void the_laplacian_spares_iterations(void)
{
    size_t iterations[2];
    for (int i = 0; i < 2; i++) {
        struct sample sample =
            start(clamped, "%s dim=2 n=8 incompressible.solver=pseudo-time incompressible.alpha=%d", incompressible, i);
        advance(&sample, 5);
        iterations[i] = pressure_of(&sample)->iterations;
        finish(&sample);
    }
    CU_ASSERT(2 * iterations[1] < iterations[0]);
}

static void what_it_took_is_reported(void)
{
    struct sample sample = start(clamped, "%s dim=2 n=6", incompressible);
    advance_to(&sample, 0.5);
    const struct solver_history *history = solver_run_history(sample.run);
    const struct solver_totals *last = &history->totals[history->count - 1];
    CU_ASSERT_FATAL(history->incompressible && history->count > 10);
    CU_ASSERT_EQUAL(last->iterations, (double)pressure_of(&sample)->iterations);
    CU_ASSERT(last->iterations > (double)solver_run_facts(sample.run).steps);
    struct solver_output output = output_of(&sample);
    double largest = 0;
    for (size_t a = 0; a < output.cloud->count; a++) {
        const double *F = output.F + 4 * a;
        largest = fmax(largest, fabs(F[0] * F[3] - F[1] * F[2] - 1));
    }
    CU_ASSERT_DOUBLE_EQUAL(last->volume_change, largest, 1e-15);
    CU_ASSERT(largest > 0 && largest < 1e-3);
    finish(&sample);
    struct sample without = start(clamped, "dim=2 n=6");
    advance_to(&without, 0.1);
    CU_ASSERT(!solver_run_history(without.run)->incompressible);
    CU_ASSERT_PTR_NULL(pressure_of(&without));
    finish(&without);
}

/* Without the pressure the body of this modulus changes its volume a hundred times as much. */
static double energy_at_start(const char *words)
{
    static const char strained[] = "initial = { F = function(X, Y)\n"
                                   "    return 1 + 0.002 * sin(3 * X), 0.01 * Y, 0, 1 + 0.003 * cos(2 * Y) end }\n";
    struct sample sample = start(strained, "dim=2 n=6 evolved=pFJ material.nu=0.495 %s", words);
    advance_to(&sample, 1e-4); /* the first row of the history is that of the start */
    double strain = solver_run_history(sample.run)->totals[0].strain;
    finish(&sample);
    return strain;
}

/* A body that yields a little in volume starts with the pressure that its volumes ask for, and stores in it what the
 * same body does whose J is evolved. */
static void the_pressure_stores_energy(void)
{
    double plain = energy_at_start(""), solved = energy_at_start("incompressible.solver=poisson");
    CU_ASSERT(plain > 0.0);
    expect_below("energy of the pressure beside that of J", fabs(solved / plain - 1.0), 1e-12);
}

static void volumes_are_kept(void)
{
    double change[2];
    for (int i = 0; i < 2; i++) {
        struct sample sample = start(smooth_motion, "dim=2 n=8 material.nu=%s incompressible.solver=%s",
                                     i == 0 ? "0.3" : "0.5", i == 0 ? "none" : "poisson");
        advance(&sample, 40);
        struct solver_output output = output_of(&sample);
        change[i] = 0;
        for (size_t a = 0; a < output.cloud->count; a++) {
            change[i] = fmax(change[i], fabs(output.J[a] - 1));
        }
        finish(&sample);
    }
    printf("\n    volumes change by %.1e, and by %.1e where they are kept", change[0], change[1]);
    CU_ASSERT(change[1] < 0.01 * change[0]);
}

static void linear_momentum_is_kept(void)
{
    static const char *const settings[] = {"dim=2 stencil=sph", "dim=2 n=8 stencil=closed perturb=0.15",
                                           "dim=3 stencil=sbp2 integrator=rk4",
                                           "dim=2 stencil=sbp2 incompressible.solver=pseudo-time"};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        struct sample sample = start(smooth_motion, "%s %s", incompressible, settings[i]);
        struct solver_output output = output_of(&sample);
        struct momenta before = momenta_of(&output);
        advance(&sample, 50);
        output = output_of(&sample);
        struct momenta after = momenta_of(&output);
        expect_below(settings[i], drift_between(&before, &after).linear, 1e-13);
        finish(&sample);
    }
}

static void threads_change_no_bit(void)
{
    static const char *const settings[] = {"dim=3 n=8", "dim=2 n=24 incompressible.solver=pseudo-time",
                                           "dim=2 n=24 integrator=rk4"};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        for (int body = 0; body < 2; body++) {
            struct sample run[2];
            for (int k = 0; k < 2; k++) {
                run[k] = start(body == 0 ? clamped : led, "%s %s threads=%d", incompressible, settings[i], k + 1);
                advance(&run[k], 3);
            }
            size_t bytes = run[0].run->state.evolved * sizeof(double);
            CU_ASSERT(run[0].run->cloud->count > 2 * 256);
            CU_ASSERT(memcmp(run[0].run->state.U, run[1].run->state.U, bytes) == 0);
            finish(&run[0]);
            finish(&run[1]);
        }
    }
}

static void no_convergence_is_an_error(void)
{
    static const char *const solvers[] = {"poisson", "pseudo-time"};
    for (int i = 0; i < 2; i++) {
        struct sample sample = start(clamped,
                                     "dim=2 n=8 material.nu=0.5 incompressible.solver=%s "
                                     "incompressible.iterations=2",
                                     solvers[i]);
        double before = sample.run->state.v[5];
        CU_ASSERT_FALSE(solver_run_steps(sample.run, 1, &sample.error));
        CU_ASSERT_EQUAL(sample.error.code, SOLVER_BROKE_DOWN);
        CU_ASSERT_PTR_NOT_NULL(strstr(sample.error.text, "not converged in incompressible.iterations = 2"));
        CU_ASSERT_PTR_NOT_NULL(strstr(sample.error.text, "incompressible.tolerance is 1e-08. More iterations"));
        CU_ASSERT_EQUAL(sample.run->state.v[5], before); /* the state is that of the start */
        finish(&sample);
    }
}

static void what_cannot_be_is_refused(void)
{
    static const struct {
        const char *settings, *why;
    } bad[] = {
        {"evolved=pF", "take evolved = \"pFJ\""},
        {"material.model=hencky", "take material.model = \"neo-hookean\""},
        {"material.model=neo-hookean-polyconvex", "take material.model = \"neo-hookean\""},
        {"volume_flux=stress", "take volume_flux = \"pressure\""},
        {"reconstruction=least-squares", "take reconstruction = \"stencil\""},
        {"stencil=sph lattice=centres", "take lattice = \"nodes\""},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct solver_error error = refusal(clamped, "%s dim=2 n=6 %s", incompressible, bad[i].settings);
        bool told = error.code == SOLVER_BAD_INPUT && strstr(error.text, "incompressible.solver: ") != NULL &&
                    strstr(error.text, bad[i].why) != NULL;
        if (!told) {
            printf("\n    %s: %s", bad[i].settings, error.text);
        }
        CU_ASSERT(told);
    }
    struct solver_error error =
        refusal("rigid_wall = { point = {-1, 0}, normal = {1, 0} }\n", "%s dim=2 n=6", incompressible);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "take no rigid_wall"));
    error = refusal("domain = { shape = 'disc', centre = {0, 0}, radius = 0.5, symmetry = { X = 0 } }\n",
                    "%s dim=2 n=6 stencil=closed", incompressible);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "without domain.symmetry"));
    error = refusal("material = { model = 'neo-hookean', E = 1, nu = 0.5, rho = 1, at = function(X, Y, Z) return 1, "
                    "0.49, 1 end }\n",
                    "dim=2 incompressible.solver=poisson");
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "take no material.at"));
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"the operator is symmetric and positive", the_operator_is_symmetric_and_positive},
        {"both solvers agree", both_solvers_agree},
        {"the Laplacian spares iterations", the_laplacian_spares_iterations},
        {"what it took is reported", what_it_took_is_reported},
        {"the pressure stores energy", the_pressure_stores_energy},
        {"volumes are kept", volumes_are_kept},
        {"linear momentum is kept", linear_momentum_is_kept},
        {"threads change no bit", threads_change_no_bit},
        {"no convergence is an error", no_convergence_is_an_error},
        {"what cannot be is refused", what_cannot_be_is_refused},
    };
    return unit_main("solver pressure", tests, sizeof tests / sizeof *tests);
}
