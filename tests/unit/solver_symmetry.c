/* Parts of round bodies that planes of symmetry cut off: they move as the whole does, to round-off. */
#include "solver/cloud.h"
#include "tests/unit/runs.h"

/* Around (0.2, -0.1, 0.3), with the planes of a half, quarter or eighth; x, y, z are about the centre. */
static const struct body {
    const char *name, *domain, *planes;
    int dim, parts;
} bodies[] = {
    {"half of a disc", "shape = 'disc', centre = {0.2, -0.1}, radius = 0.5", "Y = -0.1", 2, 2},
    {"quarter of a disc", "shape = 'disc', centre = {0.2, -0.1}, radius = 0.5", "X = 0.2, Y = -0.1", 2, 4},
    {"quarter of a cylinder", "shape = 'cylinder', centre = {0.2, -0.1, 0.3}, radius = 0.5, length = 0.75",
     "X = 0.2, Y = -0.1", 3, 4},
    {"eighth of a ball", "shape = 'ball', centre = {0.2, -0.1, 0.3}, radius = 0.5", "X = 0.2, Y = -0.1, Z = 0.3", 3, 8},
};
enum { BODIES = sizeof bodies / sizeof *bodies };

/* A motion that is its own image in all planes; a cylinder stays on the plane of its lower end. */
static const char symmetric[] =
    "initial = { velocity = function(X, Y, Z)\n"
    "    local x, y, z = X - 0.2, Y + 0.1, Z - 0.3\n"
    "    return first(x * (0.9 + y * y - z * z), y * (-0.5 + x * x), z * (0.4 - 2 * x * x + z * z)) end }\n";
static const char metal[] = "material = { model = 'hencky', E = 3, nu = 0.3, rho = 2, yield_stress = 0.1 }\n";

static struct sample of_body(const struct body *body, bool cut, const char *more, const char *words)
{
    char text[4096];
    int length = snprintf(text, sizeof text, "domain = { %s%s%s%s }\n%s%s", body->domain, cut ? ", symmetry = { " : "",
                          cut ? body->planes : "", cut ? " }" : "", strstr(more, "initial = ") ? "" : symmetric, more);
    CU_ASSERT_FATAL(length > 0 && (size_t)length < sizeof text);
    return start(text, "dim=%d n=6 reference_length=0.75 stencil=closed support=1.6 %s", body->dim, words);
}

/* Particle of the whole where one of the part is. */
static size_t at(const struct solver_output *whole, const double *X)
{
    size_t dim = (size_t)whole->cloud->dim;
    for (size_t a = 0; a < whole->cloud->count; a++) {
        bool same = true;
        for (size_t i = 0; i < dim; i++) {
            same = same && whole->cloud->X[a * dim + i] == X[i];
        }
        if (same) {
            return a;
        }
    }
    CU_FAIL_FATAL("a particle that the whole has not");
    return 0;
}

static double difference(const double *one, const double *other, size_t count)
{
    double most = 0.0;
    for (size_t i = 0; i < count; i++) {
        most = fmax(most, fabs(one[i] - other[i]));
    }
    return most;
}

static void expect_same(const struct body *body, const char *more, const char *words)
{
    struct sample of_whole = of_body(body, false, more, words);
    struct sample of_part = of_body(body, true, more, words);
    advance_to(&of_whole, 0.3);
    advance_to(&of_part, 0.3);
    struct solver_output whole = output_of(&of_whole);
    struct solver_output part = output_of(&of_part);
    size_t dim = (size_t)body->dim;
    double worst = 0.0;
    double moved = 0.0;
    CU_ASSERT_EQUAL(part.step, whole.step);
    CU_ASSERT(part.cloud->count * (size_t)body->parts < whole.cloud->count * 3);
    for (size_t a = 0; a < part.cloud->count; a++) {
        size_t b = at(&whole, part.cloud->X + a * dim);
        worst = fmax(worst, difference(part.u + a * dim, whole.u + b * dim, dim));
        worst = fmax(worst, difference(part.v + a * dim, whole.v + b * dim, dim));
        worst = fmax(worst, difference(part.F + a * dim * dim, whole.F + b * dim * dim, dim * dim));
        worst = fmax(worst, difference(part.P + a * dim * dim, whole.P + b * dim * dim, dim * dim));
        worst = fmax(worst, difference(part.J + a, whole.J + b, 1));
        moved = fmax(moved, fabs(part.u[a * dim]));
    }
    expect_below(body->name, worst, 2e-12);
    CU_ASSERT(moved > 0.05);
    const struct solver_history *history[] = {solver_run_history(of_part.run), solver_run_history(of_whole.run)};
    const struct solver_totals *sums[] = {&history[0]->totals[history[0]->count - 1],
                                          &history[1]->totals[history[1]->count - 1]};
    CU_ASSERT_DOUBLE_EQUAL(body->parts * sums[0]->kinetic / sums[1]->kinetic, 1.0, 1e-11);
    CU_ASSERT_DOUBLE_EQUAL(body->parts * sums[0]->strain / sums[1]->strain, 1.0, 1e-11);
    CU_ASSERT(strcmp(more, metal) != 0 || sums[0]->plastic > 0.1 * sums[0]->strain);
    CU_ASSERT_DOUBLE_EQUAL(body->parts * sums[0]->plastic, sums[1]->plastic, 1e-11);
    double mass[] = {solver_run_facts(of_part.run).mass, solver_run_facts(of_whole.run).mass};
    CU_ASSERT_DOUBLE_EQUAL(body->parts * mass[0] / mass[1], 1.0, 1e-13);
    finish(&of_part);
    finish(&of_whole);
}

static void as_the_whole(void)
{
    for (int b = 0; b < BODIES; b++) {
        expect_same(&bodies[b], "", "evolved=pFHJ");
        expect_same(&bodies[b], metal, "evolved=pF");
        expect_same(&bodies[b], "", "scheme=jst evolved=pFJ cfl=0.2");
    }
}

static void whatever_the_terms(void)
{
    static const char *const words[] = {"reconstruction=least-squares evolved=pFHJ",
                                        "reconstruction=none evolved=pFJ",
                                        "volume_flux=stress evolved=pFJ",
                                        "stencil=sph",
                                        "integrator=rk4",
                                        "integrator=ssp-rk3",
                                        "scheme=jst jst.kappa2=0.1 cfl=0.1"};
    static const char pulled[] =
        "body_force = function(X, Y) return first(0.2 * (X - 0.2), 0, 0) end\n"
        "faces = { surface = { kind = 'traction', value = function(X, Y) return first(0.1 * (X - 0.2), 0, 0) end } }\n";
    static const char composite[] = "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2,\n"
                                    "    at = function(X) return (X - 0.2) ^ 2 > 0.04 and 3 or 5, 0.3, 2 end }\n";
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        expect_same(&bodies[1], "", words[i]);
    }
    expect_same(&bodies[1], pulled, "");
    expect_same(&bodies[1], composite, "evolved=pFJ");
}

/* A wall hits: what it takes of a part is its share. */
static void before_a_wall(void)
{
    static const char falling[] = "rigid_wall = { point = {0, 0, -0.075}, normal = {0, 0, 1} }\n"
                                  "material = { model = 'hencky', E = 3, nu = 0.3, rho = 2, yield_stress = 0.1 }\n"
                                  "initial = { velocity = function() return 0, 0, -0.5 end }\n";
    double impulse[2];
    for (int cut = 0; cut < 2; cut++) {
        struct sample sample = of_body(&bodies[2], cut == 1, falling, "evolved=pF");
        advance_to(&sample, 0.3);
        const struct solver_history *history = solver_run_history(sample.run);
        impulse[cut] = history->totals[history->count - 1].wall[2];
        CU_ASSERT(history->mirrored[0] == (cut == 1) && history->mirrored[1] == (cut == 1) && !history->mirrored[2]);
        finish(&sample);
    }
    CU_ASSERT(fabs(impulse[0]) > 0.01);
    CU_ASSERT_DOUBLE_EQUAL(4.0 * impulse[1] / impulse[0], 1.0, 1e-12);
}

/* Volumes and areas are shares of the whole, and no image is shown. */
static void shares(void)
{
    static const double pi = 3.14159265358979323846;
    const double volume[] = {pi / 8, pi / 16, pi * 0.75 / 16, pi / 48};
    for (int b = 0; b < BODIES; b++) {
        struct sample sample = of_body(&bodies[b], true, "", "");
        struct solver_output output = output_of(&sample);
        const struct solver_cloud *cloud = output.cloud;
        size_t dim = (size_t)bodies[b].dim;
        double sum = 0.0;
        for (size_t a = 0; a < cloud->count; a++) {
            sum += output.V[a];
            CU_ASSERT(output.V[a] > 0.0 && cloud->X[a * dim + 1] >= -0.1);
        }
        for (size_t c = 0; c < cloud->cell_count << dim; c++) {
            CU_ASSERT_FATAL(cloud->cell[c] < cloud->count);
        }
        CU_ASSERT(cloud->cell_count > 0);
        CU_ASSERT_DOUBLE_EQUAL(sum / volume[b], 1.0, 1e-13);
        CU_ASSERT_EQUAL(solver_run_facts(sample.run).particles, cloud->count);
        finish(&sample);
    }
}

static void refusals(void)
{
    static const char ball[] = "domain = { shape = 'ball', centre = {0, 0, 0}, radius = 0.5, symmetry = { X = 0 } }\n";
    static const char hooke[] = "domain = { shape = 'ball', centre = {0, 0, 0}, radius = 0.5, symmetry = { X = 0 } }\n"
                                "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2 }\n";
    struct solver_error error = refusal(hooke, "scheme=ulsph");
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "domain.symmetry: images are neighbours in a stencil"));
    error = refusal(ball, "stencil=closed angular_momentum=projected");
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "planes of symmetry hold the body"));
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"as the whole", as_the_whole},   {"whatever the terms", whatever_the_terms},
        {"before a wall", before_a_wall}, {"shares", shares},
        {"refusals", refusals},
    };
    return unit_main("solver symmetry", tests, sizeof tests / sizeof *tests);
}
