#include "verify/json.h"
#include "verify/report_trade.h"

#include <stdlib.h>
#include <string.h>

/* {KEY: "value"} of words. */
static void configuration(FILE *file, const char *words)
{
    (void)fputs("\"configuration\": {", file);
    for (const char *word = words; *word != '\0'; word += strspn(word, " ")) {
        size_t whole = strcspn(word, " "), key = strcspn(word, "=");
        char text[VERIFY_TRADE_WORDS];
        (void)fputs(word == words ? "" : ", ", file);
        (void)snprintf(text, sizeof text, "%.*s", (int)key, word);
        verify_json_string(file, text);
        (void)fputs(": ", file);
        (void)snprintf(text, sizeof text, "%.*s", (int)(whole - key - 1), word + key + 1);
        verify_json_string(file, text);
        word += whole;
    }
    (void)fputs("}, ", file);
}

/* What every run has. */
static void identity(FILE *file, const struct verify_trade_run *run)
{
    (void)fputc('{', file);
    configuration(file, run->words);
    verify_json_text_member(file, "variant", run->variant);
    (void)fprintf(file, ", \"n\": %d", run->n);
}

static void measured(FILE *file, const struct verify_trade *trade, const struct verify_trade_run *run)
{
    const char *between = "";
    identity(file, run);
    (void)fprintf(file, ", \"own\": %s, \"particles\": %zu, \"pairs\": %zu, \"steps\": %zu, ",
                  run->own ? "true" : "false", run->particles, run->pairs, run->steps);
    verify_json_number_member(file, "evaluations", run->evaluations);
    (void)fputs(", \"cost\": {", file);
    for (int cost = 0; cost < VERIFY_COSTS; cost++) {
        (void)fputs(cost == 0 ? "" : ", ", file);
        verify_json_number_member(file, verify_cost_name((enum verify_cost)cost), run->cost[cost]);
    }
    (void)fprintf(file, "}, \"threads\": %d, \"repeats\": %d, ", run->threads, run->repeats);
    verify_json_number_member(file, "noise", run->noise);
    (void)fputs(", \"errors\": {", file);
    for (size_t i = 0; i < trade->error_count; i++) {
        (void)fputs(i == 0 ? "" : ", ", file);
        verify_json_number_member(file, trade->error_name[i], run->error[i]);
    }
    (void)fputs("}, \"fronts\": [", file);
    for (int cost = 0; cost < VERIFY_COSTS; cost++) {
        if (run->front[cost]) {
            (void)fprintf(file, "%s\"%s\"", between, verify_cost_name((enum verify_cost)cost));
            between = ", ";
        }
    }
    (void)fputs("]}", file);
}

/* Runs that ended in one way. */
static void list(FILE *file, const struct verify_trade *trade, const char *name, enum verify_trade_end end)
{
    const char *between = "\n    ";
    (void)fprintf(file, ",\n  \"%s\": [", name);
    for (size_t i = 0; i < trade->run_count; i++) {
        const struct verify_trade_run *run = &trade->run[i];
        if (run->end != end) {
            continue;
        }
        (void)fputs(between, file);
        between = ",\n    ";
        if (end == VERIFY_MEASURED) {
            measured(file, trade, run);
            continue;
        }
        identity(file, run);
        (void)fputs(", ", file);
        verify_json_text_member(file, "why", run->why);
        (void)fputs(", ", file);
        verify_json_text_member(file, "by", run->by);
        (void)fputc('}', file);
    }
    (void)fputc(']', file);
}

/* A run's place among those measured, or null. */
static void place(FILE *file, const struct verify_trade *trade, size_t run)
{
    size_t before = 0;
    for (size_t i = 0; i < run && run < trade->run_count; i++) {
        before += trade->run[i].end == VERIFY_MEASURED;
    }
    (void)fprintf(file, run < trade->run_count ? "%zu" : "null", before);
}

static void advice(FILE *file, const struct verify_trade *trade)
{
    double decade[16];
    size_t count = verify_trade_decades(trade, trade->chosen, decade, 16);
    (void)fputs(",\n  \"advice\": [", file);
    for (size_t i = 0; i < count; i++) {
        (void)fputs(i == 0 ? "{" : ", {", file);
        verify_json_number_member(file, "error", decade[i]);
        (void)fputs(", \"run\": ", file);
        place(file, trade, verify_trade_cheapest(trade, trade->chosen, decade[i], VERIFY_SECONDS, false));
        (void)fputs(", \"own\": ", file);
        place(file, trade, verify_trade_cheapest(trade, trade->chosen, decade[i], VERIFY_SECONDS, true));
        (void)fputc('}', file);
    }
    (void)fputs("]\n}\n", file);
}

static void overrides(FILE *file, const char *lines)
{
    (void)fputs(",\n  \"overrides\": [", file);
    for (const char *line = lines; *line != '\0';) {
        size_t length = strcspn(line, "\n");
        char text[VERIFY_COMMAND_LINE];
        (void)snprintf(text, sizeof text, "%.*s", (int)length, line);
        (void)fputs(line == lines ? "" : ", ", file);
        verify_json_string(file, text);
        line += length + (line[length] == '\n');
    }
    (void)fputc(']', file);
}

static void axes(FILE *file, const struct verify_trade *trade)
{
    (void)fputs(",\n  \"axes\": {", file);
    for (size_t i = 0; i < trade->axis_count; i++) {
        (void)fprintf(file, "%s\"%s\": [", i == 0 ? "" : ", ", trade->axis[i].key);
        for (size_t j = 0; j < trade->axis[i].count; j++) {
            (void)fputs(j == 0 ? "" : ", ", file);
            verify_json_string(file, trade->axis[i].value[j]);
        }
        (void)fputc(']', file);
    }
    (void)fputs("},\n  \"levels\": [", file);
    for (size_t i = 0; i < trade->level_count; i++) {
        (void)fprintf(file, "%s%d", i == 0 ? "" : ", ", trade->level[i]);
    }
    (void)fputc(']', file);
}

void verify_trade_json(FILE *file, const struct verify_trade *trade)
{
    (void)fputs("{\n  ", file);
    verify_json_text_member(file, "scene", trade->scene);
    (void)fputs(",\n  ", file);
    verify_json_text_member(file, "oracle", trade->oracle);
    (void)fputs(",\n  ", file);
    verify_json_text_member(file, "error", trade->error_name[trade->chosen]);
    if (trade->stopped[0] != '\0') {
        (void)fputs(",\n  ", file);
        verify_json_text_member(file, "stopped_by", trade->stopped);
    } else {
        (void)fputs(",\n  \"stopped_by\": null", file);
    }
    overrides(file, trade->overrides);
    (void)fputs(",\n  ", file);
    verify_json_number_member(file, "budget", trade->budget);
    (void)fputs(",\n  ", file);
    verify_json_number_member(file, "spent", trade->spent);
    axes(file, trade);
    list(file, trade, "runs", VERIFY_MEASURED);
    list(file, trade, "refused", VERIFY_REFUSED);
    list(file, trade, "broke_down", VERIFY_BROKE);
    list(file, trade, "left_out", VERIFY_LEFT_OUT);
    advice(file, trade);
}
