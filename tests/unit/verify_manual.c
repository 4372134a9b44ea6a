/* The manual page: roff takes every text for what it is, and all commands and options are there. */
#include "render/render.h"
#include "tests/unit/unit.h"
#include "verify/manual.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The page of one command with this help; the caller frees. */
static char *page(const char *help)
{
    const struct verify_command command = {
        .name = "weigh", .operands = "GOLD", .summary = "", .help = help, .takes = VERIFY_TAKES_SET | VERIFY_TAKES_DIR};
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    verify_manual(file, &command, 1);
    CU_ASSERT_EQUAL_FATAL(fclose(file), 0);
    return text;
}

static void holds(const char *help, const char *expected)
{
    char *text = page(help);
    CU_ASSERT_PTR_NOT_NULL(strstr(text, expected));
    if (strstr(text, expected) == NULL) {
        (void)fprintf(stderr, "expected: %s\ngot: %s\n", expected, text);
    }
    free(text);
}

static void commands_and_their_options(void)
{
    holds("Weighs it.", ".B assay weigh\nGOLD\n[options]\n");
    holds("Weighs it.", ".SS assay weigh GOLD\nWeighs it.\n.TP\n.B \\-s, \\-\\-set KEY=VALUE\n");
    holds("Weighs it.", ".B \\-d, \\-\\-dir DIR\n");
    char *text = page("Weighs it.");
    CU_ASSERT_PTR_NULL(strstr(text, "levels N")); /* an option of other commands */
    free(text);
}

static void characters_that_roff_knows(void)
{
    holds("a\\b c-d `e' f^g~h", "\na\\eb c\\-d \\(gae\\(aq f\\(hag\\(tih\n");
    holds("one\n.two", "\none\n\\&.two\n");
    holds("'one", "\n\\(aqone\n");
}

static void paragraphs_and_examples(void)
{
    holds("One,\nand the same.\n\nTwo.", "\nOne,\nand the same.\n.PP\nTwo.\n.TP\n");
    holds("One:\n\n  a -b\n  c\n\nTwo.", "\nOne:\n.PP\n.RS\n.EX\na \\-b\nc\n.EE\n.RE\n.PP\nTwo.\n.TP\n");
    holds("One:\n\n  a", "\nOne:\n.PP\n.RS\n.EX\na\n.EE\n.RE\n.TP\n");
}

/* A term has its word first; what is indented in any other way stays as it is. */
static void terms_and_tables(void)
{
    holds("One.\n\nFIELDS  u and\n  -v\n\nTwo.", "\nOne.\n.TP\n.B FIELDS\nu and\n\\-v\n.PP\nTwo.\n.TP\n");
    holds("One.\n\nHDF5  /\n        a\n  b", "\nOne.\n.PP\n.EX\nHDF5  /\n        a\n  b\n.EE\n.TP\n");
    holds("One:\n\n  a\n      b", ".EX\na\n    b\n.EE\n");
    holds("  a", ".SS assay weigh GOLD\n.RS\n.EX\na\n.EE\n.RE\n"); /* no paragraph begins after a heading */
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"commands and their options", commands_and_their_options},
        {"characters that roff knows", characters_that_roff_knows},
        {"paragraphs and examples", paragraphs_and_examples},
        {"terms and tables", terms_and_tables},
    };
    return unit_main("manual", tests, sizeof tests / sizeof *tests);
}
