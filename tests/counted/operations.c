/* What the loops declare to compute (cost.h) against what a program computes in which every operation is counted. */
#include "solver/integrator.h"
#include "solver/pieces.h"
#include "solver/pressure.h"
#include "solver/run_internal.h"
#include "solver/scheme_upwind.h"
#include "tests/unit/runs.h"

/* What a step does once for each piece of the particles (pieces.h), as times of stages: less than one operation of each
 * particle would be. */
enum { OF_A_STEP = 64, STEPS = 2 };

/* Along an edge, by dimension: 64 particles, whole lots of them (solver/dim_lots.h). */
static const int cells[] = {0, 63, 7, 3};

/* What may differ: operations that are no particle's, in a step, and the part of what is declared that is not found. */
struct slack {
    double of_a_step, over;
};
static const struct slack exact = {OF_A_STEP, 0.0};

/* Iterations of the pressure from here on. */
static void expect_iterations_anew(const struct sample *sample)
{
    if (sample->scene->incompressible.solver != SOLVER_PRESSURE_NONE) {
        struct solver_upwind_system *system = sample->run->system;
        system->pressure->iterations = system->pressure->solved = 0;
    }
}

static void expect_in(int dim, const char *more, const char *words, struct slack slack)
{
    static struct solver_cost_arrays arrays;
    static struct solver_cost_terms terms;
    struct sample sample = start(more, "dim=%d n=%d %s", dim, cells[dim], words);
    int stages = solver_integrator_find(sample.scene->integrator)->stages;
    advance(&sample, 1);
    expect_iterations_anew(&sample);
    unsigned long before = counted;
    advance(&sample, STEPS);
    double found = (double)(counted - before) / STEPS;
    solver_run_cost(sample.run, &arrays, &terms);
    double declared = solver_cost_flops(&terms, stages);
    double particles = (double)solver_run_facts(sample.run).particles;
    double pieces = (double)solver_pieces(solver_run_facts(sample.run).particles);
    bool holds = found - declared <= slack.of_a_step * pieces && declared - found <= slack.over * declared;
    if (!holds || getenv("COUNTED_ALL") != NULL) {
        printf("\n    %dD %-70s %9.1f declared, %9.1f found per particle", dim, words, (plain)(declared / particles),
               (plain)(found / particles));
    }
    CU_ASSERT(holds);
    finish(&sample);
}

static void expect(const char *more, const char *words, struct slack slack)
{
    for (int dim = 1; dim <= 3; dim++) {
        expect_in(dim, more, words, slack);
    }
}

static void test_upwind(void)
{
    static const char *const words[] = {
        "evolved=pF material.model=linear-elastic",
        "evolved=pFJ material.model=linear-elastic",
        "evolved=pFHJ material.model=linear-elastic",
        "evolved=pF",
        "evolved=pFJ",
        "evolved=pFHJ",
        "evolved=pF material.model=neo-hookean-polyconvex",
        "evolved=pFHJ material.model=neo-hookean-polyconvex",
        "evolved=pFHJ reconstruction=none",
        "evolved=pF material.model=linear-elastic reconstruction=none",
        "evolved=pFHJ reconstruction=least-squares stencil=sph",
        "evolved=pFJ volume_flux=stress",
        "evolved=pFJ volume_flux=stress reconstruction=none",
        "evolved=pFHJ stencil=sph",
        "evolved=pFHJ stencil=sbp4 integrator=rk4 n=11",
        "evolved=pFJ stencil=sbp4 material.model=linear-elastic n=11",
        "evolved=pFHJ integrator=ssp-rk3",
        "evolved=pFHJ integrator=euler",
        "evolved=pF precision=single material.model=linear-elastic",
        "evolved=pFHJ precision=single material.model=linear-elastic",
        "evolved=pF precision=single",
        "evolved=pF precision=single reconstruction=none",
        "evolved=pFJ precision=single integrator=rk4",
        "evolved=pFHJ precision=single integrator=ssp-rk3",
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        expect(smooth_motion, words[i], exact);
    }
}

static void test_jst(void)
{
    expect(smooth_motion, "scheme=jst evolved=pF", exact);
    expect(smooth_motion, "scheme=jst evolved=pFHJ", exact);
    expect(smooth_motion, "scheme=jst evolved=pFHJ jst.kappa2=0.5", exact);
}

/* Where materials meet in density alone, so that J is evened out between all pairs. */
static void test_composite(void)
{
    static const char composite[] =
        "initial = { velocity = function(X, Y, Z) return first(0.05 * sin(2 * X), 0.04 * cos(3 * Y), 0) end }\n"
        "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2,\n"
        "             at = function(X) return 3, 0.3, X < 0.5 and 2 or 3 end }\n";
    expect(composite, "evolved=pF", exact);
    expect(composite, "evolved=pFHJ", exact);
}

static void test_boundary(void)
{
    static const char loaded[] =
        "initial = { velocity = function(X, Y, Z) return first(0.05 * sin(2 * X), 0.04 * cos(3 * Y), 0) end }\n"
        "body_force = function(X) return first(0.1, 0, 0) end\n"
        "faces = { X0 = 'clamped', X1 = { kind = 'traction', value = function() return first(0.1, 0, 0) end } }\n";
    expect(loaded, "evolved=pF", exact);
    expect(loaded, "evolved=pFHJ integrator=rk4", exact);
    static const char moved[] =
        "initial = { velocity = function(X, Y, Z) return first(0.05 * sin(2 * X), 0.04 * cos(3 * Y), 0) end }\n"
        "faces = { X0 = 'clamped', X1 = { kind = 'motion', value = function() return first(0.1, 0, 0) end } }\n";
    expect(moved, "evolved=pF", exact);
}

static void test_angular_momentum(void)
{
    static const char loaded[] =
        "initial = { velocity = function(X, Y, Z) return first(0.05 * sin(2 * X), 0.04 * cos(3 * Y), 0) end }\n"
        "faces = { X1 = { kind = 'traction', value = function() return first(0.1, 0, 0) end } }\n";
    /* six numbers are solved for in each stage: fewer operations than there are particles */
    static const struct slack solving = {400.0, 0.0};
    static const struct slack solving_often = {700.0, 0.0};
    static const char *const in[] = {"n=15", "n=7"};
    for (int dim = 2; dim <= 3; dim++) {
        char words[3][80];
        (void)snprintf(words[0], sizeof words[0], "angular_momentum=projected %s", in[dim - 2]);
        (void)snprintf(words[1], sizeof words[1], "%s integrator=euler", words[0]);
        (void)snprintf(words[2], sizeof words[2], "%s integrator=rk4", words[0]);
        expect_in(dim, smooth_motion, words[0], solving);
        expect_in(dim, smooth_motion, words[1], solving);
        expect_in(dim, smooth_motion, words[2], solving_often);
        expect_in(dim, loaded, words[0], solving);
    }
}

static void test_wall(void)
{
    static const char flying[] = "initial = { velocity = function() return first(-1e-3, 0, 0) end }\n"
                                 "rigid_wall = { point = each(-0.5), normal = { first(1, 0, 0) } }\n";
    expect(flying, "evolved=pF", exact);
    expect(flying, "evolved=pF integrator=rk4", exact);
}

/* An arc takes a few more than a straight piece. */
static void test_die(void)
{
    static const struct slack varied = {OF_A_STEP, 0.01};
    static const char flying[] = "initial = { velocity = function() return 1e-3, 0 end }\n"
                                 "die = { { path = { {-2, -1.5}, {0.5, -1.5}, {3, -2} }, fillets = {0.1} } }\n";
    expect_in(2, flying, "evolved=pF", varied);
    expect_in(2, flying, "evolved=pF balance=true", varied);
}

/* Two bodies within reach of each other that part: forces between them would be counted where they act. */
static void test_contact(void)
{
    static const char two[] = "-- domain = two bodies\n"
                              "bodies = { { shape = 'box', lower = each(0), upper = each(1) },\n"
                              "           { shape = 'box', lower = { first(1, 0, 0) }, upper = { first(2, 1, 1) } } }\n"
                              "reference_length, lattice = 1, 'centres'\n"
                              "initial = { velocity = function(X) return first(X > 1 and 1e-3 or 0, 0, 0) end }\n"
                              "contact = { law = 'predicted' }\n";
    expect_in(1, two, "evolved=pF stencil=sph n=64", exact);
    expect_in(2, two, "evolved=pF stencil=sph n=8", exact);
    expect_in(3, two, "evolved=pF stencil=sph n=4", exact);
}

/* A spectrum takes as many rotations as it takes. */
static void test_hencky(void)
{
    static const struct slack varied = {OF_A_STEP, 0.3};
    static const char metal[] =
        "initial = { velocity = function(X, Y, Z)\n"
        "    return first(0.5 * sin(2 * X + Y), 0.4 * cos(3 * Y - X + Z), 0.3 * sin(2 * Z + X)) end }\n"
        "material = { model = 'hencky', E = 3, nu = 0.3, rho = 2, yield_stress = 0.001, hardening = 0.1 }\n";
    expect(metal, "evolved=pF material.yield_stress=0 material.hardening=0", varied);
    expect(metal, "evolved=pFHJ material.yield_stress=0 material.hardening=0", varied);
    expect(metal, "evolved=pF", varied);
    expect(metal, "evolved=pFHJ", varied);
    expect(metal, "scheme=jst evolved=pFHJ", varied);
    expect(metal, "scheme=jst evolved=pFHJ jst.kappa4_plastic=0 jst.plastic_at=0.1", varied);
}

/* Pairs of the list that are beyond reach count for nothing. */
static void test_ulsph(void)
{
    static const struct slack varied = {OF_A_STEP, 0.3};
    static const char *const words[] = {
        "",
        "ulsph.tension=none",
        "ulsph.tension=stress",
        "ulsph.dissipation=none",
        "ulsph.dissipation=viscosity",
        "ulsph.xsph=0.5",
        "ulsph.delta=0",
        "ulsph.gradient=plain",
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        char text[160];
        (void)snprintf(text, sizeof text, "scheme=ulsph material.model=linear-elastic %s", words[i]);
        expect(smooth_motion, text, varied);
    }
}

static void test_pressure(void)
{
    /* lengths and sums of each iteration; and the integrator's sums, where it has none. One operation of each particle
     * and iteration would be 3900 and more. */
    static const struct slack varied = {3000.0, 0.01};
    static const char held[] =
        "faces = { X0 = 'clamped' }\n"
        "initial = { velocity = function(X, Y, Z) return first(0.1 * sin(X), 0.1 * X, 0) end }\n";
    static const char *const words[] = {
        "incompressible.solver=poisson",
        "incompressible.solver=poisson evolved=pFJ incompressible.restore=0",
        "incompressible.solver=poisson reconstruction=none integrator=rk4",
        "incompressible.solver=poisson material.model=linear-elastic",
        "incompressible.solver=poisson material.nu=0.49",
        "incompressible.solver=pseudo-time incompressible.tolerance=1e-3",
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        char text[160];
        (void)snprintf(text, sizeof text, "%s%s", strstr(words[i], "nu=") ? "" : "material.nu=0.5 ", words[i]);
        expect_in(2, held, text, varied);
        expect_in(3, held, text, varied);
    }
}

static void test_balance(void)
{
    expect(smooth_motion, "evolved=pF balance=true", exact);
    expect(smooth_motion, "evolved=pFHJ balance=true", exact);
    expect(smooth_motion, "scheme=jst evolved=pFHJ balance=true", exact);
}

/* Images are evaluated as particles are. */
static void test_symmetry(void)
{
    static const char disc[] = "domain = { shape = 'disc', centre = {0, 0}, radius = 1, symmetry = { X = 0, Y = 0 } }\n"
                               "initial = { velocity = function(X, Y) return 0.1 * X, 0.1 * Y end }\n";
    static const struct slack varied = {OF_A_STEP, 0.04}; /* the state of images is not integrated */
    expect_in(2, disc, "stencil=sph evolved=pFHJ n=12", varied);
    expect_in(2, disc, "scheme=jst stencil=sph evolved=pFHJ n=12", varied);
}

static const struct unit_test tests[] = {
    {"upwind", test_upwind},
    {"jst", test_jst},
    {"where materials meet", test_composite},
    {"faces and loads", test_boundary},
    {"angular momentum", test_angular_momentum},
    {"wall", test_wall},
    {"walls by paths", test_die},
    {"contact", test_contact},
    {"Hencky's material, elastic and plastic", test_hencky},
    {"ulsph", test_ulsph},
    {"pressure of incompressible bodies", test_pressure},
    {"balance", test_balance},
    {"symmetry", test_symmetry},
};

int main(void)
{
    return unit_main("operations", tests, sizeof tests / sizeof *tests);
}
