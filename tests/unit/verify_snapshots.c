/* Snapshots: a run stops at them exactly, and what is taken is the state compared with the oracle. */
#include "tests/unit/unit.h"
#include "verify/level.h"
#include "verify/simulate.h"
#include "verify/truth.h"

#include <math.h>
#include <stdio.h>

static struct solver_scene *scene;
static struct verify_truth truth;
static struct verify_level level;
static struct solver_error error;

static void open_scene(const char *name, const char *const *override, size_t count)
{
    char path[512];
    (void)snprintf(path, sizeof path, TEST_SOURCE_DIR "/verify/scenes/%s.lua", name);
    bool good = solver_scene_load(path, override, count, &scene, &error) && verify_truth_create(scene, &truth, &error);
    if (!good) {
        printf("\n    %s", error.text);
    }
    CU_ASSERT_FATAL(good);
    level = (struct verify_level){.n = scene->n};
}

static void close_scene(struct solver_run *run)
{
    solver_run_free(run);
    verify_level_free(&level);
    CU_ASSERT_EQUAL(level.snapshot_count, 0);
    verify_truth_free(&truth);
    solver_scene_free(scene);
}

static bool take(void *context, struct solver_run *run, struct solver_error *why)
{
    (void)context;
    return verify_level_snapshot(&level, run, truth.kind, truth.oracle, why);
}

static struct solver_run *simulate(verify_take *taker)
{
    struct solver_run *run = NULL;
    CU_ASSERT_FATAL(verify_simulate(scene, ".", "", taker, NULL, &run, &error));
    return run;
}

static void stops_exactly(void)
{
    static const char *const coarse[] = {"n=200"};
    open_scene("bimaterial-wave", coarse, 1);
    struct solver_run *run = simulate(take);
    CU_ASSERT_EQUAL_FATAL(level.snapshot_count, scene->snapshot_count);
    double worst = 0;
    size_t P_l1 = verify_error_find("P_l1");
    for (size_t i = 0; i < level.snapshot_count; i++) {
        CU_ASSERT(level.snapshot[i].time == scene->snapshot[i]);
        worst = fmax(worst, level.snapshot[i].error[P_l1]);
    }
    CU_ASSERT(worst > 0 && level.error[verify_error_find("snapshots_P_l1")] == worst);
    close_scene(run);
}

/* The last snapshot here is t_end: its errors are those of the final state, and its profile is that state's. */
static void profile(void)
{
    static const char *const coarse[] = {"n=200"};
    open_scene("bimaterial-wave", coarse, 1);
    struct solver_run *run = simulate(take);
    struct solver_output output;
    double at_end[VERIFY_STATE_ERRORS];
    CU_ASSERT_FATAL(solver_run_output(run, &output, &error));
    CU_ASSERT_FATAL(verify_norms_state(&output, truth.kind, truth.oracle, at_end, &error));
    const struct verify_snapshot *last = &level.snapshot[level.snapshot_count - 1];
    for (size_t i = 0; i < VERIFY_STATE_ERRORS; i++) {
        bool unknown = isnan(at_end[i]) && isnan(last->error[i]); /* of a field that is exactly zero */
        CU_ASSERT(unknown || at_end[i] == last->error[i]);
    }
    CU_ASSERT_EQUAL_FATAL(last->count, 201);
    double error_sum = 0, exact_sum = 0;
    for (size_t i = 0; i < last->count; i++) {
        const double X[3] = {last->point[i].X};
        struct oracle_state state;
        truth.kind->state(truth.oracle, X, last->time, &state);
        CU_ASSERT(i == 0 || X[0] > last->point[i - 1].X);
        CU_ASSERT(last->point[i].exact == state.P[0]);
        error_sum += fabs(last->point[i].computed - last->point[i].exact);
        exact_sum += fabs(last->point[i].exact);
    }
    /* the same but for the volumes of the ends */
    CU_ASSERT_DOUBLE_EQUAL(error_sum / exact_sum, at_end[verify_error_find("P_l1")], 0.02 * error_sum / exact_sum);
    close_scene(run);
}

/* Nobody takes them, and the steps are the same. */
static void steps_do_not_depend_on_who_looks(void)
{
    static const char *const coarse[] = {"n=100"};
    open_scene("bimaterial-wave", coarse, 1);
    struct solver_run *seen = simulate(take), *unseen = simulate(NULL);
    struct solver_output a, b;
    CU_ASSERT_FATAL(solver_run_output(seen, &a, &error) && solver_run_output(unseen, &b, &error));
    CU_ASSERT_EQUAL(a.step, b.step);
    for (size_t i = 0; i < a.cloud->count; i++) {
        CU_ASSERT(a.u[i] == b.u[i]);
    }
    solver_run_free(unseen);
    close_scene(seen);
}

/* In 3D there are errors and no profile. */
static void no_profile_in_3d(void)
{
    static const char *const coarse[] = {"n=8", "snapshots={1e-3}"};
    open_scene("swinging-cube", coarse, 2);
    struct solver_run *run = simulate(take);
    CU_ASSERT_EQUAL_FATAL(level.snapshot_count, 1);
    CU_ASSERT_EQUAL(level.snapshot[0].count, 0);
    CU_ASSERT_PTR_NULL(level.snapshot[0].point);
    CU_ASSERT(level.snapshot[0].time == 1e-3 && level.error[verify_error_find("snapshots_p")] > 0);
    close_scene(run);
}

static bool refuse(void *context, struct solver_run *run, struct solver_error *why)
{
    (void)context;
    (void)run;
    return solver_fail(why, SOLVER_NO_MEMORY, "no memory for a snapshot");
}

static void a_failing_taker_ends_the_run(void)
{
    static const char *const coarse[] = {"n=100"};
    open_scene("bimaterial-wave", coarse, 1);
    struct solver_run *run = NULL;
    CU_ASSERT_FALSE(verify_simulate(scene, ".", "", refuse, NULL, &run, &error));
    CU_ASSERT_EQUAL(error.code, SOLVER_NO_MEMORY);
    CU_ASSERT_PTR_NULL(run);
    close_scene(run);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"stops exactly", stops_exactly},
        {"profile", profile},
        {"steps do not depend on who looks", steps_do_not_depend_on_who_looks},
        {"no profile in 3D", no_profile_in_3d},
        {"a failing taker ends the run", a_failing_taker_ends_the_run},
    };
    return unit_main("snapshots", tests, sizeof tests / sizeof *tests);
}
