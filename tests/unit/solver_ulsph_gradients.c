/* Updated-Lagrangian SPH: rates of density and stress (001_363f711843f01da4.txt eq. 27, 6, 7) against their formulas,
 * on lattices that are shifted, stretched and turned. */
#include "solver/integrator.h"
#include "tests/unit/ulsph_states.h"

static const char *const blocks[] = {"dim=1 n=12", "dim=2 n=6", "dim=3 n=4"};

/* 2 mu (D - tr D / 3 I) + Omega S - S Omega */
static void jaumann_rate(size_t dim, double mu, const double *G, const double *S, double *rate)
{
    double spin[9];
    double left[9];
    double right[9];
    double trace = 0.0;
    for (size_t k = 0; k < dim * dim; k++) {
        spin[k] = 0.5 * (G[k] - G[k % dim * dim + k / dim]);
        trace += k / dim == k % dim ? G[k] : 0.0;
    }
    multiply(dim, spin, S, left);
    multiply(dim, S, spin, right);
    for (size_t k = 0; k < dim * dim; k++) {
        double D = 0.5 * (G[k] + G[k % dim * dim + k / dim]);
        rate[k] = 2.0 * mu * (D - (k / dim == k % dim ? trace / 3.0 : 0.0)) + left[k] - right[k];
    }
}

/* Largest error of rho_rate and S_rate where the velocity is G x, relative to the largest rate. */
static double error_of_rates(struct sample *sample, const double *G)
{
    size_t dim = ulsph_dim(sample);
    struct ulsph_field rho = ulsph_field(sample, "rho");
    struct ulsph_field S = ulsph_field(sample, "S");
    double mu = sample->run->constants->mu;
    double trace = 0.0;
    double worst = 0.0;
    double size = 0.0;
    ulsph_evaluate(sample);
    for (size_t i = 0; i < dim; i++) {
        trace += G[i * dim + i];
    }
    for (size_t a = 0; a < sample->run->cloud->count; a++) {
        double S_a[9];
        double rate[9];
        for (size_t k = 0; k < dim * dim; k++) {
            S_a[k] = *ulsph_entry(sample, S.value, a, k / dim, k % dim);
        }
        jaumann_rate(dim, mu, G, S_a, rate);
        worst = fmax(worst, fabs(rho.rate[a] + rho.value[a] * trace));
        for (size_t k = 0; k < dim * dim; k++) {
            worst = fmax(worst, fabs(*ulsph_entry(sample, S.rate, a, k / dim, k % dim) - rate[k]));
            size = fmax(size, fabs(rate[k]));
        }
    }
    return worst / size;
}

/* A velocity linear in x, a state that is not, a lattice out of shape: exact with the corrective matrix, far from it
 * without. */
static void test_linear_velocity(void)
{
    static const double drift[] = {0.3, -0.7, 0.2};
    for (size_t dim = 1; dim <= 3; dim++) {
        struct sample corrected = start(ulsph_material, "%s ulsph.xsph=0 ulsph.delta=0", blocks[dim - 1]);
        struct sample plain =
            start(ulsph_material, "%s ulsph.xsph=0 ulsph.delta=0 ulsph.gradient=plain", blocks[dim - 1]);
        for (int trial = 0; trial < 10; trial++) {
            double F[9];
            double G[9];
            random_deformation(dim, F);
            random_deformation(dim, G); /* any tensor */
            ulsph_place(&corrected, trial % 2 == 0 ? NULL : F, 0.15);
            ulsph_move(&corrected, G, drift);
            ulsph_strain(&corrected, 0.2, 1.0);
            ulsph_copy(&corrected, &plain);
            expect_below(blocks[dim - 1], error_of_rates(&corrected, G), 1e-13);
            CU_ASSERT(error_of_rates(&plain, G) > 0.1);
        }
        finish(&corrected);
        finish(&plain);
    }
}

/* dim 1 does not turn. W = -W^T; in 3D about an axis that is none of the frame's. */
static void spin_of(size_t dim, double W[9])
{
    static const double plane[] = {0, -1, 1, 0};
    static const double space[] = {0, -2. / 3, 1. / 3, 2. / 3, 0, -2. / 3, -1. / 3, 2. / 3, 0};
    memcpy(W, dim == 2 ? plane : space, dim * dim * sizeof *W);
}

/* exp(W angle) for |W| of one radian: Rodrigues' formula, which holds in the plane too. */
static void turn(size_t dim, const double *W, double angle, double *R)
{
    double square[9];
    multiply(dim, W, W, square);
    unit_tensor(dim, R);
    for (size_t k = 0; k < dim * dim; k++) {
        R[k] += sin(angle) * W[k] + (1.0 - cos(angle)) * square[k];
    }
}

/* R S R^T */
static void turned(size_t dim, const double *R, const double *S, double *result)
{
    double product[9];
    double transposed[9];
    for (size_t k = 0; k < dim * dim; k++) {
        transposed[k] = R[k % dim * dim + k / dim];
    }
    multiply(dim, R, S, product);
    multiply(dim, product, transposed, result);
}

/* The particles at angle t, turning as one. */
static void set_turning(const struct sample *sample, const double *W, double t)
{
    static const double still[3] = {0};
    double R[9];
    turn(ulsph_dim(sample), W, t, R);
    ulsph_place(sample, R, 0.0);
    ulsph_move(sample, W, still);
}

/* Rates of a body that turns: its density stays, its stress turns with it. */
static void test_rigid_rotation(void)
{
    for (size_t dim = 2; dim <= 3; dim++) {
        double W[9];
        struct sample sample = start(ulsph_material, "%s ulsph.xsph=0", blocks[dim - 1]);
        spin_of(dim, W);
        for (int trial = 0; trial < 5; trial++) {
            set_turning(&sample, W, 1.3 * trial);
            ulsph_strain(&sample, 0.0, 1.0);
            expect_below(blocks[dim - 1], error_of_rates(&sample, W), 1e-13);
            struct ulsph_field rho = ulsph_field(&sample, "rho");
            expect_below("rate of density", largest_entry(sample.run->cloud->count, rho.rate), 1e-13);
        }
        finish(&sample);
    }
}

enum { STRESSES = 8 * 12 }; /* numbers of a 3D block of one spacing */

/* 7 radians, a little more than a turn, in `steps` steps of one integrator as integrator.h has it. */
static void turn_around(struct sample *sample, const struct solver_integrator *integrator, size_t steps)
{
    static double begun[STRESSES];
    static double sum[STRESSES];
    struct ulsph_field S = ulsph_field(sample, "S");
    size_t size = sample->run->cloud->count * S.width;
    double dt = 7.0 / (double)steps;
    double W[9];
    CU_ASSERT_FATAL(size <= STRESSES);
    spin_of(ulsph_dim(sample), W);
    for (size_t step = 0; step < steps; step++) {
        memcpy(begun, S.value, size * sizeof *begun);
        memset(sum, 0, sizeof sum);
        for (int s = 0; s < integrator->stages; s++) {
            const struct solver_stage *stage = &integrator->stage[s];
            set_turning(sample, W, ((double)step + stage->time) * dt);
            ulsph_evaluate(sample);
            for (size_t i = 0; i < size; i++) {
                sum[i] += stage->accumulate * S.rate[i];
                S.value[i] = begun[i] + stage->keep * (S.value[i] - begun[i]) +
                             dt * (stage->rate * S.rate[i] + stage->sum * sum[i]);
            }
        }
    }
}

/* Largest error of S against R S0 R^T after the turn; *change is that of |S|, the size of the principal stresses. The
 * state is then as before. */
static double error_of_turn(struct sample *sample, const struct solver_integrator *integrator, size_t steps,
                            double *change)
{
    static double first[STRESSES];
    size_t dim = ulsph_dim(sample);
    struct ulsph_field S = ulsph_field(sample, "S");
    size_t size = sample->run->cloud->count * S.width;
    double error = 0.0;
    double W[9];
    double R[9];
    memcpy(first, S.value, size * sizeof *first);
    turn_around(sample, integrator, steps);
    spin_of(dim, W);
    turn(dim, W, 7.0, R);
    *change = 0.0;
    for (size_t a = 0; a < sample->run->cloud->count; a++) {
        double before[9];
        double after[9];
        double expected[9];
        double squares[2] = {0};
        for (size_t k = 0; k < dim * dim; k++) {
            before[k] = *ulsph_entry(sample, first, a, k / dim, k % dim);
            after[k] = *ulsph_entry(sample, S.value, a, k / dim, k % dim);
            squares[0] += before[k] * before[k];
            squares[1] += after[k] * after[k];
        }
        turned(dim, R, before, expected);
        error = fmax(error, largest_difference(dim * dim, expected, after));
        *change = fmax(*change, fabs(sqrt(squares[1]) - sqrt(squares[0])));
    }
    memcpy(S.value, first, size * sizeof *first);
    return error;
}

/* A stressed body that turns keeps its principal stresses, and they turn with it, but for what the integrator does. */
static void test_whole_turn(void)
{
    for (size_t dim = 2; dim <= 3; dim++) {
        struct sample sample = start(ulsph_material, "dim=%zu n=1 ulsph.xsph=0", dim);
        ulsph_strain(&sample, 0.0, 1.0);
        for (const struct solver_integrator *integrator = solver_integrators(); integrator->name != NULL;
             integrator++) {
            double change[2];
            double coarse = error_of_turn(&sample, integrator, 256, &change[0]);
            double fine = error_of_turn(&sample, integrator, 512, &change[1]);
            printf("\n    %zuD %-8s error of S %.2e, %.2e; change of |S| %.2e, %.2e", dim, integrator->name, coarse,
                   fine, change[0], change[1]);
            expect_below("order over a turn missing", fabs(integrator->order - log2(coarse / fine)), 0.2);
            expect_below("principal stresses", change[1], change[0] / exp2(integrator->order - 0.2));
        }
        finish(&sample);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"linear velocity", test_linear_velocity},
        {"rigid rotation", test_rigid_rotation},
        {"a whole turn", test_whole_turn},
    };
    return unit_main("ulsph gradients", tests, sizeof tests / sizeof *tests);
}
