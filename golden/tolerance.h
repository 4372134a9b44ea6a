/* How far round-off may carry two runs of one scene apart. Private to golden. */
#ifndef GOLDEN_TOLERANCE_H
#define GOLDEN_TOLERANCE_H

#include "solver/record.h"

/* The bound on |fresh - stored| of a field of the stored record. */
double golden_field_bound(const struct solver_record *stored, const struct solver_record_field *field);
/* The bound for a column of its history. */
double golden_column_bound(const struct solver_record *stored, size_t column);

#endif
