/* Records: HDF5 files that ParaView opens without a plug-in (VTKHDF 1.0, UnstructuredGrid), with an XDMF file
 * beside for older readers. Whole or absent: written beside, flushed, renamed. */
#ifndef SOLVER_RECORD_H
#define SOLVER_RECORD_H

#include "solver/run.h"

/* What a file holds.
 *
 * /VTKHDF   UnstructuredGrid as VTK's reader wants it. Points lie in the reference configuration: displacement is a
 *           field beside them, so that "Warp By Vector" shows the body at any magnification and all records of a
 *           body share their points. PointData holds the fields, FieldData the time.
 * /history  values [rows][columns], columns (names), units.
 * /         attributes: format, dim, step, time, scene_name, scene_text, overrides, command, version.
 *
 * Every dataset carries its `unit`. The same record gives the same bytes: no time stamps, no compression. The file ends
 * with a checksum of all its bytes, which other readers of HDF5 pass over: a file cut short, damaged or edited is
 * refused. */

/* One field of a record: count rows of `width` numbers. */
struct solver_record_field {
    char name[SOLVER_NAME]; /* "displacement", "velocity", "pressure", "von_mises", "F", "J", "P", "sigma", "tags", ...
                             */
    char unit[32];          /* "m", "Pa", "-" */
    int width;     /* 1; 3 for vectors and 9 for tensors, below 3D with the out-of-plane part of plane strain: 1 on the
                      diagonal of F, J on that of H, the normal stress on those of P and sigma, zeros elsewhere */
    double *value; /* [count][width] */
};

/* A record in memory, as read from a file. */
struct solver_record {
    int dim;
    size_t count;
    size_t step; /* steps taken since the start */
    double time; /* [s] */
    double *X;   /* [count][3] reference position [m] */
    size_t cell_count;
    int cell_width; /* 2, 4, 8: line, quad, hexahedron */
    uint32_t *cell; /* [cell_count][cell_width] */
    size_t field_count;
    struct solver_record_field *field;
    size_t history_count; /* rows of the time history */
    size_t history_columns;
    char (*history_name)[SOLVER_NAME]; /* [history_columns] "time", "kinetic_energy", "probe_corner_u_x", ... */
    char (*history_unit)[32];          /* [history_columns] */
    double *history;                   /* [history_count][history_columns] */
    char *scene_name, *scene_text, *overrides, *command, *version; /* attributes, "" if absent */
};

/* The record of what the body is doing now; history may be NULL. Fields are sorted by name. F and P are
 * among them where the scheme has them, H where it is evolved, "body" where there are several. SOLVER_BAD_INPUT if a
 * probe's name is too long for a column's, SOLVER_NO_MEMORY. */
bool solver_record_make(const struct solver_scene *scene, const struct solver_output *output,
                        const struct solver_history *history, const char *command, const char *version,
                        struct solver_record **record, struct solver_error *error);
/* Writes PATH (an .h5 or .vtkhdf name) and, with that ending replaced by .xdmf, the description for older readers
 * beside it. SOLVER_BAD_INPUT for another ending; SOLVER_IO leaves both files as they were. */
bool solver_record_save(const char *path, const struct solver_record *record, struct solver_error *error);
/* Both in one. */
bool solver_record_write(const char *path, const struct solver_scene *scene, const struct solver_output *output,
                         const struct solver_history *history, const char *command, const char *version,
                         struct solver_error *error);
/* Reads any record this program wrote; refuses foreign, damaged or truncated files with a clear error. Follows no
 * link out of the file. */
bool solver_record_read(const char *path, struct solver_record **record, struct solver_error *error);
void solver_record_free(struct solver_record *record);
/* NULL if there is no field of that name. */
const struct solver_record_field *solver_record_find(const struct solver_record *record, const char *name);

#endif
