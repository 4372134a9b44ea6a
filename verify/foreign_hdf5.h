/* Guarded reading of an HDF5 file that anyone may have written. It may be damaged or hostile, and the library may crash
 * on it, so that all this runs in a process of its own (sample_apart.h); what can be checked is checked before memory
 * is asked for: every link is a hard one, every dataset lies in this very file, packed by deflate at most, and claims
 * no more than the file can hold. */
#ifndef VERIFY_FOREIGN_HDF5_H
#define VERIFY_FOREIGN_HDF5_H

#include "verify/sample.h"

#include <hdf5.h>
#include <stdint.h>

struct foreign {
    const char *path;
    uint64_t bytes; /* size of the file */
    hid_t file;
    struct solver_error *error;
};

bool foreign_open(struct foreign *foreign, const char *path, size_t bytes, struct solver_error *error);
void foreign_close(struct foreign *foreign);
/* SOLVER_BAD_INPUT with the file's name, where in it, and what is wrong; always false. */
bool foreign_refuse(struct foreign *foreign, const char *where, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Calls `visit` for each link of a group, in the order of names, until one returns false. Links that are not hard are
 * refused. */
typedef bool foreign_visit(struct foreign *foreign, hid_t group, const char *name, H5O_type_t type, void *context);
bool foreign_each(struct foreign *foreign, hid_t group, foreign_visit *visit, void *context);
bool foreign_has(hid_t group, const char *name);
/* A group by its name; H5Gclose. */
bool foreign_group(struct foreign *foreign, hid_t parent, const char *name, hid_t *group);

/* Numbers of any type, as [rows][width]. */
struct foreign_block {
    size_t rows, width; /* width: all of a row, 1 for rank 1 */
    bool single;        /* stored with less than 8 bytes each */
    bool has_unit;
    char unit[VERIFY_SAMPLE_UNIT];
    double *value; /* free() releases */
};
bool foreign_block_read(struct foreign *foreign, hid_t group, const char *name, struct foreign_block *block);

/* An attribute that is one number; *value is NaN where there is none of that name. */
bool foreign_number(struct foreign *foreign, hid_t where, const char *name, double *value);
/* An attribute that is one text, of whatever kind; *found says whether there is one. */
bool foreign_text(struct foreign *foreign, hid_t where, const char *name, char *text, size_t size, bool *found);

#endif
