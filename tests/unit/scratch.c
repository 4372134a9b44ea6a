#include "tests/unit/scratch.h"

#include <dirent.h>
#include <errno.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static _Noreturn void give_up(const char *path)
{
    (void)fprintf(stderr, "%s: %s\n", path, strerror(errno));
    exit(2);
}

/* A name to be made unique, without symbolic links on the way. */
static void name(char path[SCRATCH])
{
    const char *wanted = getenv("TMPDIR");
    char *folder = realpath(wanted != NULL && *wanted != '\0' ? wanted : P_tmpdir, NULL);
    int length = folder != NULL ? snprintf(path, SCRATCH, "%s/assay-XXXXXX", folder) : -1;
    free(folder);
    if (length >= SCRATCH) {
        errno = ENAMETOOLONG;
    }
    if (length < 0 || length >= SCRATCH) {
        give_up("TMPDIR");
    }
}

void scratch_folder(char path[SCRATCH])
{
    name(path);
    if (mkdtemp(path) == NULL) {
        give_up(path);
    }
}

/* Folders in it are entered, links are not followed. */
void scratch_folder_remove(const char *path)
{
    DIR *folder = opendir(path);
    if (folder == NULL) {
        give_up(path);
    }
    for (struct dirent *entry = readdir(folder); entry != NULL; entry = readdir(folder)) {
        char below[2 * SCRATCH_BELOW];
        bool itself = strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0;
        if (!itself && snprintf(below, sizeof below, "%s/%s", path, entry->d_name) >= (int)sizeof below) {
            errno = ENAMETOOLONG;
            give_up(path);
        }
        if (!itself && unlink(below) != 0) { /* a folder */
            scratch_folder_remove(below);
        }
    }
    (void)closedir(folder);
    if (rmdir(path) != 0) {
        give_up(path);
    }
}

static int make_file(char path[SCRATCH])
{
    name(path);
    int descriptor = mkstemp(path);
    if (descriptor < 0) {
        give_up(path);
    }
    return descriptor;
}

void scratch_file(char path[SCRATCH])
{
    (void)close(make_file(path));
}

void scratch_text(char path[SCRATCH], const char *format, ...)
{
    FILE *file = fdopen(make_file(path), "w");
    va_list arguments;
    va_start(arguments, format);
    bool written = file != NULL && vfprintf(file, format, arguments) >= 0 && fclose(file) == 0;
    va_end(arguments);
    if (!written) {
        give_up(path);
    }
}
