/* The projection that keeps angular momentum (projection.h), over the tables: what claims it is held to it while a body
 * spins and deforms by much; the correction is the least, forces have no resultant, loads turn the body as they should,
 * the integrator keeps its order, and what cannot be meant is refused. */
#include "tests/unit/momenta.h"

#include "solver/integrator.h"
#include "solver/scheme.h"

static const double kept = 1e-12;
enum { STEPS = 1000, LOOKS = 20 };

/* A free body that spins, drifts, and is stretched and bent. */
static const char spinning[] = "initial = { velocity = function(X, Y, Z)\n"
                               "    local x, y, z = X - 0.5, Y - 0.5, (d > 2 and Z or 0.5) - 0.5\n"
                               "    return first(0.1 + 0.6 * x - 0.8 * y + 0.3 * sin(3 * Y + Z),\n"
                               "        0.8 * x - 0.2 * y - 0.5 * z - 0.05, 0.5 * y - 0.3 * z + 0.4 * x * y)\n"
                               "end }\n";
/* Three densities and stiffnesses. */
static const char composite[] = "material = { model = 'neo-hookean', E = 1, nu = 0.3, rho = 1, at = function(X, Y)\n"
                                "    return X > 0.4 and 3 or 1, Y > 0.6 and 0.4 or 0.3, X + Y > 1.1 and 2 or 0.5\n"
                                "end }\n";

struct flight {
    struct drift drift; /* largest at any look */
    double strain;      /* largest component of (F^T F - I) / 2 of any particle at any look */
};

static double largest_strain(const struct solver_output *output)
{
    size_t dim = (size_t)output->cloud->dim;
    double strain = 0.0;
    for (size_t a = 0; a < output->cloud->count; a++) {
        const double *F = output->F + a * dim * dim;
        for (size_t I = 0; I < dim * dim; I++) {
            double sum = I / dim == I % dim ? -0.5 : 0.0;
            for (size_t i = 0; i < dim; i++) {
                sum += 0.5 * F[i * dim + I / dim] * F[i * dim + I % dim];
            }
            strain = fmax(strain, fabs(sum));
        }
    }
    return strain;
}

static struct flight fly(const char *more, const char *settings)
{
    struct sample sample = start(more, "%s", settings);
    struct flight flight = {.strain = 0.0};
    struct solver_output output = output_of(&sample);
    struct momenta before = momenta_of(&output);
    for (int look = 0; look < LOOKS; look++) {
        size_t early = look == 0 ? 10 : 0; /* before what stretches it is damped */
        advance(&sample, early);
        output = output_of(&sample);
        flight.strain = fmax(flight.strain, largest_strain(&output));
        advance(&sample, STEPS / LOOKS - early);
        output = output_of(&sample);
        struct momenta now = momenta_of(&output);
        struct drift drift = drift_between(&before, &now);
        flight.drift.linear = fmax(flight.drift.linear, drift.linear);
        flight.drift.angular = fmax(flight.drift.angular, drift.angular);
        flight.strain = fmax(flight.strain, largest_strain(&output));
    }
    finish(&sample);
    return flight;
}

/* Flights as claimed, and one of them left free; integrators, materials and, in 3D, evolved sets in turn. */
static void fly_with(const struct solver_scheme *scheme, const struct solver_stencil_builder *builder, size_t dim,
                     bool perturbed)
{
    static const char *const evolved[] = {"pF", "pFJ", "pFHJ"};
    static const char *const materials[] = {"neo-hookean", "neo-hookean-polyconvex"};
    static const char *const integrators[] = {"tvd-rk2", "ssp-rk3", "rk4"};
    static size_t turn = 0;
    size_t first = dim == 2 ? 0 : turn % 3;
    size_t end = dim == 2 ? 3 : first + 1;
    for (size_t e = first; e < end; e++, turn++) {
        char settings[384], claimed[512];
        (void)snprintf(settings, sizeof settings,
                       "dim=%zu scheme=%s stencil=%s n=%d support=2.1 perturb=%g evolved=%s material.model=%s "
                       "integrator=%s reconstruction=%s",
                       dim, scheme->name, builder->name, fewest(builder, dim), perturbed ? 0.15 : 0.0, evolved[e],
                       materials[turn % 2], integrators[turn / 2 % 3], turn % 4 == 3 ? "least-squares" : "stencil");
        (void)snprintf(claimed, sizeof claimed, "%s %s", settings, scheme->claims.angular);
        struct flight flight = fly(spinning, claimed);
        struct flight left = e == first ? fly(spinning, settings) : (struct flight){.drift.angular = NAN};
        printf("\n    linear %.1e, angular %.1e, left free %.1e; strain %.2f  %s", flight.drift.linear,
               flight.drift.angular, left.drift.angular, flight.strain, settings);
        expect_below(settings, flight.drift.linear, kept);
        expect_below(settings, flight.drift.angular, kept);
        CU_ASSERT(flight.strain > 0.2);
        CU_ASSERT(isnan(left.drift.angular) || left.drift.angular > 1e4 * kept); /* the projection is what keeps it */
    }
}

static void fly_all(size_t dim)
{
    size_t claims = 0;
    for (const struct solver_scheme *const *scheme = solver_schemes(); *scheme != NULL; scheme++) {
        const struct solver_stencil_builder *builder = solver_stencil_builders();
        for (; (*scheme)->claims.angular != NULL && builder->name != NULL; builder++) {
            fly_with(*scheme, builder, dim, false);
            if (!builder->lattice_only) {
                fly_with(*scheme, builder, dim, true);
            }
            claims++;
        }
    }
    CU_ASSERT(claims >= 4);
}

static void test_2d(void)
{
    fly_all(2);
}

static void test_3d(void)
{
    fly_all(3);
}

/* Every integrator, and densities that differ. */
static void test_integrators(void)
{
    for (const struct solver_integrator *method = solver_integrators(); method->name != NULL; method++) {
        for (size_t dim = 2; dim <= 3; dim++) {
            char settings[256];
            (void)snprintf(settings, sizeof settings, "dim=%zu integrator=%s cfl=%g angular_momentum=projected", dim,
                           method->name, method->order == 1 ? 0.02 : 0.3);
            char more[2048];
            (void)snprintf(more, sizeof more, "%s%s", spinning, composite);
            struct flight flight = fly(more, settings);
            printf("\n    linear %.1e, angular %.1e  %s", flight.drift.linear, flight.drift.angular, settings);
            expect_below(settings, flight.drift.linear, kept);
            expect_below(settings, flight.drift.angular, kept);
        }
    }
}

/* Rates of a first Euler step: velocities after it less those before, over dt. The caller frees. */
static double *first_rates(const char *more, const char *settings, struct sample *sample)
{
    *sample = start(more, "integrator=euler %s", settings);
    struct solver_output output = output_of(sample);
    size_t numbers = output.cloud->count * (size_t)output.cloud->dim;
    double *rate = calloc(numbers, sizeof *rate);
    CU_ASSERT_PTR_NOT_NULL_FATAL(rate);
    memcpy(rate, output.v, numbers * sizeof *rate);
    advance(sample, 1);
    output = output_of(sample);
    for (size_t i = 0; i < numbers; i++) {
        rate[i] = (output.v[i] - rate[i]) / output.time;
    }
    return rate;
}

/* Resultant of rates, and the sum of their magnitudes. */
static double resultant(const struct solver_output *output, const double *rate)
{
    long double sum[3] = {0}, size = 0;
    size_t dim = (size_t)output->cloud->dim;
    for (size_t i = 0; i < output->cloud->count * dim; i++) {
        sum[i % dim] += (long double)(output->V[i / dim] * rate[i]);
        size += (long double)fabs(output->V[i / dim] * rate[i]);
    }
    CU_ASSERT(size > 0);
    return (double)(sqrtl(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / size);
}

/* Internal force: of a deformed body at rest, in which nothing jumps. Dissipation: of one that moves and is told to
 * have no strain. Each has no resultant, projected or not. */
static void test_resultants(void)
{
    static const char at_rest[] = "initial = { displacement = function(X, Y, Z)\n"
                                  "    return first(0.1 * sin(2 * X + Y), 0.2 * X * Y, 0.1 * sin(3 * Z + X)) end }\n";
    static const char unstrained[] =
        "initial = { velocity = function(X, Y, Z) return first(sin(5 * X + Y), X * Y * Y, sin(3 * Z + X)) end,\n"
        "    F = function() if d == 2 then return 1, 0, 0, 1 end return 1, 0, 0, 0, 1, 0, 0, 0, 1 end }\n";
    static const char *const scenes[] = {at_rest, unstrained};
    static const char *const choice[] = {"free", "projected"};
    for (const struct solver_stencil_builder *builder = solver_stencil_builders(); builder->name != NULL; builder++) {
        for (size_t i = 0; i < 8; i++) {
            char settings[128];
            struct sample sample;
            size_t dim = 2 + i / 4;
            (void)snprintf(settings, sizeof settings, "dim=%zu stencil=%s n=%d support=2.1 angular_momentum=%s", dim,
                           builder->name, fewest(builder, dim), choice[i / 2 % 2]);
            double *rate = first_rates(scenes[i % 2], settings, &sample);
            struct solver_output output = output_of(&sample);
            double sum = resultant(&output, rate);
            printf("\n    sum V %s: %.1e of the sum of magnitudes  %s", i % 2 == 0 ? "T" : "D", sum, settings);
            expect_below(settings, sum, 1e-13);
            free(rate);
            finish(&sample);
        }
    }
}

/* What the projection adds is, per unit mass, the motion of a rigid body: whatever else had the same resultant and
 * moment would be a larger change. Taken from three corners, it is found everywhere. */
static void test_least(void)
{
    static const char settings[] = "dim=3 stencil=closed support=2.1 perturb=0.15 evolved=pFHJ";
    struct sample with, without;
    char projected[128];
    (void)snprintf(projected, sizeof projected, "%s angular_momentum=projected", settings);
    double *rate = first_rates(spinning, projected, &with);
    double *plain = first_rates(spinning, settings, &without);
    struct solver_output output = output_of(&with);
    /* the last stage is corrected about where its velocities at the start have taken the particles */
    struct sample still = start(spinning, "%s", settings);
    struct solver_output first = output_of(&still);
    double largest = 0.0, strain = 0.0, scale = 0.0;
    for (size_t a = 0; a < output.cloud->count; a++) {
        for (size_t b = 0; b < a; b++) {
            double along = 0.0, apart = 0.0, change = 0.0;
            for (size_t i = 0; i < 3; i++) {
                double x = output.cloud->X[3 * a + i] - output.cloud->X[3 * b + i] +
                           output.time * (first.v[3 * a + i] - first.v[3 * b + i]);
                double r = (rate[3 * a + i] - plain[3 * a + i]) - (rate[3 * b + i] - plain[3 * b + i]);
                along += x * r;
                apart += x * x;
                change += r * r;
            }
            strain = fmax(strain, fabs(along) / apart);
            scale = fmax(scale, sqrt(change / apart));
        }
    }
    for (size_t i = 0; i < 3 * output.cloud->count; i++) {
        largest = fmax(largest, fabs(rate[i]));
    }
    printf("\n    the correction strains by %.1e, turns by %.1e, rates are %.1e", strain, scale, largest);
    CU_ASSERT(scale > 1e-6 * largest);
    expect_below("strain by the correction", strain, 1e-9 * scale + 1e-12 * largest);
    free(rate);
    free(plain);
    finish(&with);
    finish(&without);
    finish(&still);
}

/* A dead traction on a face turns the body by the integrator's quadrature of its moment: over one step of tvd-rk2 the
 * mean of that on the face as it lies and as the velocity carries it, both known since the body spins as a whole. */
static void test_loads(void)
{
    static const char loaded[] =
        "initial = { velocity = function(X, Y, Z)\n"
        "    if d == 2 then return 0.3 - 0.7 * Y, 0.7 * X end return 0.3 - 0.7 * Y, 0.7 * X - 0.4 * Z, 0.4 * Y end }\n"
        "faces = { X1 = { kind = 'traction', value = function() return first(0.2, 0.5, -0.3) end } }\n"
        "body_force = function() return first(-0.1, 0.3, 0.2) end\n";
    for (size_t dim = 2; dim <= 3; dim++) {
        struct sample sample = start(loaded, "dim=%zu integrator=tvd-rk2 angular_momentum=projected", dim);
        struct solver_output output = output_of(&sample);
        struct momenta before = momenta_of(&output);
        advance(&sample, 1);
        output = output_of(&sample);
        struct momenta after = momenta_of(&output);
        double dt = output.time, z = dim == 3 ? 0.5 : 0.0, w = dim == 3 ? 0.4 : 0.0;
        double body[3] = {-0.1, 0.3, dim == 3 ? 0.2 : 0.0}, face[3] = {0.2, 0.5, dim == 3 ? -0.3 : 0.0};
        double at[2][3] = {{0.5, 0.5, z}, {1.0, 0.5, z}}; /* where they act */
        double moment[3] = {0};
        for (int load = 0; load < 2; load++) {
            const double *x = at[load], *force = load == 0 ? body : face;
            double v[3] = {0.3 - 0.7 * x[1], 0.7 * x[0] - w * x[2], w * x[1]};
            double mean[3] = {x[0] + dt / 2 * v[0], x[1] + dt / 2 * v[1], x[2] + dt / 2 * v[2]};
            for (int i = 0; i < 3; i++) {
                moment[i] += mean[(i + 1) % 3] * force[(i + 2) % 3] - mean[(i + 2) % 3] * force[(i + 1) % 3];
            }
        }
        for (int i = 0; i < 3; i++) {
            CU_ASSERT_DOUBLE_EQUAL((double)(after.angular[i] - before.angular[i]) / dt, moment[i], 1e-12);
            CU_ASSERT_DOUBLE_EQUAL((double)(after.linear[i] - before.linear[i]) / dt, body[i] + face[i], 1e-12);
        }
        finish(&sample);
    }
}

/* Displacements at the end of a short flight in so many steps. The caller frees. */
static double *end_of_flight(const char *more, const char *settings, size_t steps, size_t *numbers)
{
    struct sample sample = start(more, "dim=2 stencil=sbp2 evolved=pFHJ cfl=0.01 %s", settings);
    struct solver_output output = output_of(&sample);
    *numbers = output.cloud->count * 2;
    double *u = calloc(*numbers, sizeof *u);
    CU_ASSERT_PTR_NOT_NULL_FATAL(u);
    /* steps of the size that the whole time divides into: cfl does not bind */
    double T = 0.2, cfl = T / (double)steps * wave_speed(&sample) / 0.25;
    finish(&sample);
    sample = start(more, "dim=2 stencil=sbp2 evolved=pFHJ cfl=%.17g %s", cfl * 1.5, settings);
    size_t taken = 0;
    for (double t = 0.0; taken < steps; taken++) {
        t = taken + 1 == steps ? T : T * (double)(taken + 1) / (double)steps;
        advance_to(&sample, t);
    }
    CU_ASSERT_EQUAL(solver_run_facts(sample.run).steps, steps);
    output = output_of(&sample);
    memcpy(u, output.v, *numbers * sizeof *u);
    finish(&sample);
    return u;
}

static double distance(const double *a, const double *b, size_t count)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; i++) {
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    }
    return sqrt(sum);
}

/* Velocities in 16, 32 and 64 steps approach each other by the integrator's order, free, loaded and held. */
static void test_order(void)
{
    static const char loaded[] = "faces = { X1 = { kind = 'traction', value = function(X, Y, Z, t)\n"
                                 "    return 0.2 + t, 0.5 end } }\n";
    static const char *const faces[] = {"", loaded, "faces = { X0 = 'clamped' }\n"};
    for (const struct solver_integrator *method = solver_integrators(); method->name != NULL; method++) {
        for (size_t i = 0; i < 3; i++) {
            char settings[128], more[1024];
            size_t numbers;
            (void)snprintf(settings, sizeof settings, "integrator=%s angular_momentum=projected", method->name);
            (void)snprintf(more, sizeof more, "%s%s", spinning, faces[i]);
            double *coarse = end_of_flight(more, settings, 16, &numbers);
            double *middle = end_of_flight(more, settings, 32, &numbers);
            double *fine = end_of_flight(more, settings, 64, &numbers);
            double order = log2(distance(coarse, middle, numbers) / distance(middle, fine, numbers));
            printf("\n    order %.2f of %d, %s%s", order, method->order, method->name,
                   i == 0   ? ""
                   : i == 1 ? ", loaded"
                            : ", held");
            CU_ASSERT(order > method->order - 0.15);
            free(coarse);
            free(middle);
            free(fine);
        }
    }
}

static void test_refusals(void)
{
    static const struct {
        const char *more, *settings, *text;
    } cases[] = {
        {"", "dim=1", "a line has none"},
        {"", "dim=2 scheme=ulsph material.model=linear-elastic", "the scheme does not know it"},
        {"", "dim=3 material.model=linear-elastic", "linear kinematics"},
        {"bodies = { { shape = 'box', lower = {0, 0}, upper = {1, 1} }, { shape = 'box', lower = {2, 0}, upper = {3, "
         "1} } }\n"
         "reference_length, lattice = 1, 'centres' -- instead of domain = \n",
         "dim=2 stencil=sph n=8", "one body's would be kept by forces on the others"},
        {"lattice = 'centres'\nfaces = { X0 = 'clamped' }\n", "dim=2 stencil=sph n=8", "lattice = \"nodes\""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct solver_error error = refusal(cases[i].more, "%s angular_momentum=projected", cases[i].settings);
        bool said = error.code == SOLVER_BAD_INPUT &&
                    strstr(error.text, "angular_momentum: expected \"free\"") != NULL &&
                    strstr(error.text, cases[i].text) != NULL;
        if (!said) {
            printf("\n    %s: %s", cases[i].settings, error.text);
        }
        CU_ASSERT(said);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"a spinning body over 1000 steps, 2D", test_2d},
        {"a spinning body over 1000 steps, 3D", test_3d},
        {"every integrator, and densities that differ", test_integrators},
        {"forces have no resultant", test_resultants},
        {"the correction is the least", test_least},
        {"loads turn the body", test_loads},
        {"the integrator keeps its order", test_order},
        {"what is refused", test_refusals},
    };
    return unit_main("angular momentum", tests, sizeof tests / sizeof *tests);
}
