/* Composite bodies and faces that are let go. */
#include "tests/unit/runs.h"

/* One material said in two ways; and two materials that meet at X = 0.5. */
static const char uniform[] = "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2,\n"
                              "    at = function(X, Y, Z) return 3, 0.3, 2 end }\n";
static const char halves[] = "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2,\n"
                             "    at = function(X) if X < 0.5 then return 3, 0.3, 2 end return 40, 0.1, 7 end }\n";

static void join(char out[2048], const char *first, const char *second)
{
    CU_ASSERT_FATAL(snprintf(out, 2048, "%s%s", first, second) < 2048);
}

static double largest_difference(size_t count, const double *one, const double *other)
{
    double difference = 0.0;
    double size = 0.0;
    for (size_t i = 0; i < count; i++) {
        difference = fmax(difference, fabs(one[i] - other[i]));
        size = fmax(size, fabs(one[i]));
    }
    return difference / size;
}

/* The loops of composite bodies do what those of plain ones do. */
static void test_uniform(void)
{
    static const char *const rows[] = {
        "dim=1 n=16 evolved=pFHJ",
        "dim=2 n=8 evolved=pFJ volume_flux=stress",
        "dim=3 n=4 evolved=pF reconstruction=least-squares",
        "dim=3 n=4 evolved=pFHJ",
        "dim=2 n=8 stencil=sph support=2.1 evolved=pFJ",
        "dim=2 n=8 reconstruction=none evolved=pFHJ",
    };
    char text[2048];
    join(text, uniform, smooth_motion);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct sample plain = start(smooth_motion, "%s", rows[i]);
        struct sample composite = start(text, "%s", rows[i]);
        advance(&plain, 50);
        advance(&composite, 50);
        struct solver_output a = output_of(&plain);
        struct solver_output b = output_of(&composite);
        size_t numbers = a.cloud->count * (size_t)a.cloud->dim;
        CU_ASSERT(largest_difference(numbers, a.p, b.p) < 1e-13);
        CU_ASSERT(largest_difference(numbers, a.P, b.P) < 1e-11);
        CU_ASSERT(largest_difference(a.cloud->count, a.J, b.J) < 1e-13);
        CU_ASSERT(solver_run_facts(plain.run).bytes_per_particle < solver_run_facts(composite.run).bytes_per_particle);
        finish(&plain);
        finish(&composite);
    }
}

/* The most energy there was at any time that the history tells of, over that of the start, less one. */
static double rise_of_energy(struct sample *sample)
{
    const struct solver_history *history = solver_run_history(sample->run);
    double before = history->totals[0].kinetic + history->totals[0].strain;
    double most = 0.0;
    for (size_t row = 0; row < history->count; row++) {
        most = fmax(most, history->totals[row].kinetic + history->totals[row].strain);
    }
    return most / before - 1.0;
}

/* What the dissipation of J takes from stresses on the far side of an interface is not fed in: a free body of a soft
 * and a stiff part, that meet along a slanted line, gains no energy. */
static void test_energy(void)
{
    static const char slanted[] =
        "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2, at = function(X, Y)\n"
        "    if X < 0.5 + 0.3 * (Y or 0) then return 3, 0.3, 2 end return 3e4, 0.3, 2e4 end }\n"
        "initial = { velocity = function(X, Y, Z)\n"
        "    return first(1e-3 * cos(3 * X) * cos(6 * (Y or 0) + 0.3), 1e-3 * cos(6 * X) * cos(3 * (Y or 0)), 0) end "
        "}\n";
    static const char *const rows[] = {"dim=2 n=8 evolved=pFJ", "dim=2 n=8 evolved=pFHJ precision=mixed stencil=sbp4",
                                       "dim=2 n=8 evolved=pFJ stencil=closed reconstruction=least-squares",
                                       "dim=2 n=8 evolved=pFJ volume_flux=stress"};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct sample sample = start(slanted, "integrator=rk4 cfl=0.3 history=50 t_end=0.8 %s", rows[i]);
        advance_to(&sample, 0.8);
        expect_below(rows[i], rise_of_energy(&sample), 1e-12);
        finish(&sample);
    }
}

/* A light, soft half and one of ten thousand times its density and stiffness, with no particle between: the step is one
 * that the light particles beside the stiff ones can follow. */
static void test_contrast(void)
{
    static const char contrast[] =
        "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2,\n"
        "    at = function(X) if X < 0.52 then return 3, 0.3, 2 end return 3e4, 0.3, 2e4 end }\n"
        "initial = { velocity = function(X, Y, Z)\n"
        "    return first(1e-4 * sin(40 * X + 3), 1e-4 * cos(50 * (Y or 0)), 0) end }\n";
    static const char *const rows[] = {"dim=1 n=16 evolved=pF", "dim=2 n=8 evolved=pFHJ stencil=sbp4",
                                       "dim=2 n=8 evolved=pF stencil=sph support=2.1",
                                       "dim=2 n=8 evolved=pF scheme=jst", "dim=2 n=8 evolved=pFJ precision=single"};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct sample sample = start(contrast, "integrator=rk4 cfl=0.45 t_end=1e9 %s", rows[i]);
        double most = 0.0;
        advance(&sample, 400);
        struct solver_output output = output_of(&sample);
        for (size_t k = 0; k < output.cloud->count * (size_t)output.cloud->dim; k++) {
            most = fmax(most, fabs(output.v[k]));
        }
        CU_ASSERT(most > 0.0 && most < 1e-2);
        finish(&sample);
    }
}

/* That step, of two with one wave speed: half the mean of both sides' moduli over the light particle's density, for
 * which waves alone have c^2 (meeting.h). A particle on the interface hides them from each other. */
static void test_meeting_step(void)
{
    static const char bar[] = "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2, at = function(X)\n"
                              "    if X < 0.52 then return 3, 0.3, 2 end return 3 * jump, 0.3, 2 * jump end }\n";
    static const double jumps[] = {2.0, 3.0, 10.0, 1e4};
    for (size_t i = 0; i < sizeof jumps / sizeof *jumps; i++) {
        char text[1024];
        (void)snprintf(text, sizeof text, "parameters = { jump = %g }\n%s", jumps[i], bar);
        struct sample sample = start(text, "dim=1 n=16 evolved=pF cfl=0.3");
        CU_ASSERT_DOUBLE_EQUAL(solver_run_facts(sample.run).shorter, fmax(1.0, sqrt((1.0 + jumps[i]) / 4.0)), 1e-12);
        finish(&sample);
    }
}

/* The same with kernels that reach across: what the stiff side's stress and its impedance do to light particles feeds
 * no energy in. */
static void test_kernels(void)
{
    static const char contrast[] =
        "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2,\n"
        "    at = function(X, Y) if X < 0.52 + slope * (Y or 0) then return 3, 0.3, 2 end return 3e4, 0.3, 2e4 end }\n"
        "initial = { velocity = function(X, Y, Z)\n"
        "    return first(1e-6 * sin(40 * X + 3), 1e-6 * cos(50 * (Y or 0)), 0) end }\n"
        "scheme, support = 'ulsph', 2.4\n";
    static const char *const rows[] = {"dim=1 n=16", "dim=2 n=8", "dim=2 n=8 slope=0.3",
                                       "dim=2 n=8 slope=0.3 ulsph.dissipation=viscosity"};
    char text[2048];
    join(text, "parameters = { slope = 0 }\n", contrast);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct sample sample = start(text, "integrator=ssp-rk3 cfl=0.4 history=50 t_end=1 %s", rows[i]);
        advance_to(&sample, 1.0);
        expect_below(rows[i], rise_of_energy(&sample), 1e-6);
        finish(&sample);
    }
}

static void test_momentum(void)
{
    char text[2048];
    join(text, halves, smooth_motion);
    for (int dim = 1; dim <= 3; dim++) {
        struct sample sample = start(text, "dim=%d n=%d evolved=pFHJ", dim, dim == 1 ? 16 : 5);
        CU_ASSERT_FATAL(solver_run_to(sample.run, 0.5, NULL, NULL, &sample.error));
        const struct solver_history *history = solver_run_history(sample.run);
        const struct solver_totals *first = &history->totals[0];
        const struct solver_totals *last = &history->totals[history->count - 1];
        for (int i = 0; i < dim; i++) {
            CU_ASSERT_DOUBLE_EQUAL(last->linear[i], first->linear[i], 1e-13 * fabs(first->linear[0]));
        }
        CU_ASSERT(last->kinetic + last->strain <= first->kinetic + first->strain);
        CU_ASSERT(last->strain > first->strain);
        finish(&sample);
    }
}

static void test_refused(void)
{
    static const char *const bad[] = {"0, 0.3, 2", "3, 0.5, 2", "3, -1, 2", "3, 0.3, 0", "3, 0.3, -2"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char text[512];
        (void)snprintf(text, sizeof text,
                       "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2,\n"
                       "    at = function(X) if X > 0.9 then return %s end return 3, 0.3, 2 end }\n",
                       bad[i]);
        struct solver_error error = refusal(text, "dim=2");
        CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "material.at at X = (1, "));
        CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "expected E > 0 Pa, nu in (-1, 0.5), rho > 0 kg/m^3"));
    }
}

/* A composite body of the largest moduli and the smallest densities that scenes may have, and of the reverse, runs as
 * one of moderate numbers does; beyond them it is refused. */
static void test_range(void)
{
    static const struct {
        double E, rho, length;
    } rows[] = {{1.0, 1.0, 1.0}, {1e50, 1e-50, 1e23}, {1e-50, 1e50, 1e-23}, {1e50, 1e50, 1e23}, {1e-50, 1e-50, 1e-23}};
    double moderate = NAN;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[2048];
        double c = sqrt(rows[i].E / rows[i].rho);
        double L = rows[i].length;
        (void)snprintf(text, sizeof text,
                       "domain = { lower = {0, 0, 0}, upper = {%.17g, %.17g, %.17g} }\n"
                       "material = { model = 'neo-hookean', E = %.17g, nu = 0.3, rho = %.17g,\n"
                       "    at = function(X) return %.17g, 0.3, %.17g end }\n"
                       "initial = { velocity = function(X, Y, Z) return %.17g * sin(X / %.17g), 0, 0 end }\n",
                       L, L, L, rows[i].E, rows[i].rho, rows[i].E, rows[i].rho, 1e-2 * c, L);
        struct sample sample = start(text, "dim=3 n=4 evolved=pFHJ cfl=0.3 t_end=%.17g", 0.5 * L / c);
        advance_to(&sample, 0.5 * L / c);
        double rise = rise_of_energy(&sample);
        moderate = i == 0 ? rise : moderate;
        /* strain energy is 1e-4 of the modulus, and every step rounds its sum of terms of the modulus' size */
        expect_below("energy", fabs(rise - moderate), 1e-10);
        finish(&sample);
    }
    static const char beyond[] = "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2,\n"
                                 "    at = function(X) return X > 0.9 and 1e51 or 3, 0.3, 2 end }\n";
    struct solver_error error = refusal(beyond, "dim=2");
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "products of moduli would leave the range of double precision"));
}

/* A face that is moved at a constant rate until 0.3 and then let go: it keeps its velocity to the last, a step ends at
 * 0.3 exactly, and what other faces hold stays held. */
static void test_let_go(void)
{
    static const char text[] = "faces = { X0 = { kind = 'motion', value = function() return first(0.01, 0, 0) end,\n"
                               "    free_after = 0.3 }, Y0 = d > 1 and 'symmetric' or nil }\n";
    for (int dim = 1; dim <= 2; dim++) {
        struct sample sample = start(text, "dim=%d n=8 evolved=pF", dim);
        advance_to(&sample, 0.31);
        const struct solver_history *history = solver_run_history(sample.run);
        struct solver_output output = output_of(&sample);
        size_t hits = 0;
        for (size_t i = 0; i < history->count; i++) {
            hits += history->totals[i].time == 0.3;
        }
        CU_ASSERT_EQUAL(hits, 1);
        for (size_t a = 0; a < output.cloud->count; a++) {
            bool moved = (output.cloud->tags[a] & 1U) != 0;
            bool rolls = dim > 1 && (output.cloud->tags[a] & 4U) != 0;
            if (moved) {
                CU_ASSERT(output.v[a * (size_t)dim] != 0.01);
                CU_ASSERT(output.u[a * (size_t)dim] > 0.00299);
            }
            if (rolls) {
                CU_ASSERT_EQUAL(output.u[a * (size_t)dim + 1], 0.0);
            }
        }
        finish(&sample);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"one material said in two ways", test_uniform},
        {"momentum of a composite body", test_momentum},
        {"the step where materials meet", test_meeting_step},
        {"a step for materials that differ ten thousand times", test_contrast},
        {"the step where kernels cross", test_kernels},
        {"the largest and smallest numbers", test_range},
        {"energy where materials meet", test_energy},
        {"constants that cannot be", test_refused},
        {"a face that is let go", test_let_go},
    };
    return unit_main("run_composite", tests, sizeof tests / sizeof *tests);
}
