/* The study of costs as a table: a head of one value a line, names of columns, a row a measured run, and a sum over all
 * bytes before it, so that a file that was cut short or damaged is known. Tabs stand between columns. */
#include "verify/find.h"
#include "verify/trade.h"

#include <ctype.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char magic[] = "assay trade 2";
enum { FIXED = 11 }; /* columns before those of errors */
static const char fixed_columns[] =
    "configuration\tvariant\tn\town\tevaluations\tpair_evaluations\tbytes\tseconds\tthreads\trepeats\tnoise";
enum { LARGEST_FILE = 1 << 26 };

/* Overrides stand on one line, with blanks between. */
static void write_head(FILE *file, const struct verify_trade *trade)
{
    (void)fprintf(file, "%s\nscene\t%s\nhash\t%016" PRIx64 "\noverrides\t", magic, trade->scene, trade->hash);
    for (const char *c = trade->overrides; *c != '\0'; c++) {
        if (*c != '\n' || c[1] != '\0') {
            (void)fputc(*c == '\n' ? ' ' : *c, file);
        }
    }
    (void)fprintf(file, "\nstopped\t%s\nerror\t%s\n%s", trade->stopped, trade->error_name[trade->chosen],
                  fixed_columns);
    for (size_t i = 0; i < trade->error_count; i++) {
        (void)fprintf(file, "\t%s", trade->error_name[i]);
    }
    (void)fputc('\n', file);
}

static void write_row(FILE *file, const struct verify_trade *trade, const struct verify_trade_run *run)
{
    (void)fprintf(file, "%s\t%s\t%d\t%d\t%.17g\t%.17g\t%.17g\t%.17g\t%d\t%d\t%.17g", run->words, run->variant, run->n,
                  run->own ? 1 : 0, run->evaluations, run->cost[VERIFY_PAIRS], run->cost[VERIFY_BYTES],
                  run->cost[VERIFY_SECONDS], run->threads, run->repeats, isnan(run->noise) ? -1.0 : run->noise);
    for (size_t i = 0; i < trade->error_count; i++) {
        (void)fprintf(file, isfinite(run->error[i]) ? "\t%.17g" : "\t-", run->error[i]);
    }
    (void)fputc('\n', file);
}

bool verify_trade_write(const struct verify_trade *trade, const char *path, struct solver_error *error)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    if (file == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "%s: no memory for the study", path);
    }
    write_head(file, trade);
    for (size_t i = 0; i < trade->run_count; i++) {
        if (trade->run[i].end == VERIFY_MEASURED) {
            write_row(file, trade, &trade->run[i]);
        }
    }
    bool whole = fflush(file) == 0;
    uint64_t sum = whole ? verify_trade_hash_bytes(verify_trade_hash_start, text, size) : 0;
    (void)fprintf(file, "sum\t%016" PRIx64 "\n", sum);
    whole = fclose(file) == 0 && whole;
    bool written = whole ? verify_file_write(path, text, size, error)
                         : solver_fail(error, SOLVER_NO_MEMORY, "%s: no memory for the study", path);
    free(text);
    return written;
}

/* Where the reader is. */
struct reader {
    const char *path;
    char *at; /* the rest of the text */
    size_t line;
    struct solver_error *error;
};

static bool wrong(const struct reader *reader, const char *what)
{
    return solver_fail(
        reader->error, SOLVER_BAD_INPUT,
        "%s: line %zu: expected %s; the study is damaged or was made by something else: make another with "
        "assay trade",
        reader->path, reader->line, what);
}

/* The next line without its end; NULL if there is none. */
static char *next_line(struct reader *reader)
{
    char *line = reader->at, *end = strchr(line, '\n');
    reader->line++;
    if (end == NULL) {
        return NULL;
    }
    *end = '\0';
    reader->at = end + 1;
    return line;
}

/* The next column of a line, which *rest then follows. */
static char *next_column(char **rest)
{
    char *column = *rest;
    if (column == NULL) {
        return NULL;
    }
    char *tab = strchr(column, '\t');
    *rest = tab != NULL ? tab + 1 : NULL;
    if (tab != NULL) {
        *tab = '\0';
    }
    return column;
}

/* A number from low to high, and nothing after it. */
static bool read_number(const char *text, double low, double high, double *value)
{
    char *end = NULL;
    if (text == NULL || (!isdigit((unsigned char)text[0]) && text[0] != '-')) {
        return false;
    }
    *value = strtod(text, &end);
    return end != text && *end == '\0' && *value >= low && *value <= high;
}

static bool read_whole(const char *text, int low, int high, int *value)
{
    double number = 0;
    bool read = read_number(text, low, high, &number) && number == floor(number);
    *value = read ? (int)number : 0;
    return read;
}

static bool copy(const char *text, char *out, size_t size)
{
    return text != NULL && (size_t)snprintf(out, size, "%s", text) < size;
}

static bool read_member(struct reader *reader, const char *name, char *out, size_t size)
{
    char *line = next_line(reader), *key = next_column(&line);
    return (key != NULL && strcmp(key, name) == 0 && copy(line, out, size)) || wrong(reader, name);
}

static bool read_columns(struct reader *reader, struct verify_trade *trade)
{
    char *line = next_line(reader);
    size_t length = sizeof fixed_columns - 1;
    if (line == NULL || strncmp(line, fixed_columns, length) != 0 || line[length] != '\t') {
        return wrong(reader, "the names of columns");
    }
    for (char *rest = line + length + 1, *name = next_column(&rest); name != NULL; name = next_column(&rest)) {
        if (trade->error_count == VERIFY_TRADE_ERRORS || name[0] == '\0' ||
            !copy(name, trade->error_name[trade->error_count++], VERIFY_TRADE_NAME)) {
            return wrong(reader, "up to 32 names of errors");
        }
    }
    return true;
}

/* KEY=VALUE and blanks between; keys that a study varies, each once. */
static bool words_are_good(const char *words)
{
    for (const char *word = words; *word != '\0';) {
        size_t whole = strcspn(word, " "), key = strcspn(word, "=");
        char value[SOLVER_NAME], name[SOLVER_NAME];
        if (key >= whole || whole - key < 2 || key >= SOLVER_NAME || !verify_trade_key(word, key)) {
            return false;
        }
        (void)snprintf(name, sizeof name, "%.*s", (int)key, word);
        if (verify_trade_word(word + whole, name, value) || whole - key - 1 >= SOLVER_NAME) {
            return false;
        }
        word += whole;
        word += *word == ' ';
    }
    return true;
}

static bool read_run(struct reader *reader, char *line, struct verify_trade *trade)
{
    struct verify_trade_run *run = &trade->run[trade->run_count];
    char *rest = line;
    int own = 0;
    *run = (struct verify_trade_run){.end = VERIFY_MEASURED, .order = trade->run_count};
    if (!copy(next_column(&rest), run->words, sizeof run->words) || !words_are_good(run->words) ||
        !copy(next_column(&rest), run->variant, sizeof run->variant)) {
        return wrong(reader, "a configuration of keys that a study varies");
    }
    bool read = read_whole(next_column(&rest), 1, 1000000, &run->n) && read_whole(next_column(&rest), 0, 1, &own) &&
                read_number(next_column(&rest), 0, 1e300, &run->evaluations);
    for (int cost = 0; read && cost < VERIFY_COSTS; cost++) {
        read = read_number(next_column(&rest), 0, 1e300, &run->cost[cost]);
    }
    run->own = own == 1;
    read = read && read_whole(next_column(&rest), 1, 1024, &run->threads) &&
           read_whole(next_column(&rest), 1, 1000000, &run->repeats) &&
           read_number(next_column(&rest), -1, 1e300, &run->noise);
    for (size_t i = 0; read && i < trade->error_count; i++) {
        const char *text = next_column(&rest);
        run->error[i] = NAN;
        read = text != NULL && (strcmp(text, "-") == 0 || read_number(text, 0, 1e300, &run->error[i]));
    }
    run->noise = run->noise < 0 ? NAN : run->noise;
    trade->run_count++;
    return (read && rest == NULL) || wrong(reader, "as many numbers as there are columns");
}

/* Text that a terminal may be shown: tabs and ends of lines are all it has of control characters. */
static bool is_plain(const char *text)
{
    for (const char *c = text; *c != '\0'; c++) {
        if (iscntrl((unsigned char)*c) && *c != '\t' && *c != '\n') {
            return false;
        }
    }
    return true;
}

/* Cuts the sum off the text and compares. */
static bool check_sum(struct reader *reader, size_t size)
{
    static const size_t length = sizeof "sum\t0123456789abcdef\n" - 1;
    char expected[32];
    bool whole = size > length && memchr(reader->at, '\0', size) == NULL;
    if (whole) {
        char *last = reader->at + size - length;
        uint64_t sum = verify_trade_hash_bytes(verify_trade_hash_start, reader->at, size - length);
        (void)snprintf(expected, sizeof expected, "sum\t%016" PRIx64 "\n", sum);
        whole = last[-1] == '\n' && strcmp(last, expected) == 0;
        *last = '\0';
    }
    if (!whole) {
        return solver_fail(reader->error, SOLVER_BAD_INPUT,
                           "%s: the study was cut short or damaged: its last line is not the sum over the others. "
                           "Make another with assay trade",
                           reader->path);
    }
    return is_plain(reader->at) ||
           solver_fail(reader->error, SOLVER_BAD_INPUT,
                       "%s: the study holds control characters, which assay trade writes none of; make another",
                       reader->path);
}

static bool read_all(struct reader *reader, size_t size, struct verify_trade *trade)
{
    char hash[32], chosen[VERIFY_TRADE_NAME], *end = NULL;
    if (size < sizeof magic || strncmp(reader->at, magic, sizeof magic - 2) != 0) {
        return solver_fail(reader->error, SOLVER_BAD_INPUT, "%s: no study of assay trade", reader->path);
    }
    if (strncmp(reader->at, magic, sizeof magic - 1) != 0 || reader->at[sizeof magic - 1] != '\n') {
        return solver_fail(reader->error, SOLVER_BAD_INPUT,
                           "%s: a study of another version of this program; make another with assay trade",
                           reader->path);
    }
    trade->overrides = calloc(size, 1);
    if (trade->overrides == NULL) {
        return solver_fail(reader->error, SOLVER_NO_MEMORY, "%s: no memory for the study", reader->path);
    }
    if (!check_sum(reader, size)) {
        return false;
    }
    (void)next_line(reader);
    if (!read_member(reader, "scene", trade->scene, sizeof trade->scene) ||
        !read_member(reader, "hash", hash, sizeof hash) || !read_member(reader, "overrides", trade->overrides, size) ||
        !read_member(reader, "stopped", trade->stopped, sizeof trade->stopped) ||
        !read_member(reader, "error", chosen, sizeof chosen) || !read_columns(reader, trade)) {
        return false;
    }
    trade->hash = strtoull(hash, &end, 16);
    trade->chosen = verify_trade_error(trade, chosen);
    if (end != hash + 16 || *end != '\0' || trade->chosen == trade->error_count) {
        return wrong(reader, "a hash of 16 digits and an error that has a column");
    }
    for (char *line = next_line(reader); line != NULL; line = next_line(reader)) {
        if (!verify_trade_reserve(trade, 1, reader->error)) {
            return false;
        }
        if (!read_run(reader, line, trade)) {
            return false;
        }
    }
    return true;
}

bool verify_trade_read(const char *path, struct verify_trade *trade, struct solver_error *error)
{
    char *text = NULL;
    size_t size = 0;
    *trade = (struct verify_trade){.run_count = 0};
    if (!verify_file_read(path, &text, &size, error)) {
        return false;
    }
    struct reader reader = {.path = path, .at = text, .error = error};
    bool read = size <= LARGEST_FILE ? read_all(&reader, size, trade)
                                     : solver_fail(error, SOLVER_BAD_INPUT, "%s: too large for a study", path);
    free(text);
    if (!read) {
        verify_trade_free(trade);
    }
    return read;
}
