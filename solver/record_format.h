/* What the writer and the reader of records must agree on. Private to record*.c, but for what HDF5 says of a failure,
 * which readers of files that are not records may ask as well. */
#ifndef SOLVER_RECORD_FORMAT_H
#define SOLVER_RECORD_FORMAT_H

#include "solver/record.h"
#include "solver/seal.h"

#include <hdf5.h>

#define RECORD_FORMAT "assay record 1"

enum { RECORD_UNIT = 32, RECORD_PATH = 4096, RECORD_MAX_FIELDS = 64, RECORD_MAX_COLUMNS = 4096 };

/* The fields that records have; ends with a NULL name. */
struct record_known {
    const char *name;
    int width;
    bool required; /* without it a record is no record of ours; else it is there where the scheme knows it */
};
extern const struct record_known record_known[];

/* VTK's cell type (line 3, quad 9, hexahedron 12) of cells with 2, 4, 8 corners. */
uint8_t record_vtk_type(int cell_width);

/* HDF5 prints its errors unless told otherwise; the solver never prints. */
struct record_quiet {
    H5E_auto2_t print;
    void *context;
};
struct record_quiet record_quiet_begin(void);
void record_quiet_end(struct record_quiet before);
/* What HDF5 says of its last failure: the innermost reason. */
void record_hdf5_reason(char *text, size_t size);

/* Fills the record's history columns: one row per entry of `history` (NULL: no rows), components beyond dim left out.
 */
bool record_take_history(struct solver_record *record, const struct solver_history *history,
                         struct solver_error *error);

/* A record as the bytes of an HDF5 file; free() releases. */
bool record_to_hdf5(const struct solver_record *record, void **bytes, size_t *size, struct solver_error *error);
/* A record's XDMF description; `hdf5_name` is the file it describes, without folder. free() releases. */
bool record_to_xdmf(const struct solver_record *record, const char *hdf5_name, char **text, size_t *size,
                    struct solver_error *error);

#endif
