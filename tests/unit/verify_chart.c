/* Charts: axes and their units, and lines that show what they were given. */
#include "tests/unit/unit.h"
#include "verify/chart.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static char *text;
static size_t length;

static FILE *begin(void)
{
    free(text);
    text = NULL;
    FILE *file = open_memstream(&text, &length);
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    return file;
}

static struct verify_axis axis_of(double low, double high, double margin)
{
    struct verify_axis axis = verify_axis("u", "m");
    verify_axis_hold(&axis, high);
    verify_axis_hold(&axis, NAN);
    verify_axis_hold(&axis, low);
    verify_axis_hold(&axis, INFINITY);
    CU_ASSERT(verify_axis_close(&axis, margin));
    return axis;
}

static void prefixes(void)
{
    static const struct {
        double low, high, per;
        const char *prefix;
    } cases[] = {
        {0, 1, 1, ""},         {0, 999, 1, ""},        {-1000, 3, 1e3, "k"},
        {0, 3.3e7, 1e6, "M"},  {0, 0.5, 1e-3, "m"},    {0, 3.5e-4, 1e-6, "&micro;"},
        {-2e-9, 0, 1e-9, "n"}, {0, 1e-15, 1e-12, "p"}, {0, 1e20, 1e12, "T"},
        {5, 6, 1, ""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct verify_axis axis = axis_of(cases[i].low, cases[i].high, 0);
        CU_ASSERT_DOUBLE_EQUAL(axis.per, cases[i].per, 1e-12 * cases[i].per);
        CU_ASSERT_STRING_EQUAL(axis.prefix, cases[i].prefix);
        CU_ASSERT(axis.low == cases[i].low && axis.high == cases[i].high);
    }
    struct verify_axis wide = axis_of(-1, 3, 0.25);
    CU_ASSERT(wide.low == -2 && wide.high == 4);
    struct verify_axis none = verify_axis("u", "m");
    CU_ASSERT_FALSE(verify_axis_close(&none, 0));
    verify_axis_hold(&none, 7);
    CU_ASSERT_FALSE(verify_axis_close(&none, 0)); /* one value is no extent */
}

static struct verify_chart chart_of(double x0, double x1, double y0, double y1)
{
    return (struct verify_chart){
        .left = 50, .right = 450, .top = 20, .bottom = 220, .x = axis_of(x0, x1, 0), .y = axis_of(y0, y1, 0)};
}

/* Ticks say what stands there, in the unit shown, and lie within the frame. */
static void ticks(void)
{
    struct verify_chart chart = chart_of(0, 3.5e-4, -2.4e7, 1e6);
    chart.x.name = "t";
    FILE *file = begin();
    verify_chart_frame(file, &chart, true);
    CU_ASSERT_EQUAL_FATAL(fclose(file), 0);
    CU_ASSERT_PTR_NOT_NULL(strstr(text, ">100</text>")); /* microseconds */
    CU_ASSERT_PTR_NOT_NULL(strstr(text, ">-20</text>")); /* megapascals */
    CU_ASSERT_PTR_NOT_NULL(strstr(text, "middle\">t [&micro;m]"));
    size_t count = 0;
    for (const char *at = text; (at = strstr(at, "class=\"grid\" x1=\"")) != NULL; at++) {
        double x = strtod(at + 17, NULL);
        CU_ASSERT(x >= 50 && x <= 450);
        count++;
    }
    CU_ASSERT(count >= 6 && count <= 16);
    file = begin();
    verify_chart_frame(file, &chart, false); /* of a panel that has another below it */
    CU_ASSERT_EQUAL_FATAL(fclose(file), 0);
    CU_ASSERT_PTR_NULL(strstr(text, "middle\">t"));
}

enum { POINTS = 3000 };
static double x[POINTS], y[POINTS], drawn[POINTS + 8][2];

/* The vertices of the one polyline in the text; returns how many. */
static size_t vertices(void)
{
    size_t count = 0;
    char *at = strstr(text, "points=\"");
    CU_ASSERT_PTR_NOT_NULL_FATAL(at);
    for (at += 8; *at != '"' && count < POINTS; count++) {
        drawn[count][0] = strtod(at, &at);
        drawn[count][1] = strtod(at + 1, &at);
        at += strspn(at, " ");
    }
    return count;
}

/* Largest height of the given points above or below the drawn line [pixels]. */
static double farthest(const struct verify_chart *chart, size_t points, size_t count)
{
    double worst = 0;
    size_t segment = 0;
    for (size_t i = 0; i < points; i++) {
        double px = 50 + 400 * (x[i] - chart->x.low) / (chart->x.high - chart->x.low);
        double py = 220 - 200 * (y[i] - chart->y.low) / (chart->y.high - chart->y.low);
        while (segment + 2 < count && drawn[segment + 1][0] < px) {
            segment++;
        }
        const double *a = drawn[segment], *b = drawn[segment + 1];
        double along = b[0] > a[0] ? (px - a[0]) / (b[0] - a[0]) : 0;
        worst = fmax(worst, fabs(a[1] + along * (b[1] - a[1]) - py));
    }
    return worst;
}

/* Fewer points, and the same line to a fraction of a pixel, whatever its shape. */
static void lines_are_kept(void)
{
    for (int shape = 0; shape < 4; shape++) {
        for (size_t i = 0; i < POINTS; i++) {
            x[i] = (double)i / (POINTS - 1);
            double s = sin(7 * x[i]);
            y[i] = shape == 0 ? s : shape == 1 ? fabs(s) : shape == 2 ? exp(-50 * x[i]) * s : x[i] * x[i];
        }
        const struct verify_chart chart = chart_of(0, 1, -1, 1);
        FILE *file = begin();
        verify_chart_line(file, &chart, "exact", POINTS, 1, x, y);
        CU_ASSERT_EQUAL_FATAL(fclose(file), 0);
        size_t count = vertices();
        CU_ASSERT(count > 5 && count < POINTS / 5);
        CU_ASSERT(farthest(&chart, POINTS, count) < 0.1);
        CU_ASSERT_DOUBLE_EQUAL(drawn[0][0], 50, 0.01);
        CU_ASSERT_DOUBLE_EQUAL(drawn[count - 1][0], 450, 0.01);
    }
}

/* A point that alone stands out is there. */
static void spikes_are_kept(void)
{
    const struct verify_chart chart = chart_of(0, 1, -1, 1);
    for (size_t i = 0; i < POINTS; i++) {
        x[i] = (double)i / (POINTS - 1);
        y[i] = i == 1234 ? 0.9 : i == POINTS - 1 ? -0.5 : 0;
    }
    FILE *file = begin();
    verify_chart_line(file, &chart, "exact", POINTS, 1, x, y);
    CU_ASSERT_EQUAL_FATAL(fclose(file), 0);
    size_t count = vertices();
    CU_ASSERT(count < 12);
    double top = 220, end = drawn[count - 1][1];
    for (size_t i = 0; i < count; i++) {
        top = fmin(top, drawn[i][1]);
    }
    CU_ASSERT_DOUBLE_EQUAL(top, 30, 0.01);
    CU_ASSERT_DOUBLE_EQUAL(end, 170, 0.01);
}

static size_t lines_in(const char *what)
{
    size_t count = 0;
    for (const char *at = text; (at = strstr(at, what)) != NULL; at++) {
        count++;
    }
    return count;
}

static void what_is_no_number_interrupts(void)
{
    const struct verify_chart chart = chart_of(0, 1, -1, 1);
    const double time[] = {0, 0, 0.2, 0, 0.4, 0, 0.6, NAN, 0.8, 0, 1, 0.5}; /* pairs: stride 2 */
    FILE *file = begin();
    verify_chart_line(file, &chart, "exact", 6, 2, time, time + 1);
    CU_ASSERT_EQUAL_FATAL(fclose(file), 0);
    CU_ASSERT_EQUAL(lines_in("<polyline"), 2);
    CU_ASSERT_EQUAL(lines_in("\"/>"), 2);
    CU_ASSERT_EQUAL(lines_in("nan"), 0);
    file = begin();
    verify_chart_line(file, &chart, "exact", 0, 1, time, time);
    verify_chart_mark(file, &chart, "front", 2);
    verify_chart_mark(file, &chart, "front", NAN);
    CU_ASSERT_EQUAL_FATAL(fclose(file), 0);
    CU_ASSERT_EQUAL(length, 0);
    file = begin();
    verify_chart_mark(file, &chart, "front", 0.25);
    verify_chart_dots(file, &chart, "finest", 3, time + 6, time + 7);
    CU_ASSERT_EQUAL_FATAL(fclose(file), 0);
    CU_ASSERT_PTR_NOT_NULL(strstr(text, "x1=\"150.0\""));
    CU_ASSERT_EQUAL(lines_in("<circle"), 1);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"prefixes", prefixes},
        {"ticks", ticks},
        {"lines are kept", lines_are_kept},
        {"spikes are kept", spikes_are_kept},
        {"what is no number interrupts", what_is_no_number_interrupts},
    };
    int code = unit_main("chart", tests, sizeof tests / sizeof *tests);
    free(text);
    return code;
}
