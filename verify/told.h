/* What the commands that ask an oracle directly are told of it. */
#ifndef VERIFY_TOLD_H
#define VERIFY_TOLD_H

#include "verify/options.h"
#include "verify/truth.h"

/* The oracle of --oracle or of an operand, with its --param and --typical. */
bool verify_told_oracle(const char *name, const struct verify_options *options, struct verify_truth *truth,
                        struct solver_error *error);
/* Numbers with commas between, of an option called `name`; at most `most`. */
bool verify_told_numbers(const char *name, const char *text, double *value, size_t most, size_t *count,
                         struct solver_error *error);

#endif
