/* Pieces of HTML that every part of the report is made of. */
#ifndef VERIFY_HTML_H
#define VERIFY_HTML_H

#include "verify/study.h"

#include <stdio.h>

/* Text with its markup characters escaped. */
void verify_html_text(FILE *file, const char *text);
/* A table cell: "e" three digits and an exponent, "f" two decimals; a dash where there is no number. */
void verify_html_cell(FILE *file, const char *format, double value);
/* A table cell with nine digits, or a dash. */
void verify_html_number(FILE *file, double value);
/* A picture within the page; nothing where the path is "". */
bool verify_html_picture(FILE *file, const char *path, const char *caption, struct solver_error *error);

/* The page up to its verdict, which is "pass", "fail" or "" by class; `note` stands below the title. */
void verify_html_begin(FILE *file, const char *title, const char *note, const struct verify_truth *truth,
                       const char *class, const char *verdict);
/* The gates as a table, with its heading. */
void verify_html_gates(FILE *file, const struct verify_gates *judged);

/* Parts of the page: the oracle and its proof, conserved quantities, the scene's settings. */
void verify_html_oracle(FILE *file, const struct verify_truth *truth);
void verify_html_quantities(FILE *file, const struct verify_study *study);
void verify_html_configuration(FILE *file, const struct solver_scene *scene);

#endif
