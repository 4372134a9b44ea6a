/* Updated-Lagrangian SPH: forces of states in which nothing is smooth (001_363f711843f01da4.txt eq. 51). What holds of
 * them holds whatever the state: momentum, work, and the sign of dissipation. */
#include "tests/unit/ulsph_states.h"

static const char *const blocks[] = {"dim=1 n=12", "dim=2 n=6", "dim=3 n=4"};

enum { TRIALS = 20 };

/* |sum m v_rate| over sum |m v_rate|. */
static double unbalanced(const struct sample *sample)
{
    size_t dim = ulsph_dim(sample);
    struct ulsph_field v = ulsph_field(sample, "v");
    double total[3] = {0};
    double size = 0.0;
    for (size_t a = 0; a < sample->run->cloud->count; a++) {
        for (size_t i = 0; i < dim; i++) {
            double force = ulsph_mass(sample, a) * v.rate[a * v.width + i];
            total[i] += force;
            size += fabs(force);
        }
    }
    return sqrt(total[0] * total[0] + total[1] * total[1] + total[2] * total[2]) / size;
}

/* Carried with the transport velocity, mass has the momentum it has with its own (eq. 14). */
static double unbalanced_transport(const struct sample *sample)
{
    struct ulsph_field v = ulsph_field(sample, "v");
    double *transport = ulsph_field(sample, "transport v").value;
    double total[4] = {0};
    double size = 0.0;
    for (size_t k = 0; k < sample->run->cloud->count * v.width; k++) {
        double momentum = ulsph_mass(sample, k / v.width) * (transport[k] - v.value[k]);
        total[k % v.width] += momentum;
        size += fabs(momentum);
    }
    CU_ASSERT(size > 0.0);
    return largest_entry(4, total) / size;
}

static void test_momentum(void)
{
    static const char *const terms[] = {
        "ulsph.tension=none",
        "ulsph.tension=none ulsph.dissipation=none ulsph.gradient=plain",
        "ulsph.tension=stress ulsph.dissipation=viscosity",
        "ulsph.tension=stress ulsph.repulsion=excess ulsph.gradient=plain",
        "ulsph.tension=stress ulsph.stress_factor=0.3 ulsph.stress_exponent=4 ulsph.dissipation=none",
    };
    static const char *const materials[] = {ulsph_material, ulsph_halves};
    for (size_t i = 0; i < 2 * 3 * sizeof terms / sizeof *terms; i++) {
        struct sample sample = start(materials[i % 2], "%s %s", blocks[i / 2 % 3], terms[i / 6]);
        double worst = 0.0;
        for (int trial = 0; trial < TRIALS; trial++) {
            ulsph_scatter(&sample);
            ulsph_evaluate(&sample);
            worst = fmax(worst, fmax(unbalanced(&sample), unbalanced_transport(&sample)));
        }
        expect_below(terms[i / 6], worst, 1e-14);
        finish(&sample);
    }
}

/* Tension control as printed subtracts from one side of a pair alone: forces do not balance where there is tension, and
 * do where there is none. */
static void test_control(void)
{
    for (size_t d = 0; d < 3; d++) {
        struct sample sample = start(ulsph_material, "%s", blocks[d]);
        double tensile = 0.0;
        double compressed = 0.0;
        for (int trial = 0; trial < TRIALS; trial++) {
            ulsph_scatter(&sample);
            ulsph_evaluate(&sample);
            tensile = fmax(tensile, unbalanced(&sample));
            ulsph_scatter(&sample);
            for (size_t a = 0; a < sample.run->cloud->count; a++) {
                ulsph_field(&sample, "rho").value[a] *= 2.0; /* a pressure of K, beyond any S */
            }
            ulsph_evaluate(&sample);
            compressed = fmax(compressed, unbalanced(&sample));
        }
        printf("\n    %s: forces off balance by %.1e of their sum", blocks[d], tensile);
        CU_ASSERT(tensile > 1e-3);
        expect_below("forces off balance", tensile, 0.5);
        expect_below("forces under pressure", compressed, 1e-14);
        finish(&sample);
    }
}

/* Distance from the nearest face, in spacings. */
static double depth(const struct solver_cloud *cloud, size_t a)
{
    double least = INFINITY;
    for (size_t i = 0; i < (size_t)cloud->dim; i++) {
        double X = cloud->X[a * (size_t)cloud->dim + i];
        least = fmin(least, fmin(X, 1.0 - X) / cloud->spacing);
    }
    return least;
}

/* Largest acceleration deep within a block under the same tension everywhere, its particles out of place. */
static double acceleration_in_tension(struct sample *sample)
{
    struct ulsph_field v = ulsph_field(sample, "v");
    double worst = 0.0;
    size_t deep = 0;
    ulsph_place(sample, NULL, 0.1);
    ulsph_strain(sample, 0.0, 0.0);
    for (size_t a = 0; a < sample->run->cloud->count; a++) {
        ulsph_field(sample, "rho").value[a] *= 0.9;
    }
    ulsph_evaluate(sample);
    for (size_t a = 0; a < sample->run->cloud->count; a++) {
        for (size_t i = 0; i < v.width && depth(sample->run->cloud, a) > 2.9; i++) {
            worst = fmax(worst, fabs(v.rate[a * v.width + i]));
            deep++;
        }
    }
    CU_ASSERT(deep > 0);
    return worst;
}

/* What tension control is for (eq. 49, 50): within the body the force in tension is of differences of the stress, so
 * that particles out of place do not feel a stress that is the same all over. */
static void test_constant_tension(void)
{
    static const char *const large[] = {"dim=1 n=12", "dim=2 n=8", "dim=3 n=7"};
    for (size_t d = 0; d < 3; d++) {
        static const char plain[] = "ulsph.gradient=plain ulsph.dissipation=none";
        struct sample bare = start(ulsph_material, "%s %s ulsph.tension=none", large[d], plain);
        struct sample controlled = start(ulsph_material, "%s %s", large[d], plain);
        double felt = acceleration_in_tension(&bare);
        expect_below(large[d], acceleration_in_tension(&controlled) / felt, 1e-14);
        finish(&bare);
        finish(&controlled);
    }
}

/* sum m v . v_rate */
static double power_of_forces(const struct sample *sample)
{
    struct ulsph_field v = ulsph_field(sample, "v");
    double power = 0.0;
    for (size_t k = 0; k < sample->run->cloud->count * v.width; k++) {
        power += ulsph_mass(sample, k / v.width) * v.value[k] * v.rate[k];
    }
    return power;
}

/* sum V sigma : grad v, by way of the rates that the same gradient gave: tr(grad v) = -rho_rate / rho, and the spin
 * does no work on S, so that S : S_rate = 2 mu S : (D - tr D / 3 I). *size is the sum of its parts' sizes. */
static double power_of_stress(const struct sample *sample, double *size)
{
    size_t dim = ulsph_dim(sample);
    struct ulsph_field rho = ulsph_field(sample, "rho");
    struct ulsph_field S = ulsph_field(sample, "S");
    double power = 0.0;
    *size = 0.0;
    for (size_t a = 0; a < sample->run->cloud->count; a++) {
        const struct solver_material_constants *constants = sample->run->constants + a * sample->run->body.stride;
        double p = constants->kappa * (rho.value[a] / constants->rho - 1.0);
        double divergence = -rho.rate[a] / rho.value[a];
        double work = 0.0;
        double trace = 0.0;
        for (size_t k = a * S.width; k < (a + 1) * S.width; k++) {
            work += S.value[k] * S.rate[k];
        }
        for (size_t i = 0; i < dim; i++) {
            trace += *ulsph_entry(sample, S.value, a, i, i);
        }
        double volume = ulsph_mass(sample, a) / rho.value[a];
        double part = volume * (work / (2.0 * constants->mu) + (trace / 3.0 - p) * divergence);
        power += part;
        *size += fabs(part);
    }
    return power;
}

/* The divergence of stress is the negative adjoint of the velocity gradient: what forces give to the motion, strain
 * takes. On a lattice with particles on its faces, whose cells are cut, and with every particle out of its place. */
static void test_adjoint(void)
{
    static const char *const gradients[] = {"corrected", "plain"};
    static const char *const materials[] = {ulsph_material, ulsph_halves};
    for (size_t i = 0; i < 12; i++) {
        struct sample sample = start(materials[i % 2],
                                     "%s ulsph.tension=none ulsph.dissipation=none ulsph.xsph=0 ulsph.delta=0 "
                                     "ulsph.gradient=%s",
                                     blocks[i / 4], gradients[i / 2 % 2]);
        for (int trial = 0; trial < TRIALS; trial++) {
            double size;
            ulsph_scatter(&sample);
            ulsph_evaluate(&sample);
            double sum = power_of_forces(&sample) + power_of_stress(&sample, &size);
            expect_below(gradients[i / 2 % 2], fabs(sum) / size, 1e-14);
        }
        finish(&sample);
    }
}

/* What a dissipation adds to the power of the forces, and the size of the forces that it adds. */
static double power_added(struct sample *with, struct sample *without, double *size)
{
    struct ulsph_field v = ulsph_field(with, "v");
    struct ulsph_field bare = ulsph_field(without, "v");
    double power = 0.0;
    *size = 0.0;
    ulsph_copy(with, without);
    ulsph_evaluate(with);
    ulsph_evaluate(without);
    for (size_t k = 0; k < with->run->cloud->count * v.width; k++) {
        double force = ulsph_mass(with, k / v.width) * (v.rate[k] - bare.rate[k]);
        power += force * v.value[k];
        *size += fabs(force);
    }
    return power;
}

/* Artificial viscosity takes energy from every motion that brings two particles together, and from no other. */
static void test_viscosity(void)
{
    static const double still[3] = {0};
    static const double apart[] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (size_t dim = 1; dim <= 3; dim++) {
        struct sample with = start(ulsph_material, "%s ulsph.dissipation=viscosity", blocks[dim - 1]);
        struct sample without = start(ulsph_material, "%s ulsph.dissipation=none", blocks[dim - 1]);
        double size;
        for (int trial = 0; trial < TRIALS; trial++) {
            ulsph_scatter(&with);
            CU_ASSERT(power_added(&with, &without, &size) < -0.01 * size);
        }
        double grow[9] = {0};
        for (size_t i = 0; i < dim; i++) {
            grow[i * dim + i] = apart[4 * i];
        }
        ulsph_move(&with, grow, still);
        CU_ASSERT_EQUAL(power_added(&with, &without, &size), 0.0);
        CU_ASSERT_EQUAL(size, 0.0);
        finish(&with);
        finish(&without);
    }
}

/* The Riemann term leaves a linear velocity alone, since nothing jumps, and takes energy from a random one. */
static void test_riemann(void)
{
    static const double drift[] = {0.3, -0.7, 0.2};
    for (size_t dim = 1; dim <= 3; dim++) {
        struct sample with = start(ulsph_material, "%s", blocks[dim - 1]);
        struct sample without = start(ulsph_material, "%s ulsph.dissipation=none", blocks[dim - 1]);
        for (int trial = 0; trial < TRIALS; trial++) {
            double G[9];
            double size;
            double linear;
            random_deformation(dim, G);
            ulsph_scatter(&with);
            CU_ASSERT(power_added(&with, &without, &size) < -0.1 * size);
            ulsph_move(&with, G, drift);
            (void)power_added(&with, &without, &linear);
            expect_below("forces in a linear velocity", linear / size, 1e-13);
        }
        finish(&with);
        finish(&without);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"linear momentum", test_momentum},
        {"momentum under tension control", test_control},
        {"a constant tension", test_constant_tension},
        {"work of forces is that of stress", test_adjoint},
        {"viscosity never gives energy", test_viscosity},
        {"Riemann term", test_riemann},
    };
    return unit_main("ulsph forces", tests, sizeof tests / sizeof *tests);
}
