/* The commands of the program; each takes its options and returns an exit code. */
#ifndef VERIFY_COMMANDS_H
#define VERIFY_COMMANDS_H

#include "verify/options.h"

int verify_command_run(const struct verify_options *options);
int verify_command_verify(const struct verify_options *options);
/* `verify --mutations`: see mutations.h. */
int verify_command_mutations(const struct verify_options *options);
/* `verify mms`: see mms.h. */
int verify_command_mms(const struct verify_options *options);
int verify_command_trade(const struct verify_options *options);
int verify_command_render(const struct verify_options *options);
int verify_command_golden(const struct verify_options *options);
int verify_command_compare(const struct verify_options *options);
int verify_command_bench(const struct verify_options *options);
int verify_command_cost(const struct verify_options *options);
int verify_command_judge(const struct verify_options *options);
int verify_command_oracle(const struct verify_options *options);
/* `extremes`: see extremes.h. */
int verify_command_extremes(const struct verify_options *options);
int verify_command_list(const struct verify_options *options);

/* The program's version, as records and help show it. */
const char *verify_version(void);
/* Prints "assay: TEXT" on standard error and returns the exit code that belongs to the error. */
int verify_complain(const struct solver_error *error);

#endif
