/* Observed orders. */
#include "tests/unit/unit.h"
#include "verify/study.h"

#include <math.h>
#include <stdio.h>

static void power_laws(void)
{
    for (int order = 1; order <= 4; order++) {
        for (int n = 1; n < 1000; n *= 3) {
            double h = 1.0 / n;
            double observed = verify_order(7 * pow(h, order), h, 7 * pow(h / 1.5, order), h / 1.5);
            CU_ASSERT_DOUBLE_EQUAL(observed, order, 1e-12);
        }
    }
}

static void growing_error(void)
{
    CU_ASSERT_DOUBLE_EQUAL(verify_order(1e-3, 0.1, 2e-3, 0.05), -1, 1e-12);
    CU_ASSERT(verify_order(1e-3, 0.1, 1e-3, 0.05) == 0);
}

static void no_order(void)
{
    CU_ASSERT(isnan(verify_order(0, 0.1, 0, 0.05)));
    CU_ASSERT(isnan(verify_order(NAN, 0.1, 1e-3, 0.05)));
    CU_ASSERT(isnan(verify_order(1e-3, 0.1, NAN, 0.05)));
    CU_ASSERT(isnan(verify_order(1e-3, NAN, 1e-3, 0.05)));
    CU_ASSERT(isnan(verify_order(-1e-3, 0.1, 1e-3, 0.05)));
    CU_ASSERT(isnan(verify_order(1e-3, 0.1, 1e-4, 0.1)));
    CU_ASSERT(isnan(verify_order(1e-3, 0.1, 1e-4, 0)));
    CU_ASSERT(isnan(verify_order(INFINITY, 0.1, INFINITY, 0.05)));
}

static void zero_at_one_level(void)
{
    CU_ASSERT(verify_order(1e-3, 0.1, 0, 0.05) == INFINITY);
    CU_ASSERT(verify_order(0, 0.1, 1e-3, 0.05) == -INFINITY);
}

/* The largest errors over the snapshots that have a column, as those of a state. */
static void snapshot_columns(void)
{
    const size_t shown[] = {verify_error_find("p"), verify_error_find("snapshots_P_l1"), VERIFY_PROBES_NRMSE,
                            verify_error_find("snapshots_u")};
    size_t of_state[VERIFY_STATE_ERRORS];
    CU_ASSERT_EQUAL_FATAL(verify_shown_snapshots(shown, 4, of_state), 2);
    CU_ASSERT_EQUAL(of_state[0], verify_error_find("P_l1"));
    CU_ASSERT_EQUAL(of_state[1], verify_error_find("u"));
    CU_ASSERT_EQUAL(verify_shown_snapshots(shown, 1, of_state), 0);
}

static struct verify_study study;
static struct solver_scene scene = {.oracle = "swinging-cube"};

static void levels_added(void)
{
    struct verify_level level = {.n = 4, .facts = {.particles = 125, .steps = 8, .spacing = 0.25, .seconds = 1e-3}};
    level.error[0] = level.error[VERIFY_BESIDE] = 4e-2;
    level.figure[1].error = 8e-3;
    verify_study_add(&study, &level);
    CU_ASSERT(isnan(study.level[0].rate[0]) && isnan(study.level[0].figure[1].rate));
    CU_ASSERT_DOUBLE_EQUAL(study.level[0].ns_per_particle_step, 1000, 1e-9);
    level.n = 8;
    level.error[VERIFY_BESIDE] = 1e-2;
    level.facts.spacing = 0.125;
    level.error[0] = 1e-2;
    level.figure[1].error = 1e-3;
    verify_study_add(&study, &level);
    CU_ASSERT_EQUAL(study.level_count, 2);
    CU_ASSERT_DOUBLE_EQUAL(study.level[1].rate[0], 2, 1e-12);
    CU_ASSERT(isnan(study.level[1].rate[VERIFY_BESIDE])); /* a difference has no order */
    CU_ASSERT_DOUBLE_EQUAL(study.level[1].figure[1].rate, 3, 1e-12);
    level.n = 24; /* the order is that from the level before, not from the first */
    level.facts.spacing = 0.125 / 3;
    level.error[0] = 1e-2 / 27;
    verify_study_add(&study, &level);
    CU_ASSERT_DOUBLE_EQUAL(study.level[2].rate[0], 3, 1e-12);
}

static void published_rows(void)
{
    scene.published_count = 1;
    scene.published[0] = (struct solver_published_row){.n = 16, .count = 1, .value = {{"p", 2.198e-4}}};
    CU_ASSERT(verify_published(&scene, 16, "p") == 2.198e-4);
    CU_ASSERT(isnan(verify_published(&scene, 16, "P")));
    CU_ASSERT(isnan(verify_published(&scene, 8, "p")));
    /* another method is compared with what was published, another problem is not */
    static const char *const methods[] = {
        "",
        "n=16\n",
        "stencil=closed\ncfl=0.3\n",
        "oracle.nu=0.3\nview.bands=4\n",
        "balance=true\nhistory=9\n",
        "lattice=centres\nwall=2\ngrading.X=2\njst.kappa4=0\nulsph.xsph=1\nincompressible.solver=poisson\n"};
    static const char *const problems[] = {"material.nu=0.3\n", "n=16\nU0=1\n",         "t_end=1\n",
                                           "cflx=1\n",          "faces.X0.kind=free\n", "balance=true\nV.balance=1\n"};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        char line[128];
        scene.overrides = line;
        (void)snprintf(line, sizeof line, "%s", methods[i]);
        CU_ASSERT(verify_published(&scene, 16, "p") == 2.198e-4);
        (void)snprintf(line, sizeof line, "%s", problems[i]);
        CU_ASSERT(isnan(verify_published(&scene, 16, "p")));
    }
    scene.overrides = NULL;
    size_t shown[VERIFY_ERRORS], count = 0;
    struct solver_error error;
    CU_ASSERT(verify_shown(&scene, shown, &count, &error) && count == 1);
    scene.gate_count = 1;
    scene.gate[0] = (struct solver_gate_rule){.bounds = 2, .bound = {{"u_max", 1}, {"rate F", 1}}};
    CU_ASSERT(verify_shown(&scene, shown, &count, &error) && count == 3);
    (void)snprintf(scene.scheme, sizeof scene.scheme, "ulsph"); /* has no F */
    CU_ASSERT(verify_shown(&scene, shown, &count, &error) && count == 2);
    CU_ASSERT(shown[0] == verify_error_find("p") && shown[1] == verify_error_find("u_max"));
    struct solver_scene bare = {.oracle = "swinging-cube",
                                .scheme = "ulsph"}; /* nothing is asked for: momentum and stress */
    CU_ASSERT(verify_shown(&bare, shown, &count, &error) && count == 2);
    CU_ASSERT(shown[0] == verify_error_find("p") && shown[1] == verify_error_find("sigma"));
    bare.scheme[0] = '\0';
    CU_ASSERT(verify_shown(&bare, shown, &count, &error) && count == 2);
    CU_ASSERT(shown[0] == verify_error_find("p") && shown[1] == verify_error_find("P"));
    bare.beside.count = 1; /* and the differences from the configuration beside */
    CU_ASSERT(verify_shown(&bare, shown, &count, &error) && count == 4 && shown[3] == VERIFY_BESIDE_ABS);
    bare.oracle[0] = '\0'; /* there is nothing else */
    CU_ASSERT(verify_shown(&bare, shown, &count, &error) && count == 2 && shown[0] == VERIFY_BESIDE);
    struct solver_scene figures_alone = {
        .oracle = "swinging-cube", .gate_count = 1, .gate = {{.bounds = 1, .bound = {{"rate figure period", 1}}}}};
    CU_ASSERT(verify_shown(&figures_alone, shown, &count, &error) &&
              count == 2); /* then p and P, as if nothing were asked */
    scene.published[0].value[0].name[0] = 'q';
    CU_ASSERT_FALSE(verify_shown(&scene, shown, &count, &error));
    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"power laws", power_laws},
        {"a growing error has a negative order", growing_error},
        {"no order", no_order},
        {"an error of zero at one level", zero_at_one_level},
        {"snapshot columns", snapshot_columns},
        {"levels added", levels_added},
        {"published rows and columns shown", published_rows},
    };
    return unit_main("study", tests, sizeof tests / sizeof *tests);
}
