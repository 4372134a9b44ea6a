/* What of a run outlives a step, block by block. One walk over the run names each block once (checkpoint.c, and what it
 * calls of every part that has something); walked one way the blocks are written, walked the other way they are put
 * back, so that what is written and what is read cannot come to differ.
 *
 * A file of blocks: SOLVER_KEEP_MAGIC, filled with zeros to 32 bytes; for each block its name, filled with zeros to 48
 * bytes, the bytes of one entry and how many entries there are, each as 8 bytes, and the entries, filled with zeros to
 * a multiple of 8; the seal (seal.h). */
#ifndef SOLVER_KEEP_H
#define SOLVER_KEEP_H

#include "solver/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define SOLVER_KEEP_MAGIC "assay checkpoint 2\n"

enum { SOLVER_KEEP_BLOCKS = 96 };

struct solver_keep_head {
    char name[48];
    uint64_t width, count; /* bytes of an entry, and entries, of what follows without the zeros that fill it up */
};

struct solver_keeper {
    const char *path; /* of the file, for messages; outlives the keeper */
    bool reads;
    /* Writing: the blocks so far, which stay where they are. */
    size_t count;
    struct solver_keep_head head[SOLVER_KEEP_BLOCKS];
    const void *data[SOLVER_KEEP_BLOCKS];
    /* Reading: the file, without its seal, and how far it has been read. */
    unsigned char *bytes;
    size_t size, at;
};

/* A keeper that collects blocks, which solver_keep_write then writes, whole or not at all. SOLVER_IO. */
void solver_keep_begin(struct solver_keeper *keeper, const char *path);
bool solver_keep_write(const struct solver_keeper *keeper, struct solver_error *error);

/* A keeper that reads. Refuses (SOLVER_BAD_INPUT) what is not a plain file of blocks with its seal unbroken, and older
 * or newer kinds of it. */
bool solver_keep_open(struct solver_keeper *keeper, const char *path, struct solver_error *error);
void solver_keep_close(struct solver_keeper *keeper);

/* The next block: `count` entries of `width` bytes at `data`, which are written, and must then stay as they are until
 * the file is, or read. Refuses a file whose next block has another name, width or count. */
bool solver_keep(struct solver_keeper *keeper, const char *name, void *data, size_t width, size_t count,
                 struct solver_error *error);
/* The next block while reading, of whatever size, where it lies in memory, 8-aligned, until the keeper is closed. */
bool solver_keep_peek(struct solver_keeper *keeper, const char *name, const void **data, size_t *size,
                      struct solver_error *error);
/* The next block, which says how others are to be understood: a file that has other bytes there is refused. */
bool solver_keep_same(struct solver_keeper *keeper, const char *name, const void *data, size_t width, size_t count,
                      struct solver_error *error);
/* A member of a structure that is kept as it lies in memory; a table of all is a block of the above. */
struct solver_keep_member {
    char name[16];
    uint64_t offset, size; /* [bytes] */
};
#define SOLVER_KEEP_MEMBER(type, name)                                                                                 \
    {                                                                                                                  \
#name, offsetof(type, name), sizeof((type){0}.name)                                                            \
    }
/* Whether all has been read. */
bool solver_keep_end(const struct solver_keeper *keeper, struct solver_error *error);
/* SOLVER_BAD_INPUT with the file's name; always false. */
bool solver_keep_refuse(const struct solver_keeper *keeper, struct solver_error *error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
