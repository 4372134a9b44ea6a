/* A run that goes on from a checkpoint ends with the bytes of one that was never stopped: every scene that comes with
 * the program, by every scheme that takes it. A new scene or scheme is tested by being there. */
#include "solver/checkpoint.h"
#include "solver/scheme.h"
#include "tests/unit/run_bytes.h"
#include "tests/unit/scratch.h"
#include "verify/find.h"
#include "verify/simulate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[SCRATCH];
static char checkpoint_path[SCRATCH_BELOW];

enum { HALF = 4 }; /* steps before the checkpoint, and after it */

struct sample {
    struct solver_scene *scene;
    struct solver_run *run;
};

/* At the coarsest level, with a row of history each step, by a scheme, or the scene's own if it is NULL; false where
 * the scene or its run is refused. */
static bool begin(const char *path, const char *scheme, int threads, struct sample *sample, struct solver_error *error)
{
    char n[32], by[SOLVER_NAME + 8];
    const char *overrides[] = {n, by};
    size_t count = scheme != NULL ? 2 : 1;
    *sample = (struct sample){.scene = NULL};
    if (!solver_scene_load(path, NULL, 0, &sample->scene, error)) {
        return false;
    }
    (void)snprintf(n, sizeof n, "n=%d", sample->scene->level_count > 0 ? sample->scene->levels[0] : sample->scene->n);
    (void)snprintf(by, sizeof by, "scheme=%s", scheme != NULL ? scheme : "");
    solver_scene_free(sample->scene);
    if (!solver_scene_load(path, overrides, count, &sample->scene, error)) {
        return false;
    }
    sample->scene->threads = threads; /* by no override, which the record would show */
    sample->scene->history = 1 << 30;
    sample->scene->cfl *= 0.25; /* so that no scene is at its end too soon */
    return verify_run_create(sample->scene, &sample->run, error);
}

static void finish(struct sample *sample)
{
    solver_run_free(sample->run);
    solver_scene_free(sample->scene);
}

/* The second half of the way, by a run that knows nothing but the checkpoint. */
static struct run_bytes go_on(const char *path, const char *scheme)
{
    struct sample sample;
    struct solver_checkpoint *checkpoint;
    struct solver_error error = {.text = ""};
    CU_ASSERT_FATAL(begin(path, scheme, 2, &sample, &error));
    CU_ASSERT_FATAL(solver_checkpoint_read(checkpoint_path, &checkpoint, &error));
    bool restored = solver_checkpoint_restore(checkpoint, sample.run, &error);
    if (!restored) {
        (void)printf("\n    %s", error.text);
    }
    CU_ASSERT_FATAL(restored);
    solver_checkpoint_free(checkpoint);
    CU_ASSERT_EQUAL(solver_run_facts(sample.run).steps, HALF);
    CU_ASSERT_FATAL(run_to_step(sample.scene, sample.run, 2 * HALF, &error));
    struct run_bytes bytes = run_bytes_of(sample.scene, sample.run);
    finish(&sample);
    return bytes;
}

/* False where the run does not come so far. */
static bool compare(struct sample *sample, const char *path, const char *scheme, struct solver_error *error)
{
    static const struct solver_checkpoint_about about = {"", "", "", "", "", "", NULL, NULL, 0.0, 0.0, 0, 0};
    if (!run_to_step(sample->scene, sample->run, HALF, error)) {
        return false;
    }
    CU_ASSERT_FATAL(solver_checkpoint_write(checkpoint_path, sample->run, &about, error));
    if (!run_to_step(sample->scene, sample->run, 2 * HALF, error)) {
        return false;
    }
    struct run_bytes straight = run_bytes_of(sample->scene, sample->run), resumed = go_on(path, scheme);
    bool equal = run_bytes_same(&straight, &resumed);
    if (!equal) {
        (void)printf("\n    %s, scheme = %s: other bytes from the checkpoint on", path, sample->scene->scheme);
    }
    CU_ASSERT(equal);
    CU_ASSERT(solver_run_history(sample->run)->count > HALF);
    free(straight.record);
    free(resumed.record);
    return true;
}

/* Whether the scene can be had by the scheme; if so it has been compared. `own` becomes that which it was run by, or ""
 * if it starts from its oracle, which may take a while to solve for. */
static bool try(const char *path, const char *scheme, char own[SOLVER_NAME], struct solver_error *error)
{
    struct sample sample;
    bool taken = begin(path, scheme, 1, &sample, error) && compare(&sample, path, scheme, error);
    bool solved = taken && strcmp(sample.scene->initial_from, "oracle") == 0;
    (void)snprintf(own, SOLVER_NAME, "%s", taken && !solved ? sample.scene->scheme : "");
    finish(&sample);
    return taken;
}

static void every_scene(void)
{
    static struct verify_scenes scenes;
    struct solver_error error;
    size_t others = 0;
    CU_ASSERT_FATAL(verify_scenes_list(&scenes, &error));
    CU_ASSERT(scenes.count > 0);
    for (size_t i = 0; i < scenes.count; i++) {
        char path[VERIFY_PATH], own[SOLVER_NAME], other[SOLVER_NAME];
        CU_ASSERT_FATAL(verify_path_join(path, scenes.folder, scenes.name[i], ".lua", &error));
        bool taken = try(path, NULL, own, &error);
        if (!taken) {
            (void)printf("\n    %s: %s", scenes.name[i], error.text);
        }
        CU_ASSERT(taken);
        for (const struct solver_scheme *const *scheme = solver_schemes(); *scheme != NULL; scheme++) {
            bool another = own[0] != '\0' && strcmp((*scheme)->name, own) != 0;
            others += another && try(path, (*scheme)->name, other, &error) ? 1 : 0;
        }
    }
    CU_ASSERT(others > 0);
}

/* One that was made by other hands, by steps that no history notes: at the end nobody would know by how much the energy
 * has changed. */
static void without_history(void)
{
    static const struct solver_checkpoint_about about = {"", "", "", "", "", "", NULL, NULL, 0.0, 0.0, 0, 0};
    static struct verify_scenes scenes;
    char path[VERIFY_PATH];
    struct sample sample;
    struct verify_keeping keeping = {.from = NULL};
    struct solver_run *run = NULL;
    struct solver_error error;
    CU_ASSERT_FATAL(verify_scenes_list(&scenes, &error));
    CU_ASSERT_FATAL(verify_path_join(path, scenes.folder, "elastic-cable", ".lua", &error));
    CU_ASSERT_FATAL(begin(path, NULL, 1, &sample, &error) && solver_run_steps(sample.run, 3, &error));
    CU_ASSERT_FATAL(solver_checkpoint_write(checkpoint_path, sample.run, &about, &error));
    CU_ASSERT_FATAL(solver_checkpoint_read(checkpoint_path, &keeping.from, &error));
    CU_ASSERT_FALSE(verify_simulate_kept(sample.scene, folder, "", &keeping, &run, &error));
    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "cannot go on from step 3: the checkpoint's history has no row"));
    solver_run_free(run);
    solver_checkpoint_free(keeping.from);
    finish(&sample);
}

/* A folder of results that is gone when the run is over is made again. */
static void vanished(void)
{
    static struct verify_scenes scenes;
    char path[VERIFY_PATH], gone[SCRATCH_BELOW];
    struct sample sample;
    struct solver_error error = {.text = ""};
    (void)snprintf(gone, sizeof gone, "%s/gone", folder);
    CU_ASSERT_FATAL(verify_scenes_list(&scenes, &error));
    CU_ASSERT_FATAL(verify_path_join(path, scenes.folder, "elastic-cable", ".lua", &error));
    CU_ASSERT_FATAL(begin(path, NULL, 1, &sample, &error) && run_to_step(sample.scene, sample.run, 1, &error));
    CU_ASSERT(verify_record(sample.scene, sample.run, gone, "cable", "", path, &error));
    CU_ASSERT_EQUAL(access(path, R_OK), 0);
    finish(&sample);
}

int main(void)
{
    static const struct unit_test tests[] = {{"every scene goes on as if nothing had happened", every_scene},
                                             {"a checkpoint without history", without_history},
                                             {"a folder that has vanished", vanished}};
    scratch_folder(folder);
    (void)snprintf(checkpoint_path, sizeof checkpoint_path, "%s/run.checkpoint", folder);
    int result = unit_main("checkpoints of scenes", tests, sizeof tests / sizeof *tests);
    scratch_folder_remove(folder);
    return result;
}
