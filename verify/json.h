/* Pieces of JSON that every report is made of. */
#ifndef VERIFY_JSON_H
#define VERIFY_JSON_H

#include "verify/gates.h"
#include "verify/truth.h"

#include <stdio.h>

/* A JSON string with its quotes; bytes that are no valid UTF-8 become U+FFFD. */
void verify_json_string(FILE *file, const char *text);
/* A number with all its digits; null where it is not finite. */
void verify_json_number(FILE *file, double value);
/* "KEY": text, or number. */
void verify_json_text_member(FILE *file, const char *key, const char *text);
void verify_json_number_member(FILE *file, const char *key, double value);
/* The end of a report: gates, among them the lines of the oracle's self-check that fail, and "pass", which is null
 * where nothing was judged. */
void verify_json_verdict(FILE *file, const struct verify_truth *truth, const struct verify_gates *gates);

#endif
