/* Stored results and pictures, and the comparison with them. Knows render's picture difference and the record
 * format. */
#ifndef GOLDEN_GOLDEN_H
#define GOLDEN_GOLDEN_H

#include "render/render.h"
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

/* Reads the stored record and compares. A missing one is an error that says how to make it. */
bool golden_check_record(const char *stored_path, const struct solver_record *fresh, struct golden_report *report,
                         struct solver_error *error);

/* Reads the stored picture and compares; where they differ, writes the fresh one and the difference beside it: for
 * NAME.png these are NAME.fresh.png and NAME.difference.png; where they do not, removes what an earlier failure left.
 * False on pictures that cannot be compared. difference->picture is NULL. */
bool golden_check_image(const char *stored_path, const struct render_image *fresh, struct render_difference *difference,
                        struct solver_error *error);

#endif
