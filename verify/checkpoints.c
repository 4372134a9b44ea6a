#include "verify/checkpoints.h"

#include "solver/file.h"
#include "verify/signals.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static double now(void)
{
    struct timespec at;
    (void)clock_gettime(CLOCK_MONOTONIC, &at);
    return (double)at.tv_sec + 1e-9 * (double)at.tv_nsec;
}

bool verify_checkpoints_begin(struct verify_checkpoints *checkpoints, const struct solver_scene *scene,
                              const char *folder, const char *command, const struct solver_checkpoint *from,
                              struct solver_error *error)
{
    double begun = now();
    char *file = from == NULL ? realpath(scene->path, NULL) : NULL;
    *checkpoints = (struct verify_checkpoints){.scene = scene,
                                               .command = command,
                                               .folder = folder,
                                               .resumed = from != NULL,
                                               .begun = begun,
                                               .written = begun};
    (void)snprintf(checkpoints->file, sizeof checkpoints->file, "%s",
                   from != NULL   ? solver_checkpoint_about(from)->scene_file
                   : file != NULL ? file
                                  : scene->path);
    free(file);
    if (!verify_path_join(checkpoints->path, folder, scene->name, ".checkpoint", error)) {
        return false;
    }
    solver_file_sweep(checkpoints->path);
    return true;
}

bool verify_checkpoints_due(const struct verify_checkpoints *checkpoints, size_t step)
{
    const struct verify_pace *every = &checkpoints->every;
    return (every->steps > 0 && step % every->steps == 0) ||
           (every->seconds > 0.0 && now() - checkpoints->written >= every->seconds);
}

bool verify_checkpoints_write(struct verify_checkpoints *checkpoints, const struct solver_run *run,
                              struct solver_error *error)
{
    const struct solver_scene *scene = checkpoints->scene;
    const struct solver_checkpoint_about about = {
        .scene_path = scene->path,
        .scene_file = checkpoints->file,
        .scene_text = scene->text,
        .overrides = scene->overrides,
        .command = checkpoints->command,
        .version = ASSAY_VERSION,
        .every_seconds = checkpoints->every.seconds,
        .every_steps = checkpoints->every.steps,
    };
    bool done = verify_folder_make(checkpoints->folder, error) &&
                solver_checkpoint_write(checkpoints->path, run, &about, error);
    checkpoints->written = now();
    if (done) {
        checkpoints->there = true;
        checkpoints->step = solver_run_facts(run).steps;
    }
    return done;
}

/* A word as a shell wants it; false if there is no room for it. */
static bool quote(char *out, size_t room, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
    const char *mark = word[strspn(word, plain)] != '\0' ? "'" : "";
    size_t used = (size_t)snprintf(out, room, "%s", mark);
    for (const char *c = word; *c != '\0' && used < room; c++) {
        used += (size_t)snprintf(out + used, room - used, *c == '\'' ? "'\\''" : "%c", *c);
    }
    return used < room && used + (size_t)snprintf(out + used, room - used, "%s", mark) < room;
}

static void say_how(const struct verify_checkpoints *checkpoints, struct solver_error *error)
{
    char path[512];
    size_t used = strlen(error->text);
    bool fits = quote(path, sizeof path, checkpoints->path);
    (void)snprintf(error->text + used, sizeof error->text - used, "; assay run --restart %s goes on from step %zu",
                   fits ? path : "with the checkpoint beside its results", checkpoints->step);
}

bool verify_checkpoints_stop(struct verify_checkpoints *checkpoints, const struct solver_run *run, double time,
                             int number, struct solver_error *error)
{
    const struct verify_pace *every = &checkpoints->every;
    struct solver_error why = {.code = SOLVER_OK};
    bool worth = every->steps > 0 || every->seconds > 0.0 || checkpoints->resumed ||
                 now() - checkpoints->begun >= VERIFY_WORTH_KEEPING;
    (void)solver_fail(error, SOLVER_STOPPED, "%s: stopped by %s at step %zu, t = %.6g s of %.6g s",
                      checkpoints->scene->name, verify_signals_name(number), solver_run_facts(run).steps, time,
                      checkpoints->scene->t_end);
    size_t used = strlen(error->text);
    if (!worth) {
        (void)snprintf(error->text + used, sizeof error->text - used,
                       "; nothing is kept of a run of less than %g s unless --checkpoint asks for it",
                       VERIFY_WORTH_KEEPING);
        return false;
    }
    if (!verify_checkpoints_write(checkpoints, run, &why)) {
        (void)snprintf(error->text + used, sizeof error->text - used, "; %.200s", why.text);
    }
    if (checkpoints->there) {
        say_how(checkpoints, error);
    }
    return false;
}
