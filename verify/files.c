#include "verify/files.h"

#include "solver/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool failed(struct solver_error *error, const char *verb, const char *path, int number)
{
    return solver_fail(error, SOLVER_IO, "%s: cannot %s: %s", path, verb, strerror(number));
}

/* A folder, a device or a link in place of the file is not replaced. */
static bool check_plain(const char *path, struct solver_error *error)
{
    struct stat status;
    return lstat(path, &status) != 0 || S_ISREG(status.st_mode) ||
           solver_fail(error, SOLVER_IO, "%s: is not a plain file; name another file to write to", path);
}

bool verify_file_check(const char *path, struct solver_error *error)
{
    char folder[VERIFY_PATH];
    const char *slash = strrchr(path, '/');
    int length = slash == NULL ? 1 : slash == path ? 1 : (int)(slash - path);
    if (length >= VERIFY_PATH) {
        return solver_fail(error, SOLVER_BAD_INPUT, "the path is too long: %.200s...", path);
    }
    (void)snprintf(folder, sizeof folder, "%.*s", length, slash == NULL ? "." : path);
    return check_plain(path, error) && (access(folder, W_OK | X_OK) == 0 || failed(error, "write", path, errno));
}

bool verify_file_write(const char *path, const void *bytes, size_t size, struct solver_error *error)
{
    return check_plain(path, error) && solver_file_replace(path, bytes, size, error);
}

static bool read_stream(FILE *file, const char *path, size_t size, char *bytes, struct solver_error *error)
{
    size_t got = fread(bytes, 1, size, file);
    if (got != size) {
        return solver_fail(error, SOLVER_IO, "%s: only %zu of %zu bytes could be read", path, got, size);
    }
    bytes[size] = '\0';
    return true;
}

bool verify_file_read(const char *path, char **bytes, size_t *size, struct solver_error *error)
{
    struct stat status;
    int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK); /* a pipe without a writer must not hang us */
    FILE *file = fd < 0 ? NULL : fdopen(fd, "rb");
    if (file == NULL || fstat(fd, &status) != 0) {
        int number = errno;
        if (file != NULL) {
            (void)fclose(file);
        } else if (fd >= 0) {
            (void)close(fd);
        }
        return failed(error, "read", path, number);
    }
    if (!S_ISREG(status.st_mode) || status.st_size > (1L << 30)) {
        (void)fclose(file);
        return solver_fail(error, SOLVER_IO, "%s: is not a plain file of at most 1 GiB", path);
    }
    *size = (size_t)status.st_size;
    *bytes = malloc(*size + 1);
    bool done = *bytes == NULL ? solver_fail(error, SOLVER_NO_MEMORY, "%s: no memory for its %zu bytes", path, *size)
                               : read_stream(file, path, *size, *bytes, error);
    if (!done) {
        free(*bytes);
        *bytes = NULL;
    }
    (void)fclose(file);
    return done;
}

bool verify_folder_make(const char *path, struct solver_error *error)
{
    char part[VERIFY_PATH];
    size_t length = strlen(path);
    if (length == 0 || length >= sizeof part) {
        return solver_fail(error, SOLVER_BAD_INPUT, "the folder name is empty or too long");
    }
    for (size_t i = 1; i <= length; i++) {
        if (path[i] != '/' && path[i] != '\0') {
            continue;
        }
        memcpy(part, path, i);
        part[i] = '\0';
        if (mkdir(part, 0777) != 0 && errno != EEXIST) {
            return failed(error, "make the folder", part, errno);
        }
    }
    struct stat status;
    if (stat(path, &status) != 0 || !S_ISDIR(status.st_mode)) {
        return solver_fail(error, SOLVER_IO, "%s: is not a folder", path);
    }
    return access(path, W_OK | X_OK) == 0 || failed(error, "write into the folder", path, errno);
}

bool verify_file_same(const char *one, const char *other)
{
    struct stat a, b;
    return stat(one, &a) == 0 && stat(other, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

bool verify_path_join(char *path, const char *folder, const char *name, const char *ending, struct solver_error *error)
{
    if (snprintf(path, VERIFY_PATH, "%s/%s%s", folder, name, ending) >= VERIFY_PATH) {
        return solver_fail(error, SOLVER_BAD_INPUT, "the path is too long: %.200s...", folder);
    }
    return true;
}
