/* Updated-Lagrangian SPH: fields that exist, the surface that is found, results that do not depend on threads or on
 * when neighbours were listed, and scenes that are refused. */
#include "tests/unit/ulsph_states.h"

static const char bare[] = "ulsph.gradient=plain ulsph.dissipation=none ulsph.tension=none ulsph.xsph=0 ulsph.delta=0";

static double bytes_of(size_t dim, const char *more)
{
    struct sample sample = start(ulsph_material, "dim=%zu n=3 %s %s", dim, bare, more);
    double bytes = solver_run_facts(sample.run).state_bytes;
    finish(&sample);
    return bytes;
}

/* Each ingredient brings its own fields and no others; together they bring what they bring alone. */
static void test_fields(void)
{
    static const struct {
        const char *setting, *fields;
        size_t tensors, vectors;
        int scalars;
    } rows[] = {
        {"ulsph.gradient=corrected", "the corrective matrix", 1, 0, 0},
        {"ulsph.dissipation=viscosity", "no field", 0, 0, 0},
        {"ulsph.dissipation=riemann", "gradient of v, impedance and root of density", 1, 0, 2},
        {"ulsph.tension=stress", "the tensile stress", 1, 0, 0},
        {"ulsph.tension=control", "the tensile stress, colour and what is inner", 1, 0, 2},
        {"ulsph.xsph=0.5", "the transport velocity", 0, 1, 0},
        {"ulsph.delta=0.002", "gradient of density", 0, 1, 0},
        {"lattice=centres", "one field less, of whole cells", 0, 0, -1},
    };
    for (size_t dim = 1; dim <= 3; dim++) {
        double lanes = (double)solver_state_lanes((int)dim);
        double tensor = (double)dim * lanes;
        /* v, x, rho, S; volume and whole cell; sigma L */
        double base = 8.0 * (2.0 * lanes + 1.0 + tensor + 2.0 + tensor);
        double all = base;
        CU_ASSERT_EQUAL(bytes_of(dim, ""), base);
        for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
            double own = 8.0 * ((double)rows[i].tensors * tensor + (double)rows[i].vectors * lanes + rows[i].scalars);
            bool brings = bytes_of(dim, rows[i].setting) == base + own;
            if (!brings) {
                printf("\n    %zuD: %s does not bring %s", dim, rows[i].setting, rows[i].fields);
            }
            CU_ASSERT(brings);
            bool full = i != 1 && i != 3 && i != 7; /* of alternatives, the larger */
            all += full ? own : 0.0;
        }
        CU_ASSERT_EQUAL(bytes_of(dim, "ulsph.gradient=corrected ulsph.dissipation=riemann ulsph.tension=control "
                                      "ulsph.xsph=0.5 ulsph.delta=0.002"),
                        all);
    }
}

/* Eq. 11, its height apart, at r over the support. */
static double wendland(double part)
{
    return part < 1.0 ? pow(1.0 - part, 4.0) * (4.0 * part + 1.0) : 0.0;
}

static double distance(const struct sample *sample, size_t a, size_t b)
{
    double square = 0.0;
    for (size_t i = 0; i < ulsph_dim(sample); i++) {
        const double *x = sample->run->state.x + i;
        double d = x[b * sample->run->state.lanes] - x[a * sample->run->state.lanes];
        square += d * d;
    }
    return sqrt(square);
}

/* Eq. 52 and what section 3.4 calls surface, vicinity and inner, by all pairs. */
static void test_surface(void)
{
    static const double pi = 3.14159265358979323846;
    static const char *const blocks[] = {"dim=1 n=12", "dim=2 n=9", "dim=3 n=6"};
    for (size_t i = 0; i < 6; i++) {
        struct sample sample = start(ulsph_material, "%s lattice=%s", blocks[i / 2], i % 2 == 0 ? "nodes" : "centres");
        size_t count = sample.run->cloud->count;
        double spacing = sample.run->cloud->spacing;
        double h = 1.2 * spacing;
        const double height[] = {0.75 / h, 7.0 / (4.0 * pi * h * h), 21.0 / (16.0 * pi * h * h * h)};
        double *inner = ulsph_field(&sample, "inner").value;
        double *colour = ulsph_field(&sample, "colour").value;
        size_t found = 0;
        ulsph_place(&sample, NULL, 0.1);
        ulsph_strain(&sample, 0.05, 0.0);
        ulsph_evaluate(&sample);
        for (size_t a = 0; a < count; a++) {
            double C = 0.0;
            bool within = colour[a] >= 0.9;
            for (size_t b = 0; b < count; b++) {
                double r = distance(&sample, a, b);
                C += ulsph_mass(&sample, b) / ulsph_field(&sample, "rho").value[b] * height[i / 2] *
                     wendland(r / (2.0 * h));
                within = within && (r >= 1.2 * spacing || colour[b] >= 0.9);
            }
            CU_ASSERT_DOUBLE_EQUAL(colour[a], C, 1e-13);
            CU_ASSERT_EQUAL(inner[a], within ? 1.0 : 0.0);
            found += within;
        }
        CU_ASSERT(found > 0 && found < count);
        finish(&sample);
    }
}

/* A block pressed together so that third neighbours lie where lists end, and that flies apart: its lists change. */
static void set_wild(const struct sample *sample)
{
    static const double drift[] = {0.1, -0.2, 0.3};
    double F[9];
    double G[9];
    unit_tensor(ulsph_dim(sample), F);
    for (size_t k = 0; k < ulsph_dim(sample) * ulsph_dim(sample); k++) {
        G[k] = 0.5 * F[k] + uniform(-0.2, 0.2);
        F[k] *= 0.87;
    }
    ulsph_place(sample, F, 0.05);
    ulsph_strain(sample, 0.02, 0.05);
    ulsph_move(sample, G, drift);
}

static bool same_state(const struct sample *one, const struct sample *other)
{
    const struct solver_state *left = &one->run->state;
    const struct solver_state *right = &other->run->state;
    return left->evolved == right->evolved && memcmp(left->U, right->U, left->evolved * sizeof(double)) == 0 &&
           memcmp(left->rate, right->rate, left->evolved * sizeof(double)) == 0;
}

/* The same bytes on any number of threads, through steps in which neighbours are listed anew. */
static void test_threads(void)
{
    static const char *const blocks[] = {"dim=1 n=600", "dim=2 n=23", "dim=3 n=7"}; /* three pieces of work or more */
    static const char *const terms[] = {"integrator=tvd-rk2",
                                        "integrator=rk4 ulsph.dissipation=viscosity ulsph.tension=stress"};
    static const int threads[] = {5, 3, 2};
    for (size_t i = 0; i < 6; i++) {
        struct sample alone = start(ulsph_halves, "%s %s threads=1", blocks[i / 2], terms[i % 2]);
        struct sample begin = start(ulsph_halves, "%s %s threads=1", blocks[i / 2], terms[i % 2]);
        size_t pairs = solver_run_facts(alone.run).pairs;
        set_wild(&begin);
        ulsph_copy(&begin, &alone);
        advance(&alone, 4);
        CU_ASSERT_NOT_EQUAL(solver_run_facts(alone.run).pairs, pairs); /* listed anew on the way */
        for (size_t t = 0; t < sizeof threads / sizeof *threads; t++) {
            struct sample together = start(ulsph_halves, "%s %s threads=%d", blocks[i / 2], terms[i % 2], threads[t]);
            ulsph_copy(&begin, &together);
            advance(&together, 4);
            CU_ASSERT(same_state(&alone, &together));
            finish(&together);
        }
        finish(&alone);
        finish(&begin);
    }
}

/* The same bytes whenever neighbours were listed: of two runs in the same state one has the list of an earlier place,
 * not yet too far away, with other pairs beyond the support. */
static void test_lists(void)
{
    static const char *const blocks[] = {"dim=1 n=60", "dim=2 n=12", "dim=3 n=6"};
    for (size_t dim = 1; dim <= 3; dim++) {
        struct sample fresh = start(ulsph_material, "%s", blocks[dim - 1]);
        struct sample aged = start(ulsph_material, "%s", blocks[dim - 1]);
        struct ulsph_field x = ulsph_field(&aged, "x");
        set_wild(&aged);
        ulsph_evaluate(&aged);
        for (size_t k = 0; k < aged.run->cloud->count * x.width; k++) {
            x.value[k] += k % x.width < dim ? uniform(-0.055, 0.055) * aged.run->cloud->spacing : 0.0;
        }
        ulsph_copy(&aged, &fresh);
        ulsph_evaluate(&aged);
        ulsph_evaluate(&fresh);
        CU_ASSERT_NOT_EQUAL(solver_run_facts(fresh.run).pairs, solver_run_facts(aged.run).pairs);
        CU_ASSERT(same_state(&fresh, &aged));
        for (int step = 0; step < 20; step++) {
            advance(&fresh, 1);
            advance(&aged, 1);
            CU_ASSERT(same_state(&fresh, &aged));
        }
        finish(&fresh);
        finish(&aged);
    }
}

static void expect_refusal(const char *more, const char *overrides, const char *message)
{
    struct solver_error error = refusal(more, "%s", overrides);
    bool said = error.code == SOLVER_BAD_INPUT && strstr(error.text, message) != NULL;
    if (!said) {
        printf("\n    \"%s\" is not: %s", error.text, message);
    }
    CU_ASSERT(said);
}

static void test_refusals(void)
{
    static const char displaced[] = "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2 }\n"
                                    "scheme, support = 'ulsph', 2.4\n"
                                    "initial = { displacement = function(X) return first(0.01 * X, 0, 0) end }\n";
    static const char strained[] = "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2 }\n"
                                   "scheme, support = 'ulsph', 2.4\n"
                                   "initial = { F = function(X) local big = X > 0.9 and 0.11 or 0.09\n"
                                   "    if d == 1 then return 1 - big elseif d == 2 then return 1, 0, big, 1 end\n"
                                   "    return 1, 0, 0, 0, 1, 0, 0, big, 1 end }\n";
    expect_refusal("scheme = 'ulsph'\n", "dim=2",
                   "material.model: scheme = \"ulsph\" has one material, Hooke's law in rates with the Jaumann rate; "
                   "expected linear-elastic, got neo-hookean");
    expect_refusal(displaced, "dim=2",
                   "initial.F: scheme = \"ulsph\" needs it beside initial.displacement: its initial density and stress "
                   "follow from it");
    expect_refusal(ulsph_material, "dim=2 contact.law=predicted",
                   "contact.law: there is one body, and no other that it could touch; expected several under bodies");
    expect_refusal(ulsph_material, "dim=3 support=1.1",
                   "support: with scheme = \"ulsph\" the nearest neighbours must be well within reach; expected at "
                   "least 1.2, got 1.1");
    expect_refusal(strained, "dim=1",
                   "initial.F at X = (1, 0, 0) m: scheme = \"ulsph\" starts from small strains; "
                   "expected row 1, column 1 within 0.1 of 1, got 0.89");
    expect_refusal(strained, "dim=2", "expected row 2, column 1 within 0.1 of 0, got 0.11");
    expect_refusal(strained, "dim=3", "expected row 3, column 2 within 0.1 of 0, got 0.11");
}

/* At the least support that is accepted, and the largest, all terms are finite. */
static void test_supports(void)
{
    for (size_t dim = 1; dim <= 3; dim++) {
        for (int i = 0; i < 4; i++) {
            struct sample sample =
                start(ulsph_material,
                      "dim=%zu n=%d support=%g ulsph.stress_exponent=32 "
                      "ulsph.tension=%s",
                      dim, dim == 3 ? 4 : 6, i / 2 == 0 ? 1.2 : 4.0, i % 2 == 0 ? "control" : "stress");
            ulsph_scatter(&sample);
            ulsph_evaluate(&sample);
            double worst = 0.0;
            for (size_t k = 0; k < sample.run->state.evolved; k++) {
                worst = isfinite(sample.run->state.rate[k]) ? worst : INFINITY;
            }
            CU_ASSERT_EQUAL(worst, 0.0);
            finish(&sample);
        }
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"fields", test_fields}, {"surface", test_surface},   {"threads", test_threads},
        {"lists", test_lists},   {"refusals", test_refusals}, {"supports", test_supports},
    };
    return unit_main("ulsph states", tests, sizeof tests / sizeof *tests);
}
