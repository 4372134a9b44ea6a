/* Runs: time, order in time, motions known in closed form, and what the state holds. */
#include "solver/integrator.h"
#include "solver/scheme.h"
#include "tests/unit/runs.h"

static void test_t_end_is_hit(void)
{
    static const double ends[] = {1e-9, 0.1, 0.37, 1.0};
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
        struct sample sample = start(smooth_motion, "dim=2");
        advance_to(&sample, ends[i]);
        CU_ASSERT_EQUAL(output_of(&sample).time, ends[i]);
        advance_to(&sample, ends[i]); /* is there already */
        CU_ASSERT_EQUAL(output_of(&sample).time, ends[i]);
        size_t steps = output_of(&sample).step;
        advance_to(&sample, 1.5 * ends[i]);
        CU_ASSERT_EQUAL(output_of(&sample).time, 1.5 * ends[i]);
        CU_ASSERT(output_of(&sample).step > steps);
        const struct solver_history *history = solver_run_history(sample.run);
        CU_ASSERT_FATAL(history->count >= 2);
        CU_ASSERT_EQUAL(history->totals[0].time, 0.0);
        CU_ASSERT_EQUAL(history->totals[history->count - 1].time, 1.5 * ends[i]);
        for (size_t row = 1; row < history->count; row++) {
            CU_ASSERT(history->totals[row].time > history->totals[row - 1].time);
        }
        finish(&sample);
    }
}

/* Time does not run backwards, and has an end. */
static void test_no_time_in_the_past(void)
{
    struct sample sample = start(smooth_motion, "dim=1");
    static const double wrong[] = {-1.0, 0.25, (double)NAN};
    advance_to(&sample, 0.5);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct solver_error error = {.text = ""};
        CU_ASSERT_FALSE(solver_run_to(sample.run, wrong[i], NULL, NULL, &error));
        CU_ASSERT(error.code == SOLVER_BAD_INPUT && strstr(error.text, "a time from now on") != NULL);
        CU_ASSERT_EQUAL(output_of(&sample).time, 0.5);
    }
    finish(&sample);
}

/* As many rows over t_end as the scene says, and the same ones where the run is made in parts. */
static void test_history_rows(void)
{
    struct sample whole = start(smooth_motion, "dim=1 n=100 history=50"),
                  parts = start(smooth_motion, "dim=1 n=100 history=50");
    advance_to(&whole, 1.0);
    const struct solver_history *rows = solver_run_history(whole.run);
    CU_ASSERT_EQUAL(rows->count, 51);
    for (size_t row = 0; row < rows->count; row++) {
        double after = rows->totals[row].time - 0.02 * (double)row;
        CU_ASSERT(after >= -1e-12 && after <= 1.0 / (double)output_of(&whole).step + 1e-12);
    }
    for (int part = 1; part <= 10; part++) {
        advance_to(&parts, 0.1 * part);
    }
    CU_ASSERT_EQUAL(solver_run_history(parts.run)->count, 51);
    finish(&whole);
    finish(&parts);
}

static void test_steps_are_counted(void)
{
    struct sample sample = start(smooth_motion, "dim=3 material.model=linear-elastic");
    advance(&sample, 0);
    CU_ASSERT_EQUAL(output_of(&sample).step, 0);
    advance(&sample, 7);
    advance(&sample, 5);
    CU_ASSERT_EQUAL(output_of(&sample).step, 12);
    CU_ASSERT_EQUAL(solver_run_facts(sample.run).steps, 12);
    double dt = 0.3 * 0.25 / wave_speed(&sample); /* eq. 41: CFL h / c */
    CU_ASSERT_DOUBLE_EQUAL(output_of(&sample).time, 12 * dt, 1e-14);
    finish(&sample);
}

struct watcher {
    size_t calls, stop_at, last_step;
    double last_time, t_end;
};

static bool watch(void *context, double time, double t_end, size_t step)
{
    struct watcher *watcher = context;
    CU_ASSERT(time > watcher->last_time || watcher->calls == 0);
    CU_ASSERT_EQUAL(t_end, watcher->t_end);
    watcher->last_time = time;
    watcher->last_step = step;
    return ++watcher->calls != watcher->stop_at;
}

static void test_progress_can_stop(void)
{
    struct sample sample = start(smooth_motion, "dim=2");
    struct watcher watcher = {.stop_at = 3, .t_end = 1.0};
    CU_ASSERT(solver_run_to(sample.run, 1.0, watch, &watcher, &sample.error));
    struct solver_output output = output_of(&sample);
    CU_ASSERT_EQUAL(watcher.calls, 3);
    CU_ASSERT(output.time < 1.0);
    CU_ASSERT_EQUAL(output.time, watcher.last_time);
    CU_ASSERT_EQUAL(output.step, watcher.last_step);
    watcher.stop_at = 0;
    CU_ASSERT(solver_run_to(sample.run, 1.0, watch, &watcher, &sample.error));
    CU_ASSERT_EQUAL(output_of(&sample).time, 1.0);
    CU_ASSERT_EQUAL(watcher.last_time, 1.0);
    finish(&sample);
}

/* The discrete system is an ODE: halving the step at a fixed lattice shows the integrator's order. */
static void check_order_in_time(const struct solver_scheme *scheme, const struct solver_integrator *integrator)
{
    double u[3][9];
    for (size_t level = 0; level < 3; level++) {
        size_t steps = (size_t)96 << level;
        /* without what is not smooth: tension control acts in tension alone */
        struct sample sample = start(smooth_motion,
                                     "dim=1 n=8 material.model=linear-elastic evolved=pFJ scheme=%s integrator=%s "
                                     "cfl=%.17g support=2.4 ulsph.tension=none",
                                     scheme->name, integrator->name, 4.0 / (double)steps);
        advance(&sample, steps);
        memcpy(u[level], output_of(&sample).v, sizeof u[level]);
        finish(&sample);
    }
    double coarse = 0.0;
    double fine = 0.0;
    for (size_t a = 0; a < 9; a++) {
        coarse = fmax(coarse, fabs(u[0][a] - u[1][a]));
        fine = fmax(fine, fabs(u[1][a] - u[2][a]));
    }
    CU_ASSERT(fine > 1e-12); /* above round-off */
    expect_below("order in time missing", fabs(integrator->order - log2(coarse / fine)), 0.2);
}

static void test_order_in_time(void)
{
    for (const struct solver_scheme *const *scheme = solver_schemes(); *scheme != NULL; scheme++) {
        for (const struct solver_integrator *integrator = solver_integrators(); integrator->name != NULL;
             integrator++) {
            check_order_in_time(*scheme, integrator);
        }
    }
}

/* No force, no strain: velocity and F stay as they are. */
static void test_rigid_translation(void)
{
    static const char motion[] =
        "initial = { velocity = function() return first(0.7, -0.3, 0.1) end,\n"
        "            F = function() if d == 1 then return 1 elseif d == 2 then return 1, 0, 0, 1 end\n"
        "                           return 1, 0, 0, 0, 1, 0, 0, 0, 1 end }\n";
    static const double velocity[] = {0.7, -0.3, 0.1};
    static const char *const settings[] = {"material.model=linear-elastic integrator=tvd-rk2",
                                           "material.model=linear-elastic integrator=rk4 stencil=closed perturb=0.15",
                                           "integrator=ssp-rk3 evolved=pFJ",
                                           "integrator=euler stencil=sbp2",
                                           "integrator=rk4 stencil=sph",
                                           "dim=2 integrator=tvd-rk2",
                                           "dim=1 integrator=rk4 evolved=pF"};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        struct sample sample = start(motion, "%s", settings[i]);
        advance(&sample, 100);
        struct solver_output output = output_of(&sample);
        size_t dim = (size_t)output.cloud->dim;
        double worst = 0.0;
        for (size_t a = 0; a < output.cloud->count; a++) {
            for (size_t k = 0; k < dim; k++) {
                worst = fmax(worst, fabs(output.v[a * dim + k] - velocity[k]));
                worst = fmax(worst, fabs(output.u[a * dim + k] - velocity[k] * output.time));
            }
            for (size_t k = 0; k < dim * dim; k++) {
                worst = fmax(worst, fabs(output.F[a * dim * dim + k] - (k / dim == k % dim ? 1.0 : 0.0)));
            }
        }
        expect_below(settings[i], worst, 2e-13); /* 100 steps, each of a few units in the last place of X */
        finish(&sample);
    }
}

/* A uniform body force moves a body as a point: momentum is the integral of force over time, kinetic energy its work.
 * Quadrature over the step must be exact up to the integrator's degree, which shows wrong stage times. */
static void test_body_force(void)
{
    static const struct {
        const char *integrator, *force;
        double power;
    } rows[] = {{"euler", "t^0", 1.0}, {"tvd-rk2", "t", 2.0}, {"ssp-rk3", "t^2", 3.0}, {"rk4", "t^3", 4.0}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char force[128];
        (void)snprintf(force, sizeof force, "body_force = function(X, Y, Z, t) return first(%s, -2 * %s, 0) end\n",
                       rows[i].force, rows[i].force);
        struct sample sample = start(force, "dim=2 n=3 integrator=%s", rows[i].integrator);
        advance_to(&sample, 0.9);
        struct solver_output output = output_of(&sample);
        double momentum = pow(0.9, rows[i].power) / rows[i].power;
        for (size_t a = 0; a < output.cloud->count; a++) {
            CU_ASSERT_DOUBLE_EQUAL(output.p[2 * a], momentum, 1e-13);
            CU_ASSERT_DOUBLE_EQUAL(output.p[2 * a + 1], -2.0 * momentum, 1e-13);
        }
        const struct solver_history *history = solver_run_history(sample.run);
        struct solver_totals last = history->totals[history->count - 1];
        double kinetic = 5.0 * momentum * momentum / (2.0 * sample.scene->rho);
        CU_ASSERT_DOUBLE_EQUAL(last.kinetic, kinetic, 1e-12);
        double late =
            rows[i].power == 1.0 ? 1.0 / (double)output.step : 0.0; /* Euler sees no speed in the first step */
        CU_ASSERT_DOUBLE_EQUAL(last.external, (1.0 - late) * kinetic,
                               2e-3 * kinetic); /* its power is of higher degree */
        CU_ASSERT_DOUBLE_EQUAL(last.strain, 0.0, 1e-14);
        finish(&sample);
    }
}

/* Only what the scene asks for. */
static void test_memory(void)
{
    static const char *const evolved[] = {"pF", "pFJ", "pFHJ"};
    static const char *const models[] = {"neo-hookean", "linear-elastic"};
    for (size_t model = 0; model < 2; model++) {
        double state[4][3] = {{0}};
        double bytes[4][3] = {{0}};
        for (size_t dim = 1; dim <= 3; dim++) {
            for (size_t e = 0; e < 3; e++) {
                struct sample sample = start(smooth_motion, "dim=%zu n=4 stencil=closed evolved=%s material.model=%s",
                                             dim, evolved[e], models[model]);
                struct solver_facts facts = solver_run_facts(sample.run);
                state[dim][e] = facts.state_bytes;
                bytes[dim][e] = facts.bytes_per_particle;
                printf("\n    %s %zud %-4s %5.0f bytes of state, %6.0f in all, per particle", models[model], dim,
                       evolved[e], facts.state_bytes, facts.bytes_per_particle);
                CU_ASSERT(facts.bytes_per_particle > facts.state_bytes);
                CU_ASSERT(e == 0 || bytes[dim][e] > bytes[dim][e - 1]);
                CU_ASSERT(e != 1 || state[dim][1] > state[dim][0]);
                CU_ASSERT(e != 2 || state[dim][2] >= state[dim][1]); /* {p,F,J} derives the cofactor, or needs none */
                CU_ASSERT(state[dim][e] > state[dim - 1][e] && bytes[dim][e] > bytes[dim - 1][e]);
                finish(&sample);
            }
        }
    }
}

/* An evolved Jacobian drifts from det F by the error of the discretisation, no more; and it is not det F itself. The
 * motion is one that stays smooth: between symmetric faces, its mirror images continue it. */
static double distance_of_J(size_t n, double *change)
{
    static const char motion[] =
        "faces = { X0 = 'symmetric', X1 = 'symmetric', Y0 = 'symmetric', Y1 = 'symmetric' }\n"
        "local pi = math.pi\n"
        "initial = { velocity = function(X, Y)\n"
        "    return 0.05 * sin(pi * X) * cos(pi * Y), 0.03 * cos(pi * X) * sin(pi * Y) end }\n";
    struct sample sample = start(motion, "dim=2 n=%zu evolved=pFJ stencil=sbp2 integrator=rk4", n);
    advance_to(&sample, 0.25);
    struct solver_output output = output_of(&sample);
    double square = 0.0;
    *change = 0.0;
    for (size_t a = 0; a < output.cloud->count; a++) {
        const double *F = output.F + 4 * a;
        *change = fmax(*change, fabs(output.J[a] - 1.0));
        double d = output.J[a] - (F[0] * F[3] - F[1] * F[2]);
        square += output.V[a] * d * d;
    }
    finish(&sample);
    return sqrt(square);
}

static void test_evolved_J(void)
{
    double change;
    double coarse = distance_of_J(8, &change);
    double fine = distance_of_J(16, &change);
    printf("\n    |J - det F|: %.2e at n = 8, %.2e at n = 16; J changes by %.2e", coarse, fine, change);
    CU_ASSERT(fine > 0.0);
    expect_below("J - det F against the change of J", coarse / change, 0.02);
    expect_below("J - det F at half the spacing, against the whole", fine / coarse, 0.36); /* order 1.5 */
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"t_end is hit exactly", test_t_end_is_hit},
        {"no time in the past", test_no_time_in_the_past},
        {"rows of the time history", test_history_rows},
        {"as many steps as asked for", test_steps_are_counted},
        {"progress sees every step and can stop the run", test_progress_can_stop},
        {"order in time is the integrator's", test_order_in_time},
        {"rigid translation", test_rigid_translation},
        {"a uniform body force", test_body_force},
        {"memory per particle", test_memory},
        {"the evolved Jacobian stays with det F", test_evolved_J},
    };
    return unit_main("run", tests, sizeof tests / sizeof *tests);
}
