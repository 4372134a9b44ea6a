/* The manual page, in the man format of roff. Commands and options are those of the program's own tables, so that the
 * page cannot say anything else than its help. */
#ifndef VERIFY_MANUAL_H
#define VERIFY_MANUAL_H

#include "verify/options.h"

#include <stddef.h>
#include <stdio.h>

void verify_manual(FILE *file, const struct verify_command *command, size_t count);

#endif
