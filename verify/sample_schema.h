/* What an HDF5 file holds for the judge. Runs in a process of its own (sample_apart.h). */
#ifndef VERIFY_SAMPLE_SCHEMA_H
#define VERIFY_SAMPLE_SCHEMA_H

#include "verify/sample.h"

/* Adds the samples of an HDF5 file: records of this program, VTKHDF, or the judge's own schema:
 *
 *   /             attributes time [s], h [m], n: of all levels that do not have their own
 *   /             or any group in it: a level; its attributes time, h and n
 *     points      [N][dim] reference positions, attribute unit
 *     weights     [N], optional
 *     NAME        [N], [N][dim], [N][3], [N][dim*dim], [N][9] or [N][3][3], attribute unit
 */
bool verify_schema_read(const char *path, size_t bytes, struct verify_samples *samples, struct solver_error *error);

#endif
