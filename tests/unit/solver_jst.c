/* JST dissipation (solver/jst.h): what it conserves, what it leaves alone, what it takes away, and how fast. */
#include "tests/unit/ulsph_states.h"

#include "solver/stencil.h"

static const char material[] = "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2 }\n"
                               "scheme = 'jst'\n";
static const char halves[] = "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2,\n"
                             "    at = function(X) if X < 0.5 then return 3, 0.3, 2 end return 40, 0.1, 7 end }\n"
                             "scheme = 'jst'\n";

/* Clouds for every stencil that takes them; those on graded lattices come first, then those on even ones. */
static const char *const clouds[] = {"dim=1 n=12 grading.X=10",
                                     "dim=2 n=8 grading.X=10 grading.Y=3 grading.fine_Y=both",
                                     "dim=3 n=7 grading.Y=10 grading.fine_Y=upper",
                                     "dim=1 n=12 support=3",
                                     "dim=2 n=8 support=2.1",
                                     "dim=3 n=7 support=2.1",
                                     "dim=1 n=12 support=3 perturb=0.15",
                                     "dim=2 n=6 support=2.1 perturb=0.15",
                                     "dim=2 n=6 support=2.1 perturb=0.15 reconstruction=least-squares",
                                     "dim=3 n=4 support=2.1 perturb=0.15"};
enum { CLOUDS = 10, GRADED = 3, LATTICES = 6 };

/* A body at rest and without stress, so that v_rate is what the dissipation makes of v. */
static void each_body(const char *scene, const char *terms, void (*look)(struct sample *sample, const char *settings))
{
    size_t seen = 0;
    for (const struct solver_stencil_builder *builder = solver_stencil_builders(); builder->name != NULL; builder++) {
        for (size_t i = builder->lattice_only ? 0 : GRADED; i < (builder->lattice_only ? LATTICES : CLOUDS); i++) {
            char settings[256];
            (void)snprintf(settings, sizeof settings, "stencil=%s %s %s", builder->name, clouds[i], terms);
            struct sample sample = start(scene, "%s", settings);
            look(&sample, settings);
            finish(&sample);
            seen++;
        }
    }
    CU_ASSERT(seen >= 2 * (CLOUDS - GRADED) + 2 * LATTICES);
}

static double mass(const struct sample *sample, const struct solver_output *output, size_t a)
{
    return output->V[a] * solver_run_density(sample->run, a);
}

/* What the dissipation adds to the rate of J, the same body's without it being taken away. */
static double *added_to_J(struct sample *sample, const char *scene, const char *settings)
{
    struct sample without = start(scene, "%s jst.kappa2=0 jst.kappa4=0", settings);
    size_t count = sample->run->cloud->count;
    double *added = malloc(count * sizeof *added);
    CU_ASSERT_PTR_NOT_NULL_FATAL(added);
    ulsph_copy(sample, &without);
    ulsph_evaluate(sample);
    ulsph_evaluate(&without);
    for (size_t a = 0; a < count; a++) {
        added[a] = ulsph_field(sample, "J").rate[a] - ulsph_field(&without, "J").rate[a];
    }
    finish(&without);
    return added;
}

static void scatter_J(struct sample *sample)
{
    for (size_t a = 0; a < sample->run->cloud->count; a++) {
        ulsph_field(sample, "J").value[a] = 1.0 + uniform(-0.1, 0.1);
    }
}

/* Forces between two particles are equal and opposite. */
static void look_at_momentum(struct sample *sample, const char *settings)
{
    ulsph_move_randomly(sample, 1.0);
    ulsph_evaluate(sample);
    struct solver_output output = output_of(sample);
    size_t lanes = sample->run->state.lanes;
    double sum[3] = {0}, size = 0.0;
    for (size_t a = 0; a < output.cloud->count; a++) {
        for (size_t i = 0; i < ulsph_dim(sample); i++) {
            double force = mass(sample, &output, a) * sample->run->state.v_rate[a * lanes + i];
            sum[i] += force;
            size += fabs(force);
        }
    }
    CU_ASSERT(size > 0.01);
    expect_below(settings, (fabs(sum[0]) + fabs(sum[1]) + fabs(sum[2])) / size, 1e-14);
}

static void test_momentum(void)
{
    each_body(material, "jst.kappa2=0.2 jst.kappa4=0.1", look_at_momentum);
    each_body(halves, "jst.kappa2=0.2 jst.kappa4=0.1", look_at_momentum);
}

/* J of each of two materials is moved about, and none crosses. */
static void look_at_volume(struct sample *sample, const char *settings)
{
    scatter_J(sample);
    double *added = added_to_J(sample, halves, settings);
    struct solver_output output = output_of(sample);
    double light = 0.0, heavy = 0.0, size = 0.0;
    for (size_t a = 0; a < output.cloud->count; a++) {
        double volume = output.V[a] * added[a];
        *(solver_run_density(sample->run, a) > 5.0 ? &heavy : &light) += volume;
        size += fabs(volume);
    }
    CU_ASSERT(size > 1e-3);
    expect_below(settings, (fabs(light) + fabs(heavy)) / size, 1e-13);
    free(added);
}

static void test_volume(void)
{
    each_body(halves, "jst.kappa2=0.2 jst.kappa4=0.1", look_at_volume);
}

/* A velocity that is linear in X has no Laplacian at any particle, wherever the boundary is. */
static void look_at_linear(struct sample *sample, const char *settings)
{
    double G[9], c[3], worst = 0.0;
    for (size_t k = 0; k < 9; k++) {
        G[k] = uniform(-1.0, 1.0);
        c[k % 3] = uniform(-1.0, 1.0);
    }
    ulsph_move(sample, G, c);
    ulsph_evaluate(sample);
    for (size_t k = 0; k < sample->run->cloud->count * sample->run->state.lanes; k++) {
        worst = fmax(worst, fabs(sample->run->state.v_rate[k]));
    }
    expect_below(settings, worst, 1e-11);
}

/* Nor has the biharmonic part a first moment: it turns no body that an affine motion has deformed. */
static void look_at_moment(struct sample *sample, const char *settings)
{
    ulsph_move_randomly(sample, 1.0);
    ulsph_evaluate(sample);
    struct solver_output output = output_of(sample);
    size_t dim = ulsph_dim(sample), lanes = sample->run->state.lanes;
    double moment[9] = {0}, size = 0.0;
    for (size_t a = 0; a < output.cloud->count; a++) {
        for (size_t k = 0; k < dim * dim; k++) {
            double arm = mass(sample, &output, a) * output.cloud->X[a * dim + k % dim];
            moment[k] += arm * sample->run->state.v_rate[a * lanes + k / dim];
            size += fabs(arm * sample->run->state.v_rate[a * lanes + k / dim]);
        }
    }
    CU_ASSERT(size > 0.01);
    expect_below(settings, largest_entry(dim * dim, moment) / size, 1e-13);
}

static void test_moment(void)
{
    each_body(material, "jst.kappa4=0.1", look_at_moment);
    each_body(halves, "jst.kappa4=0.1", look_at_moment);
}

static void test_linear(void)
{
    each_body(material, "jst.kappa4=0.1", look_at_linear);
    each_body(halves, "jst.kappa4=0.1", look_at_linear);
}

/* Work of the biharmonic part: sum V rho v . D4 = -kappa4 dx^3 sum V rho c |Lap v|^2, from what the scheme shows as rho
 * c Lap v; of J the same. */
static void look_at_work(struct sample *sample, const char *settings)
{
    struct solver_output output = output_of(sample);
    struct solver_material_constants constants = solver_material_constants(3, 0.3, 2);
    double dx3 = 0.1 * pow(output.cloud->spacing, 3.0);
    double work = 0.0, taken = 0.0, work_on_J = 0.0, taken_of_J = 0.0;
    size_t lanes = sample->run->state.lanes;
    ulsph_move_randomly(sample, 1.0);
    ulsph_evaluate(sample);
    for (size_t k = 0; k < output.cloud->count * lanes; k++) {
        double L = ulsph_field(sample, "Lap v").value[k];
        work += mass(sample, &output, k / lanes) * sample->run->state.v[k] * sample->run->state.v_rate[k];
        taken += dx3 * output.V[k / lanes] * L * L / constants.zp;
    }
    scatter_J(sample);
    double *added = added_to_J(sample, material, settings);
    for (size_t a = 0; a < output.cloud->count; a++) {
        double L = ulsph_field(sample, "Lap J").value[a];
        work_on_J += output.V[a] * ulsph_field(sample, "J").value[a] * added[a];
        taken_of_J += dx3 * output.V[a] * L * L / constants.cp;
    }
    free(added);
    CU_ASSERT(taken > 0.01 && taken_of_J > 1e-5);
    expect_below(settings, fabs(work + taken) / taken, 1e-12);
    expect_below(settings, fabs(work_on_J + taken_of_J) / taken_of_J, 1e-11);
}

static void test_work(void)
{
    each_body(material, "jst.kappa4=0.1", look_at_work);
}

/* The middle of a lattice where v_x = f(X). */
struct middle {
    double rate, laplacian, h; /* of v_x */
};

static struct middle look_at_middle(const char *settings, double (*f)(const double *X, size_t dim))
{
    struct sample sample = start(material, "%s", settings);
    const struct solver_cloud *cloud = sample.run->cloud;
    size_t dim = ulsph_dim(&sample), lanes = sample.run->state.lanes, middle = 0;
    for (size_t a = 0; a < cloud->count; a++) {
        double off = 0.0;
        for (size_t i = 0; i < dim; i++) {
            off = fmax(off, fabs(cloud->X[a * dim + i] - 0.5));
        }
        middle = off < 1e-9 ? a : middle;
        sample.run->state.v[a * lanes] = f(cloud->X + a * dim, dim);
    }
    ulsph_evaluate(&sample);
    struct middle found = {.rate = sample.run->state.v_rate[middle * lanes],
                           .laplacian = ulsph_field(&sample, "Lap v").value[middle * lanes],
                           .h = cloud->spacing};
    finish(&sample);
    return found;
}

/* What is added there to the rate of J where J = 1 + f(X) / 100, over that hundredth. */
static double added_in_middle(const char *settings, double (*f)(const double *X, size_t dim))
{
    struct sample sample = start(material, "%s", settings);
    const struct solver_cloud *cloud = sample.run->cloud;
    size_t dim = ulsph_dim(&sample), middle = 0;
    for (size_t a = 0; a < cloud->count; a++) {
        double off = 0.0;
        for (size_t i = 0; i < dim; i++) {
            off = fmax(off, fabs(cloud->X[a * dim + i] - 0.5));
        }
        middle = off < 1e-9 ? a : middle;
        ulsph_field(&sample, "J").value[a] = 1.0 + 0.01 * f(cloud->X + a * dim, dim);
    }
    double *added = added_to_J(&sample, material, settings), rate = added[middle] / 0.01;
    free(added);
    finish(&sample);
    return rate;
}

static double square(const double *X, size_t dim)
{
    double sum = 0.0;
    for (size_t i = 0; i < dim; i++) {
        sum += X[i] * X[i];
    }
    return sum;
}

static double quartic(const double *X, size_t dim)
{
    double sum = 0.0;
    for (size_t i = 0; i < dim; i++) {
        sum += pow(X[i], 4.0);
    }
    return sum;
}

/* Eq. 3.13 inside a lattice, of v and of J: Lap |X|^2 = 2 dim with any stencil, and Lap Lap sum X_i^4 = 24 dim by
 * nearest neighbours.
 */
static void test_printed(void)
{
    struct solver_material_constants constants = solver_material_constants(3, 0.3, 2);
    for (size_t dim = 1; dim <= 3; dim++) {
        for (const struct solver_stencil_builder *builder = solver_stencil_builders(); builder->name; builder++) {
            char settings[128];
            double d = (double)dim;
            (void)snprintf(settings, sizeof settings, "stencil=%s dim=%zu n=%d support=%s jst.kappa2=0.3 jst.kappa4=0",
                           builder->name, dim, dim == 3 ? 8 : 12, dim == 1 ? "3" : "2");
            struct middle middle = look_at_middle(settings, square);
            CU_ASSERT_DOUBLE_EQUAL(middle.laplacian / (2.0 * d * constants.zp), 1.0, 1e-9);
            if (builder->lattice_only) {
                (void)snprintf(settings, sizeof settings, "stencil=%s dim=%zu n=16 jst.kappa2=0.3 jst.kappa4=0",
                               builder->name, dim);
                middle = look_at_middle(settings, square);
                double harmonic = 0.3 * constants.cp * middle.h * 2.0 * d;
                CU_ASSERT_DOUBLE_EQUAL(middle.rate / harmonic, 1.0, 1e-9);
                CU_ASSERT_DOUBLE_EQUAL(added_in_middle(settings, square) / harmonic, 1.0, 1e-9);
                (void)snprintf(settings, sizeof settings, "stencil=%s dim=%zu n=16 jst.kappa4=0.3", builder->name, dim);
                middle = look_at_middle(settings, quartic);
                double biharmonic = -0.3 * constants.cp * pow(middle.h, 3.0) * 24.0 * d;
                CU_ASSERT_DOUBLE_EQUAL(middle.rate / biharmonic, 1.0, 1e-9);
                CU_ASSERT_DOUBLE_EQUAL(added_in_middle(settings, quartic) / biharmonic, 1.0, 1e-8);
            }
        }
    }
}

/* The fastest decay, by power iteration: on a lattice at most 16 dim^2 kappa4 c / h, that of the shortest wave, and
 * with displaced particles up to a tenth more; an integrator that is stable for decays of up to r / step takes a CFL
 * number of r / (16 dim^2 kappa4). */
static void test_fastest(void)
{
    static const char *const bodies[] = {"dim=1 n=12 stencil=sbp2",
                                         "dim=1 n=12 stencil=sbp2 grading.X=10",
                                         "dim=2 n=12 stencil=sbp4 grading.X=10 grading.Y=3 grading.fine_Y=both",
                                         "dim=2 n=12 stencil=sbp2",
                                         "dim=3 n=6 stencil=sbp2",
                                         "dim=2 n=12 stencil=sbp4",
                                         "dim=2 n=8 stencil=closed support=2.1",
                                         "dim=2 n=8 stencil=closed support=2.1 perturb=0.15",
                                         "dim=2 n=8 stencil=sph support=2"};
    double c = solver_material_constants(3, 0.3, 2).cp;
    for (size_t i = 0; i < sizeof bodies / sizeof *bodies; i++) {
        struct sample sample = start(material, "%s jst.kappa4=1", bodies[i]);
        size_t size = sample.run->cloud->count * sample.run->state.lanes;
        double decay = 0.0;
        ulsph_move_randomly(&sample, 1.0);
        for (int pass = 0; pass < 200; pass++) {
            ulsph_evaluate(&sample);
            decay = 0.0;
            for (size_t k = 0; k < size; k++) {
                decay = fmax(decay, fabs(sample.run->state.v_rate[k]));
            }
            for (size_t k = 0; k < size; k++) {
                sample.run->state.v[k] = sample.run->state.v_rate[k] / decay;
            }
        }
        double dim = (double)ulsph_dim(&sample);
        double share = decay * solver_cloud_finest(sample.run->cloud) / c / (16.0 * dim * dim);
        printf("\n    %s: fastest decay %.3f of 16 dim^2 kappa4 c / h", bodies[i], share);
        CU_ASSERT(share > 0.2 && share < 1.1);
        finish(&sample);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"pairs exchange momentum", test_momentum},
        {"no volume crosses between materials", test_volume},
        {"a linear velocity is left alone", test_linear},
        {"it has no first moment", test_moment},
        {"its work is the Laplacian's square", test_work},
        {"inside a lattice it is what is printed", test_printed},
        {"the fastest decay", test_fastest},
    };
    return unit_main("JST dissipation", tests, sizeof tests / sizeof *tests);
}
