/* The same bytes for any number of threads. */
#include "tests/unit/runs.h"

#include "solver/scheme.h"
#include "solver/stencil.h"

#include <limits.h>
#include <omp.h>

/* Everything a run shows, one array after another. */
struct bytes {
    size_t size;
    unsigned char *value;
};

static void append(struct bytes *bytes, const void *from, size_t size)
{
    if (size == 0) {
        return;
    }
    unsigned char *value = realloc(bytes->value, bytes->size + size);
    CU_ASSERT_PTR_NOT_NULL_FATAL(value);
    memcpy(value + bytes->size, from, size);
    bytes->value = value;
    bytes->size += size;
}

static struct bytes bytes_of(struct sample *sample)
{
    struct bytes bytes = {.size = 0};
    struct solver_output output = output_of(sample);
    const struct solver_history *history = solver_run_history(sample->run);
    size_t count = output.cloud->count;
    size_t dim = (size_t)output.cloud->dim;
    const double *vectors[] = {output.cloud->X, output.u, output.v, output.p};
    const double *tensors[] = {output.F, output.H, output.P,
                               output.sigma}; /* the first three where the scheme has them */
    const double *scalars[] = {output.V, output.J, output.pressure, output.von_mises};
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++) {
        append(&bytes, vectors[i], count * dim * sizeof(double));
    }
    for (size_t i = 0; i < sizeof tensors / sizeof *tensors; i++) {
        append(&bytes, tensors[i], tensors[i] != NULL ? count * dim * dim * sizeof(double) : 0);
    }
    for (size_t i = 0; i < sizeof scalars / sizeof *scalars; i++) {
        append(&bytes, scalars[i], count * sizeof(double));
    }
    append(&bytes, &output.time, sizeof output.time);
    append(&bytes, history->totals, history->count * sizeof *history->totals);
    append(&bytes, history->probe_u, history->count * history->probe_count * 3 * sizeof(double));
    append(&bytes, history->probe_v, history->count * history->probe_count * 3 * sizeof(double));
    return bytes;
}

static const char scene[] =
    "probes = { { name = 'middle', X = each(0.5) } }\n"
    "body_force = function(X, Y, Z, t) return first(0.1 * X, 0.2 * t, -0.1) end\n"
    "faces = { X0 = 'symmetric', X1 = { kind = 'traction', value = function(X, Y, Z, t) return first(0.1, Y, Z) end } "
    "}\n"
    "initial = { velocity = function(X, Y, Z)\n"
    "    return first(0.05 * sin(2 * X + Y), 0.04 * cos(3 * Y - X + Z), 0.05 * sin(2 * Z + X)) end }\n";

static struct bytes result(const char *settings, size_t dim, int threads)
{
    static const int n[] = {600, 24, 8}; /* three pieces of 256 particles, none of them full */
    struct sample sample = start(scene, "dim=%zu n=%d threads=%d %s", dim, n[dim - 1], threads, settings);
    struct solver_facts facts = solver_run_facts(sample.run);
    CU_ASSERT(facts.particles > 2 * 256);
    CU_ASSERT_EQUAL(facts.threads, threads);
    /* three steps, by run_to, so that the history is there; the material stiffens as it deforms, hence a little less */
    advance_to(&sample, 2.9 * sample.scene->cfl * facts.spacing / wave_speed(&sample));
    CU_ASSERT(solver_run_facts(sample.run).steps >= 3);
    struct bytes bytes = bytes_of(&sample);
    finish(&sample);
    return bytes;
}

static bool same(const struct bytes *left, const struct bytes *right)
{
    return left->size == right->size && memcmp(left->value, right->value, left->size) == 0;
}

static void compare_threads(const char *settings, size_t dim)
{
    struct bytes alone = result(settings, dim, 1);
    for (int threads = 2; threads <= 4; threads += 2) {
        struct bytes together = result(settings, dim, threads);
        if (!same(&alone, &together)) {
            printf("\n    %d threads give other bytes than one: %zud %s", threads, dim, settings);
        }
        CU_ASSERT(same(&alone, &together));
        free(together.value);
    }
    free(alone.value);
}

static void test_every_stencil_and_set(void)
{
    static const char *const evolved[] = {"pF", "pFJ", "pFHJ"};
    for (const struct solver_stencil_builder *builder = solver_stencil_builders(); builder->name != NULL; builder++) {
        for (size_t e = 0; e < 3; e++) {
            for (size_t dim = 1; dim <= 3; dim++) {
                char settings[128];
                (void)snprintf(settings, sizeof settings, "stencil=%s evolved=%s", builder->name, evolved[e]);
                compare_threads(settings, dim);
            }
        }
    }
}

static void test_every_scheme(void)
{
    for (const struct solver_scheme *const *scheme = solver_schemes(); *scheme != NULL; scheme++) {
        for (size_t dim = 1; dim <= 3; dim++) {
            char settings[128];
            (void)snprintf(settings, sizeof settings, "scheme=%s material.model=linear-elastic integrator=euler",
                           (*scheme)->name);
            compare_threads(settings, dim);
        }
    }
}

static void test_other_choices(void)
{
    static const char *const settings[] = {
        "stencil=closed evolved=pFHJ reconstruction=least-squares integrator=rk4",
        "stencil=sph evolved=pFJ reconstruction=least-squares integrator=ssp-rk3",
        "stencil=sbp4 evolved=pFJ reconstruction=none material.model=linear-elastic",
        "stencil=sbp2 evolved=pFHJ volume_flux=stress material.model=linear-elastic integrator=rk4",
        "scheme=ulsph material.model=linear-elastic ulsph.dissipation=viscosity ulsph.tension=stress integrator=rk4",
        "stencil=closed evolved=pFHJ precision=single integrator=rk4",
        "stencil=sbp2 evolved=pF precision=single material.model=linear-elastic",
    };
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        for (size_t dim = 1; dim <= 3; dim++) {
            compare_threads(settings[i], dim);
        }
    }
    for (size_t dim = 2; dim <= 3; dim++) {
        compare_threads("stencil=sbp2 angular_momentum=projected integrator=rk4", dim);
        compare_threads("stencil=sbp2 angular_momentum=projected integrator=tvd-rk2", dim);
    }
    compare_threads("stencil=closed perturb=0.15 support=2.1 evolved=pFJ", 2);
    compare_threads("stencil=closed perturb=0.15 support=2.1 evolved=pFHJ", 3);
    compare_threads("stencil=sph perturb=0.15 support=2.1 evolved=pFHJ", 3);
}

/* The comparison sees one bit in any of the arrays. */
static void test_comparison_sees(void)
{
    struct bytes one = result("stencil=sbp2 evolved=pFHJ", 3, 1);
    struct bytes other = result("stencil=sbp2 evolved=pFHJ", 3, 1);
    CU_ASSERT_FATAL(same(&one, &other));
    for (size_t at = 0; at < one.size; at += 997) {
        other.value[at] ^= 1;
        CU_ASSERT_FALSE(same(&one, &other));
        other.value[at] ^= 1;
    }
    struct bytes changed = result("stencil=sbp2 evolved=pFHJ material.nu=0.30000000000000004", 3, 1);
    CU_ASSERT_FALSE(same(&one, &changed));
    free(one.value);
    free(other.value);
    free(changed.value);
}

/* What a scene asks for it gets; left to itself, a run on a line takes a thread for each 32768
 * particles, at most one per core. */
static void test_number(void)
{
    static const struct {
        int n, asked, worth;
    } lines[] = {{500, 0, 1}, {500, 3, 3}, {40000, 0, 1}, {70000, 0, 2}, {400000, 0, 12}};
    CU_ASSERT_EQUAL(unsetenv("OMP_NUM_THREADS"), 0);
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        struct sample sample = start("", "dim=1 n=%d threads=%d", lines[i].n, lines[i].asked);
        int cores = omp_get_num_procs();
        int expected = lines[i].asked == 0 && lines[i].worth > cores ? cores : lines[i].worth;
        CU_ASSERT_EQUAL(solver_run_facts(sample.run).threads, expected);
        finish(&sample);
    }
}

/* OMP_NUM_THREADS is the most that a run left to itself takes; what is no number says nothing. */
static void test_environment(void)
{
    static const struct {
        const char *value;
        int asked, most;
    } table[] = {{"1", 0, 1},          {"1,4", 0, 1},    {"1", 3, 3}, {"100000", 0, INT_MAX},
                 {"many", 0, INT_MAX}, {"0", 0, INT_MAX}};
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        int cores = omp_get_num_procs(), worth = 2;
        CU_ASSERT_EQUAL(setenv("OMP_NUM_THREADS", table[i].value, 1), 0);
        struct sample sample = start("", "dim=1 n=70000 threads=%d", table[i].asked);
        int expected = worth < cores ? worth : cores;
        expected = table[i].asked > 0 ? table[i].asked : expected < table[i].most ? expected : table[i].most;
        CU_ASSERT_EQUAL(solver_run_facts(sample.run).threads, expected);
        finish(&sample);
    }
    CU_ASSERT_EQUAL(unsetenv("OMP_NUM_THREADS"), 0);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"every stencil, evolved set and dimension", test_every_stencil_and_set},
        {"every scheme and dimension", test_every_scheme},
        {"reconstructions, fluxes, integrators, perturbed clouds", test_other_choices},
        {"the comparison sees one bit", test_comparison_sees},
        {"number of threads", test_number},
        {"OMP_NUM_THREADS", test_environment},
    };
    return unit_main("run on threads", tests, sizeof tests / sizeof *tests);
}
