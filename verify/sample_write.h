/* Samples as files, in the judge's own schema. */
#ifndef VERIFY_SAMPLE_WRITE_H
#define VERIFY_SAMPLE_WRITE_H

#include "verify/sample.h"

#include <stdio.h>

/* Writes an HDF5 file: one sample as the file's root, several as groups level1, level2, ... The same samples give the
 * same bytes. */
bool verify_sample_write_hdf5(const char *path, const struct verify_samples *samples, struct solver_error *error);

/* How the columns of a field are named: u, u_x, u_xx. */
enum verify_columns { VERIFY_PLAIN, VERIFY_BY_AXIS, VERIFY_BY_PAIR };
/* Writes one sample as a table; `columns` is that of each field. */
void verify_sample_write_csv(FILE *file, const struct verify_sample *sample,
                             const enum verify_columns columns[VERIFY_SAMPLE_FIELDS]);

#endif
