/* Guarded reading of an HDF5 file that may be foreign, damaged or hostile: every link must be a hard one, every
 * dataset stored in this very file, contiguous, unfiltered, of the type and shape asked for and no larger than the
 * file, before memory is asked for. Private to record_*.c. */
#ifndef SOLVER_RECORD_SOURCE_H
#define SOLVER_RECORD_SOURCE_H

#include "solver/record_format.h"

struct record_source {
    const char *path;
    hid_t file;
    uint64_t bytes; /* size of the file */
    struct solver_error *error;
};

/* Opens a plain file that starts like HDF5. */
bool record_open(struct record_source *source, const char *path, struct solver_error *error);
void record_close(struct record_source *source);

/* SOLVER_BAD_INPUT with the file's name, where in it, and what is wrong; always false. */
bool record_refuse(struct record_source *source, const char *where, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* A group by its name within `parent`; false if it is missing or a link. H5Gclose. */
bool record_group(struct record_source *source, hid_t parent, const char *name, hid_t *group);

struct record_block {
    const char *name;
    hid_t type;
    int rank;       /* as found, 1 or 2 */
    size_t dims[2]; /* as found; dims[1] is 1 for rank 1 */
    void *data;     /* free() releases */
    char unit[RECORD_UNIT];
};
/* Reads the dataset `name` of `type`. Whoever calls checks the shape found. On failure data is NULL. */
bool record_block_read(struct record_source *source, hid_t group, const char *name, hid_t type,
                       struct record_block *block);
/* The same, and refuses any shape but rows (columns = 1: rank 1) of `columns`. */
bool record_block_read_shaped(struct record_source *source, hid_t group, const char *name, hid_t type, size_t rows,
                              size_t columns, struct record_block *block);

/* Attributes of the file's root. */
bool record_attribute(struct record_source *source, hid_t where, const char *name, hid_t type, void *value);
bool record_attribute_text(struct record_source *source, hid_t where, const char *name, char **text);

#endif
