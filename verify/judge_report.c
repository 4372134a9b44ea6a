/* A judgement for programs and as a page; the JSON has the shape that --json always has, with null where a file of
 * another solver does not say. */
#include "verify/html.h"
#include "verify/json.h"
#include "verify/judge.h"
#include "verify/report.h"

#include <math.h>
#include <string.h>

/* The name of the first file, without its folder: what stands in the place of a scene's name. */
static void name_of(const struct verify_judgement *judgement, char text[VERIFY_SAMPLE_PLACE])
{
    char place[VERIFY_SAMPLE_PLACE] = "";
    if (judgement->level_count > 0) {
        memcpy(place, judgement->level[0].sample->place, sizeof place);
    }
    char *group = strstr(place, ": /");
    if (group != NULL) {
        *group = '\0';
    }
    const char *slash = strrchr(place, '/');
    (void)snprintf(text, VERIFY_SAMPLE_PLACE, "%s", slash != NULL ? slash + 1 : place);
}

/* NaN where the file does not say. */
static double n_of(const struct verify_judged_level *level)
{
    return level->sample->n > 0 ? (double)level->sample->n : (double)NAN;
}

/* {NAME: value} over the errors of fields that were compared. */
static void errors(FILE *file, const struct verify_judgement *judgement, const double *value)
{
    const struct oracle_kind *kind = judgement->truth->kind;
    const char *between = "";
    for (size_t i = 0; i < VERIFY_NORMS * verify_judged_count(kind); i++) {
        char name[VERIFY_JUDGED_NAME];
        if (judgement->level[0].known[i / VERIFY_NORMS]) {
            (void)fputs(between, file);
            verify_json_number_member(file, verify_judged_name(kind, i, name), value[i]);
            between = ", ";
        }
    }
}

static void level_object(FILE *file, const struct verify_judgement *judgement, const struct verify_judged_level *level)
{
    (void)fputc('{', file);
    verify_json_number_member(file, "n", n_of(level));
    (void)fputs(", ", file);
    verify_json_number_member(file, "h", level->h);
    (void)fprintf(file, ", \"particles\": %zu, \"steps\": null, \"seconds\": null, \"ns_per_particle_step\": null, ",
                  level->sample->count);
    verify_json_text_member(file, "file", level->sample->place);
    (void)fputs(", ", file);
    verify_json_number_member(file, "t", level->time);
    (void)fprintf(file, ", \"weighted\": %s, \"errors\": {", level->sample->weight != NULL ? "true" : "false");
    errors(file, judgement, level->error);
    (void)fputs("}}", file);
}

void verify_judge_json(FILE *file, const struct verify_judgement *judgement)
{
    char name[VERIFY_SAMPLE_PLACE];
    name_of(judgement, name);
    (void)fputs("{\n  ", file);
    verify_json_text_member(file, "scene", name);
    (void)fputs(",\n  ", file);
    verify_json_text_member(file, "oracle", judgement->truth->kind->name);
    (void)fputs(",\n  \"scheme\": \"external\",\n  \"stencil\": \"none\",\n  \"levels\": [", file);
    for (size_t i = 0; i < judgement->level_count; i++) {
        (void)fputs(i == 0 ? "\n    " : ",\n    ", file);
        level_object(file, judgement, &judgement->level[i]);
    }
    (void)fputs("],\n  \"rates\": {", file);
    if (judgement->level_count > 1) {
        errors(file, judgement, judgement->level[judgement->level_count - 1].rate);
    }
    (void)fputc('}', file);
    verify_json_verdict(file, judgement->truth, &judgement->gates);
}

static void levels(FILE *file, const struct verify_judgement *judgement)
{
    const struct oracle_kind *kind = judgement->truth->kind;
    char name[VERIFY_JUDGED_NAME], meaning[VERIFY_JUDGED_MEANING];
    (void)fprintf(file, "<h2>Errors at t = %.6g s</h2><table><tr><th>n</th><th>h [m]</th><th>points</th>",
                  judgement->level[0].time);
    for (size_t i = 0; i < judgement->shown_count; i++) {
        (void)fprintf(file, "<th>");
        verify_html_text(file, verify_judged_name(kind, judgement->shown[i], name));
        (void)fprintf(file, " [%s]</th><th>order</th>", verify_judged_unit(kind, judgement->shown[i]));
    }
    (void)fprintf(file, "<th>file</th></tr>\n");
    for (size_t i = 0; i < judgement->level_count; i++) {
        const struct verify_judged_level *level = &judgement->level[i];
        (void)fprintf(file, "<tr>");
        verify_html_number(file, n_of(level));
        verify_html_number(file, level->h);
        (void)fprintf(file, "<td>%zu</td>", level->sample->count);
        for (size_t j = 0; j < judgement->shown_count; j++) {
            verify_html_cell(file, "e", level->error[judgement->shown[j]]);
            verify_html_cell(file, "f", level->rate[judgement->shown[j]]);
        }
        (void)fprintf(file, "<td class=\"help\">");
        verify_html_text(file, level->sample->place);
        (void)fprintf(file, "</td></tr>\n");
    }
    (void)fprintf(file, "</table>\n<p class=\"note\">");
    for (size_t i = 0; i < judgement->shown_count; i++) {
        verify_html_text(file, verify_judged_name(kind, judgement->shown[i], name));
        (void)fprintf(file, ": ");
        verify_html_text(file, verify_judged_meaning(kind, judgement->shown[i], meaning));
        (void)fprintf(file, ". ");
    }
    (void)fprintf(file, "Order: log(e1/e2)/log(h1/h2) from the level before.</p>\n");
}

static void convergence(FILE *file, const struct verify_judgement *judgement)
{
    (void)fprintf(file, "<h2>Convergence</h2><div class=\"row\">\n");
    for (size_t i = 0; i < judgement->shown_count; i++) {
        char name[VERIFY_JUDGED_NAME];
        size_t which = judgement->shown[i];
        struct verify_errors curve = {.name = verify_judged_name(judgement->truth->kind, which, name),
                                      .unit = verify_judged_unit(judgement->truth->kind, which),
                                      .count = judgement->level_count};
        for (size_t j = 0; j < judgement->level_count; j++) {
            curve.h[j] = judgement->level[j].h;
            curve.e[j] = judgement->level[j].error[which];
        }
        verify_plot_errors(file, &curve);
    }
    (void)fprintf(file, "</div>\n");
}

void verify_judge_html(FILE *file, const struct verify_judgement *judgement)
{
    const struct verify_gates *gates = &judgement->gates;
    char title[VERIFY_SAMPLE_PLACE + 96], name[VERIFY_SAMPLE_PLACE];
    name_of(judgement, name);
    (void)snprintf(title, sizeof title, "%s, judged by %.60s", name, judgement->truth->kind->name);
    verify_html_begin(file, title, judgement->command, judgement->truth,
                      gates->count == 0 ? ""
                      : gates->pass     ? "pass"
                                        : "fail",
                      verify_judge_verdict(judgement));
    if (judgement->level_count > 0 && judgement->truth->proven) {
        levels(file, judgement);
        verify_html_gates(file, gates);
        if (!isnan(judgement->level[0].h)) {
            convergence(file, judgement);
        }
    }
    verify_html_oracle(file, judgement->truth);
    (void)fprintf(file, "</body></html>\n");
}
_Static_assert((int)VERIFY_SAMPLES <= (int)SOLVER_LEVELS, "a curve has room for all levels");
