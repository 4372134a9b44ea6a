/* Pieces of text that every report on the terminal is made of. */
#ifndef VERIFY_TERMINAL_H
#define VERIFY_TERMINAL_H

#include "verify/gates.h"
#include "verify/truth.h"

#include <stdio.h>

/* "1.234e-05", or a dash where there is no number to show. */
const char *verify_scientific(char text[32], double value);
/* "1.98", or a dash. */
const char *verify_order_text(char text[32], double value);
/* Characters of the column of what has this name. */
int verify_width_of(const char *name);
/* The oracle, what it was told, its self-check line by line, and its figures. */
void verify_print_truth(FILE *file, const struct verify_truth *truth);
/* The gates as a table. */
void verify_print_gates(FILE *file, const struct verify_gates *gates);

#endif
