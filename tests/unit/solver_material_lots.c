/* Loops over particles of every material, several particles at a time or not: what one gets does not depend on those
 * beside it, on all paths; and neo-Hookean ones where J <= 0, and against their formula. */
#include "solver/path.h"
#include "tests/unit/padded.h"

#include <fenv.h>
#include <float.h>

enum { COUNT = 23, KINDS = 4 };

/* Particles of different constants. */
struct bodies {
    size_t dim;
    double *F, *H, *P;
    double J[COUNT];
    double rows[COUNT][9], cofactor[COUNT][9];
    struct solver_material_constants constants[COUNT];
};

static struct bodies bodies_of(const struct sample *sample)
{
    size_t dim = sample->dim;
    struct bodies bodies = {.dim = dim};
    bodies.F = padded_field(dim, COUNT);
    bodies.H = padded_field(dim, COUNT);
    bodies.P = padded_field(dim, COUNT);
    for (size_t a = 0; a < COUNT; a++) {
        double of_F;
        random_deformation(dim, bodies.rows[a]);
        measures(sample, bodies.rows[a], bodies.cofactor[a], &of_F);
        bodies.J[a] = of_F * uniform(0.9, 1.1);
        for (size_t k = 0; k < dim * dim; k++) {
            bodies.cofactor[a][k] *= uniform(0.9, 1.1);
        }
        bodies.constants[a] = solver_material_constants(uniform(1e6, 2e7), uniform(-0.5, 0.49), uniform(500.0, 8e3));
        pad(dim, bodies.rows[a], a, bodies.F);
        pad(dim, bodies.cofactor[a], a, bodies.H);
    }
    return bodies;
}

static void free_bodies(struct bodies *bodies)
{
    free(bodies->F);
    free(bodies->H);
    free(bodies->P);
}

/* With H, J, both or neither of their own: `kind`. */
static void stresses(const struct solver_material *material, struct bodies *bodies, int kind, size_t begin, size_t end,
                     size_t stride)
{
    material->stress_range(bodies->constants, stride, begin, end, bodies->F, kind & 1 ? bodies->H : NULL,
                           kind & 2 ? bodies->J : NULL, bodies->P);
}

/* Ranges of every length, from every particle on, give each particle what a range of its own gives it. */
static void alone_or_beside_others(const struct sample *sample)
{
    struct bodies bodies = bodies_of(sample);
    size_t width = bodies.dim * lanes_of(bodies.dim);
    size_t size = COUNT * width * sizeof(double);
    double *alone = padded_field(bodies.dim, COUNT);
    for (int kind = 0; kind < KINDS; kind++) {
        for (size_t stride = 0; stride < 2; stride++) {
            double speed[COUNT];
            for (size_t a = 0; a < COUNT; a++) {
                stresses(sample->material, &bodies, kind, a, a + 1, stride);
                speed[a] = sample->material->fastest(bodies.constants, stride, a, a + 1, bodies.F);
            }
            memcpy(alone, bodies.P, size);
            for (size_t begin = 0; begin < 5; begin++) {
                for (size_t end = begin; end <= COUNT; end++) {
                    double most = 0.0;
                    memset(bodies.P, 0, size);
                    stresses(sample->material, &bodies, kind, begin, end, stride);
                    for (size_t a = begin; a < end; a++) {
                        most = fmax(most, speed[a]);
                    }
                    bool same = memcmp(bodies.P + begin * width, alone + begin * width,
                                       (end - begin) * width * sizeof(double)) == 0;
                    for (size_t k = 0; k < COUNT * width; k++) {
                        same = same && (bodies.P[k] == 0.0 || (k >= begin * width && k < end * width));
                    }
                    expect(sample, "a stress that depends on its range", same ? 0.0 : 1.0, 0.0);
                    if (end > begin) {
                        double found = sample->material->fastest(bodies.constants, stride, begin, end, bodies.F);
                        expect(sample, "a speed that depends on its range", fabs(found - most), 0.0);
                    }
                }
            }
        }
    }
    free(alone);
    free_bodies(&bodies);
}

/* Stresses and speeds of one path. */
static void results_on(int path, const struct sample *sample, struct bodies *bodies, double *into, double speed[COUNT])
{
    size_t width = bodies->dim * lanes_of(bodies->dim);
    solver_path_use(path);
    const struct solver_material *material = solver_material_find(sample->name)->in[bodies->dim - 1];
    for (int kind = 0; kind < KINDS; kind++) {
        stresses(material, bodies, kind, 0, COUNT, 1);
        memcpy(into + (size_t)kind * COUNT * width, bodies->P, COUNT * width * sizeof(double));
    }
    for (size_t a = 0; a < COUNT; a++) {
        speed[a] = material->fastest(bodies->constants, 1, a, a + 1, bodies->F);
    }
}

static void wide_paths(const struct sample *sample)
{
    int before = solver_path();
    struct bodies bodies = bodies_of(sample);
    double *stress_on[2];
    double speed_on[2][COUNT];
    for (int i = 0; i < 2; i++) {
        stress_on[i] = padded_field(bodies.dim, (size_t)KINDS * COUNT);
        results_on(i + 1, sample, &bodies, stress_on[i], speed_on[i]);
    }
    bool same =
        memcmp(stress_on[0], stress_on[1], KINDS * COUNT * bodies.dim * lanes_of(bodies.dim) * sizeof(double)) == 0;
    expect(sample, "stresses by avx2 and avx512 that differ", same ? 0.0 : 1.0, 0.0);
    for (size_t a = 0; a < COUNT; a++) {
        expect(sample, "speeds by avx2 and avx512 that differ", fabs(speed_on[0][a] - speed_on[1][a]), 0.0);
    }
    solver_path_use(before);
    free(stress_on[0]);
    free(stress_on[1]);
    free_bodies(&bodies);
}

static bool is_neo_hookean(const struct sample *sample)
{
    return strncmp(sample->name, "neo-hookean", strlen("neo-hookean")) == 0;
}

/* An evolved J says that a particle is whole where det F, of its own, has passed through zero. */
static void inverted(const struct sample *sample)
{
    struct bodies bodies = bodies_of(sample);
    size_t dim = bodies.dim;
    if (!is_neo_hookean(sample)) {
        free_bodies(&bodies);
        return;
    }
    for (size_t a = 0; a < COUNT; a++) {
        for (size_t i = 0; i < dim; i++) {
            bodies.rows[a][i * dim] *= -1.0;
        }
        pad(dim, bodies.rows[a], a, bodies.F);
    }
    CU_ASSERT_EQUAL(feclearexcept(FE_ALL_EXCEPT), 0);
    stresses(sample->material, &bodies, 3, 0, COUNT, 1);
    CU_ASSERT_EQUAL(fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW), 0);
    for (size_t a = 0; a < COUNT; a++) {
        double P[9];
        sample->material->stress(&bodies.constants[a], bodies.rows[a], bodies.cofactor[a], bodies.J[a], P);
        double bound = 1e-13 * (largest_entry(dim * dim, P) + bodies.constants[a].mu + bodies.constants[a].kappa);
        for (size_t k = 0; k < dim * dim; k++) {
            expect(sample, "stress where det F < 0", fabs(*entry(dim, bodies.P, a, k / dim, k % dim) - P[k]), bound);
        }
    }
    free_bodies(&bodies);
}

/* Largest row sum of |A^T A|. */
static long double row_sum(size_t dim, const double *A)
{
    long double most = 0.0L;
    for (size_t I = 0; I < dim; I++) {
        long double sum = 0.0L;
        for (size_t J = 0; J < dim; J++) {
            long double entry = 0.0L;
            for (size_t i = 0; i < dim; i++) {
                entry += (long double)A[i * dim + I] * A[i * dim + J];
            }
            sum += fabsl(entry);
        }
        most = fmaxl(most, sum);
    }
    return most;
}

/* The bound of rho c^2 along all N, from the eigenvalues of shear 1 + mixed (f (x) h + h (x) f) + by_JJ h (x) h with
 * f . h = J, |f|^2 and |h|^2 at most the row sums. */
static void speed_by_formula(const struct sample *sample)
{
    struct bodies bodies = bodies_of(sample);
    size_t dim = bodies.dim;
    for (size_t a = 0; is_neo_hookean(sample) && a < COUNT; a++) {
        const struct solver_material_constants *of = &bodies.constants[a];
        double H[9];
        long double FF = 3.0L - dim;
        cofactor_of(dim, bodies.rows[a], H);
        long double J = determinant_of(dim, bodies.rows[a]);
        for (size_t k = 0; k < dim * dim; k++) {
            FF += (long double)bodies.rows[a][k] * bodies.rows[a][k];
        }
        long double shear = of->mu / cbrtl(J * J);
        long double mixed = -2.0L / 3.0L * shear / J;
        long double by_JJ = of->kappa + 5.0L / 9.0L * shear * FF / (J * J);
        long double ff = row_sum(dim, bodies.rows[a]);
        long double hh = row_sum(dim, H);
        long double half = mixed * J + 0.5L * by_JJ * hh;
        long double root = sqrtl(half * half + mixed * mixed * fmaxl(0.0L, ff * hh - J * J));
        long double speed = sqrtl((shear + half + root) / of->rho);
        double found = sample->material->fastest(bodies.constants, 1, a, a + 1, bodies.F);
        /* det F, from terms of up to 8 that it may be 1/8 of, enters by its square's inverse */
        expect(sample, "fastest wave against its formula", (double)fabsl(found / speed - 1.0L), 64 * 4 * DBL_EPSILON);
    }
    free_bodies(&bodies);
}

static void test_ranges(void)
{
    each(alone_or_beside_others);
}

static void test_paths(void)
{
    if (SOLVER_PATHS == 3 && solver_path_runs(2)) {
        each(wide_paths);
    } else {
        CU_PASS("there are no two of them");
    }
}

static void test_inverted(void)
{
    each(inverted);
}

static void test_formula(void)
{
    each(speed_by_formula);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"a particle's bits do not depend on its range", test_ranges},
        {"wide paths give the same bits", test_paths},
        {"det F below zero beside a J above", test_inverted},
        {"the fastest wave by its formula", test_formula},
    };
    return unit_main("material lots", tests, sizeof tests / sizeof *tests);
}
