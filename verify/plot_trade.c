/* Work-precision charts: error over cost, both axes logarithmic. Attributes stand at each element, so that a chart
 * looks the same within a page and alone. */
#include "verify/report_trade.h"

#include <math.h>
#include <string.h>

/* Pixels of the plotted area within a chart. */
enum { LEFT = 66, RIGHT = VERIFY_TRADE_CHART_WIDTH - 12, TOP = 30, BOTTOM = VERIFY_TRADE_CHART_HEIGHT - 60 };
/* One colour for each kind, a scheme on a stencil (Okabe and Ito's, and three more that differ in lightness too). */
enum { KINDS = 10, KIND_NAME = 2 * SOLVER_NAME };
static const char *const colours[KINDS] = {"#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9",
                                           "#d55e00", "#7a5195", "#8c6d1f", "#b8b000", "#777777"};

struct chart {
    const struct verify_trade *trade;
    enum verify_cost cost;
    double x0, x1, y0, y1; /* powers of ten */
    size_t kinds, above;   /* above: runs whose error is beyond the chart */
    char kind[KINDS][KIND_NAME];
};

static double x_of(const struct chart *chart, double power)
{
    return LEFT + (RIGHT - LEFT) * (power - chart->x0) / (chart->x1 - chart->x0);
}

static double y_of(const struct chart *chart, double power)
{
    return BOTTOM - (BOTTOM - TOP) * (power - chart->y0) / (chart->y1 - chart->y0);
}

static bool is_shown(const struct chart *chart, const struct verify_trade_run *run)
{
    return run->end == VERIFY_MEASURED && run->error[chart->trade->chosen] > 0 && run->cost[chart->cost] > 0;
}

/* Which kind a run is of; those that are too many share the last. */
static size_t kind_of(struct chart *chart, const struct verify_trade_run *run)
{
    char scheme[SOLVER_NAME] = "", stencil[SOLVER_NAME] = "", name[KIND_NAME];
    (void)verify_trade_word(run->words, "scheme", scheme);
    (void)verify_trade_word(run->words, "stencil", stencil);
    (void)snprintf(name, sizeof name, "%s%s%s", scheme, scheme[0] != '\0' && stencil[0] != '\0' ? " " : "", stencil);
    size_t i = 0;
    while (i < chart->kinds && strcmp(chart->kind[i], name) != 0) {
        i++;
    }
    if (i == chart->kinds && chart->kinds < KINDS) {
        (void)snprintf(chart->kind[chart->kinds++], KIND_NAME, "%s", i + 1 < KINDS ? name : "others");
    }
    return i < KINDS ? i : KINDS - 1;
}

/* Whole decades around what is shown; errors a hundred times the scene's own at its coarsest level say that a run is of
 * no use, not by how much. */
static void stretch(struct chart *chart)
{
    const struct verify_trade *trade = chart->trade;
    double most = INFINITY;
    for (size_t i = trade->run_count; i-- > 0;) {
        most = trade->run[i].own && is_shown(chart, &trade->run[i]) ? 100 * trade->run[i].error[trade->chosen] : most;
    }
    chart->x0 = chart->y0 = INFINITY;
    chart->x1 = chart->y1 = -INFINITY;
    for (size_t i = 0; i < trade->run_count; i++) {
        const struct verify_trade_run *run = &trade->run[i];
        if (!is_shown(chart, run)) {
            continue;
        }
        (void)kind_of(chart, run);
        double error = run->error[trade->chosen];
        chart->above += error > most;
        chart->x0 = fmin(chart->x0, floor(log10(run->cost[chart->cost])));
        chart->x1 = fmax(chart->x1, ceil(log10(run->cost[chart->cost]) + 1e-9));
        chart->y0 = fmin(chart->y0, floor(log10(error)));
        chart->y1 = fmax(chart->y1, ceil(log10(fmin(error, most)) + 1e-9));
    }
}

static void draw_power(FILE *file, double x, double y, const char *anchor, int power)
{
    (void)fprintf(file, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">1e%d</text>\n", x, y, anchor, power);
}

static void draw_frame(FILE *file, const struct chart *chart)
{
    static const char line[] = "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#e3e7eb\"/>\n";
    for (int power = (int)chart->x0; power <= (int)chart->x1; power++) {
        double x = x_of(chart, power);
        (void)fprintf(file, line, x, (double)TOP, x, (double)BOTTOM);
        draw_power(file, x, BOTTOM + 16, "middle", power);
    }
    for (int power = (int)chart->y0; power <= (int)chart->y1; power++) {
        double y = y_of(chart, power);
        (void)fprintf(file, line, (double)LEFT, y, (double)RIGHT, y);
        draw_power(file, LEFT - 6, y + 4, "end", power);
    }
    (void)fprintf(file,
                  "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" fill=\"none\" stroke=\"#57606a\"/>\n"
                  "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\">%s</text>\n"
                  "<text transform=\"translate(16 %d) rotate(-90)\" text-anchor=\"middle\">error %s</text>\n",
                  LEFT, TOP, RIGHT - LEFT, BOTTOM - TOP, (LEFT + RIGHT) / 2, BOTTOM + 38,
                  verify_cost_meaning(chart->cost), (TOP + BOTTOM) / 2, chart->trade->error_name[chart->trade->chosen]);
    if (chart->above > 0) {
        (void)fprintf(file, "<text x=\"%d\" y=\"%d\" text-anchor=\"end\" fill=\"#57606a\">%zu runs lie above</text>\n",
                      RIGHT, TOP - 8, chart->above);
    }
}

static void draw_dot(FILE *file, struct chart *chart, const struct verify_trade_run *run)
{
    double y = log10(run->error[chart->trade->chosen]);
    if (y <= chart->y1) {
        bool front = run->front[chart->cost];
        (void)fprintf(file, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%s\" fill=\"%s\" fill-opacity=\"%s\"/>\n",
                      x_of(chart, log10(run->cost[chart->cost])), y_of(chart, y), front ? "4.5" : "2.2",
                      colours[kind_of(chart, run)], front ? "1" : "0.35");
    }
}

/* The front as stairs: what a cost buys until a larger one buys more. */
static void draw_front(FILE *file, const struct chart *chart)
{
    const struct verify_trade *trade = chart->trade;
    double at = -INFINITY, y = NAN;
    (void)fprintf(file, "<polyline fill=\"none\" stroke=\"#1b1f24\" stroke-width=\"1\" points=\"");
    for (;;) {
        const struct verify_trade_run *next = NULL;
        for (size_t i = 0; i < trade->run_count; i++) {
            const struct verify_trade_run *run = &trade->run[i];
            bool after = is_shown(chart, run) && run->front[chart->cost] && run->cost[chart->cost] > at;
            next = after && (next == NULL || run->cost[chart->cost] < next->cost[chart->cost]) ? run : next;
        }
        if (next == NULL) {
            break;
        }
        at = next->cost[chart->cost];
        double x = x_of(chart, log10(at)), now = y_of(chart, fmin(log10(next->error[trade->chosen]), chart->y1));
        if (!isnan(y)) {
            (void)fprintf(file, "%.1f,%.1f ", x, y);
        }
        (void)fprintf(file, "%.1f,%.1f ", x, now);
        y = now;
    }
    (void)fprintf(file, "%d,%.1f\"/>\n", RIGHT, y);
}

/* Rings around the scene's own configuration, level by level. */
static void draw_own(FILE *file, const struct chart *chart)
{
    for (size_t i = 0; i < chart->trade->run_count; i++) {
        const struct verify_trade_run *run = &chart->trade->run[i];
        if (run->own && is_shown(chart, run)) {
            (void)fprintf(file, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"7.5\" fill=\"none\" stroke=\"#1b1f24\"/>\n",
                          x_of(chart, log10(run->cost[chart->cost])),
                          y_of(chart, log10(run->error[chart->trade->chosen])));
        }
    }
}

void verify_plot_trade_key(FILE *file, const struct verify_trade *trade)
{
    struct chart chart = {.trade = trade, .cost = VERIFY_PAIRS};
    stretch(&chart);
    int y = TOP + 12;
    for (size_t i = 0; i < chart.kinds; i++, y += 18) {
        (void)fprintf(file, "<circle cx=\"14\" cy=\"%d\" r=\"4.5\" fill=\"%s\"/><text x=\"28\" y=\"%d\">%s</text>\n",
                      y - 4, colours[i], y, chart.kind[i]);
    }
    (void)fprintf(file,
                  "<circle cx=\"14\" cy=\"%d\" r=\"7.5\" fill=\"none\" stroke=\"#1b1f24\"/><text x=\"28\" "
                  "y=\"%d\">the scene's own</text>\n",
                  y - 4, y);
}

void verify_plot_trade(FILE *file, const struct verify_trade *trade, enum verify_cost cost)
{
    struct chart chart = {.trade = trade, .cost = cost};
    stretch(&chart);
    if (!(chart.x1 > chart.x0) || !(chart.y1 > chart.y0)) {
        (void)fprintf(file, "<text x=\"%d\" y=\"%d\">nothing to plot</text>\n", LEFT, TOP + 20);
        return;
    }
    draw_frame(file, &chart);
    for (int front = 0; front < 2; front++) { /* the front on top */
        for (size_t i = 0; i < trade->run_count; i++) {
            if (is_shown(&chart, &trade->run[i]) && trade->run[i].front[cost] == (front == 1)) {
                draw_dot(file, &chart, &trade->run[i]);
            }
        }
        if (front == 0) {
            draw_front(file, &chart);
        }
    }
    draw_own(file, &chart);
}

void verify_trade_svg(FILE *file, const struct verify_trade *trade)
{
    static const enum verify_cost order[VERIFY_COSTS] = {VERIFY_SECONDS, VERIFY_PAIRS, VERIFY_BYTES};
    int width = VERIFY_COSTS * VERIFY_TRADE_CHART_WIDTH + VERIFY_TRADE_KEY_WIDTH;
    (void)fprintf(file,
                  "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" "
                  "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"%d\" height=\"%d\" fill=\"#ffffff\"/>\n",
                  width, VERIFY_TRADE_CHART_HEIGHT, width, VERIFY_TRADE_CHART_HEIGHT, width, VERIFY_TRADE_CHART_HEIGHT);
    for (int i = 0; i < VERIFY_COSTS; i++) {
        (void)fprintf(file, "<g transform=\"translate(%d 0)\">\n", i * VERIFY_TRADE_CHART_WIDTH);
        verify_plot_trade(file, trade, order[i]);
        (void)fprintf(file, "</g>\n");
    }
    (void)fprintf(file, "<g transform=\"translate(%d 0)\">\n", VERIFY_COSTS * VERIFY_TRADE_CHART_WIDTH);
    verify_plot_trade_key(file, trade);
    (void)fprintf(file, "</g>\n</svg>\n");
}
