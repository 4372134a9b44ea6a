#include "verify/restart.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool check_version(const char *path, const struct solver_checkpoint_about *about, struct solver_error *error)
{
    return strcmp(about->version, ASSAY_VERSION) == 0 ||
           solver_fail(error, SOLVER_BAD_INPUT,
                       "cannot go on from %.400s: assay %.32s wrote it, and this is assay " ASSAY_VERSION
                       ", whose steps may differ; go on with the one that wrote it",
                       path, about->version);
}

/* The scene is in the checkpoint; its file, where it is still there, should say the same. */
static bool check_file(const struct verify_options *options, const struct solver_checkpoint_about *about,
                       struct solver_error *error)
{
    char *now = NULL;
    size_t size = 0;
    struct solver_error unread;
    if (options->as_stored || access(about->scene_file, R_OK) != 0) {
        return true;
    }
    bool same = verify_file_read(about->scene_file, &now, &size, &unread) && size == strlen(about->scene_text) &&
                memcmp(now, about->scene_text, size) == 0;
    free(now);
    return same ||
           solver_fail(error, SOLVER_BAD_INPUT,
                       "%.400s: has changed since the run began that %.200s is of; --as-stored goes on with the "
                       "scene as it was",
                       about->scene_file, options->restart);
}

/* Splits a copy of "KEY=value\n" lines in place. */
static bool split(char *lines, const struct verify_options *options, const char *override[2 * VERIFY_OVERRIDES],
                  size_t *count, struct solver_error *error)
{
    char *rest = NULL;
    *count = 0;
    for (char *line = strtok_r(lines, "\n", &rest); line != NULL; line = strtok_r(NULL, "\n", &rest)) {
        if (*count == VERIFY_OVERRIDES) {
            return solver_fail(error, SOLVER_BAD_INPUT, "cannot go on from %.400s: it holds more than %d overrides",
                               options->restart, VERIFY_OVERRIDES);
        }
        override[(*count)++] = line;
    }
    for (size_t i = 0; i < options->override_count; i++) {
        if (strncmp(options->override[i], "threads=", strlen("threads=")) != 0) {
            return solver_fail(error, SOLVER_BAD_INPUT,
                               "--set %.200s: a run that goes on is the run that began; only threads may be set anew",
                               options->override[i]);
        }
        override[(*count)++] = options->override[i];
    }
    return true;
}

/* With the threads of this command line, and the overrides of the first. */
static bool open_scene(const struct verify_options *options, const struct solver_checkpoint_about *about,
                       struct solver_scene **scene, struct solver_error *error)
{
    const char *override[2 * VERIFY_OVERRIDES];
    size_t count = 0;
    char *lines = strdup(about->overrides), *kept = strdup(about->overrides);
    bool done = (lines != NULL && kept != NULL) ||
                solver_fail(error, SOLVER_NO_MEMORY, "no memory for the overrides of %.400s", options->restart);
    done = done && split(lines, options, override, &count, error) &&
           solver_scene_load_text(about->scene_path, about->scene_text, override, count, scene, error);
    if (done) {
        free((*scene)->overrides);
        (*scene)->overrides = kept;
        kept = NULL;
    }
    free(lines);
    free(kept);
    return done;
}

bool verify_restart_open(const struct verify_options *options, struct solver_scene **scene,
                         struct verify_keeping *keeping, char line[VERIFY_COMMAND_LINE], struct solver_error *error)
{
    if (!solver_checkpoint_read(options->restart, &keeping->from, error)) {
        return false;
    }
    const struct solver_checkpoint_about *about = solver_checkpoint_about(keeping->from);
    if (!check_version(options->restart, about, error) || !check_file(options, about, error) ||
        !open_scene(options, about, scene, error)) {
        return false;
    }
    if (keeping->every.steps == 0 && keeping->every.seconds == 0.0) {
        keeping->every = (struct verify_pace){about->every_steps, about->every_seconds};
    }
    (void)snprintf(line, VERIFY_COMMAND_LINE, "%s", about->command);
    return true;
}

bool verify_restart_folder(const struct verify_options *options, char folder[VERIFY_PATH], struct solver_error *error)
{
    const char *slash = strrchr(options->restart, '/');
    int length = options->out != NULL ? snprintf(folder, VERIFY_PATH, "%s", options->out)
                 : slash == NULL      ? snprintf(folder, VERIFY_PATH, ".")
                 : slash == options->restart
                     ? snprintf(folder, VERIFY_PATH, "/")
                     : snprintf(folder, VERIFY_PATH, "%.*s", (int)(slash - options->restart), options->restart);
    if (length >= VERIFY_PATH) {
        return solver_fail(error, SOLVER_BAD_INPUT, "--out: the path is too long");
    }
    return verify_folder_make(folder, error);
}
