#include "solver/file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool write_all(int fd, const char *bytes, size_t size)
{
    while (size > 0) {
        ssize_t written = write(fd, bytes, size);
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written <= 0) {
            return false;
        }
        bytes += written;
        size -= (size_t)written;
    }
    return true;
}

static int create_beside(const char *staged)
{
    const int flags = O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC;
    int fd = open(staged, flags, 0666);
    if (fd < 0 && errno == EEXIST) { /* left by a killed process that had our number */
        (void)unlink(staged);
        fd = open(staged, flags, 0666);
    }
    return fd;
}

bool solver_file_stage_parts(const char *path, const struct solver_file_part *part, size_t count,
                             char staged[SOLVER_FILE_PATH], struct solver_error *error)
{
    int length = snprintf(staged, SOLVER_FILE_PATH, "%s.partial-%ld", path, (long)getpid());
    if (length < 0 || length >= SOLVER_FILE_PATH) {
        return solver_fail(error, SOLVER_IO, "cannot write %.200s...: the path is longer than 4096 bytes", path);
    }
    int fd = create_beside(staged);
    if (fd < 0) {
        return solver_fail(error, SOLVER_IO, "cannot write %.600s: %s (creating a file in its folder)", path,
                           strerror(errno));
    }
    bool written = true;
    size_t size = 0;
    for (size_t i = 0; i < count; i++) {
        written = written && write_all(fd, part[i].bytes, part[i].size);
        size += part[i].size;
    }
    written = written && fsync(fd) == 0;
    int why = errno;
    if (close(fd) != 0 && written) {
        written = false;
        why = errno;
    }
    if (!written) {
        (void)unlink(staged);
        return solver_fail(error, SOLVER_IO, "cannot write %.600s: %s (%zu bytes are needed); what was there is kept",
                           path, strerror(why), size);
    }
    return true;
}

bool solver_file_stage(const char *path, const void *bytes, size_t size, char staged[SOLVER_FILE_PATH],
                       struct solver_error *error)
{
    return solver_file_stage_parts(path, &(struct solver_file_part){bytes, size}, 1, staged, error);
}

static void folder_of(const char *path, char folder[SOLVER_FILE_PATH])
{
    (void)snprintf(folder, SOLVER_FILE_PATH, "%s", path);
    char *slash = strrchr(folder, '/');
    if (slash == NULL) {
        (void)snprintf(folder, SOLVER_FILE_PATH, ".");
    } else {
        slash[slash == folder ? 1 : 0] = '\0';
    }
}

/* The rename itself must survive a power cut; a file system that cannot flush a folder is no reason to fail. */
static void flush_folder(const char *path)
{
    char folder[SOLVER_FILE_PATH];
    folder_of(path, folder);
    int fd = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd >= 0) {
        (void)fsync(fd);
        (void)close(fd);
    }
}

bool solver_file_commit(const char staged[SOLVER_FILE_PATH], const char *path, struct solver_error *error)
{
    if (rename(staged, path) != 0) {
        int why = errno;
        (void)unlink(staged);
        return solver_fail(error, SOLVER_IO, "cannot write %.600s: %s", path, strerror(why));
    }
    flush_folder(path);
    return true;
}

bool solver_file_replace(const char *path, const void *bytes, size_t size, struct solver_error *error)
{
    char staged[SOLVER_FILE_PATH];
    return solver_file_stage(path, bytes, size, staged, error) && solver_file_commit(staged, path, error);
}

/* The process that staged the file of this name for `base`; 0: the name is none of those. */
static long writer_of(const char *name, const char *base)
{
    static const char part[] = ".partial-";
    size_t length = strlen(base);
    char *end = NULL;
    if (strncmp(name, base, length) != 0 || strncmp(name + length, part, sizeof part - 1) != 0) {
        return 0;
    }
    long number = strtol(name + length + sizeof part - 1, &end, 10);
    return *end == '\0' && number > 0 ? number : 0;
}

void solver_file_sweep(const char *path)
{
    char folder[SOLVER_FILE_PATH];
    const char *slash = strrchr(path, '/');
    folder_of(path, folder);
    DIR *open_folder = opendir(folder);
    for (struct dirent *entry = NULL; open_folder != NULL && (entry = readdir(open_folder)) != NULL;) {
        long writer = writer_of(entry->d_name, slash != NULL ? slash + 1 : path);
        if (writer > 0 && kill((pid_t)writer, 0) != 0 && errno == ESRCH) {
            (void)unlinkat(dirfd(open_folder), entry->d_name, 0);
        }
    }
    if (open_folder != NULL) {
        (void)closedir(open_folder);
    }
}
