/* Stored results, and the comparison with them. Knows the record format; pictures are compared by render. */
#ifndef GOLDEN_GOLDEN_H
#define GOLDEN_GOLDEN_H

#include "solver/record.h"

/* The comparison of one field. */
struct golden_line {
    char field[SOLVER_NAME];
    double difference;       /* largest |fresh - stored| */
    double bound;            /* what round-off growth over the run allows for this field */
    char place[SOLVER_TEXT]; /* where the largest difference lies, with both values */
    bool pass;
};

struct golden_report {
    size_t count;
    struct golden_line *line; /* [count] fields of the record, then columns of the time history */
    bool pass;
};

/* Compares two records field by field, then column by column of the history. False on records that cannot be compared:
 * another body (dimension, scene, particles, their places or order, cells), other fields or columns, other numbers of
 * steps or rows, or nothing to compare. A NaN or an infinity on either side fails its line. */
bool golden_compare(const struct solver_record *stored, const struct solver_record *fresh, struct golden_report *report,
                    struct solver_error *error);
void golden_report_free(struct golden_report *report);

#endif
