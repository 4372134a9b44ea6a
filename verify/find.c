#include "verify/find.h"

#include "verify/suggest.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const char ending[] = ".lua";
enum { ENDING = sizeof ending - 1 };

static bool ends_in_lua(const char *name)
{
    size_t length = strlen(name);
    return length > ENDING && strcmp(name + length - ENDING, ending) == 0;
}

void verify_source_folder(const char *name, char folder[VERIFY_PATH])
{
    struct stat status;
    int length = snprintf(folder, VERIFY_PATH, "%s/%s", ASSAY_SOURCE_DIR, name);
    if (length >= VERIFY_PATH || stat(folder, &status) != 0) {
        (void)snprintf(folder, VERIFY_PATH, "./%s", name);
    }
}

static int by_name(const void *a, const void *b)
{
    return strcmp(a, b);
}

bool verify_scenes_list(struct verify_scenes *scenes, struct solver_error *error)
{
    scenes->count = 0;
    verify_source_folder("verify/scenes", scenes->folder);
    DIR *folder = opendir(scenes->folder);
    if (folder == NULL) {
        return solver_fail(error, SOLVER_IO,
                           "%s: cannot read the folder of scenes; start the program where the source lies, or give the "
                           "path of a .lua file",
                           scenes->folder);
    }
    for (struct dirent *entry = readdir(folder); entry != NULL; entry = readdir(folder)) {
        size_t length = strlen(entry->d_name);
        bool fits = length - ENDING < SOLVER_NAME && scenes->count < VERIFY_SCENES;
        if (ends_in_lua(entry->d_name) && fits) {
            (void)snprintf(scenes->name[scenes->count++], SOLVER_NAME, "%.*s", (int)(length - ENDING), entry->d_name);
        }
    }
    (void)closedir(folder);
    qsort(scenes->name, scenes->count, sizeof scenes->name[0], by_name);
    return true;
}

static bool refuse(const char *word, const struct verify_scenes *scenes, struct solver_error *error)
{
    const char *names[VERIFY_SCENES];
    for (size_t i = 0; i < scenes->count; i++) {
        names[i] = scenes->name[i];
    }
    const char *meant = verify_suggest(word, names, scenes->count);
    if (meant != NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT, "there is no scene \"%.64s\" in %s; did you mean %s?", word,
                           scenes->folder, meant);
    }
    return solver_fail(error, SOLVER_BAD_INPUT,
                       "there is no scene \"%.64s\" in %s; assay list shows those there are, and the path of a .lua "
                       "file works too",
                       word, scenes->folder);
}

bool verify_scene_find(const char *word, char path[VERIFY_PATH], struct solver_error *error)
{
    if (strchr(word, '/') != NULL || ends_in_lua(word)) {
        if (snprintf(path, VERIFY_PATH, "%s", word) >= VERIFY_PATH) {
            return solver_fail(error, SOLVER_BAD_INPUT, "the path is too long: %.200s...", word);
        }
        return true; /* whether it can be read, the loader says */
    }
    static struct verify_scenes scenes;
    if (!verify_scenes_list(&scenes, error)) {
        return false;
    }
    for (size_t i = 0; i < scenes.count; i++) {
        if (strcmp(scenes.name[i], word) == 0) {
            return verify_path_join(path, scenes.folder, word, ending, error);
        }
    }
    return refuse(word, &scenes, error);
}

bool verify_scene_open(const struct verify_options *options, int n, struct solver_scene **scene,
                       struct solver_error *error)
{
    char path[VERIFY_PATH], level[32];
    const char *override[VERIFY_OVERRIDES];
    size_t count = options->override_count;
    memcpy(override, options->override, count * sizeof *override);
    if (n > 0) {
        (void)snprintf(level, sizeof level, "n=%d", n);
        override[count++] = level;
    }
    return verify_scene_find(options->operand[0], path, error) &&
           solver_scene_load(path, override, count, scene, error);
}

bool verify_out_folder(const struct verify_options *options, const char *scene_name, char folder[VERIFY_PATH],
                       struct solver_error *error)
{
    int length = options->out != NULL ? snprintf(folder, VERIFY_PATH, "%s", options->out)
                                      : snprintf(folder, VERIFY_PATH, "out/%s", scene_name);
    if (length >= VERIFY_PATH) {
        return solver_fail(error, SOLVER_BAD_INPUT, "--out: the path is too long");
    }
    return verify_folder_make(folder, error);
}
