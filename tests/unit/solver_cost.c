/* What a run declares to keep against what it has allocated, and the order in which what a scene asks for costs. The
 * linker puts the functions __wrap_ in front of the allocator's (tests/cost.cmake). */
#include "solver/integrator.h"
#include "solver/memory.h"
#include "solver/scene_internal.h"
#include "tests/unit/runs.h"

#include <stdint.h>

/* --- the allocator, watched --- */

enum { SLOTS = 1 << 16 };
static struct {
    uintptr_t place;
    size_t bytes;
} slot[SLOTS];
static size_t live; /* bytes asked for and not released */

static size_t find(uintptr_t place)
{
    size_t at = (place >> 4) % SLOTS;
    while (slot[at].place != place && slot[at].place != 0) {
        at = (at + 1) % SLOTS;
    }
    return at;
}

static void take(void *place, size_t bytes)
{
    if (place != NULL) {
        size_t at = find((uintptr_t)place);
        slot[at].place = (uintptr_t)place;
        slot[at].bytes = bytes;
        live += bytes;
    }
}

/* Those behind it that were kept from its slot move up. */
static void give(const void *place)
{
    size_t at = find((uintptr_t)place);
    if (place == NULL || slot[at].place == 0) {
        return;
    }
    live -= slot[at].bytes;
    for (size_t next = (at + 1) % SLOTS; slot[next].place != 0; next = (next + 1) % SLOTS) {
        size_t home = (slot[next].place >> 4) % SLOTS;
        if ((next + SLOTS - home) % SLOTS >= (next + SLOTS - at) % SLOTS) {
            slot[at] = slot[next];
            at = next;
        }
    }
    slot[at].place = 0;
}

/* The names are the linker's. */
// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
void *__real_aligned_alloc(size_t alignment, size_t bytes);
void *__real_malloc(size_t bytes);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t bytes);
void __real_free(void *place);
void *__wrap_aligned_alloc(size_t alignment, size_t bytes);
void *__wrap_malloc(size_t bytes);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t bytes);
void __wrap_free(void *place);

void *__wrap_aligned_alloc(size_t alignment, size_t bytes)
{
    void *place = __real_aligned_alloc(alignment, bytes);
    take(place, bytes);
    return place;
}

void *__wrap_malloc(size_t bytes)
{
    void *place = __real_malloc(bytes);
    take(place, bytes);
    return place;
}

void *__wrap_calloc(size_t count, size_t size)
{
    void *place = __real_calloc(count, size);
    take(place, count * size);
    return place;
}

void *__wrap_realloc(void *old, size_t bytes)
{
    give(old);
    void *place = __real_realloc(old, bytes);
    take(place, bytes);
    return place;
}

void __wrap_free(void *place)
{
    give(place);
    __real_free(place);
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

/* --- memory --- */

static struct solver_cost_arrays arrays;
static struct solver_cost_terms terms;

static void expect_whole(const char *what, const char *words, const struct sample *sample, size_t before,
                         size_t formulas)
{
    solver_run_cost(sample->run, &arrays, &terms);
    size_t declared = solver_cost_total(&arrays);
    size_t found = live - before - (sample->scene->lua->bytes - formulas); /* less what formulas hold */
    if (declared != found || arrays.count == SOLVER_COST_ARRAYS) {
        printf("\n    %s, %s: %zu bytes declared, %zu allocated", words, what, declared, found);
    }
    CU_ASSERT_EQUAL(declared, found);
    CU_ASSERT(arrays.count < SOLVER_COST_ARRAYS);
}

/* When it is built, after steps, after its history has grown and after it was shown. */
static void expect_memory(const char *more, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void expect_memory(const char *more, const char *format, ...)
{
    va_list arguments;
    char words[256];
    va_start(arguments, format);
    (void)vsnprintf(words, sizeof words, format, arguments);
    va_start(arguments, format);
    struct sample sample = load_scene(more, format, arguments);
    va_end(arguments);
    size_t before = live;
    size_t formulas = sample.scene->lua->bytes;
    bool built = solver_run_create(sample.scene, &sample.run, &sample.error);
    if (!built) {
        printf("\n    %s: %s", words, sample.error.text);
    }
    CU_ASSERT_FATAL(built);
    expect_whole("built", words, &sample, before, formulas);
    advance(&sample, 3);
    expect_whole("after steps", words, &sample, before, formulas);
    advance_to(&sample, 2.0 * solver_run_facts(sample.run).step * 3.0);
    (void)output_of(&sample);
    expect_whole("shown", words, &sample, before, formulas);
    solver_run_free(sample.run);
    CU_ASSERT_EQUAL(live - before, sample.scene->lua->bytes - formulas);
    solver_scene_free(sample.scene);
}

static const char metal[] =
    "initial = { velocity = function(X, Y, Z) return first(0.05 * sin(2 * X + Y), 0.04 * cos(3 * Y - X), 0) end }\n"
    "material = { model = 'hencky', E = 3, nu = 0.3, rho = 2, yield_stress = 0.01, hardening = 0.1 }\n";

static const char composite[] =
    "initial = { velocity = function(X, Y, Z) return first(0.05 * sin(2 * X), 0.04 * cos(3 * Y), 0) end }\n"
    "body_force = function(X) return first(0.1, 0, 0) end\n"
    "probes = { { name = 'p', X = each(0.5) } }\n"
    "faces = { X0 = 'clamped', X1 = { kind = 'traction', value = function() return first(0.1, 0, 0) end } }\n"
    "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2,\n"
    "             at = function(X) return 3, 0.3, X < 0.5 and 2 or 3 end }\n";

static const char walled[] = "initial = { velocity = function() return first(-1e-3, 0, 0) end }\n"
                             "rigid_wall = { point = each(0), normal = { first(1, 0, 0) } }\n";

/* Two bodies that drift apart. */
#define TWO                                                                                                            \
    "-- domain = two bodies\n"                                                                                         \
    "bodies = { { shape = 'box', lower = each(0), upper = each(1) },\n"                                                \
    "           { shape = 'box', lower = { first(1, 0, 0) }, upper = { first(2, 1, 1) } } }\n"                         \
    "reference_length, lattice = 1, 'centres'\n"                                                                       \
    "initial = { velocity = function(X) return first(X > 1 and 1e-3 or 0, 0, 0) end }\n"
static const char touching[] = TWO "contact = { law = 'predicted' }\n";
static const char apart[] = TWO;

static const char quarter[] = "domain = { shape = 'disc', centre = {0, 0}, radius = 1, symmetry = { X = 0, Y = 0 } }\n"
                              "initial = { velocity = function(X, Y) return 0.01 * X, 0.01 * Y end }\n";
/* A disc of a lattice, and what its cloud is worth. */
static const char cut[] = "domain = { shape = 'solid', lower = {-1.25, -1.25}, upper = {1.25, 1.25},\n"
                          "           distance = function(X, Y) return math.sqrt(X * X + Y * Y) - 1 end }\n"
                          "reference_length = 1\n"
                          "initial = { velocity = function(X, Y) return 0.01 * X, 0.01 * Y end }\n";
static const char cut_quarter[] =
    "domain = { shape = 'solid', lower = {-1.25, -1.25}, upper = {1.25, 1.25}, symmetry = { X = 0, Y = 0 },\n"
    "           distance = function(X, Y) return math.sqrt(X * X + Y * Y) - 1 end }\n"
    "reference_length = 1\n"
    "initial = { velocity = function(X, Y) return 0.01 * X, 0.01 * Y end }\n";
/* Between two walls, the lower one with a corner. */
static const char die[] = "initial = { velocity = function(X, Y) return -1e-3, 0 end }\n"
                          "die = { { path = { {-2, -0.5}, {-0.1, -0.5}, {3, -1} }, fillets = {0.1} },\n"
                          "        { path = { {3, 2}, {-2, 2} } } }\n";

static void memory_of_what_few_scenes_ask_for(void)
{
    static const char *const solvers[] = {"poisson", "pseudo-time incompressible.tolerance=1e-4"};
    static const char *const sets[] = {"pFJ", "pFHJ"};
    for (int dim = 1; dim <= 3; dim++) {
        for (size_t i = 0; i < 2; i++) {
            expect_memory(smooth_motion, "dim=%d evolved=%s material.nu=0.5 incompressible.solver=%s", dim, sets[i],
                          solvers[0]);
            expect_memory(smooth_motion, "dim=%d material.nu=0.49 incompressible.solver=%s", dim, solvers[i]);
            expect_memory(
                smooth_motion,
                "dim=%d material.nu=0.5 reconstruction=none incompressible.restore=0 incompressible.solver=%s", dim,
                solvers[i]);
            expect_memory(smooth_motion, "dim=%d evolved=%s balance=true", dim, sets[i]);
        }
        expect_memory(walled, "dim=%d balance=true", dim);
        expect_memory(metal, "dim=%d scheme=jst jst.kappa4_plastic=0 jst.plastic_at=0.1", dim);
    }
    static const char *const shapes[] = {quarter, cut, cut_quarter};
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        expect_memory(shapes[i], "dim=2 n=8 stencil=closed support=2.2 integrator=rk4");
        expect_memory(shapes[i], "dim=2 n=8 stencil=closed support=2.2 integrator=rk4 scheme=jst evolved=pF");
    }
    expect_memory(quarter, "dim=2 n=8 stencil=closed support=2.2 reconstruction=least-squares");
    expect_memory(quarter, "dim=2 n=8 stencil=closed support=2.2 balance=true");
    expect_memory(die, "dim=2");
    expect_memory(die, "dim=2 balance=true scheme=jst");
}

static void memory_is_as_declared(void)
{
    static const char *const schemes[] = {"scheme=upwind", "scheme=jst", "scheme=jst jst.kappa2=0.5"};
    static const char *const sets[] = {"pF", "pFJ", "pFHJ"};
    for (int dim = 1; dim <= 3; dim++) {
        for (size_t s = 0; s < sizeof schemes / sizeof *schemes; s++) {
            for (size_t e = 0; e < sizeof sets / sizeof *sets; e++) {
                expect_memory(smooth_motion, "dim=%d %s evolved=%s", dim, schemes[s], sets[e]);
                expect_memory(smooth_motion, "dim=%d %s evolved=%s material.model=linear-elastic integrator=rk4", dim,
                              schemes[s], sets[e]);
                expect_memory(smooth_motion, "dim=%d %s evolved=%s stencil=sph reconstruction=least-squares", dim,
                              schemes[s], sets[e]);
                expect_memory(metal, "dim=%d %s evolved=%s", dim, schemes[s], sets[e]);
                expect_memory(composite, "dim=%d %s evolved=%s", dim, schemes[s], sets[e]);
            }
        }
        expect_memory(smooth_motion, "dim=%d volume_flux=stress", dim);
        expect_memory(smooth_motion, "dim=%d stencil=closed", dim);
        expect_memory(smooth_motion, "dim=%d stencil=sbp4 n=8", dim);
        expect_memory(smooth_motion, "dim=%d stencil=sbp2 n=9", dim); /* rows are kept once */
        expect_memory(smooth_motion, "dim=%d stencil=sbp2 n=9 grading.X=10", dim);
        expect_memory(smooth_motion, "dim=%d stencil=sbp2 n=9 precision=mixed", dim);
        expect_memory(smooth_motion, "dim=%d precision=single", dim);
        expect_memory(smooth_motion, "dim=%d precision=single evolved=pFJ integrator=rk4", dim);
        expect_memory(composite, "dim=%d precision=single evolved=pF reconstruction=least-squares", dim);
        expect_memory(walled, "dim=%d", dim);
        expect_memory(touching, "dim=%d stencil=sph", dim);
        expect_memory(apart, "dim=%d stencil=sph", dim);
        expect_memory(touching, "dim=%d scheme=ulsph material.model=linear-elastic", dim);
        expect_memory(smooth_motion, "dim=%d scheme=ulsph material.model=linear-elastic ulsph.xsph=0.5", dim);
        expect_memory(smooth_motion,
                      "dim=%d scheme=ulsph material.model=linear-elastic ulsph.tension=none lattice=centres", dim);
    }
    expect_memory(smooth_motion, "dim=2 angular_momentum=projected");
    expect_memory(smooth_motion, "dim=3 angular_momentum=projected");
}

/* --- order --- */

struct cost {
    double flops, bytes; /* per particle and step, per particle */
};

static struct cost cost_of(const char *more, const char *words)
{
    struct sample sample = start(more, "%s", words);
    double particles = (double)solver_run_facts(sample.run).particles;
    int stages = solver_integrator_find(sample.scene->integrator)->stages;
    solver_run_cost(sample.run, &arrays, &terms);
    struct cost cost = {solver_cost_flops(&terms, stages) / particles, (double)solver_cost_total(&arrays) / particles};
    finish(&sample);
    return cost;
}

static void expect_order(const char *what, struct cost less, struct cost more)
{
    if (!(less.flops < more.flops && less.bytes < more.bytes)) {
        printf("\n    %s: %.1f and %.1f flop, %.1f and %.1f bytes", what, less.flops, more.flops, less.bytes,
               more.bytes);
    }
    CU_ASSERT(less.flops < more.flops);
    CU_ASSERT(less.bytes < more.bytes);
}

static void what_is_asked_for_costs(void)
{
    static const char *const schemes[] = {"scheme=upwind", "scheme=jst"};
    char words[2][160];
    for (size_t s = 0; s < 2; s++) {
        for (int dim = 2; dim <= 3; dim++) { /* on a line H is 1 */
            (void)snprintf(words[0], sizeof words[0], "dim=%d %s evolved=pF", dim, schemes[s]);
            (void)snprintf(words[1], sizeof words[1], "dim=%d %s evolved=pFJ", dim, schemes[s]);
            expect_order("{p,F} < {p,F,J}", cost_of(smooth_motion, words[0]), cost_of(smooth_motion, words[1]));
        }
        (void)snprintf(words[0], sizeof words[0], "%s evolved=pFJ", schemes[s]);
        (void)snprintf(words[1], sizeof words[1], "%s evolved=pFHJ", schemes[s]);
        expect_order("{p,F,J} < {p,F,H,J}", cost_of(smooth_motion, words[0]), cost_of(smooth_motion, words[1]));
        (void)snprintf(words[0], sizeof words[0], "%s material.yield_stress=0 material.hardening=0", schemes[s]);
        (void)snprintf(words[1], sizeof words[1], "%s", schemes[s]);
        expect_order("elastic < plastic", cost_of(metal, words[0]), cost_of(metal, words[1]));
        (void)snprintf(words[0], sizeof words[0], "dim=2 %s", schemes[s]);
        (void)snprintf(words[1], sizeof words[1], "dim=3 %s", schemes[s]);
        expect_order("2D < 3D", cost_of(smooth_motion, words[0]), cost_of(smooth_motion, words[1]));
    }
    expect_order("no contact < contact", cost_of(apart, "stencil=sph"), cost_of(touching, "stencil=sph"));
    expect_order("compressible < incompressible", cost_of(smooth_motion, "material.nu=0.49"),
                 cost_of(smooth_motion, "material.nu=0.49 incompressible.solver=poisson"));
    expect_order("volumes left < given back",
                 cost_of(smooth_motion, "material.nu=0.5 incompressible.solver=poisson incompressible.restore=0"),
                 cost_of(smooth_motion, "material.nu=0.5 incompressible.solver=poisson"));
    expect_order("no balance < balance", cost_of(smooth_motion, ""), cost_of(smooth_motion, "balance=true"));
    expect_order("no balance < balance", cost_of(smooth_motion, "scheme=jst"),
                 cost_of(smooth_motion, "scheme=jst balance=true"));
    expect_order("no wall < walls by paths", cost_of(smooth_motion, "dim=2"), cost_of(die, "dim=2"));
    CU_ASSERT(cost_of(metal, "scheme=jst").flops <
              cost_of(metal, "scheme=jst jst.kappa4_plastic=0 jst.plastic_at=0.1").flops);
    expect_order("free < projected", cost_of(smooth_motion, "dim=3"),
                 cost_of(smooth_motion, "angular_momentum=projected"));
    expect_order("stencil's slopes < least squares", cost_of(smooth_motion, "stencil=sph"),
                 cost_of(smooth_motion, "stencil=sph reconstruction=least-squares"));
    expect_order("2D < 3D", cost_of(smooth_motion, "dim=2 scheme=ulsph material.model=linear-elastic"),
                 cost_of(smooth_motion, "dim=3 scheme=ulsph material.model=linear-elastic"));
    expect_order("no tension control < tension control",
                 cost_of(smooth_motion, "scheme=ulsph material.model=linear-elastic ulsph.tension=none"),
                 cost_of(smooth_motion, "scheme=ulsph material.model=linear-elastic"));
}

static const struct unit_test tests[] = {
    {"what is allocated is what is declared", memory_is_as_declared},
    {"so it is of what few scenes ask for", memory_of_what_few_scenes_ask_for},
    {"what is asked for costs, and nothing else", what_is_asked_for_costs},
};

int main(void)
{
    return unit_main("solver cost", tests, sizeof tests / sizeof *tests);
}
