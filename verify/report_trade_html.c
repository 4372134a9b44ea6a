#include "verify/html.h"
#include "verify/report_trade.h"

#include <math.h>

enum { MEMBERS = 512 };

static void charts(FILE *file, const struct verify_trade *trade)
{
    static const enum verify_cost order[VERIFY_COSTS] = {VERIFY_SECONDS, VERIFY_PAIRS, VERIFY_BYTES};
    (void)fprintf(file, "<h2>Error over cost</h2><div class=\"row\">\n");
    for (int i = 0; i < VERIFY_COSTS; i++) {
        (void)fprintf(file, "<svg viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"error over %s\">\n",
                      VERIFY_TRADE_CHART_WIDTH, VERIFY_TRADE_CHART_HEIGHT, verify_cost_name(order[i]));
        verify_plot_trade(file, trade, order[i]);
        (void)fprintf(file, "</svg>\n");
    }
    (void)fprintf(file, "<svg style=\"width:%dpx\" viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"key\">\n",
                  VERIFY_TRADE_KEY_WIDTH, VERIFY_TRADE_KEY_WIDTH, VERIFY_TRADE_CHART_HEIGHT);
    verify_plot_trade_key(file, trade);
    (void)fprintf(file,
                  "</svg>\n</div>\n<p class=\"note\">Each dot is a run; large ones, with the line of stairs, are those "
                  "that no other beats. Rings are the scene's own configuration, level by level.</p>\n");
}

static void fronts(FILE *file, const struct verify_trade *trade)
{
    size_t member[MEMBERS], count = verify_trade_members(trade, member, MEMBERS);
    (void)fprintf(file, "<h2>What nothing else beats</h2><table><tr><th>configuration</th><th>n</th>");
    for (size_t i = 0; i < trade->error_count; i++) {
        (void)fprintf(file, "<th>");
        verify_html_text(file, trade->error_name[i]);
        (void)fprintf(file, "</th>");
    }
    (void)fprintf(file, "<th>time [s]</th><th>noise [-]</th><th>threads</th><th>pair<br>evaluations</th>"
                        "<th>bytes<br>moved</th><th>first in</th></tr>\n");
    for (size_t i = 0; i < count; i++) {
        const struct verify_trade_run *run = &trade->run[member[i]];
        char words[VERIFY_TRADE_WORDS];
        verify_trade_short(trade, run, words);
        (void)fprintf(file, "<tr><td>");
        verify_html_text(file, words);
        (void)fprintf(file, "</td><td>%d</td>", run->n);
        for (size_t k = 0; k < trade->error_count; k++) {
            verify_html_cell(file, "e", run->error[k]);
        }
        verify_html_cell(file, "e", run->cost[VERIFY_SECONDS]);
        verify_html_cell(file, "f", run->noise);
        (void)fprintf(file, "<td>%d</td>", run->threads);
        verify_html_cell(file, "e", run->cost[VERIFY_PAIRS]);
        verify_html_cell(file, "e", run->cost[VERIFY_BYTES]);
        (void)fprintf(file, "<td>%s%s%s</td></tr>\n", run->front[VERIFY_SECONDS] ? "time " : "",
                      run->front[VERIFY_PAIRS] ? "pairs " : "", run->front[VERIFY_BYTES] ? "bytes" : "");
    }
    (void)fprintf(file,
                  "</table>\n<p class=\"note\">Time: set-up and time loop, the best of the repeats; noise: second "
                  "fastest over fastest, less 1, a dash where it was timed once.</p>\n");
}

static void advice(FILE *file, const struct verify_trade *trade)
{
    double decade[16];
    size_t count = verify_trade_decades(trade, trade->chosen, decade, 16);
    (void)fprintf(file, "<h2>What to choose</h2><ul>\n");
    for (size_t i = 0; i < count; i++) {
        char text[VERIFY_ADVICE];
        verify_trade_advise(trade, trade->chosen, decade[i], text);
        (void)fprintf(file, "<li>");
        verify_html_text(file, text);
        (void)fprintf(file, "</li>\n");
    }
    (void)fprintf(file, "</ul>\n");
}

/* Nothing is dropped: each run that was not measured, with its reason. */
static void others(FILE *file, const struct verify_trade *trade)
{
    static const char *const heading[] = {
        [VERIFY_REFUSED] = "Refused", [VERIFY_BROKE] = "Broke down", [VERIFY_LEFT_OUT] = "Left out"};
    for (int end = VERIFY_REFUSED; end <= VERIFY_LEFT_OUT; end++) {
        (void)fprintf(file, "<h2>%s</h2><table><tr><th>configuration</th><th>n</th><th>why</th></tr>\n", heading[end]);
        for (size_t i = 0; i < trade->run_count; i++) {
            const struct verify_trade_run *run = &trade->run[i];
            if ((int)run->end == end) {
                (void)fprintf(file, "<tr><td>");
                verify_html_text(file, run->words);
                verify_html_text(file, run->variant[0] != '\0' ? ", " : "");
                verify_html_text(file, run->variant);
                (void)fprintf(file, "</td><td>%d</td><td class=\"help\">", run->n);
                verify_html_text(file, run->why);
                verify_html_text(file, run->by[0] != '\0' ? ": " : "");
                verify_html_text(file, run->by);
                (void)fprintf(file, "</td></tr>\n");
            }
        }
        (void)fprintf(file, "</table>\n");
    }
}

void verify_trade_html(FILE *file, const struct verify_trade *trade, const struct solver_scene *scene,
                       const struct verify_truth *truth)
{
    verify_html_begin(file, scene->title, scene->source, truth, "", "What accuracy costs");
    if (trade->stopped[0] != '\0') {
        char text[512];
        verify_trade_stopped(trade, text, sizeof text);
        (void)fprintf(file, "<p><strong>The study was ");
        verify_html_text(file, text);
        (void)fprintf(file, ".</strong></p>\n");
    }
    charts(file, trade);
    advice(file, trade);
    fronts(file, trade);
    verify_html_oracle(file, truth);
    verify_html_configuration(file, scene);
    others(file, trade);
    (void)fprintf(file, "<h2>Scene</h2><pre>");
    verify_html_text(file, scene->text);
    (void)fprintf(file, "</pre></body></html>\n");
}
