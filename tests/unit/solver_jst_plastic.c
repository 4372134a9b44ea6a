/* kappa4 that depends on plastic strain (004_0c0448173ed5e9bd.txt, eq. 4.2): its values, what it conserves and takes
 * away, what it costs, and where it is refused. */
#include "tests/unit/ulsph_states.h"

#include "solver/stencil.h"

static const char metal[] =
    "material = { model = 'hencky', E = 3, nu = 0.3, rho = 2, yield_stress = 0.01, hardening = 0.1 }\n"
    "scheme = 'jst'\n";
#define PRINTED "jst.kappa4=0.015625 jst.kappa4_plastic=0.000244140625 "

/* The formula as printed. */
static double printed(double strain)
{
    return strain <= 0.5 ? 1.0 / 64 - 2.0 * (1.0 / 64 - 1.0 / 4096) * strain : 1.0 / 4096;
}

/* A body at rest and without stress, whose particles have flown by up to 1, with a random velocity. */
static struct sample flown(const char *settings)
{
    struct sample sample = start(metal, "%s", settings);
    struct ulsph_field memory = ulsph_field(&sample, "plastic flow at the start"); /* from which a stage sets out */
    for (size_t a = 0; a < sample.run->cloud->count; a++) {
        memory.value[a * memory.width] = a % 5 == 0 ? 0.0 : a % 5 == 1 ? 0.5 : uniform(0.0, 1.0);
    }
    return sample;
}

static void each_body(void (*look)(struct sample *sample, const char *settings))
{
    static const char *const clouds[] = {"dim=1 n=12 support=3", "dim=2 n=8 support=2.1", "dim=3 n=5 support=2.1",
                                         "dim=2 n=6 support=2.1 perturb=0.15"};
    size_t seen = 0;
    for (const struct solver_stencil_builder *builder = solver_stencil_builders(); builder->name != NULL; builder++) {
        for (size_t i = 0; i < (builder->lattice_only ? 3 : 4); i++) {
            char settings[256];
            (void)snprintf(settings, sizeof settings, "stencil=%s %s " PRINTED, builder->name, clouds[i]);
            if (strcmp(builder->name, "sbp4") == 0 && i == 2) {
                continue; /* needs more layers */
            }
            struct sample sample = flown(settings);
            ulsph_move_randomly(&sample, 1.0);
            ulsph_evaluate(&sample);
            look(&sample, settings);
            finish(&sample);
            seen++;
        }
    }
    CU_ASSERT(seen > 10);
}

/* Each particle's Laplacian is that of the same body with kappa4 = 1 throughout, times the printed value. */
static void look_at_values(struct sample *sample, const char *settings)
{
    char whole[256];
    (void)snprintf(whole, sizeof whole, "%.*s jst.kappa4=1", (int)(strstr(settings, "jst.") - settings), settings);
    struct sample plain = start(metal, "%s", whole);
    struct ulsph_field memory = ulsph_field(sample, "plastic flow"), shown = ulsph_field(sample, "Lap v"),
                       bare = ulsph_field(&plain, "Lap v");
    ulsph_copy(sample, &plain);
    ulsph_evaluate(&plain);
    double wrong = 0.0, size = 0.0;
    for (size_t k = 0; k < sample->run->cloud->count * shown.width; k++) {
        double kappa4 = printed(memory.value[k / shown.width * memory.width]);
        wrong = fmax(wrong, fabs(shown.value[k] - kappa4 * bare.value[k]));
        size = fmax(size, fabs(bare.value[k]));
    }
    CU_ASSERT(size > 0.0 && memory.value[memory.width] == 0.5);
    expect_below(settings, wrong / size, 1e-16);
    CU_ASSERT_EQUAL(solver_run_facts(sample->run).bytes_per_particle, solver_run_facts(plain.run).bytes_per_particle);
    finish(&plain);
}

static void test_values(void)
{
    each_body(look_at_values);
}

/* Pairs exchange momentum, and what is taken away is c dx^3 sum kappa4 V |Lap v|^2 / rho. */
static void look_at_exchange(struct sample *sample, const char *settings)
{
    struct solver_output output = output_of(sample);
    struct solver_material_constants constants = solver_material_constants(3, 0.3, 2);
    struct ulsph_field memory = ulsph_field(sample, "plastic flow"), laplacian = ulsph_field(sample, "Lap v");
    size_t lanes = sample->run->state.lanes;
    double dx3 = pow(output.cloud->spacing, 3.0), work = 0.0, taken = 0.0, size = 0.0, sum[4] = {0};
    for (size_t k = 0; k < output.cloud->count * lanes; k++) {
        double mass = 2.0 * output.V[k / lanes], L = laplacian.value[k];
        double force = mass * sample->run->state.v_rate[k];
        work += force * sample->run->state.v[k];
        taken += dx3 * output.V[k / lanes] * L * L / constants.zp / printed(memory.value[k / lanes * memory.width]);
        sum[k % lanes] += force;
        size += fabs(force);
    }
    CU_ASSERT(taken > 1e-4);
    expect_below(settings, fabs(work + taken) / taken, 1e-12);
    expect_below(settings, (fabs(sum[0]) + fabs(sum[1]) + fabs(sum[2])) / size, 1e-14);
}

static void test_exchange(void)
{
    each_body(look_at_exchange);
}

/* The strain from which it is constant is a key; kappa4 may grow too. */
static void test_keys(void)
{
    struct sample sample = start(metal, "dim=2 jst.kappa4=0.1 jst.kappa4_plastic=0.3 jst.plastic_at=2");
    CU_ASSERT(sample.scene->jst.fades && sample.scene->jst.plastic_at == 2.0);
    finish(&sample);
    sample = start(metal, "dim=2 jst.kappa4_plastic=0");
    CU_ASSERT(sample.scene->jst.fades && sample.scene->jst.plastic_at == 0.5);
    finish(&sample);
    sample = start(metal, "dim=2");
    CU_ASSERT(!sample.scene->jst.fades);
    finish(&sample);
}

static void test_refusals(void)
{
    expect_refused(metal, "jst.plastic_at: belongs to jst.kappa4_plastic", "dim=2 jst.plastic_at=0.5");
    expect_refused(metal, "jst.kappa4_plastic: expected number in [0, 10]", "dim=2 jst.kappa4_plastic=-1");
    expect_refused(metal, "jst.plastic_at: expected number > 0", "dim=2 jst.kappa4_plastic=0 jst.plastic_at=0");
    expect_refused(metal, "jst.kappa4_plastic: the material does not flow",
                   "dim=2 jst.kappa4_plastic=0 material.yield_stress=0 material.hardening=0");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"each particle has the printed value", test_values},
        {"momentum stays, energy falls", test_exchange},
        {"keys", test_keys},
        {"refusals", test_refusals},
    };
    return unit_main("JST and plastic strain", tests, sizeof tests / sizeof *tests);
}
