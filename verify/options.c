#include "verify/options.h"

#include "solver/suggest.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

struct option {
    const char *name;
    const char *short_name; /* NULL if none */
    const char *value;      /* what the help calls it; NULL: takes none */
    const char *help;
    unsigned bit; /* 0: every command takes it */
};

static const struct option options_table[] = {
    {"--set", "-s", "KEY=VALUE", "override a key of the scene; may be repeated", VERIFY_TAKES_SET},
    {"--levels", "-l", "N,N,...", "spacings along the reference length, increasing", VERIFY_TAKES_LEVELS},
    {"--vary", "-v", "KEY=V,V,...", "values of a key to try, in place of those tried anyway; may be repeated",
     VERIFY_TAKES_VARY},
    {"--error", "-e", "NAME", "the error that the fronts are of (default: the first that the scene shows)",
     VERIFY_TAKES_ERROR_NAME},
    {"--error", "-e", "[NAME=]BOUND", "run the cheapest configuration that a study (assay trade) saw reach this error",
     VERIFY_TAKES_ERROR},
    {"--study", NULL, "FILE", "that study's trade.tsv (default: in the folder of --out)", VERIFY_TAKES_STUDY},
    {"--budget", "-b", "SECONDS", "time for the study (default 120)", VERIFY_TAKES_BUDGET},
    {"--json", "-j", "FILE", "write the result for programs", VERIFY_TAKES_JSON},
    {"--out", "-O", "DIR", "folder for the files written (default out/SCENE)", VERIFY_TAKES_OUT},
    {"--output", "-o", "PNG", "the picture's file", VERIFY_TAKES_PICTURE},
    {"--dir", "-d", "DIR", "folder of the golden records (default: the one that comes with the program)",
     VERIFY_TAKES_DIR},
    {"--tolerance", NULL, "ALL,TILE", "shares of pixels that may differ visibly, in all and within the worst tile",
     VERIFY_TAKES_TOLERANCE},
    {"--oracle", NULL, "NAME", "the oracle that judges; assay list oracles shows them", VERIFY_TAKES_ORACLE},
    {"--param", "-p", "KEY=VALUE", "a parameter of the oracle, in SI units; may be repeated", VERIFY_TAKES_PARAM},
    {"--typical", NULL, NULL, "the oracle's typical values for parameters not given", VERIFY_TAKES_PARAM},
    {"--norm", NULL, "NAME", "l2 (default), l1, max, abs or abs_max: errors shown; may be repeated", VERIFY_TAKES_NORM},
    {"--gate", "-g", "NAME=BOUND", "an error at most, or \"rate NAME=BOUND\" an order at least", VERIFY_TAKES_GATE},
    {"--order", NULL, "NAME=BOUND", "short for --gate \"rate NAME=BOUND\"", VERIFY_TAKES_ORDER},
    {"--time", "-t", "T,T,...", "time [s]: one, or one a level", VERIFY_TAKES_TIME},
    {"--spacing", NULL, "H,H,...", "spacing [m] of each level, where files do not say", VERIFY_TAKES_SPACING},
    {"--points", NULL, "FILE", "the places of this file", VERIFY_TAKES_PLACES},
    {"--grid", NULL, "RANGES", "X0:X1:N,Y0:Y1:N,...: N places from X0 to X1 along each axis [m]", VERIFY_TAKES_PLACES},
    {"--inside", NULL, NULL, "leave out places outside the body in place of refusing them", VERIFY_TAKES_PLACES},
    {"--output", "-o", "FILE", "FILE.h5 or FILE.csv (default: a table on standard output)", VERIFY_TAKES_TABLE},
    {"--mutations", NULL, NULL, "no scene: what is told wrongly on purpose, and which gate notices",
     VERIFY_TAKES_MUTATIONS},
    {"--checkpoint", "-c", "PACE", "write SCENE.checkpoint every so often: 500 (steps), 30s, 10min, 2h",
     VERIFY_TAKES_CHECKPOINT},
    {"--restart", "-r", "FILE", "no SCENE: go on from a checkpoint", VERIFY_TAKES_CHECKPOINT},
    {"--as-stored", NULL, NULL, "with --restart: although the scene's file has changed since", VERIFY_TAKES_CHECKPOINT},
    {"--help", "-h", NULL, "this text", 0},
};
enum { OPTIONS = sizeof options_table / sizeof *options_table };
_Static_assert((int)OPTIONS <= (int)VERIFY_OPTIONS, "every option has its line");

static bool takes(const struct verify_command *command, const struct option *option)
{
    return option->bit == 0 || (command->takes & option->bit) != 0;
}

static bool bad(struct solver_error *error, const struct verify_command *command, const char *word, const char *why)
{
    return solver_fail(error, SOLVER_BAD_INPUT, "%s: %s; see assay %s --help", word, why, command->name);
}

/* One that the command takes; two commands may have options of one name. */
static const struct option *find(const struct verify_command *command, const char *word, size_t length)
{
    for (size_t i = 0; i < OPTIONS; i++) {
        const struct option *option = &options_table[i];
        bool is_long = strlen(option->name) == length && strncmp(option->name, word, length) == 0;
        bool is_short = option->short_name != NULL && length == 2 && strncmp(option->short_name, word, 2) == 0;
        if (takes(command, option) && (is_long || is_short)) {
            return option;
        }
    }
    return NULL;
}

/* An option that other commands take. */
static bool foreign(const struct verify_command *command, const char *name, struct solver_error *error)
{
    for (size_t i = 0; i < OPTIONS; i++) {
        if (strcmp(options_table[i].name, name) == 0) {
            bool size = options_table[i].bit == VERIFY_TAKES_LEVELS && (command->takes & VERIFY_TAKES_SET) != 0;
            (void)solver_fail(error, SOLVER_BAD_INPUT, "assay %s takes no %s%s; see assay %s --help", command->name,
                              name, size ? ", being of one size, as in --set n=24" : "", command->name);
            return true;
        }
    }
    return false;
}

static bool unknown(const struct verify_command *command, const char *word, struct solver_error *error)
{
    const char *names[OPTIONS];
    size_t count = 0;
    for (size_t i = 0; i < OPTIONS; i++) {
        if (takes(command, &options_table[i])) {
            names[count++] = options_table[i].name;
        }
    }
    char name[64];
    (void)snprintf(name, sizeof name, "%.*s", (int)strcspn(word, "="), word);
    const char *meant = solver_suggest(name, names, count);
    if (foreign(command, name, error)) {
        return false;
    }
    if (meant != NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT, "unknown option %s for assay %s; did you mean %s?", word,
                           command->name, meant);
    }
    return solver_fail(error, SOLVER_BAD_INPUT, "unknown option %s; see assay %s --help", word, command->name);
}

/* "4,8,16": whole numbers above 0, increasing. */
static bool read_levels(const struct verify_command *command, const char *text, struct verify_options *options,
                        struct solver_error *error)
{
    if (options->level_count > 0) {
        return bad(error, command, "--levels", "given twice");
    }
    for (const char *c = text;; c++) {
        char *end = (char *)c;
        errno = 0;
        long n = isdigit((unsigned char)*c) ? strtol(c, &end, 10) : 0;
        if (errno != 0 || n < 1 || n > INT_MAX || (*end != ',' && *end != '\0')) {
            return bad(error, command, text, "--levels wants whole numbers above 0 with commas between, as in 4,8,16");
        }
        if (options->level_count > 0 && n <= options->level[options->level_count - 1]) {
            return bad(error, command, text, "--levels must increase from one to the next");
        }
        if (options->level_count == SOLVER_LEVELS) {
            return bad(error, command, text, "--levels takes at most 16 numbers");
        }
        options->level[options->level_count++] = (int)n;
        c = end;
        if (*c == '\0') {
            return true;
        }
    }
}

static bool read_override(const struct verify_command *command, const char *text, struct verify_options *options,
                          struct solver_error *error)
{
    const char *equals = strchr(text, '=');
    if (equals == NULL || equals == text) {
        return bad(error, command, text, "--set wants KEY=VALUE, as in --set n=24");
    }
    for (const char *c = text; *c != '\0'; c++) {
        if (iscntrl((unsigned char)*c)) {
            return bad(error, command, "--set", "the value holds a control character, such as a line break");
        }
    }
    /* One place stays free for what a study adds itself. */
    if (options->override_count == VERIFY_OVERRIDES - 1) {
        return bad(error, command, text, "too many --set (at most 63)");
    }
    options->override[options->override_count++] = text;
    return true;
}

static bool read_budget(const struct verify_command *command, const char *text, struct verify_options *options,
                        struct solver_error *error)
{
    char *end = (char *)text;
    if (options->budget > 0) {
        return bad(error, command, "--budget", "given twice");
    }
    options->budget = strtod(text, &end);
    return (end != text && *end == '\0' && options->budget > 0 && options->budget <= 1e7) ||
           bad(error, command, text, "--budget wants a number of seconds above 0, as in 60");
}

/* "5e-4,0.02": two shares. */
static bool read_tolerance(const struct verify_command *command, const char *text, struct verify_options *options,
                           struct solver_error *error)
{
    char *end = (char *)text;
    if (options->has_tolerance) {
        return bad(error, command, "--tolerance", "given twice");
    }
    for (int i = 0; i < 2; i++) {
        const char *from = i == 0 ? text : end + 1;
        options->tolerance[i] = strtod(from, &end);
        if (end == from || *end != (i == 0 ? ',' : '\0') ||
            !(options->tolerance[i] >= 0 && options->tolerance[i] <= 1)) {
            return bad(error, command, text, "--tolerance wants two numbers from 0 to 1, as in 5e-4,0.02");
        }
    }
    options->has_tolerance = true;
    return true;
}

/* A value of an option that may be repeated, in the form "NAME=..." if it has `named`. */
static bool add(const struct verify_command *command, const struct option *option, struct verify_list *list,
                const char *value, bool named, struct solver_error *error)
{
    const char *equals = strrchr(value, '=');
    if (named && (equals == NULL || equals == value || equals[1] == '\0')) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%s %s: expected %s; see assay %s --help", option->name, value,
                           option->value, command->name);
    }
    if (list->count == VERIFY_OVERRIDES) {
        return bad(error, command, option->name, "given too often");
    }
    list->text[list->count++] = value;
    return true;
}

static bool once(const struct verify_command *command, const struct option *option, const char **place,
                 const char *value, struct solver_error *error)
{
    if (*place != NULL) {
        return bad(error, command, option->name, "given twice");
    }
    if (*value == '\0') {
        return bad(error, command, option->name, "its value is empty");
    }
    *place = value;
    return true;
}

/* A file to write whose name must end as its content does: a slip of the hand must not replace a scene or a record. */
static bool output(const struct verify_command *command, const struct option *option, const char **place,
                   const char *value, const char *suffix, struct solver_error *error)
{
    size_t length = strlen(value);
    if (length <= strlen(suffix) || strcmp(value + length - strlen(suffix), suffix) != 0) {
        return solver_fail(error, SOLVER_BAD_INPUT, "assay %s: %s %s: expected a name that ends in %s", command->name,
                           option->name, value, suffix);
    }
    return once(command, option, place, value, error);
}

/* Options of what judges and asks oracles. */
static bool apply_to_judge(const struct verify_command *command, const struct option *option, const char *value,
                           struct verify_options *options, struct solver_error *error)
{
    switch (option->bit) {
    case VERIFY_TAKES_ORACLE:
        return once(command, option, &options->oracle, value, error);
    case VERIFY_TAKES_PARAM:
        options->typical = options->typical || option->value == NULL;
        return option->value == NULL || add(command, option, &options->param, value, true, error);
    case VERIFY_TAKES_NORM:
        return add(command, option, &options->norm, value, false, error);
    case VERIFY_TAKES_GATE:
        return add(command, option, &options->gate, value, true, error);
    case VERIFY_TAKES_ORDER:
        return add(command, option, &options->order, value, true, error);
    case VERIFY_TAKES_TIME:
        return once(command, option, &options->times, value, error);
    case VERIFY_TAKES_SPACING:
        return once(command, option, &options->spacings, value, error);
    case VERIFY_TAKES_PLACES:
        options->inside = options->inside || option->value == NULL;
        return option->value == NULL ||
               once(command, option, strcmp(option->name, "--grid") == 0 ? &options->grid : &options->points, value,
                    error);
    case VERIFY_TAKES_TABLE:
        return once(command, option, &options->table, value, error);
    default:
        options->help = true;
        return true;
    }
}

/* Options of what keeps a run on disk, and of what goes on from there. */
static bool apply_to_checkpoints(const struct verify_command *command, const struct option *option, const char *value,
                                 struct verify_options *options, struct solver_error *error)
{
    if (strcmp(option->name, "--restart") == 0) {
        return once(command, option, &options->restart, value, error);
    }
    if (option->value == NULL) {
        options->as_stored = true;
        return true;
    }
    if (options->checkpoint.steps > 0 || options->checkpoint.seconds > 0.0) {
        return bad(error, command, option->name, "given twice");
    }
    return verify_pace_read(value, &options->checkpoint) ||
           bad(error, command, value,
               "--checkpoint wants a number of steps, or a time in s, min or h, as in 500, 30s, 10min");
}

static bool apply(const struct verify_command *command, const struct option *option, const char *value,
                  struct verify_options *options, struct solver_error *error)
{
    switch (option->bit) {
    case VERIFY_TAKES_SET:
        return read_override(command, value, options, error);
    case VERIFY_TAKES_LEVELS:
        return read_levels(command, value, options, error);
    case VERIFY_TAKES_JSON:
        return output(command, option, &options->json, value, ".json", error);
    case VERIFY_TAKES_OUT:
        return once(command, option, &options->out, value, error);
    case VERIFY_TAKES_PICTURE:
        return output(command, option, &options->picture, value, ".png", error);
    case VERIFY_TAKES_DIR:
        return once(command, option, &options->dir, value, error);
    case VERIFY_TAKES_MUTATIONS:
        options->mutations = true;
        return true;
    case VERIFY_TAKES_TOLERANCE:
        return read_tolerance(command, value, options, error);
    case VERIFY_TAKES_VARY:
        return add(command, option, &options->vary, value, true, error);
    case VERIFY_TAKES_ERROR_NAME:
    case VERIFY_TAKES_ERROR:
        return once(command, option, &options->error, value, error);
    case VERIFY_TAKES_STUDY:
        return once(command, option, &options->study, value, error);
    case VERIFY_TAKES_BUDGET:
        return read_budget(command, value, options, error);
    case VERIFY_TAKES_CHECKPOINT:
        return apply_to_checkpoints(command, option, value, options, error);
    default:
        return apply_to_judge(command, option, value, options, error);
    }
}

/* Options that say where results go, or what is kept on the way: the record is the same with and without them. */
static bool leaves_no_trace(const struct option *option)
{
    static const char *const names[] = {"--checkpoint", "--out", "--json"};
    bool found = false;
    for (size_t i = 0; option != NULL && i < sizeof names / sizeof *names; i++) {
        found = found || strcmp(option->name, names[i]) == 0;
    }
    return found;
}

/* Appends words to the command line that the record will hold. */
static void keep_words(const struct option *option, int count, char *const *words, char *line)
{
    for (int i = 0; i < count && !leaves_no_trace(option); i++) {
        size_t used = strlen(line);
        (void)snprintf(line + used, VERIFY_COMMAND_LINE - used, " %s", words[i]);
    }
}

static bool read_operand(const struct verify_command *command, const char *word, struct verify_options *options,
                         struct solver_error *error)
{
    if (options->operand_count == command->most || options->operand_count == VERIFY_OPERANDS) {
        return bad(error, command, word, command->most == 0 ? "this command takes no such word" : "one word too many");
    }
    options->operand[options->operand_count++] = word;
    return true;
}

/* Reads the option words[*at], and its value, which may be the word after it; *at is then the last of them. */
static bool read_option(const struct verify_command *command, int count, char *const *words, int *at,
                        struct verify_options *options, struct solver_error *error)
{
    int first = *at;
    const char *word = words[first];
    size_t length = strcspn(word, "=");
    const struct option *option = find(command, word, length);
    if (option == NULL) {
        return unknown(command, word, error);
    }
    bool attached = word[length] == '=';
    const char *value = attached ? word + length + 1 : "";
    if (option->value == NULL && attached) {
        return bad(error, command, word, "takes no value");
    }
    if (option->value != NULL && !attached) {
        if (first + 1 == count) {
            return solver_fail(error, SOLVER_BAD_INPUT, "%s wants %s after it; see assay %s --help", word,
                               option->value, command->name);
        }
        value = words[++*at];
    }
    keep_words(option, *at - first + 1, words + first, options->line);
    return apply(command, option, value, options, error);
}

/* Whether all that was given belongs together, and nothing is missing. */
static bool check_together(const struct verify_command *command, const struct verify_options *options,
                           struct solver_error *error)
{
    if (options->mutations && options->operand_count + options->override_count + options->level_count > 0) {
        return bad(error, command, "--mutations", "stands alone: it has scenes and oracles of its own");
    }
    if (options->restart != NULL && options->operand_count > 0) {
        return bad(error, command, options->operand[0], "with --restart the checkpoint holds the scene");
    }
    if (options->as_stored && options->restart == NULL) {
        return bad(error, command, "--as-stored", "belongs to --restart");
    }
    bool alone = options->help || options->mutations || options->restart != NULL;
    return alone || options->operand_count >= command->least ||
           solver_fail(error, SOLVER_BAD_INPUT, "assay %s wants %s; see assay %s --help", command->name,
                       command->operands, command->name);
}

bool verify_options_parse(const struct verify_command *command, int count, char *const *words,
                          struct verify_options *options, struct solver_error *error)
{
    *options = (struct verify_options){.operand_count = 0};
    (void)snprintf(options->line, VERIFY_COMMAND_LINE, "assay %s", command->name);
    bool words_only = false; /* after "--" */
    for (int i = 0; i < count; i++) {
        const char *word = words[i];
        bool ends_options = !words_only && strcmp(word, "--") == 0;
        if (!ends_options && !words_only && word[0] == '-' && word[1] != '\0') {
            if (!read_option(command, count, words, &i, options, error)) {
                return false;
            }
            continue;
        }
        keep_words(NULL, 1, words + i, options->line);
        words_only = words_only || ends_options;
        if (!ends_options && !read_operand(command, word, options, error)) {
            return false;
        }
    }
    return check_together(command, options, error);
}

const char verify_by_levels[] = "a study runs several values of n; say which by --levels 4,8,16";

bool verify_refuse_n(const struct verify_options *options, const char *how, struct solver_error *error)
{
    for (size_t i = 0; i < options->override_count; i++) {
        if (strncmp(options->override[i], "n=", 2) == 0 || strncmp(options->override[i], "levels=", 7) == 0) {
            return solver_fail(error, SOLVER_BAD_INPUT, "--set %s: %s", options->override[i], how);
        }
    }
    return true;
}

size_t verify_options_lines(const struct verify_command *command, struct verify_option_line line[VERIFY_OPTIONS])
{
    size_t count = 0;
    for (size_t i = 0; i < OPTIONS; i++) {
        const struct option *option = &options_table[i];
        if (takes(command, option)) {
            (void)snprintf(line[count].words, sizeof line[count].words, "%s%s%s%s%s",
                           option->short_name != NULL ? option->short_name : "",
                           option->short_name != NULL ? ", " : "    ", option->name, option->value == NULL ? "" : " ",
                           option->value == NULL ? "" : option->value);
            line[count++].help = option->help;
        }
    }
    return count;
}

void verify_options_help(FILE *file, const struct verify_command *command)
{
    (void)fprintf(file, "usage: assay %s %s%s[options]\n\n%s\n\noptions:\n", command->name, command->operands,
                  command->operands[0] == '\0' ? "" : " ", command->help);
    struct verify_option_line line[VERIFY_OPTIONS];
    size_t count = verify_options_lines(command, line);
    for (size_t i = 0; i < count; i++) {
        (void)fprintf(file, "  %-24s %s\n", line[i].words, line[i].help);
    }
}

enum verify_exit verify_exit_code(const struct solver_error *error)
{
    switch (error->code) {
    case SOLVER_OK:
        return VERIFY_PASSED;
    case SOLVER_BAD_INPUT:
    case SOLVER_IO:
        return VERIFY_BAD_INPUT;
    case SOLVER_STOPPED:
        return VERIFY_STOPPED;
    default:
        return VERIFY_RUN_FAILED;
    }
}
