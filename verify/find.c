#include "verify/find.h"

#include "solver/suggest.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char ending[] = ".lua";
enum { ENDING = sizeof ending - 1 };

static bool ends_in_lua(const char *name)
{
    size_t length = strlen(name);
    return length > ENDING && strcmp(name + length - ENDING, ending) == 0;
}

static const struct {
    const char *installed, *source;
} folders[] = {
    [VERIFY_FOLDER_SCENES] = {"scenes", "verify/scenes"},
    [VERIFY_FOLDER_GOLDEN] = {"golden", "golden"},
};

bool verify_folder_installed(enum verify_folder which, const char *program, char folder[VERIFY_PATH])
{
    static const char bin[] = "/" ASSAY_BIN;
    const char *slash = strrchr(program, '/');
    size_t length = slash != NULL ? (size_t)(slash - program) : 0;
    /* Not so in a build tree, which must not see what may be installed beside it. */
    if (length < sizeof bin - 1 || memcmp(program + length - (sizeof bin - 1), bin, sizeof bin - 1) != 0) {
        return false;
    }
    char path[VERIFY_PATH];
    int written =
        snprintf(path, VERIFY_PATH, "%.*s/%s/%s", (int)length, program, ASSAY_SHARE, folders[which].installed);
    return written < VERIFY_PATH && realpath(path, folder) != NULL;
}

static bool is_there(const char *root, enum verify_folder which, char folder[VERIFY_PATH])
{
    struct stat status;
    int length = snprintf(folder, VERIFY_PATH, "%s/%s", root, folders[which].source);
    return length < VERIFY_PATH && stat(folder, &status) == 0;
}

void verify_folder_find(enum verify_folder which, char folder[VERIFY_PATH])
{
    char program[VERIFY_PATH];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = '\0';
    if (!verify_folder_installed(which, program, folder) && !is_there(ASSAY_SOURCE_DIR, which, folder)) {
        (void)is_there(".", which, folder);
    }
}

static int by_name(const void *a, const void *b)
{
    return strcmp(a, b);
}

bool verify_scenes_list(struct verify_scenes *scenes, struct solver_error *error)
{
    scenes->count = 0;
    verify_folder_find(VERIFY_FOLDER_SCENES, scenes->folder);
    DIR *folder = opendir(scenes->folder);
    if (folder == NULL) {
        return solver_fail(error, SOLVER_IO,
                           "%s: cannot read the folder of scenes; install the program whole, start it where the source "
                           "lies, or give the path of a .lua file",
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
    const char *meant = solver_suggest(word, names, scenes->count);
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

/* A folder in the place of a result would be noticed when there is one. */
static bool nothing_in_the_way(const char *folder, const char *scene_name, struct solver_error *error)
{
    static const char *const endings[] = {".vtkhdf", ".xdmf", ".png"};
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        char path[VERIFY_PATH];
        struct stat status;
        if (!verify_path_join(path, folder, scene_name, endings[i], error)) {
            return false;
        }
        if (stat(path, &status) == 0 && S_ISDIR(status.st_mode)) {
            return solver_fail(error, SOLVER_IO, "%.400s: is a folder, and a result is to be written there", path);
        }
    }
    return true;
}

bool verify_out_folder(const struct verify_options *options, const char *scene_name, char folder[VERIFY_PATH],
                       struct solver_error *error)
{
    int length = options->out != NULL ? snprintf(folder, VERIFY_PATH, "%s", options->out)
                                      : snprintf(folder, VERIFY_PATH, "out/%s", scene_name);
    if (length >= VERIFY_PATH) {
        return solver_fail(error, SOLVER_BAD_INPUT, "--out: the path is too long");
    }
    return verify_folder_make(folder, error) && nothing_in_the_way(folder, scene_name, error);
}
