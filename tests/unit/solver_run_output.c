/* Runs: what they show of a known state, stresses, momenta and memory; the same body in the plane and between rollers;
 * the evolved cofactor. */
#include "tests/unit/runs.h"

static const double deformation[3][9] = {
    {1.15}, {1.2, 0.3, -0.1, 0.9}, {1.2, 0.3, 0.1, -0.2, 0.9, 0.1, 0.05, 0.15, 1.05}};

/* A homogeneous deformation, held for no longer than it takes to look at it. */
static struct sample deformed(size_t dim, const char *model, const char *evolved)
{
    char text[512], list[256];
    size_t used = 0;
    for (size_t i = 0; i < dim * dim; i++) {
        used +=
            (size_t)snprintf(list + used, sizeof list - used, "%s%.17g", i > 0 ? ", " : "", deformation[dim - 1][i]);
    }
    (void)snprintf(text, sizeof text, "initial = { F = function() return %s end }\n", list);
    return start(text, "dim=%zu n=2 material.model=%s evolved=%s", dim, model, evolved);
}

/* Hooke's law with E = 3, nu = 0.3, or the neo-Hookean model, on all nine components: Cauchy stress, J and cofactor. */
static void by_hand(size_t dim, bool linear, double sigma[3][3], double *J, double H[3][3])
{
    const double mu = 3.0 / 2.6, kappa = 3.0 / 1.2;
    double F[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (size_t i = 0; i < dim * dim; i++) {
        F[i / dim][i % dim] = deformation[dim - 1][i];
    }
    double trace = F[0][0] + F[1][1] + F[2][2] - 3.0;
    double square = 0.0;
    for (size_t i = 0; i < 3; i++) {
        for (size_t j = 0; j < 3; j++) {
            size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            double one = i == j ? 1.0 : 0.0;
            H[i][j] = linear ? one * (2.0 + trace) - F[j][i] : F[i1][j1] * F[i2][j2] - F[i1][j2] * F[i2][j1];
            square += F[i][j] * F[i][j];
        }
    }
    *J = linear ? 1.0 + trace : F[0][0] * H[0][0] + F[0][1] * H[0][1] + F[0][2] * H[0][2];
    for (size_t i = 0; i < 3; i++) {
        for (size_t j = 0; j < 3; j++) {
            double one = i == j ? 1.0 : 0.0;
            double b = F[i][0] * F[j][0] + F[i][1] * F[j][1] + F[i][2] * F[j][2];
            sigma[i][j] = linear ? mu * (F[i][j] + F[j][i] - 2.0 * one) + (kappa - 2.0 / 3.0 * mu) * trace * one
                                 : mu / pow(*J, 5.0 / 3.0) * (b - square / 3.0 * one) + kappa * (*J - 1.0) * one;
        }
    }
}

static void test_measures(void)
{
    static const char *const models[] = {"linear-elastic", "neo-hookean", "neo-hookean-polyconvex"};
    static const char *const evolved[] = {"pF", "pFJ", "pFHJ"};
    for (size_t i = 0; i < 27; i++) {
        size_t dim = i / 9 + 1;
        double s[3][3], H[3][3], J;
        by_hand(dim, i / 3 % 3 == 0, s, &J, H);
        double mean = (s[0][0] + s[1][1] + s[2][2]) / 3.0;
        double differences = (s[0][0] - s[1][1]) * (s[0][0] - s[1][1]) + (s[1][1] - s[2][2]) * (s[1][1] - s[2][2]) +
                             (s[2][2] - s[0][0]) * (s[2][2] - s[0][0]);
        double shears = s[0][1] * s[0][1] + s[1][2] * s[1][2] + s[2][0] * s[2][0];
        struct sample sample = deformed(dim, models[i / 3 % 3], evolved[i % 3]);
        struct solver_output output = output_of(&sample);
        for (size_t a = 0; a < output.cloud->count; a++) {
            CU_ASSERT_DOUBLE_EQUAL(output.von_mises[a], sqrt(0.5 * differences + 3.0 * shears), 4e-15);
            CU_ASSERT_DOUBLE_EQUAL(output.pressure[a], mean, 4e-15);
            CU_ASSERT_DOUBLE_EQUAL(output.J[a], J, 1e-15);
            for (size_t k = 0; k < dim * dim; k++) {
                CU_ASSERT_DOUBLE_EQUAL(output.H[a * dim * dim + k], H[k / dim][k % dim], 1e-15);
                CU_ASSERT_DOUBLE_EQUAL(output.sigma[a * dim * dim + k], s[k / dim][k % dim], 4e-15);
            }
            if (dim < 3) {
                CU_ASSERT_DOUBLE_EQUAL(output.sigma_normal[a], s[2][2], 4e-15);
            } else {
                CU_ASSERT_PTR_NULL(output.sigma_normal);
            }
        }
        finish(&sample);
    }
}

/* Without a formula for it, F is what the stencil makes of the displacement: of a linear one, its gradient. */
static void test_discrete_F(void)
{
    for (size_t dim = 1; dim <= 3; dim++) {
        struct sample sample =
            start("initial = { displacement = function(X, Y, Z)\n"
                  "    return first(0.2 * X - 0.1 * Y + 0.3 * Z, 0.05 * X + 0.1 * Z, 0.15 * Y) end }\n",
                  "dim=%zu stencil=%s", dim, dim == 2 ? "closed" : "sbp2");
        static const double gradient[3][3] = {{0.2, -0.1, 0.3}, {0.05, 0.0, 0.1}, {0.0, 0.15, 0.0}};
        struct solver_output output = output_of(&sample);
        for (size_t a = 0; a < output.cloud->count; a++) {
            for (size_t k = 0; k < dim * dim; k++) {
                double expected = gradient[k / dim][k % dim] + (k / dim == k % dim ? 1.0 : 0.0);
                CU_ASSERT_DOUBLE_EQUAL(output.F[a * dim * dim + k], expected, 1e-13);
            }
        }
        finish(&sample);
    }
}

/* A block that has been moved by (3, -1, 2) m and flies: sums are those of its centre of mass. */
static void test_momenta(void)
{
    static const double velocity[] = {0.7, -0.3, 0.5}, centre[] = {3.5, -0.5, 2.5};
    for (size_t dim = 1; dim <= 3; dim++) {
        struct sample sample = start("initial = { displacement = function() return first(3, -1, 2) end,\n"
                                     "            velocity = function() return first(0.7, -0.3, 0.5) end }\n",
                                     "dim=%zu n=4 evolved=pF", dim);
        advance_to(&sample, 0.5);
        const struct solver_history *history = solver_run_history(sample.run);
        double energy = 0.0, v[3] = {0}, x[3] = {0};
        for (size_t row = 0; row < history->count; row++) {
            const struct solver_totals *totals = &history->totals[row];
            energy = 0.0;
            for (size_t i = 0; i < dim; i++) {
                v[i] = velocity[i];
                x[i] = centre[i] + velocity[i] * totals->time;
                energy += velocity[i] * velocity[i]; /* mass 2 kg */
            }
            for (size_t i = 0; i < 3; i++) {
                size_t j = (i + 1) % 3, k = (i + 2) % 3;
                CU_ASSERT_DOUBLE_EQUAL(totals->linear[i], 2.0 * v[i], 1e-13);
                CU_ASSERT_DOUBLE_EQUAL(totals->angular[i], 2.0 * (x[j] * v[k] - x[k] * v[j]), 1e-12);
            }
            CU_ASSERT_DOUBLE_EQUAL(totals->kinetic, energy, 1e-13);
        }
        finish(&sample);
    }
}

/* Plane strain is a body between rollers, whatever is evolved: out of the plane too. */
static void test_plane_strain(void)
{
    static const char motion[] = "initial = { velocity = function(X, Y)\n"
                                 "    return first(0.4 * sin(2 * X + Y), 0.3 * cos(3 * Y - X), 0) end }\n"
                                 "if d == 3 then faces = { Z0 = 'symmetric', Z1 = 'symmetric' } end\n";
    static const char *const models[] = {"linear-elastic", "neo-hookean", "neo-hookean-polyconvex"};
    static const char *const evolved[] = {"pF", "pFJ", "pFHJ"};
    for (size_t i = 0; i < 9; i++) {
        struct sample plane = start(motion, "dim=2 n=4 material.model=%s evolved=%s", models[i / 3], evolved[i % 3]);
        struct sample solid = start(motion, "dim=3 n=4 material.model=%s evolved=%s", models[i / 3], evolved[i % 3]);
        /* the same steps: a bound of the wave speeds may know that there is a third direction */
        advance_to(&plane, 0.5);
        advance_to(&solid, 0.5);
        struct solver_output flat = output_of(&plane), thick = output_of(&solid);
        if (flat.step == thick.step) {
            double worst = 0.0, strain = 0.0;
            for (size_t a = 0; a < thick.cloud->count; a++) {
                size_t b = 0;
                while (flat.cloud->site[2 * b] != thick.cloud->site[3 * a] ||
                       flat.cloud->site[2 * b + 1] != thick.cloud->site[3 * a + 1]) {
                    b++;
                }
                worst = fmax(worst, fabs(flat.von_mises[b] - thick.von_mises[a]));
                worst = fmax(worst, fabs(flat.pressure[b] - thick.pressure[a]));
                worst = fmax(worst, fabs(flat.J[b] - thick.J[a]));
                worst = fmax(worst, fabs(flat.P[4 * b + 1] - thick.P[9 * a + 1]));
                strain = fmax(strain, fabs(flat.J[b] - 1.0));
            }
            CU_ASSERT(strain > 0.02);
            printf("\n    %.1e  %s %s", worst, models[i / 3], evolved[i % 3]);
            /* {p,F,H,J} in 3D: H_zz is evolved, and leaves det F by the error of the time integration */
            expect_below("in the plane against between rollers", worst, i % 3 == 2 && i > 2 ? 2e-4 : 1e-13);
        }
        CU_ASSERT_EQUAL(flat.step, thick.step);
        finish(&plane);
        finish(&solid);
    }
}

/* The evolved cofactor takes no dissipation: it leaves that of F by the error of the time integration alone. */
static double distance_of_H(const char *cfl)
{
    struct sample sample = start("initial = { velocity = function(X, Y, Z)\n"
                                 "    return 0.4 * sin(2 * X + Y), 0.3 * cos(3 * Y - Z), 0.4 * sin(X - 2 * Z) end }\n",
                                 "evolved=pFHJ cfl=%s", cfl);
    advance_to(&sample, 0.5);
    struct solver_output output = output_of(&sample);
    double worst = 0.0;
    for (size_t a = 0; a < output.cloud->count; a++) {
        const double *F = output.F + 9 * a;
        for (size_t k = 0; k < 9; k++) {
            size_t i1 = (k / 3 + 1) % 3, i2 = (k / 3 + 2) % 3, j1 = (k % 3 + 1) % 3, j2 = (k % 3 + 2) % 3;
            double H = F[3 * i1 + j1] * F[3 * i2 + j2] - F[3 * i1 + j2] * F[3 * i2 + j1];
            worst = fmax(worst, fabs(output.H[9 * a + k] - H));
        }
    }
    finish(&sample);
    return worst;
}

static void test_evolved_H(void)
{
    double whole = distance_of_H("0.3"), half = distance_of_H("0.15");
    printf("\n    |H - cof F|: %.2e, with half the step %.2e", whole, half);
    CU_ASSERT(half > 1e-12); /* it is evolved, and not the cofactor itself */
    expect_below("|H - cof F| at half the step, against the whole", half / whole, 0.3);
    expect_below("|H - cof F|", whole, 1e-3);
}

/* Doubles per particle that an integrator keeps: state, start of the step and rate; rk4 the sum of its rates as well.
 */
static void test_memory_of_integrators(void)
{
    for (size_t dim = 1; dim <= 3; dim++) {
        double vector = dim == 3 ? 4.0 : (double)dim; /* padded */
        double tensor = (double)dim * vector;
        double evolved = 2.0 * vector + tensor; /* velocity, position, F; beside them, reference position and P */
        struct sample two = start("", "dim=%zu evolved=pF integrator=tvd-rk2", dim);
        struct sample four = start("", "dim=%zu evolved=pF integrator=rk4", dim);
        struct solver_facts of_two = solver_run_facts(two.run), of_four = solver_run_facts(four.run);
        CU_ASSERT_EQUAL(of_two.state_bytes, 8.0 * (evolved + vector + tensor));
        CU_ASSERT_DOUBLE_EQUAL(of_four.bytes_per_particle - of_two.bytes_per_particle, 8.0 * evolved, 1e-9);
        CU_ASSERT(of_two.bytes_per_particle > of_two.state_bytes + 16.0 * evolved); /* the stencil comes on top */
        finish(&two);
        finish(&four);
    }
}

/* The last row of a probe is the displacement and velocity of the particle there, bit for bit. */
static void test_probes(void)
{
    static const char probed[] = "probes = { { name = 'corner', X = each(0) }, { name = 'centre', X = each(0.5) } }\n"
                                 "initial = { velocity = function(X, Y) return first(0.01 * X, 0.02 * Y, 0.03) end }\n";
    struct sample sample = start(probed, "dim=2 t_end=0.05");
    advance_to(&sample, 0.05);
    struct solver_output output = output_of(&sample);
    const struct solver_history *history = solver_run_history(sample.run);
    CU_ASSERT_EQUAL_FATAL(history->probe_count, 2);
    CU_ASSERT_EQUAL_FATAL(history->totals[history->count - 1].time, output.time);
    size_t found = 0;
    for (size_t k = 0; k < 2; k++) {
        const double *u = history->probe_u + 3 * ((history->count - 1) * 2 + k);
        const double *v = history->probe_v + 3 * ((history->count - 1) * 2 + k);
        for (size_t a = 0; a < output.cloud->count; a++) {
            const double *X = output.cloud->X + 2 * a;
            if (X[0] == 0.5 * (double)k && X[1] == 0.5 * (double)k) {
                found++;
                CU_ASSERT(u[0] == output.u[2 * a] && u[1] == output.u[2 * a + 1] && u[2] == 0.0);
                CU_ASSERT(v[0] == output.v[2 * a] && v[1] == output.v[2 * a + 1] && v[2] == 0.0);
                CU_ASSERT(k == 0 || (u[1] != 0.0 && v[1] != 0.0));
            }
        }
    }
    CU_ASSERT_EQUAL(found, 2);
    finish(&sample);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"probes", test_probes},
        {"stress, Jacobian and cofactor of a known deformation", test_measures},
        {"F of a displacement", test_discrete_F},
        {"momenta of a body that flies", test_momenta},
        {"plane strain is a body between rollers", test_plane_strain},
        {"the evolved cofactor stays with that of F", test_evolved_H},
        {"memory of the integrators", test_memory_of_integrators},
    };
    return unit_main("output of runs", tests, sizeof tests / sizeof *tests);
}
