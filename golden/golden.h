/* Stored results and pictures, and the comparison with them. Knows render's picture difference and the record
 * format. */
#ifndef GOLDEN_GOLDEN_H
#define GOLDEN_GOLDEN_H

#include "render/render.h"
#include "solver/record.h"

/* The comparison of one field. */
struct golden_line {
    char field[SOLVER_NAME];
    double difference; /* largest |fresh - stored| */
    double bound;      /* what round-off growth over the run allows for this field */
    char place[SOLVER_TEXT]; /* where the largest difference lies, with both values */
    bool pass;
};

struct golden_report {
    size_t count;
    struct golden_line *line;   /* [count] fields of the record, then columns of the time history */
    bool pass;
};

/* Compares two records field by field. False on records that cannot be compared (other particles, fields, shape). */
bool golden_compare(const struct solver_record *stored, const struct solver_record *fresh, struct golden_report *report,
                    struct solver_error *error);
void golden_report_free(struct golden_report *report);

#endif
