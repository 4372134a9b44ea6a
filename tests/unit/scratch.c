#define _XOPEN_SOURCE 700 // nftw

#include "tests/unit/scratch.h"

#include <errno.h>
#include <ftw.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void give_up(const char *path)
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

static int remove_one(const char *path, const struct stat *about, int kind, struct FTW *at)
{
    (void)about;
    (void)kind;
    (void)at;
    return remove(path);
}

void scratch_folder_remove(const char *path)
{
    if (nftw(path, remove_one, 8, FTW_DEPTH | FTW_PHYS) != 0) {
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
