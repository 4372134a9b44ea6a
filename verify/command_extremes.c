/* assay extremes: a map of where schemes work, measured row by row. */
#include "solver/suggest.h"
#include "verify/commands.h"
#include "verify/extremes.h"
#include "verify/files.h"
#include "verify/json.h"
#include "verify/signals.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What came of all rows so far. */
struct tally {
    FILE *json; /* in memory; NULL: none is wanted */
    size_t rows, judged, failed;
    const char *unfinished; /* the extreme during which the program was asked to end; NULL: all was measured */
};

static void print(const struct verify_extreme_row *row, bool judged, bool holds)
{
    char fails[24] = "-";
    if (!isnan(row->fails)) {
        (void)snprintf(fails, sizeof fails, "%.4g", row->fails);
    }
    (void)printf("%-4s  %-34s %-34s %12.5g %12s %-8s %s\n",
                 !judged ? ""
                 : holds ? "ok"
                         : "FAIL",
                 row->what, row->quantity, row->value, fails, row->unit,
                 row->note[0] == '\0' && !isfinite(row->value) ? "nothing was measured" : row->note);
    (void)fflush(stdout);
}

static void write_row(FILE *file, bool first, const char *extreme, const struct verify_extreme_row *row, bool judged,
                      bool holds)
{
    (void)fprintf(file, "%s\n  {", first ? "" : ",");
    verify_json_text_member(file, "extreme", extreme);
    (void)fprintf(file, ", ");
    verify_json_text_member(file, "what", row->what);
    (void)fprintf(file, ", ");
    verify_json_text_member(file, "quantity", row->quantity);
    (void)fprintf(file, ", ");
    verify_json_text_member(file, "unit", row->unit);
    (void)fprintf(file, ", ");
    verify_json_number_member(file, "value", row->value);
    (void)fprintf(file, ", ");
    verify_json_number_member(file, "fails", row->fails);
    (void)fprintf(file, ", ");
    verify_json_number_member(file, "least", row->least);
    (void)fprintf(file, ", ");
    verify_json_number_member(file, "most", row->most);
    (void)fprintf(file, ", ");
    verify_json_text_member(file, "note", row->note);
    (void)fprintf(file, ", \"pass\": %s}", !judged ? "null" : holds ? "true" : "false");
}

static void take(void *context, const char *extreme, const struct verify_extreme_row *row)
{
    struct tally *tally = context;
    bool judged = isfinite(row->least) || isfinite(row->most) || !isfinite(row->value);
    bool holds = verify_extreme_holds(row);
    print(row, judged, holds);
    if (tally->json != NULL) {
        write_row(tally->json, tally->rows == 0, extreme, row, judged, holds);
    }
    tally->rows++;
    tally->judged += judged;
    tally->failed += judged && !holds;
}

static int refuse(const char *word)
{
    const char *names[32];
    char list[256] = "";
    size_t count = 0;
    for (const struct verify_extreme *extreme = verify_extremes_table(); extreme->name != NULL && count < 32;
         extreme++) {
        size_t used = strlen(list);
        (void)snprintf(list + used, sizeof list - used, "%s%s", count > 0 ? ", " : "", extreme->name);
        names[count++] = extreme->name;
    }
    const char *meant = solver_suggest(word, names, count);
    struct solver_error error;
    (void)solver_fail(&error, SOLVER_BAD_INPUT, "there is no extreme \"%.64s\"%s%s; there are %s", word,
                      meant != NULL ? ", did you mean " : "", meant != NULL ? meant : "", list);
    return verify_complain(&error);
}

static bool run(const struct verify_extreme *extreme, struct verify_extremes *in, struct solver_error *error)
{
    (void)printf("\n%s: %s\n%-4s  %-34s %-34s %12s %12s\n", extreme->name, extreme->summary, "", "what", "quantity",
                 "holds", "fails");
    in->extreme = extreme->name;
    return extreme->run(in, error);
}

/* What the command line adds to every run, without which rows would say more than they measure. */
static void write_overrides(FILE *file, const struct verify_options *options)
{
    (void)fputs("{\"set\": [", file);
    for (size_t i = 0; i < options->override_count; i++) {
        (void)fputs(i > 0 ? ", " : "", file);
        verify_json_string(file, options->override[i]);
    }
    (void)fputs("], \"rows\": [", file);
}

static bool wanted(const struct verify_extreme *extreme, const char *word)
{
    return word == NULL || strcmp(word, extreme->name) == 0;
}

static bool run_all(const struct verify_options *options, const char *word, struct tally *tally,
                    struct solver_error *error)
{
    struct verify_extremes in = {.options = options, .take = take, .context = tally};
    in.rows = options->operand_count > 1 ? options->operand[1] : NULL;
    bool done = true;
    for (const struct verify_extreme *extreme = verify_extremes_table(); done && extreme->name != NULL; extreme++) {
        done = !wanted(extreme, word) || verify_extreme_check(extreme, options, error);
    }
    for (size_t i = 0; done && i < options->override_count; i++) {
        (void)printf("%s%s%s", i == 0 ? "in every run: " : ", ", options->override[i],
                     i + 1 == options->override_count ? "\n" : "");
    }
    verify_signals_watch();
    for (const struct verify_extreme *extreme = verify_extremes_table(); done && extreme->name != NULL; extreme++) {
        done = !wanted(extreme, word) || run(extreme, &in, error);
        if (verify_signals_asked() != 0) {
            tally->unfinished = extreme->name;
            done = true;
            break;
        }
    }
    verify_signals_leave();
    if (done && tally->unfinished == NULL && in.rows != NULL && tally->rows == 0) {
        return solver_fail(error, SOLVER_BAD_INPUT, "assay extremes %s: no row is of anything with \"%.100s\" in it",
                           word, in.rows);
    }
    return done;
}

/* Whether all rows hold: unknown where some are missing and none of the others fails. */
static void write_end(FILE *file, const struct tally *tally)
{
    (void)fputs("\n], ", file);
    if (tally->unfinished != NULL) {
        verify_json_text_member(file, "stopped_by", verify_signals_name(verify_signals_asked()));
        (void)fputs(", ", file);
        verify_json_text_member(file, "unfinished", tally->unfinished);
    } else {
        (void)fputs("\"stopped_by\": null, \"unfinished\": null", file);
    }
    (void)fprintf(file, ", \"pass\": %s}\n", tally->failed > 0 ? "false" : tally->unfinished != NULL ? "null" : "true");
}

/* The rows, and as JSON at `path` unless that is NULL; whole or not at all. */
static bool tell(const struct verify_options *options, const char *word, struct tally *tally,
                 struct solver_error *error)
{
    char *text = NULL;
    size_t size = 0;
    if (options->json == NULL) {
        return run_all(options, word, tally, error);
    }
    if (!verify_file_check(options->json, error)) {
        return false;
    }
    tally->json = open_memstream(&text, &size);
    if (tally->json == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "%s: no memory for the report", options->json);
    }
    write_overrides(tally->json, options);
    bool done = run_all(options, word, tally, error);
    write_end(tally->json, tally);
    bool whole = ferror(tally->json) == 0;
    whole = fclose(tally->json) == 0 && whole;
    if (done && !whole) {
        done = solver_fail(error, SOLVER_NO_MEMORY, "%s: no memory for the report", options->json);
    }
    done = done && verify_file_write(options->json, text, size, error);
    free(text);
    return done;
}

/* What there is of a map that was not finished. */
static int say_stopped(const struct tally *tally, const struct verify_options *options)
{
    struct solver_error error;
    (void)solver_fail(&error, SOLVER_STOPPED,
                      "extremes: stopped by %s during %s; the %zu rows before are whole%s%.400s, and no others were "
                      "measured",
                      verify_signals_name(verify_signals_asked()), tally->unfinished, tally->rows,
                      options->json != NULL ? ", stand in " : "", options->json != NULL ? options->json : "");
    return verify_complain(&error);
}

int verify_command_extremes(const struct verify_options *options)
{
    struct solver_error error = {.code = SOLVER_OK};
    struct tally tally = {.json = NULL, .unfinished = NULL};
    const char *word = options->operand_count > 0 ? options->operand[0] : NULL;
    if (word != NULL && verify_extreme_find(word) == NULL) {
        return refuse(word);
    }
    if (!tell(options, word, &tally, &error)) {
        return verify_complain(&error);
    }
    (void)printf("\n%zu rows, %zu with bounds, %zu of these fail%s\n", tally.rows, tally.judged, tally.failed,
                 tally.unfinished != NULL ? "; not all were measured" : "");
    if (tally.unfinished != NULL) {
        return say_stopped(&tally, options);
    }
    return tally.failed == 0 ? VERIFY_PASSED : VERIFY_FAILED;
}
