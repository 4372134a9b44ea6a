#include "solver/keep.h"

#include "solver/file.h"
#include "solver/seal.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MAGIC = 32, WORD = 8 };

static size_t filled(size_t size)
{
    return (size + WORD - 1) / WORD * WORD;
}

bool solver_keep_refuse(const struct solver_keeper *keeper, struct solver_error *error, const char *format, ...)
{
    char what[512];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return solver_fail(error, SOLVER_BAD_INPUT, "cannot go on from %.400s: %s", keeper->path, what);
}

/* --- writing --- */

void solver_keep_begin(struct solver_keeper *keeper, const char *path)
{
    *keeper = (struct solver_keeper){.path = path};
}

static bool add(struct solver_keeper *keeper, const char *name, const void *data, size_t width, size_t count,
                struct solver_error *error)
{
    struct solver_keep_head *head = &keeper->head[keeper->count];
    if (keeper->count == SOLVER_KEEP_BLOCKS || strlen(name) >= sizeof head->name) {
        return solver_fail(error, SOLVER_IO, "cannot write %.400s: no place for the block \"%s\" after %zu others",
                           keeper->path, name, keeper->count);
    }
    head->width = width;
    head->count = count;
    memcpy(head->name, name, strlen(name));
    keeper->data[keeper->count++] = data;
    return true;
}

bool solver_keep_write(const struct solver_keeper *keeper, struct solver_error *error)
{
    static const char zeros[WORD];
    static const char magic[MAGIC] = SOLVER_KEEP_MAGIC;
    struct solver_file_part part[3 * SOLVER_KEEP_BLOCKS + 2] = {{magic, MAGIC}};
    unsigned char seal[SOLVER_SEAL_SIZE];
    char staged[SOLVER_FILE_PATH];
    uint64_t sum = solver_seal_sum(SOLVER_SEAL_SEED, magic, MAGIC);
    size_t parts = 1;
    for (size_t i = 0; i < keeper->count; i++) {
        size_t size = keeper->head[i].width * keeper->head[i].count;
        sum = solver_seal_sum(sum, &keeper->head[i], sizeof keeper->head[i]);
        sum = solver_seal_sum(sum, keeper->data[i], size);
        part[parts++] = (struct solver_file_part){&keeper->head[i], sizeof keeper->head[i]};
        part[parts++] = (struct solver_file_part){keeper->data[i], size};
        part[parts++] = (struct solver_file_part){zeros, filled(size) - size};
    }
    memcpy(seal, SOLVER_SEAL, sizeof sum);
    memcpy(seal + sizeof sum, &sum, sizeof sum);
    part[parts++] = (struct solver_file_part){seal, sizeof seal};
    return solver_file_stage_parts(keeper->path, part, parts, staged, error) &&
           solver_file_commit(staged, keeper->path, error);
}

/* --- reading --- */

static bool read_all(int fd, unsigned char *bytes, size_t size)
{
    while (size > 0) {
        ssize_t got = read(fd, bytes, size);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got <= 0) {
            return false;
        }
        bytes += got;
        size -= (size_t)got;
    }
    return true;
}

/* Takes what is open as `fd` into memory. */
static bool load(struct solver_keeper *keeper, int fd, struct solver_error *error)
{
    struct stat about;
    if (fstat(fd, &about) != 0) {
        return solver_fail(error, SOLVER_IO, "cannot read %.400s: %s", keeper->path, strerror(errno));
    }
    if (!S_ISREG(about.st_mode)) {
        return solver_keep_refuse(keeper, error, "it is %s; expected a checkpoint",
                                  S_ISDIR(about.st_mode) ? "a folder" : "not a plain file");
    }
    keeper->size = (size_t)about.st_size;
    keeper->bytes = malloc(keeper->size + 1);
    if (keeper->bytes == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "cannot read %.400s: no memory for its %zu bytes", keeper->path,
                           keeper->size);
    }
    return read_all(fd, keeper->bytes, keeper->size) ||
           solver_fail(error, SOLVER_IO, "cannot read %.400s: %s", keeper->path, strerror(errno));
}

/* Magic and seal. */
static bool check(struct solver_keeper *keeper, struct solver_error *error)
{
    static const char kind[] = "assay checkpoint ";
    static const char magic[MAGIC] = SOLVER_KEEP_MAGIC;
    if (keeper->size < sizeof kind - 1 || memcmp(keeper->bytes, kind, sizeof kind - 1) != 0) {
        return solver_keep_refuse(keeper, error, "it is no checkpoint that assay wrote (%zu bytes)", keeper->size);
    }
    size_t end = keeper->size - SOLVER_SEAL_SIZE;
    bool whole = keeper->size >= MAGIC + SOLVER_SEAL_SIZE && keeper->size % WORD == 0 &&
                 memcmp(keeper->bytes + end, SOLVER_SEAL, WORD) == 0;
    uint64_t sum = whole ? solver_seal_sum(SOLVER_SEAL_SEED, keeper->bytes, end) : 0;
    if (!whole || memcmp(keeper->bytes + end + WORD, &sum, sizeof sum) != 0) {
        return solver_keep_refuse(keeper, error,
                                  "it is cut short, damaged, or changed since it was written: its %zu bytes do not end "
                                  "with their checksum",
                                  keeper->size);
    }
    if (memcmp(keeper->bytes, magic, MAGIC) != 0) {
        return solver_keep_refuse(keeper, error, "it is a checkpoint of another kind; this program reads \"%.*s\"",
                                  (int)strcspn(magic, "\n"), magic);
    }
    keeper->size = end;
    keeper->at = MAGIC;
    return true;
}

bool solver_keep_open(struct solver_keeper *keeper, const char *path, struct solver_error *error)
{
    *keeper = (struct solver_keeper){.path = path, .reads = true};
    int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK); /* a pipe without a writer must not hang us */
    if (fd < 0) {
        return solver_fail(error, SOLVER_IO, "cannot read %.400s: %s", path, strerror(errno));
    }
    bool good = load(keeper, fd, error) && check(keeper, error);
    (void)close(fd);
    if (!good) {
        solver_keep_close(keeper);
    }
    return good;
}

void solver_keep_close(struct solver_keeper *keeper)
{
    free(keeper->bytes);
    *keeper = (struct solver_keeper){.path = keeper->path};
}

/* Where the entries of the next block lie, which must have that name; NULL: it is refused. */
static const void *next_block(struct solver_keeper *keeper, const char *name, struct solver_keep_head *head,
                              struct solver_error *error)
{
    size_t left = keeper->size - keeper->at;
    *head = (struct solver_keep_head){.width = 0};
    if (left < sizeof *head) {
        (void)solver_keep_refuse(keeper, error, "it has no \"%s\"", name);
        return NULL;
    }
    memcpy(head, keeper->bytes + keeper->at, sizeof *head);
    if (strncmp(head->name, name, sizeof head->name) != 0) {
        (void)solver_keep_refuse(keeper, error, "it has \"%.47s\" where \"%s\" was expected", head->name, name);
        return NULL;
    }
    left -= sizeof *head;
    if (head->width > 0 && (head->count > left / head->width || filled(head->width * head->count) > left)) {
        (void)solver_keep_refuse(keeper, error, "its \"%s\" claims %llu entries of %llu bytes, and %zu bytes are there",
                                 name, (unsigned long long)head->count, (unsigned long long)head->width, left);
        return NULL;
    }
    const void *entries = keeper->bytes + keeper->at + sizeof *head;
    keeper->at += sizeof *head + filled(head->width * head->count);
    return entries;
}

/* The same of a block that must have so many entries of that width. */
static const void *expect(struct solver_keeper *keeper, const char *name, size_t width, size_t count,
                          struct solver_error *error)
{
    struct solver_keep_head head;
    const void *entries = next_block(keeper, name, &head, error);
    if (entries != NULL && (head.width != width || head.count != count)) {
        (void)solver_keep_refuse(keeper, error,
                                 "its \"%s\" has %llu entries of %llu bytes, and the scene as this program runs it %zu "
                                 "of %zu",
                                 name, (unsigned long long)head.count, (unsigned long long)head.width, count, width);
        return NULL;
    }
    return entries;
}

bool solver_keep_peek(struct solver_keeper *keeper, const char *name, const void **data, size_t *size,
                      struct solver_error *error)
{
    struct solver_keep_head head;
    *data = next_block(keeper, name, &head, error);
    *size = head.width * head.count;
    return *data != NULL;
}

bool solver_keep(struct solver_keeper *keeper, const char *name, void *data, size_t width, size_t count,
                 struct solver_error *error)
{
    if (!keeper->reads) {
        return add(keeper, name, data, width, count, error);
    }
    const void *found = expect(keeper, name, width, count, error);
    if (found != NULL && width * count > 0) {
        memcpy(data, found, width * count);
    }
    return found != NULL;
}

bool solver_keep_same(struct solver_keeper *keeper, const char *name, const void *data, size_t width, size_t count,
                      struct solver_error *error)
{
    if (!keeper->reads) {
        return add(keeper, name, data, width, count, error);
    }
    const void *found = expect(keeper, name, width, count, error);
    return found != NULL && (memcmp(data, found, width * count) == 0 ||
                             solver_keep_refuse(keeper, error, "its \"%s\" are not as this program has them", name));
}

bool solver_keep_end(const struct solver_keeper *keeper, struct solver_error *error)
{
    return keeper->at == keeper->size ||
           solver_keep_refuse(keeper, error, "it holds %zu bytes more than the run has", keeper->size - keeper->at);
}
